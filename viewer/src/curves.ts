import type { BodyMotion } from "./motion";
import type { Track } from "./track";
import { length } from "./vectors";

export interface Curve {
  label: string;
  color: string;
  /** Index and name of the run. */
  run: number;
  method: string;
  track: Track;
  value: (t: number, piece: number) => number;
}

/** A plot against time: what it is called, in which unit, and its curves. */
export interface Quantity {
  title: string;
  unit: string;
  color?: string;
  /** What is smaller than this throughout is rounding, and not worth a plot. */
  least?: number;
  curves: Curve[];
  /** Of the components: the labels of those that are zero throughout, and so have no curve. */
  zero?: string[];
}

/** One body in one of the runs. */
export interface Own {
  body: BodyMotion;
  run: number;
  method: string;
}
export type Value = (body: BodyMotion, t: number, piece: number) => number;

export const curvesOf = (own: readonly Own[], label: string, color: (run: number) => string, of: Value): Curve[] =>
  own.map(({ body, run, method }) => ({
    label,
    color: color(run),
    run,
    method,
    track: body.track,
    value: (t, piece) => of(body, t, piece),
  }));

/** Places in a piece: a polynomial that is 0 at all of them is 0 at all times if its degree is 3. */
const kPlaces = [0.07, 0.36, 0.65, 0.94];

/** Whether curves are 0, or not larger than `least`, at four times of every piece of their runs. */
export function isZero(curves: readonly Curve[], least = 0): boolean {
  return curves.every(({ track, value }) => {
    for (let piece = 0; piece < track.count; ++piece) {
      const [begin, end] = [track.pieceBegin(piece), track.pieceEnd(piece)];
      // what is no number is not small either
      if (kPlaces.some((place) => !(Math.abs(value(begin + place * (end - begin), piece)) <= least))) return false;
    }
    return true;
  });
}

/** Errors of rounding, added up over a run, beside what they are errors of. */
const kRounding = 1e-13;
/** Pieces of a track beyond so many are not all looked at for the size of its values. */
const kMostPieces = 300;

/** What is rounding only in the motion of a body: in m, m/s, m/s^2, and rad/s. */
export interface Rounding {
  position: number;
  velocity: number;
  acceleration: number;
  angularVelocity: number;
}

/**
 * Rounding beside the largest values of a body in any run; of a velocity also beside what goes once along its places in
 * the time of the run, and of an acceleration likewise.
 */
export function roundingOf(own: readonly Own[]): Rounding {
  const most: Rounding = { position: 0, velocity: 0, acceleration: 0, angularVelocity: 0 };
  const keys = Object.keys(most) as (keyof Rounding)[];
  let duration = 0;
  for (const { body } of own) {
    const { track } = body;
    duration = Math.max(duration, track.end - track.begin);
    const stride = Math.max(1, Math.ceil(track.count / kMostPieces));
    for (let piece = 0; piece < track.count; piece += stride)
      for (const t of [track.pieceBegin(piece), (track.pieceBegin(piece) + track.pieceEnd(piece)) / 2])
        for (const key of keys) {
          const size = length(body[key](t, piece));
          if (size > most[key] && Number.isFinite(size)) most[key] = size;
        }
  }
  const rate = duration > 0 ? 1 / duration : 0;
  const velocity = Math.max(most.velocity, most.position * rate);
  const acceleration = Math.max(most.acceleration, velocity * rate);
  const angularVelocity = Math.max(most.angularVelocity, rate);
  return {
    position: kRounding * most.position,
    velocity: kRounding * velocity,
    acceleration: kRounding * acceleration,
    angularVelocity: kRounding * angularVelocity,
  };
}
