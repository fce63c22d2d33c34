// Prepares drawing while the model is decoded: context and shader programs of the first picture, which take longer to compile
// than the picture to draw.
import { BufferAttribute, BufferGeometry, DirectionalLight, HemisphereLight, PerspectiveCamera, Points, Scene, Sphere, Vector3, WebGLRenderer } from "three";
import { shapesOf } from "../decode/model";
import type { Mesh, MeshPart } from "../data";
import { Parts3D } from "./parts3d";
import { discTexture, dotMaterial } from "./shapes";

/** True without a graphics processor: antialiasing would take most of the time. */
export function drawsInSoftware(): boolean {
  // Most browsers refuse slow contexts; others reveal it by name.
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return true;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** Throws without WebGL. */
export function machineFor(software: boolean): WebGLRenderer {
  const made = new WebGLRenderer({ antialias: !software, stencil: true, preserveDrawingBuffer: false, powerPreference: "high-performance" });
  made.localClippingEnabled = true;
  made.info.autoReset = false; // a picture may have several slices
  return made;
}

/** A triangle, and a line. */
const sample: MeshPart = {
  part: -1,
  node: Uint32Array.from([0, 1, 2]),
  position: Float32Array.from([-1, -1, 0, 1, -1, 0, 0, 1, 0]),
  groups: [
    { kind: 1, corners: 3, count: 1, vertex: Uint32Array.from([0, 1, 2]), element: Float64Array.from([1]) },
    { kind: 6, corners: 2, count: 1, vertex: Uint32Array.from([0, 1]), element: Float64Array.from([2]) },
  ],
};

/** As machineFor(), with programs for solid, transparent, line and dot; null without WebGL. */
export function readyToDraw(software: boolean): WebGLRenderer | null {
  try {
    const machine = machineFor(software);
    const mesh: Mesh = { nodeId: new Float64Array(3), parts: [sample], low: [-1, -1, 0], high: [1, 1, 0] };
    const parts = new Parts3D(mesh, shapesOf(mesh, false));
    const dots = new Points(new BufferGeometry().setAttribute("position", new BufferAttribute(sample.position, 3)).setAttribute("color", new BufferAttribute(new Float32Array(9), 3)), dotMaterial(discTexture()));
    const scene = new Scene().add(parts.group, dots, new HemisphereLight(), new DirectionalLight());
    const camera = new PerspectiveCamera();
    camera.position.z = 4;
    for (const look of ["solid", "ghost"] as const) {
      parts.setLook(parts.parts[0], look);
      parts.show(false, software, () => 1, (s: Sphere) => s.radius > 0, new Vector3());
      machine.render(scene, camera);
    }
    return machine;
  } catch {
    return null;
  }
}
