// Shapes that the 3D view draws many times: the arrow of a force or depth, the dot of a node.
import { BufferGeometry, CanvasTexture, ConeGeometry, CylinderGeometry } from "three";
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
