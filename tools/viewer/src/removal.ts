// Irem_gap = 2: secondary nodes (edges) of a self contact within sqrt(2) gaps of a main segment
// (edge) along the mesh are not paired with it. Follows libdeck/contact/rules/removal.cpp step by step.
import type { ContactData, Contacts } from "./data";
import { pairGap, sideGaps, type Setting } from "./evaluate";
import { closestBetweenEdges, edge, type Points } from "./kernel";
import type { ContactMeta } from "./meta";

const root2 = Math.sqrt(2);

/** Node -> items of the main side that touch it and have at least one secondary node. */
class NodeItems {
  readonly first: Uint32Array;
  readonly item: Uint32Array;
  constructor(nodes: number, itemNodes: Uint32Array, width: number, isSecondary: Uint8Array) {
    const items = itemNodes.length / width;
    this.first = new Uint32Array(nodes + 1);
    const each = (f: (node: number, item: number) => void) => {
      for (let i = 0; i < items; i++) {
        let works = 0;
        for (let k = 0; k < width; k++) works |= isSecondary[itemNodes[width * i + k]];
        if (!works) continue;
        for (let k = 0; k < width; k++) {
          const n = itemNodes[width * i + k];
          let before = false;
          for (let j = 0; j < k; j++) before ||= itemNodes[width * i + j] === n;
          if (!before) f(n, i);
        }
      }
    };
    each((n) => this.first[n + 1]++);
    for (let n = 0; n < nodes; n++) this.first[n + 1] += this.first[n];
    this.item = new Uint32Array(this.first[nodes]);
    const fill = this.first.slice(0, nodes);
    each((n, i) => (this.item[fill[n]++] = i));
  }
}

/** Distances along the mesh from one item. */
class Front {
  readonly dist: Float64Array;
  readonly expanded: Uint32Array;
  readonly met: Uint32Array;
  touched: number[] = [];
  front: number[] = [];
  next: number[] = [];
  ring = 0;
  firstRing = 0;
  constructor(nodes: number, items: number) {
    this.dist = new Float64Array(nodes).fill(Infinity);
    this.expanded = new Uint32Array(nodes);
    this.met = new Uint32Array(items);
  }
  start(item: number, nodes: Uint32Array): void {
    for (const n of this.touched) this.dist[n] = Infinity;
    this.touched = [];
    for (const n of nodes) this.set(n, 0);
    this.front = [item];
    this.firstRing = ++this.ring;
    this.met[item] = this.ring;
  }
  set(n: number, d: number): void {
    if (this.dist[n] === Infinity) this.touched.push(n);
    if (d < this.dist[n]) this.dist[n] = d;
  }
}

/** Nodes of a list as positions among the exact ones. */
function exactNodes(list: Uint32Array, all: Contacts): Uint32Array {
  return list.map((n) => all.exactOf[n]);
}

function apartNodes(p: Points, a: number, b: number): number {
  const dx = p.x[b] - p.x[a], dy = p.y[b] - p.y[a], dz = p.z[b] - p.z[a];
  return Math.sqrt(dx * dx + dy * dy + dz * dz);
}

/** Keys main * (number of secondaries) + secondary of the pairs that are left out. */
export function removedPairs(meta: ContactMeta, c: ContactData, s: Setting, all: Contacts, p: Points): Set<number> {
  const nodes = all.exactNode.length;
  const secondary = exactNodes(c.secondaryNode, all);
  const main = exactNodes(c.mainNode, all);
  const count = secondary.length;
  const position = new Int32Array(nodes).fill(-1);
  const isSecondary = new Uint8Array(nodes);
  const { gs, gm } = sideGaps(s, false, c);
  let thickest = 0;
  let longest = 0;
  const lengthS = (i: number) => c.secondaryLength[c.secondaryListed[i]];
  const lengthM = (i: number) => c.mainLength[c.mainListed[i]];
  for (let i = 0; i < count; i++) {
    if (secondary[i] < nodes) {
      position[secondary[i]] = i;
      isSecondary[secondary[i]] = 1;
    }
    thickest = Math.max(thickest, gs(i));
    if (s.igap === 3) longest = Math.max(longest, lengthS(i));
  }
  const out = new Set<number>();
  const atNode = new NodeItems(nodes, main, 4, isSecondary);
  if (atNode.item.length === 0) return out;
  const f = new Front(nodes, main.length / 4);
  for (let i = 0; i < main.length / 4; i++) {
    const own = main.subarray(4 * i, 4 * i + 4);
    let reach = s.gapmin;
    if (s.igap !== 0) {
      reach = gm(i) + thickest;
      if (s.igap === 3) reach = Math.min(reach, lengthM(i) + longest);
    }
    const limit = root2 * Math.max(reach, s.drad);
    f.start(i, own);
    let lower = 0;
    let any = false;
    while (lower + meta.shortest_side <= limit && f.front.length > 0) {
      any = true;
      lower = Infinity;
      ++f.ring;
      f.next = [];
      for (const q of f.front) {
        const qn = main.subarray(4 * q, 4 * q + 4);
        for (const a of qn) {
          if (f.expanded[a] === f.ring || f.dist[a] === Infinity) continue;
          f.expanded[a] = f.ring;
          for (let k = atNode.first[a]; k < atNode.first[a + 1]; k++) {
            const r = atNode.item[k];
            if (f.met[r] >= f.firstRing && f.met[r] !== f.ring) continue;
            if (f.met[r] !== f.ring) f.next.push(r);
            f.met[r] = f.ring;
            for (let j = 0; j < 4; j++) {
              const b = main[4 * r + j];
              if (!isSecondary[b] || qn.includes(b)) continue;
              f.set(b, f.dist[a] + apartNodes(p, a, b));
              if (f.dist[b] < lower) lower = f.dist[b];
            }
          }
        }
      }
      f.front = f.next;
    }
    if (!any) continue;
    for (const b of f.touched) {
      const k = position[b];
      if (k < 0 || own.includes(b)) continue;
      let bound = limit;
      if (s.igap !== 0)
        bound = root2 * Math.max(s.drad, pairGap(s, false, gs(k), gm(i), lengthS(k), lengthM(i)));
      if (f.dist[b] <= bound) out.add(i * count + k);
    }
  }
  return out;
}

export function removedEdgePairs(_meta: ContactMeta, c: ContactData, s: Setting, all: Contacts, p: Points): Set<number> {
  const nodes = all.exactNode.length;
  const secondary = exactNodes(c.secondaryNode, all);
  const main = exactNodes(c.mainNode, all);
  const count = secondary.length / 2;
  const isSecondary = new Uint8Array(nodes);
  const lookup = new Map<number, number>();
  const key = (a: number, b: number) => (a < b ? a * nodes + b : b * nodes + a);
  for (let i = 0; i < count; i++) {
    const [a, b] = [secondary[2 * i], secondary[2 * i + 1]];
    isSecondary[a] = isSecondary[b] = 1;
    if (!lookup.has(key(a, b))) lookup.set(key(a, b), i);
  }
  const out = new Set<number>();
  const atNode = new NodeItems(nodes, main, 2, isSecondary);
  if (atNode.item.length === 0) return out;
  const { gm } = sideGaps(s, true, c);
  const lengthM = (i: number) => c.mainLength[c.mainListed[i]];
  const reach = root2 * s.maxGap;
  const f = new Front(nodes, main.length / 2);
  const apart = (a: number, b: number) => {
    closestBetweenEdges(p, main[2 * a], main[2 * a + 1], main[2 * b], main[2 * b + 1]);
    return edge.distance;
  };
  for (let i = 0; i < main.length / 2; i++) {
    f.start(i, main.subarray(2 * i, 2 * i + 2));
    const reached: number[] = [];
    while (f.front.length > 0) {
      ++f.ring;
      f.next = [];
      for (const q of f.front) {
        const near = Math.min(f.dist[main[2 * q]], f.dist[main[2 * q + 1]]) <= reach;
        if (!near && !(apart(q, i) < reach)) continue;
        for (const a of [main[2 * q], main[2 * q + 1]]) {
          if (f.expanded[a] === f.ring || f.dist[a] === Infinity) continue;
          f.expanded[a] = f.ring;
          for (let k = atNode.first[a]; k < atNode.first[a + 1]; k++) {
            const r = atNode.item[k];
            if (f.met[r] >= f.firstRing && f.met[r] !== f.ring) continue;
            if (f.met[r] !== f.ring) {
              f.next.push(r);
              reached.push(r);
            }
            f.met[r] = f.ring;
            for (const b of [main[2 * r], main[2 * r + 1]])
              if (b !== a && isSecondary[b]) f.set(b, f.dist[a] + apartNodes(p, a, b));
          }
        }
      }
      f.front = f.next;
    }
    for (const r of reached) {
      const [a, b] = [main[2 * r], main[2 * r + 1]];
      const [u, v] = [main[2 * i], main[2 * i + 1]];
      if (a === u || a === v || b === u || b === v) continue;
      let bound = reach;
      if (s.igap !== 0)
        bound = root2 * Math.max(s.drad, s.gapmin, pairGap(s, true, gm(r), gm(i), lengthM(r), lengthM(i)));
      const along = Math.min(f.dist[a], f.dist[b]);
      if (!(along <= bound) && !(apart(r, i) < bound)) continue;
      const k = lookup.get(key(a, b));
      if (k !== undefined) out.add(i * count + k);
    }
  }
  return out;
}
