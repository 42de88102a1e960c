import { element } from "./dom";
import * as format from "./format";
import { impactAngle, type Moment, momentText, speeds } from "./moments";

/** Rows beyond so many are not listed: the report has them all. */
const kMostRows = 300;

/** A table of the impacts and events; a click goes there. */
export class MomentList {
  readonly root: HTMLElement;
  private readonly rows: { time: number; row: HTMLElement }[] = [];
  private shownTime = NaN;

  constructor(moments: readonly Moment[], seek: (t: number) => void) {
    const hasImpacts = moments.some(({ impact }) => impact);
    const hasEvents = moments.some(({ event }) => event);
    const name = [hasImpacts && "Impacts", hasEvents && (hasImpacts ? "events" : "Events")].filter(Boolean).join(" and ");
    const table = element("tbody");
    for (const moment of moments.slice(0, kMostRows)) table.append(this.row(moment, hasImpacts, seek));
    const heading = hasImpacts
      ? ["time [s]", "body", "kind", hasEvents ? "with, event" : "with", "speed [m/s]", "angle [°]"]
      : ["time [s]", "event", "direction"];
    const head = element("tr", {}, ...heading.map((text) => element("th", { scope: "col" }, text)));
    if (hasImpacts) (head.lastChild as HTMLElement).title = "between the way in and the surface: 90° is head-on";
    this.root = element(
      "section",
      { class: "moments", "aria-label": name },
      element("h2", {}, `${name} (${moments.length})`),
      element("table", {}, element("thead", {}, head), table),
    );
    if (moments.length > kMostRows) this.root.append(element("p", {}, `… and ${moments.length - kMostRows} more`));
  }

  private row(moment: Moment, hasImpacts: boolean, seek: (t: number) => void): HTMLElement {
    const { time, kind, impact, event } = moment;
    const button = element(
      "button",
      { type: "button", "aria-label": `Go to ${momentText(moment)}` },
      format.number(time, 10),
    );
    button.addEventListener("click", () => seek(time));
    const angle = impact ? impactAngle(impact) : null;
    const cells = impact
      ? [impact.body, impact.kind, impact.with, speeds(impact), angle === null ? "" : format.number(angle, 3)]
      : hasImpacts
        ? ["", event!.direction, event!.event, "", ""]
        : [event!.event, event!.direction];
    const row = element("tr", { class: kind }, ...[button, ...cells].map((cell) => element("td", {}, cell)));
    this.rows.push({ time, row });
    return row;
  }

  /** Marks what happens at exactly that time. */
  setTime(t: number): void {
    if (t === this.shownTime) return;
    this.shownTime = t;
    for (const { time, row } of this.rows) row.classList.toggle("current", time === t);
  }
}
