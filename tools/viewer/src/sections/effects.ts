// Effects: cost of the loop over pairs; active and inactive effects with reasons; one effect of one interface in words; the
// folded matrix of all. From the document of `deck cycle --json`.
import type { Document, Effect, EffectCost, EffectSum, Interface } from "schema/cycle";
import { blockText } from "../data";
import { button, fileName, group, h, num, plural, replace } from "../dom";
import type { Report } from "../report";

export function loadCycleDocument(): Document | null {
  const text = blockText("cycle-json");
  return text === null ? null : (JSON.parse(text) as Document);
}

const ns = (v: number) => `${Math.abs(v) < 10 ? v.toFixed(1) : v.toFixed(0)} ns`;
type Cost = EffectCost & Required<Pick<EffectCost, "against" | "ns" | "low" | "high" | "change">>;
const known = (e: EffectCost): e is Cost => e.why_not === undefined;
/** Time; or its upper bound if the lower quartile does not exceed 0. */
const added = (e: { ns: number; low: number; high: number }) => (e.low > 0 ? ns(e.ns) : `under ${ns(Math.max(e.high, 0.1))}`);

/** Mean over the pairs of some contacts. */
function mean(list: { pairs: number; cost: Cost }[], pick: (c: Cost) => number): number {
  const pairs = list.reduce((n, x) => n + x.pairs, 0);
  return list.reduce((n, x) => n + x.pairs * pick(x.cost), 0) / pairs;
}

const words = (name: string) => name.replaceAll("-", " ");
/** Cost of an effect over all contacts with enough pairs. */
const costOf = (e: EffectSum) => (e.ns === undefined ? "–" : added({ ns: e.ns, low: e.low!, high: e.high! }));

/** The loop of this deck next to the generic kernel and to all effects. */
function bars(doc: Document): HTMLElement | null {
  const costs = doc.costs;
  if (!costs || costs.pairs === 0) return null;
  const all: [string, number][] = [["this deck", costs.loop_ns], ["flags asked for in the loop", costs.flags_ns], ["everything", costs.all_ns]];
  const most = Math.max(...all.map(([, v]) => v));
  return h("table", { class: "bars" }, h("tbody", null, ...all.filter(([, v]) => v > 0).map(([name, v], i) => h("tr", null,
    h("th", { scope: "row" }, name), h("td", { class: "bar-cell" }, h("span", { class: i === 0 ? "bar on" : "bar", style: `width:${(100 * v) / most}%` })),
    h("td", null, `${ns(v)} a pair`), h("td", null, `${num((v * costs.pairs) / 1e6, 3)} ms a cycle`), h("td", null, i === 0 ? "" : `${num(v / costs.loop_ns, 2)} x`)))));
}

/** Active or inactive effects, most expensive first. */
function list(effects: EffectSum[], on: boolean, choose: (name: string) => void): HTMLElement {
  const heads = on ? ["Runs", "Asked by", "In", "Costs", "Moves a force by"] : ["Does not run", "Would begin with", "In", "Would cost"];
  const row = (e: EffectSum) => {
    const first = button(words(e.name), "", () => choose(e.name), { class: "link" });
    const moves = e.change === undefined ? "–" : e.change === 0 ? "nothing" : `${num(100 * e.change, 3)} %`;
    return h("tr", { "data-effect": e.name }, h("td", null, first), h("td", null, on ? e.because : (e.against ?? `off: ${e.because}`)), h("td", null, `${e.in}/${e.of}`), h("td", null, costOf(e)), on && h("td", null, moves));
  };
  const table = (rows: EffectSum[]) => h("table", { class: "plain sums" }, h("thead", null, h("tr", null, ...heads.map((t) => h("th", { scope: "col" }, t)))), h("tbody", null, ...rows.map(row)));
  const most = on ? effects.length : 7;
  return h("div", { class: "scroll", tabindex: -1 }, table(effects.slice(0, most)),
    effects.length > most && h("details", null, h("summary", null, `${effects.length - most} more that do not run`), table(effects.slice(most))));
}

export function effectsSection(report: Report, doc: Document): HTMLElement {
  const detail = h("div", { class: "panel effect-detail", "aria-live": "polite", hidden: true });
  const [on, off] = [true, false].map((o) => doc.effects.filter((e) => e.on === o));
  const cells = matrix(doc, (i, e) => {
    show(detail, i, e);
    const at = report.meta.interfaces.findIndex((x) => x.id === i.id);
    if (at >= 0 && report.filter.interface !== at) report.setFilter({ interface: at, pairs: null });
  });
  const choose = (name: string) => {
    const inter = doc.interfaces.find((i) => i.effects.some((e) => e.name === name && e.on)) ?? doc.interfaces.find((i) => i.effects.some((e) => e.name === name));
    if (inter) show(detail, inter, inter.effects.find((e) => e.name === name)!);
  };
  return h("section", { id: "effects", "aria-label": "Effects" },
    h("h2", null, "Only what this deck asks for runs", h("span", { class: "muted count" }, `${on.length} of ${doc.effects.length} effects`)),
    bars(doc),
    doc.costs && doc.costs.pairs > 0 && h("p", { class: "note" }, `${plural(doc.costs.pairs, "pair", "pairs")}, timed on ${plural(doc.costs.contacts, "contact", "contacts")}; the answers of these loops are equal bit for bit. Processor time of deck's own loop over pairs, not of the Engine; ${doc.costs.repeats} timings in turn; ${doc.costs.processor}; ${doc.costs.compiler}.`),
    list(on, true, choose), list(off, false, choose), detail,
    h("details", { class: "by-interface" }, h("summary", null, "By interface"), h("div", { class: "scroll effects-scroll", tabindex: -1 }, cells),
      h("p", { class: "note" }, "Filled: runs, with what it adds per pair in ns where the contact was timed (--costs: each with 100 pairs or more). Choose a cell to see the field that decides.")));
}

/** Interfaces by effects. One tab stop; arrow keys move inside. */
function matrix(doc: Document, choose: (i: Interface, e: Effect) => void): HTMLElement {
  const names = [...new Set(doc.interfaces.flatMap((i) => i.effects.map((e) => e.name)))];
  const runs = (n: string) => doc.interfaces.filter((i) => i.effects.some((e) => e.name === n && e.on)).length;
  names.sort((a, b) => runs(b) - runs(a));
  const cells: HTMLTableCellElement[][] = [];
  const body = doc.interfaces.map((inter, row) => {
    const line = names.map((n, column) => {
      const e = inter.effects.find((x) => x.name === n);
      const costs = inter.contacts.flatMap((c) => (c.cost?.effects ?? []).filter(known).filter((x) => x.name === n && x.on).map((cost) => ({ pairs: c.cost!.pairs, cost })));
      const range = costs.length > 0 && { low: mean(costs, (c) => c.low), high: mean(costs, (c) => c.high) };
      const text = !e?.on ? "" : !range || range.low <= 0 ? "•" : mean(costs, (c) => c.ns).toFixed(1);
      const cell = h("td", { role: "gridcell", id: `ef-${row}-${column}`, class: e?.on ? "on" : "off", "aria-label": `${inter.id} ${n}: ${e?.on ? "runs" : "off"}${text && text !== "•" ? `, ${text} ns` : ""}`, title: e ? `${n}: ${e.because}` : n }, text);
      if (e) cell.addEventListener("click", () => pick(row, column));
      return cell;
    });
    cells.push(line);
    return h("tr", { role: "row" }, h("th", { role: "rowheader", scope: "row", title: inter.title }, `${inter.id} TYPE${inter.type}`), ...line);
  });
  const table = h("table", { role: "grid", tabindex: 0, class: "effects", "aria-label": "Effects by interface" },
    h("thead", null, h("tr", { role: "row" }, h("td", { role: "gridcell" }), ...names.map((n) => h("th", { role: "columnheader", scope: "col", "data-name": n }, h("span", null, words(n)))))), h("tbody", null, ...body));
  let at: [number, number] = [0, 0];
  const mark = () => {
    for (const old of table.querySelectorAll(".at")) old.classList.remove("at");
    const cell = cells[at[0]]?.[at[1]];
    cell?.classList.add("at");
    if (cell) table.setAttribute("aria-activedescendant", cell.id);
  };
  const pick = (row: number, column: number) => {
    at = [row, column];
    mark();
    const inter = doc.interfaces[row];
    const e = inter.effects.find((x) => x.name === names[column]);
    if (e) choose(inter, e);
  };
  table.addEventListener("keydown", (k) => {
    const move = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[k.key];
    if (move) {
      at = [Math.min(Math.max(at[0] + move[0], 0), cells.length - 1), Math.min(Math.max(at[1] + move[1], 0), names.length - 1)];
      mark();
      cells[at[0]]?.[at[1]]?.scrollIntoView({ block: "nearest", inline: "nearest" });
    } else if (k.key === "Enter") pick(...at);
    else return;
    k.preventDefault();
    k.stopPropagation();
  });
  return table;
}

/** One effect of one interface: deciding field, and times per contact. */
function show(panel: HTMLElement, inter: Interface, e: Effect): void {
  const where = e.source ? `${fileName(e.source.file)}:${e.source.line}, column ${e.source.column}` : "no field of the card";
  const rows = inter.contacts.map(({ role, cost }) => {
    const c = cost?.effects.find((x) => x.name === e.name);
    const kind = inter.type === 19 ? role : `TYPE${inter.type}`;
    if (!cost || !c || cost.problem || !known(c))
      return h("tr", null, h("td", null, kind), h("td", { colspan: 4 }, cost?.problem || c?.why_not || "not measured"));
    return h("tr", null, h("td", null, kind), h("td", null, `${c.on ? "" : "would add "}${added(c)}`), h("td", null, c.against),
      h("td", null, c.change === 0 ? "no force" : `a force by ${num(100 * c.change, 3)} % of the largest`),
      h("td", null, `${group(cost.measured)} of ${group(cost.pairs)}${cost.margin > 0 ? `, up to ${num(cost.margin)} beyond the gap` : ""}`));
  });
  panel.hidden = false;
  replace(panel,
    h("h3", null, `${e.name} ${e.on ? "runs" : "does not run"} in interface ${inter.id}${inter.title ? ` ${inter.title}` : ""}`),
    h("p", { class: "note" }, `${e.because}. `, h("b", null, where)),
    h("table", { class: "plain" }, h("thead", null, h("tr", null, ...["Contact", "Adds per pair", "Against", "Moves", "Pairs timed"].map((t) => h("th", { scope: "col" }, t)))), h("tbody", null, ...rows)));
}
