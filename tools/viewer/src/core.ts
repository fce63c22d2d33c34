// The rules of gaps, penetrations, Inacti and removal: libdeck/contact/rules, compiled to WebAssembly
// (../wasm). Numbers go in and out in the order of the structs of ../wasm/what_if.cpp.
import { unzlibSync } from "fflate";
import packed from "../wasm/rules.wasm";
import { lengths as limitsOf, rowSize, type ContactData, type Contacts } from "./data";
import type { ContactMeta, Meta, Overrides, Samples } from "./meta";

interface Exports {
  initialize(): void;
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  exchange(): number;
  nodes(count: number, xyz: number): void;
  contact(): void;
  reset(): void;
  evaluate(contact: number, moved: number, withPairs: number): void;
  nearest(contact: number): void;
  secondary_gaps(): number;
  main_gaps(): number;
  pair_gap(igap: number, gapmin: number, gapmax: number, gs: number, gm: number, ls: number, lm: number): number;
  on_surface_error(type: number, itied: number, fpenmax: number, inacti: number): number;
  act(inacti: number, fpenmax: number, depth: number, gap: number, onSurface: number): void;
  act_modern(type: number, inacti: number, depth: number): void;
  finds_the_same(inacti: number, other: number): number;
  action_text(action: number): number;
  origin_text(origin: number): number;
}

let compiled: WebAssembly.Module | null = null;
/** The compiled rules, which can be given from thread to thread. */
export const compiledRules = (): WebAssembly.Module => (compiled ??= new WebAssembly.Module(unzlibSync(packed) as Uint8Array<ArrayBuffer>));
/** Those of another thread: then they are not compiled here. */
export function useRules(module: WebAssembly.Module): void {
  compiled = module;
}
function start(): Exports {
  const wasm = new WebAssembly.Instance(compiledRules()).exports as unknown as Exports;
  wasm.initialize();
  return wasm;
}
let own: Exports | null = null;
/** For rules that need no data. */
const rules = (): Exports => (own ??= start());

export type Action =
  | "none"
  | "node-stiffness-zero"
  | "segment-stiffness-zero"
  | "node-moved"
  | "gap-reduced"
  | "edge-stiffness-zero"
  | "ignored"
  | "offset-stored"
  | "initial-force"
  | "removed-tied"
  | "error-611"
  | "error-612";

/** Effective options of one contact. */
export interface Setting {
  igap: number;
  rule: number; // the Igap by which gaps of the sides make the gap of a pair
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

/** What is done about a penetration. */
export interface Outcome {
  readonly action: Action;
  readonly gap0: number | null;
  readonly p0: number | null;
  readonly movedBy: [number, number, number] | null;
}

export interface Row extends Outcome {
  readonly contact: number;
  readonly secondary: number;
  readonly main: number;
  readonly depth: number;
  readonly gap: number;
  readonly distance: number;
  readonly normal: [number, number, number];
  readonly onSurface: boolean;
  readonly stored: number; // TYPE24, TYPE25: what is taken off the penetration from then on
  readonly weight: number; // edges: weight of the first secondary node
}

function text(address: number): string {
  const bytes = new Uint8Array(rules().memory.buffer);
  let out = "";
  for (let i = address; bytes[i] !== 0; i++) out += String.fromCharCode(bytes[i]);
  return out;
}
let names: Action[] | null = null;
const actionOf = (i: number): Action => (names ??= Array.from({ length: 12 }, (_, k) => k).map((k) => text(rules().action_text(k)) as Action))[i];

/** A row as the rules wrote it: there can be half a million, so nothing is copied. */
class WrittenRow implements Row {
  readonly secondary: number; // these two are asked for everywhere
  readonly main: number;
  constructor(
    readonly contact: number,
    private readonly v: Float64Array,
    private readonly at: number,
    private readonly error = 0, // with which the solver stops at a node on a segment
  ) {
    this.secondary = v[at];
    this.main = v[at + 1];
  }
  get depth(): number {
    return this.v[this.at + 2];
  }
  get gap(): number {
    return this.v[this.at + 3];
  }
  get distance(): number {
    return this.v[this.at + 4];
  }
  get normal(): [number, number, number] {
    return [this.v[this.at + 5], this.v[this.at + 6], this.v[this.at + 7]];
  }
  get onSurface(): boolean {
    return this.v[this.at + 8] !== 0;
  }
  get action(): Action {
    return this.error !== 0 && this.onSurface ? (`error-${this.error}` as Action) : actionOf(this.v[this.at + 9]);
  }
  get gap0(): number | null {
    return this.v[this.at + 10] !== 0 ? this.v[this.at + 11] : null;
  }
  get p0(): number | null {
    return this.v[this.at + 10] !== 0 ? this.v[this.at + 12] : null;
  }
  get stored(): number {
    return this.v[this.at + 12];
  }
  get movedBy(): [number, number, number] | null {
    return this.action === "node-moved" ? [this.v[this.at + 13], this.v[this.at + 14], this.v[this.at + 15]] : null;
  }
  get weight(): number {
    return this.v[this.at + 16];
  }
}

/** The solver stops at such a penetration. */
export const stopsSolver = (action: Action): boolean => action.startsWith("error-");

/** What Inacti and Fpenmax would do about a penetration on its own. */
export function outcomeOf(row: Row, meta: ContactMeta, inacti: number, fpenmax: number): Outcome {
  rules().act(inacti, fpenmax, row.depth, row.gap, Number(row.onSurface));
  const written = new Float64Array(rules().memory.buffer, rules().exchange(), rowSize).slice();
  written[8] = Number(row.onSurface);
  return new WrittenRow(row.contact, written, 0, onSurfaceError(meta, fpenmax, inacti));
}

/** The solver's error for a node exactly on a segment; 0: none. */
function onSurfaceError(meta: ContactMeta, fpenmax: number, inacti: number): number {
  return meta.kind === "edge_edge" ? 0 : rules().on_surface_error(meta.type, meta.itied, fpenmax, inacti);
}

/** Values of Inacti that the page can try on a TYPE24 or TYPE25, the deck's among them: those with which the same pairs are
 * found, unless a tie could hold nodes (Irem_i2) that are not told apart with the deck's own. */
export function modernInacti(meta: ContactMeta, heldByTies: boolean): number[] {
  const { inacti } = meta;
  return [-1, 0, 5].filter((v) => v === inacti || (rules().finds_the_same(v, inacti) === 1 && !(heldByTies && v === 5)));
}

/** Pair gap from what the two sides bring. */
export function pairGap(s: Setting, gs: number, gm: number, ls: number, lm: number): number {
  return rules().pair_gap(s.rule, s.gapmin, s.gapmax, gs, gm, ls, lm);
}

/** One contact at its settings. */
export interface Evaluated {
  setting: Setting;
  rows: Row[];
  /** Largest pair gap that occurs. */
  reached: number;
  /** Nodes have moved, and mesh-size limits of Igap 3 with them, which the page cannot measure. */
  uncertain: boolean;
}

/** The same as the rules hand it out, which can be given from thread to thread. */
export interface Raw {
  head: Float64Array;
  rows: Float64Array;
}

export function evaluated(contact: number, meta: ContactMeta, { head, rows: out }: Raw): Evaluated {
  const [igap, inacti, irem, fpenmax, scale, gapmin, from, gapmax, maxGap, drad, reached, uncertain, count, , rule = igap] = head;
  const rows: Row[] = [];
  const error = onSurfaceError(meta, fpenmax, inacti);
  for (let i = 0; i < count; i++) rows.push(new WrittenRow(contact, out, i * rowSize, error));
  return { setting: { igap, rule, inacti, irem, fpenmax, scale, gapmin, gapminFrom: text(rules().origin_text(from)), gapmax, maxGap, drad }, rows, reached, uncertain: uncertain !== 0 };
}

/** How far the rows of a contact move a node at most. */
export function largestMove({ rows }: Raw): number {
  let most = 0;
  for (let at = 0; at < rows.length; at += rowSize)
    if (actionOf(rows[at + 9]) === "node-moved") most = Math.max(most, Math.hypot(rows[at + 13], rows[at + 14], rows[at + 15]));
  return most;
}

/** All contacts of the page, with their nodes. */
export class Core {
  private readonly wasm = start();

  /** Number of a contact among those that the rules are asked about. */
  private readonly number: number[] = [];

  constructor(private readonly meta: Meta, private readonly data: Contacts) {
    const n = data.exactNode.length;
    // One more for nodes without exact coordinates, which no pair has: the solver's rules only ask
    // whether they are there.
    const [address, xyz] = this.reals(3 * (n + 1));
    [data.x, data.y, data.z].forEach((axis, k) => {
      xyz.set(axis, k * (n + 1));
      xyz[k * (n + 1) + n] = 0;
    });
    this.wasm.nodes(n + 1, address);
    const position = (nodes: Uint32Array) => {
      const address = this.wasm.room(nodes.byteLength);
      const out = new Uint32Array(this.wasm.memory.buffer, address, nodes.length);
      for (let i = 0; i < out.length; i++) {
        const at = data.exactOf[nodes[i]];
        out[i] = at < 0 ? n : at;
      }
      return address;
    };
    let count = 0;
    meta.contacts.forEach((c, i) => {
      this.number.push(c.given ? -1 : count++);
      if (!c.given) this.add(c, meta.interfaces[c.interface].type, data.contacts[i], position);
    });
  }

  private add(c: ContactMeta, interfaceType: number, d: ContactData, position: (nodes: Uint32Array) => number): void {
    const edges = c.kind === "edge_edge";
    const card = c.card;
    const none: Samples = [0, 0, null, null, 0];
    // JSON has no infinity.
    const samples = ([count, sum, smallest, largest, shortest]: Samples) => [count, sum, smallest ?? Infinity, largest ?? -Infinity, shortest];
    const lengths = [d.secondaryListed, d.mainListed].map((list) => this.wasm.room(8 * list.length));
    this.send([
      Number(edges), c.type, interfaceType, c.shortest_side, c.longest_main, c.longest_node, c.margin,
      card.Gapmin, card.Igap, card.Inacti, card.Irem_gap, card.Fscalegap, card.Gapmax, card.Fpenmax,
      Number(card.thermal), card.Drad, card.Edge_scale_gap,
      ...samples(c.default[0]), ...samples(c.default[1] ?? none),
      d.secondaryListed.length, d.mainListed.length, d.pairMain.length,
      position(d.secondaryNode), position(d.mainNode),
      this.put(d.secondaryThickness), this.put(d.mainThickness),
      ...lengths,
      this.put(d.pairSecondary), this.put(d.pairMain),
    ]);
    this.wasm.contact();
    this.missing.push(() => {
      ([[d.secondaryListed, d.secondaryLength], [d.mainListed, d.mainLength]] as const).forEach(([listed, length], k) => {
        const out = new Float64Array(this.wasm.memory.buffer, lengths[k], listed.length);
        const of = limitsOf(length);
        for (let i = 0; i < out.length; i++) out[i] = listed[i] < 0 ? Infinity : of[listed[i]];
      });
    });
  }

  /** By contact: writes the mesh-size limits, which only Igap 3 and removal along the mesh look at; null: they are there. */
  private readonly missing: ((() => void) | null)[] = [];
  private complete(contact: number, change: Overrides): void {
    const card = this.meta.contacts[contact].card;
    if ([0, 1, 2, 1000].includes(change.Igap ?? card.Igap) && card.Irem_gap !== 2) return;
    this.missing[contact]?.();
    this.missing[contact] = null;
  }

  private reals(count: number): [number, Float64Array] {
    const address = this.wasm.room(8 * count);
    return [address, new Float64Array(this.wasm.memory.buffer, address, count)];
  }
  private put(list: Uint8Array | Uint32Array | Float64Array): number {
    const address = this.wasm.room(list.byteLength);
    const bytes = new Uint8Array(list.buffer, list.byteOffset, list.byteLength);
    new Uint8Array(this.wasm.memory.buffer).set(bytes, address);
    return address;
  }
  private send(values: number[]): void {
    new Float64Array(this.wasm.memory.buffer, this.wasm.exchange(), values.length).set(values);
  }

  /** Before the first contact of an evaluation: all nodes where the deck has them. */
  reset(): void {
    this.wasm.reset();
  }

  /** `moved`: how far the contacts before have moved a node; without pairs there are no rows. */
  evaluate(contact: number, change: Overrides, moved: number, withPairs: boolean): Raw {
    if (this.meta.contacts[contact].given) return this.given(contact, change, withPairs);
    this.ask(contact, change);
    this.wasm.evaluate(this.number[contact], moved, Number(withPairs));
    const head = new Float64Array(this.wasm.memory.buffer, this.wasm.exchange(), 14).slice();
    return { head, rows: new Float64Array(this.wasm.memory.buffer, head[13], head[12] * rowSize).slice() };
  }

  private ask(contact: number, change: Overrides): void {
    this.complete(contact, change);
    const { Gapmin, Fscalegap, Gapmax, Fpenmax, Igap, Inacti } = change;
    this.send([Gapmin, Fscalegap, Gapmax, Fpenmax, Igap, Inacti].map((v) => v ?? NaN));
  }

  /** The pair with the least room left beyond its gap, where nothing has moved; null: the page has none. */
  nearest(contact: number, change: Overrides): Row | null {
    if (this.meta.contacts[contact].given) return null;
    this.wasm.reset();
    this.ask(contact, change);
    this.wasm.nearest(this.number[contact]);
    const row = new WrittenRow(contact, new Float64Array(this.wasm.memory.buffer, this.wasm.exchange(), rowSize).slice(), 0);
    return row.secondary < 0 ? null : row;
  }

  /** What the page has no rules for: as the program found it, with what another Inacti does about it. */
  private given(contact: number, change: Overrides, withPairs: boolean): Raw {
    const c = this.meta.contacts[contact];
    const found = withPairs ? this.data.contacts[contact].given! : new Float64Array(0);
    const inacti = change.Inacti ?? c.inacti;
    const rows = inacti === c.inacti ? found : found.slice();
    let reached = 0;
    for (let at = 0; at < rows.length; at += rowSize) {
      reached = Math.max(reached, rows[at + 3]);
      if (rows === found) continue;
      this.wasm.act_modern(c.type, inacti, rows[at + 2]);
      const acted = new Float64Array(this.wasm.memory.buffer, this.wasm.exchange(), rowSize);
      rows[at + 9] = acted[9];
      rows[at + 12] = acted[12];
    }
    const limited = c.type === 25 && c.igap === 3; // by the mesh size
    const head = [c.igap, inacti, c.irem_gap, c.fpenmax, c.gap_scale, c.gapmin, 0, Infinity, c.max_gap, c.drad, reached, 0, rows.length / rowSize, 0, limited ? 3 : 1];
    return { head: Float64Array.from(head), rows };
  }

  /** Gaps that the items of both sides bring at these settings. */
  sideGaps(contact: number, change: Overrides, data: ContactData): { gs: Float64Array; gm: Float64Array } {
    if (this.meta.contacts[contact].given) return { gs: data.secondaryThickness, gm: data.mainThickness };
    this.evaluate(contact, change, 0, false);
    const list = (address: number, count: number) => new Float64Array(this.wasm.memory.buffer, address, count).slice();
    return { gs: list(this.wasm.secondary_gaps(), data.secondaryListed.length), gm: list(this.wasm.main_gaps(), data.mainListed.length) };
  }
}
