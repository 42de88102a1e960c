import * as THREE from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import type { Vector } from "./data";
import { type BodyMotion, length } from "./motion";
import { trailOf } from "./sampling";
import { bodyGeometry, reach, vector } from "./shapes";
import { kComponentColors, kQuantityColors } from "./theme";
import { kViewSize, type ViewFrame } from "./view_frame";

/** What is drawn of every body. */
export interface Visibility {
  trails: boolean;
  velocity: boolean;
  acceleration: boolean;
  axes: boolean;
}

/** px: the length of the arrow of the largest velocity or acceleration, in a picture whose smaller side is so long. */
export const arrowPixels = (size: number): number => Math.min(110, 0.2 * size);
/** The length of a body's axes, in how far the body reaches. */
const kAxisReach = 1.4;
/** px: the least length of a body's axes, and the size of a body too small to see. */
const kAxisPixels = 45;
const kDotPixels = 9;

/** A white disk; made by hand because a canvas for it would be one more thing that the graphics processor sets up. */
const dotTexture = (() => {
  const kSide = 32;
  let texture: THREE.DataTexture | undefined;
  return (): THREE.Texture => {
    if (texture) return texture;
    const isInside = (i: number): boolean =>
      Math.hypot((i % kSide) - (kSide - 1) / 2, Math.floor(i / kSide) - (kSide - 1) / 2) < (kSide - 1) / 2;
    const texels = Array.from({ length: kSide * kSide }, (_, i) => [255, 255, 255, isInside(i) ? 255 : 0]);
    texture = new THREE.DataTexture(new Uint8Array(texels.flat()), kSide, kSide);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  };
})();

/** Round dots of constant size on the screen. */
export function dots(points: THREE.Vector3[], color: string, pixels: number): THREE.Points {
  const material = new THREE.PointsMaterial({
    color,
    size: pixels,
    sizeAttenuation: false,
    map: dotTexture(),
    alphaTest: 0.5,
  });
  const result = new THREE.Points(new THREE.BufferGeometry().setFromPoints(points), material);
  result.frustumCulled = false;
  return result;
}

/** Makes all that is drawn of an object as opaque as given, 1: as it was made. */
export function setOpacity(object: THREE.Object3D, opacity: number): void {
  object.traverse((each) => {
    const { material } = each as THREE.Object3D & { material?: THREE.Material };
    if (!material) return;
    material.userData.ownOpacity ??= material.opacity;
    material.opacity = (material.userData.ownOpacity as number) * opacity;
    material.transparent = material.opacity < 1;
    if (material.alphaTest > 0) material.alphaTest = 0.5 * material.opacity;
  });
}

/** An arrow along its own y axis from the origin, of length 1. */
function arrow(color: string): THREE.Group {
  const material = new THREE.MeshBasicMaterial({ color });
  const shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.02, 0.02, 0.8, 12).translate(0, 0.4, 0), material);
  const head = new THREE.Mesh(new THREE.ConeGeometry(0.07, 0.22, 20).translate(0, 0.89, 0), material);
  return new THREE.Group().add(shaft, head);
}

/** A body with all that is drawn of it. */
export class Actor {
  readonly group = new THREE.Group();
  private readonly body3d = new THREE.Group();
  private readonly dot: THREE.Points;
  private readonly velocity: THREE.Group;
  private readonly acceleration: THREE.Group;
  private readonly axes: THREE.Group;
  private readonly way: Line2;
  private readonly tip: Line2;
  private readonly wholeWay: THREE.Line;
  private readonly times: number[];
  private readonly points: THREE.Vector3[];
  /** How far the body reaches from its centre, and the same with the most that its numbers ever stretch it. */
  readonly reach: number;
  readonly widest: number;
  /** Where its centre is now, its top and its foot, in the drawing. */
  readonly place = new THREE.Vector3();
  readonly top = new THREE.Vector3();
  readonly foot = new THREE.Vector3();
  /** Of the whole run, in the drawing. */
  readonly offset = new THREE.Vector3();
  private readonly mostSpeed: number;
  private readonly mostAcceleration: number;

  constructor(
    readonly motion: BodyMotion,
    private readonly frame: ViewFrame,
    readonly color: string,
  ) {
    this.reach = reach(motion.data) * frame.scale;
    this.widest = this.reach * largestStretch(motion);
    const trail = trailOf(motion, (1e-4 * kViewSize) / frame.scale);
    this.times = trail.times;
    this.points = trail.points.map((point) => frame.toView(point));
    const speeds = trail.times.map((t) => length(motion.velocity(t)));
    const accelerations = trail.times.map((t) => length(motion.acceleration(t)));
    this.mostSpeed = largest(speeds);
    this.mostAcceleration = largest(accelerations);

    const geometry = bodyGeometry(motion.data.shape, color, motion.turns);
    if (geometry) {
      this.body3d.add(new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true })));
      if (motion.data.shape.kind !== "sphere")
        this.body3d.add(
          new THREE.LineSegments(
            new THREE.EdgesGeometry(geometry, 15),
            new THREE.LineBasicMaterial({ color: "#1d1d22", transparent: true, opacity: 0.6 }),
          ),
        );
    }
    this.addPoints(color);
    this.body3d.matrixAutoUpdate = false;
    this.dot = dots([new THREE.Vector3()], color, kDotPixels);
    this.velocity = arrow(kQuantityColors.velocity);
    this.acceleration = arrow(kQuantityColors.acceleration);
    this.axes = new THREE.Group();
    const directions: Vector[] = [
      [0, 0, -Math.PI / 2],
      [0, 0, 0],
      [Math.PI / 2, 0, 0],
    ];
    directions.forEach((turn, i) => {
      const axis = arrow(kComponentColors[i]);
      axis.rotation.set(...turn);
      this.axes.add(axis);
    });

    const positions = new Float32Array(this.points.length * 3);
    this.points.forEach((point, i) => point.toArray(positions, 3 * i));
    const lineMaterial = new LineMaterial({ color, linewidth: 3 });
    this.way = new Line2(new LineGeometry().setPositions(positions), lineMaterial);
    this.tip = new Line2(new LineGeometry().setPositions([0, 0, 0, 0, 0, 0]), lineMaterial);
    this.wholeWay = new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(this.points),
      new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.35 }),
    );
    for (const line of [this.way, this.tip, this.wholeWay]) line.frustumCulled = false;
    this.group.add(
      this.body3d,
      this.dot,
      this.velocity,
      this.acceleration,
      this.axes,
      this.way,
      this.tip,
      this.wholeWay,
    );
  }

  /** Named points as dots, and, of a body without a shape, rods to them from the centre of mass. */
  private addPoints(color: string): void {
    const { points, shape } = this.motion.data;
    const { Mesh, SphereGeometry, CylinderGeometry, MeshLambertMaterial, Vector3, Quaternion } = THREE;
    const material = new MeshLambertMaterial({ color });
    const thickness = 0.035 * reach(this.motion.data);
    for (const { position } of points) {
      const end = vector(position);
      const dot = new Mesh(new SphereGeometry(1.4 * thickness, 20, 14), material);
      dot.position.copy(end);
      this.body3d.add(dot);
      if (shape.kind !== "point" || end.length() === 0) continue;
      const rod = new Mesh(new CylinderGeometry(thickness, thickness, end.length(), 20), material);
      rod.position.copy(end).multiplyScalar(0.5);
      rod.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), end.clone().normalize()));
      this.body3d.add(rod);
    }
  }

  /**
   * Puts everything where it is at time t. `pixel`: the size of a pixel of the screen at a place of the drawing;
   * `pictureSize`: px, of the picture's smaller side.
   */
  update(t: number, shown: Visibility, pixel: (at: THREE.Vector3) => number, pictureSize: number): void {
    const { motion } = this;
    const local = this.frame.toView(motion.position(t));
    this.place.copy(local).add(this.offset);
    this.top.copy(this.place).z += this.widest;
    this.foot.copy(this.place).z -= this.widest;
    const size = pixel(this.place);
    const [w, x, y, z] = motion.orientation(t);
    const turn = new THREE.Quaternion(x, y, z, w);
    const s = this.frame.scale;
    const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = motion.carriedMatrix(t).map((each) => s * each);
    this.body3d.matrix.set(xx, xy, xz, local.x, yx, yy, yz, local.y, zx, zy, zz, local.z, 0, 0, 0, 1);
    this.body3d.matrixWorldNeedsUpdate = true;
    this.dot.position.copy(local);
    this.dot.visible = this.reach < 0.5 * kDotPixels * size;

    const longest = arrowPixels(pictureSize) * size;
    point(this.velocity, local, motion.velocity(t), this.mostSpeed, shown.velocity, longest);
    point(this.acceleration, local, motion.acceleration(t), this.mostAcceleration, shown.acceleration, longest);
    this.axes.visible = shown.axes && motion.turns;
    this.axes.position.copy(local);
    this.axes.quaternion.copy(turn);
    for (const axis of this.axes.children)
      stretch(axis, Math.max(kAxisReach * this.reach, kAxisPixels * size), 2 * kAxisPixels * size);

    this.showWay(t, local, shown.trails);
  }

  /** Where arrows and axes come to on the way, if the longest arrows are so long, in the drawing. */
  arrowTips(longest: number): THREE.Vector3[] {
    const { motion } = this;
    const { begin, end } = motion.track;
    const kTimes = 24;
    const tips: THREE.Vector3[] = [];
    for (let i = 0; i <= kTimes; ++i) {
      const t = begin + ((end - begin) * i) / kTimes;
      const place = this.frame.toView(motion.position(t)).add(this.offset);
      const add = (direction: Vector, most: number): void => {
        if (most > 0) tips.push(place.clone().addScaledVector(vector(direction), longest / most));
      };
      add(motion.velocity(t), this.mostSpeed);
      add(motion.acceleration(t), this.mostAcceleration);
      // axes come to any side of the body
      const axis = motion.turns ? Math.max(kAxisReach * this.reach, longest / 2) : 0;
      if (axis > 0)
        for (const side of [-axis, axis])
          tips.push(...[0, 1, 2].map((k) => place.clone().setComponent(k, place.getComponent(k) + side)));
    }
    return tips;
  }

  private showWay(t: number, local: THREE.Vector3, isShown: boolean): void {
    let low = 0;
    let high = this.times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    this.way.visible = isShown && low > 0;
    this.way.geometry.instanceCount = low;
    this.tip.visible = isShown;
    // both ends of the one line share a buffer
    const ends = (this.tip.geometry.getAttribute("instanceStart") as THREE.InterleavedBufferAttribute).data;
    this.points[low].toArray(ends.array, 0);
    local.toArray(ends.array, 3);
    ends.needsUpdate = true;
    this.wholeWay.visible = isShown;
  }
}

/** By how much the numbers that carry a body's orientation lengthen it at most, at least 1. */
function largestStretch(motion: BodyMotion): number {
  if (!motion.turns) return 1;
  const { begin, end } = motion.track;
  const kTimes = 64;
  let most = 1;
  for (let i = 0; i <= kTimes; ++i) {
    const m = motion.carriedMatrix(begin + ((end - begin) * i) / kTimes);
    for (let k = 0; k < 3; ++k) most = Math.max(most, Math.hypot(m[k], m[3 + k], m[6 + k]));
  }
  return most;
}

const largest = (values: number[]): number => values.reduce((most, value) => Math.max(most, value), 0);

function point(
  arrow: THREE.Group,
  at: THREE.Vector3,
  direction: Vector,
  most: number,
  isShown: boolean,
  longest: number,
): void {
  const size = length(direction);
  arrow.visible = isShown && size > 1e-9 * most && most > 0;
  if (!arrow.visible) return;
  arrow.position.copy(at);
  const unit = new THREE.Vector3(direction[0] / size, direction[1] / size, direction[2] / size);
  arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), unit);
  stretch(arrow, (longest * size) / most, longest);
}

/** An arrow of that length, as thick as one of the length `usual`, as long as it is longer than thick. */
function stretch(arrow: THREE.Object3D, drawn: number, usual: number): void {
  const thickness = Math.min(usual, 2 * drawn);
  arrow.scale.set(thickness, drawn, thickness);
}
