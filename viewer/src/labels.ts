import * as THREE from "three";

/** A text at a point of the drawing. Where two would overlap, the one of lower priority is left out. */
export interface LabelSpec {
  at: THREE.Vector3;
  text: string;
  className: string;
  priority: number;
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

/** px between two texts, and between a text and its point. */
const kGap = 4;
const kOffset = 9;

export const overlap = (a: Area, b: Area): boolean =>
  a.left < b.right + kGap && b.left < a.right + kGap && a.top < b.bottom + kGap && b.top < a.bottom + kGap;

/** The places around a point at which its text may stand, best first. */
export function candidates(x: number, y: number, width: number, height: number): Area[] {
  const at = (left: number, top: number): Area => ({ left, top, right: left + width, bottom: top + height });
  return [
    at(x - width / 2, y - kOffset - height),
    at(x + kOffset, y - height / 2),
    at(x - kOffset - width, y - height / 2),
    at(x - width / 2, y + kOffset),
  ];
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
    for (const { spec, element, width: w, height: h } of this.placed) {
      point.copy(spec.at).project(camera);
      const isInFront = point.z < 1;
      const x = (0.5 + 0.5 * point.x) * width;
      const y = (0.5 - 0.5 * point.y) * height;
      const place = isInFront
        ? candidates(x, y, w, h).find(
            (area) =>
              area.left >= 0 &&
              area.top >= 0 &&
              area.right <= width &&
              area.bottom <= height &&
              !taken.some((other) => overlap(area, other)),
          )
        : undefined;
      element.style.visibility = place ? "visible" : "hidden";
      if (!place) continue;
      taken.push(place);
      element.style.transform = `translate(${place.left.toFixed(1)}px, ${place.top.toFixed(1)}px)`;
    }
  }
}
