import type uPlot from "uplot";
import type { Quantity } from "./curves";
import { jumpsOf, samplingTimes } from "./sampling";
import type { Track } from "./track";

/** Curves on a common time axis: evaluated in the range that is shown, so that zooming in shows more. */
export function tabulate(quantity: Quantity, from: number, to: number, count: number): uPlot.AlignedData {
  const tables = quantity.curves.map((curve) => {
    const samples = samplingTimes(curve.track, jumpsOfTrack(curve.track), from, to, count);
    const times = samples.map(({ t }) => t);
    const values = samples.map(({ t, piece }) => {
      const value = curve.value(t, piece);
      return Number.isFinite(value) ? value : null;
    });
    return [times, values] as [number[], (number | null)[]];
  });
  const isShared = quantity.curves.every((curve) => curve.track === quantity.curves[0].track);
  if (isShared) return [tables[0][0], ...tables.map(([, values]) => values)];
  return joinByTime(tables);
}

/** Tables of different times as one; where a table has no row it has a gap that lines go over. */
function joinByTime(tables: [number[], (number | null)[]][]): uPlot.AlignedData {
  const rows = tables
    .flatMap(([times, values], column) => times.map((t, i) => ({ t, column, i, value: values[i] })))
    .sort((a, b) => a.t - b.t || a.column - b.column || a.i - b.i);
  const columns = tables.map(() => new Array<number | null | undefined>(rows.length).fill(undefined));
  rows.forEach(({ column, value }, row) => (columns[column][row] = value));
  return [rows.map(({ t }) => t), ...columns] as uPlot.AlignedData;
}

const jumpCache = new WeakMap<Track, number[]>();
function jumpsOfTrack(track: Track): number[] {
  let pieces = jumpCache.get(track);
  if (!pieces) jumpCache.set(track, (pieces = jumpsOf(track)));
  return pieces;
}
