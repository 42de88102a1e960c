import * as THREE from "three";
import type { ObstacleData, ObstacleShape, Vector } from "./data";
import { Drive } from "./drive";
import { roundSpacing } from "./format";
import type { LabelSpec } from "./labels";
import { type Grid, gridLabels, heightScale } from "./scales";
import { vector } from "./shapes";
import { cssColor } from "./theme";
import { isSeenAlongRight, type ViewFrame } from "./view_frame";

/** Faces that meet at more than so many degrees have an edge between them. */
const kEdge = 20;
const kEdgeOfGround = 60;

/** A plane with a grid on it, in the world. `isSolid`: it is an obstacle, not a scale only. */
export interface Ground {
  point: THREE.Vector3;
  normal: THREE.Vector3;
  isSolid: boolean;
}

/** What an obstacle's motion carries along. */
interface Driven {
  drive: Drive;
  drawn: THREE.Object3D;
  /** Its text, and where that is at the start, m. */
  label?: { spec: LabelSpec; at: THREE.Vector3 };
}

/** Obstacles, and a grid that gives the scale. */
export class Scenery {
  readonly group = new THREE.Group();
  readonly labels: LabelSpec[] = [];
  readonly grounds: Ground[] = [];
  /** Obstacles that are no planes: what casts shadows. */
  readonly solids: THREE.Mesh[] = [];
  /** Where grid and scale of height end: the picture is to hold it. */
  readonly corners: THREE.Vector3[] = [];
  /** m; the side of a square of the grid. */
  readonly spacing: number;
  /** Of obstacles that are closed, which are seen from outside, and of flat ones. */
  private readonly closed: THREE.MeshLambertMaterial;
  private readonly hollow: THREE.MeshLambertMaterial;
  private readonly flat: THREE.MeshLambertMaterial;
  private readonly ground: THREE.MeshBasicMaterial;
  private readonly edges: THREE.LineBasicMaterial;
  private readonly lines: THREE.LineBasicMaterial;
  private readonly driven: Driven[] = [];

  constructor(
    private readonly frame: ViewFrame,
    obstacles: readonly ObstacleData[],
  ) {
    const size = frame.box.getSize(new THREE.Vector3());
    this.spacing = roundSpacing(Math.max(size.x, size.y, size.z) / 10);
    const offset = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    const pane = { transparent: true, opacity: 0.8, ...offset };
    this.closed = new THREE.MeshLambertMaterial(pane);
    // of a room, the walls behind what is inside
    this.hollow = new THREE.MeshLambertMaterial({ side: THREE.BackSide, ...pane });
    this.flat = new THREE.MeshLambertMaterial({ side: THREE.DoubleSide, forceSinglePass: true, ...pane });
    this.ground = new THREE.MeshBasicMaterial({
      side: THREE.DoubleSide,
      forceSinglePass: true,
      transparent: true,
      opacity: 0.5,
      depthWrite: false,
      ...offset,
    });
    this.edges = new THREE.LineBasicMaterial();
    this.lines = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.9 });

    for (const obstacle of obstacles) {
      const { shape } = obstacle;
      if (shape.kind !== "plane") {
        this.addObstacle(obstacle, shape);
        continue;
      }
      const ground = { point: vector(shape.point), normal: vector(shape.normal).normalize(), isSolid: true };
      if (obstacle.drive) this.addDriven(new Drive(obstacle.drive), this.surfaceOf(ground));
      else this.grounds.push(ground);
    }
    // Without a plane the grid lies beneath everything, as a scale only.
    if (this.grounds.length === 0) {
      const { up } = frame.axes;
      const point = frame.box.getCenter(new THREE.Vector3());
      point.addScaledVector(up, frame.box.min.dot(up) - point.dot(up));
      this.grounds.push({ point, normal: up.clone(), isSolid: false });
    }
    this.grounds.forEach((ground, index) => this.addGround(ground, index === 0));
  }

  applyTheme(): void {
    for (const surface of [this.closed, this.hollow, this.flat]) surface.color.set(cssColor("--obstacle"));
    this.edges.color.set(cssColor("--obstacle-edge"));
    this.ground.color.set(cssColor("--ground"));
    this.lines.color.set(cssColor("--grid"));
  }

  private addObstacle({ name, color, drive }: ObstacleData, shape: Exclude<ObstacleShape, { kind: "plane" }>): void {
    const geometry = obstacleGeometry(shape);
    const { scale } = this.frame;
    const { up } = this.frame.axes;
    const isClosed = shape.kind === "sphere" || shape.kind === "box" || (shape.kind === "mesh" && shape.closed);
    const isHollow = shape.kind === "mesh" && shape.hollow === true;
    const material = isHollow ? this.hollow : isClosed ? this.closed : this.flat;
    const mesh = new THREE.Mesh(geometry, color ? material.clone() : material);
    if (color) mesh.material.color.set(color);
    mesh.scale.setScalar(scale);
    const center: Vector =
      shape.kind === "triangle" ? shape.corners[0] : shape.kind === "mesh" ? shape.vertices[0] : shape.center;
    mesh.position.copy(this.frame.toView(center));
    // what is open is a ground: the facets of its slopes are no edges
    const isGround = shape.kind === "mesh" && !shape.closed;
    const outline = new THREE.LineSegments(new THREE.EdgesGeometry(geometry, isGround ? kEdgeOfGround : kEdge), this.edges);
    mesh.add(outline);
    mesh.name = name;
    this.solids.push(mesh);
    geometry.computeBoundingBox();
    const top = geometry.boundingBox!.max.dot(up);
    const label: LabelSpec = {
      at: mesh.position.clone().addScaledVector(up, top * scale),
      text: name,
      className: "label-obstacle",
      priority: 1,
    };
    this.labels.push(label);
    if (drive) this.addDriven(new Drive(drive), mesh, { spec: label, at: vector(center).addScaledVector(up, top) });
    else this.group.add(mesh);
  }

  private addDriven(drive: Drive, what: THREE.Object3D, label?: Driven["label"]): void {
    const drawn = new THREE.Group();
    drawn.add(what);
    this.group.add(drawn);
    this.driven.push({ drive, drawn, label });
  }

  /** Puts what moves to where it is at time t. */
  update(t: number): void {
    for (const { drive, drawn, label } of this.driven) {
      drive.move(drawn, this.frame, t);
      if (!label) continue;
      const { x, y, z } = drive.place(label.at, t);
      label.spec.at.copy(this.frame.toView([x, y, z]));
    }
  }

  /** A square of a plane that moves, as large as the picture. */
  private surfaceOf({ point, normal }: Ground): THREE.Mesh {
    const side = 10 * this.spacing * this.frame.scale;
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(side, side), this.ground);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    const { x, y, z } = new THREE.Plane()
      .setFromNormalAndCoplanarPoint(normal, point)
      .projectPoint(this.frame.box.getCenter(new THREE.Vector3()), new THREE.Vector3());
    mesh.position.copy(this.frame.toView([x, y, z]));
    return mesh;
  }

  /** A rectangle of whole squares under the picture, with scales if `isScale`. */
  private addGround({ point, normal: n, isSolid }: Ground, isScale: boolean): void {
    const { right, up, names } = this.frame.axes;
    const isLevel = Math.abs(n.dot(up)) > 0.999;
    const u = isLevel ? right.clone() : up.clone().cross(n).normalize();
    const v = n.clone().cross(u);
    // The grid's lines pass through the foot of the world's origin; (0, 0) is there.
    const origin = n.clone().multiplyScalar(point.dot(n));
    const range = (axis: THREE.Vector3): [number, number] => {
      const { min, max } = this.frame.box;
      let [low, high] = [Infinity, -Infinity];
      for (let corner = 0; corner < 8; ++corner) {
        const p = new THREE.Vector3(corner & 1 ? min.x : max.x, corner & 2 ? min.y : max.y, corner & 4 ? min.z : max.z);
        const value = p.sub(origin).dot(axis);
        [low, high] = [Math.min(low, value), Math.max(high, value)];
      }
      return [Math.floor(low / this.spacing - 0.25), Math.ceil(high / this.spacing + 0.25)];
    };
    const [u0, u1] = range(u);
    const [v0, v1] = range(v);
    const at = (i: number, j: number): THREE.Vector3 => {
      const p = origin.clone().addScaledVector(u, i * this.spacing).addScaledVector(v, j * this.spacing);
      return this.frame.toView([p.x, p.y, p.z]);
    };
    const ends: THREE.Vector3[] = [];
    for (let i = u0; i <= u1; ++i) ends.push(at(i, v0), at(i, v1));
    for (let j = v0; j <= v1; ++j) ends.push(at(u0, j), at(u1, j));
    this.group.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(ends), this.lines));
    if (isSolid) {
      const corners = [at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v0), at(u1, v1), at(u0, v1)];
      this.group.add(new THREE.Mesh(new THREE.BufferGeometry().setFromPoints(corners), this.ground));
    }
    this.corners.push(at(u0, v0), at(u1, v0), at(u0, v1), at(u1, v1));
    const level = isLevel ? ([names[0], names[1]] as [string, string]) : null;
    if (isScale) this.addScales({ spacing: this.spacing, u0, u1, v0, v1, at, names: level }, point.dot(up));
  }

  /** `bottom`: m, how high the grid lies. */
  private addScales(grid: Grid, bottom: number): void {
    const { axes, box, scale } = this.frame;
    const alongRight = isSeenAlongRight(this.frame);
    this.labels.push(...gridLabels(grid, alongRight));
    const height = grid.names && heightScale(grid, alongRight, bottom, box.max.dot(axes.up), scale, axes);
    if (!height) return;
    this.group.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(height.lines), this.edges));
    this.labels.push(...height.labels);
    this.corners.push(height.top);
  }
}

/** An obstacle about its centre (a triangle or a mesh about its first corner), in metres. */
function obstacleGeometry(shape: Exclude<ObstacleShape, { kind: "plane" }>): THREE.BufferGeometry {
  switch (shape.kind) {
    case "sphere":
      return new THREE.SphereGeometry(shape.radius, 48, 32);
    case "disk": {
      const toNormal = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), vector(shape.normal));
      return new THREE.CircleGeometry(shape.radius, 64).applyQuaternion(toNormal);
    }
    case "rectangle": {
      const [normal, up] = [vector(shape.normal), vector(shape.up)];
      const axes = new THREE.Matrix4().makeBasis(up.clone().cross(normal), up, normal);
      return new THREE.PlaneGeometry(shape.width, shape.height).applyMatrix4(axes);
    }
    case "triangle": {
      const [a, b, c] = shape.corners.map(vector);
      const geometry = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), b.sub(a), c.sub(a)]);
      geometry.computeVertexNormals();
      return geometry;
    }
    case "mesh": {
      const corners = shape.triangles.flatMap((triangle) => triangle.map((corner) => vector(shape.vertices[corner])));
      const origin = vector(shape.vertices[0]);
      const geometry = new THREE.BufferGeometry().setFromPoints(corners.map((corner) => corner.sub(origin)));
      geometry.computeVertexNormals();
      return geometry;
    }
    case "box": {
      const [x, y, z] = shape.axes.map(vector);
      return new THREE.BoxGeometry(...shape.size).applyMatrix4(new THREE.Matrix4().makeBasis(x, y, z));
    }
  }
}
