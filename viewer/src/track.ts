import { decodeDoubles } from "./data";

const kDegreesOfNumber = 6;
const kDegreeBase = 256;

/** The degree of a component, of those that are stored from `first` on. */
const degreeOf = (numbers: Float64Array, first: number, component: number): number =>
  Math.floor(
    numbers[first + Math.floor(component / kDegreesOfNumber)] / kDegreeBase ** (component % kDegreesOfNumber),
  ) % kDegreeBase;

/**
 * The motion of one group of bodies and states: pieces of polynomials in time, one after the other.
 *
 * A piece is stored as the numbers from, to, t0, the degrees of all components, six to a number as its digits to the
 * base 256, the first the least, and then the coefficients of each component, (t - t0)^0 first. It stands for the
 * half-open interval [from, to); the last one for its end as well. Where a body bounces, the values jump between two
 * pieces.
 */
export class Track {
  private readonly begins: Float64Array;
  private readonly ends: Float64Array;
  /** Where a piece begins in the numbers, where the coefficients of each of its components do, and their degrees. */
  private readonly places: Int32Array;
  private readonly coefficients: Int32Array;
  private readonly degrees: Uint8Array;

  constructor(
    private readonly numbers: Float64Array,
    readonly dimension: number,
  ) {
    const places: number[] = [];
    for (let at = 0; at < numbers.length;) {
      places.push(at);
      const first = at + 3;
      at = first + Math.ceil(dimension / kDegreesOfNumber);
      for (let i = 0; i < dimension; ++i) at += degreeOf(numbers, first, i) + 1;
    }
    // A run backward in time has its last piece first.
    if (places.length > 0 && numbers[0] > numbers[1]) places.reverse();
    this.places = Int32Array.from(places);
    this.coefficients = new Int32Array(places.length * dimension);
    this.degrees = new Uint8Array(places.length * dimension);
    places.forEach((place, piece) => {
      let at = place + 3 + Math.ceil(dimension / kDegreesOfNumber);
      for (let i = 0; i < dimension; ++i) {
        this.coefficients[piece * dimension + i] = at;
        this.degrees[piece * dimension + i] = degreeOf(numbers, place + 3, i);
        at += degreeOf(numbers, place + 3, i) + 1;
      }
    });
    this.begins = Float64Array.from(places, (at) => Math.min(numbers[at], numbers[at + 1]));
    this.ends = Float64Array.from(places, (at) => Math.max(numbers[at], numbers[at + 1]));
  }

  static decode(pieces: string, dimension: number): Track {
    return new Track(decodeDoubles(pieces), dimension);
  }

  /** One piece, from the coefficients of each component about its beginning. */
  static ofPiece(from: number, to: number, components: readonly (readonly number[])[]): Track {
    const degrees = new Array<number>(Math.ceil(components.length / kDegreesOfNumber)).fill(0);
    components.forEach(({ length }, i) => {
      degrees[Math.floor(i / kDegreesOfNumber)] += (length - 1) * kDegreeBase ** (i % kDegreesOfNumber);
    });
    return new Track(Float64Array.from([from, to, from, ...degrees, ...components.flat()]), components.length);
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
    const tau = t - this.numbers[this.places[piece] + 2];
    const at = this.coefficients[piece * this.dimension + component];
    let sum = 0;
    for (let k = this.degrees[piece * this.dimension + component]; k >= derivative; --k) {
      // d^m/dt^m t^k = k (k - 1) … (k - m + 1) t^(k - m)
      let factor = 1;
      for (let i = 0; i < derivative; ++i) factor *= k - i;
      sum = sum * tau + factor * this.numbers[at + k];
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
