// Values of the cards in words.

export const igapWords: Record<number, string> = {
  0: "constant gap",
  1: "thickness of both sides",
  2: "thickness × Fscalegap, at most Gapmax",
  3: "as 2, limited by the mesh size",
  4: "as 2, near nodes removed",
};
export const inactiWords: Record<number, string> = {
  0: "no action",
  1: "switch the node off",
  2: "switch the segment off",
  3: "move the node",
  5: "reduce the gap",
  6: "reduce the gap, 5 % spared",
};

export function flagText(field: "Igap" | "Inacti", value: number): string {
  const words = field === "Igap" ? igapWords : inactiWords;
  return `${value} – ${words[value] ?? "unknown"}`;
}

export const actionWords: Record<string, string> = {
  none: "nothing",
  "node-stiffness-zero": "node off",
  "segment-stiffness-zero": "segment off",
  "node-moved": "node moved",
  "gap-reduced": "gap reduced",
  "edge-stiffness-zero": "edge off",
};
export const actionLong: Record<string, string> = {
  none: "Nothing is done. The run starts with this overlap: the contact pushes the node out from the first cycle on, with a force that grows with depth.",
  "node-stiffness-zero": "The node's stiffness is set to zero: this interface never acts on the node again.",
  "segment-stiffness-zero": "The segment's stiffness is set to zero: nothing will ever be stopped by this segment.",
  "node-moved": "The node is moved along the normal to the edge of the gap. The mesh changes.",
  "gap-reduced": "The gap of this pair is reduced so that the run starts (nearly) without force; it grows back as the node leaves.",
  "edge-stiffness-zero": "The stiffness of the edge is set to zero: it no longer takes part in this interface.",
};
