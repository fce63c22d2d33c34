// Evaluates all contacts for given card values, as libdeck/contact/{scene/scene,rules/gaps,rules/penetrations}.cpp do:
// pair gaps, penetrations, and what Inacti and Fpenmax do about each. Same order of operations, so
// the numbers are those of `deck gaps --what-if`. Inacti 3 moves nodes, and later contacts see that.
import type { ContactData, Contacts } from "./data";
import { closestBetweenEdges, closestOnSegment, edge, sub, type Points } from "./kernel";
import type { CardValues, ContactMeta, Meta, Overrides, Totals } from "./meta";
import { removedEdgePairs, removedPairs } from "./removal";

export type Action =
  | "none"
  | "node-stiffness-zero"
  | "segment-stiffness-zero"
  | "node-moved"
  | "gap-reduced"
  | "edge-stiffness-zero";

export interface Row {
  contact: number;
  secondary: number;
  main: number;
  depth: number;
  gap: number;
  distance: number;
  normal: [number, number, number];
  onSurface: boolean;
  action: Action;
  gap0: number | null;
  p0: number | null;
  movedBy: [number, number, number] | null;
  weight: number; // edges: weight of the first secondary node
}

/** Effective options of one contact. */
export interface Setting {
  igap: number;
  inacti: number;
  irem: number;
  fpenmax: number;
  scale: number;
  gapmin: number;
  gapminFrom: string;
  gapmax: number;
  maxGap: number;
  drad: number;
}

export interface Result {
  setting: Setting;
  rows: Row[]; // in the solver's order
  totals: Totals;
  /** Largest pair gap that occurs, to be compared with the reach of the pairs. */
  reached: number;
  complete: boolean; // false: a gap exceeds what this page carries
}

const inflation = 1e-8;
const groupSize = 128;

const max = (list: Float64Array) => {
  let m = 0;
  for (const v of list) if (v > m) m = v;
  return m;
};
const at0 = (v: number | null) => v ?? Infinity;

/** Card values of a contact with overrides applied. */
export function cardOf(meta: ContactMeta, overrides: Overrides): CardValues {
  const card = { ...meta.card };
  if (overrides.Gapmin !== undefined) card.Gapmin = overrides.Gapmin;
  if (overrides.Fscalegap !== undefined) card.Fscalegap = overrides.Fscalegap;
  if (overrides.Gapmax !== undefined) card.Gapmax = overrides.Gapmax;
  if (overrides.Fpenmax !== undefined) card.Fpenmax = overrides.Fpenmax;
  if (overrides.Igap !== undefined) card.Igap = overrides.Igap === 1000 ? 0 : overrides.Igap;
  if (overrides.Inacti !== undefined) card.Inacti = overrides.Inacti === 1000 ? 0 : overrides.Inacti;
  return card;
}

export function settingOf(meta: ContactMeta, data: ContactData, overrides: Overrides, isType19: boolean): Setting {
  const card = cardOf(meta, overrides);
  const edges = meta.kind === "edge_edge";
  if (isType19) {
    if (edges) {
      card.Igap = card.Igap === 2 ? 1 : card.Igap === 4 ? 0 : card.Igap;
      if (card.Edge_scale_gap !== 0) card.Gapmin *= card.Edge_scale_gap;
    } else if (card.Igap === 4) {
      card.Igap = 2;
      card.Irem_gap = 2;
    }
  }
  const s: Setting = {
    igap: card.Igap,
    inacti: card.Inacti,
    irem: card.Irem_gap,
    fpenmax: card.Fpenmax,
    scale: !edges && card.Igap >= 2 && card.Fscalegap !== 0 ? card.Fscalegap : 1,
    gapmin: card.Gapmin,
    gapminFrom: "card",
    gapmax: !edges && card.Igap >= 2 && card.Gapmax > 0 ? card.Gapmax : 1e30,
    maxGap: 0,
    drad: 0,
  };
  const variable = s.igap !== 0;
  if (!(s.gapmin > 0)) defaultGap(meta, s, edges, variable && meta.type !== 10);
  if (edges) {
    const a = variable ? 0.5 * max(data.mainThickness) : 0;
    const b = variable ? 0.5 * max(data.secondaryThickness) : 0;
    s.maxGap = Math.max(a + b, s.gapmin);
  } else {
    let sum = variable ? s.scale * 0.5 * max(data.mainThickness) + s.scale * max(data.secondaryThickness) : 0;
    if (s.igap === 3) sum = Math.min(sum, meta.longest_main + meta.longest_node);
    s.maxGap = variable ? Math.min(Math.max(sum, s.gapmin), s.gapmax) : s.gapmin;
  }
  if (card.thermal)
    s.drad = card.Drad === 0 ? Math.max(s.maxGap, meta.shortest_side) : Math.max(card.Drad, s.maxGap);
  return s;
}

function defaultGap(meta: ContactMeta, s: Setting, edges: boolean, variable: boolean): void {
  const d = meta.default;
  if (edges) {
    // Main side, then secondary: samples, sum, smallest, shortest edge.
    const side = (i: number) => {
      const half = 0.5 * d[i + 3]!;
      if (d[i] === 0) return 0.2 * half;
      return Math.min(half, variable ? at0(d[i + 2]) : d[i + 1]! / d[i]!);
    };
    s.gapmin = 0.5 * (side(0) + side(4));
    s.gapminFrom = "mean of the defaults of both sides";
    return;
  }
  // Shell segments: count, sum of thickness, smallest.
  const half = 0.5 * meta.shortest_side;
  if (d[0] === 0) {
    s.gapmin = 0.1 * meta.shortest_side;
    s.gapminFrom = "a tenth of the shortest main side";
    return;
  }
  const t = variable ? s.scale * at0(d[2]) : d[1]! / d[0]!;
  s.gapmin = half < t ? half : t;
  s.gapminFrom =
    half < t
      ? "half the shortest main side"
      : variable
        ? s.scale === 1
          ? "smallest thickness of the main shells"
          : "Fscalegap times the smallest thickness of the main shells"
        : "mean thickness of the main shells";
}

/** Pair gap from what the two sides bring. */
export function pairGap(s: Setting, edges: boolean, gs: number, gm: number, ls: number, lm: number): number {
  if (s.igap === 0) return s.gapmin;
  let gap = gs + gm;
  if (s.igap === 3) gap = Math.min(gap, ls + lm);
  if (!edges) gap = Math.min(gap, s.gapmax);
  return Math.max(gap, s.gapmin);
}

export function sideGaps(s: Setting, edges: boolean, data: ContactData): { gs(i: number): number; gm(i: number): number } {
  const variable = s.igap !== 0;
  if (!variable) return { gs: () => 0, gm: () => 0 };
  const ts = data.secondaryThickness;
  const tm = data.mainThickness;
  if (edges) return { gs: (i) => 0.5 * ts[i], gm: (i) => 0.5 * tm[i] };
  return { gs: (i) => s.scale * ts[i], gm: (i) => s.scale * 0.5 * tm[i] };
}

export function on_surface_error(meta: ContactMeta, s: Setting): number {
  if (meta.kind === "edge_edge" || s.fpenmax !== 0 || s.inacti === 1 || s.inacti === 2) return 0;
  if (meta.type === 10 && meta.itied !== 0) return 0;
  return s.inacti === 0 ? 612 : 611;
}

export class Evaluator {
  private readonly type19: boolean[];

  constructor(
    readonly meta: Meta,
    readonly data: Contacts,
  ) {
    this.type19 = meta.contacts.map((c) => meta.interfaces[c.interface].type === 19);
  }

  /** Results of all contacts; `overrides` by position of the interface. `known` supplies results of
   * contacts whose interface did not change, where no node moves. */
  evaluate(overrides: Overrides[], known?: { overrides: Overrides[]; results: Result[] }): Result[] {
    const moves = this.meta.contacts.some((c, i) => this.moves(i, overrides[c.interface]));
    const moved = known !== undefined && this.meta.contacts.some((c, i) => this.moves(i, known.overrides[c.interface]));
    const same = (i: number) => {
      const k = this.meta.contacts[i].interface;
      return JSON.stringify(overrides[k]) === JSON.stringify(known!.overrides[k]);
    };
    const points: Points = moves
      ? { x: this.data.x.slice(), y: this.data.y.slice(), z: this.data.z.slice() }
      : this.data;
    const out: Result[] = [];
    let largestMove = 0;
    for (let i = 0; i < this.meta.contacts.length; i++) {
      if (known && !moves && !moved && same(i)) {
        out.push(known.results[i]);
        continue;
      }
      const r = this.contact(i, overrides[this.meta.contacts[i].interface], points, largestMove);
      for (const row of r.rows)
        if (row.movedBy) largestMove = Math.max(largestMove, Math.hypot(...row.movedBy));
      out.push(r);
    }
    return out;
  }

  setting(i: number, overrides: Overrides): Setting {
    return settingOf(this.meta.contacts[i], this.data.contacts[i], overrides, this.type19[i]);
  }

  private moves(i: number, overrides: Overrides): boolean {
    const meta = this.meta.contacts[i];
    return meta.kind === "node_segment" && cardOf(meta, overrides).Inacti === 3;
  }

  private exact(pageNode: number): number {
    return this.data.exactOf[pageNode];
  }

  /** Below its distance, whatever has moved by `moved` so far. */
  private lowerBound(i: number, moved: number): (pair: number) => number {
    const { pairClass } = this.data.contacts[i];
    const unit = (this.meta.contacts[i].reach / 255) * (1 - 1e-12);
    return (p) => pairClass[p] * unit - 2 * moved;
  }

  private nodePair(c: ContactData, p: number, points: Points): void {
    const m = 4 * c.pairMain[p];
    closestOnSegment(
      points,
      this.exact(c.secondaryNode[c.pairSecondary[p]]),
      this.exact(c.mainNode[m]),
      this.exact(c.mainNode[m + 1]),
      this.exact(c.mainNode[m + 2]),
      this.exact(c.mainNode[m + 3]),
    );
  }

  private edgePair(c: ContactData, p: number, points: Points): void {
    const s = 2 * c.pairSecondary[p];
    const m = 2 * c.pairMain[p];
    closestBetweenEdges(
      points,
      this.exact(c.secondaryNode[s]),
      this.exact(c.secondaryNode[s + 1]),
      this.exact(c.mainNode[m]),
      this.exact(c.mainNode[m + 1]),
    );
  }

  private contact(i: number, overrides: Overrides, points: Points, moved: number): Result {
    const meta = this.meta.contacts[i];
    const data = this.data.contacts[i];
    const setting = this.setting(i, overrides);
    const result: Result = { setting, rows: [], totals: emptyTotals(), reached: 0, complete: true };
    const n = data.pairSecondary.length;
    if (meta.secondary > 0 && meta.main > 0 && !meta.dropped) {
      const gaps = this.gapsOf(i, setting);
      for (let p = 0; p < n; p++) result.reached = Math.max(result.reached, gaps[p]);
      result.reached = Math.max(result.reached, setting.maxGap);
      const exactMove = setting.inacti === 3 && meta.kind === "node_segment" ? setting.maxGap + meta.margin : 0;
      const needed = Math.max(result.reached + 2 * moved, exactMove + 2 * moved);
      result.complete = meta.complete
        ? needed <= meta.reach
        : sameGaps(meta, setting) && meta.totals.pairs === n;
      if (meta.kind === "edge_edge") this.edgeRows(i, setting, gaps, points, moved, result);
      else this.nodeRows(i, setting, gaps, points, moved, result);
    }
    const tally = new Tally();
    tally.add(meta, data, result);
    result.totals = tally.totals();
    return result;
  }

  private gapsOf(i: number, setting: Setting): Float64Array {
    const data = this.data.contacts[i];
    const edges = this.meta.contacts[i].kind === "edge_edge";
    const { gs, gm } = sideGaps(setting, edges, data);
    const n = data.pairSecondary.length;
    const out = new Float64Array(n);
    for (let p = 0; p < n; p++) {
      const s = data.pairSecondary[p];
      const m = data.pairMain[p];
      const ls = data.secondaryLength[data.secondaryListed[s]];
      const lm = data.mainLength[data.mainListed[m]];
      out[p] = pairGap(setting, edges, gs(s), gm(m), ls, lm);
    }
    return out;
  }

  private nodeRows(i: number, s: Setting, gaps: Float64Array, points: Points, moved: number, out: Result): void {
    const meta = this.meta.contacts[i];
    const c = this.data.contacts[i];
    const removed = s.irem === 2 ? removedPairs(meta, c, s, this.data, points) : null;
    const n = c.pairSecondary.length;
    // A whole group of candidates is measured before anything is done about one of them.
    let acted = 0;
    let inGroup = 0;
    const actOnGroup = () => {
      const start = new Map<number, [number, number, number]>();
      for (; acted < out.rows.length; acted++) {
        const row = out.rows[acted];
        this.act(row, s, points, start, this.exact(c.secondaryNode[row.secondary]));
      }
    };
    const candidates = s.inacti === 3 ? this.candidates(i, s, gaps, points, moved) : null;
    const bound = this.lowerBound(i, moved);
    for (let p = 0; p < n; p++) {
      const gap = gaps[p];
      if (candidates ? candidates[p] === 0 : bound(p) >= gap) continue;
      const secondary = c.pairSecondary[p];
      const main = c.pairMain[p];
      if (removed?.has(main * c.secondaryListed.length + secondary)) continue;
      if (inGroup++ === groupSize) {
        actOnGroup();
        inGroup = 1;
      }
      this.nodePair(c, p, points);
      let value = 0;
      let best = 0;
      for (let k = 0; k < 4; k++) {
        const d = gap - sub.distance[k];
        const v = 0 < d ? d : 0;
        if (k === 0 || v > value) {
          value = v;
          best = k;
        }
      }
      if (!(value > 0)) continue;
      const distance = sub.distance[best];
      const row: Row = {
        contact: i, secondary, main, depth: value, gap, distance,
        normal: [0, 0, 0], onSurface: !(distance > 0), action: "none",
        gap0: null, p0: null, movedBy: null, weight: 1,
      };
      if (!row.onSurface) {
        const f = 1 / (1e-30 < distance ? distance : 1e-30);
        row.normal = [f * sub.vector[3 * best], f * sub.vector[3 * best + 1], f * sub.vector[3 * best + 2]];
      }
      out.rows.push(row);
    }
    actOnGroup();
  }

  /** Inacti 3: the pairs that the solver's search finds, before anything moves. */
  private candidates(i: number, s: Setting, gaps: Float64Array, points: Points, moved: number): Uint8Array {
    const c = this.data.contacts[i];
    const { margin } = this.meta.contacts[i];
    const bound = this.lowerBound(i, moved);
    const out = new Uint8Array(gaps.length);
    for (let p = 0; p < gaps.length; p++) {
      const limit = Math.max(s.drad, gaps[p]) + margin;
      if (bound(p) >= limit) continue;
      this.nodePair(c, p, points);
      const [a, b, d, e] = sub.distance;
      if (Math.min(a, b, d, e) < limit) out[p] = 1;
    }
    return out;
  }

  /** `start`: where nodes stood before anything in the group moved. */
  private act(row: Row, s: Setting, points: Points, start: Map<number, [number, number, number]>, node: number): void {
    const pene = row.onSurface ? row.depth : row.depth * (1 + inflation);
    if (s.fpenmax !== 0 && pene > s.fpenmax * row.gap) {
      row.action = "node-stiffness-zero";
      return;
    }
    if (s.inacti === 1) row.action = "node-stiffness-zero";
    else if (s.inacti === 2) row.action = "segment-stiffness-zero";
    else if (s.inacti === 3) {
      const { x, y, z } = points;
      row.action = "node-moved";
      row.movedBy = [0, 0, 0];
      let at = start.get(node);
      if (!at) start.set(node, (at = [x[node], y[node], z[node]]));
      const dx = x[node] - at[0];
      const dy = y[node] - at[1];
      const dz = z[node] - at[2];
      if (pene > Math.sqrt(dx * dx + dy * dy + dz * dz)) {
        row.movedBy = [pene * row.normal[0], pene * row.normal[1], pene * row.normal[2]];
        x[node] = at[0] + row.movedBy[0];
        y[node] = at[1] + row.movedBy[1];
        z[node] = at[2] + row.movedBy[2];
      }
    } else if (s.inacti === 5 || s.inacti === 6) {
      row.action = "gap-reduced";
      row.p0 = s.inacti === 5 ? pene : pene + 0.05 * (row.gap - pene);
      row.gap0 = row.gap - row.p0;
    }
  }

  private edgeRows(i: number, s: Setting, gaps: Float64Array, points: Points, moved: number, out: Result): void {
    const meta = this.meta.contacts[i];
    const c = this.data.contacts[i];
    const removed = s.irem === 2 ? removedEdgePairs(meta, c, s, this.data, points) : null;
    const storedS = new Map<number, number>();
    const storedM = new Map<number, number>();
    const store = (map: Map<number, number>, k: number, v: number) => map.set(k, Math.max(map.get(k) ?? 0, v));
    const bound = this.lowerBound(i, moved);
    for (let p = 0; p < c.pairSecondary.length; p++) {
      const gap = gaps[p];
      if (bound(p) >= gap) continue;
      this.edgePair(c, p, points);
      const distance = edge.distance;
      const depth = gap - distance;
      if (!(depth > 0)) continue;
      const secondary = c.pairSecondary[p];
      const main = c.pairMain[p];
      if (removed?.has(main * c.secondaryListed.length + secondary)) continue;
      const row: Row = {
        contact: i, secondary, main, depth, gap, distance,
        normal: [0, 0, 0], onSurface: !(distance > 0), action: "none",
        gap0: null, p0: null, movedBy: null, weight: edge.weightS,
      };
      if (!row.onSurface) row.normal = [edge.vx / distance, edge.vy / distance, edge.vz / distance];
      if (s.inacti === 1 || s.inacti === 2) row.action = "edge-stiffness-zero";
      else if (s.inacti === 5 || s.inacti === 6) {
        if (depth >= 0.995 * gap) row.action = "edge-stiffness-zero";
        else {
          row.action = "gap-reduced";
          const v = s.inacti === 5 ? depth * (1 + inflation) : depth + 0.05 * (gap - depth);
          store(storedS, secondary, 0.5 * v);
          store(storedM, main, 0.5 * v);
        }
      }
      out.rows.push(row);
    }
    for (const row of out.rows) {
      if (row.action !== "gap-reduced") continue;
      row.p0 = storedS.get(row.secondary)! + storedM.get(row.main)!;
      row.gap0 = row.gap - row.p0;
    }
  }
}

/** True if no pair gap can be larger than in the deck. */
function sameGaps(meta: ContactMeta, s: Setting): boolean {
  return s.igap === meta.igap && s.gapmin === meta.gapmin && s.scale === meta.gap_scale && s.gapmax === meta.gapmax;
}

export function emptyTotals(): Totals {
  return { pairs: 0, nodes: 0, edges: 0, on_segment: { nodes: 0, edges: 0, pairs: 0 }, solver_errors: 0, acted: 0, max_depth: 0, max_ratio: 0 };
}

export function ratioOf(row: Row): number {
  return row.gap > 0 ? row.depth / row.gap : 0;
}

/** Counts rows, and the nodes and edges among them once each, also over several contacts. */
export class Tally {
  private readonly t = emptyTotals();
  private readonly nodes = new Set<number>();
  private readonly edges = new Set<number>();
  private readonly onNodes = new Set<number>();
  private readonly onEdges = new Set<number>();
  private readonly stopped = new Set<number>();

  add(meta: ContactMeta, data: ContactData, result: Result): void {
    const stops = on_surface_error(meta, result.setting) !== 0;
    const isEdge = meta.kind === "edge_edge";
    for (const row of result.rows) {
      const item = isEdge ? edgeKey(data.secondaryNode[2 * row.secondary], data.secondaryNode[2 * row.secondary + 1]) : data.secondaryNode[row.secondary];
      (isEdge ? this.edges : this.nodes).add(item);
      this.t.pairs++;
      if (row.onSurface) {
        this.t.on_segment.pairs++;
        (isEdge ? this.onEdges : this.onNodes).add(item);
        if (stops && !isEdge) this.stopped.add(item);
      }
      if (row.action !== "none") this.t.acted++;
      this.t.max_depth = Math.max(this.t.max_depth, row.depth);
      this.t.max_ratio = Math.max(this.t.max_ratio, ratioOf(row));
    }
  }

  totals(): Totals {
    const { t } = this;
    return {
      ...t, nodes: this.nodes.size, edges: this.edges.size, solver_errors: this.stopped.size,
      on_segment: { nodes: this.onNodes.size, edges: this.onEdges.size, pairs: t.on_segment.pairs },
    };
  }
}

/** Two page nodes as one number; a page has far fewer than 2^26 nodes. */
function edgeKey(a: number, b: number): number {
  return Math.min(a, b) * 2 ** 26 + Math.max(a, b);
}
