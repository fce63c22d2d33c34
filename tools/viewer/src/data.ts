// Blocks of the page and their types. Writers: libdeck/report/html/*.cpp.
import { unzlibSync } from "fflate";
import { fromBase64, fromPlanes, Reader } from "./decode/reader";
import type { Changes, ContactMeta, Crossings, Earlier, FirstCycle, Meta, Moved, Repair, TieLines } from "schema/page";

export const kindNames = ["shell", "sh3n", "solid", "quad", "tria", "truss", "beam", "spring"];

export function blockText(id: string): string | null { return document.getElementById(id)?.textContent ?? null; }

export interface Owners {
  kind: Uint8Array; // index into kindNames plus 1; 0: none
  id: Float64Array;
  part: Int32Array; // index into Meta.parts; -1: none
}

function owners(r: Reader, n: number): Owners {
  const out = { kind: r.bytes(n), id: r.deltas(n), part: new Int32Array(n) };
  const part = r.deltas(n);
  for (let i = 0; i < n; i++) out.part[i] = part[i] - 1;
  return out;
}

/** True if each number is the one before plus 1: the only contact of a surface needs no copy of it. */
const inARow = (numbers: Uint32Array): boolean => numbers.length > 0 && numbers.every((n, i) => n === numbers[0] + i);

/** Segments or edges of all contacts; contacts refer to them by number. */
class Items {
  private readonly node: Uint32Array;
  private readonly owner: Owners;
  constructor(r: Reader, private readonly nodes: number) {
    const n = r.u();
    this.node = r.deltas32(nodes * n);
    this.owner = owners(r, n);
  }
  nodesOf(numbers: Uint32Array): Uint32Array {
    const { node, nodes } = this;
    if (inARow(numbers)) return node.subarray(nodes * numbers[0], nodes * (numbers[0] + numbers.length));
    const out = new Uint32Array(nodes * numbers.length);
    for (let i = 0, o = 0; i < numbers.length; i++) for (let at = nodes * numbers[i], k = 0; k < nodes; k++) out[o++] = node[at++];
    return out;
  }
  ownersOf(numbers: Uint32Array): Owners {
    const { kind, id, part } = this.owner;
    const n = numbers.length;
    const [from, to] = [numbers[0], numbers[0] + n];
    if (inARow(numbers)) return { kind: kind.subarray(from, to), id: id.subarray(from, to), part: part.subarray(from, to) };
    const out = { kind: new Uint8Array(n), id: new Float64Array(n), part: new Int32Array(n) };
    for (let i = 0; i < n; i++) {
      out.kind[i] = kind[numbers[i]];
      out.id[i] = id[numbers[i]];
      out.part[i] = part[numbers[i]];
    }
    return out;
  }
}

export interface MeshPart {
  part: number; // index into Meta.parts; -1: no part
  node: Uint32Array; // page node of each vertex
  position: Float32Array;
  /** Faces and lines: `corners` vertices each. */
  groups: { kind: number; corners: number; count: number; vertex: Uint32Array; element: Float64Array }[];
}

export interface Mesh {
  nodeId: Float64Array;
  parts: MeshPart[];
  low: [number, number, number];
  high: [number, number, number];
}

/** Items and pairs of one contact. Edges have two nodes per item, segments four. */
export interface ContactData {
  secondaryNode: Uint32Array; // page nodes: 1 per node, 2 per edge
  mainNode: Uint32Array; // 4 per segment, 2 per edge
  secondaryThickness: Float64Array; // nodes: half thickness; edges: thickness
  mainThickness: Float64Array; // whole thickness
  secondaryOwner: Owners; // nodes: only of listed ones, see `listed`
  mainOwner: Owners;
  secondaryListed: Int32Array; // item -> position among items with pairs; -1: none
  mainListed: Int32Array;
  file: Int32Array; // by listed position: file that defines the (first) node
  line: Float64Array;
  /** Mesh-size limits of Igap 3 by listed position, as byte planes; see lengths(). */
  secondaryLength: Uint8Array;
  mainLength: Uint8Array;
  pairSecondary: Uint32Array;
  pairMain: Uint32Array;
  distance: Float64Array;
  /** By pair: further distances that the solver reports if they give an equal depth. */
  others: Map<number, number[]>;
  figures: Figures;
}

/** Figures of penetrations that do not follow from their pair. */
export interface Figures {
  pair: Uint32Array; // position
  gap: Float64Array;
  depth: Float64Array; // for TYPE24 and TYPE25; of others it is gap - distance
  normal: Float64Array[]; // x, y, z
  weight: Float64Array; // edges: of the first secondary node
  stored: Float64Array;
  action: Uint8Array; // position among Meta.actions
}

const limits = new WeakMap<Uint8Array, Float64Array>();
/** Mesh-size limits of one side, computed on first use. */
export function lengths(planes: Uint8Array): Float64Array {
  let found = limits.get(planes);
  if (!found) limits.set(planes, (found = fromPlanes(planes)));
  return found;
}

export interface Contacts {
  exactNode: Uint32Array; // page nodes with exact coordinates, ascending
  exactOf: Int32Array; // page node -> index into x, y, z; -1: none
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
  contacts: ContactData[];
}

export function readMesh(bytes: Uint8Array): Mesh {
  const r = new Reader(bytes);
  const nodeId = r.deltas(r.u());
  const parts: MeshPart[] = [];
  const low: Mesh["low"] = [Infinity, Infinity, Infinity];
  const high: Mesh["high"] = [-Infinity, -Infinity, -Infinity];
  for (let left = r.u(); left > 0; left--) {
    const part = r.u() - 1;
    const count = r.u();
    const node = r.deltas32(count);
    const position = new Float32Array(3 * count);
    for (let axis = 0; axis < 3; axis++) {
      const [base, step] = r.f64(2);
      const steps = r.deltas(count);
      let [least, most] = [low[axis], high[axis]];
      for (let i = 0; i < count; i++) {
        const v = base + steps[i] * step;
        position[3 * i + axis] = v;
        if (v < least) least = v;
        if (v > most) most = v;
      }
      low[axis] = least;
      high[axis] = most;
    }
    const groups: MeshPart["groups"] = [];
    let next = 0;
    for (let g = r.u(); g > 0; g--) {
      const kind = r.u();
      const corners = r.u();
      const items = r.u();
      const [vertex, unused] = r.backwards(items * corners, next);
      next = unused;
      groups.push({ kind, corners, count: items, vertex, element: r.deltas(items) });
    }
    parts.push({ part, node, position, groups });
  }
  return { nodeId, parts, low, high };
}

/** Time steps of elements by page node. */
export interface Steps {
  low: number;
  high: number; // end of the scale
  largest: number;
  /** In [0, 1], 1 for the smallest step; NaN: no step. */
  values: Float32Array;
}

export function loadSteps(nodes: number): Steps | null {
  const bytes = inflate("deck-steps");
  if (!bytes) return null;
  const r = new Reader(bytes);
  const [low, high, largest] = r.f64(3);
  if (!(high > 0)) return null;
  return { low, high, largest, values: Float32Array.from(r.bytes(nodes), (c) => (c === 0 ? NaN : (c - 1) / 254)) };
}

/** Place of definition of an element, and its own thickness (0: that of its property). */
export interface ElementOrigin {
  file: number; // index into Meta.files
  line: number;
  thickness: number;
}

/** By part and element, in mesh order; read on the first pick. */
export function loadElements(mesh: Mesh): (part: number, item: number) => ElementOrigin {
  const bytes = inflate("deck-elements");
  if (!bytes) return () => ({ file: 0, line: 0, thickness: 0 });
  const r = new Reader(bytes);
  const parts = mesh.parts.map((p) => p.groups.map((g) => ({ file: r.deltas(g.count), line: r.deltas(g.count), thickness: r.palette(g.count) })));
  return (part, item) => {
    let i = item;
    let g = 0;
    while (i >= mesh.parts[part].groups[g].count) i -= mesh.parts[part].groups[g++].count;
    const { file, line, thickness } = parts[part][g];
    return { file: file[i], line: line[i], thickness: thickness[i] };
  };
}

function listPositions(pairs: Uint32Array, items: number): [Int32Array, number] {
  const out = new Int32Array(items).fill(-1);
  for (let k = 0; k < pairs.length; k++) out[pairs[k]] = 0;
  let n = 0;
  for (let i = 0; i < items; i++) if (out[i] === 0) out[i] = n++;
  return [out, n];
}

function readContact(r: Reader, meta: ContactMeta, segments: Items, allEdges: Items): ContactData {
  const edges = meta.kind === "edge_edge";
  const d = {} as ContactData;
  const pairs = r.u();
  d.pairSecondary = new Uint32Array(pairs);
  for (let at = 0, secondary = 0; at < pairs; ) {
    secondary += r.small();
    d.pairSecondary.fill(secondary, at, (at += r.u()));
  }
  d.pairMain = r.deltas32(pairs);
  d.distance = r.f64(pairs);
  d.others = new Map();
  const others = r.deltas32(r.u());
  const instead = r.f64(others.length);
  others.forEach((pair, i) => d.others.set(pair, [...(d.others.get(pair) ?? []), instead[i]]));
  const secondaries = r.u();
  const secondary = r.deltas32(secondaries);
  d.secondaryNode = edges ? allEdges.nodesOf(secondary) : secondary;
  d.secondaryThickness = r.palette(secondaries);
  const mains = r.u();
  const main = r.deltas32(mains);
  const items = edges ? allEdges : segments;
  d.mainNode = items.nodesOf(main);
  d.mainThickness = r.palette(mains);
  d.mainOwner = items.ownersOf(main);
  const [sl, sn] = listPositions(d.pairSecondary, secondaries);
  const [ml, mn] = listPositions(d.pairMain, mains);
  d.secondaryListed = sl;
  d.mainListed = ml;
  d.secondaryOwner = edges ? allEdges.ownersOf(secondary.filter((_, i) => sl[i] >= 0)) : owners(r, sn);
  d.file = new Int32Array(sn);
  d.line = new Float64Array(sn);
  let file = 0;
  let line = 0;
  for (let i = 0; i < sn; i++) { d.file[i] = file += r.small(); d.line[i] = line += r.small(); }
  d.secondaryLength = r.bytes(8 * sn);
  d.mainLength = r.bytes(8 * mn);
  d.figures = readFigures(r, meta);
  return d;
}

function readFigures(r: Reader, meta: ContactMeta): Figures {
  const n = r.u();
  const none = new Float64Array(0);
  return {
    pair: r.deltas32(n), gap: r.palette(n), depth: meta.modern ? r.f64(n) : none, normal: [r.f64(n), r.f64(n), r.f64(n)],
    weight: meta.kind === "edge_edge" ? r.f64(n) : none, stored: r.f64(n), action: r.bytes(n),
  };
}

/** `shared`: data common to all contacts. */
export function readContacts(shared: Uint8Array, bytes: Uint8Array, meta: Meta, nodes: number): Contacts {
  const s = new Reader(shared);
  const count = s.u();
  const exactNode = s.deltas32(count);
  const exactOf = new Int32Array(nodes).fill(-1);
  for (let i = 0; i < count; i++) exactOf[exactNode[i]] = i;
  const [x, y, z] = [s.decimals(count), s.decimals(count), s.decimals(count)];
  const [segments, edges] = [new Items(s, 4), new Items(s, 2)];
  const r = new Reader(bytes);
  return { exactNode, exactOf, x, y, z, contacts: meta.contacts.map((c) => readContact(r, c, segments, edges)) };
}

const unpacked = new Map<string, Uint8Array>();

const inflate = (id: string): Uint8Array | null => {
  const known = unpacked.get(id);
  unpacked.delete(id); // each is read once
  if (known) return known;
  const text = blockText(id);
  return text === null ? null : unzlibSync(fromBase64(text));
};

/** Unpacks blocks with the browser's inflater, beside the page; without one they are unpacked on reading. */
export async function unpack(ids: string[]): Promise<void> {
  if (typeof DecompressionStream === "undefined") return;
  await Promise.all(ids.map(async (id) => {
    const text = blockText(id);
    if (text !== null) unpacked.set(id, await inflateText(text));
  }));
}

/** Bytes of a block, by the browser's inflater if there is one. */
export async function inflateText(text: string): Promise<Uint8Array> {
  const packed = fromBase64(text);
  if (typeof DecompressionStream === "undefined") return unzlibSync(packed);
  // Written at once: a Blob would deliver small pieces through another process of the browser.
  const { readable, writable } = new DecompressionStream("deflate");
  const writer = writable.getWriter();
  const written = Promise.all([writer.write(packed as Uint8Array<ArrayBuffer>), writer.close()]);
  const [bytes] = await Promise.all([new Response(readable).arrayBuffer(), written]);
  return new Uint8Array(bytes);
}

export function loadMeta(): Meta { return JSON.parse(blockText("deck-meta")!) as Meta; }

const text = (id: string): string | null => {
  const bytes = inflate(id);
  return bytes && new TextDecoder().decode(bytes);
};
const json = (id: string): unknown => {
  const found = text(id);
  return found === null ? null : JSON.parse(found);
};
/** Drawing of the parts that touch, as SVG. */
export const loadTouches = () => text("deck-touches");
export const loadEarlier = () => json("deck-earlier") as Earlier | null;
export const loadCycle = () => json("deck-cycle") as FirstCycle | null;
export const loadTies = () => (json("deck-ties") as TieLines[] | null) ?? [];
export const loadMoved = () => json("deck-moved") as Moved | null;
export const loadRepair = () => json("deck-repair") as Repair | null;
export const loadChanges = () => json("deck-changes") as Changes | null;
export const loadCrossed = () => json("deck-crossed") as Crossings | null;
