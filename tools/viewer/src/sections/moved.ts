// Nodes moved by a repair, by part and one by one. The picture shows the mesh before and after.
import { loadMoved } from "../data";
import { button, group, h, lengthText, num, plural, replace, sectionHead } from "../dom";
import type { Moved } from "schema/page";
import type { Report } from "../report";
import { partColumn } from "../table/columns";
import { VirtualTable } from "../table/table";

type MovedRow = Moved["rows"][0];
interface PartRow {
  part: number;
  nodes: number;
  longest: number;
  mean: number;
}

const lengthOf = (r: MovedRow) => Math.hypot(r[1], r[2], r[3]);

/** `fly` goes to a node; `before` switches between the meshes; `show` isolates a part. */
export function movedSection(report: Report, fly: (node: number) => void, before: (on: boolean) => void, show: (part: number | null) => void): HTMLElement | null {
  const moved = loadMoved();
  if (!moved) return null;
  report.moved = moved;
  const section = h("section", { id: "moved" });
  if (moved.total === 0) {
    if (report.meta.page === "diff") return null;
    section.append(h("h2", null, "Moved nodes"), h("p", { class: "note" }, "No node was moved: the repair changed cards only."));
    return section;
  }
  const partOf = (r: MovedRow) => r[4];
  const byPart = [...new Set(moved.rows.map(partOf))].map((p): PartRow => {
    const own = moved.rows.filter((r) => partOf(r) === p).map(lengthOf);
    return { part: p, nodes: own.length, longest: Math.max(...own), mean: own.reduce((a, b) => a + b, 0) / own.length };
  });
  const parts = new VirtualTable<PartRow>(
    [
      partColumn(report, "part", "Part", (r) => r.part, { least: 150 }),
      { key: "nodes", title: "Nodes", kind: "number", value: (r) => r.nodes, text: (r) => group(r.nodes) },
      { key: "longest", title: "Farthest", kind: "number", value: (r) => r.longest, text: (r) => lengthText(report, r.longest, 4, true) },
      { key: "mean", title: "Mean", kind: "number", rank: 1, value: (r) => r.mean, text: (r) => num(r.mean, 4, true) },
    ],
    { label: "Moved nodes by part", rows: [0, 6], sort: "longest", descending: true, select: (r) => {
      draw(r === null ? null : r.part);
      show(r === null ? null : r.part);
    } },
  );
  parts.setRows(byPart);
  report.answers.push(["Moved nodes", () => parts.plain(12)]);
  const nodes = new VirtualTable<MovedRow>(
    [
      { key: "node", title: "Node", kind: "id", value: (r) => report.nodeId(r[0]), text: (r) => String(report.nodeId(r[0])) },
      partColumn(report, "part", "Part", partOf, { rank: 1, least: 100 }),
      { key: "length", title: "Moved by", kind: "number", value: lengthOf, text: (r) => num(lengthOf(r), 4, true) },
      ...(["dx", "dy", "dz"] as const).map((key, k) => ({ key, title: key, kind: "number" as const, rank: 2 + k, value: (r: MovedRow) => r[k + 1], text: (r: MovedRow) => num(r[k + 1], 4) })),
    ],
    { label: "Moved nodes", name: "moved", rows: [0, 8], sort: "length", descending: true, select: (r) => r && fly(r[0]) },
  );
  const draw = (only: number | null) => nodes.setRows(only === null ? moved.rows : moved.rows.filter((r) => partOf(r) === only));
  draw(null);
  const choice = h("span", { class: "buttons", role: "group", "aria-label": "Mesh in the picture" });
  const turn = (old: boolean) => {
    before(old);
    replace(choice, ...([["Before", true], ["After", false]] as const).map(([label, on]) => button(label, null, () => turn(on), { class: "small", "aria-pressed": on === old ? "true" : "false" })));
  };
  turn(false);
  section.append(
    sectionHead(h("h2", null, "Moved nodes", h("span", { class: "muted count" }, plural(moved.total, "node", "nodes"))), choice, nodes.chooser()),
    parts.element, nodes.element,
    ...(moved.rows.length < moved.total ? [h("p", { class: "note" }, `The farthest ${group(moved.rows.length)} of ${group(moved.total)} are listed.`)] : []));
  return section;
}
