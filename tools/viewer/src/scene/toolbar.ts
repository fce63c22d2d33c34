// The tool bar of the 3D view: what the colours show, what is drawn, from where.
import { Vector3 } from "three";
import { button, h } from "../dom";
import { contourNames, ofCycle, type ContourKind, type Look } from "../look";
import type { Report } from "../report";
import type { Viewport } from "./viewport";

/** `toggles` gets the buttons that stay down, by name. */
export function toolbar(viewport: Viewport, report: Report, look: Look, changeLook: (change: Partial<Look>) => void, toggles: Map<string, HTMLButtonElement>): HTMLElement {
  const contour = h("select", { "aria-label": "Colours show", title: "What the colours show (keys 1 to 5)", onchange: () => changeLook({ contour: contour.value as ContourKind }) },
    ...Object.entries(contourNames).filter(([k]) => (k === "element" ? report.steps : !ofCycle(k as ContourKind) || report.cycle?.nodes.length)).map(([k, name]) => h("option", { value: k }, name)));
  report.on("look", () => (contour.value = look.contour));
  contour.value = look.contour;
  const toggle = (key: string, name: string, iconName: string, run: () => void) => {
    const b = button("", iconName, run, { "aria-label": name, title: name, "aria-pressed": viewport.isOn(key) ? "true" : "false", class: "tool" });
    toggles.set(key, b);
    return b;
  };
  let last = "";
  const axis = (name: string, d: [number, number, number], up: [number, number, number], title = `Look along ${name}; again: from the other side`) =>
    button(name, null, () => {
      const back = last === name && name !== "ISO";
      last = back ? "" : name;
      viewport.view!.look(new Vector3(...d).multiplyScalar(back ? -1 : 1), new Vector3(...up));
    }, { class: "tool text", title });
  return h("div", { class: "toolbar", role: "toolbar", "aria-label": "3D view" },
    contour,
    h("span", { class: "bar" },
      toggle("arrows", "Arrows: the way out, or nodal forces where colours show those (a)", "arrows", () => viewport.toggleArrows()),
      toggle("edges", "Element sides (w)", "mesh", () => viewport.toggleEdges()),
      toggle("rest", "Only what penetrates (h)", "ghost", () => viewport.toggleRest()),
      toggle("solid", "All parts solid (o)", "parts3d", () => viewport.toggleSolid()),
      toggle("follow", "Isolate the chosen pair (i)", "isolate", () => viewport.toggleFollow()),
      report.crossed?.total ? toggle("crossed", "Edges of crossed elements (c)", "cross", () => viewport.toggleCrossed()) : null,
      report.ties.length > 0 ? toggle("ties", "Ties: from node to segment, what is not tied marked (n)", "tie", () => viewport.toggleTies()) : null,
      toggle("clip", "Section planes (x)", "clip", () => viewport.toggleClip()),
      toggle("measure", "Measure between two nodes, or a node and a part (m)", "ruler", () => viewport.toggleMeasure()),
      toggle("parts", "Parts (p)", "parts", () => viewport.toggleParts())),
    h("span", { class: "bar" },
      axis("ISO", [1, -1, 1], [0, 0, 1], "Look from a corner"), axis("X", [1, 0, 0], [0, 0, 1]), axis("Y", [0, -1, 0], [0, 0, 1]), axis("Z", [0, 0, 1], [0, 1, 0]),
      toggle("parallel", "Parallel projection (v)", "parallel", () => viewport.toggleParallel()),
      button("", "fit", () => viewport.fit(), { "aria-label": "Fit (f)", title: "Fit (f)", class: "tool" }),
      button("", "camera", () => viewport.savePicture(false), { "aria-label": "Save a PNG", title: "Save a PNG", class: "tool" })));
}
