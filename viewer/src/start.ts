import type { RunData } from "./data";
import { Track } from "./track";

/**
 * The motion of a group in a run that ended where it began, which has no pieces: one of no duration that holds how the
 * report says that the bodies and states are.
 */
export function startTrack({ report, bodies, states, groups }: RunData, group: number): Track {
  // the coefficients of each component
  const components = Array.from({ length: groups[group].dimension }, () => [0]);
  const set = (first: number, values: readonly number[]): void => {
    values.forEach((value, i) => (components[first + i] = [value]));
  };
  for (const body of bodies.filter((each) => each.group === group)) {
    const state = report.final.find((each) => each.body === body.name)!;
    set(body.position, state.position);
    state.velocity.forEach((v, i) => (components[body.velocity + i] = [v, state.acceleration[i] ?? 0]));
    const { rotation } = body;
    if (!rotation) continue;
    const { rotation_matrix: matrix, angular_velocity: w } = state;
    const inBody = [0, 1, 2].map((axis) => w.reduce((sum, each, i) => sum + matrix[i][axis] * each, 0));
    set(rotation.component, rotation.kind === "matrix" ? matrix.flat() : state.orientation);
    set(rotation.angular_velocity, rotation.frame === "world" ? w : inBody);
  }
  for (const state of states.filter((each) => each.group === group)) set(state.component, [report.states[state.name]]);
  return Track.ofPiece(report.start_time, report.end_time, components);
}
