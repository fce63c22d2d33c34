// The model as drawn: per part one mesh of faces and one set of element sides with common vertices. A pair per vertex has the
// contour: value times weight, and weight; colours fade into the part's colour at the rim of a patch.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, LineBasicMaterial, LineSegments, LinearFilter,
  Mesh as Mesh3, MeshLambertMaterial, Object3D, type Plane, RGBAFormat, Sphere, SRGBColorSpace, Vector3,
} from "three";
import { acceleratedRaycast, MeshBVH } from "three-mesh-bvh";
import type { Moved } from "schema/page";
import type { Mesh, MeshPart } from "../data";
import type { Shape } from "../decode/model";
import { Coarser, contourAttribute, fillContour, geometryOf, ranges, sharing, type Marks } from "./coarser";
import { discard } from "./shapes";

Mesh3.prototype.raycast = acceleratedRaycast;

/** hot: penetrating elements solid, others transparent; only: penetrating elements alone. */
export type Look = "solid" | "hot" | "only" | "ghost" | "hidden";
export type Side = "none" | "secondary" | "main";

export interface Part3D {
  index: number; // into Mesh.parts
  data: MeshPart;
  shape: Shape;
  coarser: Coarser[]; // coarsest first
  /** True if contour and penetrating elements are up to date. */
  contourDrawn: boolean;
  hotDrawn: boolean;
  faces: Mesh3 | null;
  lines: LineSegments | null; // sides of faces
  wires: LineSegments | null; // one-dimensional elements
  color: Color;
  look: Look;
  side: Side;
  /** Penetrating elements and their sides. */
  hot: Mesh3 | null;
  hotLines: LineSegments | null;
  sphere: Sphere;
  /** Triangle -> position of its element in `element`, and its kind. */
  triangleElement: Uint32Array;
  element: Float64Array;
  elementKind: Uint8Array;
}

// Muted colours that leave room for the contour.
const palette = ["#8fa3b8", "#b3a58f", "#94ad9b", "#b79a9c", "#a49bb8", "#8fb0b5", "#b8ac84", "#9aa7a0", "#a88f86", "#8c99c0"];

const manyTriangles = 30000;
const fewMarks = 4000; // nodes: up to this number their elements are drawn in full while the view moves
const atRest = 300000; // triangles drawn at rest without a graphics processor

export const elementKey = (kind: number, id: number): number => 16 * id + kind;

const sideColor = (side: Side, dark: boolean): string =>
  side === "secondary" ? (dark ? "#5aa9ff" : "#2468c8") : side === "main" ? (dark ? "#f0a860" : "#b8741a") : dark ? "#9db0c4" : "#7d8a99";
export const solidColor = (side: Side, dark: boolean): string =>
  side === "secondary" ? (dark ? "#6d8db8" : "#a9c3e6") : side === "main" ? (dark ? "#a88d6f" : "#dfc7a4") : dark ? "#7b8794" : "#c3cad2";

export class Parts3D {
  readonly group = new Object3D();
  readonly parts: Part3D[] = [];
  readonly texture: DataTexture;
  private readonly ghosts: Record<Side, MeshLambertMaterial>;
  private readonly line: LineBasicMaterial;
  private readonly ghostLine: LineBasicMaterial;
  private readonly wire: LineBasicMaterial;
  private readonly uniforms = { contourMap: { value: null as DataTexture | null } };
  edgesOn = true;

  constructor(mesh: Mesh, shapes: Shape[]) {
    this.texture = new DataTexture(new Uint8Array(256 * 4), 256, 1, RGBAFormat);
    this.texture.magFilter = this.texture.minFilter = LinearFilter;
    this.texture.colorSpace = SRGBColorSpace;
    this.uniforms.contourMap.value = this.texture;
    // One pass: layers of one colour look equal in any order.
    const ghost = () => new MeshLambertMaterial({ transparent: true, depthWrite: false, side: DoubleSide, flatShading: true, forceSinglePass: true });
    this.ghosts = { none: ghost(), secondary: ghost(), main: ghost() };
    this.line = new LineBasicMaterial({ color: "#1c2733", transparent: true, opacity: 0.28 });
    this.ghostLine = new LineBasicMaterial({ color: "#7b8896", transparent: true, opacity: 0.05, depthWrite: false });
    this.wire = new LineBasicMaterial({ color: "#5b6b7d" });
    mesh.parts.forEach((data, i) => this.add(data, shapes[i], i));
  }

  private add(data: MeshPart, shape: Shape, index: number): void {
    const color = new Color(palette[index % palette.length]);
    const items = data.groups.reduce((n, g) => n + g.count, 0);
    const element = new Float64Array(items);
    const elementKind = new Uint8Array(items);
    let e = 0;
    for (const g of data.groups) { element.set(g.element, e); elementKind.fill(g.kind, e, (e += g.count)); }
    const { triangleElement } = shape;
    const position = new BufferAttribute(data.position, 3);
    const empty = !(shape.high[0] >= shape.low[0]);
    const middle = new Vector3(...shape.low).add(new Vector3(...shape.high)).multiplyScalar(0.5);
    const part: Part3D = {
      index, data, shape, coarser: [], contourDrawn: false, hotDrawn: false, faces: null, lines: null, wires: null, color, look: "solid", side: "none",
      hot: null, hotLines: null, sphere: empty ? new Sphere() : new Sphere(middle, shape.radius), triangleElement, element, elementKind,
    };
    if (triangleElement.length > 0) {
      const geometry = geometryOf(part.sphere, new BufferAttribute(shape.index, 1), position, contourAttribute(data.node.length));
      const material = new MeshLambertMaterial({
        color, side: DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      });
      this.addContour(material);
      part.faces = new Mesh3(geometry, material);
      part.faces.userData = { part, triangleElement };
      this.group.add(part.faces);
      part.coarser = shape.coarse.map((c) => new Coarser(c, data, part.sphere));
      for (const c of part.coarser) this.group.add(c.group);
    }
    if (shape.wires.length > 0) {
      part.wires = new LineSegments(geometryOf(part.sphere, new BufferAttribute(shape.wires, 1), position), this.wire);
      this.group.add(part.wires);
    }
    this.parts.push(part);
  }

  /** Distinct element sides; made on first use. */
  private sides(part: Part3D): LineSegments | null {
    if (part.lines || !part.faces) return part.lines;
    const n = part.data.node.length;
    const keys: number[] = [];
    for (const g of part.data.groups) {
      if (g.corners === 2) continue;
      for (let i = 0; i < g.count; i++)
        for (let k = 0; k < g.corners; k++) {
          const a = g.vertex[g.corners * i + k];
          const b = g.vertex[g.corners * i + ((k + 1) % g.corners)];
          keys.push(a < b ? a * n + b : b * n + a);
        }
    }
    const sorted = Float64Array.from(keys).sort();
    const Index = n > 65535 ? Uint32Array : Uint16Array;
    const index = new Index(2 * sorted.length);
    let m = 0;
    for (let i = 0; i < sorted.length; i++) {
      if (i > 0 && sorted[i] === sorted[i - 1]) continue;
      index[m++] = Math.floor(sorted[i] / n);
      index[m++] = sorted[i] % n;
    }
    part.lines = new LineSegments(geometryOf(part.sphere, new BufferAttribute(index.slice(0, m), 1), part.faces.geometry.getAttribute("position") as BufferAttribute), this.line);
    this.group.add(part.lines);
    return part.lines;
  }

  private addContour(material: MeshLambertMaterial): void {
    material.onBeforeCompile = (shader) => {
      shader.uniforms.contourMap = this.uniforms.contourMap;
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nattribute vec2 contour;\nvarying vec2 vContour;")
        .replace("#include <begin_vertex>", "#include <begin_vertex>\nvContour = contour;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", "#include <common>\nvarying vec2 vContour;\nuniform sampler2D contourMap;")
        .replace(
          "#include <color_fragment>",
          `#include <color_fragment>
          if (vContour.y > 0.001) {
            float value = clamp(vContour.x / vContour.y, 0.0, 1.0);
            vec3 c = texture2D(contourMap, vec2(value * 0.992 + 0.004, 0.5)).rgb;
            float weight = smoothstep(0.05, 0.55, vContour.y);
            // A part of the colour ignores the light, so that it can be compared with the legend.
            diffuseColor.rgb = mix(diffuseColor.rgb, 0.62 * c, weight);
            totalEmissiveRadiance += 0.42 * weight * c;
          }`,
        );
    };
    material.customProgramCacheKey = () => "contour";
  }

  private values: Float32Array | null = null;
  /** Contour values in [0, 1] by page node, NaN: none. null: no contour. */
  setContour(values: Float32Array | null): void {
    this.values = values;
    for (const part of this.parts) {
      part.contourDrawn = false;
      for (const c of part.coarser) c.contourDrawn = false;
    }
  }

  private marks: Marks = { node: new Uint8Array(0), touched: new Uint8Array(0), elements: null, few: true };
  private elements: () => Set<number> = () => new Set();
  /** Marks penetrating elements: with a marked node, or named by kind and id and with touched nodes. */
  setHot(node: Uint8Array, touched: Uint8Array, elements: () => Set<number>): void {
    this.elements = elements;
    let count = 0;
    for (let i = 0; i < touched.length; i++) count += touched[i];
    this.marks = { node, touched, elements: null, few: count <= fewMarks };
    for (const part of this.parts) { part.hotDrawn = false; for (const c of part.coarser) c.hotDrawn = false; }
  }

  /** Updates contour and penetrating elements of a part. */
  private complete(part: Part3D): void {
    if (!part.faces) return;
    if (!part.contourDrawn) {
      part.contourDrawn = true;
      fillContour(part.faces.geometry, part.data.node, null, this.values);
    }
    if (!part.hotDrawn) { part.hotDrawn = true; this.drawHot(part, part.faces.geometry); }
  }

  private drawHot(part: Part3D, from: BufferGeometry): void {
    discard(this.group, [part.hot, part.hotLines]);
    part.hot = part.hotLines = null;
    const { node } = this.marks;
    const elements = (this.marks.elements ??= this.elements());
    const marked = part.data.node.some((n) => node[n] === 1);
    const triangles: number[] = [];
    const lines: number[] = [];
    const owner: number[] = [];
    let e = 0;
    for (const g of part.data.groups)
      for (let i = 0; i < g.count; i++, e++) {
        if (g.corners === 2) continue;
        let hot = elements.has(elementKey(g.kind, g.element[i]));
        for (let k = 0; marked && !hot && k < g.corners; k++) hot = node[part.data.node[g.vertex[g.corners * i + k]]] === 1;
        if (!hot) continue;
        const v = g.vertex.subarray(g.corners * i, g.corners * (i + 1));
        for (let k = 2; k < g.corners; k++) { triangles.push(v[0], v[k - 1], v[k]); owner.push(e); }
        for (let k = 0; k < g.corners; k++) lines.push(v[k], v[(k + 1) % g.corners]);
      }
    if (triangles.length === 0) return;
    const share = (index: number[]) => sharing(from, new BufferAttribute(part.data.node.length > 65535 ? new Uint32Array(index) : new Uint16Array(index), 1));
    part.hot = new Mesh3(share(triangles), this.materialOf(part));
    part.hot.userData = { part, triangleElement: Uint32Array.from(owner) };
    part.hotLines = new LineSegments(share(lines), this.line);
    this.group.add(part.hot, part.hotLines);
  }

  /** 256 colours. */
  setColors(colorAt: (t: number) => [number, number, number]): void {
    const out = this.texture.image.data as Uint8Array;
    for (let i = 0; i < 256; i++) out.set([...colorAt(i / 255), 255], 4 * i);
    this.texture.needsUpdate = true;
  }

  /** `context`: opacity of transparent parts; 1: normal. */
  setGround(dark: boolean, neutral: boolean, context: number): void {
    this.line.color.set(dark ? "#0b0f14" : "#1c2733");
    this.line.opacity = dark ? 0.5 : 0.25;
    // Many layers add up.
    for (const side of ["none", "secondary", "main"] as const) {
      this.ghosts[side].color.set(sideColor(side, dark));
      this.ghosts[side].opacity = (this.parts.length > 60 ? 0.045 : 0.1) * (side === "none" ? context : 1.8);
    }
    this.wire.color.set(dark ? "#7f90a3" : "#5b6b7d");
    for (const p of this.parts)
      if (p.faces) {
        // Parts on one another do not fight for a pixel: one of them always lies behind.
        this.materialOf(p).polygonOffsetUnits = 1 + 2 * (p.index % 4) + (p.side === "main" ? 8 : 0);
        this.materialOf(p).color.copy(neutral ? new Color(solidColor(p.side, dark)) : p.color);
      }
  }

  private readonly materials = new Map<Part3D, MeshLambertMaterial>();
  private materialOf(part: Part3D): MeshLambertMaterial {
    let m = this.materials.get(part);
    if (!m) this.materials.set(part, (m = part.faces!.material as MeshLambertMaterial));
    return m;
  }

  /** Sets what is drawn of a part; show() decides how finely. */
  setLook(part: Part3D, look: Look): void {
    part.look = look;
    if (!part.wires) return;
    part.wires.visible = look !== "hidden" && look !== "only";
    part.wires.material = look === "ghost" || look === "hot" ? this.ghostLine : this.wire;
  }

  /** Before a picture. `moving`: one of many on a slow machine; `slow`: no GPU; `pixel`: its length; `sees`: sphere visible. */
  show(moving: boolean, slow: boolean, pixel: (at: Vector3) => number, sees: (s: Sphere) => boolean, at: Vector3): void {
    const drawn = this.parts.filter((p) => p.faces && p.look !== "hidden" && p.look !== "only");
    const all = drawn.reduce((n, p) => n + p.triangleElement.length, 0);
    const least = slow ? 8 : 3;
    for (const p of this.parts) {
      if (!p.faces) continue;
      const near = () => pixel(p.sphere.containsPoint(at) ? at : p.sphere.center);
      const level = p.coarser.length === 0 ? -1 : moving ? 0 : slow && all > atRest && this.side(p) < 2 * near() ? p.coarser.length - 1 : -1;
      const ghost = p.look === "ghost" || p.look === "hot";
      const faces = p.look === "solid" || ghost;
      const hot = p.look === "hot" || p.look === "only";
      const exact = level < 0 || (hot && this.marks.few);
      if (exact && p.look !== "hidden") this.complete(p);
      p.faces.visible = faces && level < 0 && (!moving || !ghost || all <= manyTriangles);
      p.faces.material = ghost ? this.ghosts[p.side] : this.materialOf(p);
      p.faces.renderOrder = ghost ? 1 : 0;
      if (p.faces.visible) this.narrow(p, slow ? sees : () => true);
      if (p.hot) p.hot.visible = hot && exact;
      if (p.hotLines) p.hotLines.visible = hot && exact && this.edgesOn && !moving;
      if (p.wires) p.wires.visible = p.look !== "hidden" && p.look !== "only" && !(moving && slow);
      p.coarser.forEach((c, k) => c.show(k === level && p.look !== "hidden", faces, hot && !exact, p.faces!.material as MeshLambertMaterial, this.materialOf(p), this.values, this.marks));
      const lines = this.edgesOn && !moving && level < 0 && p.look === "solid" && this.side(p) > least * pixel(p.sphere.center);
      const sides = lines ? this.sides(p) : p.lines;
      if (sides) sides.visible = lines;
    }
  }

  private readonly spans = new Map<Part3D, { first: number; sphere: Sphere }[]>();
  /** Restricts a large part to its visible range of triangles. */
  private narrow(part: Part3D, sees: (s: Sphere) => boolean): void {
    if (part.triangleElement.length < manyTriangles) return;
    let spans = this.spans.get(part);
    if (!spans) this.spans.set(part, (spans = ranges(part.data.position, part.shape.index)));
    const seen = spans.flatMap((s, i) => (sees(s.sphere) ? [i] : []));
    const [first, last] = [seen[0] ?? 0, seen.at(-1) ?? -1];
    const end = last + 1 < spans.length ? spans[last + 1].first : part.shape.index.length;
    part.faces!.geometry.setDrawRange(spans[first].first, last < 0 ? 0 : end - spans[first].first);
  }

  private readonly typical = new Map<Part3D, number>();
  /** Length of a side in the middle of a sample. */
  private side(part: Part3D): number {
    let found = this.typical.get(part);
    if (found !== undefined) return found;
    const x = part.data.position;
    const lengths: number[] = [];
    for (const g of part.data.groups)
      for (let i = 0; g.corners > 2 && i < g.count; i += Math.max(1, Math.floor(g.count / 40))) {
        const [a, b] = [3 * g.vertex[g.corners * i], 3 * g.vertex[g.corners * i + 1]];
        lengths.push(Math.hypot(x[a] - x[b], x[a + 1] - x[b + 1], x[a + 2] - x[b + 2]));
      }
    found = lengths.sort((a, b) => a - b)[lengths.length >> 1] ?? 0;
    this.typical.set(part, found);
    return found;
  }

  private shifted = false;
  /** Moves repaired nodes to their former position, or back. */
  showBefore(rows: Moved["rows"], on: boolean): void {
    if (on === this.shifted) return;
    this.shifted = on;
    const by = new Map(rows.map((r) => [r[0], r]));
    for (const part of this.parts) {
      const { node, position } = part.data;
      let any = false;
      for (let v = 0; v < node.length; v++) {
        const r = by.get(node[v]);
        if (!r) continue;
        any = true;
        for (let k = 0; k < 3; k++) position[3 * v + k] += on ? -r[k + 1] : r[k + 1];
      }
      if (!any) continue;
      for (const o of [part.faces, part.wires]) if (o) o.geometry.getAttribute("position").needsUpdate = true;
    }
  }
  setClip(planes: Plane[]): void {
    for (const p of this.parts) if (p.faces) this.materialOf(p).clippingPlanes = planes;
    for (const m of [...Object.values(this.ghosts), this.line, this.ghostLine, this.wire]) m.clippingPlanes = planes;
  }

  /** Meshes to pick from; search trees are built on first use. */
  pickable(): Mesh3[] {
    const out: Mesh3[] = [];
    for (const p of this.parts) {
      if (p.faces && p.look === "solid") out.push(p.faces);
      if (p.look !== "hot" && p.look !== "only") continue;
      this.complete(p);
      if (p.hot) out.push(p.hot);
    }
    return out;
  }
  /** Transparent faces: picked if nothing solid is there. */
  pickableGhosts(): Mesh3[] {
    return this.parts.flatMap((p) => (p.faces && (p.look === "ghost" || p.look === "hot") ? [p.faces] : []));
  }
  prepare(mesh: Mesh3): void {
    const geometry = mesh.geometry;
    if (geometry.boundsTree) return;
    const { start, count } = geometry.drawRange;
    geometry.setDrawRange(0, Infinity); // all, visible or not
    geometry.boundsTree = new MeshBVH(geometry, { indirect: true });
    geometry.setDrawRange(start, count);
  }

  bounds(visible: (p: Part3D) => boolean): Sphere | null {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = low.clone().negate();
    for (const p of this.parts) {
      if (!visible(p)) continue;
      low.min(new Vector3(...p.shape.low));
      high.max(new Vector3(...p.shape.high));
    }
    if (!(high.x >= low.x)) return null;
    return new Sphere(low.clone().add(high).multiplyScalar(0.5), Math.max(high.distanceTo(low) / 2, 1e-6));
  }
}
