// Report without penetrations: nearest pair per interface, and the limit of the time step.
import { kindNames } from "../data";
import { h, lengthText, num, percent, replace } from "../dom";
import type { Report } from "../report";
import type { Row } from "../rows";
import { interfaceColumn } from "../table/columns";
import { VirtualTable } from "../table/table";

/** Distance of a pair beyond its gap. */
const room = (r: Row): number => r.distance - r.gap;

/** Nearest pair per interface relative to its gap, nearest first. */
export function nearestPairs(report: Report): Row[] {
  const best = new Map<number, Row>();
  report.meta.contacts.forEach((c, i) => {
    if (c.dropped || !c.evaluated || c.ties) return;
    const row = report.evaluator.nearest(i, report.results[i].setting);
    const known = best.get(c.interface);
    if (row && (!known || room(row) < room(known))) best.set(c.interface, row);
  });
  return [...best.values()].sort((a, b) => room(a) - room(b));
}

const pairText = (report: Report, r: Row) =>
  `${report.isEdge(r) ? "edge" : "node"} ${report.secondaryText(r)} and ${report.isEdge(r) ? "edge" : "segment"} ${report.mainText(r)}`;

export function nearText(report: Report, r: Row): string {
  return `${pairText(report, r)} of interface ${report.meta.interfaces[report.meta.contacts[r.contact].interface].id}: ${lengthText(report, room(r))} beyond the gap of ${lengthText(report, r.gap)}`;
}

/** What limits the time step in the first cycle. */
export function stepText(report: Report): string {
  const { cycle } = report;
  if (!cycle) return "";
  const { structure_dt: own, contact_dt: contact, structure_element: element } = cycle;
  const { time = "" } = report.meta.deck.units.working ?? {};
  const unit = time && ` ${time}`;
  const name = element ? `${kindNames[element[0]]} ${element[1]}` : "the elements";
  if (contact !== null && (own === null || contact < own)) return `Contact limits the time step: ${num(contact)}${unit}${own === null ? "" : `; ${name} would allow ${num(own)}${unit}`}.`;
  return own === null ? "" : `The time step is limited by ${name}: ${num(own)}${unit}; ${contact === null ? "no contact limits it" : `contact would allow ${num(contact)}${unit}`}.`;
}

/** `ready`: resolves after the first picture, before slow work. null if the deck has penetrations. */
export function nearestSection(report: Report, open: (row: Row) => void, ready: Promise<void>): HTMLElement | null {
  if (report.hits.length > 0 || report.meta.contacts.length === 0) return null;
  const said = h("p", { class: "nearest-said" });
  const section = h("section", { id: "nearest" }, h("h2", null, "Nearest"), said);
  const inter = (r: Row) => report.meta.interfaces[report.meta.contacts[r.contact].interface];
  const table = new VirtualTable<Row>(
    [
      interfaceColumn(report, (r) => report.meta.contacts[r.contact].interface),
      { key: "title", title: "Interface", kind: "text", rank: 3, value: (r) => inter(r).title, text: (r) => inter(r).title || "(no title)" },
      { key: "node", title: "Node / edge", kind: "id", value: (r) => report.nodeId(report.secondaryNodes(r)[0]), text: (r) => report.secondaryText(r) },
      { key: "segment", title: "Segment / edge", kind: "id", rank: 2, value: (r) => report.nodeId(report.mainNodes(r)[0]), text: (r) => report.mainText(r) },
      { key: "room", title: "Room", hint: "Distance less gap: what is left before the pair penetrates", kind: "number", value: room, text: (r) => lengthText(report, room(r)) },
      { key: "gap", title: "Gap", kind: "number", rank: 4, value: (r) => r.gap, text: (r) => lengthText(report, r.gap) },
      { key: "share", title: "Of gap", hint: "Room as a share of the gap", kind: "number", rank: 1, value: (r) => (r.gap > 0 ? room(r) / r.gap : Infinity), text: (r) => (r.gap > 0 ? percent(room(r) / r.gap) : "–") },
    ],
    { label: "Nearest pairs", name: "nearest", rows: [0, 8], hideEmpty: true, sort: "room", descending: false, select: (r) => r && open(r) },
  );
  section.append(table.element);
  const draw = () => {
    section.hidden = report.hits.length > 0;
    if (section.hidden) return;
    const rows = nearestPairs(report);
    const first = rows[0];
    table.setRows(rows);
    const reach = report.meta.contacts.reduce((m, c) => Math.max(m, c.reach), 0);
    replace(said, first ? h("span", null, "Nothing penetrates. Nearest is ", h("button", { type: "button", class: "link", onclick: () => open(first) }, pairText(report, first)), ` of interface ${inter(first).id}: ${lengthText(report, room(first))} beyond the gap of ${lengthText(report, first.gap)}. `)
      : `Nothing is nearer than ${num(reach)}. `, stepText(report));
  };
  void ready.then(() => {
    draw();
    report.on("results", draw);
  });
  return section;
}
