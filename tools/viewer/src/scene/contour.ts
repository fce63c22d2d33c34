// Values per page node for the coloured surface.
import { lengths, type Steps } from "../data";
import { num } from "../dom";
import { ofCycle, type ContourKind } from "../look";
import type { Hit, Report } from "../report";
import { pairGap, sideGaps } from "../what_if";

export interface Contour {
  /** In [0, 1], by page node; NaN: no value. */
  values: Float32Array | null;
  top: number;
  of(hit: Hit): number; // value of a row in [0, 1]
  /** Value at a position of the scale. */
  tick(t: number): string;
  /** Adjustable limits; none if the scale is not linear. */
  scaled?: { low: number; high: number };
  /** Values before adjusted limits. */
  unscaled?: Float32Array | null;
}

/** Forces, stiffness and time steps of nodes; the smallest step is the hottest. */
function cycleContour(report: Report, kind: ContourKind): Contour {
  const values = new Float32Array(report.mesh.nodeId.length).fill(NaN);
  const nodes = report.acted ?? [];
  const raw = (n: (typeof nodes)[0]) => (kind === "force" ? Math.hypot(n[1], n[2], n[3]) : kind === "stiffness" ? n[4] : n[5] === null ? 0 : 1 / n[5]);
  const top = nodes.reduce((m, n) => Math.max(m, raw(n)), 0) || 1;
  for (const n of nodes) values[n[0]] = raw(n) / top;
  const of = (x: Hit) => [...report.secondaryNodes(x.row), ...report.mainNodes(x.row)].reduce((m, n) => (values[n] > m ? values[n] : m), 0);
  return { values, top, of, tick: (t) => (kind !== "step" ? num(t * top, 3) : t === 0 ? "∞" : num(1 / (t * top), 3)) };
}

/** Steps of elements in equal ratios; the smallest is the hottest. */
function stepContour({ low, high, largest, values }: Steps, report: Report): Contour {
  const of = (x: Hit) => [...report.secondaryNodes(x.row), ...report.mainNodes(x.row)].reduce((m, n) => (values[n] > m ? values[n] : m), 0);
  return { values, top: 1 / low, of, tick: (t) => (t === 0 && largest > high ? "≥ " : "") + num(high * (low / high) ** t, 3) };
}

export function contourOf(report: Report, kind: ContourKind, hits: Hit[]): Contour {
  if (kind === "element" && report.steps) return stepContour(report.steps, report);
  if (ofCycle(kind)) return cycleContour(report, kind);
  const n = report.mesh.nodeId.length;
  const scale = (top: number) => (t: number) => num(t * top, 3);
  const pick = kind === "ratio" ? (x: Hit) => x.ratio : kind === "gap" ? (x: Hit) => x.row.gap : (x: Hit) => x.depth;
  if (kind === "none" || kind === "depth" || kind === "ratio") {
    let top = 0;
    const sure = report.bounded(hits);
    for (const x of sure) { const v = pick(x); if (v > top) top = v; }
    top ||= 1;
    const of = (x: Hit) => Math.min(1, pick(x) / top);
    if (kind === "none") return { values: null, top, of, tick: scale(top) };
    const values = new Float32Array(n).fill(NaN);
    for (const x of sure) {
      const v = pick(x) / top;
      const { secondaryNode, mainNode } = report.data.contacts[x.contact];
      const { secondary, main } = x.row;
      const edge = report.isEdge(x.row);
      const few = edge ? 2 : 1;
      const many = edge ? 2 : 4;
      // A point on a side of a segment has a mark; the side is not what penetrates.
      if (!report.meta.contacts[x.contact].points) for (let i = few * secondary; i < few * secondary + few; i++) if (!(values[secondaryNode[i]] >= v)) values[secondaryNode[i]] = v;
      for (let i = many * main; i < many * main + many; i++) if (!(values[mainNode[i]] >= v)) values[mainNode[i]] = v;
    }
    return { values, top, of, tick: scale(top) };
  }
  const raw = new Float32Array(n).fill(NaN);
  const position = report.nodePositions;
  const most = kind === "gap" ? report.meta.largest_gap : Infinity;
  const set = (node: number, v: number) => { if (v <= most && !(raw[node] >= v)) raw[node] = v; };
  report.meta.contacts.forEach((meta, i) => {
    if (report.filter.interface !== null && meta.interface !== report.filter.interface) return;
    const data = report.data.contacts[i];
    const edges = meta.kind === "edge_edge";
    const s = report.results[i].setting;
    const { gs, gm } = sideGaps(meta, data, s);
    const thickest = (gaps: Float64Array) => gaps.reduce((m, g) => Math.max(m, g), 0);
    const width = edges ? 2 : 4;
    const mains = data.mainNode.length / width;
    const perSecondary = edges ? 2 : 1;
    const secondaries = data.secondaryNode.length / perSecondary;
    const gsTop = thickest(gs);
    const gmTop = thickest(gm);
    const limits = lengths(data.mainLength);
    for (let m = 0; m < mains; m++) {
      const at = data.mainListed[m];
      const length = at >= 0 ? limits[at] : Infinity;
      const gap = pairGap(s, gsTop, gm[m], meta.longest_node || Infinity, length);
      const nodes = data.mainNode.subarray(width * m, width * m + width);
      if (report.unbounded(gap)) continue;
      const v = kind === "gap" ? gap : gap / shortestSide(position, nodes);
      if (Number.isFinite(v)) for (const node of nodes) set(node, v);
    }
    if (kind === "gap")
      for (let k = 0; k < secondaries; k++) {
        const gap = pairGap(s, gs[k], gmTop, Infinity, Infinity);
        for (let j = 0; j < perSecondary; j++) set(data.secondaryNode[perSecondary * k + j], gap);
      }
  });
  let top = 0;
  for (const v of raw) if (v > top) top = v;
  top = top || 1;
  const values = raw.map((v) => v / top);
  const rowValue = (x: Hit) => {
    if (kind === "gap") return Math.min(1, x.row.gap / top);
    const side = shortestSide(position, Uint32Array.from(report.mainNodes(x.row)));
    return Math.min(1, x.row.gap / side / top);
  };
  return { values, top, of: rowValue, tick: scale(top) };
}

function shortestSide(position: Float32Array, nodes: Uint32Array): number {
  let best = Infinity;
  for (let k = 0; k < nodes.length; k++) {
    const a = 3 * nodes[k];
    const b = 3 * nodes[(k + 1) % nodes.length];
    if (a === b) continue;
    const d = Math.hypot(position[a] - position[b], position[a + 1] - position[b + 1], position[a + 2] - position[b + 2]);
    if (d > 0 && d < best) best = d;
  }
  return best;
}
