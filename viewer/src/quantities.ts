import { type BodyMotion, length, type Run } from "./motion";
import { colorOf, kComponentColors, kPalette, kQuantityColors } from "./theme";
import type { Track } from "./track";

export interface Curve {
  label: string;
  color: string;
  /** Index and name of the run. */
  run: number;
  method: string;
  track: Track;
  value: (t: number, piece: number) => number;
}

/** A plot against time: what it is called, in which unit, and its curves. */
export interface Quantity {
  title: string;
  unit: string;
  color?: string;
  /** Around 0, what is smaller than this is rounding, and not worth a plot's height. */
  least?: number;
  curves: Curve[];
}

/** One body in one of the runs. */
interface Own {
  body: BodyMotion;
  run: number;
  method: string;
}
type Value = (body: BodyMotion, t: number, piece: number) => number;

/** A few units of the last place of a number near 1. */
const kRounding = 1e-15;
/** Of the parts of the energy. */
const kTranslation = { label: "translation", color: kPalette[5] };
const kRotation = { label: "rotation", color: kPalette[2] };
const kPotential = { label: "potential", color: kPalette[1] };
const kTotalColor = kPalette[3];

const curvesOf = (own: readonly Own[], label: string, color: (run: number) => string, of: Value): Curve[] =>
  own.map(({ body, run, method }) => ({
    label,
    color: color(run),
    run,
    method,
    track: body.track,
    value: (t, piece) => of(body, t, piece),
  }));

/** Whether curves are 0 at four times of every piece of their runs, as a polynomial is at all times if its degree is 3. */
export function isZero(curves: readonly Curve[]): boolean {
  const kPlaces = [0.07, 0.36, 0.65, 0.94];
  return curves.every(({ track, value }) => {
    for (let piece = 0; piece < track.count; ++piece) {
      const [begin, end] = [track.pieceBegin(piece), track.pieceEnd(piece)];
      if (kPlaces.some((place) => value(begin + place * (end - begin), piece) !== 0)) return false;
    }
    return true;
  });
}

/**
 * The energy of a body, in its parts. It is the whole mechanical energy where the law tells it: in a constant field of
 * acceleration, turning without torque. Else the kinetic one.
 */
function energyOf(own: readonly Own[], scalarColor: (run: number) => string): Quantity[] {
  const { mass, field, rotation } = own[0].body.data;
  const isWhole = field !== null && (!rotation || (rotation.inertia !== null && rotation.free));
  const unit = mass === null ? "J/kg" : "J";
  const rotationEnergy: Value = (b, t, p) => b.rotationEnergy(t, p);
  const parts: { label: string; color: string; of: Value }[] = [
    { ...kTranslation, of: (b, t, p) => b.translationEnergy(t, p) },
  ];
  if (rotation?.inertia && mass !== null) parts.push({ ...kRotation, of: rotationEnergy });
  if (isWhole) parts.push({ ...kPotential, of: (b, t, p) => b.potentialEnergy(t, p) });
  const title = isWhole ? "energy" : "kinetic energy";
  const present = parts.filter(({ of }) => !isZero(curvesOf(own, "", scalarColor, of)));

  const quantities: Quantity[] = [];
  if (present.length > 1) {
    const sum: Value = (b, t, p) => present.reduce((total, { of }) => total + of(b, t, p), 0);
    const curves = present.flatMap(({ label, color, of }) => curvesOf(own, label, () => color, of));
    quantities.push({
      title,
      unit,
      curves: [...curves, ...curvesOf(own, isWhole ? "total" : "sum", () => kTotalColor, sum)],
    });
  } else {
    const only = present[0] ?? parts[0];
    quantities.push({ title: `${title} (${only.label})`, unit, curves: curvesOf(own, "", scalarColor, only.of) });
  }
  if (rotation?.inertia && mass === null)
    quantities.push({
      title: "kinetic energy (rotation)",
      unit: "J",
      curves: curvesOf(own, "", scalarColor, rotationEnergy),
    });
  return quantities;
}

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
    of: (b: BodyMotion, t: number, p: number) => number[],
  ) =>
    quantities.push({
      title,
      unit,
      color,
      curves: ["x", "y", "z"].flatMap((axis, i) =>
        curvesOf(
          own,
          axis,
          () => kComponentColors[i],
          (b, t, p) => of(b, t, p)[i],
        ),
      ),
    });
  if (own.length > 0) {
    const { rotation } = own[0].body.data;
    components("position", "m", kQuantityColors.position, (b, t, p) => b.position(t, p));
    components("velocity", "m/s", kQuantityColors.velocity, (b, t, p) => b.velocity(t, p));
    components("acceleration", "m/s²", kQuantityColors.acceleration, (b, t, p) => b.acceleration(t, p));
    quantities.push({
      title: "speed",
      unit: "m/s",
      curves: curvesOf(own, "", scalarColor, (b, t, p) => length(b.velocity(t, p))),
    });
    quantities.push(...energyOf(own, scalarColor));
    if (rotation) {
      components("angular velocity", "rad/s", undefined, (b, t, p) => b.angularVelocity(t, p));
      const title = [
        ...new Set(own.map(({ body }) => (body.data.rotation?.kind === "matrix" ? "det R − 1" : "|q| − 1"))),
      ].join(", ");
      const curves = curvesOf(own, "", scalarColor, (b, t, p) => b.orientationDefect(t, p));
      quantities.push({ title, unit: "", least: kRounding, curves });
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
