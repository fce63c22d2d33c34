// Forces, energies and time steps of the first cycle, if the page has them; and a comparison without one effect (deck cycle
// --without EFFECT --html).
import type { Document } from "schema/cycle";
import type { CycleContact } from "schema/page";
import { amount, group, h, num, sectionHead } from "../dom";
import type { Report } from "../report";
import { commonStart, headOf, named } from "../table/columns";
import { VirtualTable } from "../table/table";

/** `known`: something was evaluated; `left`: reasons for the rest. */
type Whole = Omit<CycleContact, "rows" | "active" | "acceleration" | "complete"> & { known: boolean; left: string };

/** First cycle of an interface: sums over its contacts, smallest step; null if settings have changed. */
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

export function cycleSection(report: Report): HTMLElement | null {
  const { cycle } = report;
  if (!cycle) return null;
  const of = (i: number) => wholeOf(report, i);
  // A TYPE19 is one row, as in other tables.
  const rows = report.meta.interfaces.flatMap((_, i) => {
    const c = of(i);
    return c && (c.with_force > 0 || c.dt !== null || c.left !== "") ? [i] : [];
  });
  const dash = (i: number, f: (c: Whole) => string) => {
    const c = of(i);
    return c ? (c.known ? f(c) : "–") : "settings changed";
  };
  const why = (i: number) => {
    const c = of(i);
    return c ? [c.because, c.left].filter((t) => t).join("; ") || "–" : "settings changed";
  };
  const prefix = commonStart(report.meta.interfaces.map((i) => i.title));
  const reasons = [...new Set(rows.map(why))];
  const alike = reasons.length === 1 && reasons[0] !== "–";
  const table = new VirtualTable<number>(
    [
      { key: "id", title: "Id", kind: "id", value: (i) => report.meta.interfaces[i].id, text: (i) => String(report.meta.interfaces[i].id) },
      { key: "title", title: "Interface", kind: "text", rank: 3, value: (i) => report.meta.interfaces[i].title, text: (i) => report.meta.interfaces[i].title, cell: (i, room) => named("", report.meta.interfaces[i].title, prefix, room) },
      { key: "kind", title: "Kind", kind: "text", rank: 6, value: (i) => report.meta.interfaces[i].type, text: (i) => `TYPE${report.meta.interfaces[i].type}` },
      { key: "pairs", title: "Pairs", hint: "Pairs that carry a force", kind: "number", rank: 5, value: (i) => of(i)?.with_force ?? 0, text: (i) => dash(i, (c) => group(c.with_force)) },
      { key: "force", title: "Sum", hint: "Sum of the sizes of the pair forces", kind: "number", rank: 4, value: (i) => of(i)?.force ?? 0, text: (i) => dash(i, (c) => num(c.force)) },
      { key: "largest", title: "Largest", hint: "Largest force of one pair", kind: "number", value: (i) => of(i)?.largest ?? 0, text: (i) => dash(i, (c) => num(c.largest)) },
      { key: "elastic", title: "Energy", hint: "Elastic energy of the contact", kind: "number", rank: 3, value: (i) => of(i)?.elastic ?? 0, text: (i) => dash(i, (c) => num(c.elastic)) },
      { key: "dt", title: "Time step", hint: "Smallest step that this interface allows", kind: "number", value: (i) => of(i)?.dt ?? Infinity, text: (i) => dash(i, (c) => amount(c.dt)) },
      ...(alike ? [] : [{ key: "because", title: "Because of", kind: "text" as const, rank: 1, value: (i: number) => of(i)?.because ?? "", text: why }]),
    ],
    { label: "First cycle", rows: [1, 5], hideEmpty: true, sort: "dt", descending: false, select: (i) => i !== null && report.setFilter({ interface: i, pairs: null }) },
  );
  report.on("results", () => table.setRows(rows));
  table.setRows(rows);
  if (report.meta.page === "cycle") report.answers.push(["First cycle", () => table.plain(12)]);
  return h("section", { id: "cycle" }, h("h2", null, "First cycle"), table.element, h("p", { class: "note" }, `${rows.length === 0 ? "No contact carries a force or limits the time step. " : ""}Evaluated by the program with the deck's settings (deck cycle).${alike ? ` All steps are because of ${reasons[0]}.` : ""}${report.welds.length > 0 ? " Forces of ties (TYPE2) are not computed." : ""}`));
}

const figures = [["force", "Sum of forces"], ["elastic", "Elastic energy"], ["dt", "Time step"]] as const;

export function withoutSection(report: Report, doc: Document): HTMLElement | null {
  const other = doc.without;
  if (!other) return null;
  /** Both figures; marks changes with their size. */
  const pair = (a: number | null, b: number | null): HTMLElement[] => {
    const change = a !== null && b !== null && a !== b ? (a !== 0 ? ` (${b > a ? "+" : "−"}${num(100 * Math.abs(b / a - 1), 3)} %)` : "") : "";
    return [h("td", { class: "right" }, amount(a)), h("td", { class: `right${a === b ? " muted" : " changed"}` }, amount(b), change)];
  };
  const rows = other.interfaces.flatMap((o) => {
    const at = report.meta.interfaces.findIndex((i) => i.id === o.id);
    const own = at < 0 ? null : wholeOf(report, at);
    if (!own) return [];
    const without = { force: o.force_sum, elastic: o.elastic_energy, dt: o.contact_dt };
    const same = figures.every(([k]) => own[k] === without[k]);
    return [{ same, row: h("tr", { "data-interface": o.id, class: same ? "quiet" : "" }, h("th", { scope: "row" }, report.interfaceName(at)), ...figures.flatMap(([k]) => pair(own[k], without[k]))) }];
  });
  const changed = rows.filter((r) => !r.same).length;
  const [force, dt] = [[doc.nodal_force.max, other.largest_nodal_force], [doc.dt.contact, other.contact_dt]] as const;
  return h("section", { id: "without" },
    sectionHead(h("h2", null, `With and without ${other.effect}`)),
    h("p", { class: "note" }, `${changed === 0 ? "No interface has another force, energy or step" : `${changed} of ${rows.length} interfaces change`} without ${other.effect}. `,
      `${headOf("force", "Largest force on a node")} ${amount(force[0])}, without ${amount(force[1])}; ${headOf("dt", "time step of contact")} ${amount(dt[0])}, without ${amount(dt[1])}.`),
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `With and without ${other.effect}` },
      h("table", { class: "plain without" },
        h("thead", null,
          h("tr", null, h("th", { scope: "col", rowspan: 2 }, "Interface"), ...figures.map(([key, name]) => h("th", { scope: "colgroup", colspan: 2 }, headOf(key, name)))),
          h("tr", null, ...figures.flatMap(() => [h("th", { scope: "col" }, "with"), h("th", { scope: "col" }, "without")]))),
        h("tbody", null, ...rows.sort((a, b) => Number(a.same) - Number(b.same)).map((r) => r.row)))));
}
