// Part pairs as table and matrix, distributions, and the list of penetrations.
import { amount, button, dropDown, fileName, group, h, lengthText, num, percent, plainTable, plural, replace, sectionHead, svg } from "../dom";
import { colorAt, cssColor, inkOn, type Look } from "../look";
import { isPair, type Hit, type Report } from "../report";
import { openMenu, rowItems } from "../menu";
import { stopsSolver } from "../rows";
import { interfaceColumn, named, partColumn } from "../table/columns";
import { VirtualTable, type Column } from "../table/table";

interface PairRow {
  secondary: number;
  main: number;
  pairs: number;
  nodes: number;
  edges: number;
  max: number;
  mean: number;
  p95: number;
  ratio: number;
}

export function partPairs(report: Report, hits: Hit[]): PairRow[] {
  const groups = new Map<number, Hit[]>();
  for (const x of hits) {
    const k = (x.secondaryPart + 1) * 2 ** 26 + x.mainPart + 1;
    const list = groups.get(k);
    if (list) list.push(x);
    else groups.set(k, [x]);
  }
  return [...groups.values()]
    .map((list) => {
      const nodes = new Set<number>();
      const edges = new Set<string>();
      let [sum, ratio] = [0, 0];
      for (const x of list) {
        const [a, b] = x.nodes;
        if (b === 0) nodes.add(a);
        else edges.add(a < b ? `${a}-${b}` : `${b}-${a}`);
        sum += x.depth;
        ratio = Math.max(ratio, x.ratio);
      }
      return {
        secondary: list[0].secondaryPart, main: list[0].mainPart, pairs: list.length, nodes: nodes.size, edges: edges.size, max: list[0].depth,
        mean: sum / list.length, p95: list[Math.floor(list.length / 20)].depth /* deepest first */, ratio,
      };
    })
    .sort((a, b) => b.max - a.max || report.partId(a.secondary) - report.partId(b.secondary));
}

/** A click selects a pair or deselects it; Ctrl adds or removes it; Shift adds all pairs with its secondary part, Ctrl and Shift all with its
 * main part. */
function choosePairs(report: Report, rows: PairRow[], { secondary, main }: PairRow, keys: { ctrlKey?: boolean; metaKey?: boolean; shiftKey?: boolean } = {}): void {
  const now = report.filter.pairs ?? [];
  const ctrl = keys.ctrlKey || keys.metaKey;
  const on = isPair(now, secondary, main);
  const rest = now.filter(([s, m]) => s !== secondary || m !== main);
  const alike = rows.filter((r) => (keys.shiftKey ? (ctrl ? r.main === main : r.secondary === secondary) : r.secondary === secondary && r.main === main));
  const added = alike.filter((r) => !isPair(now, r.secondary, r.main)).map((r): [number, number] => [r.secondary, r.main]);
  const next = keys.shiftKey ? [...now, ...added] : ctrl ? (on ? rest : [...now, ...added]) : on && rest.length === 0 ? [] : [[secondary, main] as [number, number]];
  report.setFilter({ pairs: next.length > 0 ? next : null });
}

/** All pairs of a part, on either side. */
export function choosePart(report: Report, part: number): void {
  const pairs = partPairs(report, report.passing("pairs", false)).filter((r) => r.secondary === part || r.main === part);
  report.setFilter({ pairs: pairs.length > 0 ? pairs.map((r) => [r.secondary, r.main]) : null });
}

export function pairsSection(report: Report, look: Look): HTMLElement {
  const table = new VirtualTable<PairRow>(
    [
      partColumn(report, "s", "Secondary part", (r) => r.secondary, { least: 190 }),
      partColumn(report, "m", "Main part", (r) => r.main, { least: 190 }),
      { key: "pairs", title: "Pairs", kind: "number", rank: 1, value: (r) => r.pairs, text: (r) => group(r.pairs) },
      { key: "nodes", title: "Nodes", kind: "number", rank: 3, value: (r) => r.nodes, text: (r) => group(r.nodes) },
      { key: "edges", title: "Edges", kind: "number", rank: 4, value: (r) => r.edges, text: (r) => group(r.edges) },
      { key: "max", title: "Deepest", kind: "number", value: (r) => r.max, text: (r) => num(r.max, 4, true) },
      { key: "mean", title: "Mean", kind: "number", rank: 5, value: (r) => r.mean, text: (r) => num(r.mean, 4, true) },
      { key: "p95", title: "p95", hint: "95 % of the pairs are not deeper", kind: "number", rank: 6, value: (r) => r.p95, text: (r) => num(r.p95, 4, true) },
      { key: "ratio", title: "Of gap", kind: "number", rank: 2, value: (r) => r.ratio, text: (r) => percent(r.ratio) },
    ],
    {
      label: "Part pairs", rows: [1, 8], hideEmpty: true, sort: "max", descending: true,
      select: (r, keys) => r && choosePairs(report, table.order, r, keys),
      chosen: (r) => isPair(report.filter.pairs, r.secondary, r.main),
      toggle: (r) => choosePairs(report, table.order, r, { ctrlKey: true }),
      context: (r, x, y) => openMenu([r.secondary, r.main].map((p) => ({ label: `All pairs of part ${report.partText(p)}`, run: () => choosePart(report, p) })), x, y),
      same: (a, b) => a.secondary === b.secondary && a.main === b.main,
    },
  );
  const matrix = h("div", { class: "matrix-wrap" });
  const count = h("span", { class: "muted count" });
  const empty = h("p", { class: "note" }, `No part penetrates another${report.leftOut}.`);
  const section = h("section", { id: "pairs", hidden: report.tiesOnly }, sectionHead(h("h2", null, "Part pairs", count), table.chooser()), table.element, matrix, empty);
  const draw = () => {
    const rows = partPairs(report, report.passing("pairs", false)); // all pairs count here, regardless of the list
    table.setRows(rows);
    const last = report.filter.pairs?.at(-1);
    table.setSelected(last ? (rows.find((r) => isPair([last], r.secondary, r.main)) ?? null) : null, true);
    empty.hidden = rows.length > 0;
    count.textContent = rows.length ? plural(rows.length, "pair", "pairs") : "";
    replace(matrix, rows.length > 1 ? drawMatrix(report, rows, look) : null);
  };
  report.on("filter", draw);
  report.on("look", draw);
  draw();
  return section;
}

const matrixSize = 26;

function drawMatrix(report: Report, rows: PairRow[], look: Look): HTMLElement {
  const order = (pick: (r: PairRow) => number) => {
    const best = new Map<number, number>();
    for (const r of rows) best.set(pick(r), Math.max(best.get(pick(r)) ?? 0, r.max));
    return [...best].sort((a, b) => b[1] - a[1]).slice(0, matrixSize).map(([p]) => p);
  };
  const down = order((r) => r.secondary);
  const across = order((r) => r.main);
  const top = rows.reduce((m, r) => Math.max(m, r.max), 0);
  const cells = new Map(rows.map((r) => [`${r.secondary},${r.main}`, r]));
  const { pairs } = report.filter;
  const head = (p: number, kind: string, room: number) => h("button", { type: "button", onclick: () => choosePart(report, p), tabindex: -1, class: `matrix-head matrix-${kind}`, title: `${report.partText(p)}: all its pairs` }, p < 0 ? "(no part)" : named(report.meta.parts[p].id, report.meta.parts[p].title, report.commonPrefix, room));
  const grid = h("div", { class: "matrix", role: "group", "aria-label": "Deepest penetration by part pair" });
  grid.style.gridTemplateColumns = `max-content repeat(${across.length}, minmax(26px, 46px))`;
  grid.append(h("div", { class: "matrix-corner" }, "secondary \u2193   main \u2192"));
  for (const p of across) grid.append(head(p, "col", 150));
  for (const s of down) {
    grid.append(head(s, "row", 190));
    for (const m of across) {
      const r = cells.get(`${s},${m}`);
      if (!r) {
        grid.append(h("div", { class: "matrix-cell none" }));
        continue;
      }
      const t = top > 0 ? r.max / top : 0;
      const [red, green, blue] = colorAt(look.map, t);
      const on = isPair(pairs, s, m);
      grid.append(h("button", {
        type: "button", tabindex: grid.querySelector("[tabindex='0']") === null && (on || !pairs) ? 0 : -1, class: `matrix-cell${on ? " on" : ""}`, style: `background:rgb(${red} ${green} ${blue});color:${inkOn(red, green, blue)}`,
        title: `${report.partText(s)} into ${report.partText(m)}: ${plural(r.pairs, "pair", "pairs")}, deepest ${num(r.max)}`,
        onclick: (e) => choosePairs(report, rows, r, e as MouseEvent),
      }, r.pairs > 999 ? `${Math.round(r.pairs / 1000)}k` : String(r.pairs)));
    }
  }
  grid.addEventListener("keydown", (e) => stepThrough(grid, across.length + 1, e));
  const left = new Set(rows.map((r) => r.secondary)).size - down.length + new Set(rows.map((r) => r.main)).size - across.length;
  return h("div", null, grid, left > 0 ? h("p", { class: "note" }, `${left} shallower parts are only in the table above.`) : null);
}

/** Arrow keys go to the next cell with pairs; the matrix is one tab stop. */
function stepThrough(grid: HTMLElement, width: number, e: KeyboardEvent): void {
  const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -width, ArrowDown: width }[e.key];
  const from = document.activeElement;
  if (!by || !(from instanceof HTMLButtonElement)) return;
  e.preventDefault();
  const cells = [...grid.children];
  for (let i = cells.indexOf(from) + by; i >= 0 && i < cells.length; i += by) {
    const to = cells[i];
    if (!(to instanceof HTMLButtonElement)) continue;
    from.tabIndex = -1;
    to.tabIndex = 0;
    return to.focus();
  }
}

// ---- distributions ----------------------------------------------------------------------------

export function distribution(report: Report, look: Look): HTMLElement {
  const left = h("div", { class: "chart" });
  const right = h("div", { class: "chart" });
  const section = h("section", { id: "distribution" }, h("h2", null, "Distribution"), h("div", { class: "charts" }, left, right));
  const draw = () => {
    section.hidden = report.hits.length === 0;
    if (section.hidden) return;
    replace(left, histogram(report, look, "depth", "Depth"));
    replace(right, histogram(report, look, "ratio", "Depth ÷ gap"));
  };
  report.on("filter", draw);
  report.on("look", draw);
  draw();
  return section;
}

function ticks(top: number): number[] {
  const raw = top / 4;
  const p = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((k) => k * p).find((s) => s >= raw) ?? raw;
  const out = [];
  for (let i = 0; i < 12 && (i * step) / top <= 1.0001; i++) out.push(i * step);
  return out;
}

function histogram(report: Report, look: Look, field: "depth" | "ratio", title: string): HTMLElement {
  const values = report.bounded(report.around(field));
  let all = 0;
  for (const x of report.bounded(report.hits)) if (x[field] > all) all = x[field];
  const top = field === "ratio" ? Math.max(1, all) : all || 1;
  const bins = 24;
  const count = new Array<number>(bins).fill(0);
  for (const x of values) count[Math.min(bins - 1, Math.floor((x[field] / top) * bins))]++;
  const most = Math.max(...count, 1);
  const [w, hgt, x0, y0, x1, y1] = [384, 176, 38, 10, 350, 142];
  const x = (v: number) => x0 + (x1 - x0) * (v / top);
  const y = (n: number) => y1 - ((y1 - y0) * n) / most;
  const g: SVGElement[] = [];
  for (const t of ticks(most).filter((n) => Number.isInteger(n)))
    g.push(svg("line", { x1: x0, x2: x1, y1: y(t), y2: y(t), class: "grid" }), svg("text", { x: x0 - 6, y: y(t) + 4, class: "tick end", "data-value": t }, group(t)));
  for (const t of [0, 0.5, 1]) g.push(svg("text", { x: x1 + 4, y: y1 - (y1 - y0) * t + 4, class: "tick" }, percent(t)));
  for (const t of ticks(top)) g.push(svg("text", { x: x(t), y: y1 + 16, class: "tick mid" }, num(t, 3)));
  const range = report.filter[field];
  let sum = 0;
  let path = `M${x0} ${y1}`;
  count.forEach((n, i) => {
    const low = (i / bins) * top;
    const high = ((i + 1) / bins) * top;
    const inside = !range || (low >= range[0] - 1e-12 * top && high <= range[1] * (1 + 1e-9));
    sum += n;
    path += ` L${x(high)} ${y1 - ((y1 - y0) * sum) / Math.max(values.length, 1)}`;
    const bar = svg("rect", {
      x: x(low) + 1, width: Math.max(1, x(high) - x(low) - 2), y: n ? Math.min(y(n), y1 - 2) : y1, height: n ? Math.max(2, y1 - y(n)) : 0,
      rx: 1.5, fill: cssColor(look.map, (i + 0.5) / bins), opacity: inside ? 1 : 0.25,
    });
    const hit = svg("rect", {
      x: x(low), width: x(high) - x(low), y: y0, height: y1 - y0, fill: "transparent", class: "bin",
      onclick: () => report.setFilter({ [field]: range && range[0] === low ? null : [low, i === bins - 1 ? Infinity : high] }),
    }, svg("title", null, `${num(low)} to ${num(high)}: ${plural(n, "row", "rows")}`));
    g.push(bar, hit);
  });
  g.push(svg("path", { d: path, class: "cumulative" }));
  return h("figure", null,
    h("figcaption", null, title, h("span", { class: "muted" }, ` · ${plural(values.length, "row", "rows")}, line: cumulative share`)),
    svg("svg", { viewBox: `0 0 ${w} ${hgt - 12}`, role: "img", "aria-label": `Histogram of ${title}` }, ...g));
}

// ---- list -------------------------------------------------------------------------------------

// Over 80 lines: columns and filters share the row type.
export function listSection(report: Report, open: (hit: Hit) => void, exportsMenu: HTMLElement, changed: () => void): { element: HTMLElement; table: VirtualTable<Hit> } {
  const action = (x: Hit) => report.fateText(x.row);
  const place = (x: Hit) => report.place(x.row);
  const columns: Column<Hit>[] = [
    { key: "depth", title: "Depth", kind: "number", value: (x) => x.depth, text: (x) => lengthText(report, x.depth, 5, true) },
    { key: "gap", title: "Gap", kind: "number", rank: 3, value: (x) => x.row.gap, text: (x) => lengthText(report, x.row.gap, 4, true) },
    { key: "ratio", title: "Of gap", kind: "number", rank: 4, value: (x) => x.ratio, text: (x) => percent(x.ratio) },
    { key: "distance", title: "Distance", hint: "Residual distance of node and segment, or of the two edges", kind: "number", rank: 8, value: (x) => x.row.distance, text: (x) => num(x.row.distance, 4, true) },
    { ...interfaceColumn<Hit>(report, (x) => report.meta.contacts[x.contact].interface), rank: 0 },
    { key: "node", title: "Node / edge", kind: "id", value: (x) => x.nodes[0], text: (x) => report.secondaryText(x.row) },
    { key: "segment", title: "Segment / edge", kind: "id", rank: 5, value: (x) => report.nodeId(report.mainNodes(x.row)[0]), text: (x) => report.mainText(x.row) },
    { key: "action", title: "Action", hint: "What the solver does about it at start-up", kind: "text", rank: 2, value: (x) => x.row.action, text: action,
      cell: (x) => (stopsSolver(x.row.action) ? h("span", { class: "bad" }, action(x)) : action(x)) },
    partColumn(report, "sp", "Part", (x) => x.secondaryPart, { least: 170, rank: 1 }),
    partColumn(report, "mp", "Main part", (x) => x.mainPart, { least: 170, rank: 1 }),
    { key: "place", title: "Defined at", kind: "text", rank: 7, value: (x) => place(x)?.line ?? 0, text: (x) => (place(x) ? `${place(x)!.file}:${place(x)!.line}` : ""),
      cell: (x) => (place(x) ? `${fileName(place(x)!.file)}:${place(x)!.line}` : "") },
  ];
  if (report.cycle)
    columns.splice(columns.findIndex((c) => c.key === "action") + 1, 0, {
      key: "force", title: "Force", hint: "Of the pair in the first cycle, with the deck's settings", kind: "number", rank: 6,
      value: (x) => report.forceOf(x.row)?.force ?? -1,
      text: (x) => amount(report.forceOf(x.row)?.force ?? null),
    });
  if (report.earlier)
    columns.unshift({
      key: "status", title: "Change", hint: `Against ${report.earlier.path}`, kind: "id", value: (x) => x.status ?? "", text: (x) => (x.status ? `${x.status}   ` : ""),
      cell: (x) => (x.status ? h("span", { class: `chip tiny ${x.status}`, title: x.earlier !== null ? `was ${num(x.earlier)}` : "" }, x.status) : ""),
    });
  const table = new VirtualTable<Hit>(columns, {
    label: "Penetrations", name: "list", rows: [3, 15], hideEmpty: true, sort: "depth", descending: true,
    select: (x) => report.select(x),
    open,
    context: (x, left, top) => openMenu(rowItems(report, x), left, top),
    changed,
    same: (a, b) => a.key === b.key,
  });
  const chips = h("div", { class: "filters" });
  const count = h("span", { class: "muted count" });
  const from = h("input", { type: "number", class: "from-depth", min: 0, step: "any", placeholder: "0", "aria-label": "Only from this depth", onchange: () => report.setFilter({ depth: Number(from.value) > 0 ? [Number(from.value), Infinity] : null }) });
  const perNode = h("input", { type: "checkbox", checked: true, onchange: () => report.setFilter({ perNode: perNode.checked }) });
  const solved = h("div", { class: "solved" });
  const empty = h("p", { class: "note" }, "Nothing to list.");
  const element = h("section", { id: "worst", hidden: report.tiesOnly },
    sectionHead(h("h2", null, "Worst first", count), h("label", { class: "check" }, "from ", from, " deep"), h("label", { class: "check" }, perNode, "deepest per node"), table.chooser(), exportsMenu),
    chips, table.element, empty, solved);
  const draw = () => {
    const f = report.filter;
    table.setRows(report.filtered);
    table.setSelected(report.selected, false);
    empty.hidden = report.filtered.length > 0;
    empty.textContent = report.hits.length ? "No row passes the filters." : `Nothing penetrates with these settings${report.leftOut}.`;
    perNode.checked = f.perNode;
    if (document.activeElement !== from) from.value = f.depth && f.depth[1] === Infinity ? String(f.depth[0]) : "";
    count.textContent = report.hits.length ? `${group(report.filtered.length)} of ${plural(report.hits.length, "pair", "pairs")}` : "";
    const chip = (text: string, clear: Partial<typeof f>) =>
      h("button", { type: "button", class: "chip filter", title: "Remove this filter", onclick: () => report.setFilter(clear) }, text, h("span", { "aria-hidden": "true" }, " ×"));
    const span = (r: [number, number]) => (r[1] === Infinity ? `≥ ${num(r[0])}` : `${num(r[0])} – ${num(r[1])}`);
    replace(chips,
      f.interface !== null && chip(`interface ${report.interfaceName(f.interface)}`, { interface: null }),
      f.pairs && chip(report.pairsText, { pairs: null }),
      f.depth && chip(`depth ${span(f.depth)}`, { depth: null }),
      f.ratio && chip(`depth ÷ gap ${span(f.ratio)}`, { ratio: null }),
      f.status && chip(f.status, { status: null }),
      f.roundOff && chip("only by the solver's round-off", { roundOff: false }),
      f.text && chip(`“${f.text}”`, { text: "" }));
    const gone = report.solved;
    replace(solved, f.status === "solved" && gone.length > 0
      ? plainTable(["Interface", "Part of it", "Node / edge", "Depth before", "Gap before"],
          gone.slice(0, 500).map((s) => [s.interfaceId, s.role, s.nodes.filter((n) => n).join("–"), num(s.depth), num(s.gap)]))
      : null);
  };
  report.on("filter", draw);
  report.on("selection", () => table.setSelected(report.selected, true));
  draw();
  return { element, table };
}

export function exportMenu(actions: { label: string; run: () => void; hint?: string }[]): HTMLElement {
  const menu = dropDown({ id: "export" }, h("summary", { class: "button" }, "Export"), h("div", { class: "menu-list", role: "menu" },
    ...actions.map((a) => button(a.label, null, () => {
      menu.open = false;
      a.run();
    }, { role: "menuitem", title: a.hint }))));
  return menu;
}
