/** Colours of lines and bodies: [OkabeIto2008], distinguishable with any colour vision. */
export const kPalette = ["#0072b2", "#e69f00", "#cc79a7", "#009e73", "#d55e00", "#56b4e9", "#b8a900", "#7f7f7f"];

/** The colour of a body: its own in a single run, its run's where several are compared. */
export const colorOf = (runCount: number, run: number, body: number): string =>
  kPalette[(runCount > 1 ? run : body) % kPalette.length];

/** Of the components x, y, z, in plots and on a body's axes. */
export const kComponentColors = ["#e69f00", "#56b4e9", "#cc79a7"];

/** The course's colours: position blue, velocity green, acceleration red. */
export const kQuantityColors = { position: "#2b7bff", velocity: "#16a34a", acceleration: "#e5383b" };

/** Of the marks of impacts and events on the picture and the plots. */
export const kMomentColors = { impact: "#dc2626", event: "#7c5cff" };

export type Theme = "light" | "dark";

const kStorageKey = "trajet-theme";

function stored(): Theme | null {
  try {
    return localStorage.getItem(kStorageKey) as Theme | null;
  } catch {
    return null; // storage is closed to some pages from files
  }
}

export function initialTheme(): Theme {
  return stored() ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

export function applyTheme(theme: Theme): void {
  document.documentElement.dataset.theme = theme;
}

export function rememberTheme(theme: Theme): void {
  try {
    localStorage.setItem(kStorageKey, theme);
  } catch {
    return; // the choice holds for this visit
  }
}

/** A colour of the style sheet, as it is now. */
export const cssColor = (name: string): string =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();
