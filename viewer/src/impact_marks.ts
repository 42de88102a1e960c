import * as THREE from "three";
import type { Impact } from "./data";
import { dots } from "./drawing";
import type { LabelSpec } from "./labels";
import { momentText } from "./moments";
import type { Run } from "./motion";
import { kMomentColors } from "./theme";
import type { ViewFrame } from "./view_frame";

/** More impacts than these are not all marked, and not all told, at once: the last ones before the time are. */
const kMostDots = 60;
const kMostTexts = 12;
const kLastDots = 25;
const kLastTexts = 3;
const kPixels = 10;

/** Where the impacts of a run are in the picture. */
export class ImpactMarks {
  readonly dots: THREE.Points;
  private readonly impacts: Impact[];
  private readonly places: THREE.Vector3[];
  /** The impacts up to the time that is shown. */
  private count = 0;
  private time = NaN;

  constructor(run: Run, frame: ViewFrame) {
    this.impacts = run.moments.flatMap(({ impact }) => (impact ? [impact] : []));
    this.places = this.impacts.map(({ point }) => frame.toView(point));
    this.dots = dots(this.places, kMomentColors.impact, kPixels);
    this.dots.visible = this.impacts.length > 0;
  }

  /** Whether the texts are others than before. */
  setTime(t: number): boolean {
    const count = this.impacts.filter(({ time }) => time <= t).length;
    const wasExact = this.impacts[this.count - 1]?.time === this.time;
    const isExact = this.impacts[count - 1]?.time === t;
    const isOther = count !== this.count || wasExact !== isExact;
    [this.count, this.time] = [count, t];
    if (this.impacts.length > kMostDots) {
      const first = Math.max(0, count - kLastDots);
      this.dots.geometry.setDrawRange(first, count - first);
    }
    return isOther;
  }

  /** What is marked now. */
  get shown(): { impact: Impact; place: THREE.Vector3 }[] {
    const isAll = this.impacts.length <= kMostDots;
    const [first, last] = isAll ? [0, this.impacts.length] : [Math.max(0, this.count - kLastDots), this.count];
    return this.impacts.slice(first, last).map((impact, i) => ({ impact, place: this.places[first + i] }));
  }

  /** Texts at the impacts, of a run that stands at `offset`; `isFirst`: of the first run, before others. */
  labels(offset: THREE.Vector3, isFirst: boolean): LabelSpec[] {
    const isAll = this.impacts.length <= kMostTexts;
    const [first, last] = isAll ? [0, this.impacts.length] : [Math.max(0, this.count - kLastTexts), this.count];
    return this.impacts.slice(first, last).map((impact, i) => {
      const isNow = impact.time === this.time;
      return {
        at: this.places[first + i].clone().add(offset),
        text: momentText({ time: impact.time, kind: "impact", impact }),
        className: isNow ? "label-impact label-highlighted" : "label-impact",
        // what has just happened before what was earlier
        priority: isNow ? 4 : (isFirst ? 3 : 2) + (first + i) / (this.impacts.length + 1),
      };
    });
  }
}
