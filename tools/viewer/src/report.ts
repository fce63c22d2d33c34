// State of the page: data, settings under test, results, filters, selection; notifies listeners of changes.
import type { Crossings, CycleContact, Earlier, FirstCycle, Meta, Moved, TieLines, TieMeta } from "schema/page";
import type { FieldName, Overrides } from "./card";
import { kindNames, type Contacts, type Mesh, type Steps } from "./data";
import { lengthText, onceShown } from "./dom";
import { commonStart } from "./table/columns";
import { ratioOf, Tally, type Action, type Row, type Totals } from "./rows";
import type { Untied } from "./tied";
import { Evaluator, type Result } from "./what_if";

export type Status = "new" | "worse" | "better" | "same" | "solved";

/** A row with names. Solved rows of an earlier report lack a Row. */
export interface Hit {
  row: Row;
  depth: number;
  ratio: number;
  contact: number;
  secondaryPart: number; // index into Meta.parts; -1: none
  mainPart: number;
  nodes: [number, number]; // ids: node and 0, or the two nodes of an edge
  readonly key: string;
  status: Status | null;
  earlier: number | null; // depth in the earlier report
}

/** A row of the evaluation. */
class Found implements Hit {
  readonly depth: number;
  readonly ratio: number;
  readonly contact: number;
  status: Status | null = null;
  earlier: number | null = null;

  constructor(readonly row: Row, readonly secondaryPart: number, readonly mainPart: number, readonly nodes: [number, number]) {
    this.depth = row.depth;
    this.ratio = ratioOf(row);
    this.contact = row.contact;
  }
  get key(): string {
    return `${this.contact}/${this.row.secondary}/${this.row.main}`;
  }
}

/** Sorts by depth >= 0, deepest first; stable. */
export function deepestFirst<T extends { depth: number }>(list: T[]): T[] {
  if (list.length < 2000) return [...list].sort((a, b) => b.depth - a.depth);
  // Bits of non-negative doubles ascend with their value: four passes of 16 bits each.
  const depth = new Float64Array(list.length);
  let order = new Uint32Array(list.length);
  for (let i = 0; i < order.length; i++) {
    depth[i] = list[i].depth;
    order[i] = i;
  }
  const words = new Uint16Array(depth.buffer);
  let next = new Uint32Array(order.length);
  const start = new Uint32Array(65537);
  for (let w = 0; w < 4; w++) {
    start.fill(0);
    for (let i = 0; i < order.length; i++) start[65536 - words[4 * i + w]]++;
    for (let k = 0; k < 65536; k++) start[k + 1] += start[k];
    for (let i = 0; i < order.length; i++) next[start[65535 - words[4 * order[i] + w]]++] = order[i];
    [order, next] = [next, order];
  }
  const out = list.slice();
  for (let i = 0; i < out.length; i++) out[i] = list[order[i]];
  return out;
}

/** Trend of a depth under test; null if there was none. */
function trendOf(now: number, was: number | null, same: number): Status {
  if (was === null) return "new";
  return now > was * (1 + same) ? "worse" : now < was * (1 - same) ? "better" : "same";
}

export interface Solved {
  interfaceId: number;
  role: string;
  nodes: [number, number];
  depth: number;
  gap: number;
}

export interface Filter {
  interface: number | null; // position
  pairs: [number, number][] | null; // part indices: secondary, main; null: all
  depth: [number, number] | null;
  ratio: [number, number] | null;
  status: Status | null;
  text: string;
  roundOff: boolean; // only penetrations by round-off of the solver
  perNode: boolean;
}

export const isPair = (pairs: Filter["pairs"], secondary: number, main: number): boolean => pairs?.some((p) => p[0] === secondary && p[1] === main) ?? false;

export const noFilter: Omit<Filter, "perNode"> = { interface: null, pairs: null, depth: null, ratio: null, status: null, text: "", roundOff: false };

export type Topic = "results" | "filter" | "selection" | "look";

export class Report {
  readonly evaluator: Evaluator;
  readonly base: Result[];
  results: Result[];
  overrides: Overrides[];
  /** Settings of the program's run. */
  private readonly started: Overrides[];
  hits: Hit[] = [];
  solved: Solved[] = [];
  /** Tables that answer the verb of the page, with their titles, as paper has them. */
  readonly answers: [string, () => HTMLElement][] = [];
  filtered: Hit[] = [];
  filter: Filter = { ...noFilter, perNode: true };
  selected: Hit | null = null;
  untied: Untied | null = null;
  steps: Steps | null = null; // of deck parts
  moved: Moved | null = null; // of deck fix
  private readonly listeners = new Map<Topic, (() => void)[]>();
  private readonly forces: Map<string, { force: number; stiffness: number }>[] | null;
  private readonly earlierRows: Map<string, Earlier["rows"][0]> | null;
  private readonly roundOff: Set<string>[]; // by contact: secondary/main

  constructor(
    readonly meta: Meta,
    readonly mesh: Mesh,
    readonly data: Contacts,
    readonly earlier: Earlier | null,
    readonly cycle: FirstCycle | null,
    readonly crossed: Crossings | null,
    readonly ties: TieLines[], // in the order of Meta.ties
  ) {
    this.forces = cycle && cycle.contacts.map((c) => new Map(c.rows.map((r) => [`${r[0]}/${r[1]}`, { force: r[2], stiffness: r[3] }])));
    this.overrides = meta.interfaces.map((inter) => {
      const out: Overrides = {};
      for (const w of meta.what_if)
        if (w.interface === inter.id)
          for (const [k, v] of Object.entries(w))
            if (k !== "interface" && k !== "%mesh_size" && k !== "Irem_gap") out[k as FieldName] = v as number;
      return out;
    });
    this.started = this.overrides;
    this.evaluator = new Evaluator(meta, data, this.started);
    this.results = this.evaluator.written;
    this.base = this.evaluator.evaluate(meta.interfaces.map(() => ({})));
    this.roundOff = meta.contacts.map((c) => new Set(c.round_off.map((p) => p.join("/"))));
    // A solved row may have an id that another row has now.
    this.earlierRows = earlier && new Map([...earlier.rows].reverse().sort((a, b) => Number(b[6] === "solved") - Number(a[6] === "solved")).map((r) => [`${r[0]}|${r[1]}|${r[2]}|${r[3]}`, r]));
    this.collect();
  }

  on(topic: Topic, f: () => void): void {
    this.listeners.set(topic, [...(this.listeners.get(topic) ?? []), f]);
  }
  /** Notifies a listener of several topics once. */
  emit(...topics: Topic[]): void {
    const told = new Set(topics.flatMap((t) => this.listeners.get(t) ?? []));
    this.rest = this.rest.filter((f) => !told.has(f));
    for (const f of told) f();
  }

  private rest: (() => void)[] = [];
  /** Notifies of new results: figures next to the slider at once, other lists and the picture later, one by one while idle. */
  private tellOfResults(): void {
    this.emit("results");
    const told = new Set(this.listeners.get("results"));
    const others = [...new Set(["filter" as const, "selection" as const].flatMap((t) => this.listeners.get(t) ?? []))].filter((f) => !told.has(f));
    const begin = this.rest.length === 0;
    // Waiting listeners keep their turn: none starves while the slider moves.
    this.rest = [...this.rest, ...others.filter((f) => !this.rest.includes(f))];
    if (begin) onceShown(() => this.goOn());
  }
  /** True while new results are being announced and more may follow. */
  stepping = false;
  private goOn(): void {
    this.stepping = true;
    this.rest.shift()?.();
    this.stepping = false;
    if (this.rest.length > 0) setTimeout(() => this.goOn());
  }
  /** True if everything shows the settings under test. */
  get told(): boolean {
    return this.rest.length === 0;
  }

  /** "; 2 contacts were not evaluated", else empty: such contacts are not clean. */
  get leftOut(): string {
    const n = this.meta.contacts.filter((c) => !c.evaluated).length + this.welds.filter((t) => !t.evaluated).length;
    const others = this.meta.verdict.counts.interfaces_not_examined ?? 0;
    return [n > 0 && `; ${n === 1 ? "1 contact or tie was" : `${n} contacts or ties were`} not evaluated`, others > 0 && `; ${others === 1 ? "1 interface was" : `${others} interfaces were`} not examined`].filter(Boolean).join("");
  }

  /** True if the page's counts agree with the program's. */
  get verified(): boolean {
    return this.meta.contacts.every((c, i) => {
      const t = this.evaluator.written[i].totals;
      const written: Totals = c.totals;
      return (
        !c.complete ||
        (Object.keys(t) as (keyof Totals)[]).every((k) => (t.unbounded && (k === "unbounded" || k.startsWith("max_"))) || JSON.stringify(t[k]) === JSON.stringify(written[k]))
      );
    });
  }

  // ---- settings -----------------------------------------------------------------------------

  /** True while a slider is dragged: rows keep their order. */
  held = false;
  hold(): void {
    this.held = true;
    window.addEventListener("pointerup", () => {
      this.held = false;
      this.emit("results");
    }, { once: true });
  }
  /** Sets a field of an interface (undefined: clears it) and evaluates again. */
  setOverride(inter: number, field: FieldName, value: number | undefined): void {
    const next = this.overrides.map((o) => ({ ...o }));
    if (value === undefined) delete next[inter][field];
    else next[inter][field] = value;
    this.apply(next);
  }
  setOverrides(next: Overrides[]): void {
    if (JSON.stringify(next) !== JSON.stringify(this.overrides)) this.apply(next);
  }
  clearOverrides(inter: number | null): void {
    this.apply(this.overrides.map((o, i) => (inter === null || i === inter ? {} : o)));
  }
  private apply(wanted: Overrides[]): void {
    const next = wanted.map((o, i) => (this.evaluator.fixed(i) === "" ? o : this.started[i]));
    const results = this.evaluator.evaluate(next, { overrides: this.overrides, results: this.results });
    this.overrides = next;
    this.results = results;
    const key = this.selected?.key;
    this.collect();
    this.untied = null;
    this.selected = key ? (this.hits.find((x) => x.key === key) ?? null) : null;
    this.tellOfResults();
  }
  changed(inter: number): boolean {
    return Object.keys(this.overrides[inter]).length > 0;
  }
  get anyChanged(): boolean {
    return this.overrides.some((_, i) => this.changed(i));
  }
  contactsOf(inter: number): number[] {
    return this.meta.contacts.flatMap((c, i) => (c.interface === inter ? [i] : []));
  }
  totals(which: "base" | "now", inter: number | null): Totals {
    const list = which === "base" ? this.base : this.results;
    const known = this.sums.get(list) ?? new Map<number | null, Totals>();
    this.sums.set(list, known);
    let found = known.get(inter);
    if (!found) {
      const own = this.meta.contacts.flatMap((c, i) => (inter === null || c.interface === inter ? [i] : []));
      if (own.length === 1) found = list[own[0]].totals;
      else {
        const tally = new Tally(this.mesh.nodeId.length, this.meta.largest_gap);
        for (const i of own) tally.add(this.meta.contacts[i], this.data.contacts[i], list[i].rows);
        found = tally.totals();
      }
      known.set(inter, found);
    }
    return found;
  }
  private readonly sums = new WeakMap<Result[], Map<number | null, Totals>>();

  // ---- names --------------------------------------------------------------------------------

  nodeId(pageNode: number): number {
    return this.mesh.nodeId[pageNode];
  }
  secondaryNodes(row: Row): number[] {
    const c = this.data.contacts[row.contact];
    const w = this.meta.contacts[row.contact].kind === "edge_edge" ? 2 : 1;
    return Array.from(c.secondaryNode.subarray(w * row.secondary, w * row.secondary + w));
  }
  /** Page nodes of the main side; three for a triangle. */
  mainNodes(row: Row): number[] {
    const c = this.data.contacts[row.contact];
    const w = this.meta.contacts[row.contact].kind === "edge_edge" ? 2 : 4;
    const n = Array.from(c.mainNode.subarray(w * row.main, w * row.main + w));
    return w === 4 && n[2] === n[3] ? n.slice(0, 3) : n;
  }
  secondaryText(row: Row): string {
    return this.secondaryNodes(row).map((n) => this.nodeId(n)).join("–");
  }
  mainText(row: Row): string {
    return this.mainNodes(row).map((n) => this.nodeId(n)).join(this.isEdge(row) ? "–" : " ");
  }
  isEdge(row: Row): boolean {
    return this.meta.contacts[row.contact].kind === "edge_edge";
  }
  elementText(row: Row, side: "secondary" | "main"): string {
    const c = this.data.contacts[row.contact];
    const o = side === "main" ? c.mainOwner : c.secondaryOwner;
    const i = side === "main" ? row.main : c.secondaryListed[row.secondary];
    return o.kind[i] === 0 ? "no element" : `${kindNames[o.kind[i] - 1]} ${o.id[i]}`;
  }
  elementId(row: Row, side: "secondary" | "main"): number {
    const c = this.data.contacts[row.contact];
    return side === "main" ? c.mainOwner.id[row.main] : c.secondaryOwner.id[c.secondaryListed[row.secondary]];
  }
  partText(part: number): string {
    if (part < 0) return "(no part)";
    const p = this.meta.parts[part];
    return p.title ? `${p.id} ${p.title}` : String(p.id);
  }
  /** Name without the common start of most penetrating parts' titles. */
  partShort(part: number): string {
    if (part < 0) return "(no part)";
    const p = this.meta.parts[part];
    return p.title ? `${p.id} ${p.title.slice(p.title.startsWith(this.commonPrefix) ? this.commonPrefix.length : 0)}` : String(p.id);
  }
  commonPrefix = "";
  private findPrefix(): void {
    const parts = new Set<number>();
    let [a, b] = [-1, -1];
    for (const x of this.hits) {
      if (x.secondaryPart === a && x.mainPart === b) continue; // equal to the row before
      [a, b] = [x.secondaryPart, x.mainPart];
      parts.add(a).add(b);
    }
    this.commonPrefix = commonStart([...parts].filter((p) => p >= 0).map((p) => this.meta.parts[p].title));
  }
  /** Names of the chosen part pairs; empty if all pass. */
  get pairsText(): string {
    const { pairs } = this.filter;
    return !pairs ? "" : pairs.length > 1 ? `${pairs.length} part pairs` : `${this.partText(pairs[0][0])} × ${this.partText(pairs[0][1])}`;
  }
  partId(part: number): number {
    return part < 0 ? 0 : this.meta.parts[part].id;
  }
  place(row: Row): { file: string; line: number } | null {
    const c = this.data.contacts[row.contact];
    const i = c.secondaryListed[row.secondary];
    return c.file[i] < 0 ? null : { file: this.meta.files[c.file[i]], line: c.line[i] };
  }
  private readonly sides = new Map<number, { secondary: Set<number>; main: Set<number> }>();
  /** Parts of both sides of an interface. */
  sidesOf(inter: number): { secondary: Set<number>; main: Set<number> } {
    let found = this.sides.get(inter);
    if (found) return found;
    found = { secondary: new Set(), main: new Set() };
    const marked = new Uint8Array(this.mesh.nodeId.length);
    for (const i of this.contactsOf(inter)) {
      const c = this.data.contacts[i];
      for (const p of c.mainOwner.part) if (p >= 0) found.main.add(p);
      for (const n of c.secondaryNode) marked[n] = 1;
    }
    const corner = new Uint8Array(marked.length);
    const tie = this.tieOf(inter);
    for (const n of tie?.nodes ?? []) marked[n] = 1;
    for (const n of tie?.main ?? []) corner[n] = 1;
    for (const p of this.mesh.parts) {
      if (p.part < 0) continue;
      if (p.node.some((n) => marked[n] === 1)) found.secondary.add(p.part);
      if (tie && p.node.some((n) => corner[n] === 1)) found.main.add(p.part);
    }
    this.sides.set(inter, found);
    return found;
  }
  /** True with ties but without contacts: no statement about penetrations. */
  get tiesOnly(): boolean {
    return this.ties.length > 0 && this.meta.interfaces.length === this.welds.length;
  }
  /** Ties of TYPE2, which are no contacts. */
  get welds(): TieMeta[] {
    return this.meta.ties.filter((t) => this.meta.interfaces[t.interface].type === 2);
  }
  /** Number of untied nodes; of a TYPE10 with the settings under test. */
  lost(t: TieMeta): number {
    const contact = this.meta.contacts.findIndex((c) => c.ties && c.evaluated && c.interface === t.interface);
    return contact < 0 ? t.lost : t.nodes - new Set(this.results[contact].rows.map((r) => r.secondary)).size;
  }
  /** The tie of an interface; null for a contact. */
  tieOf(inter: number): TieLines | null {
    return this.ties[this.meta.ties.findIndex((t) => t.interface === inter)] ?? null;
  }
  interfaceName(inter: number): string {
    const i = this.meta.interfaces[inter];
    return `${i.id}${i.title ? ` ${i.title}` : ""}`;
  }
  roleText(contact: number): string {
    const c = this.meta.contacts[contact];
    const type = this.meta.interfaces[c.interface].type;
    if (type !== 19) return `TYPE${type}`;
    return `TYPE19 ${c.role}`;
  }
  /** Exact secondary point: the node, or the closest point of the edge; null if unknown. */
  point(row: Row): [number, number, number] | null {
    const { x, y, z, exactOf, contacts } = this.data;
    const nodes = contacts[row.contact].secondaryNode;
    if (!this.isEdge(row)) {
      const a = exactOf[nodes[row.secondary]];
      return [x[a], y[a], z[a]];
    }
    const [a, b] = [exactOf[nodes[2 * row.secondary]], exactOf[nodes[2 * row.secondary + 1]]];
    const w = row.weight;
    if (w === null) return null;
    return [w * x[a] + (1 - w) * x[b], w * y[a] + (1 - w) * y[b], w * z[a] + (1 - w) * z[b]];
  }
  /** Action of the solver on one pair or several, in the program's words. */
  actionText(action: Action, pairs = 1): string {
    return this.meta.actions[action][pairs === 1 ? 0 : 1];
  }
  /** Action on a row, with the remaining gap. */
  fateText(row: Row): string {
    const text = row.action === "gap-reduced" && row.gap0 !== null ? `gap to ${lengthText(this, row.gap0)}` : this.actionText(row.action);
    return this.isRoundOff(row) ? `${text} (round-off)` : text;
  }
  /** True if the pair is not within its gap and penetrates only by the solver's round-off. Known for the deck's settings. */
  isRoundOff(row: Row): boolean {
    return this.roundOff[row.contact].has(`${row.secondary}/${row.main}`) && !this.settingsDiffer(row.contact);
  }

  private positions: Float32Array | null = null;
  /** Positions of page nodes, exact if known, else as drawn; NaN: node without element. */
  get nodePositions(): Float32Array {
    if (this.positions) return this.positions;
    const out = new Float32Array(3 * this.mesh.nodeId.length).fill(NaN);
    for (const { node, position } of this.mesh.parts)
      for (let i = 0; i < node.length; i++) for (let k = 0; k < 3; k++) out[3 * node[i] + k] = position[3 * i + k];
    const { exactNode, x, y, z } = this.data;
    for (let i = 0; i < exactNode.length; i++) {
      const at = 3 * exactNode[i];
      out[at] = x[i];
      out[at + 1] = y[i];
      out[at + 2] = z[i];
    }
    return (this.positions = out);
  }

  /** Force in the first cycle; null if unknown or evaluated with other settings. */
  forceOf(row: Row): { force: number; stiffness: number } | null {
    if (!this.forces || this.settingsDiffer(row.contact)) return null;
    return this.forces[row.contact].get(`${row.secondary}/${row.main}`) ?? null;
  }
  settingsDiffer(contact: number): boolean {
    const inter = this.meta.contacts[contact].interface;
    return JSON.stringify(this.overrides[inter]) !== JSON.stringify(this.started[inter]);
  }
  /** First cycle of a contact; null as in forceOf. */
  cycleOf(contact: number): CycleContact | null {
    return this.cycle && !this.settingsDiffer(contact) ? this.cycle.contacts[contact] : null;
  }

  /** Nodes with contact force in the first cycle, of the chosen interface or part pair; null as in forceOf. */
  get acted(): FirstCycle["nodes"] | null {
    if (!this.cycle || this.meta.contacts.some((_, i) => this.settingsDiffer(i))) return null;
    const { interface: inter, pairs } = this.filter;
    if (inter === null && pairs === null) return this.cycle.nodes;
    const own = new Set(this.passing("perNode").flatMap((x) => [...this.secondaryNodes(x.row), ...this.mainNodes(x.row)]));
    return this.cycle.nodes.filter((n) => own.has(n[0]));
  }

  // ---- rows and filters ---------------------------------------------------------------------

  private collect(): void {
    this.hits = [];
    const seen = new Set<string>();
    this.results.forEach((result, contact) => {
      const meta = this.meta.contacts[contact];
      if (meta.ties) return;
      const c = this.data.contacts[contact];
      const id = this.meta.interfaces[meta.interface].id;
      const edges = meta.kind === "edge_edge";
      for (const row of result.rows) {
        const at = edges ? 2 * row.secondary : row.secondary;
        const pair: [number, number] = [this.nodeId(c.secondaryNode[at]), edges ? this.nodeId(c.secondaryNode[at + 1]) : 0];
        const hit = new Found(row, c.secondaryOwner.part[c.secondaryListed[row.secondary]], c.mainOwner.part[row.main], pair);
        if (this.earlier && this.earlierRows) {
          const key = `${id}|${meta.role}|${[...pair].sort((a, b) => (edges ? a - b : 0)).join("|")}`;
          const old = this.earlierRows.get(key);
          seen.add(key);
          hit.earlier = old && old[6] !== "new" ? old[4] : null;
          hit.status = this.settingsDiffer(contact) ? trendOf(row.depth, hit.earlier, this.earlier.same_depth) : old && old[6] !== "solved" ? (old[6] as Status) : null;
        }
        this.hits.push(hit);
      }
    });
    this.hits = deepestFirst(this.hits); // rows of a contact follow one another
    this.unboundedRows = this.hits.reduce((n, x) => n + Number(this.unbounded(x.row.gap)), 0);
    this.deepest = this.hits.find((x) => !this.unbounded(x.row.gap)) ?? null;
    this.findPrefix();
    // The earlier report has one row per node: only a node's deepest row can be compared.
    if (this.earlierRows) {
      const first = new Set<string>();
      for (const x of this.hits) {
        const k = this.itemKey(x);
        if (first.has(k)) {
          x.status = null;
          x.earlier = null;
        }
        first.add(k);
      }
    }
    this.solved = [];
    for (const r of this.earlier?.rows ?? []) {
      const key = `${r[0]}|${r[1]}|${r[2]}|${r[3]}`;
      const another = r[6] === "solved" && this.earlierRows!.get(key) !== r;
      if (r[6] !== "new" && (another || !seen.has(key)))
        this.solved.push({ interfaceId: r[0], role: r[1], nodes: [r[2], r[3]], depth: r[4], gap: r[5] });
    }
    this.applyFilter();
  }

  /** Hits that pass all filters except one; `perNode`: only the deepest per node or edge. */
  passing(except: keyof Filter | null, perNode = this.filter.perNode && except !== "perNode", f = this.filter): Hit[] {
    const of = <K extends keyof Filter>(k: K): Filter[K] | null => (except === k ? null : f[k]);
    const [inter, pairs, depth, ratio, status] = [of("interface"), of("pairs"), of("depth"), of("ratio"), of("status")];
    const text = (of("text") ?? "").trim().toLowerCase();
    // The first row of a node or edge is its deepest; there may be half a million.
    const seen = perNode ? this.data.contacts.map((c) => new Uint8Array(c.secondaryNode.length)) : null;
    const edges = new Set<string>();
    const out: Hit[] = [];
    for (const x of this.hits) {
      if (inter !== null && this.meta.contacts[x.contact].interface !== inter) continue;
      if (pairs && !isPair(pairs, x.secondaryPart, x.mainPart)) continue;
      if (depth && !(x.depth >= depth[0] && x.depth <= depth[1])) continue;
      if (ratio && !(x.ratio >= ratio[0] && x.ratio <= ratio[1])) continue;
      if (status && x.status !== status) continue;
      if (text && !this.matches(x, text)) continue;
      if (f.roundOff && except !== "roundOff" && !this.isRoundOff(x.row)) continue;
      if (seen && this.isEdge(x.row)) { // lists may repeat an edge
        const key = this.itemKey(x);
        if (edges.has(key)) continue;
        edges.add(key);
      } else if (seen) {
        const done = seen[x.contact];
        if (done[x.row.secondary] === 1) continue;
        done[x.row.secondary] = 1;
      }
      out.push(x);
    }
    return out;
  }

  /** Key of the node or edge of a contact. */
  private itemKey(x: Hit): string {
    return `${x.contact}/${[...x.nodes].sort((a, b) => a - b).join("/")}`;
  }

  /** Deepest per node or edge, deepest first, without filters. */
  worst(): Hit[] {
    return this.passing(null, true, { ...noFilter, perNode: true });
  }

  /** True for a length beyond the size of any model. */
  unbounded(v: number): boolean {
    return !(Math.abs(v) <= this.meta.largest_gap);
  }
  /** Hits for scales, sums and histograms. */
  bounded(hits: Hit[]): Hit[] {
    return this.unboundedRows === 0 ? hits : hits.filter((x) => !this.unbounded(x.row.gap));
  }
  unboundedRows = 0;
  deepest: Hit | null = null;

  /** The list, or all that pass the other filters while this one is set. */
  around(filter: "interface" | "pairs" | "depth" | "ratio" | "status" | "text"): Hit[] {
    const set = this.filter[filter];
    return set === null || set === "" ? this.filtered : this.passing(filter);
  }

  matches(x: Hit, text: string): boolean {
    return (
      this.secondaryText(x.row).includes(text) ||
      this.mainText(x.row).split(/[ –]/).includes(text) ||
      String(this.elementId(x.row, "main")) === text ||
      String(this.elementId(x.row, "secondary")) === text ||
      this.partText(x.secondaryPart).toLowerCase().includes(text) ||
      this.partText(x.mainPart).toLowerCase().includes(text)
    );
  }

  private applyFilter(): void {
    this.filtered = this.passing(null);
  }

  setFilter(change: Partial<Filter>): void {
    this.filter = { ...this.filter, ...change };
    this.applyFilter();
    this.emit("filter");
  }

  /** Selects a row, or a node of a tie instead. */
  select(hit: Hit | null, untied: Untied | null = null): void {
    this.selected = hit;
    this.untied = untied;
    this.emit("selection");
  }
}
