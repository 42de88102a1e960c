import type { Impact, Report, SceneEvent } from "./data";
import * as format from "./format";
import { dot, length } from "./vectors";

/** Something that happens at one time of a run: an impact, or an event that the scene watches for. */
export interface Moment {
  time: number;
  kind: "impact" | "event";
  impact?: Impact;
  event?: SceneEvent;
}

const kVerbs = {
  hit: "hits",
  graze: "grazes",
  rest: "rests on",
  slide: "slides on",
  roll: "rolls on",
  stick: "sticks to",
  leave: "leaves",
};

/** All impacts and events of a run, in the order of time. */
export function momentsOf({ impacts, events }: Report): Moment[] {
  const moments: Moment[] = [
    ...impacts.map((impact) => ({ time: impact.time, kind: "impact" as const, impact })),
    ...events.map((event) => ({ time: event.time, kind: "event" as const, event })),
  ];
  return moments.sort((a, b) => a.time - b.time);
}

/** Who does what to whom. */
export const action = ({ body, kind, with: obstacle }: Impact): string => `${body} ${kVerbs[kind]} ${obstacle}`;

/** m/s, before and after where they differ. */
export function speeds({ velocity_before, velocity_after }: Impact): string {
  const [before, after] = [length(velocity_before), length(velocity_after)].map((speed) => format.number(speed));
  return before === after ? before : `${before} → ${after}`;
}

/** Degrees between the way in and the surface: 90 is head-on. Null where the body does not move. */
export function impactAngle({ velocity_before, normal }: Impact): number | null {
  const speed = length(velocity_before);
  if (!(speed > 0)) return null;
  return (Math.asin(Math.min(1, Math.abs(dot(velocity_before, normal)) / speed)) * 180) / Math.PI;
}

/** A line that tells a moment. */
export function momentText({ time, impact, event }: Moment): string {
  const at = `${format.number(time, 6)} s`;
  if (event) return `${event.event} (${event.direction}), ${at}`;
  return `${action(impact!)}, ${at}, ${speeds(impact!)} m/s`;
}

/** How many of the moments, which are in the order of time, are not later than t. */
export function countUntil(moments: readonly Moment[], t: number): number {
  let [low, high] = [0, moments.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (moments[middle].time <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** How a run ended, and by what if something has stopped it. */
export function ending({ status, end_time, impacts, events }: Report): string {
  if (status !== "stopped") return status;
  const impact = impacts.filter(({ time }) => time === end_time).at(-1);
  if (impact) return `stopped: ${action(impact)}`;
  const event = events.filter(({ time }) => time === end_time).at(-1);
  return event ? `stopped: event ${event.event}` : status;
}
