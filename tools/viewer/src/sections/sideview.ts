// Side view of a pair, to scale: main side with half thickness, gap above it, node with half thickness, depth in red, action of
// the solver as a ghost; below it the equation.
import { h, num, svg } from "../dom";
import type { Hit, Report } from "../report";

const [width, height, left, right, margin] = [280, 134, 6, 176, 10];

/** Lengths of a pair normal to the main side; `at`: node above the surface, negative below. */
export interface Heights {
  gap: number;
  depth: number;
  at: number;
  distance: number;
  main: number; // half thickness
  secondary: number;
}

export function heightsOf(report: Report, x: Hit): Heights {
  const data = report.data.contacts[x.contact];
  const meta = report.meta.contacts[x.contact];
  const { secondary: s, main: m } = x.row;
  // The page has half thicknesses of nodes and full ones of others; for TYPE24 and TYPE25 resulting gaps.
  const half = meta.modern ? [1, 1] : [report.isEdge(x.row) ? 0.5 : 1, 0.5];
  return {
    gap: x.row.gap, depth: x.depth, at: x.row.gap - x.depth, distance: x.row.distance,
    main: half[1] * data.mainThickness[m], secondary: half[0] * data.secondaryThickness[s],
  };
}

const near = (a: number, b: number, v: Heights) => Math.abs(a - b) <= 1e-6 * Math.max(v.gap, v.depth);

/** "depth 0.35 = gap 1.25 − distance 0.9" */
export function equation(v: Heights): string {
  const { gap, depth, at, distance } = v;
  if (near(at, distance, v)) return `depth ${num(depth, 5)} = gap ${num(gap, 5)} − distance ${num(distance, 5)}`;
  if (near(at, -distance, v)) return `depth ${num(depth, 5)} = gap ${num(gap, 5)} + distance ${num(distance, 5)}: the node is behind the surface`;
  return `depth ${num(depth, 5)} of a gap of ${num(gap, 5)}: at the rim of a surface the gap is rounded off`;
}

/** Gap or position of the node after the solver's action. */
function ghostOf(x: Hit, at: number): { gap: number | null; node: number | null; off: "node" | "segment" | null } {
  const r = x.row;
  const out = { gap: null as number | null, node: null as number | null, off: null as "node" | "segment" | null };
  if (r.gap0 !== null) out.gap = r.gap0;
  if (r.action === "offset-stored") out.gap = r.gap - r.stored;
  if (r.movedBy) out.node = at + Math.hypot(...r.movedBy);
  if (r.action === "node-stiffness-zero") out.off = "node";
  if (r.action === "segment-stiffness-zero" || r.action === "edge-stiffness-zero") out.off = "segment";
  return out;
}

export function sideView(report: Report, x: Hit): HTMLElement | null {
  const v = heightsOf(report, x);
  if (report.unbounded(v.gap) || !(v.gap > 0 || v.depth > 0)) return null;
  const ghost = ghostOf(x, v.at);
  const edge = report.isEdge(x.row);
  const solid = v.main === 0;
  const low = Math.min(solid ? -0.12 * Math.max(v.gap, v.depth) : -v.main, v.at - v.secondary, 0);
  const high = Math.max(v.gap, v.at + v.secondary, (ghost.node ?? 0) + v.secondary);
  const scale = (height - 2 * margin) / (high - low);
  const y = (above: number) => height - margin - (above - low) * scale;
  const node = (left + right) / 2;
  const line = (kind: string, above: number, from = left, to = right) => svg("line", { class: kind, x1: from, x2: to, y1: y(above), y2: y(above) });
  const upright = (kind: string, at: number, from: number, to: number) => svg("line", { class: kind, x1: at, x2: at, y1: y(from), y2: y(to) });
  const dot = (kind: string, above: number) => svg("circle", { class: kind, cx: node, cy: y(above), r: 4 });
  const round = (kind: string, above: number) => svg("circle", { class: kind, cx: node, cy: y(above), r: Math.max(v.secondary * scale, 0) });
  // Shifts overlapping names, from below.
  const names: [number, string, string][] = [[0, edge ? "edge" : "segment", "name"], [v.gap, `gap ${num(v.gap)}`, "name"], [(v.at + v.gap) / 2, `depth ${num(v.depth)}`, "name deep"]];
  if (ghost.gap !== null && ghost.gap > 0 && ghost.gap < 0.97 * v.gap) names.push([ghost.gap, `left ${num(ghost.gap)}`, "name ghost"]);
  if (ghost.node !== null) names.push([ghost.node, "moved here", "name ghost"]);
  names.sort((a, b) => a[0] - b[0]);
  let last = Infinity;
  const labels = names.map(([above, text, kind]) => {
    const at = Math.min(y(above), last - 14);
    last = at;
    return svg("g", null, svg("path", { class: "leader", d: `M${right + 2} ${y(above)}L${right + 12} ${at}` }), svg("text", { class: kind, x: right + 15, y: Math.max(at, 10) + 4 }, text));
  });
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "side-view", role: "img", "aria-label": `Side view: ${equation(v)}`, "data-scale": scale },
    svg("rect", { class: "band", x: left, width: right - left, y: y(v.gap), height: v.gap * scale }),
    solid ? svg("rect", { class: "main", x: left, width: right - left, y: y(0), height: Math.max(y(low) - y(0), 0) })
      : svg("rect", { class: "main", x: left, width: right - left, y: y(v.main), height: 2 * v.main * scale }),
    round("half", v.at),
    line(ghost.off === "segment" ? "surface off" : "surface", 0),
    line("gap-end", v.gap),
    ghost.gap !== null && ghost.gap > 0 && line("ghost-line", ghost.gap),
    upright("gap-length", left + 8, 0, v.gap),
    upright("distance", node, 0, v.at),
    upright("depth", node, v.at, v.gap),
    ghost.node !== null && round("ghost-line", ghost.node),
    ghost.node !== null && dot("ghost-dot", ghost.node),
    dot(ghost.off === "node" ? "dot off" : "dot", v.at),
    ...labels);
  return h("figure", { class: "side" }, drawing, h("figcaption", null, equation(v)));
}
