// Parts with mass, smallest time step and interfaces: the document of `deck parts --json`.
import type { Document, Part, Step } from "schema/parts";
import { blockText, loadSteps } from "../data";
import { amount, group, h, num, plural, sectionHead } from "../dom";
import type { Report } from "../report";
import { named } from "../table/columns";
import { VirtualTable } from "../table/table";

export function loadPartsDocument(report: Report): Document | null {
  const text = blockText("parts-json");
  if (text === null) return null;
  report.steps = loadSteps(report.mesh.nodeId.length);
  return JSON.parse(text) as Document;
}

const mostIds = 12;
const ids = (list: number[]) => list.slice(0, mostIds).join(", ") + (list.length > mostIds ? ` and ${list.length - mostIds} more` : "");
const count = (p: Part) => Object.values(p.elements).reduce((a, b) => a + b, 0);
const elementsText = (p: Part) => Object.entries(p.elements).map(([kind, n]) => `${group(n)} ${kind}`).join(", ") || "none";
const element = (dt: Step) => (dt.element ? `${dt.element.kind} ${dt.element.id}` : "–");

function notes(doc: Document): HTMLElement[] {
  const { unconnected: u } = doc;
  const touching = doc.repeated_contacts.map((c) => `interfaces ${ids(c.interfaces)} on ${plural(c.pairs, "pair", "pairs")} of parts (for example ${c.parts[0]} and ${c.parts[1]})`);
  const lines = [
    u.unseen_parts.length > 0 && `No contact or tie sees ${u.unseen_parts.length === 1 ? "part" : `${group(u.unseen_parts.length)} parts:`} ${ids(u.unseen_parts)}.`,
    u.parts.length > 0 && `Without elements: ${u.parts.length === 1 ? "part" : "parts"} ${ids(u.parts)}.`,
    u.nodes > 0 && `${plural(u.nodes, "node belongs", "nodes belong")} to no element.`,
    touching.length > 0 && `Several contacts act between the same parts: ${touching.slice(0, 3).join("; ")}${touching.length > 3 ? `; and ${touching.length - 3} more` : ""}.`,
    ...doc.not_computed.map((n) => `Not computed: ${n.what} (${group(n.count)}): ${n.why}.`),
  ];
  return lines.filter((l) => l !== false).map((l) => h("p", { class: "note" }, l));
}

/** `open` shows a part alone; null: all. */
export function partsSection(report: Report, doc: Document, open: (part: number | null) => void): HTMLElement {
  let chosen: Part | null = null;
  const table = new VirtualTable<Part>(
    [
      { key: "id", title: "Id", kind: "id", value: (p) => p.id, text: (p) => String(p.id) },
      { key: "title", title: "Part", kind: "text", least: 120, value: (p) => p.title.toLowerCase(), text: (p) => p.title || "(no title)",
        cell: (p, room) => (p.title ? named("", p.title, report.commonPrefix, room) : "(no title)") },
      { key: "elements", title: "Elements", kind: "text", rank: 4, least: 90, value: count, text: elementsText },
      { key: "material", title: "Mat.", hint: "Material id", kind: "id", rank: 6, value: (p) => p.material, text: (p) => String(p.material) },
      { key: "property", title: "Prop.", hint: "Property id", kind: "id", rank: 7, value: (p) => p.property, text: (p) => String(p.property) },
      { key: "thickness", title: "Thickness", kind: "number", rank: 5, value: (p) => p.thickness, text: (p) => (p.thickness > 0 ? num(p.thickness) : "–") },
      { key: "mass", title: "Mass", kind: "number", rank: 0, value: (p) => p.mass ?? -1, text: (p) => amount(p.mass) },
      { key: "step", title: "Step", hint: "Smallest time step of an element, as the solver lists it", kind: "number", value: (p) => p.dt.min ?? Infinity, text: (p) => amount(p.dt.min) },
      { key: "element", title: "Of element", kind: "id", rank: 3, value: (p) => p.dt.element?.id ?? 0, text: (p) => element(p.dt) },
      { key: "interfaces", title: "Interfaces", hint: "Contacts and ties that see the part", kind: "text", rank: 1, least: 80, value: (p) => p.interfaces.length, text: (p) => p.interfaces.join(", ") || "none",
        cell: (p) => (p.interfaces.length > 0 ? p.interfaces.join(", ") : h("span", { class: "muted" }, "none")) },
      { key: "body", title: "Rigid body", hint: "Holds all nodes of the part", kind: "id", rank: 2, value: (p) => p.rigid_body ?? 0, text: (p) => (p.rigid_body === null ? "–" : String(p.rigid_body)) },
    ],
    {
      label: "Parts", name: "parts", rows: [2, 14], sort: "step", descending: false,
      select: (p) => {
        chosen = p === chosen ? null : p;
        open(chosen ? report.meta.parts.findIndex((m) => m.id === chosen!.id) : null);
      },
      classOf: (p) => (count(p) === 0 ? "quiet" : ""),
      same: (a, b) => a === b,
    },
  );
  table.setRows(doc.parts);
  report.answers.push(["Parts", () => table.plain(12)]);
  return h("section", { id: "parts" },
    sectionHead(h("h2", null, "Parts", h("span", { class: "muted count" }, plural(doc.parts.length, "part", "parts"))), table.chooser()),
    table.element, ...notes(doc));
}
