// The page of deck diff: what differs beside moved nodes, alike values in groups: "Gapmin x 2.5 in 30 interfaces"; a click leaves
// the penetrations that are new because of them.
import { loadChanges } from "../data";
import { button, h, num, plainTable, plural } from "../dom";
import type { Report } from "../report";

type Group = { text: string; columns: string[]; rows: string[][] };

/** Rows that say the same of several interfaces or entities. */
function grouped(): Group[] {
  const groups = new Map<string, Group>();
  for (const { title, columns, rows } of loadChanges()?.tables ?? []) {
    const effective = title === "Effective values";
    const [field, was, is] = effective ? [1, 4, 5] : [columns.indexOf("field"), columns.indexOf("old"), columns.indexOf("new")];
    for (const r of rows) {
      const ratio = Number(r[is]) / Number(r[was]);
      const factor = ratio > 0 && ratio < Infinity && !/^(I[a-z]+|.*_ID)/.test(r[field] ?? "");
      const name = field < 0 ? `${title}: ${r[0]}` : factor ? `${r[field]} × ${num(ratio)}` : `${r[field]} ${r[was]} → ${r[is]}`;
      const known = groups.get(`${title} ${name}`);
      if (known) known.rows.push(r);
      else groups.set(`${title} ${name}`, { text: name, columns, rows: [r] });
    }
    for (const g of groups.values())
      if (g.columns === columns && field >= 0) g.text += g.rows.length === 1 ? ` in ${g.rows[0][0]}` : effective ? ` in ${g.rows.length} interfaces` : ` (${g.rows.length} times)`;
  }
  return [...groups.values()].sort((a, b) => b.rows.length - a.rows.length);
}

export function changesSection(report: Report): HTMLElement | null {
  const groups = grouped();
  if (groups.length === 0) return null;
  /** The interface that a row is about, in the new deck; -1: none. */
  const interfaceOf = (r: string[]) => {
    const id = /^\/INTER\/\w+\/(?:\d+ -> )?(\d+)/.exec(r[0]);
    return id ? report.meta.interfaces.findIndex((i) => i.id === Number(id[1])) : -1;
  };
  const filter = (rows: string[][]) => {
    const at = rows.length === 1 ? interfaceOf(rows[0]) : -1;
    report.setFilter({ interface: at < 0 ? null : at, status: report.hits.some((x) => x.status === "new") ? "new" : null, perNode: true });
  };
  return h("section", { id: "changes" },
    h("h2", null, "What changed", h("span", { class: "muted count" }, plural(groups.reduce((n, g) => n + g.rows.length, 0), "value", "values"))),
    ...groups.map((g) => {
      const table = plainTable(g.columns, g.rows);
      table.querySelectorAll("tbody td:first-child").forEach((cell, i) => {
        if (interfaceOf(g.rows[i]) >= 0) cell.replaceChildren(button(g.rows[i][0], null, () => filter([g.rows[i]]), { class: "link", title: "Only the new penetrations of this interface" }));
      });
      return h("details", { class: "change", ontoggle: (e) => (e.target as HTMLDetailsElement).open && filter(g.rows) },
        h("summary", null, g.text), h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": g.text }, table));
    }));
}
