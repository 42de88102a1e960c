import * as THREE from "three";
import type { Actor } from "./actor";
import { dots } from "./drawing";
import type { Ground } from "./scenery";
import { type Axes, kAxes, kViewSize, type ViewFrame } from "./view_frame";

/** Where the light goes while it goes down by 1: little, so that a shadow tells where a body is over the ground. */
const kSlant = new THREE.Vector2(0.15, 0.25);
/** How far from beneath a body its shadow falls at most, in squares of the grid. */
const kMostSquares = 0.6;
/** A ground that is steeper takes no shadows: the least upward part of its unit normal. */
const kLeastUp = 0.3;
/** How far over the ground shadows lie, in the drawing. */
const kLift = 1e-4 * kViewSize;
/** px; the shadow of a body too small to see. */
const kDotPixels = 8;

/** The ground that shadows fall on: the most level one; null where all are steep. */
export function shadowedGround(grounds: readonly Ground[], { up }: Axes = kAxes.z): Ground | null {
  const rise = ({ normal }: Ground): number => normal.dot(up);
  const level = grounds.filter((each) => rise(each) > kLeastUp);
  return level.length === 0 ? null : level.reduce((best, each) => (rise(each) > rise(best) ? each : best));
}

/** What carries a point of the drawing along `light` to the plane n·x = d. */
export function projection(n: THREE.Vector3, d: number, light: THREE.Vector3): THREE.Matrix4 {
  const l = light.clone().divideScalar(light.dot(n));
  return new THREE.Matrix4().set(
    1 - l.x * n.x, -l.x * n.y, -l.x * n.z, l.x * d,
    -l.y * n.x, 1 - l.y * n.y, -l.y * n.z, l.y * d,
    -l.z * n.x, -l.z * n.y, 1 - l.z * n.z, l.z * d,
    0, 0, 0, 1,
  ); // prettier-ignore
}

/** The way of the light in a scene of that height, in squares of the grid. */
export function lightOver(squares: number, { right, away, up }: Axes = kAxes.z): THREE.Vector3 {
  const slant = kSlant.clone().multiplyScalar(Math.min(1, kMostSquares / (kSlant.length() * squares || 1)));
  return up.clone().negate().addScaledVector(right, slant.x).addScaledVector(away, slant.y).normalize();
}

interface Cast {
  source: THREE.Mesh;
  shadow: THREE.Mesh;
}

/**
 * Shadows of bodies and obstacles on the ground: their own meshes, flattened along the light. That costs one more drawing
 * of each, and no picture of the depth seen from the light.
 */
export class Shadows {
  readonly group = new THREE.Group();
  /** Where shadows overlap, the stencil lets the first one through only. */
  private readonly material = new THREE.MeshBasicMaterial({
    color: "#000000",
    transparent: true,
    depthWrite: false,
    stencilWrite: true,
    stencilRef: 1,
    stencilFunc: THREE.NotEqualStencilFunc,
    stencilZPass: THREE.ReplaceStencilOp,
  });
  private readonly still: Cast[];
  private readonly moving: { actor: Actor; casts: Cast[]; dot: ReturnType<typeof dots> }[];
  private readonly normal: THREE.Vector3;
  /** Of the ground, in the drawing: n·x. */
  private readonly height: number;
  private readonly flatten: THREE.Matrix4;

  /** `spacing`: m, of the grid. */
  constructor(frame: ViewFrame, spacing: number, ground: Ground, solids: readonly THREE.Mesh[], actors: readonly Actor[]) {
    this.normal = ground.normal;
    const { x, y, z } = ground.point;
    this.height = frame.toView([x, y, z]).dot(this.normal);
    const { up } = frame.axes;
    const light = lightOver((frame.box.max.dot(up) - frame.box.min.dot(up)) / spacing, frame.axes);
    this.flatten = projection(this.normal, this.height + kLift, light);
    this.still = solids.map((source) => this.cast(source));
    this.moving = actors.map((actor) => {
      const casts: Cast[] = [];
      actor.body3d.traverse((each) => {
        if (each instanceof THREE.Mesh) casts.push(this.cast(each));
      });
      const dot = dots([new THREE.Vector3()], "#000000", kDotPixels);
      dot.material.transparent = true;
      dot.material.depthWrite = false;
      this.group.add(dot);
      return { actor, casts, dot };
    });
  }

  private cast(source: THREE.Mesh): Cast {
    const shadow = new THREE.Mesh(source.geometry, this.material);
    shadow.matrixAutoUpdate = false;
    shadow.frustumCulled = false;
    shadow.renderOrder = 1;
    this.group.add(shadow);
    return { source, shadow };
  }

  set opacity(opacity: number) {
    this.material.opacity = opacity;
    for (const { dot } of this.moving) {
      dot.material.opacity = opacity;
      dot.material.alphaTest = 0.5 * opacity;
    }
  }

  /** Puts all shadows where they fall now. Nothing that is under the ground has one. */
  update(): void {
    for (const each of this.still) this.place(each);
    for (const { actor, casts, dot } of this.moving) {
      const isOver = isShown(actor.group) && actor.place.dot(this.normal) > this.height;
      for (const each of casts) {
        each.shadow.visible = isOver && !actor.isDot;
        if (each.shadow.visible) this.place(each);
      }
      dot.visible = isOver && actor.isDot;
      dot.position.copy(actor.place).applyMatrix4(this.flatten);
    }
  }

  private place({ source, shadow }: Cast): void {
    source.updateWorldMatrix(true, false);
    shadow.matrix.multiplyMatrices(this.flatten, source.matrixWorld);
    shadow.matrixWorldNeedsUpdate = true;
  }
}

function isShown(object: THREE.Object3D): boolean {
  for (let each: THREE.Object3D | null = object; each; each = each.parent) if (!each.visible) return false;
  return true;
}
