// Penetrations: their data, and how they are counted.
import type { ContactData, Figures } from "./data";
import type { ContactMeta, Meta, Totals as WrittenTotals } from "schema/page";

export type Action = keyof Meta["actions"];

/** Distinct secondary nodes, distinct edges, and pairs. The three overlap: do not add them. */
export interface Totals extends Omit<WrittenTotals, "tied" | "crossed_elements"> {
  unbounded?: number; // pairs left out of max_depth and max_ratio
}

/** True if the solver stops at such a penetration. */
export const stopsSolver = (action: Action): boolean => action.startsWith("error-");

/** Depth as Inacti uses it, a little larger; not for nodes exactly on the surface. */
export const enlarged = (depth: number): number => depth * (1 + 1e-8);

export class Row {
  /** `figures`: data at position `at` that only the program has; null: the pair penetrates with changed settings only. */
  constructor(
    readonly contact: number,
    private readonly meta: ContactMeta,
    readonly secondary: number,
    readonly main: number,
    readonly gap: number,
    readonly distance: number,
    readonly depth: number,
    public action: Action,
    public stored: number, // permanent reduction; for a moved node 1, or 0 if an earlier move was enough
    private readonly figures: Figures | null,
    private readonly at: number,
  ) {}

  get onSurface(): boolean {
    return !this.meta.modern && !(this.distance > 0);
  }
  /** Remaining gap; null without reduction. */
  get gap0(): number | null { return this.p0 === null ? null : this.gap - this.stored; }
  get p0(): number | null { return this.meta.modern || this.action === "node-moved" || this.stored === 0 ? null : this.stored; }
  get movedBy(): [number, number, number] | null {
    if (this.action !== "node-moved") return null;
    const by = this.onSurface ? this.depth : enlarged(this.depth);
    const [x, y, z] = this.normal!; // the page does not try Inacti 3
    return this.stored === 0 ? [0, 0, 0] : [by * x, by * y, by * z];
  }
  /** From main to secondary side; null if unknown. */
  get normal(): [number, number, number] | null {
    if (this.figures === null) return null;
    const [x, y, z] = this.figures.normal;
    return [x[this.at], y[this.at], z[this.at]];
  }
  /** Edges: weight of the first secondary node; null if unknown. */
  get weight(): number | null { return this.figures === null ? null : this.figures.weight[this.at]; }
}

/** Distance that the solver reports for a gap: of sub-triangles equal within round-off the first. */
export function distanceOf({ distance, others }: ContactData, pair: number, gap: number): number {
  const d = distance[pair];
  if (others.size === 0) return d;
  return others.get(pair)?.find((other) => gap - other === gap - d) ?? d;
}

/** The rows of `deck gaps --json`. */
export function foundRows(contact: number, meta: Meta, data: ContactData): Row[] {
  const c = meta.contacts[contact];
  const names = Object.keys(meta.actions) as Action[];
  const f = data.figures;
  return Array.from(f.pair, (pair, i) => {
    const distance = distanceOf(data, pair, f.gap[i]);
    const depth = c.modern ? f.depth[i] : f.gap[i] - distance;
    return new Row(contact, c, data.pairSecondary[pair], data.pairMain[pair], f.gap[i], distance, depth, names[f.action[i]], f.stored[i], f, i);
  });
}

export function emptyTotals(): Totals {
  return { pairs: 0, nodes: 0, edges: 0, on_segment: { nodes: 0, edges: 0, pairs: 0 }, solver_errors: 0, acted: 0, max_depth: 0, max_ratio: 0 };
}

export function ratioOf(row: Row): number { return row.gap > 0 ? row.depth / row.gap : 0; }

/** Counts rows and their distinct nodes and edges, also over several contacts. */
export class Tally {
  private readonly t = emptyTotals();
  /** By page node: 1: counted, 2: counted as on a segment, 4: counted as stopping the solver. */
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

  add(meta: ContactMeta, data: ContactData, rows: Row[]): this {
    const isEdge = meta.kind === "edge_edge";
    if (meta.ties) { // only rows that stop the solver count
      for (const row of rows) if (stopsSolver(row.action)) this.node(data.secondaryNode[row.secondary], 4);
      return this;
    }
    for (const row of rows) {
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
      if (row.gap > this.largestGap) { this.t.unbounded = (this.t.unbounded ?? 0) + 1; continue; }
      this.t.max_depth = Math.max(this.t.max_depth, row.depth);
      this.t.max_ratio = Math.max(this.t.max_ratio, ratioOf(row));
    }
    return this;
  }

  totals(): Totals {
    const { t } = this;
    return {
      ...t, nodes: this.counted[1], edges: this.edges.size, solver_errors: this.counted[4],
      on_segment: { nodes: this.counted[2], edges: this.onEdges.size, pairs: t.on_segment.pairs },
    };
  }
}

/** Key of two page nodes; a page has far fewer than 2^26 nodes. */
function edgeKey(a: number, b: number): number { return Math.min(a, b) * 2 ** 26 + Math.max(a, b); }
