import * as THREE from "three";
import { number, roundSpacing } from "./format";
import type { LabelSpec, Side } from "./labels";
import { type Axes, kAxes } from "./view_frame";

/** A level grid of squares in the world: lines number u0 to u1 across `right`, and v0 to v1 across `away`. */
export interface Grid {
  /** m; the side of a square. */
  spacing: number;
  u0: number;
  u1: number;
  v0: number;
  v1: number;
  /** From line numbers to the drawing. */
  at: (u: number, v: number) => THREE.Vector3;
  /** The axes along which u and v count, where they are the world's. */
  names: [string, string] | null;
}

/** Numbers beside the last one in the order of steps from zero: every second line, zero among them. */
const evenNumbers = (first: number, last: number): number[] => {
  const numbers: number[] = [];
  for (let i = first + (first & 1); i <= last; i += 2) numbers.push(i);
  return numbers;
};

/** The last number of an axis has the axis' name and the unit, and is not left out before the others. */
function textOf(value: number, isLast: boolean, name: string | null): string {
  if (!isLast) return number(value, 6);
  return `${name ? `${name} = ` : ""}${number(value, 6)} m`;
}

/** The numbers along two sides of a grid: in front of the picture and on its right. */
export function gridLabels({ spacing, u0, u1, v0, v1, at, names }: Grid, isAlongRight: boolean): LabelSpec[] {
  const label = (place: THREE.Vector3, i: number, isLast: boolean, name: string | null, side: Side): LabelSpec => ({
    at: place,
    text: textOf(i * spacing, isLast, name),
    className: "label-scale",
    priority: isLast ? 1.5 : 0,
    side,
  });
  const [us, vs] = [evenNumbers(u0, u1), evenNumbers(v0, v1)];
  return [
    ...us.map((i) =>
      label(at(i, isAlongRight ? v1 : v0), i, i === us.at(-1), names?.[0] ?? null, isAlongRight ? "right" : "below"),
    ),
    ...vs.map((j) => label(at(u1, j), j, j === vs.at(-1), names?.[1] ?? null, isAlongRight ? "below" : "right")),
  ];
}

/** A scale of height, which stands on the far left corner of a grid. */
export interface HeightScale {
  /** Pairs of ends of lines, in the drawing. */
  lines: THREE.Vector3[];
  labels: LabelSpec[];
  top: THREE.Vector3;
}

/** Heights with numbers on a scale, about. */
const kNumbers = 4;

/**
 * From the height of the grid, which is `bottom` in the world, to `top` (m); null where that is so little beside a square
 * that it is flat. `toView`: from metres to the drawing, along one axis.
 */
export function heightScale(
  grid: Grid,
  isAlongRight: boolean,
  bottom: number,
  top: number,
  toView: number,
  { right, away, up, names }: Axes = kAxes.z,
): HeightScale | null {
  const { spacing } = grid;
  if (top - bottom < 0.5 * spacing) return null;
  const foot = isAlongRight ? grid.at(grid.u0, grid.v0) : grid.at(grid.u0, grid.v1);
  const step = roundSpacing((top - bottom) / kNumbers);
  const first = Math.ceil(bottom / step - 1e-6);
  const last = Math.floor(top / step + 1e-6);
  const at = (height: number): THREE.Vector3 => foot.clone().addScaledVector(up, (height - bottom) * toView);
  const tick = (isAlongRight ? away : right).clone().multiplyScalar(-0.2 * spacing * toView);
  const lines = [at(bottom), at(top)];
  const labels: LabelSpec[] = [
    { at: at(top), text: `${names[2]} [m]`, className: "label-scale", priority: 1.5, side: "above" },
  ];
  for (let i = first; i <= last; ++i) {
    const place = at(i * step);
    lines.push(place, place.clone().add(tick));
    labels.push({ at: place, text: number(i * step, 6), className: "label-scale", priority: 0, side: "left" });
  }
  return { lines, labels, top: at(top) };
}
