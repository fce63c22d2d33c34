// What things in the picture are called: elements, and the axes in its corner.
import { Vector3, type Quaternion } from "three";
import { kindNames, type ElementOrigin } from "../../data";
import { fileName, num, replace, svg } from "../../dom";
import type { Report } from "../../report";
import type { Part3D } from "../parts3d";

/** Id, part, property, thickness, and where the element is defined. */
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

/** The axes of the deck as the view is turned. */
export function drawAxes(element: SVGElement, turned: Quaternion): void {
  const q = turned.clone().invert();
  const items = ([["X", "#c0392b", 1, 0, 0], ["Y", "#2e8b57", 0, 1, 0], ["Z", "#2f6fde", 0, 0, 1]] as const).map(([name, color, x, y, z]) => {
    const v = new Vector3(x, y, z).applyQuaternion(q);
    return { z: v.z, e: [
      svg("line", { x1: 0, y1: 0, x2: 18 * v.x, y2: -18 * v.y, stroke: color, "stroke-width": 2, "stroke-linecap": "round" }),
      svg("text", { x: 25 * v.x, y: -25 * v.y + 3, fill: color }, name)] };
  });
  items.sort((a, b) => a.z - b.z);
  replace(element, ...items.flatMap((i) => i.e));
}
