import * as THREE from "three";
import { arrow, arrowPixels, point, stretch } from "./arrows";
import type { Vector } from "./data";
import { dots } from "./drawing";
import type { BodyMotion } from "./motion";
import { trailOf } from "./sampling";
import { bodyGeometry, reach, vector } from "./shapes";
import { kComponentColors, kPalette, kQuantityColors } from "./theme";
import { type Tail, trailLine, WholeTrail } from "./trail_line";
import { length } from "./vectors";
import { kViewSize, type ViewFrame } from "./view_frame";

/** What is drawn of a body. */
export interface Visibility {
  trails: boolean;
  velocity: boolean;
  acceleration: boolean;
  axes: boolean;
}

/** How a body is drawn: its colour, that of its points where they have their own, and how many others there are. */
export interface Look {
  color: string;
  hasPointColors: boolean;
  isOneOfMany: boolean;
}

/** The length of a body's axes, in how far the body reaches. */
const kAxisReach = 1.4;
/** px: the least length of a body's axes, and the size of a body too small to see. */
const kAxisPixels = 45;
const kDotPixels = 9;
/** px */
const kTrailWidth = 3;
const kPointTrailWidth = 2;
/** Of a run in more pieces, points leave no trails. */
const kMostPieces = 50000;

/** A body with all that is drawn of it. */
export class Actor {
  readonly group = new THREE.Group();
  /** The body itself, as it stands. */
  readonly body3d = new THREE.Group();
  private readonly dot: THREE.Points;
  private readonly velocity = arrow(kQuantityColors.velocity);
  private readonly acceleration = arrow(kQuantityColors.acceleration);
  private readonly axes = new THREE.Group();
  private readonly trail: WholeTrail;
  private readonly pointTrails: { position: Vector; line: WholeTrail | Tail }[];
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
    private readonly look: Look,
  ) {
    this.reach = reach(motion.data) * frame.scale;
    this.widest = this.reach * largestStretch(motion);
    const trail = trailOf(motion, this.tolerance);
    this.mostSpeed = largest(trail.times.map((t) => length(motion.velocity(t))));
    this.mostAcceleration = largest(trail.times.map((t) => length(motion.acceleration(t))));
    this.trail = new WholeTrail(
      { times: trail.times, points: trail.points.map((each) => frame.toView(each)) },
      look.color,
      kTrailWidth,
    );
    this.addShape();
    this.pointTrails = this.addPoints();
    this.body3d.matrixAutoUpdate = false;
    this.dot = dots([new THREE.Vector3()], look.color, kDotPixels);
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
    const trails = [this.trail, ...this.pointTrails.map(({ line }) => line)].map(({ group }) => group);
    this.group.add(this.body3d, this.dot, this.velocity, this.acceleration, this.axes, ...trails);
  }

  /** m; how well trails follow ways. */
  private get tolerance(): number {
    return (1e-4 * kViewSize) / this.frame.scale;
  }

  private addShape(): void {
    const { data, turns } = this.motion;
    const geometry = bodyGeometry(data.shape, this.look.color, turns, this.look.isOneOfMany);
    if (!geometry) return;
    this.body3d.add(new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true })));
    if (data.shape.kind === "sphere") return;
    const edges = new THREE.EdgesGeometry(geometry, 15);
    const material = new THREE.LineBasicMaterial({ color: "#1d1d22", transparent: true, opacity: 0.6 });
    this.body3d.add(new THREE.LineSegments(edges, material));
  }

  /**
   * Named points as dots, and, of a body without a shape, rods to them from the centre of mass. Returns their trails, of
   * those that do not go where the centre goes.
   */
  private addPoints(): { position: Vector; line: WholeTrail | Tail }[] {
    const { points, shape } = this.motion.data;
    const { Mesh, SphereGeometry, CylinderGeometry, MeshLambertMaterial, Vector3, Quaternion } = THREE;
    const thickness = 0.035 * reach(this.motion.data);
    const own = new MeshLambertMaterial({ color: this.look.color });
    const trails: { position: Vector; line: WholeTrail | Tail }[] = [];
    points.forEach(({ position }, i) => {
      const color = this.look.hasPointColors ? kPalette[(i + 1) % kPalette.length] : this.look.color;
      const end = vector(position);
      const dot = new Mesh(new SphereGeometry(1.4 * thickness, 20, 14), new MeshLambertMaterial({ color }));
      dot.position.copy(end);
      this.body3d.add(dot);
      if (end.length() === 0) return;
      if (this.motion.turns && this.motion.track.count <= kMostPieces) {
        const { times, points: places } = trailOf(this.motion, this.tolerance, position);
        const way = { times, points: places.map((each) => this.frame.toView(each)) };
        trails.push({ position, line: trailLine(way, color, kPointTrailWidth) });
      }
      if (shape.kind !== "point") return;
      const rod = new Mesh(new CylinderGeometry(thickness, thickness, end.length(), 20), own);
      rod.position.copy(end).multiplyScalar(0.5);
      rod.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), end.clone().normalize()));
      this.body3d.add(rod);
    });
    return trails;
  }

  /** Whether the body is so small in the picture that a dot stands for it. */
  get isDot(): boolean {
    return this.dot.visible;
  }

  /** How far from the centre arrows begin: at the surface of a solid, in which they could not be seen. */
  private get arrowStart(): number {
    return this.motion.data.shape.kind === "point" ? 0 : this.reach;
  }

  /**
   * Puts everything where it is at time t. `pixel`: the size of a pixel of the screen at a place of the drawing;
   * `pictureSize`: px, of the picture's smaller side.
   */
  update(t: number, shown: Visibility, pixel: (at: THREE.Vector3) => number, pictureSize: number): void {
    const { motion } = this;
    const local = this.frame.toView(motion.position(t));
    this.place.copy(local).add(this.offset);
    this.top.copy(this.place).addScaledVector(this.frame.axes.up, this.widest);
    this.foot.copy(this.place).addScaledVector(this.frame.axes.up, -this.widest);
    const size = pixel(this.place);
    const s = this.frame.scale;
    const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = motion.carriedMatrix(t).map((each) => s * each);
    this.body3d.matrix.set(xx, xy, xz, local.x, yx, yy, yz, local.y, zx, zy, zz, local.z, 0, 0, 0, 1);
    this.body3d.matrixWorldNeedsUpdate = true;
    this.dot.position.copy(local);
    this.dot.visible = this.reach < 0.5 * kDotPixels * size;

    const longest = arrowPixels(pictureSize) * size;
    this.velocity.visible = this.acceleration.visible = false;
    if (shown.velocity) point(this.velocity, local, motion.velocity(t), this.mostSpeed, longest, this.arrowStart);
    if (shown.acceleration)
      point(this.acceleration, local, motion.acceleration(t), this.mostAcceleration, longest, this.arrowStart);
    this.showAxes(t, local, shown.axes, size);
    this.trail.group.visible = shown.trails;
    if (shown.trails) this.trail.update(t, local);
    for (const { position, line } of this.pointTrails) {
      line.group.visible = shown.trails;
      if (shown.trails) line.update(t, this.frame.toView(motion.pointPosition(position, t)));
    }
  }

  private showAxes(t: number, local: THREE.Vector3, isShown: boolean, pixel: number): void {
    this.axes.visible = isShown && this.motion.turns;
    if (!this.axes.visible) return;
    const [w, x, y, z] = this.motion.orientation(t);
    this.axes.position.copy(local);
    this.axes.quaternion.set(x, y, z, w);
    for (const axis of this.axes.children)
      stretch(axis, Math.max(kAxisReach * this.reach, kAxisPixels * pixel), 2 * kAxisPixels * pixel);
  }

  /** Where arrows and axes come to on the way, if the longest arrows are so long, in the drawing. */
  arrowTips(longest: number): THREE.Vector3[] {
    const { begin, end } = this.motion.track;
    const kTimes = 24;
    return Array.from({ length: kTimes + 1 }, (_, i) =>
      this.tipsAt(begin + ((end - begin) * i) / kTimes, longest),
    ).flat();
  }

  private tipsAt(t: number, longest: number): THREE.Vector3[] {
    const { motion } = this;
    const tips: THREE.Vector3[] = [];
    const place = this.frame.toView(motion.position(t)).add(this.offset);
    const add = (direction: Vector, most: number): void => {
      const size = length(direction);
      if (!(most > 0 && size > 0)) return;
      const far = this.arrowStart + (longest * size) / most;
      tips.push(place.clone().addScaledVector(vector(direction), far / size));
    };
    add(motion.velocity(t), this.mostSpeed);
    add(motion.acceleration(t), this.mostAcceleration);
    // axes come to any side of the body
    const axis = motion.turns ? Math.max(kAxisReach * this.reach, longest / 2) : 0;
    if (axis > 0)
      for (const side of [-axis, axis])
        tips.push(...[0, 1, 2].map((k) => place.clone().setComponent(k, place.getComponent(k) + side)));
    return tips;
  }

  /** How far the body and what is drawn at it reach from its centre, if the longest arrows are so long. */
  reachWithArrows(longest: number): number {
    const hasArrow = this.mostSpeed > 0 || this.mostAcceleration > 0;
    const axis = this.motion.turns ? kAxisReach * this.reach : 0;
    return Math.max(this.widest, axis, hasArrow ? this.arrowStart + longest : 0);
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
