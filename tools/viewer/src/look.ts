// How things look: theme, colour map, what the colours mean.
import type { MapName } from "./scene/colormap";

export type ContourKind = "depth" | "ratio" | "gap" | "edge" | "none" | "force" | "stiffness" | "step" | "element";
/** Kinds that show what contact does in the first cycle. */
export const ofCycle = (kind: ContourKind): boolean => kind === "force" || kind === "stiffness" || kind === "step";

export interface Look {
  map: MapName;
  dark: boolean;
  contour: ContourKind;
  /** Colours in steps instead of a smooth change. */
  bands: number;
  /** Limits of the scale; null: those of the values. */
  low: number | null;
  high: number | null;
  log: boolean;
  maximum: boolean; // the largest value is labelled
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
