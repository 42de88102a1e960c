import * as THREE from "three";

export type Side = "above" | "right" | "left" | "below";

/** A text at a point of the drawing. Where two would overlap, the one of lower priority is left out. */
export interface LabelSpec {
  at: THREE.Vector3;
  /** Where the text stands beneath if there is no room above `at`: the other end of something large. */
  foot?: THREE.Vector3;
  /** Where alone the text may stand; else wherever there is room. */
  side?: Side;
  text: string;
  className: string;
  priority: number;
  /** A colour to show before the text. */
  mark?: string;
}

interface Placed {
  spec: LabelSpec;
  element: HTMLElement;
  width: number;
  height: number;
  /** Where it stands now; null: nowhere. */
  side: Side | "foot" | null;
}

/** A rectangle on the screen, px. */
export interface Area {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** px between two texts, and between a text and its point: clear of the body that is at an impact. */
const kGap = 4;
const kOffset = 13;
/** px; a text that has been left out comes back where there is so much more room, lest it come and go. */
const kRoomToReturn = 10;

export const overlap = (a: Area, b: Area): boolean =>
  a.left < b.right + kGap && b.left < a.right + kGap && a.top < b.bottom + kGap && b.top < a.bottom + kGap;

/** The places around a point at which its text may stand in a picture of that width, best first. */
export function candidates(
  x: number,
  y: number,
  width: number,
  height: number,
  pictureWidth: number,
): Record<Side, Area> {
  const at = (left: number, top: number): Area => ({ left, top, right: left + width, bottom: top + height });
  const centered = Math.min(Math.max(0, x - width / 2), pictureWidth - width);
  return {
    above: at(centered, y - kOffset - height),
    right: at(x + kOffset, y - height / 2),
    left: at(x - kOffset - width, y - height / 2),
    below: at(centered, y + kOffset),
  };
}

const grown = ({ left, top, right, bottom }: Area, by: number): Area => ({
  left: left - by,
  top: top - by,
  right: right + by,
  bottom: bottom + by,
});

/** Texts over the picture, as HTML: sharp, in the page's fonts, never one over another, and each where it was if it can. */
export class Labels {
  private placed: Placed[] = [];

  constructor(private readonly layer: HTMLElement) {}

  set(specs: readonly LabelSpec[]): void {
    const before = new Map(this.placed.map((each) => [keyOf(each.spec), each]));
    this.placed = [...specs]
      .sort((a, b) => b.priority - a.priority)
      .map((spec) => {
        const kept = before.get(keyOf(spec));
        before.delete(keyOf(spec));
        if (kept) {
          kept.element.className = `label ${spec.className}`;
          return { ...kept, spec };
        }
        const element = document.createElement("span");
        element.className = `label ${spec.className}`;
        element.textContent = spec.text;
        if (spec.mark) element.style.setProperty("--mark", spec.mark);
        this.layer.append(element);
        return { spec, element, width: 0, height: 0, side: null };
      });
    for (const { element } of before.values()) element.remove();
    for (const each of this.placed) {
      each.width = each.element.offsetWidth;
      each.height = each.element.offsetHeight;
    }
  }

  /** Puts each text where its point is now, and none over what is `occupied`. */
  update(camera: THREE.Camera, width: number, height: number, occupied: readonly Area[]): void {
    const taken = [...occupied];
    const point = new THREE.Vector3();
    const around = (at: THREE.Vector3, w: number, h: number): Record<Side, Area> | null => {
      point.copy(at).project(camera);
      if (point.z >= 1 || Math.abs(point.x) > 1 || Math.abs(point.y) > 1) return null;
      return candidates((0.5 + 0.5 * point.x) * width, (0.5 - 0.5 * point.y) * height, w, h, width);
    };
    const isFree = (area: Area, room: number): boolean =>
      area.left >= 0 &&
      area.top >= 0 &&
      area.right <= width &&
      area.bottom <= height &&
      !taken.some((other) => overlap(grown(area, room), other));
    for (const each of this.placed) {
      const { spec, element, width: w, height: h } = each;
      const areas = around(spec.at, w, h);
      const foot = spec.foot ? around(spec.foot, w, h)?.below : undefined;
      const all: Partial<Record<Side | "foot", Area>> = { ...areas, ...(foot && { foot }) };
      const sides: (Side | "foot")[] = spec.side ? [spec.side] : ["above", "foot", "right", "left", "below"];
      if (each.side) sides.unshift(each.side);
      const isNew = element.style.visibility === "";
      const room = each.side || isNew ? 0 : kRoomToReturn;
      each.side = sides.find((side) => all[side] && isFree(all[side], room)) ?? null;
      element.style.visibility = each.side ? "visible" : "hidden";
      const place = each.side && all[each.side];
      if (!place) continue;
      taken.push(place);
      element.style.transform = `translate(${place.left.toFixed(1)}px, ${place.top.toFixed(1)}px)`;
    }
  }
}

/** What makes a text the same after a change of others. */
const keyOf = ({ text, at, side }: LabelSpec): string => `${text} ${side ?? ""} ${at.toArray().join(" ")}`;
