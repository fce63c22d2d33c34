// Two section planes: cut side, caps in solids, lines in shells.
import {
  AlwaysStencilFunc, BackSide, BufferAttribute, BufferGeometry, DecrementWrapStencilOp, DoubleSide, FrontSide, IncrementWrapStencilOp, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, NotEqualStencilFunc, Object3D, Plane, PlaneGeometry, ReplaceStencilOp, type Side, type StencilOp, Vector3,
  type WebGLRenderer,
} from "three";
import { kindNames } from "../data";
import type { Part3D, Parts3D } from "./parts3d";

export interface Cut {
  normal: Vector3;
  at: number; // 0..1 of the extent
}

export class Section {
  readonly group = new Object3D();
  planes: Plane[] = [];
  private readonly solids = new Map<Part3D, BufferGeometry | null>();
  constructor(private readonly parts: Parts3D) {}
  /** Cuts away the side of the normal. */
  set(cuts: Cut[], center: Vector3, radius: number): void {
    this.planes = cuts.map((c) => {
      const n = c.normal.clone().normalize();
      return new Plane(n.clone().negate(), center.dot(n) + (2 * c.at - 1) * radius);
    });
    this.parts.setClip(this.planes);
    for (const old of this.group.children) if (old instanceof LineSegments) old.geometry.dispose();
    this.group.clear();
    this.planes.forEach((plane, i) => this.build(plane, this.planes.filter((_, k) => k !== i), i, center, radius));
  }
  /** True if a point is cut away. */
  hides(p: Vector3): boolean { return this.planes.some((plane) => plane.distanceToPoint(p) < 0); }
  private build(plane: Plane, others: Plane[], order: number, center: Vector3, radius: number): void {
    const shown = this.parts.parts.filter((p) => p.look !== "hidden" && p.look !== "only");
    // Inside a solid, more back faces than front faces lie behind the plane.
    const count = (side: Side, op: StencilOp) =>
      new MeshBasicMaterial({
        side, depthWrite: false, depthTest: false, colorWrite: false, stencilWrite: true, stencilFunc: AlwaysStencilFunc,
        stencilFail: op, stencilZFail: op, stencilZPass: op, clippingPlanes: [plane],
      });
    const back = count(BackSide, IncrementWrapStencilOp);
    const front = count(FrontSide, DecrementWrapStencilOp);
    let any = false;
    for (const p of shown) {
      const geometry = this.solidFaces(p);
      if (!geometry) continue;
      any = true;
      for (const material of [back, front]) {
        const mesh = new Mesh(geometry, material);
        mesh.renderOrder = 1.1 + 0.1 * order;
        this.group.add(mesh);
      }
    }
    if (any) {
      const cap = new Mesh(
        new PlaneGeometry(2.2 * radius, 2.2 * radius),
        new MeshBasicMaterial({
          color: "#9aa4af", side: DoubleSide, clippingPlanes: others, stencilWrite: true, stencilRef: 0, stencilFunc: NotEqualStencilFunc,
          stencilFail: ReplaceStencilOp, stencilZFail: ReplaceStencilOp, stencilZPass: ReplaceStencilOp,
        }),
      );
      cap.renderOrder = 1.15 + 0.1 * order;
      cap.position.copy(plane.projectPoint(center, new Vector3()));
      cap.lookAt(cap.position.clone().sub(plane.normal));
      cap.onAfterRender = (renderer) => (renderer as WebGLRenderer).clearStencil();
      this.group.add(cap);
    }
    const lines = new LineSegments(
      new BufferGeometry().setAttribute("position", new BufferAttribute(this.outline(plane, shown), 3)),
      new LineBasicMaterial({ color: "#d0021b", clippingPlanes: others }),
    );
    lines.renderOrder = 3;
    lines.frustumCulled = false;
    this.group.add(lines);
  }
  /** Outer faces of the solids of a part. */
  private solidFaces(part: Part3D): BufferGeometry | null {
    const known = this.solids.get(part);
    if (known !== undefined) return known;
    const index: number[] = [];
    for (const g of part.data.groups) {
      if (kindNames[g.kind] !== "solid") continue;
      for (let i = 0; i < g.count; i++) {
        const v = g.vertex.subarray(g.corners * i, g.corners * (i + 1));
        for (let k = 2; k < g.corners; k++) index.push(v[0], v[k - 1], v[k]);
      }
    }
    const geometry = index.length > 0 ? new BufferGeometry() : null;
    geometry?.setAttribute("position", part.faces!.geometry.getAttribute("position")).setIndex(index);
    this.solids.set(part, geometry);
    return geometry;
  }
  /** Lines of the plane through triangles. */
  private outline(plane: Plane, parts: Part3D[]): Float32Array {
    const out: number[] = [];
    const { normal: n, constant } = plane;
    for (const p of parts) {
      const index = p.faces?.geometry.index?.array;
      if (!index || Math.abs(plane.distanceToPoint(p.sphere.center)) > p.sphere.radius) continue;
      const x = p.data.position;
      const side = new Float32Array(x.length / 3);
      for (let i = 0; i < side.length; i++) side[i] = n.x * x[3 * i] + n.y * x[3 * i + 1] + n.z * x[3 * i + 2] + constant;
      for (let t = 0; t < index.length; t += 3)
        for (let k = 0, found = 0; k < 3; k++) {
          const a = index[t + k];
          const b = index[t + ((k + 1) % 3)];
          if (side[a] < 0 === side[b] < 0) continue;
          const s = side[a] / (side[a] - side[b]);
          for (let axis = 0; axis < 3; axis++) out.push(x[3 * a + axis] + s * (x[3 * b + axis] - x[3 * a + axis]));
          if (++found === 2) break;
        }
    }
    return Float32Array.from(out);
  }
}
