import type { SceneError } from "./data";
import { element } from "./dom";

/** Lines of the scene shown before and behind the wrong one. */
const kContext = 4;

/** What is wrong with the scene, in its text, where it is. */
export function errorPage({ file, line, column, message, text }: SceneError): HTMLElement {
  const place = line > 0 ? `${file}:${line}:${column}` : file;
  const page = element(
    "main",
    { class: "error" },
    element("h1", {}, "The scene has an error"),
    element("p", { role: "alert" }, element("code", {}, place), " ", message),
  );
  if (line > 0) {
    const lines = text.split("\n");
    const first = Math.max(0, line - 1 - kContext);
    const listing = element("pre", { class: "listing" });
    for (let i = first; i < Math.min(lines.length, line + kContext); ++i) {
      const row = element("div", { class: i === line - 1 ? "row wrong" : "row" });
      row.append(element("span", { class: "line-number" }, String(i + 1).padStart(4)));
      if (i === line - 1) row.append(...markedLine(lines[i], column));
      else row.append(lines[i]);
      row.append("\n");
      listing.append(row);
    }
    page.append(listing);
  }
  return page;
}

/** The line with the character in that column marked. Columns count bytes of UTF-8. */
export function markedLine(line: string, column: number): Node[] {
  const bytes = new TextEncoder().encode(line);
  const before = new TextDecoder().decode(bytes.slice(0, Math.max(0, column - 1)));
  const [first = " ", ...others] = [...line.slice(before.length)];
  return [new Text(before), element("mark", {}, first), new Text(others.join(""))];
}
