// Shapes of the 3D view: arrow of a force or depth, dot of a node, lines and dots over everything.
import {
  BufferAttribute, BufferGeometry, CanvasTexture, Color, ConeGeometry, CylinderGeometry, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, type Object3D, Points,
  PointsMaterial, type Scene, Vector3,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** An arrow of length 1 along y. */
export function arrowGeometry(): BufferGeometry {
  const shaft = new CylinderGeometry(0.022, 0.022, 0.62, 5, 1, true).translate(0, 0.31, 0);
  const tip = new ConeGeometry(0.085, 0.3, 7).translate(0, 0.77, 0);
  return mergeGeometries([shaft, tip])!;
}

/** A white disc. */
export function discTexture(): CanvasTexture {
  const size = 64;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const g = canvas.getContext("2d")!;
  g.fillStyle = "#fff";
  g.beginPath();
  g.arc(size / 2, size / 2, size / 2 - 2, 0, 2 * Math.PI);
  g.fill();
  return new CanvasTexture(canvas);
}

/** Dots in vertex colours. */
export const dotMaterial = (disc: CanvasTexture, size = 8): PointsMaterial =>
  new PointsMaterial({ size, sizeAttenuation: false, map: disc, alphaTest: 0.3, vertexColors: true, transparent: true });

/** Lines one pixel wide, in front of everything. */
export function thinLines(positions: Float32Array, color: string): LineSegments {
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ color, depthTest: false, transparent: true }));
  lines.renderOrder = 7;
  lines.frustumCulled = false;
  return lines;
}

/** Lines several pixels wide, for a picture of this size. */
export function thickLines(positions: Float32Array, color: string, width: number, across: number, down: number): LineSegments2 {
  const material = new LineMaterial({ color: new Color(color).getHex(), linewidth: width, depthTest: false, transparent: true });
  material.resolution.set(across, down);
  const lines = new LineSegments2(new LineSegmentsGeometry().setPositions(positions), material);
  lines.renderOrder = 7;
  lines.frustumCulled = false;
  return lines;
}

/** Head of an arrow between two points. */
export function coneAt(from: Vector3, to: Vector3, color: string): Mesh {
  const length = from.distanceTo(to);
  const cone = new Mesh(new ConeGeometry(0.12 * length, 0.32 * length, 12).translate(0, -0.16 * length, 0), new MeshBasicMaterial({ color, depthTest: false, transparent: true }));
  cone.position.copy(to);
  cone.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), to.clone().sub(from).divideScalar(length));
  cone.renderOrder = 8;
  return cone;
}

/** Dots of one colour. */
export function dotsOver(geometry: BufferGeometry, disc: CanvasTexture, size: number, color: string, order: number): Points {
  const dots = new Points(geometry, new PointsMaterial({ size, color, sizeAttenuation: false, map: disc, alphaTest: 0.3, depthTest: false, transparent: true }));
  dots.frustumCulled = false;
  dots.renderOrder = order;
  return dots;
}

/** Removes objects from the scene and frees their graphics memory. */
export function discard(scene: Object3D, things: ((Object3D & { geometry: BufferGeometry }) | null)[]): void {
  for (const thing of things) {
    if (!thing) continue;
    scene.remove(thing);
    thing.geometry.dispose();
  }
}

const mostThickLines = 4000; // thick lines are triangles

interface Strokes {
  ends: Float32Array; // six numbers per line
  color: string;
  width: number;
  what: string; // in the legend
}

export class LineLayer {
  readonly lines: (LineSegments2 | LineSegments)[] = [];
  private readonly dots: Points[] = [];
  private shown = true;
  keys = new Map<string, string>(); // what is drawn, with its colour

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

  /** Replaces the content: strokes, later ones on top, and dots. */
  set(strokes: Strokes[], dots: { at: Float32Array; color: string; what: string } | null = null): void {
    this.keys = new Map([...strokes.filter((s) => s.ends.length > 0), ...(dots && dots.at.length > 0 ? [dots] : [])].map((s) => [s.what, s.color]));
    discard(this.scene, this.lines.splice(0));
    discard(this.scene, this.dots.splice(0));
    for (const { ends, color, width } of strokes) {
      if (ends.length === 0) continue;
      const l = ends.length > 6 * mostThickLines ? thinLines(ends, color) : this.thick(ends, color, width);
      l.visible = this.shown;
      this.lines.push(l);
      this.scene.add(l);
    }
    if (dots && dots.at.length > 0) {
      this.dots.push(dotsOver(new BufferGeometry().setAttribute("position", new BufferAttribute(dots.at, 3)), this.disc, 10, dots.color, 7));
      this.scene.add(...this.dots);
    }
    this.changed();
  }
}
