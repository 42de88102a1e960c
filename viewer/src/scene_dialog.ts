import type { Report } from "./data";
import { element } from "./dom";
import * as format from "./format";
import { ending } from "./moments";
import type { Run } from "./motion";

/** The digits of a double that matter to a reader who compares. */
const kDigits = 10;

const heading = (text: string): HTMLElement => element("h3", {}, text);

const listOf = (rows: [string, string][]): HTMLElement =>
  element("dl", {}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));

const statisticsOf = ({ statistics }: Report): [string, string][] =>
  Object.entries(statistics ?? {}).map(([name, value]) => [name.replaceAll("_", " "), format.number(value, kDigits)]);

/** What a run was made from: the parameters' values, method and statistics of each run, and the scene's text. */
export function sceneDialog(runs: readonly Run[], text: string): HTMLDialogElement {
  const [{ data }] = runs;
  const { report } = data;
  const parameters = Object.entries(report.parameters ?? {});
  const parts: HTMLElement[] = [element("h2", {}, report.scene || report.title || "Scene")];
  if (parameters.length > 0)
    parts.push(
      heading("Parameters, in SI units"),
      listOf(parameters.map(([name, value]) => [name, format.number(value, kDigits)])),
    );
  for (const run of runs)
    parts.push(
      heading(`Run: ${run.name}`),
      listOf([
        ["method", run.data.report.method],
        ["end", `${ending(run.data.report)} at ${format.exactTime(run.data.report.end_time)}`],
        ...statisticsOf(run.data.report),
      ]),
    );
  if (text) parts.push(heading("Text"), element("pre", { class: "scene-text", tabindex: "0" }, text));
  return element(
    "dialog",
    { class: "scene", "aria-label": "Scene" },
    ...parts,
    element("form", { method: "dialog" }, element("button", {}, "Close")),
  );
}
