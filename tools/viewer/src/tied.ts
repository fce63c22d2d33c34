// Ties: nodes that are not tied, as tables, picture and panel name them, and the lines from each node to the nearest point of the
// segment that it is tied to, or that is nearest to it.
import type { TieLines } from "schema/page";
import { Triangle, Vector3 } from "three";
import type { Report } from "./report";

/** What becomes of a node of a tie: tied, lost, tied from beyond the rim of its segment, held by something else. */
export const Holds = { tied: 0, lost: 1, beyondRim: 2, elsewhere: 3 } as const;

/** A row with the tie that it belongs to. */
export interface Untied {
  tie: number;
  row: TieLines["rows"][0];
}

/** Page node of a row. */
export const nodeOf = (report: Report, { tie, row }: Untied): number => report.ties[tie].nodes[row[0]];

/** Corners of the segment of a node of a tie as page nodes, a triangle's fourth left out; empty: there is none. */
export function cornersOf(report: Report, tie: number, node: number): number[] {
  const { main, segment } = report.ties[tie];
  const s = segment[node];
  if (s < 0) return [];
  const n = main.slice(4 * s, 4 * s + 4);
  return n[2] === n[3] ? n.slice(0, 3) : n;
}

export interface TieStrokes {
  tied: Float32Array; // six numbers a line
  lost: Float32Array;
  lostNodes: Float32Array; // also those without a segment
}

/** Nearest point of a segment; quads are two triangles. */
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

/** Of the ties of an interface, or of all. What something else holds has no line. */
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
