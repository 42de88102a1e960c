import { curvesOf, isZero, type Quantity, roundingOf } from "./curves";
import { energyQuantities } from "./energy";
import type { BodyMotion, Run } from "./motion";
import { colorOf, kComponentColors, kPalette, kQuantityColors } from "./theme";
import { length } from "./vectors";

/** A few tens of units of the last place of a number near 1. */
const kRoundingOfOne = 2e-14;

/** What there is to plot of a body, of the first run whole and of the others dashed. */
export function quantitiesOf(runs: readonly Run[], bodyName: string | null): Quantity[] {
  const quantities: Quantity[] = [];
  const own = runs.flatMap((run, index) => {
    const body = bodyName === null ? undefined : run.body(bodyName);
    return body ? [{ body, run: index, method: run.name }] : [];
  });
  const scalarColor = (run: number): string => (runs.length > 1 ? colorOf(runs.length, run, 0) : kPalette[5]);
  const components = (
    title: string,
    unit: string,
    color: string | undefined,
    least: number,
    of: (b: BodyMotion, t: number, p: number) => number[],
  ): void => {
    const curves = ["x", "y", "z"].map((axis, i) =>
      curvesOf(
        own,
        axis,
        () => kComponentColors[i],
        (b, t, p) => of(b, t, p)[i],
      ),
    );
    const zero = curves.filter((each) => isZero(each, least));
    // a quantity that is zero as a whole keeps its curves, to be recognised by
    const shown = zero.length < curves.length ? curves.filter((each) => !zero.includes(each)) : curves;
    const labels = zero.map(([{ label }]) => label);
    quantities.push({ title, unit, color, least, curves: shown.flat(), zero: labels });
  };
  if (own.length > 0) {
    const { rotation } = own[0].body.data;
    const rounding = roundingOf(own);
    components("position", "m", kQuantityColors.position, rounding.position, (b, t, p) => b.position(t, p));
    components("velocity", "m/s", kQuantityColors.velocity, rounding.velocity, (b, t, p) => b.velocity(t, p));
    components("acceleration", "m/s²", kQuantityColors.acceleration, rounding.acceleration, (b, t, p) =>
      b.acceleration(t, p),
    );
    quantities.push({
      title: "speed",
      unit: "m/s",
      least: rounding.velocity,
      curves: curvesOf(own, "", scalarColor, (b, t, p) => length(b.velocity(t, p))),
    });
    quantities.push(...energyQuantities(own, scalarColor));
    if (rotation) {
      components("angular velocity", "rad/s", undefined, rounding.angularVelocity, (b, t, p) => b.angularVelocity(t, p));
      const title = [
        ...new Set(own.map(({ body }) => (body.data.rotation?.kind === "matrix" ? "det R − 1" : "|q| − 1"))),
      ].join(", ");
      const curves = curvesOf(own, "", scalarColor, (b, t, p) => b.orientationDefect(t, p));
      quantities.push({ title, unit: "", least: kRoundingOfOne, curves });
    }
  }
  const stateNames = [...new Set(runs.flatMap((run) => run.states.map((state) => state.name)))];
  stateNames.forEach((name, i) =>
    quantities.push({
      title: name,
      unit: "",
      curves: runs.flatMap((run, index) =>
        run.states
          .filter((state) => state.name === name)
          .map((state) => ({
            label: "",
            color: runs.length > 1 ? scalarColor(index) : kPalette[i % kPalette.length],
            run: index,
            method: run.name,
            track: state.track,
            value: (t: number, piece: number) => state.value(t, piece),
          })),
      ),
    }),
  );
  return quantities;
}
