import type { Vector } from "./data";
import type { BodyMotion } from "./motion";
import type { Track } from "./track";
import { length } from "./vectors";

const distance = (a: Vector, b: Vector): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Points on a body's way, in the order of time. */
export interface Trail {
  times: number[];
  points: Vector[];
}

/** More straight lines for one piece tell the eye nothing. */
const kMostLinesOfPiece = 256;
/** Fewer for the whole run are so long that a camera near the body stands between their ends, and draws them badly. */
const kFewestLines = 256;

/**
 * The way of a body's centre, or of its point at `p` in its own frame, as straight lines, passed at constant speed each,
 * that stay within about twice `tolerance` (m) of it at all times.
 *
 * A chord over the time h leaves a curve of acceleration a by a h^2 / 8 at most. Pieces that are short beside the
 * tolerance are passed over; of the many points of a motion in short steps only those are kept that a line would miss.
 */
export function trailOf(body: BodyMotion, tolerance: number, p?: Vector): Trail {
  const { track } = body;
  const place = (t: number, piece: number): Vector =>
    p ? body.pointPosition(p, t, piece) : body.position(t, piece);
  const trail: Trail = { times: [track.begin], points: [place(track.begin, 0)] };
  const add = (t: number, piece: number, isForced: boolean): void => {
    const point = place(t, piece);
    if (!isForced && distance(point, trail.points[trail.points.length - 1]) < tolerance) return;
    trail.times.push(t);
    trail.points.push(point);
  };
  if (track.end === track.begin) {
    add(track.end, 0, true);
    return trail;
  }
  const around = p ? length(p) : 0;
  const second = (t: number, piece: number): number => {
    const centre = length(track.vector(piece, body.data.position, t, 2));
    return around > 0 ? centre + around * length(body.angularVelocity(t, piece)) ** 2 : centre;
  };
  for (let piece = 0; piece < track.count; ++piece) {
    const begin = track.pieceBegin(piece);
    const duration = track.pieceEnd(piece) - begin;
    const bend = Math.max(...[0, 0.25, 0.5, 0.75, 1].map((part) => second(begin + part * duration, piece)));
    const wanted = duration * Math.max(Math.sqrt(bend / (8 * tolerance)), kFewestLines / (track.end - track.begin));
    const lines = Math.min(kMostLinesOfPiece, Math.max(1, Math.ceil(wanted)));
    const turns = piece + 1 === track.count || jumps(track, piece, body.data.velocity, 3);
    for (let i = 1; i <= lines; ++i) add(begin + (duration * i) / lines, piece, i === lines && turns);
  }
  return thinned(trail, tolerance);
}

/** By the algorithm of Douglas and Peucker, with the distance between points of the same time. */
function thinned({ times, points }: Trail, tolerance: number): Trail {
  const isKept = new Uint8Array(times.length);
  isKept[0] = isKept[times.length - 1] = 1;
  const open: [number, number][] = [[0, times.length - 1]];
  for (let range = open.pop(); range; range = open.pop()) {
    const [first, last] = range;
    const [a, b] = [points[first], points[last]];
    const duration = times[last] - times[first];
    let farthest = first;
    let largest = tolerance;
    for (let i = first + 1; i < last; ++i) {
      const part = duration > 0 ? (times[i] - times[first]) / duration : 0;
      const [x, y, z] = points[i];
      const off = Math.hypot(
        x - a[0] - part * (b[0] - a[0]),
        y - a[1] - part * (b[1] - a[1]),
        z - a[2] - part * (b[2] - a[2]),
      );
      if (off > largest) [farthest, largest] = [i, off];
    }
    if (farthest === first && (last - first < 2 || kFewestLines * duration < times[times.length - 1] - times[0]))
      continue;
    if (farthest === first) farthest = (first + last) >> 1;
    isKept[farthest] = 1;
    open.push([first, farthest], [farthest, last]);
  }
  return { times: times.filter((_, i) => isKept[i]), points: points.filter((_, i) => isKept[i]) };
}

/** Whether one of `count` components from `first` on jumps from a piece to the next, by more than rounding. */
export function jumps(track: Track, piece: number, first: number, count: number): boolean {
  if (piece + 1 >= track.count) return false;
  const t = track.pieceEnd(piece);
  for (let i = first; i < first + count; ++i) {
    const before = track.value(piece, i, t);
    const after = track.value(piece + 1, i, t);
    if (Math.abs(after - before) > 1e-6 * (Math.abs(before) + Math.abs(after)) + 1e-9) return true;
  }
  return false;
}

/** The pieces behind which some component of a track jumps: impacts and events that set something. */
export function jumpsOf(track: Track): number[] {
  const pieces: number[] = [];
  for (let piece = 0; piece + 1 < track.count; ++piece) if (jumps(track, piece, 0, track.dimension)) pieces.push(piece);
  return pieces;
}

/** Beyond so many jumps in one picture they are not drawn one by one. */
const kMostJumps = 400;

/**
 * The times at which to evaluate a curve between `from` and `to`, with the piece to take: `count` equal steps, and both
 * sides of every jump, so that it shows as the vertical line that it is.
 */
export function samplingTimes(
  track: Track,
  jumpPieces: readonly number[],
  from: number,
  to: number,
  count: number,
): { t: number; piece: number }[] {
  const begin = Math.max(from, track.begin);
  const end = Math.min(to, track.end);
  if (!(end > begin)) return [];
  const samples: { t: number; piece: number }[] = [];
  const visible = jumpPieces.filter((piece) => track.pieceEnd(piece) > begin && track.pieceEnd(piece) < end);
  const drawn = visible.length > kMostJumps ? [] : visible;
  let next = 0;
  for (let i = 0; i <= count; ++i) {
    const t = i === count ? end : begin + ((end - begin) * i) / count;
    for (; next < drawn.length && track.pieceEnd(drawn[next]) <= t; ++next)
      samples.push(
        { t: track.pieceEnd(drawn[next]), piece: drawn[next] },
        { t: track.pieceEnd(drawn[next]), piece: drawn[next] + 1 },
      );
    samples.push({ t, piece: track.pieceAt(t) });
  }
  return samples;
}
