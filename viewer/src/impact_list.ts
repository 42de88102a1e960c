import type { Impact } from "./data";
import { element } from "./dom";
import * as format from "./format";
import { length } from "./motion";

/** Rows beyond so many are not listed: the report has them all. */
const kMostRows = 300;

/** A table of the impacts; a click goes there. */
export class ImpactList {
  readonly root: HTMLElement;
  private readonly rows: { impact: Impact; row: HTMLElement }[] = [];
  private current: Impact | null = null;

  constructor(impacts: readonly Impact[], seek: (t: number) => void) {
    const bodies = new Set(impacts.map((impact) => impact.body));
    const heading = ["time [s]", ...(bodies.size > 1 ? ["body"] : []), "with", "kind", "speed before, after [m/s]"];
    const table = element("tbody");
    for (const impact of impacts.slice(0, kMostRows)) {
      const time = element("button", { type: "button", "aria-label": `Go to ${format.impact(impact)}` }, format.number(impact.time, 10));
      time.addEventListener("click", () => seek(impact.time));
      const speeds = `${format.number(length(impact.velocity_before))} → ${format.number(length(impact.velocity_after))}`;
      const cells = [time, ...(bodies.size > 1 ? [impact.body] : []), impact.with, impact.kind, speeds];
      const row = element("tr", {}, ...cells.map((cell) => element("td", {}, cell)));
      table.append(row);
      this.rows.push({ impact, row });
    }
    const head = element("tr", {}, ...heading.map((text) => element("th", { scope: "col" }, text)));
    this.root = element("section", { class: "impacts", "aria-label": "Impacts" }, element("table", {}, element("thead", {}, head), table));
    if (impacts.length > kMostRows) this.root.append(element("p", {}, `… and ${impacts.length - kMostRows} more`));
  }

  /** Marks the impact of exactly that time, and returns it. */
  setTime(t: number): Impact | null {
    if (this.current?.time === t) return this.current;
    this.current = null;
    for (const { impact, row } of this.rows) {
      const isCurrent = impact.time === t && this.current === null;
      if (isCurrent) this.current = impact;
      row.classList.toggle("current", isCurrent);
    }
    return this.current;
  }
}
