// Distances between two nodes, or between a node and the surface of a part.
import { Triangle, Vector3, type Mesh } from "three";
import type { MeshBVH } from "three-mesh-bvh";
import { h, icon, num, replace } from "../dom";
import type { Report } from "../report";
import { placeOf } from "./drawn";
import type { Parts3D } from "./parts3d";
import type { Picked, View3D } from "./view3d";

export class Ruler {
  on = false;
  measured: number[] = []; // page nodes
  private readonly said = h("span", null);
  private readonly mode = h("select", { "aria-label": "What is measured", onchange: () => this.again() },
    h("option", { value: "nodes" }, "node to node"), h("option", { value: "surface" }, "node to surface"));
  readonly element = h("div", { class: "tip ruler", hidden: true, "aria-live": "polite" }, icon("ruler"), this.said, this.mode);

  constructor(private readonly report: Report, private readonly view: () => View3D | null) {}

  show(on: boolean): void {
    this.on = on;
    this.element.hidden = !on;
    this.again();
  }
  private get toSurface(): boolean { return this.mode.value === "surface"; }
  private again(): void {
    this.measured = [];
    this.view()?.setRule([]);
    replace(this.said, this.toSurface ? "Click a node, then a part." : "Click a node, then another one.");
  }

  /** Adds the picked point as an end of the distance. */
  take(p: Picked): void {
    if (p.node < 0) return;
    if (this.toSurface && this.measured.length === 1 && p.part) return this.surface(p);
    if (this.measured.length === 2 || (this.toSurface && this.measured.length === 1)) this.measured = [];
    this.measured.push(p.node);
    this.draw();
  }
  /** Sets two page nodes. */
  set(nodes: number[]): void {
    this.mode.value = "nodes";
    this.show(nodes.length === 2);
    if (!this.on) return;
    this.measured = nodes;
    this.draw();
  }
  private get unit(): string { return this.report.meta.deck.units.working?.length ?? ""; }
  private draw(): void {
    const points = this.measured.map((n) => placeOf(this.report, n));
    this.view()?.setRule(points);
    const ids = this.measured.map((n) => `node ${this.report.nodeId(n)}`);
    if (points.length < 2) return replace(this.said, `${ids[0]} – click ${this.toSurface ? "a part" : "another node"}`);
    const d = points[1].clone().sub(points[0]);
    replace(this.said, h("b", null, `${num(d.length(), 6)} ${this.unit}`), ` ${ids.join(" – ")} · ${d.toArray().map((v) => num(v, 5)).join("  ")}`);
  }

  /** Distance to the nearest point of the clicked part; in the node's own part, of the clicked element. */
  private surface(p: Picked): void {
    const view = this.view();
    const part = p.part!;
    const from = placeOf(this.report, this.measured[0]);
    const own = part.data.node.includes(this.measured[0]);
    const foot = part.faces && nearestOn(view!.parts, part.faces, from, own ? (t) => part.triangleElement[t] === p.item : null);
    if (!foot) return;
    view!.setRule([from, foot.point]);
    const d = foot.point.clone().sub(from);
    replace(this.said, h("b", null, `${num(d.length(), 5)} ${this.unit}`),
      ` node ${this.report.nodeId(this.measured[0])} – ${own ? "element" : `part ${this.report.partText(part.data.part)}, element`} ${part.element[part.triangleElement[foot.triangle]]} · ${d.toArray().map((v) => num(v, 5)).join("  ")}`);
    this.measured = [];
  }
}

/** Nearest point of a surface; `only` filters triangles. */
export function nearestOn(parts: Parts3D, mesh: Mesh, from: Vector3, only: ((triangle: number) => boolean) | null): { point: Vector3; triangle: number } | null {
  const { geometry } = mesh;
  if (!only) {
    parts.prepare(mesh);
    const found = (geometry.boundsTree as MeshBVH).closestPointToPoint(from);
    return found && { point: found.point, triangle: found.faceIndex };
  }
  const index = geometry.index!;
  const position = geometry.attributes.position;
  const t = new Triangle();
  let best: { point: Vector3; triangle: number } | null = null;
  for (let i = 0; 3 * i < index.count; i++) {
    if (!only(i)) continue;
    t.setFromAttributeAndIndices(position as never, index.getX(3 * i), index.getX(3 * i + 1), index.getX(3 * i + 2));
    const point = t.closestPointToPoint(from, new Vector3());
    if (!best || point.distanceTo(from) < best.point.distanceTo(from)) best = { point, triangle: i };
  }
  return best;
}
