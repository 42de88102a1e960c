import * as THREE from "three";
import { kComponentColors } from "./theme";

const kSize = 76;
const kReach = 24;
/** An axis that looks shorter points at the eye, and its name would stand on another. */
const kLeastLength = 0.15;

/** The directions of x, y and z as the camera sees them, in a corner of the picture. */
export class Triad {
  readonly root: SVGSVGElement;
  private readonly lines: SVGLineElement[];
  private readonly names: SVGTextElement[];

  constructor() {
    const make = <K extends keyof SVGElementTagNameMap>(tag: K): SVGElementTagNameMap[K] =>
      document.createElementNS("http://www.w3.org/2000/svg", tag);
    this.root = make("svg");
    this.root.setAttribute("class", "triad");
    this.root.setAttribute("aria-hidden", "true");
    this.root.setAttribute("viewBox", `${-kSize / 2} ${-kSize / 2} ${kSize} ${kSize}`);
    this.lines = kComponentColors.map((color) => {
      const line = make("line");
      line.setAttribute("stroke", color);
      this.root.append(line);
      return line;
    });
    this.names = ["x", "y", "z"].map((name) => {
      const text = make("text");
      text.textContent = name;
      this.root.append(text);
      return text;
    });
  }

  update(camera: THREE.Camera): void {
    const toCamera = new THREE.Matrix3().setFromMatrix4(camera.matrixWorldInverse);
    this.lines.forEach((line, axis) => {
      const { x, y } = new THREE.Vector3().setComponent(axis, 1).applyMatrix3(toCamera);
      line.setAttribute("x2", String(kReach * x));
      line.setAttribute("y2", String(-kReach * y));
      const length = Math.hypot(x, y);
      const name = this.names[axis];
      name.setAttribute("visibility", length < kLeastLength ? "hidden" : "visible");
      const far = kReach * length + 8;
      name.setAttribute("x", String((far * x) / length || 0));
      name.setAttribute("y", String((-far * y) / length || 0));
    });
  }
}
