// Tool bar of the 3D view: colours, visible objects, directions.
import { Vector3 } from "three";
import { button, h } from "../dom";
import { contourNames, ofCycle, type ContourKind, type Look } from "../look";
import type { Report } from "../report";
import type { Viewport } from "./viewport";

/** Switches with button and key: key, icon, description on the button and in the list of keys. */
const switches = {
  arrows: ["a", "arrows", "Arrows: the way out, or nodal forces where colours show those", "arrows"],
  edges: ["w", "mesh", "Element sides", "element sides"],
  rest: ["h", "only", "Only what penetrates", "only what penetrates; or the rest see-through"],
  solid: ["o", "parts3d", "All parts solid", "all parts solid"],
  follow: ["i", "isolate", "Isolate the chosen pair", "isolate the chosen pair, or not"],
  crossed: ["c", "cross", "Edges of crossed elements", "edges of crossed elements"],
  ties: ["n", "tie", "Ties: from node to segment, what is not tied marked", "lines of ties, from node to segment"],
  clip: ["x", "clip", "Section planes", "section planes"],
  measure: ["m", "ruler", "Measure between two nodes, or a node and a part", "measure: node to node, or node to surface"],
  parts: ["p", "parts", "Parts", "list of parts"],
  parallel: ["v", "parallel", "Parallel projection", "parallel projection"],
} as const;
export type SwitchName = keyof typeof switches;
const names = Object.keys(switches) as SwitchName[];
/** By key. */
export const switchOf: Record<string, SwitchName> = Object.fromEntries(names.map((n) => [switches[n][0], n]));

export const switchHelp = [..."ihomawvxpcn"].map((key): [string, string] => [key, switches[switchOf[key]][3]]);

/** `buttons` gets the toggles by name. */
export function toolbar(viewport: Viewport, report: Report, look: Look, changeLook: (change: Partial<Look>) => void, buttons: Map<string, HTMLButtonElement>): HTMLElement {
  const contour = h("select", { "aria-label": "Colours show", title: "What the colours show (keys 1 to 5)", onchange: () => changeLook({ contour: contour.value as ContourKind }) },
    ...Object.entries(contourNames).filter(([k]) => (k === "element" ? report.steps : !ofCycle(k as ContourKind) || report.cycle?.nodes.length)).map(([k, name]) => h("option", { value: k }, name)));
  report.on("look", () => (contour.value = look.contour));
  contour.value = look.contour;
  const toggle = (name: SwitchName) => {
    const [key, iconName, what] = switches[name];
    const title = `${what} (${key})`;
    const b = button("", iconName, () => viewport.toggle(name), { "aria-label": title, title, "aria-pressed": viewport.on[name] ? "true" : "false", class: "tool" });
    buttons.set(name, b);
    return b;
  };
  const there = (name: SwitchName) => (name === "crossed" ? !!report.crossed?.total : name === "ties" ? report.ties.length > 0 : name !== "parallel");
  let last = "";
  const axis = (name: string, d: [number, number, number], up: [number, number, number], title = `Look along ${name}; again: from the other side`) =>
    button(name, null, () => {
      const back = last === name && name !== "ISO";
      last = back ? "" : name;
      viewport.view!.look(new Vector3(...d).multiplyScalar(back ? -1 : 1), new Vector3(...up));
    }, { class: "tool text", title });
  return h("div", { class: "toolbar", role: "toolbar", "aria-label": "3D view" },
    contour,
    h("span", { class: "bar" }, ...names.filter(there).map(toggle)),
    h("span", { class: "bar" },
      axis("ISO", [1, -1, 1], [0, 0, 1], "Look from a corner"), axis("X", [1, 0, 0], [0, 0, 1]), axis("Y", [0, -1, 0], [0, 0, 1]), axis("Z", [0, 0, 1], [0, 1, 0]),
      toggle("parallel"),
      button("", "fit", () => viewport.fit(), { "aria-label": "Fit (f)", title: "Fit (f)", class: "tool" }),
      button("", "camera", () => viewport.savePicture(false), { "aria-label": "Save a PNG", title: "Save a PNG", class: "tool" })));
}
