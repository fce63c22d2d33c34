// Highlights: elements that penetrate, cross or have forces, arrows of nodal forces; lines over the picture: crossed elements,
// ties, ways of moved nodes.
import type { Crossings } from "schema/page";
import { Color } from "three";
import type { Look } from "../../look";
import type { Report } from "../../report";
import { segmentOf } from "../../sections/crossed";
import { tieLines } from "../../tied";
import { elementKey, type Parts3D } from "../parts3d";
import type { View3D } from "../view3d";
import type { Arrow } from "./markers";

type Crossing = Crossings["rows"][0];

/** Sides of a polygon of page nodes, six numbers each. */
export function outline(report: Report, nodes: number[]): number[] {
  const x = report.nodePositions;
  return nodes.flatMap((a, k) => {
    const b = nodes[(k + 1) % nodes.length];
    return [...x.subarray(3 * a, 3 * a + 3), ...x.subarray(3 * b, 3 * b + 3)];
  });
}

/** Crossings in `rows`: edges red, segments orange. */
export function drawCrossed(view: View3D, report: Report, rows: readonly Crossing[], dark: boolean): void {
  if (rows.length === 0) return view.crossed.set([]);
  const x = report.nodePositions;
  const edges = rows.flatMap((r) => [...x.subarray(3 * r[1], 3 * r[1] + 3), ...x.subarray(3 * r[2], 3 * r[2] + 3)]);
  view.crossed.set([
    { ends: Float32Array.from(rows.flatMap((r) => outline(report, segmentOf(report, r)))), color: dark ? "#ffb454" : "#b45309", width: 1.5, what: "crossed segment" },
    { ends: Float32Array.from(edges), color: dark ? "#ff6b81" : "#c1123f", width: 4, what: "crossing edge" }]);
}

/** Ties of an interface, or of all. */
export function drawTies(view: View3D, report: Report, inter: number | null, on: boolean, dark: boolean): void {
  if (!on) return view.ties.set([]);
  const { tied, lost, lostNodes } = tieLines(report, inter);
  const [own, bad] = dark ? ["#b79bff", "#ff5fc4"] : ["#6d3fd4", "#c2087f"];
  view.ties.set([{ ends: tied, color: own, width: 1.5, what: "tied" }, { ends: lost, color: bad, width: 3, what: "not tied" }], { at: lostNodes, color: bad, what: "not tied" });
}

export function drawMoved(view: View3D, report: Report, look: Look): void {
  const x = report.nodePositions;
  const ends = (report.moved?.rows ?? []).flatMap((r) => [0, 1, 2].map((k) => x[3 * r[0] + k] - r[k + 1]).concat([0, 1, 2].map((k) => x[3 * r[0] + k])));
  view.moved.set([{ ends: Float32Array.from(ends), color: look.dark ? "#7cc7ff" : "#1d4ed8", width: 2.5, what: "way of a moved node" }]);
}

/** The two elements of a crossing. */
export function crossedElements(report: Report, row: Crossing): Set<number> {
  const main = report.data.contacts[row[0]].mainOwner;
  return new Set([elementKey(row[3], row[4]), ...(main.kind[row[5]] > 0 ? [elementKey(main.kind[row[5]] - 1, main.id[row[5]])] : [])]);
}

/** Penetrating elements: at penetrating nodes, and of main sides and edges; with `crossing` only its elements. */
export function markHot(parts: Parts3D, report: Report, crossing: Crossing | null): void {
  const node = new Uint8Array(report.mesh.nodeId.length);
  const touched = new Uint8Array(node.length);
  if (crossing) {
    for (const n of [crossing[1], crossing[2], ...segmentOf(report, crossing)]) touched[n] = 1;
    return parts.setHot(node, touched, () => crossedElements(report, crossing));
  }
  const { filtered } = report;
  for (const x of filtered) {
    const data = report.data.contacts[x.contact];
    const { secondary, main } = x.row;
    const edge = report.isEdge(x.row);
    const few = edge ? 2 : 1;
    const many = edge ? 2 : 4;
    if (!edge) node[data.secondaryNode[secondary]] = 1;
    for (let k = 0; k < few; k++) touched[data.secondaryNode[few * secondary + k]] = 1;
    for (let k = 0; k < many; k++) touched[data.mainNode[many * main + k]] = 1;
  }
  parts.setHot(node, touched, () => {
    const out = new Set<number>();
    for (const { contact, row } of filtered) {
      const { secondaryListed, secondaryOwner: s, mainOwner: m } = report.data.contacts[contact];
      const at = secondaryListed[row.secondary];
      if (report.isEdge(row)) out.add(elementKey(s.kind[at] - 1, s.id[at]));
      out.add(elementKey(m.kind[row.main] - 1, m.id[row.main]));
    }
    return out;
  });
}

/** Nodal forces, largest first: length by size, colour by the present scale. */
export function forceArrows(report: Report, color: (node: number) => [number, number, number]): Arrow[] {
  const x = report.nodePositions;
  const size = (n: readonly number[]) => Math.hypot(n[1], n[2], n[3]);
  const nodes = (report.acted ?? []).filter((n) => size(n) > 0).sort((a, b) => size(b) - size(a));
  const c = new Color();
  return nodes.map((n) => {
    const [r, g, b] = color(n[0]);
    return {
      at: [x[3 * n[0]], x[3 * n[0] + 1], x[3 * n[0] + 2]], along: [n[1], n[2], n[3]], length: 0.2 + 0.8 * (size(n) / size(nodes[0])),
      rgb: c.setRGB(r / 255, g / 255, b / 255, "srgb").toArray() as [number, number, number],
    };
  });
}
