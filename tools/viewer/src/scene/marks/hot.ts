// What of the model penetrates, crosses or is pushed: elements that stand out, and arrows of nodal forces.
import { Color } from "three";
import type { Crossings } from "schema/page";
import type { Report } from "../../report";
import { segmentOf } from "../../sections/crossed";
import type { Arrow } from "./markers";
import { elementKey, type Parts3D } from "../parts3d";

type Crossing = Crossings["rows"][0];

/** The two elements of a crossing. */
export function crossedElements(report: Report, row: Crossing): Set<number> {
  const main = report.data.contacts[row[0]].mainOwner;
  return new Set([elementKey(row[3], row[4]), ...(main.kind[row[5]] > 0 ? [elementKey(main.kind[row[5]] - 1, main.id[row[5]])] : [])]);
}

/** Penetrating elements: around penetrating nodes, and the elements of main sides and edges; those of a crossing alone. */
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

/** Nodal forces, largest first: length by size, colour by what the colours show. */
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
