import { describe, expect, it } from "vitest";
import type { BodyData, FinalState, RotationData, RunData } from "../src/data";
import { BodyMotion, namedRuns, product, quaternionOfMatrix, quaternionOfRotationVector, rotated } from "../src/motion";
import { trailOf } from "../src/sampling";
import { Track } from "../src/track";
import { constant, piece } from "./pieces";

const body = (more: Partial<BodyData> = {}): BodyData => ({
  name: "ball",
  shape: { kind: "point" },
  mass: null,
  group: 0,
  position: 0,
  velocity: 3,
  points: [],
  field: null,
  attitude: [1, 0, 0, 0],
  ...more,
});

const rotation = (more: Partial<RotationData>): RotationData => ({
  kind: "quaternion",
  component: 6,
  angular_velocity: 10,
  frame: "world",
  free: true,
  inertia: null,
  ...more,
});

// r = (3 t, 0, 4 t - 5 t^2), v = (3, 0, 4 - 10 t)
const flight = new Track(Float64Array.from(piece(0, 1, 0, [0, 3], [0], [0, 4, -5], [3], [0], [4, -10])), 6);

describe("a body", () => {
  it("has the quantities of its path", () => {
    const motion = new BodyMotion(body({ mass: 2 }), flight);
    expect(motion.position(0.5)).toEqual([1.5, 0, 0.75]);
    expect(motion.velocity(0.5)).toEqual([3, 0, -1]);
    expect(motion.acceleration(0.5)).toEqual([0, 0, -10]);
    expect(motion.translationEnergy(0.5)).toBe(10);
  });

  it("has an energy in a constant field, and keeps the sum", () => {
    const motion = new BodyMotion(body({ mass: 2, field: [0, 0, -10] }), flight);
    expect(motion.potentialEnergy(0.5)).toBe(15);
    for (const t of [0, 0.3, 0.9]) expect(motion.translationEnergy(t) + motion.potentialEnergy(t)).toBeCloseTo(25, 12);
  });

  it("leaves a trail that is as near to its path as asked", () => {
    const trail = trailOf(new BodyMotion(body(), flight), 1e-3);
    for (let i = 1; i < trail.times.length; ++i) {
      const h = trail.times[i] - trail.times[i - 1];
      // the chord of a parabola: a h^2 / 8
      expect((10 * h * h) / 8).toBeLessThanOrEqual(1e-3);
    }
    expect(trail.times.at(-1)).toBe(1);
  });

  it("leaves no more lines than needed when it was computed in short steps", () => {
    // ten times around a circle of radius 1 at 1 rad/s, in straight steps of 1 ms
    const steps = Array.from({ length: 62832 }, (_, i) => {
      const [t, h] = [1e-3 * i, 1e-3];
      const [c, s] = [Math.cos(t), Math.sin(t)];
      return piece(t, t + h, t, [c, -s], [s, c], [0], [-s], [c], [0]);
    });
    const tolerance = 5e-4;
    const { times, points } = trailOf(new BodyMotion(body(), new Track(Float64Array.from(steps.flat()), 6)), tolerance);
    // a chord may leave the circle by twice the tolerance: 2 sqrt(8 * tolerance) rad each
    expect(times.length).toBeGreaterThan(62.8 / Math.sqrt(8 * 2 * tolerance));
    expect(times.length).toBeLessThan((2 * 62.8) / Math.sqrt(8 * tolerance));
    for (let i = 1; i < times.length; ++i) {
      const middle = (times[i - 1] + times[i]) / 2;
      const chord = [0, 1].map((axis) => (points[i - 1][axis] + points[i][axis]) / 2);
      expect(Math.hypot(chord[0] - Math.cos(middle), chord[1] - Math.sin(middle))).toBeLessThan(2 * tolerance);
    }
  });
});

describe("an orientation", () => {
  const turned = (q: number[]): number[] => {
    const [w, x, y, z] = q;
    return [
      1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
    ]; // prettier-ignore
  };

  it("is read off a matrix, whichever component of the quaternion is largest", () => {
    const tests = [
      [0.9, 0.1, -0.3, 0.2],
      [0.1, 0.9, 0.3, -0.2],
      [-0.1, 0.2, 0.9, 0.3],
      [0.2, -0.3, 0.1, 0.9],
    ];
    for (const test of tests) {
      const norm = Math.hypot(...test);
      const q = test.map((each) => each / norm);
      const found = quaternionOfMatrix(turned(q).map((each) => 1.3 * each));
      const sign = Math.sign(found.reduce((sum, each, i) => sum + each * q[i], 0));
      found.forEach((each, i) => expect(sign * each).toBeCloseTo(q[i], 14));
    }
  });

  it("is shown normalised, and its defect is told", () => {
    const track = new Track(Float64Array.from(constant([0, 0, 0, 0, 0, 0, 1.2, 0, 0, 1.6, 0, 0, 5])), 13);
    const motion = new BodyMotion(body({ rotation: rotation({ kind: "quaternion" }) }), track);
    motion.orientation(0.5).forEach((each, i) => expect(each).toBeCloseTo([0.6, 0, 0, 0.8][i], 15));
    expect(motion.orientationDefect(0.5)).toBeCloseTo(1, 15);
    expect(motion.angularVelocity(0.5)).toEqual([0, 0, 5]);
    // a quarter turn and more about z, and |q|^2 = 4 times as large
    const c = 4 * (0.36 - 0.64);
    const s = 4 * 2 * 0.6 * 0.8;
    motion.carriedMatrix(0.5).forEach((each, i) => expect(each).toBeCloseTo([c, -s, 0, s, c, 0, 0, 0, 4][i], 13));
  });

  it("is put together from a quaternion and a rotation vector, on the side of its frame", () => {
    const start = quaternionOfRotationVector([0.3, 0, 0]);
    const added = quaternionOfRotationVector([0, 0.2, 0]);
    const state = [0, 0, 0, 0, 0, 0, ...start, 0, 0.2, 0, 1, 2, 3];
    const track = new Track(Float64Array.from(constant(state)), state.length);
    for (const frame of ["world", "body"] as const) {
      const motion = new BodyMotion(
        body({ rotation: rotation({ kind: "rotation-vector", frame, angular_velocity: 13 }) }),
        track,
      );
      const expected = frame === "world" ? product(added, start) : product(start, added);
      motion.orientation(0.5).forEach((each, i) => expect(each).toBeCloseTo(expected[i], 15));
      const w = frame === "world" ? [1, 2, 3] : rotated(expected, [1, 2, 3]);
      motion.angularVelocity(0.5).forEach((each, i) => expect(each).toBeCloseTo(w[i], 14));
    }
  });

  it("has the energy of rotation about any axis of its inertia", () => {
    const state = [0, 0, 0, 0, 0, 0, ...quaternionOfRotationVector([0, 0, Math.PI / 2]), 2, 0, 0];
    const track = new Track(Float64Array.from(constant(state)), state.length);
    const inertia: RotationData["inertia"] = [[1, 0, 0], [0, 7, 0], [0, 0, 3]]; // prettier-ignore
    // the world's x axis is the body's -y axis: 7 * 2^2 / 2
    const motion = new BodyMotion(body({ mass: 1, rotation: rotation({ kind: "quaternion", inertia }) }), track);
    expect(motion.rotationEnergy(0.5)).toBeCloseTo(14, 14);
  });
});

describe("a run of no duration", () => {
  const state = { body: "ball", position: [1, 2, 3], velocity: [4, 5, 6], acceleration: [0, null, -9.8] };
  const half = Math.SQRT1_2;
  const data = (kind: RotationData["kind"], frame: RotationData["frame"], angular_velocity: number): RunData => ({
    report: {
      title: "", scene: "", method: "rk4", status: "failed", start_time: 2, end_time: 2, parameters: {}, impacts: [], events: [], warnings: [], statistics: {},
      // a quarter of a turn about z
      final: [{ ...state, orientation: [half, 0, 0, half], rotation_matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]], angular_velocity: [7, 0, 0] } as FinalState],
      states: { m: 8 },
    },
    up: "z",
    orientation: kind,
    bodies: [body({ rotation: rotation({ kind, frame, angular_velocity }) })],
    states: [{ name: "m", group: 0, component: angular_velocity + 3 }],
    obstacles: [],
    groups: [{ dimension: angular_velocity + 4, pieces: "" }],
  }); // prettier-ignore

  it("shows its bodies as they start", () => {
    for (const [kind, place] of [["quaternion", 10], ["matrix", 15], ["rotation-vector", 13]] as const)
      for (const frame of ["world", "body"] as const) {
        const [run] = namedRuns([data(kind, frame, place)]);
        const ball = run.body("ball")!;
        expect(ball.position(2)).toEqual([1, 2, 3]);
        expect(ball.velocity(2)).toEqual([4, 5, 6]);
        expect(ball.acceleration(2)).toEqual([0, 0, -9.8]);
        ball.orientation(2).forEach((each, i) => expect(each).toBeCloseTo([half, 0, 0, half][i], 12));
        ball.angularVelocity(2).forEach((each, i) => expect(each).toBeCloseTo([7, 0, 0][i], 12));
        expect(run.states[0].value(2)).toBe(8);
        expect(trailOf(ball, 1e-3).points).toEqual([[1, 2, 3], [1, 2, 3]]); // prettier-ignore
      }
  });
});

describe("runs", () => {
  const run = (method: string, orientation: string | null): RunData => ({
    report: { title: "", scene: "", method, status: "finished", start_time: 0, end_time: 1, parameters: {}, impacts: [], events: [], final: [], states: {}, warnings: [], statistics: {} },
    up: "z",
    orientation,
    bodies: [],
    states: [],
    obstacles: [],
    groups: [],
  }); // prettier-ignore
  const names = (...data: RunData[]): string[] => namedRuns(data).map(({ name }) => name);

  it("are named after what they differ in", () => {
    expect(names(run("euler", "exact"))).toEqual(["euler"]);
    expect(names(run("taylor", null), run("euler", null))).toEqual(["taylor", "euler"]);
    expect(names(run("euler", "exact"), run("euler", "matrix"))).toEqual(["exact", "matrix"]);
    expect(names(run("rk4", "exact"), run("euler", "exact"), run("rk4", "matrix"))).toEqual([
      "rk4, exact",
      "euler, exact",
      "rk4, matrix",
    ]);
  });
});
