/** Real seconds that a run is to take at the speed chosen for it, about. */
const kComfortableDuration = 6;
/** Turns in a real second that the eye follows, two and a little more, and the real seconds that a run may take for it. */
const kTurnsToFollow = 2.1;
const kLongestDuration = 300;

/** The time that is shown, and how it goes on while the motion plays. `fastestSpin`: rad/s, of all that it shows. */
export class Clock {
  time: number;
  isPlaying = false;
  speed: number;

  constructor(
    readonly begin: number,
    readonly end: number,
    fastestSpin = 0,
  ) {
    this.time = begin;
    this.speed = comfortableSpeed(end - begin, fastestSpin);
  }

  get duration(): number {
    return this.end - this.begin;
  }

  seek(t: number): void {
    this.time = Math.min(this.end, Math.max(this.begin, t));
  }

  /** Starts or stops; from the end it starts again. */
  toggle(): void {
    if (!this.isPlaying && this.time >= this.end) this.time = this.begin;
    this.isPlaying = !this.isPlaying;
  }

  /** Goes on by so many seconds of the clock on the wall; stops at the end. */
  advance(seconds: number): void {
    if (!this.isPlaying) return;
    this.seek(this.time + seconds * this.speed);
    if (this.time >= this.end) this.isPlaying = false;
  }
}

/**
 * Real time where a run takes a few seconds; else slow or quick motion by a power of ten, or twice or five times it. Slower
 * where something spins so fast (rad/s) that it would seem to stand, or to turn backward.
 */
export function comfortableSpeed(duration: number, fastestSpin = 0): number {
  const isComfortable = duration >= 2 && duration <= 20;
  const usual = isComfortable ? 1 : roundedDown((duration || 1) / kComfortableDuration);
  if (fastestSpin * usual <= 2 * Math.PI * kTurnsToFollow) return usual;
  return roundedDown(Math.max((2 * Math.PI * kTurnsToFollow) / fastestSpin, duration / kLongestDuration));
}

/** To 1, 2 or 5 times a power of ten. */
function roundedDown(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const mantissa = value / power;
  return Number(((mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * power).toPrecision(1));
}

/** The speeds to choose from: 1, 2 and 5 times powers of ten around a given one. */
export function speedsAround(speed: number): number[] {
  const speeds = new Set([1, speed]);
  for (let power = Math.floor(Math.log10(speed)) - 2; power <= Math.floor(Math.log10(speed)) + 2; ++power)
    for (const mantissa of [1, 2, 5]) speeds.add(Number((mantissa * 10 ** power).toPrecision(1)));
  return [...speeds].sort((a, b) => a - b);
}

/** The first time behind `t`, or the last one before it; null where there is none. Times in any order. */
export function neighbour(times: readonly number[], t: number, direction: 1 | -1): number | null {
  const ahead = times.filter((each) => (each - t) * direction > 0);
  if (ahead.length === 0) return null;
  return ahead.reduce((best, each) => ((each - best) * direction < 0 ? each : best));
}
