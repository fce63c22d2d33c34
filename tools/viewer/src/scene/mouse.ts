// What the buttons of the mouse do: as this page has it, or as the pre-processors of the field do.
export type Motion = "turn" | "move" | "zoom";
export type MouseScheme = "page" | "control" | "shift";

/** Names and what they do, for the list of keys. */
export const mouseSchemes: Record<MouseScheme, { name: string; says: string }> = {
  page: { name: "this page", says: "left: turn · shift and left, middle, right: move" },
  control: { name: "HyperMesh (Ctrl)", says: "Ctrl and left: turn · Ctrl and middle: zoom · Ctrl and right: move; without Ctrl as this page" },
  shift: { name: "LS-PrePost (Shift)", says: "Shift and left: turn · Shift and middle: move · Shift and right: zoom; without Shift as this page" },
};

export function motionOf(scheme: MouseScheme, e: { button: number; ctrlKey: boolean; shiftKey: boolean }): Motion {
  if (scheme === "control" && e.ctrlKey) return (["turn", "zoom", "move"] as const)[e.button] ?? "turn";
  if (scheme === "shift" && e.shiftKey) return (["turn", "move", "zoom"] as const)[e.button] ?? "turn";
  return e.button === 1 || e.button === 2 || e.shiftKey ? "move" : "turn";
}
