// Evaluates all contacts for given card values: the rules are the program's own (core.ts), so the rows
// are those of `deck gaps --what-if`. Inacti 3 moves nodes, and later contacts see that.
import { Core, evaluated, largestMove, stopsSolver, type Raw, type Row, type Setting } from "./core";
import type { ContactData, Contacts } from "./data";
import type { ContactMeta, Meta, Overrides, Totals } from "./meta";

export interface Result {
  setting: Setting;
  rows: Row[]; // in the solver's order
  totals: Totals;
  /** Largest pair gap that occurs, to be compared with the reach of the pairs. */
  reached: number;
  complete: boolean; // false: a gap exceeds what this page carries
}

/** Contacts that have rows to look for. */
const searched = (meta: ContactMeta) => meta.secondary > 0 && meta.main > 0 && !meta.dropped;

export class Evaluator {
  private made: Core | null = null;

  /** `deckResults`: those of the deck's settings, where another thread has evaluated them. */
  constructor(
    readonly meta: Meta,
    readonly data: Contacts,
    private readonly deckResults: Raw[] | null = null,
  ) {}

  /** The rules with all contacts: made when something is evaluated here. */
  get core(): Core {
    return (this.made ??= new Core(this.meta, this.data));
  }

  /** The deck's settings. */
  base(): Result[] {
    const none = this.meta.interfaces.map(() => ({}) as Overrides);
    if (!this.deckResults) return this.evaluate(none);
    let moved = 0;
    return this.deckResults.map((raw, i) => {
      const result = this.result(i, raw, moved);
      moved = Math.max(moved, largestMove(raw));
      return result;
    });
  }

  /** The same as base() gets from another thread. */
  rawBase(): Raw[] {
    this.core.reset();
    let moved = 0;
    return this.meta.contacts.map((c, i) => {
      const raw = this.core.evaluate(i, {}, moved, searched(c));
      moved = Math.max(moved, largestMove(raw));
      return raw;
    });
  }

  /** Results of all contacts; `overrides` by position of the interface. `known` supplies results of
   * contacts whose interface did not change, where no node moves. */
  evaluate(overrides: Overrides[], known?: { overrides: Overrides[]; results: Result[] }): Result[] {
    const moves = this.moves(overrides);
    const moved = known !== undefined && this.moves(known.overrides);
    const same = (i: number) => {
      const k = this.meta.contacts[i].interface;
      return JSON.stringify(overrides[k]) === JSON.stringify(known!.overrides[k]);
    };
    const out: Result[] = [];
    let most = 0;
    this.core.reset();
    for (let i = 0; i < this.meta.contacts.length; i++) {
      if (known && !moves && !moved && same(i)) {
        out.push(known.results[i]);
        continue;
      }
      const raw = this.core.evaluate(i, overrides[this.meta.contacts[i].interface], most, searched(this.meta.contacts[i]));
      out.push(this.result(i, raw, most));
      most = Math.max(most, largestMove(raw));
    }
    return out;
  }

  setting(i: number, overrides: Overrides): Setting {
    return evaluated(i, this.meta.contacts[i], this.core.evaluate(i, overrides, 0, false)).setting;
  }

  private moves(overrides: Overrides[]): boolean {
    return this.meta.contacts.some(
      (c, i) => c.kind === "node_segment" && !c.given && this.setting(i, overrides[c.interface]).inacti === 3,
    );
  }

  /** `moved`: how far the contacts before have moved a node. */
  private result(i: number, raw: Raw, moved: number): Result {
    const meta = this.meta.contacts[i];
    const { setting, rows, reached, uncertain } = evaluated(i, meta, raw);
    const result: Result = { setting, rows, totals: emptyTotals(), reached, complete: true };
    if (meta.given) result.complete = meta.complete;
    else if (searched(meta)) {
      const exactMove = setting.inacti === 3 && meta.kind === "node_segment" ? setting.maxGap + meta.margin : 0;
      const needed = Math.max(reached, exactMove) + 2 * moved;
      result.complete = uncertain ? false : meta.complete
        ? needed <= meta.reach
        : sameGaps(meta, setting) && meta.totals.pairs === this.data.contacts[i].pairMain.length;
    }
    const tally = new Tally(this.data.exactOf.length, this.meta.largest_gap);
    tally.add(meta, this.data.contacts[i], result);
    result.totals = tally.totals();
    return result;
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
  /** By page node: 1 counted, 2 counted as on a segment, 4 as one for which the solver stops. */
  private marks = new Uint8Array(0);
  private readonly counted = [0, 0, 0, 0, 0];
  private readonly edges = new Set<number>();
  private readonly onEdges = new Set<number>();

  constructor(private readonly pageNodes: number, private readonly largestGap: number) {}

  private node(n: number, mark: 1 | 2 | 4): void {
    if (this.marks.length === 0) this.marks = new Uint8Array(this.pageNodes);
    if ((this.marks[n] & mark) !== 0) return;
    this.marks[n] |= mark;
    this.counted[mark]++;
  }

  add(meta: ContactMeta, data: ContactData, result: Result): void {
    const isEdge = meta.kind === "edge_edge";
    if (meta.ties) { // only what stops the solver counts
      for (const row of result.rows) if (stopsSolver(row.action)) this.node(data.secondaryNode[row.secondary], 4);
      return;
    }
    for (const row of result.rows) {
      const item = isEdge ? edgeKey(data.secondaryNode[2 * row.secondary], data.secondaryNode[2 * row.secondary + 1]) : data.secondaryNode[row.secondary];
      if (isEdge) this.edges.add(item);
      else this.node(item, 1);
      this.t.pairs++;
      if (row.onSurface) {
        this.t.on_segment.pairs++;
        if (isEdge) this.onEdges.add(item);
        else this.node(item, 2);
      }
      if (stopsSolver(row.action)) this.node(item, 4);
      else if (row.action !== "none") this.t.acted++;
      if (row.gap > this.largestGap) {
        this.t.unbounded = (this.t.unbounded ?? 0) + 1;
        continue;
      }
      this.t.max_depth = Math.max(this.t.max_depth, row.depth);
      this.t.max_ratio = Math.max(this.t.max_ratio, ratioOf(row));
    }
  }

  totals(): Totals {
    const { t } = this;
    return {
      ...t, nodes: this.counted[1], edges: this.edges.size, solver_errors: this.counted[4],
      on_segment: { nodes: this.counted[2], edges: this.onEdges.size, pairs: t.on_segment.pairs },
    };
  }
}

/** Two page nodes as one number; a page has far fewer than 2^26 nodes. */
function edgeKey(a: number, b: number): number {
  return Math.min(a, b) * 2 ** 26 + Math.max(a, b);
}
