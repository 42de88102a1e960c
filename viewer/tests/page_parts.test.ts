import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { readableRange, ticksBetween, tickTexts } from "../src/axis";
import { Clock, comfortableSpeed, neighbour, speedsAround } from "../src/clock";
import * as format from "../src/format";
import { candidates, overlap } from "../src/labels";
import { markPlaces } from "../src/timeline";
import { cameraPlace } from "../src/view_frame";

describe("the clock", () => {
  it("plays at the speed chosen, stops at the end, and starts again from there", () => {
    const clock = new Clock(1, 4);
    clock.toggle();
    clock.advance(2);
    expect(clock.time).toBe(3);
    clock.advance(2);
    expect([clock.time, clock.isPlaying]).toEqual([4, false]);
    clock.toggle();
    expect([clock.time, clock.isPlaying]).toEqual([1, true]);
  });

  it("shows short motions slowly and long ones quickly", () => {
    expect([0.36, 3, 3600, 3e7].map((duration) => comfortableSpeed(duration))).toEqual([0.05, 1, 500, 5e6]);
    for (const duration of [1e-6, 0.36, 3, 3600]) {
      const speed = comfortableSpeed(duration);
      expect(speedsAround(speed)).toContain(speed);
      expect(duration / speed).toBeGreaterThan(1);
      expect(duration / speed).toBeLessThan(21);
    }
  });

  it("steps to the next time on either side, in whatever order they come", () => {
    const times = [0.7, 0.2, 0.9, 0.2];
    expect(neighbour(times, 0.2, 1)).toBe(0.7);
    expect(neighbour(times, 0.5, -1)).toBe(0.2);
    expect(neighbour(times, 0.9, 1)).toBeNull();
  });
});

describe("the marks of impacts", () => {
  it("are where the impacts are", () => {
    expect(markPlaces([1, 1.5, 3], 1, 2)).toEqual([0, 0.25, 1]);
    expect(markPlaces([0], 0, 0)).toEqual([0]);
  });

  it("go on to the last of any number of impacts, and are not more than can be seen", () => {
    const marks = markPlaces(Array.from({ length: 20000 }, (_, i) => 0.5 * i), 0, 10000);
    expect(marks.length).toBeGreaterThan(100);
    expect(marks.length).toBeLessThan(1000);
    for (let i = 1; i < marks.length; ++i) expect(marks[i] - marks[i - 1]).toBeLessThan(0.01);
    expect(marks.at(-1)).toBeGreaterThan(0.99);
  });
});

describe("the picture of the whole scene", () => {
  it("holds all points with equal margins, though what is near looks larger", () => {
    const away = new THREE.Vector3(-0.35, -1, 0.42).normalize();
    const line = [new THREE.Vector3(-5, 0, 0), new THREE.Vector3(5, 0, 0)];
    const tall = [new THREE.Vector3(1, 2, -5), new THREE.Vector3(1, 0, 5)];
    for (const [points, axis] of [[line, "x"], [tall, "y"]] as const) {
      const vertical = Math.tan(THREE.MathUtils.degToRad(35 / 2));
      const { target, distance } = cameraPlace(points, new THREE.Vector3(), away, { horizontal: vertical, vertical });
      const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
      camera.up.set(0, 0, 1);
      camera.position.copy(target).addScaledVector(away, distance);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      const places = points.map((point) => point.clone().project(camera));
      const along = places.map((place) => place[axis]);
      expect(Math.min(...along)).toBeCloseTo(-1, 9);
      expect(Math.max(...along)).toBeCloseTo(1, 9);
      for (const { x, y } of places) expect(Math.max(Math.abs(x), Math.abs(y))).toBeLessThan(1 + 1e-9);
    }
  });
});

describe("numbers", () => {
  it("have the digits that matter", () => {
    expect(format.number(500.00961)).toBe("500");
    expect(format.number(-0.000123456, 3)).toBe("−0.000123");
    expect(format.exactTime(0.36000013714)).toBe("0.3600001371 s");
    expect(format.time(0.2, 0.36)).toBe("0.20000");
    expect(format.time(12.3, 3600)).toBe("12.3");
  });

  it("measure grids in 1, 2 and 5", () => {
    expect([2.3, 18, 0.06, 0.9].map(format.roundSpacing)).toEqual([2, 20, 0.05, 1]);
  });
});

describe("a plot's range", () => {
  it("does not blow up the rounding of a constant", () => {
    const [low, high] = readableRange(5, 5 + 1e-14);
    expect(low).toBeCloseTo(4.5, 10);
    expect(high).toBeCloseTo(5.5, 10);
    expect(readableRange(0, 0)).toEqual([-1, 1]);
    expect(readableRange(null, null)).toEqual([-1, 1]);
    expect(readableRange(-2e-16, 4e-16, 1e-15)).toEqual([-1e-15, 1e-15]);
  });

  it("has ticks whose texts differ, however narrow it is", () => {
    for (const [low, high] of [[0, 1], [-3e-16, 9e-16], [500.0001, 500.0003], [2.1e7, 2.3e7], [-40, 1]]) {
      const ticks = ticksBetween(low, high);
      expect(ticks.length).toBeGreaterThanOrEqual(3);
      expect(ticks.length).toBeLessThanOrEqual(7);
      const texts = tickTexts(ticks);
      expect(new Set(texts).size).toBe(ticks.length);
      texts.forEach((text, i) => expect(Number(text.replaceAll("−", "-"))).toBeCloseTo(ticks[i], 9));
    }
    expect(tickTexts([0, 0.5, 1])).toEqual(["0", "0.5", "1.0"]);
    expect(tickTexts([-2e-16, 0, 2e-16])).toEqual(["−2e−16", "0", "2e−16"]);
  });
});

describe("texts", () => {
  it("stay in the picture above and below a point at its side", () => {
    const { above, below } = candidates(195, 50, 40, 12, 200);
    expect([above.right, below.right]).toEqual([200, 200]);
  });

  it("have four places around a point, none of them over it", () => {
    const point = { left: 100, right: 100, top: 50, bottom: 50 };
    for (const place of Object.values(candidates(100, 50, 40, 12, 200))) expect(overlap(place, point)).toBe(false);
  });
});
