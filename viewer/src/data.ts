/** What the program writes into the page: docs/formats/page.md. SI units; world frame. */

export type Vector = [number, number, number];

export interface Report {
  title: string;
  scene: string;
  method: string;
  status: "finished" | "stopped" | "failed" | "interrupted";
  failure?: string;
  start_time: number;
  end_time: number;
  /** Name to value, in SI units. */
  parameters: Record<string, number>;
  impacts: Impact[];
  events: SceneEvent[];
  warnings: string[];
  statistics: Record<string, number>;
  /** How each body is at the end. */
  final: FinalState[];
  states: Record<string, number>;
}

export interface FinalState {
  body: string;
  position: Vector;
  velocity: Vector;
  /** null, as all numbers that are not finite. */
  acceleration: (number | null)[];
  /** (w, x, y, z) */
  orientation: [number, number, number, number];
  rotation_matrix: [Vector, Vector, Vector];
  angular_velocity: Vector;
}

/** An event that the scene has watched for. */
export interface SceneEvent {
  time: number;
  event: string;
  direction: string;
}

export interface Impact {
  time: number;
  body: string;
  with: string;
  kind: "hit" | "graze" | "rest" | "slide" | "roll" | "stick" | "leave";
  point: Vector;
  /** Unit, to the side that the body came from. */
  normal: Vector;
  velocity_before: Vector;
  velocity_after: Vector;
}

export type BodyShape =
  | { kind: "point" }
  | { kind: "sphere"; radius: number }
  | { kind: "soccer-ball"; radius: number }
  /** A box, a hull or a mesh. Triangles: indices of three vertices each. */
  | { kind: "mesh"; vertices: Vector[]; triangles: Vector[] };

export interface BodyData {
  name: string;
  shape: BodyShape;
  /** "#rrggbb", where the scene chooses it. */
  color?: string;
  /** kg; null where there is none or where it changes. */
  mass: number | null;
  group: number;
  /** The first component of p_WB, and of v_WB, in the group's state. */
  position: number;
  velocity: number;
  /** Named points in the body's frame, m. */
  points: { name: string; position: Vector }[];
  /** The acceleration, m/s^2, where the law makes it constant; null where it is not. */
  field: Vector | null;
  /** Where the body does not turn: how it stands, (w, x, y, z). */
  attitude: [number, number, number, number];
  /** Where it turns. */
  rotation?: RotationData;
}

/** How the orientation and the angular velocity of a body stand in the state of its group. */
export interface RotationData {
  /**
   * `quaternion`: (w, x, y, z). `matrix`: nine numbers, row by row. `rotation-vector`: a quaternion, and the rotation
   * vector that has been added to it since the piece began.
   */
  kind: "quaternion" | "matrix" | "rotation-vector";
  /** The first component of the orientation, and of the angular velocity. */
  component: number;
  angular_velocity: number;
  /** In which frame angular velocity and rotation vector are. */
  frame: "world" | "body";
  /** Whether no torque acts, or the angular velocity is constant. */
  free: boolean;
  /** About the centre of mass in the body's frame, kg m^2, row by row; null where the law needs none. */
  inertia: [Vector, Vector, Vector] | null;
}

export type ObstacleShape =
  | { kind: "plane"; point: Vector; normal: Vector }
  | { kind: "disk"; center: Vector; normal: Vector; radius: number }
  | { kind: "rectangle"; center: Vector; normal: Vector; up: Vector; width: number; height: number }
  | { kind: "triangle"; corners: [Vector, Vector, Vector] }
  | { kind: "sphere"; center: Vector; radius: number }
  /** `axes`: the columns of R_WB. */
  | { kind: "box"; center: Vector; size: Vector; axes: [Vector, Vector, Vector] }
  /** Triangles: indices of three vertices each. `closed`: it encloses matter; `hollow`: a room, the matter is around it. */
  | { kind: "mesh"; vertices: Vector[]; triangles: Vector[]; closed: boolean; hollow?: boolean };

export interface ObstacleData {
  name: string;
  /** Where it is at the start. */
  shape: ObstacleShape;
  /** "#rrggbb", where the scene chooses it. */
  color?: string;
  /** Where it moves as the scene says. */
  drive?: DriveData;
}

/**
 * `pivot`: a place of the obstacle at the start. `pieces`, as those of a group: where that place is, and the unit
 * quaternion (w, x, y, z) by which the obstacle has turned about it.
 */
export interface DriveData {
  pivot: Vector;
  pieces: string;
}

export interface RunData {
  report: Report;
  /** The axis of the world that points up in pictures. */
  up: "y" | "z";
  /** The way in which orientations are carried; null where nothing turns. */
  orientation: string | null;
  bodies: BodyData[];
  states: { name: string; group: number; component: number }[];
  obstacles: ObstacleData[];
  /** `pieces`: base64 of little-endian doubles, see `Track`. */
  groups: { dimension: number; pieces: string }[];
}

/** What is wrong with a scene. Lines and columns count from 1, columns in bytes; 0: unknown. */
export interface SceneError {
  file: string;
  line: number;
  column: number;
  message: string;
  text: string;
}

export interface PageData {
  trajet: string;
  /** The number of a page that a server makes anew when its scene changes; 0: there is no such server. */
  live: number;
  /** The scene as its author wrote it; empty where there is no file of it. */
  scene_text?: string;
  runs?: RunData[];
  error?: SceneError;
}

/** The numbers of a base64 text of little-endian doubles. */
export function decodeDoubles(text: string): Float64Array {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return new Float64Array(bytes.buffer);
}
