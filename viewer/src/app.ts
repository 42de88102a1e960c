import { Clock } from "./clock";
import type { Report, RunData, Vector } from "./data";
import { checkbox, element, iconButton, kIcons } from "./dom";
import { helpDialog } from "./help";
import { ImpactList } from "./impact_list";
import { namedRuns, type Run } from "./motion";
import { Plots } from "./plots";
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
  private readonly impactList: ImpactList;
  private stage: Stage | null = null;
  private readonly help: HTMLDialogElement;
  private isStale = true;
  private lastFrame = 0;

  /** `time`: what to show first, s; by default the beginning. */
  constructor(root: HTMLElement, data: readonly RunData[], time?: number) {
    this.runs = namedRuns(data);
    const [first] = this.runs;
    const { report } = first.data;
    document.title = titleOf(report);
    this.clock = new Clock(
      Math.min(...this.runs.map((run) => run.begin)),
      Math.max(...this.runs.map((run) => run.end)),
    );
    const stale = (): void => void (this.isStale = true);
    this.timeline = new Timeline(this.clock, first.impacts, stale);
    this.impactList = new ImpactList(first.impacts, (t) => this.seek(t));
    this.help = helpDialog();

    const view = element("div", { class: "stage" });
    const plots = element("div", { class: "plots" });
    const side = element("aside", { class: "side", "aria-label": "Plots and impacts" });
    const body = element("main", { class: "body" });
    if (first.bodies.length > 0) body.append(view);
    else body.classList.add("plots-only");
    body.append(side);
    root.append(this.header(), ...this.messages(), body, this.timeline.root, this.help);
    if (first.bodies.length > 0) this.stage = this.makeStage(view, stale);
    if (first.bodies.length > 1 && this.clock.duration > 0) side.append(this.bodyChoice());
    side.append(plots);
    if (first.impacts.length > 0) side.append(this.impactList.root);
    this.plots = new Plots(plots, this.runs, first.bodies[0]?.name ?? null, (t) => this.seek(t));

    new ResizeObserver(() => {
      this.stage?.resize();
      this.plots.resize();
      this.isStale = true;
    }).observe(body);
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
      this.timeline.update();
      this.plots.setTime(this.clock.time);
      this.stage?.highlight(this.impactList.setTime(this.clock.time));
      this.stage?.render(this.clock.time);
    }
    requestAnimationFrame((next) => this.onFrame(next));
  }

  private header(): HTMLElement {
    const { report } = this.runs[0].data;
    const status = element("span", { class: `status ${report.status}` }, report.status);
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

  private makeStage(view: HTMLElement, stale: () => void): Stage | null {
    let stage: Stage;
    try {
      stage = new Stage(view, this.runs, stale);
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
      options,
      element("div", { class: "camera" }, camera, all),
    );
    panel.addEventListener("toggle", () => {
      stage.refreshLabels();
      stale();
    });
    view.append(panel);
    stage.refreshLabels();
    return stage;
  }

  private bodyChoice(): HTMLElement {
    const choice = element("select", { "aria-label": "Body" });
    for (const body of this.runs[0].bodies) choice.append(element("option", {}, body.name));
    choice.addEventListener("change", () => this.plots.setBody(choice.value));
    return element("label", { class: "body-choice" }, "Plots of ", choice);
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
    if (event.ctrlKey || event.metaKey || event.altKey || target instanceof HTMLSelectElement || this.help.open) return;
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
