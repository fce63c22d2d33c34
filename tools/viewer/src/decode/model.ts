// The model of a page from its blocks: mesh, contacts, and per part triangles, lines, extent, and a coarser version for machines
// without graphics processor. Runs in a thread, or in the page if threads are not allowed.
import type { Meta } from "schema/page";
import { inflateText, readContacts, readMesh, type Contacts, type Mesh, type MeshPart } from "../data";

/** A part whose vertices in a grid cell are merged. */
export interface Coarse {
  vertex: Uint32Array; // vertex of the part for each remaining one
  of: Uint32Array; // vertex of the part -> position in `vertex`
  index: Uint16Array | Uint32Array; // three per triangle
}

export interface Shape {
  index: Uint16Array | Uint32Array; // three vertices per triangle
  triangleElement: Uint32Array; // triangle -> position of its element in the part
  wires: Uint16Array | Uint32Array; // one-dimensional elements, two vertices each
  low: [number, number, number];
  high: [number, number, number]; // below `low` if there is no vertex
  radius: number; // of the sphere around their centre
  coarse: Coarse[]; // coarsest first; empty for parts with few triangles
}

/** Triangles of the whole model in motion, and at rest if elements are at most a pixel or two. */
const budgets = [12000, 150000];

function indices(part: MeshPart): Pick<Shape, "index" | "triangleElement" | "wires"> {
  const Index = part.node.length > 65535 ? Uint32Array : Uint16Array;
  const count = (corners: number) => part.groups.reduce((n, g) => n + (g.corners === corners ? g.count : 0), 0);
  const triangles = 2 * count(4) + count(3);
  const triangleElement = new Uint32Array(triangles);
  const index = new Index(3 * triangles);
  const wires = new Index(2 * count(2));
  let [t, w, e] = [0, 0, 0];
  for (const { corners, count: items, vertex } of part.groups)
    for (let i = 0, v = 0; i < items; i++, e++, v += corners) {
      if (corners === 2) {
        wires[w++] = vertex[v];
        wires[w++] = vertex[v + 1];
        continue;
      }
      for (let k = 2; k < corners; k++) {
        triangleElement[t] = e;
        index[3 * t] = vertex[v];
        index[3 * t + 1] = vertex[v + k - 1];
        index[3 * t++ + 2] = vertex[v + k];
      }
    }
  return { index, triangleElement, wires };
}

function extent(x: Float32Array): Pick<Shape, "low" | "high" | "radius"> {
  const low: Shape["low"] = [Infinity, Infinity, Infinity];
  const high: Shape["high"] = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < 3; k++) {
    let [least, most] = [low[k], high[k]];
    for (let i = k; i < x.length; i += 3) {
      const v = x[i];
      if (v < least) least = v;
      if (v > most) most = v;
    }
    low[k] = least;
    high[k] = most;
  }
  const [a, b, c] = low.map((v, k) => (v + high[k]) / 2);
  let most = 0;
  for (let i = 0; i < x.length; i += 3) {
    const u = x[i] - a;
    const v = x[i + 1] - b;
    const w = x[i + 2] - c;
    const d = u * u + v * v + w * w;
    if (d > most) most = d;
  }
  return { low, high, radius: Math.sqrt(most) };
}

/** Area of the triangles. */
function area(x: Float32Array, index: ArrayLike<number>): number {
  let sum = 0;
  // Plain variables: an array literal would allocate per triangle until the loop is compiled.
  for (let t = 0; t < index.length; t += 3) {
    const a = 3 * index[t];
    const b = 3 * index[t + 1];
    const c = 3 * index[t + 2];
    const ux = x[b] - x[a];
    const uy = x[b + 1] - x[a + 1];
    const uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a];
    const vy = x[c + 1] - x[a + 1];
    const vz = x[c + 2] - x[a + 2];
    const nx = uy * vz - uz * vy;
    const ny = uz * vx - ux * vz;
    const nz = ux * vy - uy * vx;
    sum += Math.sqrt(nx * nx + ny * ny + nz * nz);
  }
  return sum / 2;
}

function grown<T extends Uint32Array | Int32Array>(list: T): T {
  const out = new (list.constructor as new (n: number) => T)(2 * list.length);
  out.set(list);
  return out;
}

/** Grid cells, numbered in order of appearance. The table grows with them and stays in the cache. */
class Cells {
  count = 0;
  private slots = new Int32Array(4096).fill(-1);
  private where = new Int32Array(3 * 2048);

  /** Number of a cell; equals the former `count` for a new one. */
  of(a: number, b: number, c: number): number {
    const { where } = this;
    let at = this.hash(a, b, c);
    for (let found = this.slots[at]; found >= 0; found = this.slots[(at = (at + 1) & (this.slots.length - 1))])
      if (where[3 * found] === a && where[3 * found + 1] === b && where[3 * found + 2] === c) return found;
    if (2 * this.count === this.slots.length) { this.grow(); return this.of(a, b, c); }
    this.slots[at] = this.count;
    where[3 * this.count] = a;
    where[3 * this.count + 1] = b;
    where[3 * this.count + 2] = c;
    return this.count++;
  }
  private hash(a: number, b: number, c: number): number {
    return (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & (this.slots.length - 1);
  }
  private grow(): void {
    this.where = grown(this.where);
    this.slots = new Int32Array(2 * this.slots.length).fill(-1);
    const { where, slots } = this;
    for (let i = 0; i < this.count; i++) {
      let at = this.hash(where[3 * i], where[3 * i + 1], where[3 * i + 2]);
      while (slots[at] >= 0) at = (at + 1) & (slots.length - 1);
      slots[at] = i;
    }
  }
}

/** Merges vertices of a grid cell into the first one; drops collapsed triangles. */
export function cluster(x: Float32Array, index: ArrayLike<number>, cell: number): Coarse {
  const n = x.length / 3;
  const cells = new Cells();
  const of = new Uint32Array(n);
  let vertex = new Uint32Array(1024);
  let last = -1; // neighbours mostly share a cell
  let [la, lb, lc] = [0, 0, 0];
  for (let i = 0; i < n; i++) {
    const a = Math.floor(x[3 * i] / cell) | 0;
    const b = Math.floor(x[3 * i + 1] / cell) | 0;
    const c = Math.floor(x[3 * i + 2] / cell) | 0;
    if (last < 0 || a !== la || b !== lb || c !== lc) {
      const before = cells.count;
      last = cells.of(a, b, c);
      la = a;
      lb = b;
      lc = c;
      if (last === before) { if (last === vertex.length) vertex = grown(vertex); vertex[last] = i; }
    }
    of[i] = last;
  }
  const left = cells.count;
  const out = left > 65535 ? new Uint32Array(index.length) : new Uint16Array(index.length);
  let m = 0;
  for (let t = 0; t < index.length; t += 3) {
    const a = of[index[t]];
    const b = of[index[t + 1]];
    const c = of[index[t + 2]];
    if (a === b || b === c || c === a) continue;
    out[m] = a;
    out[m + 1] = b;
    out[m + 2] = c;
    m += 3;
  }
  return { vertex: vertex.slice(0, left), of, index: out.slice(0, m) };
}

/** cluster() for a coarse part, by vertices of the original part. */
function again(fine: Coarse, x: Float32Array, cell: number): Coarse {
  const position = new Float32Array(3 * fine.vertex.length);
  for (let i = 0; i < fine.vertex.length; i++) for (let k = 0; k < 3; k++) position[3 * i + k] = x[3 * fine.vertex[i] + k];
  const c = cluster(position, fine.index, cell);
  return { vertex: c.vertex.map((v) => fine.vertex[v]), of: fine.of.map((v) => c.of[v]), index: c.index };
}

/** `coarser`: add coarser versions. */
export function shapesOf(mesh: Mesh, coarser: boolean): Shape[] {
  const shapes = mesh.parts.map((p): Shape => ({ ...indices(p), ...extent(p.position), coarse: [] }));
  const all = shapes.reduce((n, s) => n + s.index.length / 3, 0);
  if (!coarser || all < 2 * budgets[0]) return shapes;
  const areas = shapes.map((s, i) => area(mesh.parts[i].position, s.index));
  const total = areas.reduce((a, b) => a + b, 0);
  for (const budget of all > 2 * budgets[1] ? [...budgets].reverse() : [budgets[0]]) {
    // A flat sheet keeps two triangles per cell.
    const cell = Math.sqrt((2 * total) / budget);
    shapes.forEach((s, i) => {
      const x = mesh.parts[i].position;
      if (s.index.length > 0 && cell > 0) s.coarse.unshift(s.coarse.length > 0 ? again(s.coarse[0], x, cell) : cluster(x, s.index, cell));
    });
  }
  return shapes;
}

export interface Blocks {
  meta: string;
  mesh: string;
  shared: string;
  contacts: string;
}

export interface Model {
  mesh: Mesh;
  shapes: Shape[];
  contacts: Contacts;
}

/** `coarse`: true if the machine draws slowly, called late; `say`: done share, 0 to 1, and the next step. */
export async function decode(blocks: Blocks, coarse: () => boolean | Promise<boolean>, say: (done: number, next: string) => void): Promise<Model> {
  const meta = JSON.parse(blocks.meta) as Meta;
  const mesh = readMesh(await inflateText(blocks.mesh));
  say(0.3, "Reading the contacts …");
  const contacts = readContacts(await inflateText(blocks.shared), await inflateText(blocks.contacts), meta, mesh.nodeId.length);
  say(0.6, "Preparing the picture …");
  const shapes = shapesOf(mesh, await coarse());
  say(1, "Building the tables …");
  return { mesh, shapes, contacts };
}
