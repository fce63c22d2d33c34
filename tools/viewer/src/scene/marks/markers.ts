// Dots of penetrating nodes, and arrows: the way out of each, or given ones.
import {
  BufferAttribute, BufferGeometry, type CanvasTexture, Color, InstancedMesh, Matrix4, MeshLambertMaterial, type Plane, Points, type PointsMaterial, Quaternion,
  type Scene, Vector3,
} from "three";
import type { CameraControl } from "../camera";
import { pointOf, wayOut } from "../drawn";
import { arrowGeometry, discard, dotMaterial } from "../shapes";
import type { Hit, Report } from "../../report";

export interface Arrow {
  at: [number, number, number];
  along: [number, number, number];
  length: number; // of the longest one
  rgb: [number, number, number]; // linear, 0..1
}

const mostArrows = 10000;
const mostDotsInSoftware = 20000; // at least as many as arrows

export class Markers {
  hits: Hit[] = [];
  private dots: Points | null = null;
  hollow: Points | null = null; // penetrations by round-off only: hollow dots
  private list: Arrow[] = [];
  private arrows: InstancedMesh | null = null;
  private arrowsOn = true;
  private coarse = false;
  private planes: Plane[] = [];
  private scale = 0;

  constructor(private readonly report: Report, private readonly scene: Scene, private readonly disc: CanvasTexture, private readonly software: boolean) {}

  /** `colorOf` gives components of 0..255. */
  set(hits: Hit[], colorOf: (h: Hit) => [number, number, number], instead: Arrow[] | null): void {
    discard(this.scene, [this.dots, this.hollow]);
    this.hollow = null;
    if (this.arrows) {
      this.scene.remove(this.arrows);
      this.arrows.dispose();
      this.arrows = null;
    }
    this.hits = hits;
    const dots = this.software ? Math.min(hits.length, mostDotsInSoftware) : hits.length;
    const position = new Float32Array(3 * dots);
    const color = new Float32Array(3 * dots);
    const c = new Color();
    for (let i = 0; i < dots; i++) {
      const [r, g, b] = colorOf(hits[i]);
      c.setRGB(r / 255, g / 255, b / 255, "srgb").toArray(color, 3 * i);
      pointOf(this.report, hits[i].row).toArray(position, 3 * i);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("color", new BufferAttribute(color, 3));
    this.dots = new Points(geometry, dotMaterial(this.disc));
    this.dots.frustumCulled = false;
    this.dots.renderOrder = 3;
    geometry.setDrawRange(0, this.most);
    this.scene.add(this.dots);
    const open = hits.slice(0, dots).filter((x) => this.report.isRoundOff(x.row));
    if (open.length > 0) {
      const middle = new BufferGeometry();
      middle.setAttribute("position", new BufferAttribute(Float32Array.from(open.flatMap((x) => pointOf(this.report, x.row).toArray())), 3));
      middle.setAttribute("color", new BufferAttribute(new Float32Array(3 * open.length).fill(1), 3));
      this.hollow = new Points(middle, dotMaterial(this.disc, 4));
      this.hollow.frustumCulled = false;
      this.hollow.renderOrder = 4;
      this.scene.add(this.hollow);
    }
    this.list = instead ?? hits.slice(0, mostArrows).map((hit, i) => ({
      at: pointOf(this.report, hit.row).toArray(), along: wayOut(this.report, hit.row).toArray(), length: hit.row.onSurface ? 0 : 1, rgb: [color[3 * i], color[3 * i + 1], color[3 * i + 2]],
    }));
    const count = Math.min(this.list.length, mostArrows);
    if (count > 0) {
      this.arrows = new InstancedMesh(arrowGeometry(), new MeshLambertMaterial({ color: "#ffffff" }), count);
      this.arrows.frustumCulled = false;
      this.arrows.visible = this.arrowsOn && !this.coarse;
      for (let i = 0; i < count; i++) this.arrows.setColorAt(i, c.fromArray(this.list[i].rgb));
      this.scene.add(this.arrows);
      this.scale = 0;
    }
    this.clip(this.planes);
  }

  /** Dots and arrows are cut like the model. */
  clip(planes: Plane[]): void {
    this.planes = planes;
    for (const points of [this.dots, this.hollow]) if (points) (points.material as PointsMaterial).clippingPlanes = planes;
    if (this.arrows) (this.arrows.material as MeshLambertMaterial).clippingPlanes = planes;
  }

  /** Rows are deepest first. */
  private get most(): number { return this.software && this.coarse ? 1500 : Infinity; }
  setDetail(coarse: boolean): void {
    this.coarse = coarse;
    if (this.arrows) this.arrows.visible = this.arrowsOn && !coarse;
    this.dots?.geometry.setDrawRange(0, this.most);
  }
  setArrows(on: boolean): void {
    this.arrowsOn = on;
    if (this.arrows) this.arrows.visible = on && !this.coarse;
    this.scale = 0;
  }

  /** Arrows keep their size on the screen; short ones point in the direction the node has to move. */
  scaleArrows(control: CameraControl): void {
    if (!this.arrows?.visible) return;
    const scale = Math.min(control.pixel(control.target) * 44, control.radius * 0.08);
    if (this.scale > 0 && Math.abs(scale / this.scale - 1) < 0.08) return;
    this.scale = scale;
    const [up, m, q] = [new Vector3(0, 1, 0), new Matrix4(), new Quaternion()];
    for (let i = 0; i < this.arrows.count; i++) {
      const { at, along, length } = this.list[i];
      const n = new Vector3(...along).normalize();
      q.setFromUnitVectors(up, n.lengthSq() > 0 ? n : up);
      this.arrows.setMatrixAt(i, m.compose(new Vector3(...at), q, new Vector3(length > 0 ? scale : 0, scale * length, length > 0 ? scale : 0)));
    }
    this.arrows.instanceMatrix.needsUpdate = true;
  }
}
