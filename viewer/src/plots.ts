import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { readableRange, textRoom, ticksBetween, tickTexts } from "./axis";
import { element } from "./dom";
import * as format from "./format";
import { isZero, type Quantity } from "./curves";
import type { Run } from "./motion";
import { dashOf, PlotCaption, widthOf } from "./plot_caption";
import { drawMoments } from "./plot_moments";
import { quantitiesOf } from "./quantities";
import { tabulate } from "./tabulate";
import { cssColor } from "./theme";

const kHeight = 150;
/** Against the times themselves: double precision tells no more. */
const kShortestRange = 1e-12;

interface Plot {
  quantity: Quantity;
  caption: PlotCaption;
  plot: uPlot;
}

/**
 * A stack of plots in step with the timeline. `hover` is told the time that the pointer rests on, and null when it leaves.
 */
export class Plots {
  private plots: Plot[] = [];
  private from: number;
  private to: number;
  private time: number;

  constructor(
    private readonly container: HTMLElement,
    private readonly runs: readonly Run[],
    private body: string | null,
    private readonly seek: (t: number) => void,
    private readonly hover: (t: number | null) => void,
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
    for (const { plot, caption } of this.plots) {
      this.placeLine(plot);
      caption.setTime(t);
    }
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
  }

  private sampleCount(): number {
    return Math.max(200, 2 * this.container.clientWidth);
  }

  /** The line at the time that is shown; none where that is outside. */
  private placeLine(plot: uPlot): void {
    const line = plot.over.querySelector<HTMLElement>(".now");
    if (!line) return;
    const { min, max } = plot.scales.x;
    line.hidden = !(this.time >= min! && this.time <= max!);
    if (!line.hidden) line.style.transform = `translateX(${plot.valToPos(this.time, "x")}px)`;
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
    const noise = quantities.filter((each) => !zero.includes(each) && isZero(each.curves, each.least));
    for (const quantity of quantities) {
      if (zero.includes(quantity) || noise.includes(quantity)) continue;
      const figure = document.createElement("figure");
      const caption = new PlotCaption(quantity);
      figure.append(caption.root);
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
      this.plots.push({ quantity, caption, plot });
    }
    const list = (some: Quantity[]): string => some.map(({ title }) => title).join(", ");
    if (zero.length > 0) this.note("zero", `Zero throughout: ${list(zero)}.`);
    if (noise.length > 0) this.note("zero", `Zero but for rounding: ${list(noise)}.`);
    this.setTime(this.time);
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
        ...quantity.curves.map(({ label, color }, i) => ({
          label,
          stroke: color,
          width: widthOf(quantity, i),
          dash: dashOf(quantity, i),
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
        drawAxes: [(plot) => drawMoments(plot, this.runs[0].moments)],
        // a change of scale or size is carried out later than it is asked for
        draw: [(plot) => this.placeLine(plot)],
        setCursor: [
          (plot) => {
            const { left } = plot.cursor;
            const isInside = left !== undefined && left !== null && left >= 0 && plot.over.matches(":hover");
            this.hover(isInside ? Math.min(wholeTo, Math.max(wholeFrom, plot.posToVal(left, "x"))) : null);
          },
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
