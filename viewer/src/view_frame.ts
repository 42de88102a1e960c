import * as THREE from "three";
import type { ObstacleShape, Vector } from "./data";
import { Drive } from "./drive";
import type { BodyMotion, Run } from "./motion";
import { trailOf } from "./sampling";
import { reach, vector } from "./shapes";

/** The scene is drawn about this large, whatever its size in metres, so that single precision is enough. */
export const kViewSize = 10;

/** The axes of the world as a picture has them: two level ones, and the one that points up. */
export interface Axes {
  right: THREE.Vector3;
  away: THREE.Vector3;
  up: THREE.Vector3;
  /** Of the three. */
  names: readonly [string, string, string];
}

const [kX, kY, kZ] = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, 1)];

/** By the axis that points up. */
export const kAxes: Record<"y" | "z", Axes> = {
  y: { right: kZ, away: kX, up: kY, names: ["z", "x", "y"] },
  z: { right: kX, away: kY, up: kZ, names: ["x", "y", "z"] },
};

/** From metres in the world to the units of the drawing: p -> (p - center) * scale. */
export class ViewFrame {
  readonly scale: number;
  readonly center: Vector;

  constructor(
    readonly box: THREE.Box3,
    readonly axes: Axes = kAxes.z,
  ) {
    const center = box.getCenter(new THREE.Vector3());
    this.center = [center.x, center.y, center.z];
    const size = box.getSize(new THREE.Vector3());
    this.scale = kViewSize / (Math.max(size.x, size.y, size.z) || 1);
  }

  toView(p: Vector): THREE.Vector3 {
    return new THREE.Vector3(
      (p[0] - this.center[0]) * this.scale,
      (p[1] - this.center[1]) * this.scale,
      (p[2] - this.center[2]) * this.scale,
    );
  }
}

/** Whether a scene is looked at along `right`, rather than along `away`, so that its longer side goes from left to right. */
export function isSeenAlongRight({ box, axes }: ViewFrame): boolean {
  const size = box.getSize(new THREE.Vector3());
  return size.dot(axes.away) > size.dot(axes.right);
}

/**
 * The place from which a camera of these half angles (as tangents) sees all points, looking against `away`: what it looks
 * at, as deep in the picture as `middle`, and how far away from that it is. What is nearer looks larger, so that the
 * middle of the points is not the middle of what is seen of them: margins are as wide on the left as on the right, and
 * above as below.
 */
export function cameraPlace(
  points: readonly THREE.Vector3[],
  middle: THREE.Vector3,
  away: THREE.Vector3,
  halfAngles: { horizontal: number; vertical: number },
  upward: THREE.Vector3 = kZ,
): { target: THREE.Vector3; distance: number } {
  const side = upward.clone().cross(away).normalize();
  const up = away.clone().cross(side);
  const depth = middle.dot(away);
  const target = away.clone().multiplyScalar(depth);
  let distance = 0;
  // Of a camera at (c, d) across and along `away`, a point at (x, z) is inside where |x - c| <= (d - z) tan.
  for (const [axis, tangent] of [[side, halfAngles.horizontal], [up, halfAngles.vertical]] as const) {
    const most = (sign: number): number =>
      Math.max(...points.map((point) => sign * point.dot(axis) + point.dot(away) * tangent));
    const [right, left] = [most(1), most(-1)];
    target.addScaledVector(axis, (right - left) / 2);
    distance = Math.max(distance, (right + left) / (2 * tangent) - depth);
  }
  return { target, distance };
}

function obstacleBox(shape: ObstacleShape): THREE.Box3 | null {
  switch (shape.kind) {
    case "plane":
      return null;
    case "triangle":
      return new THREE.Box3().setFromPoints(shape.corners.map(vector));
    case "mesh":
      return new THREE.Box3().setFromPoints(shape.vertices.map(vector));
    case "rectangle": {
      const reach = 0.5 * Math.hypot(shape.width, shape.height);
      return ball(shape.center, reach);
    }
    case "box":
      return ball(shape.center, 0.5 * Math.hypot(...shape.size));
    default:
      return ball(shape.center, shape.radius);
  }
}

const ball = (center: Vector, radius: number): THREE.Box3 =>
  new THREE.Box3().setFromCenterAndSize(vector(center), new THREE.Vector3(2, 2, 2).multiplyScalar(radius));

/** Obstacles that are this much larger than the motion do not set the picture's size. */
const kLargestObstacle = 3;

/** The point of a plane nearest to the middle of a box. */
function footOn({ point, normal }: { point: Vector; normal: Vector }, box: THREE.Box3): THREE.Vector3 {
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(vector(normal).normalize(), vector(point));
  return plane.projectPoint(box.getCenter(new THREE.Vector3()), new THREE.Vector3());
}

/**
 * What the picture shall hold, in metres: all ways, and the obstacles near them; of runs of no duration, which have no
 * ways, all obstacles.
 */
export function sceneBox(runs: readonly Run[]): THREE.Box3 {
  const box = new THREE.Box3();
  for (const run of runs)
    for (const body of run.bodies) {
      const coarse = trailOf(body, 0.01 * roughSize(body, run));
      const extra = reach(body.data);
      for (const point of coarse.points) box.union(ball(point, extra));
    }
  if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
  const size = box.getSize(new THREE.Vector3());
  const largest = Math.max(size.x, size.y, size.z);
  const bodies = box.clone();
  const isStill = runs.every((run) => run.begin === run.end);
  for (const obstacle of runs[0]?.data.obstacles ?? []) {
    const own = obstacleBox(obstacle.shape);
    if (isStill && obstacle.shape.kind === "plane") box.expandByPoint(footOn(obstacle.shape, bodies));
    if (!own) continue;
    const ownSize = own.getSize(new THREE.Vector3());
    if (!isStill && Math.max(ownSize.x, ownSize.y, ownSize.z) > kLargestObstacle * largest) continue;
    box.union(own);
    if (obstacle.drive) box.union(sweptBox(own, new Drive(obstacle.drive), runs[0]));
  }
  // A body at rest needs a picture of some size too.
  if (box.getSize(new THREE.Vector3()).length() === 0) box.expandByScalar(1);
  return box;
}

/** What holds an obstacle all along its way. */
function sweptBox(start: THREE.Box3, drive: Drive, run: Run): THREE.Box3 {
  const box = new THREE.Box3();
  const reach = 0.5 * start.getSize(new THREE.Vector3()).length();
  const middle = start.getCenter(new THREE.Vector3());
  for (let i = 0; i <= 300; ++i) {
    const { x, y, z } = drive.place(middle, run.begin + ((run.end - run.begin) * i) / 300);
    box.union(ball([x, y, z], reach));
  }
  return box;
}

/** The span of a body's way as a few hundred points tell it. */
function roughSize(body: BodyMotion, run: Run): number {
  const box = new THREE.Box3();
  for (let i = 0; i <= 300; ++i) box.expandByPoint(vector(body.position(run.begin + ((run.end - run.begin) * i) / 300)));
  const size = box.getSize(new THREE.Vector3());
  return Math.max(size.x, size.y, size.z) || 1;
}
