/** A piece as the page stores it, from the coefficients of each component. */
export function piece(from: number, to: number, t0: number, ...components: number[][]): number[] {
  const degrees: number[] = [];
  components.forEach(({ length }, i) => {
    degrees[Math.floor(i / 6)] = (degrees[Math.floor(i / 6)] ?? 0) + (length - 1) * 256 ** (i % 6);
  });
  return [from, to, t0, ...degrees, ...components.flat()];
}

/** One piece from 0 to 1 in which nothing changes. */
export const constant = (state: number[]): number[] => piece(0, 1, 0, ...state.map((each) => [each]));
