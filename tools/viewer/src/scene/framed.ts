// Axes of the deck in the orientation of the view; and a self-explaining picture with title, axes and legend.
import { Vector3, type Quaternion } from "three";
import { replace, svg } from "../dom";

interface Frame {
  title: string; // the deck
  about: string; // interface and meaning of the colours
  white: boolean; // dark ink on light ground
  scale: number; // pixels of the canvas per pixel of the page
  turned: Quaternion; // of the camera
  legend: { title: string; tick: (t: number) => string; color: (t: number) => [number, number, number] } | null;
}

const axisColours = [["X", "#c0392b", 1, 0, 0], ["Y", "#2e8b57", 0, 1, 0], ["Z", "#2f6fde", 0, 0, 1]] as const;

/** Rear ones first. */
function axesOf(turned: Quaternion) {
  const back = turned.clone().invert();
  const all = axisColours.map(([name, colour, ...along]) => ({ name, colour, v: new Vector3(...along).applyQuaternion(back) }));
  return all.sort((a, b) => a.v.z - b.v.z);
}

/** Draws the axes in the corner of the view. */
export function showAxes(element: SVGElement, turned: Quaternion): void {
  replace(element, ...axesOf(turned).flatMap(({ name, colour, v }) => [
    svg("line", { x1: 0, y1: 0, x2: 18 * v.x, y2: -18 * v.y, stroke: colour, "stroke-width": 2, "stroke-linecap": "round" }),
    svg("text", { x: 25 * v.x, y: -25 * v.y + 3, fill: colour }, name)]));
}

function drawAxes(g: CanvasRenderingContext2D, x: number, y: number, turned: Quaternion): void {
  g.lineWidth = 2.5;
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.font = "bold 12px system-ui, sans-serif";
  for (const { name, colour, v } of axesOf(turned)) {
    g.strokeStyle = g.fillStyle = colour;
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(x + 24 * v.x, y - 24 * v.y);
    g.stroke();
    g.fillText(name, x + 33 * v.x, y - 33 * v.y);
  }
}

function drawLegend(g: CanvasRenderingContext2D, legend: NonNullable<Frame["legend"]>, left: number, top: number, width: number): void {
  g.textAlign = "left";
  g.font = "bold 13px system-ui, sans-serif";
  g.fillText(legend.title, left, top + 13);
  for (let i = 0; i < width; i++) {
    g.fillStyle = `rgb(${legend.color(Math.min((i + 0.5) / width, 0.9999)).join(" ")})`;
    g.fillRect(left + i, top + 20, 1.5, 14);
  }
}

/** Canvas with picture, title, axes and legend. */
export function framed(picture: HTMLCanvasElement, frame: Frame): HTMLCanvasElement {
  const k = frame.scale;
  const [head, foot] = [52, frame.legend ? 62 : 0];
  const out = document.createElement("canvas");
  out.width = picture.width;
  out.height = picture.height + Math.round((head + foot) * k);
  const [w, h] = [out.width / k, out.height / k];
  const g = out.getContext("2d")!;
  const ink = frame.white ? "#17202b" : "#e8edf3";
  g.fillStyle = frame.white ? "#ffffff" : "#10151c";
  g.fillRect(0, 0, out.width, out.height);
  g.drawImage(picture, 0, Math.round(head * k));
  g.scale(k, k);
  g.textBaseline = "alphabetic";
  g.fillStyle = ink;
  g.font = "bold 16px system-ui, sans-serif";
  g.fillText(frame.title, 14, 22, w - 28);
  g.font = "13px system-ui, sans-serif";
  g.fillText(frame.about, 14, 42, w - 28);
  drawAxes(g, 46, h - foot - 46, frame.turned);
  if (frame.legend) {
    const width = Math.min(w - 60, 420);
    const top = h - foot + 4;
    g.textBaseline = "alphabetic";
    g.fillStyle = ink;
    drawLegend(g, frame.legend, 30, top, width);
    g.fillStyle = ink;
    g.font = "12px system-ui, sans-serif";
    g.textAlign = "center";
    for (const t of [0, 0.25, 0.5, 0.75, 1]) g.fillText(frame.legend.tick(t), 30 + t * width, top + 50);
  }
  return out;
}
