// Nodes of ties that are not tied, as tables, picture and panel name them.
import type { TieRow } from "../meta";
import type { Report } from "../report";

/** A row with the tie that it belongs to. */
export interface Untied {
  tie: number;
  row: TieRow;
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
