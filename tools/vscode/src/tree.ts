// The tree of a deck, from what `deck gaps --json` and `deck parts --json` say: files that it includes,
// interfaces with level and depth, parts. Knows nothing of the editor.
import type { Place } from "./messages";

/** Of a verdict (schemas/output/gaps.schema.json). */
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

interface Contact {
  evaluated: boolean;
  obstacle: string | null;
  totals: { pairs: number; nodes: number; edges: number; solver_errors: number; crossed_elements: number | null; max_depth: number | null; max_ratio: number | null };
}
interface Tie {
  id: number;
  type: number;
  title: string;
  not_evaluated: string | null;
  nodes: { tied: boolean; message: number | null }[];
  main_and_tied: number[];
  summary: { nodes: number; tied: number; not_found: number; dropped: number };
}
export interface Gaps {
  deck: { path: string; title: string; includes: { path: string; written: string; from: Place }[] };
  verdict: { level: Level; text: string };
  interfaces: { id: number; type: number; title: string; source: Place; contacts: Contact[] }[];
  ties: Tie[];
  not_examined: { keyword: string; ids: number[] }[];
}
export interface Parts {
  parts: { id: number; title: string; mass: number | null; dt: { min: number | null }; interfaces: number[] }[];
  unconnected: { unseen_parts: number[] };
}

const short = (x: number): string => String(Number(x.toPrecision(3)));
const stopping = ["no_gap", "no_area", "no_element"];
const idle = ["empty_main", "empty_secondary", "no_gap", "no_stiffness"];

/** The deck's verdict has the level of all interfaces; this is the one of an interface alone: the first that applies. */
function levelOf(contacts: Contact[]): Level {
  const any = (f: (c: Contact) => boolean) => contacts.some(f);
  const obstacle = (c: Contact, of: string[]) => c.evaluated && c.obstacle !== null && of.includes(c.obstacle);
  if (any((c) => c.totals.solver_errors > 0 || obstacle(c, stopping))) return "stops";
  if (any((c) => c.totals.pairs > 0)) return "penetrates";
  if (any((c) => (c.totals.crossed_elements ?? 0) > 0)) return "crossed";
  return any((c) => !c.evaluated || obstacle(c, idle)) ? "not-examined" : "clean";
}

function levelOfTie(t: Tie): Level {
  if (t.not_evaluated !== null) return "not-examined";
  if (t.main_and_tied.length > 0 || t.nodes.some((n) => n.message === 1078)) return "stops";
  return t.summary.not_found + t.summary.dropped > 0 ? "untied" : "clean";
}

function interfaceRows(gaps: Gaps): Row[] {
  // What matters most comes first: a view is narrow.
  const row = (id: number, title: string, type: string, level: Level, more: string, place?: Place) =>
    ({ id, label: `${id} ${title}`.trim(), description: `${level}${more && `, ${more}`} · ${type}`, tooltip: `/INTER/${type}/${id} ${title}`, icon: level, place, find: { kind: "inter" as const, id }, rows: [] });
  const largest = (contacts: Contact[], what: "max_depth" | "max_ratio") => Math.max(0, ...contacts.map((c) => c.totals[what] ?? 0));
  const depth = (c: Contact[]) => (largest(c, "max_depth") > 0 ? `${short(largest(c, "max_depth"))} deep, ${short(100 * largest(c, "max_ratio"))} % of the gap` : "");
  return [
    ...gaps.interfaces.map((i) => row(i.id, i.title, `TYPE${i.type}`, levelOf(i.contacts), depth(i.contacts), i.source)),
    ...gaps.ties.map((t) => row(t.id, t.title, `TYPE${t.type}`, levelOfTie(t), t.not_evaluated ?? `${t.summary.tied} of ${t.summary.nodes} nodes tied`)),
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
