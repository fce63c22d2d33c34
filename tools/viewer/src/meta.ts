// The JSON part of the page's data as `deck gaps --html` writes it.

/** Secondary nodes and edges, each once, and pairs: never added up. */
export interface Totals {
  pairs: number;
  nodes: number;
  edges: number;
  on_segment: { nodes: number; edges: number; pairs: number };
  solver_errors: number; // nodes for which the solver stops
  acted: number;
  max_depth: number;
  max_ratio: number;
  unbounded?: number; // pairs that are left out of the two above
}

export interface Cell {
  field: FieldName;
  line: number; // index into Card.lines
  first: number; // columns, 1-based and inclusive
  last: number;
  real: boolean;
  factor: number; // working unit per unit of the card
  parameter: boolean;
  free: boolean;
  nothing: number; // what an integer cell takes for "no": 1000 where legal, else 0
}

export interface Card {
  file: string;
  line: number;
  lines: string[];
  cells: Cell[];
}

export interface InterfaceMeta {
  id: number;
  type: number;
  title: string;
  level: Verdict["level"]; // with the deck's settings
  card: Card;
  values: Record<string, { value: number | string; origin: string; input: number | string | null }>;
}

export type FieldName = "Gapmin" | "Fscalegap" | "Gapmax" | "Fpenmax" | "Igap" | "Inacti";
export const fieldNames: FieldName[] = ["Igap", "Gapmin", "Fscalegap", "Gapmax", "Inacti", "Fpenmax"];
export type Overrides = Partial<Record<FieldName, number>>;

/** What card and defaults say, before the rules of the contact's kind apply. */
export interface CardValues {
  Gapmin: number; // 0: to be derived from the mesh
  Igap: number;
  Inacti: number;
  Fscalegap: number;
  Gapmax: number;
  Fpenmax: number;
  Edge_scale_gap: number;
}

/** Thicknesses of one side (count, sum, smallest, largest; null: there is none) and its shortest side. */
export type Samples = [number, number, number | null, number | null, number];

export interface ContactMeta {
  interface: number;
  kind: "node_segment" | "edge_edge";
  role: "primary" | "reversed" | "edges";
  type: number;
  dropped: boolean;
  evaluated: boolean; // false: whether anything penetrates is not known
  modern: boolean; // TYPE24, TYPE25
  igap: number;
  inacti: number;
  itied: number;
  ties: boolean; // its pairs are tied: no penetrations
  fpenmax: number;
  gap_scale: number;
  gapmin: number | null; // null: not finite
  gapmin_from: string;
  gapmax: number;
  max_gap: number | null;
  longest_main: number;
  longest_node: number;
  secondary: number;
  main: number;
  repaired: number;
  degenerate: number;
  reoriented: number;
  no_carrier: number;
  reach: number; // all pairs nearer than that are carried
  fixed: string; // why the page tries no other settings; empty: it does
  complete: boolean; // false: of too many penetrations only the deepest
  round_off: [number, number][]; // secondary and main of pairs that only the solver's round-off makes
  totals: Totals;
  card: CardValues;
  default: Samples[]; // what a default gap is formed of: of the main side; of edges also of the secondary
}

/** A tie: /INTER/TYPE2 or TYPE10. */
export interface TieMeta {
  interface: number;
  nodes: number;
  tied: number;
  lost: number; // not tied, and nothing else holds them
  beyond_rim: number; // tied all the same
  search_distance: number; // 0: each pair has its own
  farthest: number; // distance of a node that is tied
  text: string; // "3 of 412 nodes are not tied"
  losses: string; // what becomes of the others
  evaluated: boolean;
  stops: boolean; // the solver stops
}

export interface Units {
  mass: string;
  length: string;
  time: string;
}

/** Made by the program: contract of all its documents. */
export interface Verdict {
  level: "stops" | "penetrates" | "crossed" | "untied" | "not-examined" | "warnings" | "remarks" | "clean";
  text: string;
  sentences: { what: string; text: string; counts: Record<string, number> }[];
  counts: Record<string, number>;
}

export interface Meta {
  page: "gaps" | "cycle" | "parts" | "fix" | "diff"; // which verb wrote it
  tool: { name: string; version: string };
  deck: {
    path: string;
    title: string;
    version: number;
    units: { input: Units | null; working: Units | null };
    counts: Record<string, number>;
    includes: { path: string; written: string; from: { file: string; line: number } | null }[];
  };
  verdict: Verdict;
  summary: Totals & { crossed_elements: number | null };
  files: string[];
  bytes: number; // of all of them
  largest_gap: number; // beyond it a gap is unbounded: shown as that word, left out of scales
  actions: Record<string, [string, string]>; // what the solver does, in words: about one pair, about several
  parts: { id: number; title: string; prop: number; mat: number; prop_type?: string; thickness?: number }[];
  free_group_id: number;
  what_if: (Overrides & { interface: number; "%mesh_size"?: number; Irem_gap?: number })[];
  interfaces: InterfaceMeta[];
  contacts: ContactMeta[];
  ties: TieMeta[];
  touches: [number, number, ...number[]][]; // parts that come near each other: secondary, main (-1: none), interfaces
}

export interface Earlier {
  path: string;
  deck: string;
  same_depth: number; // share of a depth below which a difference is none
  /** Interface, role, s1, s2 (ascending), depth and gap then, what became of it. */
  rows: [number, string, number, number, number, number, "new" | "worse" | "better" | "same" | "solved"][];
}

/** Forces of the first cycle with the deck's settings; null: nothing limits. */
export interface Cycle {
  structure_dt: number | null;
  contact_dt: number | null;
  structure_element: [number, number] | null; // kind and id of the one that limits
  contacts: {
    active: boolean;
    complete: boolean;
    dt: number | null;
    because: string;
    with_force: number;
    force: number; // sum over pairs
    largest: number;
    acceleration: number;
    elastic: number;
    rows: [number, number, number, number][]; // secondary, main, force, stiffness
  }[];
  nodes: [number, number, number, number, number, number | null][]; // page node, force on it, stiffness, time step
}

/** What becomes of a node of a tie: tied, lost, tied from beyond the rim of its segment, held by something else. */
export const Holds = { tied: 0, lost: 1, beyondRim: 2, elsewhere: 3 } as const;

/** A node that is not tied, or tied from beyond the rim: its position in `nodes`, distance, search distance, part, why in
 * short and as a sentence, file and line. */
export type TieRow = [number, number | null, number | null, number, string, string, number, number];

/** Nodes of a tie with the segment that each is tied to or nearest to; -1: none. */
export interface TieData {
  main: number[]; // page nodes, four a segment
  nodes: number[]; // page nodes
  segment: number[];
  holds: (typeof Holds)[keyof typeof Holds][];
  rows: TieRow[]; // untied nodes first
}

/** A node that a repair has moved: page node, and by how much. */
export type MovedRow = [number, number, number, number];
export interface Moved {
  total: number;
  rows: MovedRow[]; // farthest first
}

/** What a repair says beside the moved nodes. */
export interface Repair {
  strategy: string;
  crossings: { before: number; after: number };
  not_treated: { interface: number; nodes: number[]; depth: number; distance: number | null; reason: string }[];
  /** The same by reason, at most eight, with the command that goes on from there. */
  groups: { text: string; command: string }[];
  next: { does: string; command: string }[];
  patch: string;
}

/** Crossed elements: contact, page nodes of the edge, kind and id of its element, position of the
 * segment. */
export interface Crossed {
  total: number;
  rows: [number, number, number, number, number, number][];
}
