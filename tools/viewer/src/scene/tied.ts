// Lines of ties: from each node to the nearest point of the segment that it is tied to, or that is nearest to it.
import { Triangle, Vector3 } from "three";
import { Holds } from "../meta";
import type { Report } from "../report";
import { cornersOf } from "../sections/untied";

export interface TieLines {
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
export function tieLines(report: Report, inter: number | null): TieLines {
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
