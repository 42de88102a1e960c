import { element } from "./dom";

const kKeys: [string, string][] = [
  ["Space", "play or pause"],
  ["N, P", "next, previous impact or event"],
  ["← →", "a thousandth of the run; with Shift a hundredth"],
  ["Home, End", "begin, end"],
  ["+, −", "faster, slower"],
  ["F", "follow the next body, or see the whole scene"],
  ["T, V, A, B, I", "trail, velocity, acceleration, body axes, impacts"],
  ["G, S", "other runs, side by side"],
  ["E", "the scene: parameters, method, text"],
  ["D", "light or dark"],
];

const kPointer =
  "Drag the picture to turn it, scroll to zoom; rest on a body or an impact to read what it is, click to choose it. " +
  "Rest on a plot to see that time, click to go there, drag to zoom, double-click to see all.";

export function helpDialog(): HTMLDialogElement {
  const list = element("dl");
  for (const [keys, meaning] of kKeys) list.append(element("dt", {}, keys), element("dd", {}, meaning));
  return element(
    "dialog",
    { "aria-label": "Keys" },
    element("h2", {}, "Keys"),
    list,
    element("p", {}, kPointer),
    element("form", { method: "dialog" }, element("button", {}, "Close")),
  );
}
