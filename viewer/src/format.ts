/** A number with so many significant digits, no more than needed: 0.36, 12.5, 3.2e-7. */
export function number(value: number, digits = 4): string {
  if (value === 0) return "0";
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

/** A time with the decimals that matter in a run of that duration (s). */
export function time(t: number, duration: number): string {
  const decimals = Math.min(9, Math.max(0, 4 - Math.floor(Math.log10(duration || 1))));
  return t.toFixed(decimals).replace("-", "−");
}

/** The exact time of an impact or event, to ten digits as in the program's summary. */
export const exactTime = (t: number): string => `${number(t, 10)} s`;

/** 1, 2 or 5 times a power of ten, about `value`: a spacing for a grid. */
export function roundSpacing(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const mantissa = value / power;
  return (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10) * power;
}
