import type { BodyData, Impact, RunData, Vector } from "./data";
import { Track } from "./track";

/** How a body stands at one time: unit quaternion (w, x, y, z), from the body's frame to the world. */
export type Quaternion = [number, number, number, number];

export const length = (v: Vector): number => Math.hypot(v[0], v[1], v[2]);

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
    return this.data.orientation !== undefined;
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

  orientation(t: number, piece = this.track.pieceAt(t)): Quaternion {
    const orientation = this.data.orientation;
    if (!orientation) return [1, 0, 0, 0];
    const values = this.components(t, piece, orientation.kind === "matrix" ? 9 : 4);
    return orientation.kind === "matrix" ? quaternionOfMatrix(values) : normalized(values as Quaternion);
  }

  /** How far the orientation as it is carried has left the rotations: |q| - 1, or det R - 1. */
  orientationDefect(t: number, piece = this.track.pieceAt(t)): number {
    const orientation = this.data.orientation;
    if (!orientation) return 0;
    if (orientation.kind === "quaternion") return Math.hypot(...this.components(t, piece, 4)) - 1;
    return determinant(this.components(t, piece, 9)) - 1;
  }

  /** J; per kg of the body, J/kg, where its mass is not known. Of the rotation too where the inertia is known. */
  kineticEnergy(t: number, piece = this.track.pieceAt(t)): number {
    const v = this.velocity(t, piece);
    return 0.5 * (this.data.mass ?? 1) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }

  private components(t: number, piece: number, count: number): number[] {
    const first = this.data.orientation!.component;
    return Array.from({ length: count }, (_, i) => this.track.value(piece, first + i, t));
  }
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
  readonly bodies: BodyMotion[];
  readonly states: { name: string; value: (t: number, piece?: number) => number; track: Track }[];
  readonly begin: number;
  readonly end: number;

  constructor(readonly data: RunData) {
    const tracks = data.groups.map((group) => Track.decode(group.pieces, group.dimension));
    // A run that ended where it began has no pieces, and nothing to show.
    this.bodies = data.bodies
      .filter((body) => tracks[body.group].count > 0)
      .map((body) => new BodyMotion(body, tracks[body.group]));
    this.states = data.states
      .filter((state) => tracks[state.group].count > 0)
      .map((state) => {
        const track = tracks[state.group];
        return {
          name: state.name,
          track,
          value: (t: number, piece = track.pieceAt(t)) => track.value(piece, state.component, t),
        };
      });
    this.begin = Math.min(data.report.start_time, data.report.end_time);
    this.end = Math.max(data.report.start_time, data.report.end_time);
  }

  get name(): string {
    return this.data.report.method;
  }
  get impacts(): Impact[] {
    return this.data.report.impacts;
  }
  body(name: string): BodyMotion | undefined {
    return this.bodies.find((body) => body.name === name);
  }
}
