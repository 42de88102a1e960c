import { decodeDoubles } from "./data";

/**
 * The motion of one group of bodies and states: pieces of polynomials in time, one after the other.
 *
 * A piece is stored as the numbers from, to, t0, n and then the coefficients of (t - t0)^0 for every component, those of
 * (t - t0)^1, …, (t - t0)^n. It stands for the half-open interval [from, to); the last one for its end as well. Where a
 * body bounces, the values jump between two pieces.
 */
export class Track {
  private readonly begins: Float64Array;
  private readonly ends: Float64Array;
  private readonly places: Int32Array;

  constructor(
    private readonly numbers: Float64Array,
    readonly dimension: number,
  ) {
    const places: number[] = [];
    for (let at = 0; at < numbers.length; at += 4 + dimension * (numbers[at + 3] + 1)) places.push(at);
    // A run backward in time has its last piece first.
    if (places.length > 0 && numbers[0] > numbers[1]) places.reverse();
    this.places = Int32Array.from(places);
    this.begins = Float64Array.from(places, (at) => Math.min(numbers[at], numbers[at + 1]));
    this.ends = Float64Array.from(places, (at) => Math.max(numbers[at], numbers[at + 1]));
  }

  static decode(pieces: string, dimension: number): Track {
    return new Track(decodeDoubles(pieces), dimension);
  }

  get count(): number {
    return this.places.length;
  }
  get begin(): number {
    return this.begins[0];
  }
  get end(): number {
    return this.ends[this.count - 1];
  }
  pieceBegin(piece: number): number {
    return this.begins[piece];
  }
  pieceEnd(piece: number): number {
    return this.ends[piece];
  }
  degree(piece: number): number {
    return this.numbers[this.places[piece] + 3];
  }

  /** The piece that stands for time t; the first or the last one where t lies outside. */
  pieceAt(t: number): number {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.begins[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** A component at time t, or its time derivative of that order, by Horner's rule on the piece's polynomial. */
  value(piece: number, component: number, t: number, derivative = 0): number {
    const at = this.places[piece];
    const tau = t - this.numbers[at + 2];
    const first = at + 4 + component;
    let sum = 0;
    for (let k = this.numbers[at + 3]; k >= derivative; --k) {
      // d^m/dt^m t^k = k (k - 1) … (k - m + 1) t^(k - m)
      let factor = 1;
      for (let i = 0; i < derivative; ++i) factor *= k - i;
      sum = sum * tau + factor * this.numbers[first + k * this.dimension];
    }
    return sum;
  }

  vector(piece: number, component: number, t: number, derivative = 0): [number, number, number] {
    return [
      this.value(piece, component, t, derivative),
      this.value(piece, component + 1, t, derivative),
      this.value(piece, component + 2, t, derivative),
    ];
  }
}
