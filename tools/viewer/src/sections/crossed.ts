// Crossed elements: edges through main segments, for any gap.
import { kindNames } from "../data";
import { h, plural } from "../dom";
import type { Crossings } from "schema/page";
import type { Report } from "../report";
import { interfaceColumn, partColumn } from "../table/columns";
import { VirtualTable } from "../table/table";

type Row = Crossings["rows"][0];

/** Corners of the crossed segment as page nodes. */
export function segmentOf(report: Report, row: Row): number[] {
  const n = Array.from(report.data.contacts[row[0]].mainNode.subarray(4 * row[5], 4 * row[5] + 4));
  return n[2] === n[3] ? n.slice(0, 3) : n;
}

/** Edge and segment of a row with their elements and part. */
export function crossingText(report: Report, r: Row): string {
  const main = report.data.contacts[r[0]].mainOwner;
  const element = main.kind[r[5]] > 0 ? ` (${kindNames[main.kind[r[5]] - 1]} ${main.id[r[5]]}, part ${report.partText(main.part[r[5]])})` : "";
  return `Edge ${report.nodeId(r[1])}–${report.nodeId(r[2])} of ${kindNames[r[3]]} ${r[4]} passes through segment ${segmentOf(report, r).map((n) => report.nodeId(n)).join(" ")}${element}`;
}

export function crossedSection(report: Report, open: (row: Row) => void): HTMLElement | null {
  const crossed = report.crossed;
  if (!crossed || report.tiesOnly) return null;
  const section = h("section", { id: "crossed" }, h("h2", null, "Crossed elements", h("span", { class: "muted count" }, plural(crossed.total, "crossed element", "crossed elements"))));
  if (crossed.total === 0) {
    section.append(h("p", { class: "note" }, "No edge of the secondary side passes through a main segment. The search is exact."));
    return section;
  }
  const edge = (r: Row) => `${report.nodeId(r[1])}–${report.nodeId(r[2])}`;
  const table = new VirtualTable<Row>(
    [
      interfaceColumn(report, (r) => report.meta.contacts[r[0]].interface),
      { key: "kind", title: "Kind", kind: "text", rank: 2, value: (r) => report.roleText(r[0]), text: (r) => report.roleText(r[0]) },
      { key: "edge", title: "Edge", kind: "id", value: (r) => report.nodeId(r[1]), text: edge },
      { key: "element", title: "of element", kind: "id", rank: 1, value: (r) => r[4], text: (r) => `${kindNames[r[3]]} ${r[4]}` },
      { key: "segment", title: "Segment", kind: "id", rank: 4, value: (r) => report.nodeId(segmentOf(report, r)[0]), text: (r) => segmentOf(report, r).map((n) => report.nodeId(n)).join(" ") },
      partColumn(report, "part", "Main part", (r) => report.data.contacts[r[0]].mainOwner.part[r[5]], { rank: 3 }),
    ],
    { label: "Crossed elements", rows: [0, 8], sort: "inter", descending: false, select: (r) => r && open(r) },
  );
  table.setRows(crossed.rows);
  section.append(table.element, h("p", { class: "note" }, crossed.rows.length < crossed.total ? `The first ${crossed.rows.length} are listed. ` : "",
    "Crossed parts stay entangled with any gap: repair crossings before depths. The reference solver does not check them."));
  return section;
}
