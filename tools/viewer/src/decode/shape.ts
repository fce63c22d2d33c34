// What is drawn of a part: triangles, lines, how far it extends, and the same with fewer triangles for
// machines without a graphics processor. Runs beside the page.
import type { Mesh, MeshPart } from "../data";

/** A part with vertices of a cell of a grid drawn as one. */
export interface Coarse {
  vertex: Uint32Array; // vertex of the part for each that is left
  of: Uint32Array; // vertex of the part -> position in `vertex`
  index: Uint16Array | Uint32Array; // three of them each
}

export interface Shape {
  index: Uint16Array | Uint32Array; // three vertices each
  triangleElement: Uint32Array; // triangle -> position of its element among those of the part
  wires: Uint16Array | Uint32Array; // one-dimensional elements, two vertices each
  low: [number, number, number];
  high: [number, number, number]; // below `low`: there is no vertex
  radius: number; // of the sphere around their middle
  coarse: Coarse[]; // coarsest first; none: the part has so few triangles that it is always drawn as it is
}

/** Triangles of the whole model while it moves, and at rest where its elements are not larger than a pixel or two. */
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
  for (let i = 0; i < x.length; i += 3)
    for (let k = 0; k < 3; k++) {
      if (x[i + k] < low[k]) low[k] = x[i + k];
      if (x[i + k] > high[k]) high[k] = x[i + k];
    }
  const [a, b, c] = low.map((v, k) => (v + high[k]) / 2);
  let most = 0;
  for (let i = 0; i < x.length; i += 3) {
    const d = (x[i] - a) ** 2 + (x[i + 1] - b) ** 2 + (x[i + 2] - c) ** 2;
    if (d > most) most = d;
  }
  return { low, high, radius: Math.sqrt(most) };
}

/** Area of the triangles. */
function area(x: Float32Array, index: ArrayLike<number>): number {
  let sum = 0;
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [3 * index[t], 3 * index[t + 1], 3 * index[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    sum += Math.sqrt(nx * nx + ny * ny + nz * nz);
  }
  return sum / 2;
}

/** Vertices that share a cell of the grid become one, the first; triangles that collapse are left out. */
export function cluster(x: Float32Array, index: ArrayLike<number>, cell: number): Coarse {
  const n = x.length / 3;
  let room = 64;
  while (room < 2 * n) room *= 2;
  const slots = new Int32Array(room).fill(-1);
  const of = new Uint32Array(n);
  const vertex = new Uint32Array(n);
  const where = new Int32Array(3 * n); // of those that are left
  let left = 0;
  for (let i = 0; i < n; i++) {
    const [a, b, c] = [Math.floor(x[3 * i] / cell), Math.floor(x[3 * i + 1] / cell), Math.floor(x[3 * i + 2] / cell)];
    let at = (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & (room - 1);
    for (let found = slots[at]; ; found = slots[(at = (at + 1) & (room - 1))]) {
      if (found < 0) {
        slots[at] = found = left;
        where[3 * left] = a;
        where[3 * left + 1] = b;
        where[3 * left + 2] = c;
        vertex[left++] = i;
      } else if (where[3 * found] !== a || where[3 * found + 1] !== b || where[3 * found + 2] !== c) continue;
      of[i] = found;
      break;
    }
  }
  const out = left > 65535 ? new Uint32Array(index.length) : new Uint16Array(index.length);
  let m = 0;
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [of[index[t]], of[index[t + 1]], of[index[t + 2]]];
    if (a === b || b === c || c === a) continue;
    out[m] = a;
    out[m + 1] = b;
    out[m + 2] = c;
    m += 3;
  }
  return { vertex: vertex.slice(0, left), of, index: out.slice(0, m) };
}

/** The same of what is coarse already, by vertices of the part. */
function again(fine: Coarse, x: Float32Array, cell: number): Coarse {
  const position = new Float32Array(3 * fine.vertex.length);
  for (let i = 0; i < fine.vertex.length; i++) for (let k = 0; k < 3; k++) position[3 * i + k] = x[3 * fine.vertex[i] + k];
  const c = cluster(position, fine.index, cell);
  return { vertex: c.vertex.map((v) => fine.vertex[v]), of: fine.of.map((v) => c.of[v]), index: c.index };
}

/** `coarser`: also with fewer triangles. */
export function shapesOf(mesh: Mesh, coarser: boolean): Shape[] {
  const shapes = mesh.parts.map((p): Shape => ({ ...indices(p), ...extent(p.position), coarse: [] }));
  const all = shapes.reduce((n, s) => n + s.index.length / 3, 0);
  if (!coarser || all < 2 * budgets[0]) return shapes;
  const areas = shapes.map((s, i) => area(mesh.parts[i].position, s.index));
  const total = areas.reduce((a, b) => a + b, 0);
  for (const budget of all > 2 * budgets[1] ? [...budgets].reverse() : [budgets[0]]) {
    // A flat sheet keeps two triangles a cell.
    const cell = Math.sqrt((2 * total) / budget);
    shapes.forEach((s, i) => {
      const x = mesh.parts[i].position;
      if (s.index.length > 0 && cell > 0) s.coarse.unshift(s.coarse.length > 0 ? again(s.coarse[0], x, cell) : cluster(x, s.index, cell));
    });
  }
  return shapes;
}
