import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { Actor } from "../src/actor";
import { largestPolarAngle } from "../src/camera_rig";
import { comfortableSpeed } from "../src/clock";
import { isZero, type Quantity } from "../src/curves";
import type { BodyData, Impact, Report, RotationData, RunData } from "../src/data";
import { action, countUntil, ending, impactAngle, momentsOf, speeds } from "../src/moments";
import { BodyMotion, namedRuns } from "../src/motion";
import { dashOf, widthOf } from "../src/plot_caption";
import { drawMoments } from "../src/plot_moments";
import { quantitiesOf } from "../src/quantities";
import { trailOf } from "../src/sampling";
import { heightScale } from "../src/scales";
import { Scenery } from "../src/scenery";
import { lightOver, projection, shadowedGround, Shadows } from "../src/shadows";
import { bodyGeometry } from "../src/shapes";
import { Track } from "../src/track";
import { Tail, trailLine, WholeTrail } from "../src/trail_line";
import { isSeenAlongRight, kAxes, ViewFrame } from "../src/view_frame";
import { constant, piece } from "./pieces";

const rotation: RotationData = {
  kind: "quaternion", component: 6, angular_velocity: 10, frame: "world", free: true, inertia: null,
}; // prettier-ignore

const body = (more: Partial<BodyData> = {}): BodyData => ({
  name: "ball", shape: { kind: "point" }, mass: null, group: 0, position: 0, velocity: 3, points: [], field: null,
  attitude: [1, 0, 0, 0], ...more,
}); // prettier-ignore

/** A body that turns about z once in a second, for so many seconds, in pieces of a hundredth of a second. */
function turning(seconds: number, more: Partial<BodyData> = {}): BodyMotion {
  const w = 2 * Math.PI;
  const h = 0.01;
  const pieces = Array.from({ length: Math.round(seconds / h) }, (_, i) => {
    const [c, s] = [Math.cos((w * i * h) / 2), Math.sin((w * i * h) / 2)];
    const half = w / 2;
    // cos and sin of half the angle, by their series
    const cos = [c, -s * half, (-c * half ** 2) / 2, (s * half ** 3) / 6];
    const sin = [s, c * half, (-s * half ** 2) / 2, (-c * half ** 3) / 6];
    return piece(i * h, (i + 1) * h, i * h, [0], [0], [0], [0], [0], [0], cos, [0], [0], sin, [0], [0], [w]);
  });
  return new BodyMotion(body({ rotation, ...more }), new Track(Float64Array.from(pieces.flat()), 13));
}

/** The numbers as the page has them. */
const encoded = (numbers: number[]): string => Buffer.from(Float64Array.from(numbers).buffer).toString("base64");

const report = (more: Partial<Report> = {}): Report => ({
  title: "", scene: "", method: "rk4", status: "finished", start_time: 0, end_time: 1, parameters: {}, impacts: [],
  events: [], warnings: [], statistics: {}, final: [], states: {}, ...more,
}); // prettier-ignore

const impact = (time: number, more: Partial<Impact> = {}): Impact => ({
  time, body: "ball", with: "floor", kind: "hit", point: [0, 0, 0], normal: [0, 0, 1], velocity_before: [3, 0, -4],
  velocity_after: [3, 0, 2], ...more,
}); // prettier-ignore

describe("what happens in a run", () => {
  const events = [{ time: 0.5, event: "apex", direction: "falling" }];
  const both = report({ impacts: [impact(0.2), impact(1)], events });

  it("is impacts and events in the order of time", () => {
    expect(momentsOf(both).map(({ time, kind }) => [time, kind])).toEqual([
      [0.2, "impact"],
      [0.5, "event"],
      [1, "impact"],
    ]);
    expect([0, 0.2, 0.7, 3].map((t) => countUntil(momentsOf(both), t))).toEqual([0, 1, 2, 3]);
  });

  it("is told: who, whom, how fast, at which angle", () => {
    expect(action(impact(0, { kind: "rest" }))).toBe("ball rests on floor");
    expect(action(impact(0, { kind: "slide" }))).toBe("ball slides on floor");
    expect(action(impact(0, { kind: "roll" }))).toBe("ball rolls on floor");
    expect(speeds(impact(0))).toBe("5 → 3.606");
    expect(impactAngle(impact(0))).toBeCloseTo(53.13, 2);
    expect(impactAngle(impact(0, { velocity_before: [0, 0, 0] }))).toBeNull();
  });

  it("is what has stopped the run, where it stopped", () => {
    expect(ending({ ...both, status: "finished" })).toBe("finished");
    expect(ending({ ...both, status: "stopped" })).toBe("stopped: ball hits floor");
    expect(ending({ ...both, status: "stopped", end_time: 0.5 })).toBe("stopped: event apex");
  });

  it("is marked in the plots, in few lines or in many marks at the edge", () => {
    const linesOf = (count: number): { x: number; height: number; color: string }[] => {
      const lines: { x: number; height: number; color: string }[] = [];
      let [x, y] = [0, 0];
      const ctx = {
        save: () => 0, restore: () => 0, setLineDash: () => 0, beginPath: () => 0, stroke: () => 0,
        moveTo: (toX: number, toY: number) => ([x, y] = [toX, toY]),
        lineTo: (_x: number, toY: number) => lines.push({ x, height: toY - y, color: ctx.strokeStyle }),
        strokeStyle: "", lineWidth: 0, globalAlpha: 0,
      }; // prettier-ignore
      const bbox = { left: 50, top: 0, width: 300, height: 100 };
      const plot = { bbox, ctx, valToPos: (t: number) => 50 + 300 * t };
      const impacts = Array.from({ length: count }, (_, i) => impact((i + 0.5) / count));
      drawMoments(plot as unknown as Parameters<typeof drawMoments>[0], momentsOf(report({ impacts, events })));
      return lines;
    };
    (globalThis as { devicePixelRatio?: number }).devicePixelRatio = 1;
    const few = linesOf(2);
    expect(few.map(({ x, height }) => [x, height])).toEqual([[125, 100], [200, 100], [275, 100]]); // prettier-ignore
    expect(few[1].color).not.toBe(few[0].color);
    const many = linesOf(20000);
    expect(many.length).toBeLessThan(310);
    for (const { height } of many) expect(height).toBeLessThan(10);
  });
});

describe("a trail of a named point", () => {
  it("follows the point around the centre", () => {
    const { points, times } = trailOf(turning(1), 1e-3, [2, 0, 0]);
    expect(points.length).toBeGreaterThan(40);
    points.forEach(([x, y], i) => {
      expect(x).toBeCloseTo(2 * Math.cos(2 * Math.PI * times[i]), 4);
      expect(y).toBeCloseTo(2 * Math.sin(2 * Math.PI * times[i]), 4);
    });
  });

  it("is a tail where the whole would be a ball of yarn", () => {
    const lineOf = (seconds: number): WholeTrail | Tail => {
      const { times, points } = trailOf(turning(seconds), 1e-2, [1, 0, 0]);
      return trailLine({ times, points: points.map((each) => new THREE.Vector3(...each)) }, "#ff0000", 2);
    };
    expect(lineOf(3)).toBeInstanceOf(WholeTrail);
    const tail = lineOf(60);
    expect(tail).toBeInstanceOf(Tail);
    tail.update(30, new THREE.Vector3(1, 0, 0));
    const { geometry } = tail.group.children[0] as THREE.Mesh<THREE.InstancedBufferGeometry>;
    const { array } = (geometry.getAttribute("instanceStart") as THREE.InterleavedBufferAttribute).data;
    const count = geometry.instanceCount;
    // it ends at the point, and goes round once or so
    expect([...array.slice(6 * count - 3, 6 * count)]).toEqual([1, 0, 0]);
    let length = 0;
    for (let i = 0; i < count; ++i)
      length += Math.hypot(...[0, 1, 2].map((k) => array[6 * i + 3 + k] - array[6 * i + k]));
    expect(length).toBeGreaterThan(Math.PI);
    expect(length).toBeLessThan(4 * Math.PI);
  });

  it("is left by every point of a body that turns, but its centre", () => {
    const points = [
      { name: "tip", position: [0, 0, 0] as [number, number, number] },
      { name: "rim", position: [1, 0, 0] as [number, number, number] },
    ];
    const frame = new ViewFrame(new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1)));
    const look = { color: "#0072b2", hasPointColors: true, isOneOfMany: false };
    const still = new BodyMotion(body({ points }), new Track(Float64Array.from(constant(Array(13).fill(0))), 13));
    const trailsOf = (motion: BodyMotion): number => new Actor(motion, frame, look).group.children.length;
    expect(trailsOf(turning(1, { points })) - trailsOf(still)).toBe(1);
  });
});

describe("a ball", () => {
  it("has a pattern, whether it turns or not", () => {
    for (const color of ["#0072b2", "#ffffff"])
      for (const turns of [true, false]) {
        const colors = bodyGeometry({ kind: "sphere", radius: 1 }, color, turns)!.getAttribute("color");
        const shades = new Set(Array.from({ length: colors.count }, (_, i) => colors.getX(i).toFixed(3)));
        expect(shades.size).toBe(2);
      }
  });
});

describe("a shadow", () => {
  const frame = new ViewFrame(new THREE.Box3(new THREE.Vector3(-5, -5, 0), new THREE.Vector3(5, 5, 4)));
  const ground = { point: new THREE.Vector3(), normal: new THREE.Vector3(0, 0, 1), isSolid: true };

  it("lies on the plane, along the light", () => {
    const n = new THREE.Vector3(0.1, -0.2, 1).normalize();
    const light = new THREE.Vector3(0.2, 0.3, -1).normalize();
    const matrix = projection(n, 0.7, light);
    for (const p of [new THREE.Vector3(1, 2, 3), new THREE.Vector3(-4, 0, 9)]) {
      const cast = p.clone().applyMatrix4(matrix);
      expect(cast.dot(n)).toBeCloseTo(0.7, 12);
      expect(cast.clone().sub(p).cross(light).length()).toBeCloseTo(0, 12);
    }
  });

  it("of something high is not far away, and steep planes have none", () => {
    for (const squares of [1, 10, 1000]) {
      const { x, y, z } = lightOver(squares);
      expect((squares * Math.hypot(x, y)) / -z).toBeLessThan(0.7);
    }
    expect(shadowedGround([{ ...ground, normal: new THREE.Vector3(1, 0, 0) }])).toBeNull();
  });

  it("is cast by bodies over the ground and by obstacles, not by what is beneath", () => {
    const at = (z: number): Actor => {
      const track = new Track(Float64Array.from(constant([1, 2, z, 0, 0, 0])), 6);
      const ball = body({ shape: { kind: "sphere", radius: 0.5 } });
      const look = { color: "#0072b2", hasPointColors: true, isOneOfMany: false };
      const actor = new Actor(new BodyMotion(ball, track), frame, look);
      const shown = { trails: true, velocity: true, acceleration: true, axes: true };
      actor.update(0, shown, () => 0.01, 500);
      return actor;
    };
    const box = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1));
    const shadows = new Shadows(frame, 1, ground, [box], [at(2), at(-1)]);
    shadows.update();
    const meshes = shadows.group.children.filter((each) => each instanceof THREE.Mesh && each.visible) as THREE.Mesh[];
    expect(meshes.length).toBe(2);
    const level = frame.toView([0, 0, 0]).z;
    for (const mesh of meshes) {
      mesh.geometry.computeBoundingBox();
      const area = new THREE.Box3();
      const position = mesh.geometry.getAttribute("position");
      for (let i = 0; i < position.count; ++i)
        area.expandByPoint(new THREE.Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrix));
      expect(area.max.z).toBeCloseTo(level, 2);
      expect(area.min.z).toBeCloseTo(level, 2);
      expect(area.max.x - area.min.x).toBeGreaterThan(0.9);
    }
  });
});

describe("curves", () => {
  const run = (state: number[][]): RunData => ({
    report: report(), up: "z", orientation: "quaternion", bodies: [body({ rotation })], states: [], obstacles: [],
    groups: [{ dimension: 13, pieces: encoded(piece(0, 1, 0, ...state)) }],
  }); // prettier-ignore
  // along x and y alike, z is rounding; a unit quaternion but for 3.5e-15
  const state = [[0, 2], [0, 2], [1e-16], [2], [2], [1e-17], [1 + 3.5e-15], [0], [0], [0], [0], [0], [1]];
  const quantities = quantitiesOf(namedRuns([run(state)]), "ball");
  const named = (title: string): Quantity => quantities.find((each) => each.title === title)!;

  it("of rounding are none", () => {
    const defect = named("|q| − 1");
    expect(isZero(defect.curves)).toBe(false);
    expect(isZero(defect.curves, defect.least)).toBe(true);
    const growing = run(state.map((each, i) => (i === 6 ? [1, 1e-9] : each)));
    const drifting = quantitiesOf(namedRuns([growing]), "ball").find((each) => each.title === "|q| − 1")!;
    expect(isZero(drifting.curves, drifting.least)).toBe(false);
  });

  it("of components that are zero throughout do not hide others, and are told", () => {
    expect(named("position").curves.map(({ label }) => label)).toEqual(["x", "y"]);
    expect(named("position").zero).toEqual(["z"]);
    expect(named("acceleration").zero).toEqual(["x", "y", "z"]);
  });

  it("that coincide are both seen", () => {
    const position = named("position");
    expect(dashOf(position, 0)).toBeUndefined();
    expect(dashOf(position, 1)).toBeDefined();
    // of several runs the dashes tell the runs, and what lies beneath is wider
    const two = quantitiesOf(namedRuns([run(state), run(state)]), "ball")[0];
    expect(two.curves.map((_, i) => dashOf(two, i) !== undefined)).toEqual([false, true, false, true]);
    expect(widthOf(two, 0)).toBeGreaterThan(widthOf(two, 2));
  });
});

describe("the speed of play", () => {
  it("lets the eye follow the fastest spin, unless that takes minutes", () => {
    const rev = 2 * Math.PI;
    expect(comfortableSpeed(3, 40 * rev)).toBe(0.05);
    expect(comfortableSpeed(20, 2 * rev)).toBe(1);
    for (const spin of [3, 10, 77, 150]) expect(comfortableSpeed(3, spin * rev) * spin).toBeLessThanOrEqual(2.2);
    expect(3 / comfortableSpeed(3, 1e6 * rev)).toBeLessThan(1000);
  });
});

describe("the camera", () => {
  it("is over the ground at its largest angle, and under it beyond", () => {
    for (const n of [new THREE.Vector3(0, 0, 1), new THREE.Vector3(0.3, -0.2, 1).normalize()])
      for (const angle of [0, 1, 2.5, 4]) {
        const outward = new THREE.Vector3(Math.cos(angle), Math.sin(angle), 0);
        const target = new THREE.Vector3(1, 2, 1);
        const overAt = (polar: number): number => {
          const up = new THREE.Vector3(0, 0, 20 * Math.cos(polar));
          return target.clone().addScaledVector(outward, 20 * Math.sin(polar)).add(up).dot(n) + 1.5;
        };
        const most = largestPolarAngle(target, 20, outward, n, -1.5, 0.2);
        expect(overAt(most)).toBeCloseTo(0.2, 9);
        expect(overAt(most + 0.01)).toBeLessThan(0.2);
        expect(overAt(most - 0.01)).toBeGreaterThan(0.2);
      }
    // far over the ground there is no limit
    const [x, z] = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 0, 1)];
    expect(largestPolarAngle(new THREE.Vector3(0, 0, 50), 20, x, z, 0, 0)).toBe(Math.PI);
  });
});

describe("the edges of obstacles", () => {
  it("are those of solids, and the rim of a ground: the facets of its slopes are none", () => {
    const frame = new ViewFrame(new THREE.Box3(new THREE.Vector3(0, 0, 0), new THREE.Vector3(2, 1, 1)));
    const edges = (height: number, closed: boolean) => {
      const vertices: [number, number, number][] = [[0, 0, 0], [1, 0, height], [2, 0, 0], [0, 1, 0], [1, 1, height], [2, 1, 0]];
      const triangles: [number, number, number][] = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
      const { solids } = new Scenery(frame, [{ name: "roof", shape: { kind: "mesh", vertices, triangles, closed } }]);
      return (solids[0].children[0] as THREE.LineSegments).geometry.getAttribute("position").count / 2;
    };
    const [gentle, steep] = [0.3, 2]; // facets that meet at 33 and at 127 degrees
    const rim = 6;
    expect(edges(gentle, false)).toBe(rim);
    expect(edges(gentle, true)).toBe(rim + 1);
    expect(edges(steep, false)).toBe(rim + 1);
  });
});

describe("a scene whose y axis points up", () => {
  // a shot along x
  const box = new THREE.Box3(new THREE.Vector3(-1, 0, -2), new THREE.Vector3(9, 4, 2));
  const frame = new ViewFrame(box, kAxes.y);
  const y = new THREE.Vector3(0, 1, 0);

  it("has its grid beneath, with the names of its level axes, and a scale of its heights", () => {
    const [{ point, normal }] = new Scenery(frame, []).grounds;
    expect(normal.toArray()).toEqual([0, 1, 0]);
    expect(point.y).toBe(0);
    const texts = new Scenery(frame, []).labels.map(({ text }) => text);
    for (const name of ["x = ", "z = "]) expect(texts.some((text) => text.startsWith(name))).toBe(true);
    expect(texts).toContain("y [m]");
    const grid = { spacing: 1, u0: 0, u1: 1, v0: 0, v1: 1, at: () => new THREE.Vector3(), names: null };
    const scale = heightScale(grid, true, 0, 4, 1, kAxes.y);
    expect(scale?.top.toArray()).toEqual([0, 4, 0]);
  });

  it("is seen from the side, along z, so that x goes from left to right", () => {
    expect(isSeenAlongRight(frame)).toBe(true);
    expect(kAxes.y.right.toArray()).toEqual([0, 0, 1]);
    const { right, away, up } = kAxes.y;
    expect(right.clone().cross(away).dot(up)).toBe(1);
  });

  it("has light from above, and the camera over its ground", () => {
    expect(lightOver(1, kAxes.y).dot(y)).toBeLessThan(-0.9);
    expect(shadowedGround([{ point: new THREE.Vector3(), normal: y, isSolid: true }], kAxes.y)).not.toBeNull();
    const [z] = [new THREE.Vector3(0, 0, 1)];
    const most = largestPolarAngle(new THREE.Vector3(0, 1, 0), 20, z, y, 0, 0, y);
    expect(20 * Math.cos(most) + 1).toBeCloseTo(0, 9);
  });
});
