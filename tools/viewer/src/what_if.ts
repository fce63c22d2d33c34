// Settings under test. The page has pairs with distances. Depth = gap - distance, with the gap formed operation by operation as
// in libdeck/contact/rules: numbers equal those of `deck gaps --what-if` to the last bit (tests/browser/what_if.mjs).
import { lengths, type ContactData, type Contacts } from "./data";
import type { ContactMeta, Meta } from "schema/page";
import type { Overrides } from "./card";
import { distanceOf, emptyTotals, enlarged, foundRows, Row, Tally, type Action, type Totals } from "./rows";

/** Effective options of one contact. */
export interface Setting {
  igap: number;
  rule: number; // Igap: how the gaps of both sides make the pair gap
  inacti: number;
  fpenmax: number;
  scale: number;
  gapmin: number;
  gapminFrom: string;
  gapmax: number;
  maxGap: number;
}

export interface Result {
  setting: Setting;
  rows: Row[]; // in the solver's order
  totals: Totals;
  /** Largest gap if the settings need more pairs than the page has; the rest is then as written. 0: complete. */
  beyond: number;
}

/** Gaps of the items of both sides. */
export interface SideGaps {
  gs: Float64Array;
  gm: Float64Array;
}

const noLimit = 1e30;

/** Settings with which the program wrote the page. */
function writtenSetting(c: ContactMeta): Setting {
  const rule = !c.modern ? c.igap : c.type === 25 && c.igap === 3 ? 3 : 1;
  return { igap: c.igap, rule, inacti: c.inacti, fpenmax: c.fpenmax, scale: c.gap_scale, gapmin: c.gapmin ?? NaN, gapminFrom: c.gapmin_from, gapmax: c.gapmax, maxGap: c.max_gap ?? NaN };
}

type Samples = ContactMeta["default"][0];
/** Default gap of one side of a line contact. */
function defaultOfSide([count, sum, smallest, , shortest]: Samples, variable: boolean): number {
  const half = 0.5 * shortest;
  if (count === 0) return 0.2 * half;
  return Math.min(half, variable ? smallest : sum / count);
}

/** Gap from the mesh for a card without one, and its source. */
function defaultGap(c: ContactMeta, variable: boolean, scale: number): [number, string] {
  const [main, secondary] = c.default;
  if (c.kind === "edge_edge") return [0.5 * (defaultOfSide(main, variable) + defaultOfSide(secondary, variable)), "mean of the defaults of both sides"];
  const [count, sum, smallest, largest, shortest] = main;
  if (count === 0) return [0.1 * shortest, "a tenth of the shortest main side"];
  const scaled = variable && c.type !== 10;
  const t = scaled ? scale * (scale < 0 ? largest : smallest) : sum / count;
  const half = 0.5 * shortest;
  if (half < t) return [half, "half the shortest main side"];
  if (!scaled) return [t, "mean thickness of the main shells"];
  return [t, scale !== 1 ? "Fscalegap times the smallest thickness of the main shells" : "smallest thickness of the main shells"];
}

/** Gap of each item: half a thickness times Fscalegap; for TYPE24 and TYPE25 the page has the result. */
export function sideGaps(c: ContactMeta, data: ContactData, { igap, scale }: Setting): SideGaps {
  const { secondaryThickness: s, mainThickness: m } = data;
  if (c.modern) return { gs: s, gm: m };
  if (igap === 0) return { gs: new Float64Array(s.length), gm: new Float64Array(m.length) };
  if (c.kind === "edge_edge") return { gs: s.map((t) => 0.5 * t), gm: m.map((t) => 0.5 * t) };
  return { gs: s.map((half) => scale * half), gm: m.map((t) => scale * 0.5 * t) };
}

/** Pair gap from the gaps of both sides. */
export function pairGap(s: Setting, gs: number, gm: number, ls: number, lm: number): number {
  if (s.rule === 0 || s.rule === 1000) return s.gapmin;
  let gap = gs + gm;
  if (s.rule === 3) gap = Math.min(gap, ls + lm);
  return Math.max(Math.min(gap, s.gapmax), s.gapmin);
}

/** Settings from card, change, and rules of a TYPE19's parts. */
function changedSetting(c: ContactMeta, interfaceType: number, change: Overrides): Setting {
  const { card } = c;
  const edges = c.kind === "edge_edge";
  const changes = interfaceType === 10 ? { Gapmin: change.Gapmin } : change;
  let igap = changes.Igap ?? card.Igap;
  let gapmin = change.Gapmin ?? card.Gapmin;
  if (igap === 1000) igap = 0;
  if (interfaceType === 19 && edges) {
    igap = igap === 2 ? 1 : igap === 4 ? 0 : igap;
    if (card.Edge_scale_gap !== 0) gapmin *= card.Edge_scale_gap;
  } else if (interfaceType === 19 && igap === 4) igap = 2;
  const scaled = !edges && igap >= 2;
  const scale = (scaled && (changes.Fscalegap ?? card.Fscalegap)) || 1;
  const gapmax = (scaled && (changes.Gapmax ?? card.Gapmax)) || noLimit;
  let gapminFrom = "card";
  if (!(gapmin > 0)) [gapmin, gapminFrom] = defaultGap(c, igap !== 0, scale);
  return { igap, rule: igap, inacti: c.inacti, fpenmax: c.fpenmax, scale, gapmin, gapminFrom, gapmax, maxGap: 0 };
}

const most = (list: Float64Array): number => list.reduce((a, b) => Math.max(a, b), 0);

/** Upper bound of pair gaps, used by the solver's search. */
function largestGap(c: ContactMeta, s: Setting, { gs, gm }: SideGaps): number {
  let sum = most(gm) + most(gs);
  if (c.kind === "edge_edge") return Math.max(sum, s.gapmin);
  if (s.igap === 0) return s.gapmin;
  if (s.igap === 3) sum = Math.min(sum, c.longest_main + c.longest_node);
  return Math.min(Math.max(sum, s.gapmin), s.gapmax);
}

/** Gaps of all pairs. */
function pairGaps(data: ContactData, s: Setting, { gs, gm }: SideGaps): Float64Array {
  const { pairSecondary, pairMain, secondaryListed, mainListed } = data;
  const limited = s.rule === 3;
  const [ls, lm] = limited ? [lengths(data.secondaryLength), lengths(data.mainLength)] : [];
  const out = new Float64Array(pairMain.length);
  for (let p = 0; p < out.length; p++) {
    const [i, k] = [pairSecondary[p], pairMain[p]];
    out[p] = pairGap(s, gs[i], gm[k], ls ? ls[secondaryListed[i]] : 0, lm ? lm[mainListed[k]] : 0);
  }
  return out;
}

/** Penetration that Inacti 5 and 6 store. */
const stored = (inacti: number, depth: number, gap: number): number => (inacti === 5 ? depth : depth + 0.05 * (gap - depth));

/** Solver error for a node exactly on a segment; 0: none. */
function onSurfaceError(c: ContactMeta, inacti: number, fpenmax: number): number {
  if (fpenmax !== 0 || inacti === 1 || inacti === 2) return 0;
  if (c.type === 10 && c.itied !== 0) return 0;
  return inacti === 0 ? 612 : 611;
}

/** Action of Inacti and Fpenmax on a node, with the stored value; Inacti 3: the length of the move. */
export function outcomeOf(row: Row, c: ContactMeta, inacti: number, fpenmax: number): { action: Action; stored: number } {
  const depth = row.onSurface ? row.depth : enlarged(row.depth);
  let out: { action: Action; stored: number } = { action: "none", stored: 0 };
  if ((fpenmax !== 0 && depth > fpenmax * row.gap) || inacti === 1) out.action = "node-stiffness-zero";
  else if (inacti === 2) out.action = "segment-stiffness-zero";
  else if (inacti === 3) out = { action: "node-moved", stored: depth };
  else if (inacti === 5 || inacti === 6) out = { action: "gap-reduced", stored: stored(inacti, depth, row.gap) };
  const error = row.onSurface ? onSurfaceError(c, inacti, fpenmax) : 0;
  if (error !== 0) out.action = `error-${error}` as Action;
  return out;
}

/** Actions on edges: each edge stores the largest value of its pairs; a pair has the values of both edges. */
function actOnEdges(rows: Row[], data: ContactData, inacti: number): void {
  const bySecondary = new Float64Array(data.secondaryListed.length);
  const byMain = new Float64Array(data.mainListed.length);
  for (const row of rows) {
    const depth = inacti === 6 ? row.depth : enlarged(row.depth);
    const reduces = inacti === 5 || inacti === 6;
    if (inacti === 1 || inacti === 2 || (reduces && depth >= 0.995 * row.gap)) row.action = "edge-stiffness-zero";
    else if (reduces) {
      row.action = "gap-reduced";
      const half = 0.5 * stored(inacti, depth, row.gap);
      bySecondary[row.secondary] = Math.max(bySecondary[row.secondary], half);
      byMain[row.main] = Math.max(byMain[row.main], half);
    }
  }
  for (const row of rows) if (row.action === "gap-reduced") row.stored = bySecondary[row.secondary] + byMain[row.main];
}

/** Rows of a contact with other settings. */
function changedRows(contact: number, c: ContactMeta, data: ContactData, s: Setting, gaps: Float64Array): Row[] {
  const { figures, distance, pairSecondary, pairMain } = data;
  const known = new Int32Array(gaps.length).fill(-1);
  figures.pair.forEach((pair, i) => (known[pair] = i));
  const rows: Row[] = [];
  for (let p = 0; p < gaps.length; p++) {
    if (!(gaps[p] - distance[p] > 0)) continue;
    const d = distanceOf(data, p, gaps[p]);
    rows.push(new Row(contact, c, pairSecondary[p], pairMain[p], gaps[p], d, gaps[p] - d, "none", 0, known[p] < 0 ? null : figures, known[p]));
  }
  if (c.kind === "edge_edge") actOnEdges(rows, data, s.inacti);
  else for (const row of rows) Object.assign(row, outcomeOf(row, c, s.inacti, s.fpenmax));
  return rows;
}

export class Evaluator {
  /** As written by the program. */
  readonly written: Result[];
  /** `started`: settings of the program's run, by interface. */
  constructor(
    private readonly meta: Meta,
    private readonly data: Contacts,
    private readonly started: Overrides[],
  ) { this.written = meta.contacts.map((c, i) => this.result(i, writtenSetting(c), foundRows(i, meta, data.contacts[i]))); }
  /** Reason why the page tries no settings of an interface; empty if it does. */
  fixed(inter: number): string { return this.meta.contacts.find((c) => c.interface === inter && c.fixed !== "")?.fixed ?? ""; }
  /** Results of all contacts; `overrides` by interface position. Reuses results in `known` that did not change. */
  evaluate(overrides: Overrides[], known?: { overrides: Overrides[]; results: Result[] }): Result[] {
    const same = (a: Overrides, b: Overrides) => JSON.stringify(a) === JSON.stringify(b);
    const out = this.written.slice();
    overrides.forEach((change, inter) => {
      const own = this.meta.contacts.flatMap((c, i) => (c.interface === inter ? [i] : []));
      if (known && same(change, known.overrides[inter])) return own.forEach((i) => (out[i] = known.results[i]));
      if (same(change, this.started[inter]) || this.fixed(inter) !== "") return;
      const results = own.map((i) => this.changed(i, change));
      const beyond = Math.max(0, ...results.map((r) => r.beyond));
      own.forEach((i, k) => (out[i] = beyond > 0 ? { ...this.written[i], beyond } : results[k]));
    });
    return out;
  }
  private changed(i: number, change: Overrides): Result {
    const c = this.meta.contacts[i];
    const data = this.data.contacts[i];
    const setting = changedSetting(c, this.meta.interfaces[c.interface].type, change);
    const sides = sideGaps(c, data, setting);
    setting.maxGap = largestGap(c, setting, sides);
    if (c.dropped || c.secondary === 0 || c.main === 0) return this.result(i, setting, []);
    const gaps = pairGaps(data, setting, sides);
    const reached = Math.max(setting.maxGap, most(gaps));
    if (!(reached <= c.reach)) return { setting, rows: [], totals: emptyTotals(), beyond: reached };
    return this.result(i, setting, changedRows(i, c, data, setting, gaps));
  }
  private result(i: number, setting: Setting, rows: Row[]): Result {
    const totals = new Tally(this.data.exactOf.length, this.meta.largest_gap).add(this.meta.contacts[i], this.data.contacts[i], rows).totals();
    return { setting, rows, totals, beyond: 0 };
  }
  /** Nearest pair of a contact, relative to its gap; null if there is none. */
  nearest(i: number, setting: Setting): Row | null {
    const c = this.meta.contacts[i];
    const data = this.data.contacts[i];
    const gaps = pairGaps(data, setting, sideGaps(c, data, setting));
    let best = -1;
    for (let p = 0; p < gaps.length; p++) if (best < 0 || data.distance[p] - gaps[p] < data.distance[best] - gaps[best]) best = p;
    if (best < 0) return null;
    const [gap, distance] = [gaps[best], data.distance[best]];
    return new Row(i, c, data.pairSecondary[best], data.pairMain[best], gap, distance, gap - distance, "none", 0, null, 0);
  }
}
