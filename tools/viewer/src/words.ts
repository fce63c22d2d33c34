// Words for values on cards.

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

/** igapWords for TYPE24 and TYPE25. */
export const modernIgapWords: Record<number, string> = {
  1: "thickness of both sides",
  2: "as 1, near nodes left out",
  3: "as 1, limited by the mesh size",
  5: "thickness of the card",
};
export const modernInactiWords: Record<number, string> = {
  [-1]: "force from the start",
  0: "ignored",
  5: "stored as offset",
};

export const actionLong: Record<string, string> = {
  none: "Nothing is done. The run starts with this overlap: the contact pushes the node out from the first cycle on, with a force that grows with depth.",
  "node-stiffness-zero": "The node's stiffness is set to zero: this interface never acts on the node again.",
  "segment-stiffness-zero": "The segment's stiffness is set to zero: nothing will ever be stopped by this segment.",
  "node-moved": "The node is moved along the normal to the edge of the gap. The mesh changes.",
  "gap-reduced": "The gap of this pair is reduced so that the run starts (nearly) without force; it grows back as the node leaves.",
  "edge-stiffness-zero": "The stiffness of the edge is set to zero: it no longer takes part in this interface.",
  ignored: "The solver ignores it: nothing is stored for the pair. Only what is no deeper than 1e-8 would count.",
  "offset-stored": "The penetration is stored as an offset: the run starts without force, and from then on the contact acts on what goes beyond it.",
  "initial-force": "Nothing is taken off: the contact pushes from the first cycle on.",
  "error-611": "The node lies exactly on the segment, so no direction exists.",
  "error-612": "The node lies exactly on the segment, so no direction exists.",
  "removed-tied": "A tie holds the node, so the pair is left out of the contact (Irem_i2) and what was stored for it is taken back.",
};
