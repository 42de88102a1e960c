import { type Clock, neighbour, speedsAround } from "./clock";
import { element, iconButton, kIcons, setIcon } from "./dom";
import * as format from "./format";
import type { Moment } from "./moments";

/** Marks on the bar; more of them would not be seen apart. */
const kMostMarks = 600;

/** Where on the bar, from 0 to 1, to mark times of a run: of those that would be seen as one, the first. */
export function markPlaces(times: readonly number[], begin: number, duration: number): number[] {
  const places = new Map<number, number>();
  for (const time of times) {
    const part = (time - begin) / (duration || 1);
    const bucket = Math.floor(part * kMostMarks);
    if (part >= 0 && part <= 1 && !places.has(bucket)) places.set(bucket, part);
  }
  return [...places.values()];
}

/** The bar at the bottom: play, step from impact or event to the next, scrub. */
export class Timeline {
  readonly root: HTMLElement;
  private readonly playButton: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly readout: HTMLOutputElement;
  private readonly speed: HTMLSelectElement;
  private readonly times: number[];
  private readonly exactTimes: Set<number>;

  /** `changed` is called whenever the user has changed the clock. */
  constructor(
    private readonly clock: Clock,
    moments: readonly Moment[],
    private readonly changed: () => void,
  ) {
    this.times = moments.map(({ time }) => time);
    this.exactTimes = new Set(this.times);
    this.playButton = iconButton("Play", "space", kIcons.play, () => this.toggle());
    this.slider = element("input", {
      type: "range",
      min: "0",
      max: "1",
      step: "any",
      "aria-label": "Time",
    });
    this.slider.addEventListener("input", () => {
      this.clock.isPlaying = false;
      this.seek(this.clock.begin + Number(this.slider.value) * this.clock.duration);
    });
    const ticks = element("div", { class: "ticks", "aria-hidden": "true" });
    for (const kind of ["impact", "event"] as const) {
      const times = moments.filter((moment) => moment.kind === kind).map(({ time }) => time);
      for (const part of markPlaces(times, clock.begin, clock.duration)) {
        const tick = element("i", { class: kind });
        tick.style.left = `calc(var(--thumb) / 2 + ${part} * (100% - var(--thumb)))`;
        ticks.append(tick);
      }
    }
    this.readout = element("output", { class: "time", "aria-live": "off" });
    this.speed = element("select", { "aria-label": "Speed", title: "Speed (− and +)" });
    for (const speed of speedsAround(clock.speed))
      this.speed.append(element("option", { value: String(speed) }, `${format.number(speed)}×`));
    this.speed.value = String(clock.speed);
    this.speed.addEventListener("change", () => (this.clock.speed = Number(this.speed.value)));
    const kinds = [...new Set(moments.map(({ kind }) => kind))].sort().reverse().join(" or ");
    const steps =
      moments.length > 0
        ? [
            iconButton(`Previous ${kinds}`, "P", kIcons.previous, () => this.step(-1)),
            iconButton(`Next ${kinds}`, "N", kIcons.next, () => this.step(1)),
          ]
        : [];
    this.root = element(
      "div",
      { class: "timeline", role: "group", "aria-label": "Time" },
      this.playButton,
      ...steps,
      element("div", { class: "scrub" }, this.slider, ticks),
      this.readout,
      this.speed,
    );
  }

  toggle(): void {
    this.clock.toggle();
    this.changed();
  }

  seek(t: number): void {
    this.clock.seek(t);
    this.changed();
  }

  /** To the impact or event before or behind the time that is shown. */
  step(direction: 1 | -1): void {
    const t = neighbour(this.times, this.clock.time, direction);
    this.clock.isPlaying = false;
    if (t !== null) this.seek(t);
    else this.changed();
  }

  changeSpeed(direction: 1 | -1): void {
    const index = this.speed.selectedIndex + direction;
    if (index < 0 || index >= this.speed.options.length) return;
    this.speed.selectedIndex = index;
    this.clock.speed = Number(this.speed.value);
  }

  /** `shown`: s, the time of the picture, where it is another than the clock's. */
  update(shown = this.clock.time): void {
    const { clock } = this;
    const name = clock.isPlaying ? "Pause" : "Play";
    if (this.playButton.getAttribute("aria-label") !== name) {
      this.playButton.setAttribute("aria-label", name);
      this.playButton.title = `${name} (space)`;
      setIcon(this.playButton, clock.isPlaying ? kIcons.pause : kIcons.play);
    }
    const part = (clock.time - clock.begin) / (clock.duration || 1);
    if (Number(this.slider.value) !== part) this.slider.value = String(part);
    // At an impact or event the time is exact, elsewhere as fine as one can see.
    const text = this.exactTimes.has(shown) ? format.exactTime(shown) : `${format.time(shown, clock.duration)} s`;
    this.readout.textContent = text;
    this.readout.classList.toggle("preview", shown !== clock.time);
    this.slider.setAttribute("aria-valuetext", text);
  }
}
