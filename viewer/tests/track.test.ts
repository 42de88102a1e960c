import { describe, expect, it } from "vitest";
import { isZero } from "../src/curves";
import { jumpsOf, samplingTimes } from "../src/sampling";
import { Track } from "../src/track";
import { piece } from "./pieces";

const numbers = (...pieces: number[][]): Float64Array => Float64Array.from(pieces.flat());

// q = (x, v): a fall x = 1 - 2 t^2 until t = 0.5, then upward with v = 1 from x = 0.5.
const bounce = new Track(numbers(piece(0, 0.5, 0, [1, 0, -2], [0, -4]), piece(0.5, 2, 0.5, [0.5, 1], [1])), 2);

describe("a track", () => {
  it("evaluates polynomials about each piece's own origin", () => {
    expect(bounce.value(0, 0, 0.25)).toBe(1 - 2 * 0.25 ** 2);
    expect(bounce.value(1, 0, 1.5)).toBe(1.5);
    expect(bounce.value(0, 0, 0.25, 1)).toBe(-1);
    expect(bounce.value(0, 0, 0.25, 2)).toBe(-4);
    expect(bounce.value(1, 0, 1.5, 2)).toBe(0);
  });

  it("gives a joint to the piece behind it, the end to the last one, and what lies outside to the nearest", () => {
    expect([-1, 0, 0.4999, 0.5, 1, 2, 9].map((t) => bounce.pieceAt(t))).toEqual([0, 0, 0, 1, 1, 1, 1]);
  });

  it("keeps the components apart, more than six and of different degrees", () => {
    const components = Array.from({ length: 13 }, (_, i) =>
      Array.from({ length: 1 + ((5 * i) % 31) }, (_, k) => i + k / 32),
    );
    const track = new Track(numbers(piece(0, 1, 0, ...components), piece(1, 2, 1, ...[...components].reverse())), 13);
    components.forEach((coefficients, i) => {
      const sum = coefficients.reduceRight((value, each) => value * 0.5 + each, 0);
      expect(track.value(0, i, 0.5)).toBe(sum);
      expect(track.value(1, 12 - i, 1.5)).toBe(sum);
    });
  });

  it("turns a run backward in time around", () => {
    // x = t on [1, 2] and then on [0, 1], as the run came through it
    const backward = new Track(numbers(piece(2, 1, 2, [2, 1]), piece(1, 0, 1, [1, 1])), 1);
    expect([backward.begin, backward.end]).toEqual([0, 2]);
    for (const t of [0, 0.5, 1, 1.5, 2]) expect(backward.value(backward.pieceAt(t), 0, t)).toBe(t);
  });
});

describe("a quantity", () => {
  it("is zero only if no piece of its run says otherwise, however short", () => {
    const curve = (track: Track) => [
      { label: "", color: "", run: 0, method: "", track, value: (t: number, piece: number) => track.value(piece, 0, t) },
    ];
    const pulse = [piece(0, 5.02, 0, [0]), piece(5.02, 5.03, 5.02, [100]), piece(5.03, 10, 5.03, [0])];
    expect(isZero(curve(new Track(numbers(...pulse), 1)))).toBe(false);
    expect(isZero(curve(new Track(numbers(pulse[0], pulse[2]), 1)))).toBe(true);
  });
});

describe("sampling", () => {
  it("finds the jump of the velocity, on both sides", () => {
    expect(jumpsOf(bounce)).toEqual([0]);
    const samples = samplingTimes(bounce, [0], 0, 2, 10);
    const atJump = samples.filter(({ t }) => t === 0.5).map(({ piece }) => bounce.value(piece, 1, 0.5));
    expect(atJump).toEqual([-2, 1]);
    for (let i = 1; i < samples.length; ++i) expect(samples[i].t).toBeGreaterThanOrEqual(samples[i - 1].t);
  });

  it("evaluates only what is shown", () => {
    const samples = samplingTimes(bounce, [0], 1, 1.5, 100);
    expect(samples).toHaveLength(101);
    expect(samples[0].t).toBe(1);
    expect(samples[100].t).toBe(1.5);
    expect(samplingTimes(bounce, [0], 3, 4, 100)).toEqual([]);
  });
});
