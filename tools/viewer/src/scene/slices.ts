// Draws a picture in slices, for machines without graphics processor: a few triangles per frame beside the canvas, shown when
// complete. Until then the canvas keeps its picture.
import {
  type BufferGeometry, Matrix4, type Camera, type LineSegments, type Material, type Mesh, type Object3D, type Points, type Scene, SRGBColorSpace, Vector3,
  Vector4, type WebGLRenderer, WebGLRenderTarget,
} from "three";

/** An object, or vertices [first, end) of it. */
interface Piece {
  object: Mesh | LineSegments | Points;
  first: number;
  end: number;
}
type Drawn = Piece["object"] & { geometry: BufferGeometry & { isInstancedBufferGeometry?: boolean }; material: Material; isInstancedMesh?: boolean };

const wanted = 38; // ms of a slice
const elsewhere = 2; // layer mask of objects outside the slice

export class Slices {
  /** Triangles per slice; adapts to the machine. */
  private room = 12000;
  private target: WebGLRenderTarget | null = null;
  private left: Piece[] = [];
  private begun = false;
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly scene: Scene,
  ) {}
  /** A picture is being drawn. */
  get drawing(): boolean { return this.left.length > 0; }
  stop(): void { this.left = []; }
  /** Begins a picture of the visible objects; false if it is small enough for one frame. */
  start(camera: Camera): boolean {
    this.left = this.pieces(camera);
    const all = this.left.reduce((n, p) => n + this.cost(p), 0);
    if (all <= this.room) this.left = [];
    this.begun = false;
    return this.drawing;
  }
  /** Draws the next slice, `width` by `height` pixels, `ratio` of them per page pixel. */
  next(camera: Camera, width: number, height: number, ratio: number): void {
    const start = performance.now();
    const { renderer, scene } = this;
    const slice: Piece[] = [];
    let cost = 0;
    while (this.left.length > 0 && cost < this.room) {
      const piece = this.left[0];
      const whole = this.cost(piece);
      const fits = this.unit(piece) * Math.ceil((piece.end - piece.first) * ((this.room - cost) / whole) / this.unit(piece));
      if (piece.first + fits < piece.end) {
        // Two ranges of one object need two slices.
        slice.push({ ...piece, end: piece.first + fits });
        this.left[0] = { ...piece, first: piece.first + fits };
        cost = this.room;
        break;
      }
      slice.push(piece);
      this.left.shift();
      cost += whole;
    }
    if (this.target?.width !== width || this.target.height !== height) {
      this.target?.dispose();
      this.target = new WebGLRenderTarget(width, height, { stencilBuffer: true, generateMipmaps: false });
      // As the canvas: sRGB, not linear.
      (this.target as { isXRRenderTarget?: boolean }).isXRRenderTarget = true;
      this.target.texture.colorSpace = SRGBColorSpace;
      this.target.texture.internalFormat = "RGBA8"; // and blended likewise
    }
    const now = renderer.getPixelRatio();
    const ground = scene.background;
    const shown = new Map(slice.map((p) => [p.object, p]));
    const others: Object3D[] = [];
    scene.traverse((o) => {
      if (!isDrawn(o) || shown.has(o)) return;
      o.layers.mask = elsewhere;
      others.push(o);
    });
    const ranges = slice.map(({ object: { geometry } }) => ({ geometry, ...geometry.drawRange }));
    for (const { object, first, end } of slice) object.geometry.setDrawRange(first, end - first);
    this.scale(ratio);
    renderer.setRenderTarget(this.target);
    if (this.begun) {
      scene.background = null; // it would clear the picture
      renderer.autoClear = false;
    }
    try {
      renderer.render(scene, camera);
      const gl = renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for completion
    } finally {
      this.begun = true;
      renderer.autoClear = true;
      scene.background = ground;
      renderer.setRenderTarget(null);
      this.scale(now);
      for (const o of others) o.layers.mask = 1;
      for (const r of ranges) r.geometry.setDrawRange(r.start, r.count);
    }
    const took = performance.now() - start;
    const factor = Math.min(Math.max(wanted / Math.max(took, 1), 0.3), 1.5);
    this.room = Math.min(Math.max(cost * factor, 2000), 200000);
  }
  /** Copies the picture to the canvas of its size. */
  show(): void {
    const { renderer } = this;
    const gl = renderer.getContext() as WebGL2RenderingContext;
    const { width, height } = this.target!;
    const from = (renderer.properties.get(this.target!) as { __webglFramebuffer: WebGLFramebuffer }).__webglFramebuffer;
    renderer.setRenderTarget(null);
    renderer.state.bindFramebuffer(gl.READ_FRAMEBUFFER, from);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    renderer.state.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
  }
  /** Dot sizes follow the ratio; resizing the canvas would lose its picture. */
  private scale(ratio: number): void {
    const { renderer } = this;
    const resize = renderer.setSize;
    renderer.setSize = () => {};
    renderer.setPixelRatio(ratio);
    renderer.setSize = resize;
  }
  private unit({ object }: Piece): number { return "isMesh" in object ? 3 : "isLine" in object ? 2 : 1; }
  /** Approximate number of triangles. */
  private cost(piece: Piece): number {
    const { object } = piece;
    const { geometry } = object as Drawn;
    const copies = (object as { count?: number }).count ?? (geometry as { instanceCount?: number }).instanceCount ?? 1;
    return 40 + ((piece.end - piece.first) / this.unit(piece)) * (Number.isFinite(copies) ? copies : 1);
  }
  /** Visible objects in drawing order: solid ones by material from near to far, then transparent ones from far to near. */
  private pieces(camera: Camera): Piece[] {
    const project = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const items: { piece: Piece; object: Drawn; z: number }[] = [];
    const at = new Vector4();
    this.scene.traverseVisible((o) => {
      if (!isDrawn(o)) return;
      const object = o as Drawn;
      const { geometry } = object;
      const { start, count } = geometry.drawRange;
      const all = geometry.index?.count ?? geometry.getAttribute("position").count;
      const end = Math.min(start + count, all);
      if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
      const { x, y, z } = geometry.boundingSphere?.center ?? new Vector3();
      at.set(x, y, z, 1).applyMatrix4(object.matrixWorld).applyMatrix4(project);
      if (end > start) items.push({ piece: { object, first: start, end }, object, z: at.z });
    });
    const order = (through: boolean) =>
      items.filter((i) => i.object.material.transparent === through).sort((a, b) =>
        a.object.renderOrder - b.object.renderOrder || (through ? 0 : a.object.material.id - b.object.material.id) || (through ? b.z - a.z : a.z - b.z) || a.object.id - b.object.id);
    return [...order(false), ...order(true)].map((i) => i.piece);
  }
}

const isDrawn = (o: Object3D): o is Drawn => "isMesh" in o || "isLine" in o || "isPoints" in o;
