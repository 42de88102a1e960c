import * as THREE from "three";

/** px around a body that texts leave free. */
export const kBodyPixels = 8;

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
const kOffset = kBodyPixels + kGap + 1;

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

/** Texts over the picture, as HTML: sharp, in the page's fonts, never one over another. */
export class Labels {
  private readonly placed: Placed[] = [];

  constructor(private readonly layer: HTMLElement) {}

  set(specs: readonly LabelSpec[]): void {
    this.layer.replaceChildren();
    this.placed.length = 0;
    for (const spec of [...specs].sort((a, b) => b.priority - a.priority)) {
      const element = document.createElement("span");
      element.className = `label ${spec.className}`;
      element.textContent = spec.text;
      if (spec.mark) element.style.setProperty("--mark", spec.mark);
      this.layer.append(element);
      this.placed.push({ spec, element, width: 0, height: 0 });
    }
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
    const isFree = (area: Area): boolean =>
      area.left >= 0 &&
      area.top >= 0 &&
      area.right <= width &&
      area.bottom <= height &&
      !taken.some((other) => overlap(area, other));
    for (const { spec, element, width: w, height: h } of this.placed) {
      const areas = around(spec.at, w, h);
      const foot = spec.foot ? around(spec.foot, w, h)?.below : undefined;
      const places = spec.side ? [areas?.[spec.side]] : [areas?.above, foot, areas?.right, areas?.left, areas?.below];
      const place = places.find((area) => area && isFree(area));
      element.style.visibility = place ? "visible" : "hidden";
      if (!place) continue;
      taken.push(place);
      element.style.transform = `translate(${place.left.toFixed(1)}px, ${place.top.toFixed(1)}px)`;
    }
  }
}
