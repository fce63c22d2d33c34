// Lines over the picture: edges of crossed elements, ties, the ways of nodes that a repair has moved.
import type { Crossings } from "schema/page";
import type { Look } from "../../look";
import type { Report } from "../../report";
import { segmentOf } from "../../sections/crossed";
import { tieLines } from "../../tied";
import type { View3D } from "../view3d";

type Crossing = Crossings["rows"][0];

/** Sides of a polygon of page nodes, six numbers each. */
export function outline(report: Report, nodes: number[]): number[] {
  const x = report.nodePositions;
  return nodes.flatMap((a, k) => {
    const b = nodes[(k + 1) % nodes.length];
    return [...x.subarray(3 * a, 3 * a + 3), ...x.subarray(3 * b, 3 * b + 3)];
  });
}

/** Those of `rows`: edges in red, segments in orange. */
export function drawCrossed(view: View3D, report: Report, rows: readonly Crossing[], dark: boolean): void {
  if (rows.length === 0) return view.crossed.set([]);
  const x = report.nodePositions;
  const edges = rows.flatMap((r) => [...x.subarray(3 * r[1], 3 * r[1] + 3), ...x.subarray(3 * r[2], 3 * r[2] + 3)]);
  view.crossed.set([
    { ends: Float32Array.from(rows.flatMap((r) => outline(report, segmentOf(report, r)))), color: dark ? "#ffb454" : "#b45309", width: 1.5 },
    { ends: Float32Array.from(edges), color: dark ? "#ff6b81" : "#c1123f", width: 4 }]);
}

/** Ties of an interface, or of all. */
export function drawTies(view: View3D, report: Report, inter: number | null, on: boolean, dark: boolean): void {
  if (!on) return view.ties.set([]);
  const { tied, lost, lostNodes } = tieLines(report, inter);
  const [own, bad] = dark ? ["#b79bff", "#ff5fc4"] : ["#6d3fd4", "#c2087f"];
  view.ties.set([{ ends: tied, color: own, width: 1.5 }, { ends: lost, color: bad, width: 3 }], { at: lostNodes, color: bad });
}

export function drawMoved(view: View3D, report: Report, look: Look): void {
  const x = report.nodePositions;
  const ends = (report.moved?.rows ?? []).flatMap((r) => [0, 1, 2].map((k) => x[3 * r[0] + k] - r[k + 1]).concat([0, 1, 2].map((k) => x[3 * r[0] + k])));
  view.moved.set([{ ends: Float32Array.from(ends), color: look.dark ? "#7cc7ff" : "#1d4ed8", width: 2.5 }]);
}
