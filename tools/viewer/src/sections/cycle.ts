// Forces, energies and time steps of the first cycle, where the page carries them.
import { group, h, num, plural, replace } from "../dom";
import type { CycleContact } from "schema/page";
import type { Report } from "../report";
import { VirtualTable } from "../table/table";

/** `known`: something of it was evaluated; `left`: why the rest was not. */
type Whole = Omit<CycleContact, "rows" | "active" | "acceleration" | "complete"> & { known: boolean; left: string };

/** The first cycle of an interface: sums over its contacts, the smallest step; null: settings have changed. */
export function wholeOf(report: Report, inter: number): Whole | null {
  const out: Whole = { known: false, left: "", dt: null, because: "", with_force: 0, force: 0, largest: 0, elastic: 0 };
  for (const i of report.contactsOf(inter)) {
    const c = report.cycleOf(i);
    if (!c) return null;
    if (!c.complete && !out.left.includes(c.because)) out.left += (out.left ? "; " : "") + c.because;
    out.known ||= c.complete;
    out.with_force += c.with_force;
    out.force += c.force;
    out.largest = Math.max(out.largest, c.largest);
    out.elastic += c.elastic;
    if (c.dt === null || (out.dt !== null && out.dt <= c.dt)) continue;
    out.dt = c.dt;
    out.because = c.because;
  }
  return out;
}

/** What the program has no forces for. */
function notComputed(report: Report): string {
  const modern = new Set(report.meta.contacts.filter((c) => c.modern).map((c) => c.interface)).size;
  const ties = report.welds.length;
  const left = [modern > 0 && plural(modern, "interface of TYPE24 or TYPE25", "interfaces of TYPE24 and TYPE25"), ties > 0 && plural(ties, "tie", "ties")].filter(Boolean);
  return left.length > 0 ? ` Forces of ${left.join(" and ")} are not computed.` : "";
}

export function cycleSection(report: Report): HTMLElement {
  const section = h("section", { id: "cycle" });
  const cycle = report.cycle;
  if (!cycle) {
    section.hidden = true;
    return section;
  }
  const of = (i: number) => wholeOf(report, i);
  // An interface of several contacts, TYPE19, is one row, as in the other tables.
  const rows = report.meta.interfaces.flatMap((_, i) => {
    const c = of(i);
    return c && (c.with_force > 0 || c.dt !== null || c.left !== "") ? [i] : [];
  });
  const step = (dt: number | null) => (dt === null ? "–" : num(dt));
  const dash = (i: number, f: (c: Whole) => string) => {
    const c = of(i);
    return c ? (c.known ? f(c) : "–") : "settings changed";
  };
  const why = (i: number) => {
    const c = of(i);
    return c ? [c.because, c.left].filter((t) => t).join("; ") || "–" : "settings changed";
  };
  const table = new VirtualTable<number>(
    [
      { key: "id", title: "Id", kind: "id", value: (i) => report.meta.interfaces[i].id, text: (i) => String(report.meta.interfaces[i].id) },
      { key: "kind", title: "Kind", kind: "text", rank: 2, value: (i) => report.meta.interfaces[i].type, text: (i) => `TYPE${report.meta.interfaces[i].type}` },
      { key: "pairs", title: "With force", hint: "Pairs that carry a force", kind: "number", rank: 5, value: (i) => of(i)?.with_force ?? 0, text: (i) => dash(i, (c) => group(c.with_force)) },
      { key: "force", title: "Sum", hint: "Sum of the sizes of the pair forces", kind: "number", rank: 4, value: (i) => of(i)?.force ?? 0, text: (i) => dash(i, (c) => num(c.force)) },
      { key: "largest", title: "Largest", hint: "Largest force of one pair", kind: "number", value: (i) => of(i)?.largest ?? 0, text: (i) => dash(i, (c) => num(c.largest)) },
      { key: "elastic", title: "Energy", hint: "Elastic energy of the contact", kind: "number", rank: 3, value: (i) => of(i)?.elastic ?? 0, text: (i) => dash(i, (c) => num(c.elastic)) },
      { key: "dt", title: "Time step", hint: "Smallest step that this interface allows", kind: "number", value: (i) => of(i)?.dt ?? Infinity, text: (i) => dash(i, (c) => step(c.dt)) },
      { key: "because", title: "Because of", kind: "text", rank: 1, value: (i) => of(i)?.because ?? "", text: why },
    ],
    { label: "First cycle", sort: "dt", descending: false, select: (i) => i !== null && report.setFilter({ interface: i, pair: null }) },
  );
  const sentence = h("p", { class: "note" });
  const draw = () => {
    table.setRows(rows);
    const forces = cycle.contacts.reduce((n, c) => n + c.with_force, 0);
    const limits = cycle.contact_dt !== null && (cycle.structure_dt === null || cycle.contact_dt < cycle.structure_dt);
    replace(sentence,
      `${plural(forces, "pair carries", "pairs carry")} a force in the first cycle. `,
      cycle.contact_dt === null ? "No contact limits the time step." : h(limits ? "b" : "span", { class: limits ? "bad" : "" }, `Contact allows a time step of ${step(cycle.contact_dt)}, the elements ${step(cycle.structure_dt)}.`),
      notComputed(report),
      " Evaluated by the program with the deck's settings (deck cycle).");
  };
  table.element.style.setProperty("--rows", String(Math.max(1, Math.min(rows.length, 8))));
  table.element.hidden = rows.length === 0;
  replace(section, h("h2", null, "First cycle"), table.element, sentence);
  report.on("results", draw);
  draw();
  return section;
}
