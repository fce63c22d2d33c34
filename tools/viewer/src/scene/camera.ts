// Camera and controls: rotation about the point under the cursor, pan, zoom to the cursor, short flights. Runs on events only;
// requests a frame after each change.
import { PerspectiveCamera, Quaternion, type Ray, Vector3 } from "three";

// Meaning of the mouse buttons: own scheme, or those of common pre-processors.
type Motion = "turn" | "move" | "zoom";
export type MouseScheme = "page" | "control" | "shift";

/** Names and descriptions, for the list of keys. */
export const mouseSchemes: Record<MouseScheme, { name: string; says: string }> = {
  page: { name: "this page", says: "left: turn · shift and left, middle, right: move" },
  control: { name: "HyperMesh (Ctrl)", says: "Ctrl and left: turn · Ctrl and middle: zoom · Ctrl and right: move; without Ctrl as this page" },
  shift: { name: "LS-PrePost (Shift)", says: "Shift and left: turn · Shift and middle: move · Shift and right: zoom; without Shift as this page" },
};

function motionOf(scheme: MouseScheme, e: { button: number; ctrlKey: boolean; shiftKey: boolean }): Motion {
  if (scheme === "control" && e.ctrlKey) return (["turn", "zoom", "move"] as const)[e.button] ?? "turn";
  if (scheme === "shift" && e.shiftKey) return (["turn", "move", "zoom"] as const)[e.button] ?? "turn";
  return e.button === 1 || e.button === 2 || e.shiftKey ? "move" : "turn";
}

export class CameraControl {
  readonly camera = new PerspectiveCamera(28, 1, 0.1, 1000);
  readonly target = new Vector3();
  distance = 10;
  /** Sphere around everything, for clipping planes and limits. */
  readonly center = new Vector3();
  radius = 1;
  /** Nothing nearer to the camera than `length` in front of the point is drawn. */
  cut: { point: Vector3; length: number } | null = null;
  private flight: { start: number; from: Pose; to: Pose } | null = null;
  /** Parallel projection. */
  parallel = false;
  mouse: MouseScheme = "page";
  private drag: { id: number; x: number; y: number; motion: Motion; moved: number } | null = null;
  private pinch = new Map<number, { x: number; y: number }>();
  constructor(
    private readonly element: HTMLElement,
    private readonly request: () => void,
    private readonly pointAt: (x: number, y: number) => Vector3 | null,
    private readonly click: (x: number, y: number, e: PointerEvent) => void,
  ) {
    element.addEventListener("pointerdown", (e) => this.down(e));
    element.addEventListener("pointermove", (e) => this.move(e));
    element.addEventListener("pointerup", (e) => this.up(e));
    element.addEventListener("pointercancel", (e) => this.up(e));
    element.addEventListener("wheel", (e) => this.wheel(e), { passive: false });
    element.addEventListener("contextmenu", (e) => e.preventDefault());
  }
  get flying(): boolean { return this.flight !== null; }
  get dragging(): boolean { return this.drag !== null; }
  /** Places the camera; called before each frame. True during a flight. */
  update(now: number): boolean {
    if (this.flight) {
      const t = Math.min(1, (now - this.flight.start) / 420);
      const e = t < 0.5 ? 4 * t * t * t : 1 - (-2 * t + 2) ** 3 / 2;
      const { from, to } = this.flight;
      this.target.lerpVectors(from.target, to.target, e);
      this.distance = from.distance * (to.distance / from.distance) ** e;
      this.camera.quaternion.slerpQuaternions(from.turn, to.turn, e);
      if (t >= 1) this.flight = null;
    }
    const back = new Vector3(0, 0, 1).applyQuaternion(this.camera.quaternion);
    this.camera.position.copy(this.target).addScaledVector(back, this.distance);
    const depth = this.camera.position.distanceTo(this.center);
    this.camera.near = Math.max((depth - this.radius) * 0.9, this.distance / 200, this.radius * 1e-6);
    if (this.cut) {
      const to = this.cut.point.clone().sub(this.camera.position).dot(back) * -1;
      // Only near the point: further out everything is drawn.
      if (this.distance < this.cut.length * 30 + this.radius * 0.05)
        this.camera.near = Math.max(this.camera.near, to - this.cut.length);
    }
    this.camera.far = Math.max(depth + this.radius * 1.1, this.camera.near * 2);
    this.camera.updateProjectionMatrix();
    if (this.parallel) {
      // Objects keep their size at the target; the range includes points behind the camera.
      const up = this.distance * Math.tan((this.camera.fov * Math.PI) / 360);
      const near = this.cut && this.camera.near > (depth - this.radius) * 0.9 + 1e-12 && this.distance < this.cut.length * 30 + this.radius * 0.05 ? this.camera.near : depth - this.radius * 1.1 - this.distance;
      const aside = up * this.camera.aspect;
      this.camera.projectionMatrix.makeOrthographic(-aside, aside, up, -up, near, this.camera.far);
      this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    }
    this.camera.updateMatrixWorld();
    return this.flight !== null;
  }
  /** Flies to a sphere; looks along -`direction` (which points from the centre to the camera). */
  fly(center: Vector3, radius: number, direction?: Vector3, up?: Vector3, jump = false): void {
    const to: Pose = {
      target: center.clone(),
      distance: radius / Math.sin((this.camera.fov * Math.PI) / 360) / Math.min(1, this.camera.aspect),
      turn: direction ? lookFrom(direction, up ?? new Vector3(0, 0, 1)) : this.camera.quaternion.clone(),
    };
    if (jump || matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.target.copy(to.target);
      this.distance = to.distance;
      this.camera.quaternion.copy(to.turn);
      this.flight = null;
    } else {
      const from = { target: this.target.clone(), distance: this.distance, turn: this.camera.quaternion.clone() };
      this.flight = { start: performance.now(), from, to };
    }
    this.request();
  }
  /** Position of the camera as text; during a flight its end. */
  get pose(): string {
    const { target, distance, turn } = this.flight?.to ?? { target: this.target, distance: this.distance, turn: this.camera.quaternion };
    return [...target.toArray(), distance, ...turn.toArray()].map((v) => Number(v.toPrecision(6))).join(",");
  }
  set pose(text: string) {
    const v = text.split(",").map(Number);
    if (v.length !== 8 || !v.every(Number.isFinite) || !(v[3] > 0)) return;
    this.target.fromArray(v);
    this.distance = v[3];
    this.camera.quaternion.fromArray(v, 4).normalize();
    this.flight = null;
    this.request();
  }
  /** World length of one pixel at a point. */
  pixel(at: Vector3): number {
    const depth = this.parallel ? this.distance : at.clone().sub(this.camera.position).dot(new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion));
    return (2 * depth * Math.tan((this.camera.fov * Math.PI) / 360)) / this.element.clientHeight;
  }
  /** Ray through a point of the picture, -1 to 1 each way. */
  aim(ray: Ray, x: number, y: number): void {
    const far = new Vector3(x, y, 1).unproject(this.camera);
    ray.origin.copy(this.parallel ? new Vector3(x, y, -1).unproject(this.camera) : this.camera.position);
    ray.direction.copy(far).sub(ray.origin).normalize();
  }
  rotate(dx: number, dy: number): void {
    const s = (2.2 * Math.PI) / this.element.clientHeight;
    const q = this.camera.quaternion;
    const turn = new Quaternion()
      .setFromAxisAngle(new Vector3(0, 1, 0).applyQuaternion(q), -dx * s)
      .multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0).applyQuaternion(q), -dy * s));
    q.premultiply(turn).normalize();
    this.flight = null;
    this.request();
  }
  zoom(factor: number, toward: Vector3 | null): void {
    const d = Math.min(Math.max(this.distance * factor, this.radius * 1e-5), this.radius * 40);
    if (toward) this.target.lerp(toward, 1 - d / this.distance);
    this.distance = d;
    this.flight = null;
    this.request();
  }
  private pan(dx: number, dy: number): void {
    const s = this.pixel(this.target);
    const q = this.camera.quaternion;
    this.target.addScaledVector(new Vector3(1, 0, 0).applyQuaternion(q), -dx * s);
    this.target.addScaledVector(new Vector3(0, 1, 0).applyQuaternion(q), dy * s);
    this.flight = null;
    this.request();
  }
  /** Point under the cursor in the plane through the target. */
  private onTargetPlane(x: number, y: number): Vector3 {
    const r = this.element.getBoundingClientRect();
    const s = this.pixel(this.target);
    const q = this.camera.quaternion;
    return this.target
      .clone()
      .addScaledVector(new Vector3(1, 0, 0).applyQuaternion(q), (x - r.left - r.width / 2) * s)
      .addScaledVector(new Vector3(0, 1, 0).applyQuaternion(q), -(y - r.top - r.height / 2) * s);
  }
  private down(e: PointerEvent): void {
    this.element.setPointerCapture(e.pointerId);
    this.pinch.set(e.pointerId, { x: e.clientX, y: e.clientY });
    this.drag = { id: e.pointerId, x: e.clientX, y: e.clientY, motion: motionOf(this.mouse, e), moved: 0 };
    this.flight = null;
  }
  private move(e: PointerEvent): void {
    const before = this.pinch.get(e.pointerId);
    if (!before || !this.drag) return;
    const dx = e.clientX - before.x;
    const dy = e.clientY - before.y;
    if (this.pinch.size === 2) {
      const other = [...this.pinch].find(([id]) => id !== e.pointerId)![1];
      const was = Math.hypot(before.x - other.x, before.y - other.y);
      const is = Math.hypot(e.clientX - other.x, e.clientY - other.y);
      if (was > 0 && is > 0) this.zoom(was / is, null);
      this.pan(dx / 2, dy / 2);
    } else if (e.pointerId === this.drag.id) {
      // Rotation is about the point under the cursor at the start of the drag.
      const { motion, moved } = this.drag;
      const far = moved + Math.hypot(dx, dy) >= 4;
      if (moved < 4 && far && motion === "turn") this.pivot();
      if (far) motion === "move" ? this.pan(dx, dy) : motion === "zoom" ? this.zoom(Math.exp(dy * 0.006), null) : this.rotate(dx, dy);
    }
    this.drag.moved += Math.hypot(dx, dy);
    before.x = e.clientX;
    before.y = e.clientY;
  }
  private pivot(): void {
    const p = this.pointAt(this.drag!.x, this.drag!.y);
    if (!p) return;
    // Keeps the view: only the depth of the target changes.
    const forward = new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion);
    const depth = p.sub(this.camera.position).dot(forward);
    if (depth > 0) {
      this.target.copy(this.camera.position).addScaledVector(forward, depth);
      this.distance = depth;
    }
  }
  private up(e: PointerEvent): void {
    this.pinch.delete(e.pointerId);
    const drag = this.drag;
    if (!drag || drag.id !== e.pointerId) return;
    this.drag = null;
    if (drag.moved < 4 && e.type === "pointerup" && (e.button === 0 || e.button === 2)) this.click(e.clientX, e.clientY, e);
    this.request();
  }
  private wheel(e: WheelEvent): void {
    e.preventDefault();
    const step = e.deltaMode === 1 ? 30 : e.deltaMode === 2 ? 300 : 1;
    this.zoom(Math.exp(Math.min(Math.max(e.deltaY * step * 0.0012, -0.5), 0.5)), this.onTargetPlane(e.clientX, e.clientY));
  }
}

interface Pose {
  target: Vector3;
  distance: number;
  turn: Quaternion;
}

/** Orientation of a camera in `direction` from its target. */
export function lookFrom(direction: Vector3, up: Vector3): Quaternion {
  const z = direction.clone().normalize();
  let u = up.clone();
  if (Math.abs(u.clone().normalize().dot(z)) > 0.98) u = Math.abs(z.y) < 0.9 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
  const x = new Vector3().crossVectors(u, z).normalize();
  const y = new Vector3().crossVectors(z, x);
  const helper = new PerspectiveCamera();
  helper.matrix.makeBasis(x, y, z);
  return new Quaternion().setFromRotationMatrix(helper.matrix);
}

/** Directions that show the normal from the side, 25 degrees above the surface. */
export function directions(n: Vector3): Vector3[] {
  const other = Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  const t = new Vector3().crossVectors(n, other).normalize();
  const u = new Vector3().crossVectors(t, n).normalize();
  return Array.from({ length: 8 }, (_, i) => {
    const a = ((i * 45 - 20) * Math.PI) / 180;
    return t.clone().multiplyScalar(0.9 * Math.cos(a)).addScaledVector(u, 0.9 * Math.sin(a)).addScaledVector(n, 0.45).normalize();
  });
}
