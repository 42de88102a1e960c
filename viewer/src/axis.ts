import { roundSpacing } from "./format";

/** Round values between `low` and `high`, three to seven of them. */
export function ticksBetween(low: number, high: number): number[] {
  const step = roundSpacing((high - low) / 4);
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-6); k <= Math.floor(high / step + 1e-6); ++k) ticks.push(k * step);
  return ticks;
}

/** The texts of such values, with the digits that tell one from the next. */
export function tickTexts(ticks: readonly number[]): string[] {
  const largest = Math.max(...ticks.map(Math.abs));
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : largest;
  if (!(step > 0)) return ticks.map(() => "0");
  const stepPower = Math.floor(Math.log10(step) + 1e-6);
  const isExponential = largest >= 1e6 || largest < 1e-3;
  return ticks.map((tick) => {
    if (Math.abs(tick) < 0.5 * step) return "0";
    const digits = Math.floor(Math.log10(Math.abs(tick)) + 1e-6) - stepPower;
    const text = isExponential
      ? tick.toExponential(Math.min(15, Math.max(0, digits))).replace("e+", "e")
      : tick.toFixed(Math.min(15, Math.max(0, -stepPower)));
    return text.replaceAll("-", "−");
  });
}

/** px; room for such texts, the same in all plots that need no more. */
export const textRoom = (texts: readonly string[]): number =>
  Math.max(60, ...texts.map((text) => 10 + 6.3 * text.length));

/** The range of an axis: a constant is a line in the middle, and no rounding, what is below `least`, is blown up. */
export function readableRange(low: number | null, high: number | null, least = 0): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (size < least) return [-least, least];
  if (size === 0) return [-1, 1];
  if (high - low <= 1e-12 * size) return [low - 0.1 * size, high + 0.1 * size];
  const margin = 0.06 * (high - low);
  return [low - margin, high + margin];
}
