// Lines and dots that lie over the picture: edges of crossed elements, lines of ties.
import { BufferAttribute, BufferGeometry, type CanvasTexture, type LineSegments, Points, PointsMaterial, type Scene } from "three";
import type { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { thinLines } from "./shapes";

const mostThickLines = 4000; // thick lines are triangles

export interface Strokes {
  ends: Float32Array; // six numbers a line
  color: string;
  width: number;
}

export class LineLayer {
  readonly lines: (LineSegments2 | LineSegments)[] = [];
  private dots: Points | null = null;
  private shown = true;

  constructor(
    private readonly scene: Scene,
    private readonly thick: (ends: Float32Array, color: string, width: number) => LineSegments2,
    private readonly disc: CanvasTexture,
    private readonly changed: () => void,
  ) {}

  set visible(on: boolean) {
    this.shown = on;
    for (const l of this.lines) l.visible = on;
  }

  /** In place of what was there: the strokes, the later above the earlier, and dots. */
  set(strokes: Strokes[], dots: { at: Float32Array; color: string } | null = null): void {
    for (const l of this.lines.splice(0)) {
      this.scene.remove(l);
      l.geometry.dispose();
    }
    if (this.dots) {
      this.scene.remove(this.dots);
      this.dots.geometry.dispose();
      this.dots = null;
    }
    for (const { ends, color, width } of strokes) {
      if (ends.length === 0) continue;
      const l = ends.length > 6 * mostThickLines ? thinLines(ends, color) : this.thick(ends, color, width);
      l.visible = this.shown;
      this.lines.push(l);
      this.scene.add(l);
    }
    if (dots && dots.at.length > 0) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(dots.at, 3));
      this.dots = new Points(geometry, new PointsMaterial({ size: 10, color: dots.color, sizeAttenuation: false, map: this.disc, alphaTest: 0.3, depthTest: false, transparent: true }));
      this.dots.frustumCulled = false;
      this.dots.renderOrder = 7;
      this.scene.add(this.dots);
    }
    this.changed();
  }
}
