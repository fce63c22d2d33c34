// The tree of a deck, from what `deck gaps --json` and `deck parts --json` say: files that it includes,
// interfaces with level and depth, parts. Knows nothing of the editor.
import type { Place } from "./messages";

/** Of the deck or of an interface (schemas/output/gaps.schema.json). */
export type Level = "stops" | "penetrates" | "crossed" | "untied" | "not-examined" | "warnings" | "remarks" | "clean";

export interface Row {
  label: string;
  description: string;
  tooltip: string;
  icon: Level | "group" | "include" | "part" | "unseen";
  place?: Place; // where a click goes
  find?: { kind: "inter" | "part"; id: number }; // to be asked for with `deck/locate`
  rows: Row[];
}

interface Tie {
  id: number;
  type: number;
  title: string;
  level: Level;
  not_evaluated: string | null;
  summary: { nodes: number; tied: number };
}
export interface Gaps {
  deck: { path: string; title: string; includes: { path: string; written: string; from: Place }[] };
  verdict: { level: Level; text: string };
  interfaces: { id: number; type: number; title: string; source: Place; level: Level; max_depth: number | null; max_ratio: number | null }[];
  ties: Tie[];
  not_examined: { keyword: string; ids: number[] }[];
}
export interface Parts {
  parts: { id: number; title: string; mass: number | null; dt: { min: number | null }; interfaces: number[] }[];
  unconnected: { unseen_parts: number[] };
}

const short = (x: number): string => String(Number(x.toPrecision(3)));

function interfaceRows(gaps: Gaps): Row[] {
  // What matters most comes first: a view is narrow.
  const row = (id: number, title: string, type: string, level: Level, more: string, place?: Place) =>
    ({ id, label: `${id} ${title}`.trim(), description: `${level}${more && `, ${more}`} · ${type}`, tooltip: `/INTER/${type}/${id} ${title}`, icon: level, place, find: { kind: "inter" as const, id }, rows: [] });
  const depth = (i: Gaps["interfaces"][0]) => (i.max_depth ? `${short(i.max_depth)} deep, ${short(100 * (i.max_ratio ?? 0))} % of the gap` : "");
  return [
    ...gaps.interfaces.map((i) => row(i.id, i.title, `TYPE${i.type}`, i.level, depth(i), i.source)),
    ...gaps.ties.map((t) => row(t.id, t.title, `TYPE${t.type}`, t.level, t.not_evaluated ?? `${t.summary.tied} of ${t.summary.nodes} nodes tied`)),
    ...gaps.not_examined.flatMap((n) => n.ids.map((id) => row(id, "", n.keyword.replace("/INTER/", ""), "not-examined", ""))),
  ].sort((a, b) => a.id - b.id);
}

/** What a file includes; a file that includes itself is no reason to go on for ever. */
function includeRows(gaps: Gaps, file: string, above: string[] = []): Row[] {
  const inside = gaps.deck.includes.filter((i) => i.from.file === file && !above.includes(i.path));
  return inside.map((i) => ({ label: i.written, description: "", tooltip: `${i.path}, included in line ${i.from.line} of ${file}`, icon: "include", place: { file: i.path, line: 1 }, rows: includeRows(gaps, i.path, [...above, file]) }));
}

function partRows({ parts, unconnected }: Parts): Row[] {
  return parts.map((p) => {
    const unseen = unconnected.unseen_parts.includes(p.id);
    const said = [p.mass === null ? "" : `mass ${short(p.mass)}`, p.dt.min === null ? "" : `time step ${short(p.dt.min)}`, unseen ? "no contact sees it" : ""];
    return { label: `${p.id} ${p.title}`.trim(), description: said.filter(Boolean).join(", "), tooltip: `/PART/${p.id} ${p.title}${p.interfaces.length ? `, seen by interfaces ${p.interfaces.join(", ")}` : ""}`, icon: unseen ? "unseen" : "part", find: { kind: "part", id: p.id }, rows: [] };
  });
}

/** The row of the deck with all others below it; `parts`: null if they could not be had. */
export function treeOf(gaps: Gaps, parts: Parts | null): Row {
  const group = (label: string, rows: Row[]): Row[] => (rows.length ? [{ label, description: String(rows.length), tooltip: label, icon: "group", rows }] : []);
  const rows = [...group("Includes", includeRows(gaps, gaps.deck.path)), ...group("Interfaces", interfaceRows(gaps)), ...group("Parts", parts ? partRows(parts) : [])];
  const name = gaps.deck.path.split(/[\\/]/).at(-1) ?? "";
  return { label: name, description: gaps.verdict.level, tooltip: `${gaps.deck.title}\n\n${gaps.verdict.text}`, icon: gaps.verdict.level, place: { file: gaps.deck.path, line: 1 }, rows };
}
