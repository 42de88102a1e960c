import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Ground } from "./scenery";
import { cameraPlace, kAxes, kViewSize, type ViewFrame } from "./view_frame";

const kFieldOfViewDegrees = 35;
/** How far over the ground the camera stays, in its distance. */
const kLeastHeight = 0.01;
/** How much wider the picture is than what is to be in it. */
const kMargin = 1.1;
/** Ways to look at a scene, in degrees: how far from its side towards its end, and how far from above the ground. */
const kTurns = [19, 30, 40, 50];
const kRises = [21, 30];
/** What a degree of turning away from the side is worth, beside how much of the picture is filled. */
const kTurnCost = 0.006;

/**
 * The largest angle from the vertical at which a camera at this distance from `target`, in the upright plane through the
 * horizontal unit vector `outward`, is over the plane n·x = height, by `least`. n points up.
 */
export function largestPolarAngle(
  target: THREE.Vector3,
  distance: number,
  outward: THREE.Vector3,
  n: THREE.Vector3,
  height: number,
  least: number,
  up: THREE.Vector3 = kAxes.z.up,
): number {
  // n·(target + distance (sin p outward + cos p up)) = height + least
  const [across, rise] = [n.dot(outward), n.dot(up)];
  const size = Math.hypot(rise, across);
  const part = (height + least - n.dot(target)) / (distance * size);
  if (part <= -1) return Math.PI;
  return Math.atan2(across, rise) + Math.acos(Math.min(1, part));
}

/** The camera, what it looks at, and how the user turns it: never from under the ground. */
export class CameraRig {
  readonly camera = new THREE.PerspectiveCamera(kFieldOfViewDegrees, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  private readonly up: THREE.Vector3;
  private readonly planes: { normal: THREE.Vector3; height: number }[];
  private height = 1;

  constructor(canvas: HTMLElement, frame: ViewFrame, grounds: readonly Ground[]) {
    this.up = frame.axes.up;
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.planes = grounds
      .filter(({ isSolid, normal }) => isSolid && normal.dot(this.up) > 0)
      .map(({ point, normal }) => ({ normal, height: frame.toView([point.x, point.y, point.z]).dot(normal) }));
    this.controls.addEventListener("change", () => this.stayAbove());
  }

  resize(width: number, height: number): void {
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Tangents of the half angles that the picture spans. */
  get halfAngles(): { horizontal: number; vertical: number } {
    const vertical = Math.tan(THREE.MathUtils.degToRad(kFieldOfViewDegrees / 2));
    return { horizontal: vertical * this.camera.aspect, vertical };
  }

  /** The size of a pixel of the screen so far from the camera, in the drawing. */
  pixelAt(distance: number): number {
    return (2 * this.halfAngles.vertical * distance) / this.height;
  }

  get distance(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /** Looks at a place from so far away, in the direction `away` from it, or what comes nearest over the ground. */
  look(target: THREE.Vector3, away: THREE.Vector3, distance: number): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(away.clone().normalize(), distance);
    this.controls.update();
    this.stayAbove();
  }

  /**
   * Looks at a scene as its shape asks for: from the side, but turned towards its end as far as that fills the picture.
   * `points`: what is to be seen if arrows are so long, in the drawing; `side`, `end`: horizontal, unit.
   */
  frame(
    points: (arrow: number) => THREE.Vector3[],
    middle: THREE.Vector3,
    side: THREE.Vector3,
    end: THREE.Vector3,
    arrowPixels: number,
  ): void {
    const { horizontal, vertical } = this.halfAngles;
    const inside = { horizontal: horizontal / kMargin, vertical: vertical / kMargin };
    let best = { score: -Infinity, away: side, target: middle, distance: 1 };
    for (const turn of kTurns)
      for (const rise of kRises) {
        const [a, b] = [turn, rise].map(THREE.MathUtils.degToRad);
        const away = side.clone().multiplyScalar(Math.cos(a)).addScaledVector(end, Math.sin(a));
        away.multiplyScalar(Math.cos(b)).addScaledVector(this.up, Math.sin(b));
        const bare = cameraPlace(points(0), middle, away, inside, this.up);
        const all = points(arrowPixels * this.pixelAt(bare.distance));
        const place = cameraPlace(all, middle, away, inside, this.up);
        const score = this.filled(all, away, place) * (1 - kTurnCost * (turn - kTurns[0]));
        if (score > best.score) best = { score, away, ...place };
      }
    this.look(best.target, best.away, best.distance);
  }

  /** How much of the picture is in the rectangle about these points. */
  private filled(
    points: readonly THREE.Vector3[],
    away: THREE.Vector3,
    at: { target: THREE.Vector3; distance: number },
  ): number {
    const camera = this.camera.clone();
    camera.position.copy(at.target).addScaledVector(away, at.distance);
    camera.lookAt(at.target);
    camera.updateMatrixWorld();
    const box = new THREE.Box2();
    for (const point of points) {
      const { x, y } = point.clone().project(camera);
      box.expandByPoint(new THREE.Vector2(x, y));
    }
    const { x, y } = box.getSize(new THREE.Vector2());
    return (x * y) / 4;
  }

  /** Moves camera and target alike. */
  move(by: THREE.Vector3): void {
    this.controls.target.add(by);
    this.camera.position.add(by);
    this.stayAbove();
  }

  /** Depth has few digits: the range follows the distance that one looks at. */
  setRange(): void {
    this.camera.near = this.distance / 100;
    this.camera.far = this.distance + 10 * kViewSize;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  private stayAbove(): void {
    const { target } = this.controls;
    const offset = this.camera.position.clone().sub(target);
    const distance = offset.length();
    const outward = offset.clone().projectOnPlane(this.up).normalize();
    const limits = this.planes.map(({ normal, height }) =>
      largestPolarAngle(target, distance, outward, normal, height, kLeastHeight * distance, this.up),
    );
    const most = Math.max(0.01, Math.min(Math.PI, ...limits));
    this.controls.maxPolarAngle = most;
    if (Math.acos(offset.dot(this.up) / distance) > most + 1e-9) this.controls.update();
  }
}
