// A coarser version of a part, for motion on slow machines and for the first picture. Vertices of a grid cell are merged; a cell
// with a penetrating node is drawn as penetrating.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, type MeshLambertMaterial, Object3D, Sphere, Vector3 } from "three";
import type { MeshPart } from "../data";
import type { Coarse } from "../decode/model";
import { discard } from "./shapes";

/** Penetrating nodes and elements (see elementKey in parts3d.ts). */
export interface Marks {
  node: Uint8Array; // by page node
  touched: Uint8Array; // including nodes of the elements
  elements: Set<number> | null; // null: not yet needed
  few: boolean;
}

export const contourAttribute = (vertices: number): BufferAttribute => new BufferAttribute(new Float32Array(2 * vertices), 2).setUsage(DynamicDrawUsage);

/** Values by page node as pairs of value and weight; `vertex`: drawn vertices of the part, null: all. */
export function fillContour(geometry: BufferGeometry, node: Uint32Array, vertex: Uint32Array | null, values: Float32Array | null): void {
  const attribute = geometry.getAttribute("contour") as BufferAttribute;
  const out = attribute.array as Float32Array;
  let any = false;
  for (let i = 0; i < attribute.count; i++) {
    const v = values ? values[node[vertex ? vertex[i] : i]] : NaN;
    const w = v === v ? 1 : 0;
    const x = w ? v : 0;
    any ||= out[2 * i] !== x || out[2 * i + 1] !== w;
    out[2 * i] = x;
    out[2 * i + 1] = w;
  }
  if (any) attribute.needsUpdate = true;
}

/** `sphere`: bounds. */
export function geometryOf(sphere: Sphere, index: BufferAttribute, position: BufferAttribute, contour?: BufferAttribute): BufferGeometry {
  const geometry = new BufferGeometry().setAttribute("position", position).setIndex(index);
  if (contour) geometry.setAttribute("contour", contour);
  geometry.boundingSphere = sphere.clone();
  return geometry;
}
/** Other triangles or lines on equal vertices. */
export const sharing = (from: BufferGeometry, index: BufferAttribute): BufferGeometry =>
  geometryOf(from.boundingSphere!, index, from.getAttribute("position") as BufferAttribute, from.getAttribute("contour") as BufferAttribute);

const span = 3 * 8192; // indices

/** Pieces of a list of triangles with their bounding spheres. */
export function ranges(x: Float32Array, index: ArrayLike<number>): { first: number; sphere: Sphere }[] {
  const out = [];
  for (let first = 0; first < index.length; first += span) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = first; i < Math.min(first + span, index.length); i++)
      for (let k = 0; k < 3; k++) {
        const v = x[3 * index[i] + k];
        if (v < low[k]) low[k] = v;
        if (v > high[k]) high[k] = v;
      }
    const [a, b] = [new Vector3(...low), new Vector3(...high)];
    out.push({ first, sphere: new Sphere(a.clone().add(b).multiplyScalar(0.5), a.distanceTo(b) / 2) });
  }
  return out;
}

export class Coarser {
  readonly group = new Object3D();
  contourDrawn = false;
  hotDrawn = false;
  private faces: Mesh | null = null;
  private hot: Mesh | null = null;

  constructor(
    readonly coarse: Coarse,
    private readonly data: MeshPart,
    private readonly sphere: Sphere,
  ) {}

  /** Shows or hides it: faces with `material`, penetrating ones with `solid`. */
  show(on: boolean, faces: boolean, hot: boolean, material: MeshLambertMaterial, solid: MeshLambertMaterial, values: Float32Array | null, marks: Marks): void {
    this.group.visible = on;
    if (!on) return;
    this.faces ??= this.make();
    this.faces.visible = faces;
    this.faces.material = material;
    this.faces.renderOrder = material === solid ? 0 : 1;
    if (!this.contourDrawn) { this.contourDrawn = true; this.fill(values); }
    if (hot && !this.hotDrawn) { this.hotDrawn = true; this.mark(marks, solid); }
    if (this.hot) this.hot.visible = hot;
  }

  private make(): Mesh {
    const { vertex, index } = this.coarse;
    const position = new Float32Array(3 * vertex.length);
    for (let i = 0; i < vertex.length; i++) for (let k = 0; k < 3; k++) position[3 * i + k] = this.data.position[3 * vertex[i] + k];
    const made = new Mesh(geometryOf(this.sphere, new BufferAttribute(index, 1), new BufferAttribute(position, 3), contourAttribute(vertex.length)));
    this.group.add(made);
    return made;
  }

  /** A cell has the largest value of its vertices. */
  private fill(values: Float32Array | null): void {
    const largest = new Float32Array(this.coarse.vertex.length).fill(NaN);
    const { node } = this.data;
    if (values)
      for (let i = 0; i < node.length; i++) {
        const v = values[node[i]];
        const at = this.coarse.of[i];
        if (v === v && !(largest[at] >= v)) largest[at] = v;
      }
    const own = Uint32Array.from(largest, (_, i) => i);
    fillContour(this.faces!.geometry, own, null, largest);
  }

  private mark({ touched }: Marks, solid: MeshLambertMaterial): void {
    const { of, index, vertex } = this.coarse;
    const cell = new Uint8Array(vertex.length);
    for (let i = 0; i < of.length; i++) if (touched[this.data.node[i]] === 1) cell[of[i]] = 1;
    const out = index.slice();
    let m = 0;
    for (let t = 0; t < index.length; t += 3) {
      if (cell[index[t]] + cell[index[t + 1]] + cell[index[t + 2]] === 0) continue;
      for (let k = 0; k < 3; k++) out[m++] = index[t + k];
    }
    discard(this.group, [this.hot]);
    this.hot = null;
    if (m === 0) return;
    this.hot = new Mesh(sharing(this.faces!.geometry, new BufferAttribute(out.slice(0, m), 1)), solid);
    this.group.add(this.hot);
  }
}
