import * as THREE from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";

/** A way in the drawing: places at times, in the order of time. */
export interface Way {
  times: number[];
  points: THREE.Vector3[];
}

/** The number of the last time that is not later than t, at least 0. */
function lastUntil(times: readonly number[], t: number): number {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Both ends of the lines share a buffer. */
const endsOf = (line: Line2): THREE.InterleavedBuffer =>
  (line.geometry.getAttribute("instanceStart") as THREE.InterleavedBufferAttribute).data;

/** What a body or a point of it leaves behind: the way up to now strong, the rest of it thin. */
export class WholeTrail {
  readonly group = new THREE.Group();
  private readonly past: Line2;
  private readonly tip: Line2;

  constructor(
    private readonly way: Way,
    color: string,
    width: number,
  ) {
    const positions = new Float32Array(way.points.length * 3);
    way.points.forEach((point, i) => point.toArray(positions, 3 * i));
    const material = new LineMaterial({ color, linewidth: width });
    this.past = new Line2(new LineGeometry().setPositions(positions), material);
    this.tip = new Line2(new LineGeometry().setPositions([0, 0, 0, 0, 0, 0]), material);
    const whole = new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(way.points),
      new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.35 }),
    );
    for (const line of [this.past, this.tip, whole]) line.frustumCulled = false;
    this.group.add(this.past, this.tip, whole);
  }

  /** Up to time t, when it is at `place`. */
  update(t: number, place: THREE.Vector3): void {
    const last = lastUntil(this.way.times, t);
    this.past.visible = last > 0;
    this.past.geometry.instanceCount = last;
    const ends = endsOf(this.tip);
    this.way.points[last].toArray(ends.array, 0);
    place.toArray(ends.array, 3);
    ends.needsUpdate = true;
  }
}

/** The last part of a way that turns so often that the whole of it would be a ball of yarn. */
export class Tail {
  readonly group = new THREE.Group();
  private readonly line: Line2;

  /** `duration`: of the part, s. */
  constructor(
    private readonly way: Way,
    private readonly duration: number,
    color: string,
    width: number,
  ) {
    let most = 0;
    for (let first = 0, last = 0; last < way.times.length; ++last) {
      while (way.times[last] - way.times[first] > duration) ++first;
      most = Math.max(most, last - first);
    }
    const room = new Float32Array(3 * (most + 3));
    this.line = new Line2(new LineGeometry().setPositions(room), new LineMaterial({ color, linewidth: width }));
    this.line.frustumCulled = false;
    this.group.add(this.line);
  }

  update(t: number, place: THREE.Vector3): void {
    const { times, points } = this.way;
    const last = lastUntil(times, t);
    let first = last;
    while (first > 0 && times[first] > t - this.duration) --first;
    const ends = endsOf(this.line);
    let lines = 0;
    for (let i = first; i <= last; ++i) {
      const end = i < last ? points[i + 1] : place;
      points[i].toArray(ends.array, 6 * lines);
      end.toArray(ends.array, 6 * lines + 3);
      ++lines;
    }
    this.line.geometry.instanceCount = lines;
    ends.needsUpdate = true;
  }
}

/** A way longer than this, in its own extent, is shown as a tail, and how long that is. */
const kMostExtents = 40;
const kTailExtents = 2.5;

/** The trail that suits a way. */
export function trailLine(way: Way, color: string, width: number): WholeTrail | Tail {
  const box = new THREE.Box3().setFromPoints(way.points);
  const extent = box.getSize(new THREE.Vector3()).length();
  let length = 0;
  for (let i = 1; i < way.points.length; ++i) length += way.points[i].distanceTo(way.points[i - 1]);
  if (length <= kMostExtents * extent) return new WholeTrail(way, color, width);
  const duration = way.times[way.times.length - 1] - way.times[0];
  return new Tail(way, (duration * kTailExtents * extent) / length, color, width);
}
