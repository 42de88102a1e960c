import type { BodyData, RunData, Vector } from "./data";
import { type Moment, momentsOf } from "./moments";
import { startTrack } from "./start";
import { Track } from "./track";
import { dot, length, sum } from "./vectors";

/** How a body stands at one time: unit quaternion (w, x, y, z), from the body's frame to the world. */
export type Quaternion = [number, number, number, number];

/** One body of a run, at any time. */
export class BodyMotion {
  constructor(
    readonly data: BodyData,
    readonly track: Track,
  ) {}

  get name(): string {
    return this.data.name;
  }
  get turns(): boolean {
    return this.data.rotation !== undefined;
  }

  /** `piece`: the one that stands for t, unless the value just before a jump is wanted. */
  position(t: number, piece = this.track.pieceAt(t)): Vector {
    return this.track.vector(piece, this.data.position, t);
  }
  velocity(t: number, piece = this.track.pieceAt(t)): Vector {
    return this.track.vector(piece, this.data.velocity, t);
  }
  acceleration(t: number, piece = this.track.pieceAt(t)): Vector {
    return this.track.vector(piece, this.data.velocity, t, 1);
  }

  /** Of the named point at `p` in the body's frame. */
  pointPosition(p: Vector, t: number, piece = this.track.pieceAt(t)): Vector {
    return sum(this.position(t, piece), rotated(this.orientation(t, piece), p));
  }

  orientation(t: number, piece = this.track.pieceAt(t)): Quaternion {
    const { rotation } = this.data;
    if (!rotation) return this.data.attitude;
    const component = rotation.component;
    if (rotation.kind === "matrix") return quaternionOfMatrix(this.components(t, piece, component, 9));
    const q = normalized(this.components(t, piece, component, 4) as Quaternion);
    if (rotation.kind === "quaternion") return q;
    const added = quaternionOfRotationVector(this.track.vector(piece, component + 4, t));
    return rotation.frame === "world" ? product(added, q) : product(q, added);
  }

  /**
   * What carries the body's frame into the world as the numbers have it, row by row: not quite a rotation where the method
   * lets |q| or det R drift; the body then grows or shrinks.
   */
  carriedMatrix(t: number, piece = this.track.pieceAt(t)): number[] {
    const { rotation } = this.data;
    if (rotation?.kind === "matrix") return this.components(t, piece, rotation.component, 9);
    const q = this.orientation(t, piece);
    // q v q* of a quaternion that is not unit stretches by |q|^2
    const stretch = (1 + this.orientationDefect(t, piece)) ** 2;
    const columns = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as Vector[]).map((axis) => rotated(q, axis)); // prettier-ignore
    return [0, 1, 2].flatMap((row) => columns.map((column) => stretch * column[row]));
  }

  /** rad/s, world frame. */
  angularVelocity(t: number, piece = this.track.pieceAt(t)): Vector {
    const { rotation } = this.data;
    if (!rotation) return [0, 0, 0];
    const w = this.track.vector(piece, rotation.angular_velocity, t);
    return rotation.frame === "world" ? w : rotated(this.orientation(t, piece), w);
  }

  /** How far the orientation as it is carried has left the rotations: |q| - 1, or det R - 1. */
  orientationDefect(t: number, piece = this.track.pieceAt(t)): number {
    const { rotation } = this.data;
    if (!rotation) return 0;
    if (rotation.kind === "matrix") return determinant(this.components(t, piece, rotation.component, 9)) - 1;
    return Math.hypot(...this.components(t, piece, rotation.component, 4)) - 1;
  }

  /** Kinetic energy of the translation, J; per kg of the body, J/kg, where its mass is not known. */
  translationEnergy(t: number, piece = this.track.pieceAt(t)): number {
    const v = this.velocity(t, piece);
    return 0.5 * (this.data.mass ?? 1) * dot(v, v);
  }

  /** In the constant field of acceleration that the body is in, against the origin; J or J/kg likewise. */
  potentialEnergy(t: number, piece = this.track.pieceAt(t)): number {
    return this.data.field ? -(this.data.mass ?? 1) * dot(this.data.field, this.position(t, piece)) : 0;
  }

  /** J; 0 where the inertia is not known. */
  rotationEnergy(t: number, piece = this.track.pieceAt(t)): number {
    const inertia = this.data.rotation?.inertia;
    if (!inertia) return 0;
    const [w, x, y, z] = this.orientation(t, piece);
    const inBody = rotated([w, -x, -y, -z], this.angularVelocity(t, piece));
    return 0.5 * inBody.reduce((sum, each, i) => sum + each * dot(inertia[i], inBody), 0);
  }

  private components(t: number, piece: number, first: number, count: number): number[] {
    return Array.from({ length: count }, (_, i) => this.track.value(piece, first + i, t));
  }
}

/** Hamilton's product a b. */
export function product(a: Quaternion, b: Quaternion): Quaternion {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

/** q v q*, of a unit quaternion. */
export function rotated(q: Quaternion, v: Vector): Vector {
  const [, x, y, z] = product(product(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]);
  return [x, y, z];
}

/** The rotation by |u| about u. */
export function quaternionOfRotationVector(u: Vector): Quaternion {
  const angle = length(u);
  const factor = angle === 0 ? 0.5 : Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), factor * u[0], factor * u[1], factor * u[2]];
}

function normalized(q: Quaternion): Quaternion {
  const norm = Math.hypot(...q) || 1;
  return [q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm];
}

/** m: the rows one after the other. */
function determinant(m: number[]): number {
  return (
    m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6])
  );
}

/** The rotation of a matrix, rows one after the other, scaled to determinant one: [Shepperd 1978]. */
export function quaternionOfMatrix(m: number[]): Quaternion {
  const scale = Math.cbrt(determinant(m)) || 1;
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = m.map((each) => each / scale);
  const trace = xx + yy + zz;
  if (trace >= Math.max(xx, yy, zz)) return normalized([1 + trace, zy - yz, xz - zx, yx - xy]);
  if (xx >= Math.max(yy, zz)) return normalized([zy - yz, 1 + 2 * xx - trace, xy + yx, xz + zx]);
  if (yy >= zz) return normalized([xz - zx, xy + yx, 1 + 2 * yy - trace, yz + zy]);
  return normalized([yx - xy, xz + zx, yz + zy, 1 + 2 * zz - trace]);
}

/** A run: all its bodies and further states, between `begin` and `end`. */
export class Run {
  /** What tells it from the other runs of the page. */
  name: string;
  readonly bodies: BodyMotion[];
  readonly states: { name: string; value: (t: number, piece?: number) => number; track: Track }[];
  readonly begin: number;
  readonly end: number;
  /** Its impacts and events, in the order of time. */
  readonly moments: Moment[];

  constructor(readonly data: RunData) {
    this.name = data.report.method;
    const tracks = data.groups.map(({ pieces, dimension }, group) => {
      const track = Track.decode(pieces, dimension);
      return track.count > 0 ? track : startTrack(data, group);
    });
    this.bodies = data.bodies.map((body) => new BodyMotion(body, tracks[body.group]));
    this.states = data.states.map((state) => {
      const track = tracks[state.group];
      return {
        name: state.name,
        track,
        value: (t: number, piece = track.pieceAt(t)) => track.value(piece, state.component, t),
      };
    });
    this.begin = Math.min(data.report.start_time, data.report.end_time);
    this.end = Math.max(data.report.start_time, data.report.end_time);
    this.moments = momentsOf(data.report);
  }

  /** rad/s; of all bodies at the times looked at, which are some hundreds. */
  get fastestSpin(): number {
    const kTimes = 400;
    let most = 0;
    for (const body of this.bodies.filter(({ turns }) => turns))
      for (let i = 0; i <= kTimes; ++i) {
        const size = length(body.angularVelocity(this.begin + ((this.end - this.begin) * i) / kTimes));
        if (size > most && Number.isFinite(size)) most = size;
      }
    return most;
  }
  body(name: string): BodyMotion | undefined {
    return this.bodies.find((body) => body.name === name);
  }
}

/** The runs of a page, named after what they differ in: the method, the way of carrying orientations, or both. */
export function namedRuns(data: readonly RunData[]): Run[] {
  const runs = data.map((each) => new Run(each));
  const count = (of: (each: RunData) => string | null): number => new Set(data.map(of)).size;
  const hasMethods = count(({ report }) => report.method) > 1;
  if (count(({ orientation }) => orientation) > 1)
    for (const run of runs)
      run.name = hasMethods ? `${run.data.report.method}, ${run.data.orientation}` : (run.data.orientation ?? run.name);
  return runs;
}
