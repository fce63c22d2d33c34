// Ties: the table of `deck gaps` for each /INTER/TYPE2 and TYPE10, and untied nodes.
import { amount, fileName, group, h, num, plural, sectionHead } from "../dom";
import type { TieMeta } from "schema/page";
import type { Report } from "../report";
import { interfaceColumn, partColumn } from "../table/columns";
import { VirtualTable } from "../table/table";
import { cornersOf, Holds, nodeOf, type Untied } from "../tied";

function listOfTies(report: Report): VirtualTable<TieMeta> {
  const inter = (t: TieMeta) => report.meta.interfaces[t.interface];
  const table = new VirtualTable<TieMeta>(
    [
      { key: "id", title: "Id", kind: "id", value: (t) => inter(t).id, text: (t) => String(inter(t).id) },
      { key: "text", title: "Result", kind: "text", least: 215, value: (t) => t.lost, text: (t) => `TYPE${inter(t).type} ${inter(t).id}: ${t.text}`,
        cell: (t) => h("span", { class: t.stops ? "bad" : "" }, t.text) },
      { key: "losses", title: "What happens", kind: "text", rank: 2, value: (t) => t.losses, text: (t) => (t.losses === "-" ? "–" : t.losses) },
      { key: "title", title: "Tie", kind: "text", least: 120, rank: 1, value: (t) => inter(t).title.toLowerCase(), text: (t) => inter(t).title || "(no title)" },
      { key: "search", title: "Search distance", kind: "number", rank: 4, value: (t) => t.search_distance, text: (t) => (t.search_distance > 0 ? num(t.search_distance) : "by pair") },
      { key: "farthest", title: "Farthest", hint: "Largest distance of a node that is tied", kind: "number", rank: 3, value: (t) => t.farthest, text: (t) => (t.tied > 0 ? num(t.farthest) : "–") },
    ],
    {
      label: "Ties", name: "ties", rows: [0, 8], sort: "text", descending: true,
      select: (t) => report.setFilter({ interface: t && report.filter.interface !== t.interface ? t.interface : null, pairs: null, depth: null, ratio: null }),
      classOf: (t) => (t.lost === 0 && t.evaluated ? "quiet" : ""),
      same: (a, b) => a.interface === b.interface,
    },
  );
  table.setRows(report.meta.ties);
  return table;
}

function listOfNodes(report: Report, open: (x: Untied) => void): VirtualTable<Untied> {
  const node = (x: Untied) => report.nodeId(nodeOf(report, x));
  const segment = (x: Untied) => cornersOf(report, x.tie, x.row[0]).map((n) => report.nodeId(n)).join(" ") || "–";
  const place = (x: Untied) => (x.row[6] < 0 ? "" : `${report.meta.files[x.row[6]]}:${x.row[7]}`);
  return new VirtualTable<Untied>(
    [
      interfaceColumn(report, (x) => report.meta.ties[x.tie].interface),
      { key: "node", title: "Node", kind: "id", value: node, text: (x) => String(node(x)) },
      partColumn(report, "part", "Part", (x) => x.row[3], { rank: 2, least: 90 }),
      { key: "segment", title: "Nearest segment", kind: "id", rank: 3, value: segment, text: segment },
      { key: "distance", title: "Distance", kind: "number", value: (x) => x.row[1] ?? Infinity, text: (x) => amount(x.row[1], 6) },
      { key: "search", title: "Search", hint: "How far the solver looks", kind: "number", rank: 1, value: (x) => x.row[2] ?? 0, text: (x) => amount(x.row[2], 6) },
      { key: "why", title: "Why", kind: "text", least: 145, value: (x) => x.row[4], text: (x) => x.row[4], cell: (x) => h("span", { title: x.row[5] }, x.row[4]) },
      { key: "place", title: "Defined at", kind: "text", rank: 6, value: (x) => x.row[7], text: place, cell: (x) => fileName(place(x)) },
    ],
    { label: "Nodes that are not tied", name: "untied", rows: [2, 10], hideEmpty: true, sort: "inter", descending: false, select: (x) => x && open(x), open, same: (a, b) => a.tie === b.tie && a.row === b.row },
  );
}

/** `open` shows a node and its segment. */
export function tiesSection(report: Report, open: (x: Untied) => void): HTMLElement | null {
  const { ties } = report.meta;
  if (ties.length === 0) return null;
  const list = listOfTies(report);
  const table = listOfNodes(report, open);
  const said = h("p", { class: "note", "aria-live": "polite" });
  const beyond = h("input", { type: "checkbox", onchange: () => draw() });
  const rims = ties.reduce((n, t) => n + t.beyond_rim, 0);
  const all = report.ties.flatMap((t, tie) => t.rows.map((row): Untied => ({ tie, row })));
  const lost = (x: Untied) => report.ties[x.tie].holds[x.row[0]] === Holds.lost;
  const count = h("span", { class: "muted count" });
  const title = h("h3", null, "Nodes that are not tied ", count);
  const head = sectionHead(title, rims > 0 && h("label", { class: "check" }, beyond, `also ${group(rims)} tied beyond a rim`), table.chooser());
  const draw = () => {
    const { interface: inter } = report.filter;
    const own = ties.map((t) => inter === null || t.interface === inter);
    // A chosen contact filters nothing here.
    const none = !own.includes(true);
    const rows = all.filter((x) => (none || own[x.tie]) && (lost(x) || beyond.checked));
    table.setRows(rows);
    head.hidden = rows.length === 0 && rims === 0;
    const wanted = ties.reduce((n, t, i) => n + (none || own[i] ? t.lost + (beyond.checked ? t.beyond_rim : 0) : 0), 0);
    count.textContent = rows.length > 0 ? plural(rows.length, "node", "nodes") : "";
    const unknown = ties.filter((t, i) => (none || own[i]) && !t.evaluated).length;
    said.textContent = rows.length < wanted ? `The first ${group(rows.length)} of ${group(wanted)} are listed.`
      : rows.length === 0 ? (unknown > 0 ? `${plural(unknown, "tie", "ties")} could not be evaluated.` : "Every node is tied or held by something else.") : "";
    list.setSelected(ties.find((t) => t.interface === inter) ?? null, false);
  };
  report.on("filter", draw);
  draw();
  return h("section", { id: "ties" },
    sectionHead(h("h2", null, "Ties", h("span", { class: "muted count" }, plural(ties.length, "tie", "ties"))), list.chooser()),
    list.element,
    said,
    head,
    table.element);
}
