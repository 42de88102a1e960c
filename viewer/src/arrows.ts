import * as THREE from "three";
import type { Vector } from "./data";
import { length } from "./vectors";

/** px: the length of the arrow of the largest velocity or acceleration, in a picture whose smaller side is so long. */
export const arrowPixels = (size: number): number => Math.min(110, 0.2 * size);

const kAlong = new THREE.Vector3(0, 1, 0);
const kShaft = new THREE.CylinderGeometry(0.02, 0.02, 0.8, 12).translate(0, 0.4, 0);
const kHead = new THREE.ConeGeometry(0.07, 0.22, 20).translate(0, 0.89, 0);

/** An arrow along its own y axis from the origin, of length 1. */
export function arrow(color: string): THREE.Group {
  const material = new THREE.MeshBasicMaterial({ color });
  return new THREE.Group().add(new THREE.Mesh(kShaft, material), new THREE.Mesh(kHead, material));
}

/** An arrow of that length, as thick as one of the length `usual`, as long as it is longer than thick. */
export function stretch(arrow: THREE.Object3D, drawn: number, usual: number): void {
  const thickness = Math.min(usual, 2 * drawn);
  arrow.scale.set(thickness, drawn, thickness);
}

/**
 * Shows a vector that is `most` at its largest, then `longest` in the drawing, as an arrow that begins so far from `at`
 * as `start` says: at the surface of a solid.
 */
export function point(
  arrow: THREE.Group,
  at: THREE.Vector3,
  direction: Vector,
  most: number,
  longest: number,
  start: number,
): void {
  const size = length(direction);
  arrow.visible = size > 1e-9 * most && most > 0;
  if (!arrow.visible) return;
  const unit = new THREE.Vector3(direction[0] / size, direction[1] / size, direction[2] / size);
  arrow.position.copy(at).addScaledVector(unit, start);
  arrow.quaternion.setFromUnitVectors(kAlong, unit);
  stretch(arrow, (longest * size) / most, longest);
}
