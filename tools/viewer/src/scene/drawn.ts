// Positions of rows in the picture. Pairs that penetrate only with changed settings have no normal and weight in the page; they
// are computed here from the nearest points of both sides.
import { Vector3 } from "three";
import type { Report } from "../report";
import type { Row } from "../rows";
import { footOn } from "../tied";

/** Position of a page node; NaN: node without element. */
export const placeOf = (report: Report, node: number): Vector3 => new Vector3().fromArray(report.nodePositions, 3 * node);

/** Exact position of a node with pairs. */
export function exactAt(report: Report, node: number): Vector3 {
  const { x, y, z, exactOf } = report.data;
  const i = exactOf[node];
  return new Vector3(x[i], y[i], z[i]);
}

/** Nearest points of two edges, the secondary first. */
function nearestPoints([a, b]: Vector3[], [c, d]: Vector3[]): [Vector3, Vector3] {
  const [s, m, w] = [b.clone().sub(a), d.clone().sub(c), a.clone().sub(c)];
  const [ss, sm, mm] = [s.dot(s), s.dot(m), m.dot(m)];
  const det = ss * mm - sm * sm;
  const within = (v: number) => Math.min(Math.max(v || 0, 0), 1);
  const t = within((sm * w.dot(s) * -1 + ss * w.dot(m)) / det); // along the main edge
  const u = within((t * sm - w.dot(s)) / ss);
  const v = within((u * sm + w.dot(m)) / mm);
  return [a.clone().addScaledVector(s, u), c.clone().addScaledVector(m, v)];
}

const edges = (report: Report, row: Row): [Vector3, Vector3] => {
  const at = (n: number) => exactAt(report, n);
  return nearestPoints(report.secondaryNodes(row).map(at), report.mainNodes(row).map(at));
};

/** The node, or the nearest point of the secondary edge. */
export function pointOf(report: Report, row: Row): Vector3 {
  const known = report.point(row);
  return known ? new Vector3(...known) : edges(report, row)[0];
}

/** From main to secondary side; 0 for a point on the surface. */
export function wayOut(report: Report, row: Row): Vector3 {
  if (row.normal) return new Vector3(...row.normal);
  if (row.onSurface) return new Vector3();
  if (report.isEdge(row)) { const [point, foot] = edges(report, row); return point.sub(foot).normalize(); }
  const point = pointOf(report, row);
  return point.clone().sub(footOn(report.mainNodes(row).map((n) => exactAt(report, n)), point)).normalize();
}
