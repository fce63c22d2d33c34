// Which effects run in which interface and why, and what each costs on this deck: the document of `deck cycle --json` as a
// matrix, one effect in words, and folded the chart of costs.
import type { Document, Effect, EffectCost, Interface } from "schema/cycle";
import { blockText } from "../data";
import { button, fileName, group, h, num, plural, replace, svg } from "../dom";
import { save } from "../exports";
import type { Report } from "../report";

export function loadCycleDocument(): Document | null {
  const text = blockText("cycle-json");
  return text === null ? null : (JSON.parse(text) as Document);
}

const ns = (v: number) => `${Math.abs(v) < 10 ? v.toFixed(1) : v.toFixed(0)} ns`;
type Cost = EffectCost & Required<Pick<EffectCost, "against" | "ns" | "low" | "high" | "change">>;
const known = (e: EffectCost): e is Cost => e.why_not === undefined;
/** The quartiles leave no doubt about the sign. */
const sure = (e: { low: number; high: number }) => e.low > 0 || e.high < 0;
const added = (e: { ns: number; low: number; high: number }) => (sure(e) ? ns(e.ns) : `under ${ns(Math.max(e.high, -e.low))}`);

/** Mean over the pairs of some contacts. */
function mean(list: { pairs: number; cost: Cost }[], pick: (c: Cost) => number): number {
  const pairs = list.reduce((n, x) => n + x.pairs, 0);
  return list.reduce((n, x) => n + x.pairs * pick(x.cost), 0) / pairs;
}

interface Bar {
  name: string;
  on: boolean;
  value: number;
  low: number;
  high: number;
  note: string;
}

/** What each effect adds: where it runs, over the contacts that ask for it; else over all that could have it. */
export function costBars(doc: Document): Bar[] {
  const of = new Map<string, { pairs: number; cost: Cost }[]>();
  for (const i of doc.interfaces)
    for (const { cost } of i.contacts)
      for (const e of cost?.problem === "" ? cost.effects : [])
        if (known(e)) of.set(e.name, [...(of.get(e.name) ?? []), { pairs: cost!.pairs, cost: e }]);
  const bars = [...of].map(([name, list]): Bar => {
    const running = list.filter((x) => x.cost.on);
    const these = running.length > 0 ? running : list;
    return {
      name, on: running.length > 0, value: mean(these, (c) => c.ns), low: mean(these, (c) => c.low), high: mean(these, (c) => c.high),
      note: running.length > 0 ? `runs in ${running.length} of ${plural(list.length, "contact", "contacts")}` : `runs nowhere; ${these[0].cost.against}`,
    };
  });
  return bars.sort((a, b) => Number(b.on) - Number(a.on) || b.value - a.value);
}

function chart(doc: Document): SVGElement {
  const costs = doc.costs!;
  const whole: Bar[] = [
    ["only what is asked for", costs.loop_ns, true], ["the same, flags asked for in the loop", costs.flags_ns, false], ["everything that can run", costs.all_ns, false],
  ].filter((r) => (r[1] as number) > 0).map(([name, v, on]) => ({ name: name as string, on: on as boolean, value: v as number, low: v as number, high: v as number, note: "" }));
  const single = costBars(doc);
  const [left, right, row] = [250, 640, 20];
  const out: SVGElement[] = [svg("style", null,
    ".ef text{font:12px system-ui,sans-serif;fill:#5c6979} .ef .ef-name{fill:#17202b} .ef .ef-title{fill:#17202b;font-weight:bold} .ef .ef-grid{stroke:#dde2e8} .ef .ef-on{fill:#1f5fd0} .ef .ef-off{fill:none;stroke:#1f5fd0;stroke-width:1.2} .ef .ef-range{stroke:#9a5b00;stroke-width:1.5}")];
  let y = 0;
  const text = (b: Bar) => (b.low === b.high ? ns(b.value) : added({ ns: b.value, low: b.low, high: b.high }));
  const panel = (title: string, bars: Bar[]) => {
    y += 24;
    out.push(svg("text", { x: 8, y, class: "ef-title" }, title));
    const top = Math.max(...bars.map((b) => Math.max(b.value, b.high)), 1e-9);
    const step = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000].find((s) => top / s <= 6) ?? top / 5;
    const x = (v: number) => left + (Math.max(0, v) / top) * (right - left);
    const [from, to] = [y + 8, y + 8 + row * bars.length];
    for (let v = 0; v <= top * 1.0001; v += step)
      out.push(svg("line", { x1: x(v), x2: x(v), y1: from, y2: to, class: "ef-grid" }), svg("text", { x: x(v), y: to + 15, "text-anchor": "middle" }, `${num(v)}${v === 0 ? " ns per pair" : ""}`));
    bars.forEach((b, i) => {
      const at = from + row * i;
      out.push(svg("g", { class: "ef-bar", "data-name": b.name }, svg("title", null, `${b.name}: ${text(b)} per pair${b.note && `; ${b.note}`}`),
        svg("text", { x: left - 8, y: at + 14, "text-anchor": "end", class: "ef-name" }, b.name),
        svg("rect", { x: left, y: at + 4, width: Math.max(x(b.value) - left, 1), height: row - 8, rx: 2, class: b.on ? "ef-on" : "ef-off" }),
        b.high > b.low && svg("line", { x1: x(b.low), x2: x(b.high), y1: at + row / 2, y2: at + row / 2, class: "ef-range" }),
        svg("text", { x: Math.max(x(b.value), x(b.high)) + 6, y: at + 14 }, text(b))));
    });
    y = to + 24;
  };
  panel("The loop over pairs", whole);
  if (single.length > 0) panel("What one effect adds (filled: runs here; outlined: would, if it were asked for)", single);
  const [w, hgt] = [right + 80, y + 4];
  return svg("svg", { xmlns: "http://www.w3.org/2000/svg", class: "ef", viewBox: `0 0 ${w} ${hgt}`, width: w, height: hgt, role: "img", "aria-label": "Cost of the effects in nanoseconds per pair" }, ...out);
}

export function effectsSection(report: Report, doc: Document, name: string): HTMLElement {
  const detail = h("div", { class: "panel effect-detail", "aria-live": "polite", hidden: true });
  const names = (list: Effect[]) => new Set(list.map((e) => e.name)).size;
  const all = doc.interfaces.flatMap((i) => i.effects);
  const count = h("span", { class: "muted count" }, `${names(all.filter((e) => e.on))} of ${plural(names(all), "effect runs", "effects run")}`);
  const drawing = doc.costs && doc.costs.pairs > 0 ? chart(doc) : null;
  const section = h("section", { id: "effects", "aria-label": "Effects" },
    h("h2", null, "Effects", count),
    h("div", { class: "scroll effects-scroll", tabindex: -1 }, matrix(doc, (i, e) => {
      show(detail, i, e);
      const at = report.meta.interfaces.findIndex((x) => x.id === i.id);
      if (at >= 0 && report.filter.interface !== at) report.setFilter({ interface: at, pair: null });
    })),
    h("p", { class: "note" }, "Filled: runs, with what it adds per pair in ns (~0: less than can be told); a dot: runs outside the loop. Choose a cell to see the field that decides."),
    detail,
    doc.costs && h("details", { class: "costs" }, h("summary", null, "What the effects cost"),
      h("p", { class: "costs-text" }, doc.costs.verdict),
      drawing && h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Cost of effects" }, drawing),
      h("p", { class: "note" }, "Nanoseconds of processor time per pair, each loop in turn with the one it is held against, answers compared bit for bit. Search and sums at nodes are left out. ",
        `${doc.costs.repeats} timings; ${doc.costs.processor}; ${doc.costs.compiler}.`),
      drawing && button("Save as SVG", "save", () => save(name, drawing.outerHTML), { class: "small" })));
  return section;
}

/** Interfaces down, effects across. One tab stop; arrows move in it. */
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
      const text = !e?.on ? "" : !range ? "•" : sure(range) ? mean(costs, (c) => c.ns).toFixed(1) : "~0";
      const cell = h("td", { role: "gridcell", id: `ef-${row}-${column}`, class: e?.on ? "on" : "off", "aria-label": `${inter.id} ${n}: ${e?.on ? "runs" : "off"}${text && text !== "•" ? `, ${text} ns` : ""}`, title: e ? `${n}: ${e.because}` : n }, text);
      if (e) cell.addEventListener("click", () => pick(row, column));
      return cell;
    });
    cells.push(line);
    return h("tr", { role: "row" }, h("th", { role: "rowheader", scope: "row", title: inter.title }, `${inter.id} TYPE${inter.type}`), ...line);
  });
  const table = h("table", { role: "grid", tabindex: 0, class: "effects", "aria-label": "Effects by interface" },
    h("thead", null, h("tr", { role: "row" }, h("td", { role: "gridcell" }), ...names.map((n) => h("th", { role: "columnheader", scope: "col" }, h("span", null, n))))), h("tbody", null, ...body));
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

/** One effect of one interface: the field that decides, and what was measured in each of its contacts. */
function show(panel: HTMLElement, inter: Interface, e: Effect): void {
  const where = e.source ? `${fileName(e.source.file)}:${e.source.line}, column ${e.source.column}` : "no field of the card";
  const rows = inter.contacts.map(({ role, cost }) => {
    const c = cost?.effects.find((x) => x.name === e.name);
    const kind = inter.type === 19 ? role : `TYPE${inter.type}`;
    if (!cost || !c || cost.problem || !known(c)) return h("tr", null, h("td", null, kind), h("td", { colspan: 4 }, cost?.problem || c?.why_not || "not measured"));
    return h("tr", null, h("td", null, kind), h("td", null, `${c.on ? "" : "would add "}${added(c)} (${ns(c.low)} to ${ns(c.high)})`), h("td", null, c.against),
      h("td", null, c.change === 0 ? "no force" : `a force by ${num(100 * c.change, 3)} % of the largest`),
      h("td", null, `${group(cost.measured)} of ${group(cost.pairs)}${cost.margin > 0 ? `, up to ${num(cost.margin)} beyond the gap` : ""}`));
  });
  panel.hidden = false;
  replace(panel,
    h("h3", null, `${e.name} ${e.on ? "runs" : "does not run"} in interface ${inter.id}${inter.title ? ` ${inter.title}` : ""}`),
    h("p", { class: "note" }, `${e.because}. `, h("b", null, where)),
    h("table", { class: "plain" }, h("thead", null, h("tr", null, ...["Contact", "Adds per pair", "Against", "Moves", "Pairs timed"].map((t) => h("th", { scope: "col" }, t)))), h("tbody", null, ...rows)));
}
