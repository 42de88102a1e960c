import type uPlot from "uplot";
import type { Moment } from "./moments";
import { kMomentColors } from "./theme";

/** More lines than this would hide the curves: then there are marks at the lower edge only. */
const kMostLines = 40;
/** px of the page: the height of such a mark. */
const kMarkHeight = 5;

/** Marks impacts and events in a plot, beneath its curves. */
export function drawMoments(plot: uPlot, moments: readonly Moment[]): void {
  const { left, top, width, height } = plot.bbox;
  const { ctx } = plot;
  const pixel = devicePixelRatio;
  const places = new Map<string, { x: number; kind: Moment["kind"] }>();
  for (const { time, kind } of moments) {
    const x = plot.valToPos(time, "x", true);
    if (x >= left && x <= left + width) places.set(`${kind} ${Math.round(x / pixel)}`, { x, kind });
  }
  const isFull = places.size > kMostLines;
  ctx.save();
  ctx.lineWidth = pixel;
  for (const { x, kind } of places.values()) {
    ctx.strokeStyle = kMomentColors[kind];
    ctx.globalAlpha = isFull ? 0.7 : 0.45;
    ctx.setLineDash(isFull ? [] : [3 * pixel, 3 * pixel]);
    ctx.beginPath();
    ctx.moveTo(x, isFull ? top + height - kMarkHeight * pixel : top);
    ctx.lineTo(x, top + height);
    ctx.stroke();
  }
  ctx.restore();
}
