import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { readableRange, textRoom, ticksBetween, tickTexts } from "./axis";
import { element } from "./dom";
import * as format from "./format";
import type { Run } from "./motion";
import { isZero, type Quantity, quantitiesOf } from "./quantities";
import { jumpsOf, samplingTimes } from "./sampling";
import { cssColor } from "./theme";
import type { Track } from "./track";

const kHeight = 150;
/** Against the times themselves: double precision tells no more. */
const kShortestRange = 1e-12;
/** Of the first run, and of those compared with it. */
const kDashes: (number[] | undefined)[] = [undefined, [7, 4], [2, 3], [10, 3, 2, 3], [4, 8]];
const dashOf = (run: number): number[] | undefined => (run === 0 ? undefined : kDashes[1 + ((run - 1) % 4)]);

/** Curves on a common time axis: evaluated in the range that is shown, so that zooming in shows more. */
function tabulate(quantity: Quantity, from: number, to: number, count: number): uPlot.AlignedData {
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

/** A stack of plots in step with the timeline. */
export class Plots {
  private plots: { quantity: Quantity; plot: uPlot }[] = [];
  private from: number;
  private to: number;
  private time: number;

  constructor(
    private readonly container: HTMLElement,
    private readonly runs: readonly Run[],
    private body: string | null,
    private readonly seek: (t: number) => void,
  ) {
    this.from = Math.min(...runs.map((run) => run.begin));
    this.to = Math.max(...runs.map((run) => run.end));
    this.time = this.from;
    this.build();
  }

  setBody(body: string | null): void {
    this.body = body;
    this.build();
  }

  applyTheme(): void {
    this.build();
  }

  resize(): void {
    const width = this.container.clientWidth;
    for (const { plot } of this.plots) if (width > 0 && plot.width !== width) plot.setSize({ width, height: kHeight });
  }

  setTime(t: number): void {
    this.time = t;
    for (const { plot } of this.plots) this.placeCursor(plot);
  }

  /** Shows this part of the time in every plot. */
  zoom(from: number, to: number): void {
    if (to - from < kShortestRange * Math.max(Math.abs(from), Math.abs(to))) return;
    this.from = from;
    this.to = to;
    for (const { quantity, plot } of this.plots) {
      plot.setData(tabulate(quantity, from, to, this.sampleCount()), false);
      plot.setScale("x", { min: from, max: to });
    }
    this.setTime(this.time);
  }

  private sampleCount(): number {
    return Math.max(200, 2 * this.container.clientWidth);
  }

  private placeCursor(plot: uPlot): void {
    const isInside = this.time >= this.from && this.time <= this.to;
    plot.over.querySelector<HTMLElement>(".now")!.style.transform = isInside
      ? `translateX(${plot.valToPos(this.time, "x")}px)`
      : "translateX(-10px)";
  }

  private build(): void {
    for (const { plot } of this.plots) plot.destroy();
    this.container.replaceChildren();
    this.plots = [];
    const wholeFrom = Math.min(...this.runs.map((run) => run.begin));
    const wholeTo = Math.max(...this.runs.map((run) => run.end));
    if (wholeFrom === wholeTo) {
      this.note("still", `The run has no duration: it ends where it begins, at ${format.exactTime(wholeTo)}. There is nothing to plot.`);
      return;
    }
    const quantities = quantitiesOf(this.runs, this.body);
    const zero = quantities.filter(({ curves }) => isZero(curves));
    for (const quantity of quantities) {
      if (zero.includes(quantity)) continue;
      const figure = document.createElement("figure");
      figure.append(caption(quantity));
      this.container.append(figure);
      const plot = new uPlot(
        this.options(quantity, wholeFrom, wholeTo),
        tabulate(quantity, this.from, this.to, this.sampleCount()),
        figure,
      );
      const now = document.createElement("div");
      now.className = "now";
      plot.over.append(now);
      plot.over.setAttribute("role", "img");
      plot.over.setAttribute("aria-label", `${quantity.title} against time`);
      this.plots.push({ quantity, plot });
      this.placeCursor(plot);
    }
    if (zero.length > 0) this.note("zero", `Zero throughout: ${zero.map(({ title }) => title).join(", ")}.`);
  }

  private note(className: string, text: string): void {
    this.container.append(element("p", { class: className }, text));
  }

  private options(quantity: Quantity, wholeFrom: number, wholeTo: number): uPlot.Options {
    const text = cssColor("--text-soft");
    const axis: uPlot.Axis = {
      stroke: text,
      font: "11px system-ui, sans-serif",
      grid: { stroke: cssColor("--grid-soft"), width: 1 },
      ticks: { stroke: cssColor("--grid-soft"), width: 1, size: 4 },
      size: 24,
      gap: 3,
      splits: (_plot, _axis, low, high) => ticksBetween(low, high),
    };
    return {
      width: this.container.clientWidth || 320,
      height: kHeight,
      legend: { show: false },
      padding: [6, 24, 0, 0],
      pxAlign: false,
      scales: {
        x: { time: false, min: this.from, max: this.to },
        y: { range: (_plot, low, high) => readableRange(low, high, quantity.least) },
      },
      axes: [
        {
          ...axis,
          values: (_plot, splits) => tickTexts(splits).map((text, i) => text + (i === splits.length - 1 ? " s" : "")),
        },
        { ...axis, size: (_plot, texts) => textRoom(texts ?? []), values: (_plot, splits) => tickTexts(splits) },
      ],
      series: [
        {},
        ...quantity.curves.map(({ label, color, run }) => ({
          label,
          stroke: color,
          width: run > 0 ? 1.25 : 1.75,
          dash: dashOf(run),
          points: { show: false },
          pxAlign: 0,
        })),
      ],
      cursor: {
        y: false,
        points: { show: false },
        drag: { x: true, y: false, setScale: false },
        bind: {
          dblclick: () => () => (this.zoom(wholeFrom, wholeTo), null),
        },
      },
      hooks: {
        ready: [
          (plot) =>
            plot.over.addEventListener("click", (event) => {
              const t = plot.posToVal(event.offsetX, "x");
              this.seek(Math.min(wholeTo, Math.max(wholeFrom, t)));
            }),
        ],
        setSelect: [
          (plot) => {
            if (plot.select.width < 4) return;
            const from = plot.posToVal(plot.select.left, "x");
            const to = plot.posToVal(plot.select.left + plot.select.width, "x");
            plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            this.zoom(from, to);
          },
        ],
      },
    };
  }
}

function caption(quantity: Quantity): HTMLElement {
  const element = document.createElement("figcaption");
  const title = document.createElement("span");
  title.textContent = quantity.unit ? `${quantity.title} [${quantity.unit}]` : quantity.title;
  if (quantity.color) title.style.setProperty("--mark", quantity.color);
  title.className = quantity.color ? "quantity marked" : "quantity";
  element.append(title);
  const key = (text: string, color: string, dash: number[] | undefined): void => {
    const line = `<svg viewBox="0 0 24 4" aria-hidden="true"><path d="M0 2H24" stroke="${color}" stroke-dasharray="${dash ?? ""}"/></svg>`;
    const item = document.createElement("span");
    item.className = "curve";
    item.innerHTML = line;
    item.append(text);
    element.append(item);
  };
  // colours tell the components, dashes the runs; a single quantity has the colours of the runs
  for (const { label, color } of quantity.curves.filter(({ run, label }) => run === 0 && label))
    key(label, color, undefined);
  const runs = new Map(quantity.curves.map((curve) => [curve.run, curve]));
  if (runs.size > 1)
    for (const [run, { method, label, color }] of runs)
      key(method, label ? cssColor("--text-soft") : color, dashOf(run));
  return element;
}
