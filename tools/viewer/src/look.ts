// Appearance: theme, colour map, meaning of the colours. The maps suit colour vision deficiencies: deeper is darker and hotter on
// light and dark ground; lightness is monotonic, so prints in black and white stay readable.
export type ContourKind = "depth" | "ratio" | "gap" | "edge" | "none" | "force" | "stiffness" | "step" | "element";
/** True for kinds of the first cycle. */
export const ofCycle = (kind: ContourKind): boolean => kind === "force" || kind === "stiffness" || kind === "step";

export interface Look {
  map: MapName;
  dark: boolean;
  contour: ContourKind;
  /** Number of colour steps instead of a smooth change. */
  bands: number;
  /** Limits of the scale; null: from the values. */
  low: number | null;
  high: number | null;
  log: boolean;
  maximum: boolean; // label the largest value
}

export const contourNames: Record<ContourKind, string> = {
  depth: "Penetration depth",
  ratio: "Depth ÷ gap",
  gap: "Largest pair gap",
  edge: "Pair gap ÷ shortest side",
  none: "Part colours",
  force: "Nodal contact force",
  stiffness: "Nodal contact stiffness",
  step: "Nodal time step",
  element: "Element time step",
};

export type MapName = "heat" | "viridis" | "cividis" | "magma";

const stops: Record<MapName, string> = {
  heat: "6e0024 980026 bd0026 d7191c e8432d f26b38 fa8f48 fdb15f fecb7c fee19d fff0c0",
  viridis: "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725",
  cividis: "00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 f6dd4a fee838",
  magma: "000004 140e36 3b0f70 641a80 8c2981 b73779 de4968 f7705c fe9f6d fecf92 fcfdbf",
};
export const mapNames = Object.keys(stops) as MapName[];

function parse(name: MapName): number[][] {
  return stops[name].split(" ").map((t) => [0, 2, 4].map((k) => parseInt(t.slice(k, k + 2), 16)));
}
const tables = new Map(mapNames.map((n) => [n, parse(n)]));

/** Colour at t in [0, 1]: red, green, blue in 0..255. */
export function colorAt(name: MapName, t: number): [number, number, number] {
  const table = tables.get(name)!;
  // The ends of the maps are too close to white or black.
  const x = Math.min(Math.max(0.94 - 0.9 * t, 0), 1) * (table.length - 1);
  const i = Math.min(Math.floor(x), table.length - 2);
  const f = x - i;
  return [0, 1, 2].map((k) => Math.round(table[i][k] + f * (table[i + 1][k] - table[i][k]))) as [number, number, number];
}

export function cssColor(name: MapName, t: number): string {
  const [r, g, b] = colorAt(name, t);
  return `rgb(${r} ${g} ${b})`;
}

/** Black or white, by contrast with the colour. */
export function inkOn(red: number, green: number, blue: number): string {
  const linear = (v: number) => (v <= 10 ? v / 3295 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const light = 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
  return (light + 0.05) / 0.05 > 1.05 / (light + 0.05) ? "#000" : "#fff";
}
