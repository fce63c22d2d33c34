// The first cycle with and without one effect, side by side: deck cycle --without EFFECT --html.
import { h, num, sectionHead } from "../dom";
import type { Report } from "../report";
import type { Document } from "schema/cycle";
import { wholeOf } from "./cycle";

const figures = [["force", "Sum of forces"], ["elastic", "Elastic energy"], ["dt", "Time step"]] as const;

export function withoutSection(report: Report, doc: Document): HTMLElement | null {
  const other = doc.without;
  if (!other) return null;
  const text = (v: number | null) => (v === null ? "–" : num(v));
  /** Both figures; what the effect changes is marked, with by how much. */
  const pair = (a: number | null, b: number | null): HTMLElement[] => {
    const change = a !== null && b !== null && a !== b ? (a !== 0 ? ` (${b > a ? "+" : "−"}${num(100 * Math.abs(b / a - 1), 3)} %)` : "") : "";
    return [h("td", { class: "right" }, text(a)), h("td", { class: `right${a === b ? " muted" : " changed"}` }, text(b), change)];
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
      `Largest nodal force ${text(force[0])}, without ${text(force[1])}; time step of contact ${text(dt[0])}, without ${text(dt[1])}.`),
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `With and without ${other.effect}` },
      h("table", { class: "plain without" },
        h("thead", null,
          h("tr", null, h("th", { scope: "col", rowspan: 2 }, "Interface"), ...figures.map(([, name]) => h("th", { scope: "colgroup", colspan: 2 }, name))),
          h("tr", null, ...figures.flatMap(() => [h("th", { scope: "col" }, "with"), h("th", { scope: "col" }, "without")]))),
        h("tbody", null, ...rows.sort((a, b) => Number(a.same) - Number(b.same)).map((r) => r.row)))));
}
