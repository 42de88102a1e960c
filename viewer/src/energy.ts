import { type Curve, curvesOf, isZero, type Own, type Quantity, type Value } from "./curves";
import type { BodyMotion } from "./motion";
import { kPalette } from "./theme";

/** Of the parts of the energy. */
const kTranslation = { label: "translation", color: kPalette[5] };
const kRotation = { label: "rotation", color: kPalette[2] };
const kPotential = { label: "potential", color: kPalette[1] };
const kTotalColor = kPalette[3];

interface Energy {
  title: string;
  unit: string;
  parts: { label: string; color: string; of: Value }[];
}

const rotationEnergy: Value = (b, t, p) => b.rotationEnergy(t, p);

/**
 * The energy of a body, in its parts. It is the whole mechanical energy where the law tells it: in a constant field of
 * acceleration, turning without torque. Else the kinetic one.
 */
function energyOf({ data: { mass, field, rotation } }: BodyMotion): Energy {
  const isWhole = field !== null && (!rotation || (rotation.inertia !== null && rotation.free));
  const parts: Energy["parts"] = [{ ...kTranslation, of: (b, t, p) => b.translationEnergy(t, p) }];
  if (rotation?.inertia && mass !== null) parts.push({ ...kRotation, of: rotationEnergy });
  if (isWhole) parts.push({ ...kPotential, of: (b, t, p) => b.potentialEnergy(t, p) });
  return { title: isWhole ? "energy" : "kinetic energy", unit: mass === null ? "J/kg" : "J", parts };
}

/** A body's energy at time t: the sum of its parts, and by itself what has another unit. */
export function energyAt(body: BodyMotion, t: number): { name: string; title: string; unit: string; value: number }[] {
  const { title, unit, parts } = energyOf(body);
  const piece = body.track.pieceAt(t);
  const value = parts.reduce((total, { of }) => total + of(body, t, piece), 0);
  const energies = [{ name: title === "energy" ? "E" : "E kin", title, unit, value }];
  if (hasOwnRotationEnergy(body)) {
    const rotation = { name: "E rot", title: "kinetic energy of rotation", unit: "J", value: body.rotationEnergy(t, piece) };
    energies.push(rotation);
  }
  return energies;
}

/** Whether the rotation has an energy in J, and the rest only one per mass. */
const hasOwnRotationEnergy = ({ data: { mass, rotation } }: BodyMotion): boolean =>
  mass === null && Boolean(rotation?.inertia);

/** What there is to plot of it. */
export function energyQuantities(own: readonly Own[], scalarColor: (run: number) => string): Quantity[] {
  const { title, unit, parts } = energyOf(own[0].body);
  const present = parts.filter(({ of }) => !isZero(curvesOf(own, "", scalarColor, of)));

  const quantities: Quantity[] = [];
  if (present.length > 1) {
    const sum: Value = (b, t, p) => present.reduce((total, { of }) => total + of(b, t, p), 0);
    const curves: Curve[] = present.flatMap(({ label, color, of }) => curvesOf(own, label, () => color, of));
    const name = title === "energy" ? "total" : "sum";
    quantities.push({ title, unit, curves: [...curves, ...curvesOf(own, name, () => kTotalColor, sum)] });
  } else {
    const only = present[0] ?? parts[0];
    quantities.push({ title: `${title} (${only.label})`, unit, curves: curvesOf(own, "", scalarColor, only.of) });
  }
  if (hasOwnRotationEnergy(own[0].body))
    quantities.push({
      title: "kinetic energy (rotation)",
      unit: "J",
      curves: curvesOf(own, "", scalarColor, rotationEnergy),
    });
  return quantities;
}
