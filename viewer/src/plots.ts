import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { type BodyMotion, length, type Run } from "./motion";
import { jumpsOf, samplingTimes } from "./sampling";
import { cssColor, kComponentColors, kPalette, kQuantityColors } from "./theme";
import type { Track } from "./track";

interface Curve {
  label: string;
  color: string;
  /** Index and name of the run. */
  run: number;
  method: string;
  track: Track;
  value: (t: number, piece: number) => number;
}

/** A plot against time: what it is called, in which unit, and its curves. */
interface Quantity {
  title: string;
  unit: string;
  color?: string;
  curves: Curve[];
}

const kHeight = 150;
/** Of the first run, and of those compared with it. */
const kDashes: (number[] | undefined)[] = [undefined, [7, 4], [2, 3], [10, 3, 2, 3], [4, 8]];
const dashOf = (run: number): number[] | undefined => (run === 0 ? undefined : kDashes[1 + ((run - 1) % 4)]);

/** What there is to plot of a body, of the first run whole and of the others dashed. */
export function quantitiesOf(runs: readonly Run[], bodyName: string | null): Quantity[] {
  const quantities: Quantity[] = [];
  const own = runs.flatMap((run, index) => {
    const body = bodyName === null ? undefined : run.body(bodyName);
    return body ? [{ body, run: index, method: run.name }] : [];
  });
  const components = (title: string, unit: string, color: string | undefined, of: (b: BodyMotion, t: number, p: number) => number[]) =>
    quantities.push({
      title,
      unit,
      color,
      curves: own.flatMap(({ body, run, method }) =>
        ["x", "y", "z"].map((axis, i) => ({
          label: axis,
          color: kComponentColors[i],
          run,
          method,
          track: body.track,
          value: (t: number, piece: number) => of(body, t, piece)[i],
        })),
      ),
    });
  const scalars = (title: string, unit: string, of: (b: BodyMotion, t: number, p: number) => number) =>
    quantities.push({
      title,
      unit,
      curves: own.map(({ body, run, method }) => ({
        label: "",
        color: kPalette[5],
        run,
        method,
        track: body.track,
        value: (t: number, piece: number) => of(body, t, piece),
      })),
    });
  if (own.length > 0) {
    const first = own[0].body;
    components("position", "m", kQuantityColors.position, (b, t, p) => b.position(t, p));
    components("velocity", "m/s", kQuantityColors.velocity, (b, t, p) => b.velocity(t, p));
    components("acceleration", "m/s²", kQuantityColors.acceleration, (b, t, p) => b.acceleration(t, p));
    scalars("speed", "m/s", (b, t, p) => length(b.velocity(t, p)));
    scalars("kinetic energy", first.data.mass === null ? "J/kg" : "J", (b, t, p) => b.kineticEnergy(t, p));
    if (first.data.rotation) {
      components("angular velocity", "rad/s", undefined, (b, t, p) => b.angularVelocity(t, p));
      if (first.data.rotation.inertia) scalars("rotation energy", "J", (b, t, p) => b.rotationEnergy(t, p));
      const defect = first.data.rotation.kind === "matrix" ? "det R − 1" : "|q| − 1";
      scalars(defect, "", (b, t, p) => b.orientationDefect(t, p));
    }
  }
  const stateNames = [...new Set(runs.flatMap((run) => run.states.map((state) => state.name)))];
  stateNames.forEach((name, i) =>
    quantities.push({
      title: name,
      unit: "",
      curves: runs.flatMap((run, index) =>
        run.states
          .filter((state) => state.name === name)
          .map((state) => ({
            label: "",
            color: kPalette[i % kPalette.length],
            run: index,
            method: run.name,
            track: state.track,
            value: (t: number, piece: number) => state.value(t, piece),
          })),
      ),
    }),
  );
  return quantities;
}

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
    for (const { plot } of this.plots)
      if (width > 0 && plot.width !== width) plot.setSize({ width, height: kHeight });
  }

  setTime(t: number): void {
    this.time = t;
    for (const { plot } of this.plots) this.placeCursor(plot);
  }

  /** Shows this part of the time in every plot. */
  zoom(from: number, to: number): void {
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
    for (const quantity of quantitiesOf(this.runs, this.body)) {
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
    };
    return {
      width: this.container.clientWidth || 320,
      height: kHeight,
      legend: { show: false },
      padding: [6, 24, 0, 0],
      pxAlign: false,
      scales: { x: { time: false, min: this.from, max: this.to }, y: { range: readableRange } },
      axes: [
        { ...axis, values: (_plot, splits) => splits.map((t, i) => tick(t) + (i === splits.length - 1 ? " s" : "")) },
        { ...axis, size: 56, values: (_plot, splits) => splits.map(tick) },
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

/** A constant is a line in the middle, not noise of rounding blown up. */
export function readableRange(_plot: unknown, low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (size === 0) return [-1, 1];
  if (high - low <= 1e-12 * size) return [low - 0.1 * size, high + 0.1 * size];
  const margin = 0.06 * (high - low);
  return [low - margin, high + margin];
}

const tick = (value: number): string => {
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-4 || size >= 1e6) ? value.toExponential(1) : String(Number(value.toPrecision(6)));
  return text.replace("-", "−");
};

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
  // colours tell the components, dashes the methods
  for (const { label, color } of quantity.curves.filter(({ run, label }) => run === 0 && label)) key(label, color, undefined);
  const methods = new Map(quantity.curves.map(({ run, method }) => [run, method]));
  if (methods.size > 1) for (const [run, method] of methods) key(method, cssColor("--text-soft"), dashOf(run));
  return element;
}
