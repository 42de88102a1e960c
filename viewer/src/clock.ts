/** Real seconds that a run is to take at the speed chosen for it, about. */
const kComfortableDuration = 6;

/** The time that is shown, and how it goes on while the motion plays. */
export class Clock {
  time: number;
  isPlaying = false;
  speed: number;

  constructor(
    readonly begin: number,
    readonly end: number,
  ) {
    this.time = begin;
    this.speed = comfortableSpeed(end - begin);
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

/** Real time where a run takes a few seconds; else slow or quick motion by a power of ten, or twice or five times it. */
export function comfortableSpeed(duration: number): number {
  if (duration >= 2 && duration <= 20) return 1;
  const wanted = (duration || 1) / kComfortableDuration;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const mantissa = wanted / power;
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
