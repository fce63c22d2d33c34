// Ties: untied nodes for tables, picture and panel; lines from each node to the nearest point of its segment, or of the nearest
// segment.
import type { TieLines } from "schema/page";
import { Triangle, Vector3 } from "three";
import type { Report } from "./report";

/** State of a node of a tie: tied, lost, tied beyond the rim of its segment, or bound by another condition. */
export const Holds = { tied: 0, lost: 1, beyondRim: 2, elsewhere: 3 } as const;

/** A row with its tie. */
export interface Untied {
  tie: number;
  row: TieLines["rows"][0];
}

/** Page node of a row. */
export const nodeOf = (report: Report, { tie, row }: Untied): number => report.ties[tie].nodes[row[0]];

/** Corners of a tied node's segment as page nodes, three for a triangle; empty without segment. */
export function cornersOf(report: Report, tie: number, node: number): number[] {
  const { main, segment } = report.ties[tie];
  const s = segment[node];
  if (s < 0) return [];
  const n = main.slice(4 * s, 4 * s + 4);
  return n[2] === n[3] ? n.slice(0, 3) : n;
}

export interface TieStrokes {
  tied: Float32Array; // six numbers per line
  lost: Float32Array;
  lostNodes: Float32Array; // including nodes without segment
}

/** Nearest point of a segment; a quad is two triangles. */
export function footOn(corners: Vector3[], p: Vector3): Vector3 {
  const t = new Triangle();
  let best = corners[0];
  let near = Infinity;
  for (let k = 2; k < corners.length; k++) {
    const q = t.set(corners[0], corners[k - 1], corners[k]).closestPointToPoint(p, new Vector3());
    const d = q.distanceToSquared(p);
    if (d < near) [best, near] = [q, d];
  }
  return best;
}

/** Lines of one interface's ties, or of all. Nodes bound by another condition have none. */
export function tieLines(report: Report, inter: number | null): TieStrokes {
  const x = report.nodePositions;
  const at = (n: number) => new Vector3(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
  const [tied, lost, lostNodes]: number[][] = [[], [], []];
  report.ties.forEach((tie, i) => {
    if (inter !== null && report.meta.ties[i].interface !== inter) return;
    tie.nodes.forEach((node, k) => {
      if (tie.holds[k] === Holds.elsewhere) return;
      const p = at(node);
      if (!Number.isFinite(p.x)) return;
      const gone = tie.holds[k] === Holds.lost;
      if (gone) lostNodes.push(...p.toArray());
      const corners = cornersOf(report, i, k).map(at);
      if (corners.length === 0 || !corners.every((c) => Number.isFinite(c.x))) return;
      (gone ? lost : tied).push(...p.toArray(), ...footOn(corners, p).toArray());
    });
  });
  return { tied: Float32Array.from(tied), lost: Float32Array.from(lost), lostNodes: Float32Array.from(lostNodes) };
}
