// Labels in the picture: of a picked element; of the chosen node and segment, beside them and connected by a line.
import { Vector3 } from "three";
import { kindNames, type ElementOrigin } from "../../data";
import { fileName, h, lengthText, num, replace, svg } from "../../dom";
import type { Hit, Report } from "../../report";
import { exactAt, pointOf, wayOut } from "../drawn";
import type { Part3D } from "../parts3d";

/** Id, part, property, thickness, and place of definition. */
export function elementText(report: Report, o: ElementOrigin, part: Part3D, item: number, node: number): string {
  const meta = part.data.part < 0 ? null : report.meta.parts[part.data.part];
  const thickness = o.thickness || meta?.thickness || 0;
  const file = report.meta.files[o.file];
  return [
    `${kindNames[part.elementKind[item]]} ${part.element[item]}`,
    `part ${report.partText(part.data.part)}`,
    meta && `property ${meta.prop}${meta.prop_type ? ` ${meta.prop_type.replace("/PROP/", "")}` : ""}`,
    thickness > 0 && `thickness ${num(thickness)}`,
    node >= 0 && `node ${report.nodeId(node)}`,
    o.line > 0 && file && `${fileName(file)}:${o.line}`,
  ].filter(Boolean).join(" · ");
}

interface Point {
  x: number;
  y: number;
}
interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const clear = 24; // pixels between a label and its object
const rings = [64, 96, 136, 190];
const turns = 16;

const distance = (b: Box, p: Point) => Math.hypot(Math.max(b.left - p.x, 0, p.x - b.right), Math.max(b.top - p.y, 0, p.y - b.bottom));
const overlap = (a: Box, b: Box) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** Position of a box near `at`: inside `room`, away from points and boxes; tries `angle` first (0: right, clockwise). */
function placeFor(at: Point, size: { width: number; height: number }, room: Box, points: Point[], boxes: Box[], angle: number): Box {
  let best: Box | null = null;
  let fewest = Infinity;
  for (const r of rings)
    for (let k = 0; k < turns; k++) {
      const a = angle + ((k % 2 === 0 ? 1 : -1) * Math.ceil(k / 2) * 2 * Math.PI) / turns;
      const [dx, dy] = [Math.cos(a), Math.sin(a)];
      const x = at.x + r * dx + (dx * size.width) / 2;
      const y = at.y + r * dy + (dy * size.height) / 2;
      const box = { left: x - size.width / 2, right: x + size.width / 2, top: y - size.height / 2, bottom: y + size.height / 2 };
      const wrong = points.filter((p) => distance(box, p) < clear).length + boxes.filter((b) => overlap(box, b)).length +
        (box.left < room.left || box.right > room.right || box.top < room.top || box.bottom > room.bottom ? 4 : 0);
      if (wrong === 0) return box;
      if (wrong < fewest) [best, fewest] = [box, wrong];
    }
  return best!;
}

export class Labels {
  private readonly node = h("div", { class: "label", hidden: true });
  private readonly segment = h("div", { class: "label small", hidden: true });
  private readonly lines = svg("svg", { class: "leaders", "aria-hidden": "true" });
  readonly elements = [this.lines, this.node, this.segment];
  hide(): void { this.node.hidden = this.segment.hidden = true; this.lines.replaceChildren(); }
  /** `place` gives the picture position of a point, null behind the camera; `taken`: other boxes. */
  show(report: Report, x: Hit, place: (at: Vector3) => Point | null, room: Box, taken: Box[]): void {
    const corners = report.mainNodes(x.row).map((n) => exactAt(report, n));
    const middle = corners.reduce((a, b) => a.clone().add(b), new Vector3()).divideScalar(corners.length);
    const point = pointOf(report, x.row);
    const foot = point.clone().addScaledVector(wayOut(report, x.row), -x.row.distance);
    const [at, below, centre] = [place(point), place(foot), place(middle)];
    if (!at) return this.hide();
    if (this.node.dataset.key !== x.key + x.depth) {
      this.node.dataset.key = x.key + x.depth;
      replace(this.node,
        h("b", null, `${report.isEdge(x.row) ? "edge" : "node"} ${report.secondaryText(x.row)}`),
        h("span", null, `depth ${lengthText(report, x.depth, 5)} · gap ${lengthText(report, x.row.gap)} · distance ${num(x.row.distance)}`));
      this.segment.textContent = `${report.isEdge(x.row) ? "edge" : "segment"} ${report.mainText(x.row)}`;
    }
    const points = [at, below, centre].filter((p) => p !== null);
    this.node.hidden = false;
    const own = placeFor(at, this.sizeOf(this.node), room, points, taken, -Math.PI / 4);
    this.put(this.node, own);
    const leaders = [this.leader(own, at)];
    this.segment.hidden = !centre;
    if (centre) {
      const box = placeFor(centre, this.sizeOf(this.segment), room, points, [...taken, own], (3 * Math.PI) / 4);
      this.put(this.segment, box);
      leaders.push(this.leader(box, centre));
    }
    this.lines.replaceChildren(...leaders);
  }
  /** One label for one point. */
  one(text: string, point: Vector3, place: (at: Vector3) => Point | null, room: Box, taken: Box[]): void {
    const at = place(point);
    if (!at) return this.hide();
    if (this.node.dataset.key !== text) {
      this.node.dataset.key = text;
      replace(this.node, h("b", null, text));
    }
    this.node.hidden = false;
    this.segment.hidden = true;
    const box = placeFor(at, this.sizeOf(this.node), room, [at], taken, -Math.PI / 4);
    this.put(this.node, box);
    this.lines.replaceChildren(this.leader(box, at));
  }
  private sizeOf(e: HTMLElement): { width: number; height: number } { return { width: e.offsetWidth, height: e.offsetHeight }; }
  private put(e: HTMLElement, box: Box): void {
    e.style.transform = `translate(${Math.round(box.left)}px, ${Math.round(box.top)}px)`;
  }
  private leader(box: Box, to: Point): SVGElement {
    const x = Math.min(Math.max(to.x, box.left), box.right);
    const y = Math.min(Math.max(to.y, box.top), box.bottom);
    return svg("line", { x1: x, y1: y, x2: to.x, y2: to.y });
  }
}
