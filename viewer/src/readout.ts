import { element } from "./dom";
import { energyAt } from "./energy";
import * as format from "./format";
import type { BodyMotion } from "./motion";
import { length } from "./vectors";

const kRadiansPerTurn = 2 * Math.PI;

/** What a body does at the time that is shown, in numbers. */
export class Readout {
  readonly root: HTMLElement;
  private readonly rows = element("tbody");
  private readonly cells: HTMLElement[] = [];

  constructor(private body: BodyMotion) {
    const heading = ["", "x", "y", "z", "size", ""].map((text) => element("th", { scope: "col" }, text));
    this.root = element(
      "section",
      { class: "readout", "aria-label": "Values at this time" },
      element("table", {}, element("thead", {}, element("tr", {}, ...heading)), this.rows),
    );
    this.setBody(body);
  }

  setBody(body: BodyMotion): void {
    this.body = body;
    this.cells.length = 0;
    this.rows.replaceChildren();
    const row = (name: string, title: string, unit: string, count: number): void => {
      const cells = Array.from({ length: 4 }, () => element("td"));
      this.cells.push(...cells.slice(4 - count));
      const head = element("th", { scope: "row", title }, name);
      this.rows.append(element("tr", {}, head, ...cells, element("td", { class: "unit" }, unit)));
    };
    row("r", "position", "m", 4);
    row("v", "velocity", "m/s", 4);
    row("a", "acceleration", "m/s²", 4);
    if (body.turns) {
      row("ω", "angular velocity", "rad/s", 4);
      row("spin", "turns in a second", "rev/s", 1);
    }
    for (const { name, title, unit } of energyAt(body, body.track.begin)) row(name, title, unit, 1);
  }

  setTime(time: number): void {
    const { body } = this;
    const t = Math.min(body.track.end, Math.max(body.track.begin, time));
    const vectors = [body.position(t), body.velocity(t), body.acceleration(t)];
    if (body.turns) vectors.push(body.angularVelocity(t));
    const values = vectors.flatMap((each) => [...each, length(each)]);
    if (body.turns) values.push(length(body.angularVelocity(t)) / kRadiansPerTurn);
    values.push(...energyAt(body, t).map(({ value }) => value));
    this.cells.forEach((cell, i) => (cell.textContent = format.number(values[i])));
  }
}
