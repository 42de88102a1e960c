import { Clock } from "./clock";
import type { Report, RunData, Vector } from "./data";
import { checkbox, element, iconButton, kIcons } from "./dom";
import { helpDialog } from "./help";
import { MomentList } from "./moment_list";
import { countUntil, ending, momentText } from "./moments";
import { namedRuns, type Run } from "./motion";
import { Plots } from "./plots";
import { Readout } from "./readout";
import { sceneDialog } from "./scene_dialog";
import { Stage } from "./stage";
import { applyTheme, colorOf, rememberTheme, type Theme } from "./theme";
import { Timeline } from "./timeline";

/** What the scene calls itself, or else the name of its file. */
const titleOf = ({ title, scene }: Report): string => title || scene.split("/").pop() || "trajet";

/** The page: a picture in space, plots, a timeline, and what keeps them in step. */
export class App {
  readonly runs: Run[];
  readonly clock: Clock;
  private readonly timeline: Timeline;
  private readonly plots: Plots;
  private readonly momentList: MomentList;
  private readonly readout: Readout | null = null;
  private readonly moment = element("p", { class: "moment", "aria-hidden": "true", hidden: true });
  private readonly choice = element("select", { "aria-label": "Body" });
  private stage: Stage | null = null;
  private readonly help = helpDialog();
  private readonly sceneDialog: HTMLDialogElement;
  /** s; where the pointer rests on a plot while nothing plays: shown instead of the clock's time. */
  private preview: number | null = null;
  private isStale = true;
  private lastFrame = 0;

  /** `time`: what to show first, s; by default the beginning. `sceneText`: as its author wrote it. */
  constructor(root: HTMLElement, data: readonly RunData[], time?: number, sceneText = "") {
    this.runs = namedRuns(data);
    const [first] = this.runs;
    const { report } = first.data;
    document.title = titleOf(report);
    this.clock = new Clock(
      Math.min(...this.runs.map((run) => run.begin)),
      Math.max(...this.runs.map((run) => run.end)),
      Math.max(...this.runs.map((run) => run.fastestSpin)),
    );
    const changed = (): void => {
      this.preview = null;
      this.isStale = true;
    };
    this.timeline = new Timeline(this.clock, first.moments, changed);
    this.momentList = new MomentList(first.moments, (t) => this.seek(t));
    this.sceneDialog = sceneDialog(this.runs, sceneText);

    const view = element("div", { class: "stage" });
    const plots = element("div", { class: "plots" });
    const side = element("aside", { class: "side", "aria-label": "Values, plots, impacts and events" });
    const body = element("main", { class: "body" });
    const column = element("div", { class: "picture" }, view);
    if (first.bodies.length > 0) body.append(column);
    else body.classList.add("plots-only");
    body.append(side);
    root.append(this.header(), ...this.messages(), body, this.timeline.root, this.help, this.sceneDialog);
    if (first.bodies.length > 0) {
      view.append(this.moment);
      this.stage = this.makeStage(column, view);
      this.readout = new Readout(first.bodies[0]);
      const head = element("div", { class: "side-head" }, ...this.bodyChoice(), this.readout.root);
      side.append(head);
    }
    side.append(plots);
    if (first.moments.length > 0) side.append(this.momentList.root);
    this.plots = new Plots(
      plots,
      this.runs,
      first.bodies[0]?.name ?? null,
      (t) => this.seek(t),
      (t) => this.showPreview(t),
    );

    const sizes = new ResizeObserver(() => {
      this.stage?.resize();
      this.plots.resize();
      this.isStale = true;
    });
    for (const each of [body, view]) sizes.observe(each);
    if (time !== undefined) this.seek(time);
    document.addEventListener("keydown", (event) => this.onKey(event));
    requestAnimationFrame((now) => this.onFrame(now));
  }

  /** s; the time that is shown. */
  get time(): number {
    return this.clock.time;
  }

  seek(t: number): void {
    this.timeline.seek(t);
  }

  /** The time that the pointer rests on in a plot, unless the motion plays. */
  private showPreview(t: number | null): void {
    const next = this.clock.isPlaying ? null : t;
    if (next === this.preview) return;
    this.preview = next;
    this.isStale = true;
  }

  /** m; where a body's centre is at time t, in one of the runs. */
  position(body: string, t: number = this.time, run = 0): Vector {
    return this.runs[run].body(body)!.position(t);
  }

  /** What is shown, the whole scene or a body, in the picture. */
  fit(): void {
    this.stage?.fit();
    this.isStale = true;
  }

  private onFrame(now: number): void {
    // After a pause of the browser itself the motion goes on from where it was.
    const seconds = Math.min(0.1, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    if (this.clock.isPlaying) {
      this.clock.advance(seconds);
      this.isStale = true;
    }
    if (this.isStale) {
      this.isStale = false;
      const t = this.preview ?? this.clock.time;
      this.timeline.update(t);
      this.plots.setTime(t);
      this.readout?.setTime(t);
      this.momentList.setTime(t);
      this.showMoment(t);
      this.stage?.render(t);
    }
    requestAnimationFrame((next) => this.onFrame(next));
  }

  /** The last thing that has happened until t, over the picture. */
  private showMoment(t: number): void {
    const { moments } = this.runs[0];
    const count = countUntil(moments, t);
    const text = count === 0 ? "" : `${count} of ${moments.length}: ${momentText(moments[count - 1])}`;
    this.moment.classList.toggle("now", count > 0 && moments[count - 1].time === t);
    if (text === this.moment.textContent) return;
    this.moment.textContent = text;
    this.moment.hidden = text === "";
    this.stage?.refreshLabels();
  }

  private header(): HTMLElement {
    const { report } = this.runs[0].data;
    const status = element("span", { class: `status ${report.status}` }, ending(report));
    const names = this.runs.map((run, i) => {
      const key = element("span", { class: "key" }, run.name);
      if (this.runs.length > 1) key.style.setProperty("--mark", colorOf(this.runs.length, i, 0));
      return key;
    });
    return element(
      "header",
      {},
      element("h1", {}, titleOf(report)),
      element("span", { class: "methods" }, ...names),
      status,
      element("span", { class: "spacer" }),
      iconButton("Scene: parameters, method, text", "E", kIcons.scene, () => this.sceneDialog.showModal()),
      iconButton("Light or dark", "D", kIcons.theme, () => this.toggleTheme()),
      iconButton("Keys", "?", kIcons.help, () => this.help.showModal()),
    );
  }

  /** Why a run failed, and its warnings. */
  private messages(): HTMLElement[] {
    return this.runs.flatMap(({ name, data: { report } }) => [
      ...(report.failure ? [element("p", { class: "message failed", role: "alert" }, `${name}: ${report.failure}`)] : []),
      ...report.warnings.map((text) => element("p", { class: "message" }, text)),
    ]);
  }

  private makeStage(column: HTMLElement, view: HTMLElement): Stage | null {
    const stale = (): void => void (this.isStale = true);
    let stage: Stage;
    try {
      stage = new Stage(view, this.runs, {
        changed: stale,
        chooseBody: (name) => this.chooseBody(name),
        seek: (t) => this.seek(t),
      });
    } catch {
      view.append(element("p", { class: "message" }, "This browser shows no WebGL: plots only."));
      return null;
    }
    const set = (change: (isOn: boolean) => void) => (isOn: boolean) => {
      change(isOn);
      stage.refreshLabels();
      stale();
    };
    const options = element(
      "fieldset",
      { class: "options" },
      element("legend", {}, "Show"),
      checkbox("Trail", "T", true, set((isOn) => (stage.shown.trails = isOn))),
      checkbox("Velocity", "V", true, set((isOn) => (stage.shown.velocity = isOn))),
      checkbox("Acceleration", "A", true, set((isOn) => (stage.shown.acceleration = isOn))),
      checkbox("Body axes", "B", true, set((isOn) => (stage.shown.axes = isOn))),
      checkbox("Impacts", "I", true, set((isOn) => (stage.showsImpacts = isOn))),
    );
    options.querySelectorAll("label")[1].classList.add("velocity");
    options.querySelectorAll("label")[2].classList.add("acceleration");
    // What differs in the orientation only would stand one in the other.
    const startsBeside = new Set(this.runs.map((run) => run.data.orientation)).size > 1;
    if (this.runs.length > 1)
      options.append(
        checkbox("Other runs", "G", true, set((isOn) => (stage.showsGhosts = isOn))),
        checkbox("Side by side", "S", startsBeside, set((isOn) => stage.setSideBySide(isOn))),
      );
    const camera = element("select", { "aria-label": "Camera", title: "Camera (F)" }, element("option", { value: "" }, "Whole scene"));
    for (const body of this.runs[0].bodies) camera.append(element("option", { value: body.name }, `Follow ${body.name}`));
    const look = (): void => {
      if (camera.value === "") stage.showAll();
      else stage.follow(camera.value);
      stale();
    };
    camera.addEventListener("change", look);
    if (startsBeside) {
      camera.value = this.runs[0].bodies.find((body) => body.turns)!.name;
      look();
      stage.setSideBySide(true);
    }
    const all = iconButton("Whole scene", "F", kIcons.all, () => {
      camera.value = "";
      look();
    });
    const panel = element(
      "details",
      { class: "panel", open: innerWidth > 800 },
      element("summary", {}, "View"),
      element("div", {}, options, element("div", { class: "camera" }, camera, all)),
    );
    column.prepend(panel);
    return stage;
  }

  /** What chooses the body of plots and values, where there are several. */
  private bodyChoice(): HTMLElement[] {
    const { bodies } = this.runs[0];
    if (bodies.length < 2) return [];
    for (const body of bodies) this.choice.append(element("option", {}, body.name));
    this.choice.addEventListener("change", () => this.chooseBody(this.choice.value));
    return [element("label", { class: "body-choice" }, "Values and plots of ", this.choice)];
  }

  private chooseBody(name: string): void {
    this.choice.value = name;
    this.plots.setBody(name);
    this.readout?.setBody(this.runs[0].body(name)!);
    this.stage?.choose(name);
    this.isStale = true;
  }

  private toggleTheme(): void {
    const next: Theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    applyTheme(next);
    rememberTheme(next);
    this.stage?.applyTheme();
    this.plots.applyTheme();
    this.isStale = true;
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target instanceof HTMLSelectElement) return;
    if (this.help.open || this.sceneDialog.open) return;
    // On the slider the browser's own arrow keys would compete, on a button the space bar presses it.
    if (event.key === " " && (target instanceof HTMLButtonElement || (target as HTMLInputElement).type === "checkbox")) return;
    const action = this.actions()[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event.shiftKey);
  }

  private actions(): Record<string, ((isLarge: boolean) => void) | undefined> {
    const move = (direction: number) => (isLarge: boolean) => {
      this.clock.isPlaying = false;
      this.seek(this.time + (direction * this.clock.duration * (isLarge ? 10 : 1)) / 1000);
    };
    const click = (title: string) => () => document.querySelector<HTMLElement>(`.option[title$="(${title})"] input`)?.click();
    const next = (): void => this.timeline.step(1);
    const previous = (): void => this.timeline.step(-1);
    return {
      " ": () => this.timeline.toggle(),
      ArrowRight: move(1),
      ArrowLeft: move(-1),
      n: next,
      p: previous,
      Home: () => this.seek(this.clock.begin),
      End: () => this.seek(this.clock.end),
      "+": () => this.timeline.changeSpeed(1),
      "-": () => this.timeline.changeSpeed(-1),
      f: () => this.cycleCamera(),
      d: () => this.toggleTheme(),
      e: () => this.sceneDialog.showModal(),
      "?": () => this.help.showModal(),
      ...Object.fromEntries(["T", "V", "A", "B", "I", "G", "S"].map((key) => [key.toLowerCase(), click(key)])),
    };
  }

  private cycleCamera(): void {
    const camera = document.querySelector<HTMLSelectElement>(".camera select");
    if (!camera) return;
    camera.selectedIndex = (camera.selectedIndex + 1) % camera.options.length;
    camera.dispatchEvent(new Event("change"));
  }
}
