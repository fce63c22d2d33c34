// The 3D view: parts, markers of penetrating nodes, selected pair, picking. Draws on demand only.
import { CanvasTexture, Color, DirectionalLight, Frustum, HemisphereLight, Matrix4, Mesh, Raycaster, Scene, Sphere, Vector3, type WebGLRenderer } from "three";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { CameraControl, directions } from "./camera";
import { exactAt, pointOf, wayOut } from "./drawn";
import { Parts3D, type Look, type Part3D } from "./parts3d";
import { Section, type Cut } from "./section";
import { Marked } from "./marks/marked";
import { Slices } from "./slices";
import type { TieStrokes } from "../tied";
import { Markers, type Arrow } from "./marks/markers";
import { discTexture, LineLayer } from "./shapes";
import type { Shape } from "../decode/model";
import type { Hit, Report } from "../report";

export interface Picked {
  hit: Hit | null;
  part: Part3D | null;
  item: number; // element of the part; -1: none
  /** Corner nearest to the cursor, as page node; -1: none. */
  node: number;
}

export class View3D {
  readonly parts: Parts3D;
  readonly control: CameraControl;
  readonly canvas: HTMLCanvasElement;
  onPick: (p: Picked) => void = () => {};
  onMenu: (p: Picked, x: number, y: number) => void = () => {};
  onFrame: () => void = () => {};
  /** Called when drawing is complete and nothing moves. */
  onRest: () => void = () => {};
  frames = 0;
  private readonly slices: Slices;
  private readonly scene = new Scene();
  private readonly head = new DirectionalLight("#ffffff", 1.7);
  private readonly sky = new HemisphereLight("#ffffff", "#aab4c0", 1.7);
  private pending = false;
  readonly markers: Markers;
  private readonly marked: Marked;
  private readonly disc: CanvasTexture;
  readonly section: Section;
  dark = false;
  private readonly partOf = new Map<number, Part3D>();

  constructor(
    private readonly report: Report,
    shapes: Shape[],
    readonly software: boolean,
    private readonly renderer: WebGLRenderer,
    private readonly container: HTMLElement,
  ) {
    this.slices = new Slices(this.renderer, this.scene);
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("aria-label", "3D view of the model. Keys: see the list of shortcuts");
    container.prepend(this.canvas);
    this.disc = discTexture();
    this.markers = new Markers(report, this.scene, this.disc, software);
    this.marked = new Marked(report, this.scene, this.disc, container);
    this.crossed = new LineLayer(this.scene, this.marked.lines, this.disc, () => this.request());
    this.ties = new LineLayer(this.scene, this.marked.lines, this.disc, () => this.request());
    this.moved = new LineLayer(this.scene, this.marked.lines, this.disc, () => this.request());
    this.parts = new Parts3D(report.mesh, shapes);
    for (const p of this.parts.parts) this.partOf.set(p.data.part, p);
    this.section = new Section(this.parts);
    this.scene.add(this.parts.group, this.section.group, this.sky);
    this.control = new CameraControl(
      this.canvas,
      () => this.request(),
      (x, y) => this.surface(x, y)?.point ?? null,
      (x, y, e) => (e.button === 2 ? this.onMenu(this.pick(x, y), x, y) : this.onPick(this.pick(x, y))),
    );
    this.scene.add(this.control.camera);
    this.control.camera.add(this.head);
    this.head.position.set(0.3, 0.5, 1);
    const all = this.parts.bounds(() => true) ?? new Sphere(new Vector3(), 1);
    this.control.center.copy(all.center);
    this.control.radius = all.radius;
    for (const p of this.parts.parts) this.parts.setLook(p, "hidden"); // until the first view is chosen
    this.resize();
    this.control.fly(all.center, all.radius, new Vector3(-1, -1.4, 0.8), undefined, true);
    new ResizeObserver(() => this.resize()).observe(container);
  }

  /** Requests a frame after a change. */
  request(): void { this.slices.stop(); this.goOn(); }
  private goOn(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => { this.pending = false; this.draw(now); });
  }

  /** Drawn in full, no flight. */
  get resting(): boolean { return !this.pending && this.finish === 0 && !this.control.flying && !this.slices.drawing; }
  private lastDraw = 0;
  private slow = 0;
  private coarse = false;
  /** Slow machines draw fewer pixels and triangles and no lines while the view moves. */
  setCoarse(on: boolean): void {
    if (this.coarse === on && !this.slices.drawing) return;
    this.slices.stop();
    this.setDetail(on);
    this.size();
  }
  private setDetail(coarse: boolean): void {
    this.coarse = coarse;
    for (const l of [this.crossed, this.ties, this.moved]) l.visible = !coarse;
    this.markers.setDetail(coarse);
  }

  /** Draws the first picture at once; on a slow machine as in motion. */
  drawFirst(): void {
    if (this.software) this.setCoarse(true);
    this.markers.scaleArrows(this.control);
    this.render();
    this.frames++;
    this.onFrame();
    this.seen.copy(this.control.camera.matrixWorld);
    if (this.coarse) this.finish = -1;
    this.skip = this.pending;
  }
  /** Allows the picture at rest. */
  afterFirst(): void { if (this.finish < 0) this.later(); }

  /** Timer of the full picture; 0: none, -1: waits for the page. */
  private finish = 0;
  private due = false;
  private skip = false;
  private readonly seen = new Matrix4();
  /** Schedules the full picture after a movement. */
  private later(): void {
    clearTimeout(this.finish);
    this.due = false;
    this.finish = window.setTimeout(() => {
      this.finish = 0;
      this.due = true;
      this.request();
    }, 150);
  }

  /** Slow machines redraw after changes have stopped. */
  drawLater(): void { if (this.software) this.later(); }

  private readonly frustum = new Frustum();
  private render(): void { this.choose(); this.renderer.render(this.scene, this.control.camera); }
  private choose(): void {
    const { camera } = this.control;
    this.renderer.info.reset();
    this.frustum.setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    this.parts.show(this.coarse, this.software, (at) => this.control.pixel(at), (s) => this.frustum.intersectsSphere(s), this.control.target);
  }

  /** Draws the next slice of the picture at rest; false if it is drawn at once. */
  private slice(): boolean {
    const { camera } = this.control;
    if (!this.slices.drawing) {
      const coarse = this.coarse;
      this.setDetail(false);
      this.markers.scaleArrows(this.control);
      this.choose();
      if (!this.slices.start(camera)) { if (coarse) this.size(); return false; }
    }
    const ratio = Math.min(window.devicePixelRatio, 2);
    this.slices.next(camera, Math.floor(this.container.clientWidth * ratio), Math.floor(this.container.clientHeight * ratio), ratio);
    if (!this.slices.drawing) { this.size(); this.slices.show(); }
    return true;
  }

  private draw(now: number): void {
    if (this.skip) {
      this.skip = false; // the first picture was this one
      return;
    }
    const again = this.control.update(now);
    const { matrixWorld } = this.control.camera;
    const moving = again || !this.seen.equals(matrixWorld);
    this.seen.copy(matrixWorld);
    const took = now - this.lastDraw;
    this.lastDraw = now;
    if (moving) {
      // One long frame may be accidental, three in a row are not.
      if (took < 1000) this.slow = took > 80 ? this.slow + 1 : 0;
      if (this.software || this.slow >= 3) this.setCoarse(true);
      if (this.coarse) this.later();
    } else if (this.due || this.finish === 0) {
      if (!this.control.dragging) this.slow = 0;
      this.due = false;
      if (this.software) {
        const sliced = this.slice();
        if (this.slices.drawing) return this.goOn();
        if (sliced) return this.drawnAt(again);
      } else this.setCoarse(false);
    } else if (this.software && !this.coarse) return; // the picture at rest stays until it is due
    this.markers.scaleArrows(this.control);
    this.render();
    this.drawnAt(again);
  }
  private drawnAt(again: boolean): void {
    this.frames++;
    this.onFrame();
    if (again) this.request();
    else this.onRest();
  }

  /** Of the last picture. */
  get drawCalls(): number { return this.renderer.info.render.calls; }
  get drawnTriangles(): number { return this.renderer.info.render.triangles; }

  /** Renders the view, enlarged by `scale`, for `use`; `ground`: background colour. */
  pictured<T>(scale: number, ground: string | null, use: (canvas: HTMLCanvasElement) => T): T {
    this.setCoarse(false);
    const { clientWidth: w, clientHeight: h } = this.container;
    const ratio = this.renderer.getPixelRatio();
    const own = this.scene.background;
    this.renderer.setPixelRatio(ratio * scale);
    this.renderer.setSize(w, h, false);
    if (ground !== null) this.scene.background = new Color(ground);
    this.control.update(performance.now());
    this.render();
    const out = use(this.canvas);
    this.scene.background = own;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
    this.request();
    return out;
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.container;
    const key = `${w}x${h}@${window.devicePixelRatio}`;
    if (w === 0 || h === 0 || key === this.sized) return;
    this.sized = key;
    this.slices.stop();
    this.size();
    this.control.camera.aspect = w / h;
    for (const s of [...this.marked.selection, ...this.crossed.lines, ...this.ties.lines, ...this.moved.lines]) if (s instanceof LineSegments2) s.material.resolution.set(w, h);
    if (this.frames === 0) return;
    this.control.update(performance.now());
    this.render();
    this.onFrame();
  }
  private sized = "";
  /** Pixels of the picture. */
  private size(): void {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * (this.coarse ? 0.5 : 1));
    this.renderer.setSize(this.container.clientWidth, this.container.clientHeight, false);
  }

  setGround(dark: boolean, neutral: boolean, context: number): void {
    this.dark = dark;
    this.scene.background = new Color(dark ? "#151b23" : "#eef1f5");
    this.sky.intensity = dark ? 1.3 : 1.7;
    this.parts.setGround(dark, neutral, context);
    this.request();
  }

  // ---- what is shown ------------------------------------------------------------------------

  setLooks(look: (p: Part3D) => Look): void {
    for (const p of this.parts.parts) this.parts.setLook(p, look(p));
    this.request();
  }

  partByIndex(part: number): Part3D | undefined { return this.partOf.get(part); }

  /** Dots of rows; `colorOf` gives components of 0..255. Arrows show the way out of rows, or `instead`. */
  setHits(hits: Hit[], colorOf: (h: Hit) => [number, number, number], instead: Arrow[] | null = null): void {
    this.markers.set(hits, colorOf, instead);
    this.request();
  }
  setArrows(on: boolean): void { this.markers.setArrows(on); this.request(); }

  /** Lines over the picture: crossed elements, ties, moved nodes. */
  readonly crossed: LineLayer;
  readonly ties: LineLayer;
  readonly moved: LineLayer;

  /** Points of all visible tie lines. */
  fitPoints({ tied, lost, lostNodes }: TieStrokes): void {
    const points = [tied, lost, lostNodes].flatMap((x) => Array.from({ length: x.length / 3 }, (_, i) => new Vector3().fromArray(x, 3 * i)));
    if (points.length === 0) return this.fit();
    const s = new Sphere().setFromPoints(points);
    this.control.cut = null;
    this.control.fly(s.center, Math.max(s.radius * 1.3, 1e-9));
  }

  flyToPoints(points: Vector3[], center?: Vector3): void {
    const s = new Sphere().setFromPoints(points, center);
    this.control.cut = { point: s.center.clone(), length: s.radius * 3 };
    this.control.fly(s.center, Math.max(s.radius * (center ? 1.5 : 2.4), 1e-9));
  }

  setSelected(hit: Hit | null): void {
    if (!hit) this.control.cut = null;
    this.marked.select(hit, this.dark);
    this.request();
  }
  /** `outlines`: additional lines, six numbers each. */
  setRule(points: Vector3[], outlines: number[] = []): void {
    this.marked.measure(points, this.dark, outlines);
    this.request();
  }

  /** Sphere around the main side and the node of a row. */
  sphereOf(hit: Hit): Sphere {
    const nodes = [...this.report.mainNodes(hit.row), ...this.report.secondaryNodes(hit.row)];
    return new Sphere().setFromPoints(nodes.map((n) => exactAt(this.report, n)));
  }

  /** Flies to a row: obliquely from the node's proper side, in the clearest of several directions; cuts away the rest in between. */
  flyTo(hit: Hit): void {
    const point = pointOf(this.report, hit.row);
    const radius = Math.max(this.sphereOf(hit).radius * 2.6, 1e-9);
    const normal = this.normalOf(hit);
    let best = normal;
    let clear = -1;
    for (const side of hit.row.onSurface ? [1, -1] : [1])
      for (const d of directions(normal.clone().multiplyScalar(side))) {
        const free = this.clearance(point, d, radius);
        if (free > clear * 1.05 + 1e-9) { clear = free; best = d; }
      }
    this.control.fly(point, radius, best);
    this.control.cut = clear < 60 * radius ? { point, length: Math.max(clear * 0.98, radius * 0.4) } : null;
  }

  /** Way out of the main side, else the normal of the segment. */
  private normalOf(hit: Hit): Vector3 {
    const n = wayOut(this.report, hit.row);
    if (n.lengthSq() > 0) return n;
    const p = this.report.mainNodes(hit.row).map((k) => exactAt(this.report, k));
    if (p.length > 2) n.crossVectors(p[1].clone().sub(p[0]), p[p.length - 1].clone().sub(p[0]));
    return n.lengthSq() > 0 ? n.normalize() : new Vector3(0, 0, 1);
  }

  /** Free distance from a point, ignoring what touches it. */
  private clearance(point: Vector3, direction: Vector3, radius: number): number {
    const caster = new Raycaster(point.clone().addScaledVector(direction, radius * 0.3), direction);
    caster.firstHitOnly = true;
    const meshes = this.parts.pickable().filter((m) => caster.ray.intersectsSphere(m.geometry.boundingSphere!));
    for (const m of meshes) this.parts.prepare(m);
    const found = caster.intersectObjects(meshes, false)[0];
    return found ? found.distance + radius * 0.3 : Infinity;
  }

  fit(hits: Hit[] | null = null): void {
    this.control.cut = null;
    if (hits && hits.length > 0) {
      const s = new Sphere().setFromPoints(hits.map((x) => pointOf(this.report, x.row)));
      const grown = Math.max(s.radius, ...hits.slice(0, 1).map((x) => this.sphereOf(x).radius)) * 1.5;
      this.control.fly(s.center, grown);
      return;
    }
    const s = this.inView();
    if (s) this.control.fly(s.center, s.radius);
  }
  private inView = () => this.parts.bounds((p) => p.look === "solid") ?? this.parts.bounds(() => true);

  look(direction: Vector3, up: Vector3): void {
    this.control.cut = null;
    const s = this.inView();
    if (s) this.control.fly(s.center, s.radius, direction, up);
  }

  /** Middle of parts that are drawn, else of all. */
  middle(of: Iterable<Part3D> | null): Vector3 {
    const own = of && new Set(of);
    return (this.parts.bounds((p) => !own || own.has(p)) ?? this.control).center;
  }

  /** Cuts away what lies beyond each plane. */
  setSection(cuts: Cut[]): void {
    this.section.set(cuts, this.control.center, this.control.radius);
    this.markers.clip(this.section.planes);
    this.request();
  }

  clipThrough(point: Vector3, normal: Vector3): number {
    const n = normal.clone().normalize();
    return ((point.dot(n) - this.control.center.dot(n)) / this.control.radius + 1) / 2;
  }

  // ---- picking ------------------------------------------------------------------------------

  private ray(x: number, y: number): Raycaster {
    const r = this.canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.firstHitOnly = true;
    this.control.update(performance.now());
    this.control.aim(caster.ray, ((x - r.left) / r.width) * 2 - 1, 1 - ((y - r.top) / r.height) * 2);
    return caster;
  }

  private surface(x: number, y: number, ghosts = false) {
    const caster = this.ray(x, y);
    for (const plane of this.section.planes) {
      // Start behind the plane if the ray crosses it from the removed side.
      const t = caster.ray.distanceToPlane(plane);
      if (plane.distanceToPoint(caster.ray.origin) >= 0) continue;
      if (t === null) return null;
      caster.ray.origin.addScaledVector(caster.ray.direction, t + this.control.radius * 1e-6);
    }
    for (const all of [this.parts.pickable(), ghosts ? this.parts.pickableGhosts() : []]) {
      const meshes = all.filter((m) => caster.ray.intersectsSphere(m.geometry.boundingSphere!));
      for (const m of meshes) this.parts.prepare(m);
      const found = caster.intersectObjects(meshes, false)[0];
      if (found) return this.section.hides(found.point) ? null : found;
    }
    return null;
  }

  /** Object under the cursor: a penetrating node within a few pixels, else the surface. */
  pick(x: number, y: number): Picked {
    const r = this.canvas.getBoundingClientRect();
    const camera = this.control.camera;
    const surface = this.surface(x, y, true);
    const ghost = surface !== null && (surface.object as Mesh).renderOrder > 0;
    const depthLimit = surface && !ghost ? surface.point.clone().project(camera).z : 1;
    let best: Hit | null = null;
    let near = 13;
    const v = new Vector3();
    for (const hit of this.markers.hits) {
      v.copy(pointOf(this.report, hit.row));
      const shown = !this.section.hides(v);
      const world = v.clone();
      v.project(camera);
      if (!shown || v.z < -1 || v.z > 1) continue;
      const d = Math.hypot(r.left + ((v.x + 1) / 2) * r.width - x, r.top + ((1 - v.y) / 2) * r.height - y);
      // Dots behind a surface count only very close to it.
      const hidden = v.z > depthLimit && surface !== null && world.distanceTo(surface.point) > 14 * this.control.pixel(surface.point);
      if (d < near && !hidden) { near = d; best = hit; }
    }
    if (!surface) return { hit: best, part: null, item: -1, node: -1 };
    const { part, triangleElement } = surface.object.userData as { part: Part3D; triangleElement: Uint32Array };
    const corners = [surface.face!.a, surface.face!.b, surface.face!.c];
    const at = (i: number) => new Vector3().fromArray(part.data.position, 3 * i).distanceTo(surface.point);
    const nearest = corners.reduce((a, b) => (at(b) < at(a) ? b : a));
    if (!best && !ghost) {
      // Corners of the face may be penetrating nodes of the list.
      const nodes = new Set(corners.map((i) => part.data.node[i]));
      best = this.markers.hits.find((x) => this.report.secondaryNodes(x.row).some((n) => nodes.has(n))) ?? null;
    }
    return { hit: best, part, item: triangleElement[surface.faceIndex!], node: part.data.node[nearest] };
  }

  /** Page position of a point; null behind the camera. */
  place(at: Vector3): { x: number; y: number } | null {
    const v = at.clone().project(this.control.camera);
    if (v.z < -1 || v.z > 1) return null;
    const r = this.canvas.getBoundingClientRect();
    return { x: r.left + ((v.x + 1) / 2) * r.width, y: r.top + ((1 - v.y) / 2) * r.height };
  }

  /** Page position of a row's point; null behind the camera. */
  screen(hit: Hit): { x: number; y: number } | null {
    this.control.update(performance.now());
    return this.place(pointOf(this.report, hit.row));
  }
}
