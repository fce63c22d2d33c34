// Marks in the picture: the chosen row with outline and way out, and the line between measured points.
import { BufferGeometry, type CanvasTexture, type Mesh, type Points, type Scene, Vector3 } from "three";
import type { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import type { Hit, Report } from "../../report";
import { exactAt, pointOf, wayOut } from "../drawn";
import { coneAt, discard, dotsOver, thickLines } from "../shapes";

export class Marked {
  readonly selection: (LineSegments2 | Points | Mesh)[] = [];
  private readonly rule: (LineSegments2 | Points)[] = [];

  constructor(
    private readonly report: Report,
    private readonly scene: Scene,
    private readonly disc: CanvasTexture,
    private readonly container: HTMLElement,
  ) {}

  readonly lines = (x: Float32Array, color: string, width: number) => thickLines(x, color, width, this.container.clientWidth, this.container.clientHeight);

  /** Outline of the main side, the node or edge, the way out, and the residual distance. */
  select(hit: Hit | null, dark: boolean): void {
    discard(this.scene, this.selection.splice(0));
    if (!hit) return;
    const at = (n: number) => exactAt(this.report, n);
    const main = this.report.mainNodes(hit.row).map(at);
    const secondary = this.report.secondaryNodes(hit.row).map(at);
    const point = pointOf(this.report, hit.row);
    const normal = wayOut(this.report, hit.row);
    const foot = point.clone().addScaledVector(normal, -hit.row.distance);
    const out = point.clone().addScaledVector(normal, hit.row.depth);
    const loop = main.length > 2 ? main.flatMap((p, i) => [p, main[(i + 1) % main.length]]) : main;
    this.addLines(loop, dark ? "#ffb454" : "#c2410c", 3);
    if (secondary.length === 2) this.addLines(secondary, dark ? "#7cc7ff" : "#1d4ed8", 4);
    if (!hit.row.onSurface) {
      this.addLines([foot, point], dark ? "#ffffff" : "#111827", 2.5);
      this.addLines([point, out], dark ? "#7cc7ff" : "#1d4ed8", 2.5);
      this.addTip(point, out, dark ? "#7cc7ff" : "#1d4ed8");
    }
    const dot = new BufferGeometry().setFromPoints([point]);
    for (const [size, color] of [[17, dark ? "#0b0f14" : "#ffffff"], [12, dark ? "#7cc7ff" : "#1d4ed8"]] as const) {
      const p = dotsOver(dot, this.disc, size, color, 8);
      this.scene.add(p);
      this.selection.push(p);
    }
  }

  private addLines(points: Vector3[], color: string, width: number): void {
    const positions = Float32Array.from(points.flatMap((p) => p.toArray()));
    if (!positions.every(Number.isFinite)) return; // beyond the range of a picture
    const lines = this.lines(positions, color, width);
    this.scene.add(lines);
    this.selection.push(lines);
  }

  /** Head of the depth arrow. */
  private addTip(from: Vector3, to: Vector3, color: string): void {
    const length = from.distanceTo(to);
    if (!(length > 0) || !Number.isFinite(length)) return;
    const cone = coneAt(from, to, color);
    this.scene.add(cone);
    this.selection.push(cone);
  }

  /** Line between measured points. */
  measure(points: Vector3[], dark: boolean, outlines: number[]): void {
    discard(this.scene, this.rule.splice(0));
    this.rule.push(dotsOver(new BufferGeometry().setFromPoints(points), this.disc, 11, dark ? "#f7f" : "#a0a", 9));
    if (points.length === 2) this.rule.push(this.lines(Float32Array.from(points.flatMap((p) => p.toArray())), dark ? "#ff77ff" : "#aa00aa", 2.5));
    if (outlines.length > 0) this.rule.push(this.lines(Float32Array.from(outlines), dark ? "#ffb454" : "#c2410c", 3));
    this.scene.add(...this.rule);
  }
}
