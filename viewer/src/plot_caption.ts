import type { Curve, Quantity } from "./curves";
import { element } from "./dom";
import * as format from "./format";
import { cssColor } from "./theme";

/** Of lines that may lie over each other: the first is whole, and is seen through the gaps of the next. */
const kDashes: (number[] | undefined)[] = [undefined, [7, 4], [2, 3], [10, 3, 2, 3], [4, 8]];

/** Of curve number `index`: dashes tell the runs, or, in a single run, the curves of one plot. */
export function dashOf({ curves }: Quantity, index: number): number[] | undefined {
  const hasRuns = curves.some(({ run }) => run > 0);
  const order = hasRuns ? curves[index].run : index;
  return order === 0 ? undefined : kDashes[1 + ((order - 1) % 4)];
}

/** px; where dashes tell the runs, curves of the first one that lie under others are wider. */
export function widthOf({ curves }: Quantity, index: number): number {
  const { run } = curves[index];
  if (run > 0) return 1.25;
  if (!curves.some((each) => each.run > 0)) return 1.75;
  const above = curves.slice(index + 1).filter((each) => each.run === 0).length;
  return 1.75 + 0.9 * above;
}

/** What a plot shows, the key to its curves, and their values at one time. */
export class PlotCaption {
  readonly root: HTMLElement = element("figcaption");
  private readonly values: { curve: Curve; output: HTMLElement }[] = [];

  constructor(quantity: Quantity) {
    const { title, unit, color, curves, zero = [] } = quantity;
    const name = element("span", { class: color ? "quantity marked" : "quantity" }, unit ? `${title} [${unit}]` : title);
    if (color) name.style.setProperty("--mark", color);
    this.root.append(name);
    // colours tell the components, dashes the runs; a single quantity has the colours of the runs
    const hasRuns = curves.some(({ run }) => run > 0);
    curves.forEach((curve, i) => {
      if (curve.run > 0) return;
      if (curve.label) this.root.append(this.key(curve.label, curve.color, dashOf(quantity, i), curve));
      else if (!hasRuns) this.root.append(this.output(curve));
    });
    if (zero.length > 0 && zero.length < 3) this.root.append(element("span", { class: "curve" }, `${zero.join(" = ")} = 0`));
    if (!hasRuns) return;
    const runs = new Map(curves.map((curve, i) => [curve.run, { curve, i }]));
    for (const { curve, i } of runs.values()) {
      const isScalar = !curve.label;
      const color = isScalar ? curve.color : cssColor("--text-soft");
      this.root.append(this.key(curve.method, color, dashOf(quantity, i), isScalar ? curve : null));
    }
  }

  /** A line as in the plot, its name, and the value of `curve`. */
  private key(text: string, color: string, dash: number[] | undefined, curve: Curve | null): HTMLElement {
    const item = element("span", { class: "curve" });
    const line = `<path d="M0 2H18" stroke="${color}" stroke-dasharray="${dash ?? ""}"/>`;
    item.innerHTML = `<svg viewBox="0 0 18 4" aria-hidden="true">${line}</svg>`;
    item.append(element("span", { class: "name" }, text));
    if (curve) item.append(this.output(curve));
    return item;
  }

  private output(curve: Curve): HTMLElement {
    const output = element("span", { class: "value" });
    this.values.push({ curve, output });
    return output;
  }

  /** Shows the values at time t; of a run that has not come so far, none. */
  setTime(t: number): void {
    for (const { curve, output } of this.values) {
      const { track, value } = curve;
      const isInside = t >= track.begin && t <= track.end;
      output.textContent = isInside ? format.number(value(t, track.pieceAt(t))) : "–";
    }
  }
}
