// Columns of several tables, and names of parts and interfaces in them: ids are never cut, the common start of titles is folded,
// titles without room keep start and end.
import type { Units } from "schema/page";
import { h } from "../dom";
import type { Report } from "../report";
import { forceUnit } from "../scene/legend";
import { widthOf, type Column } from "./table";

const dimensions: Record<keyof Units | "force" | "energy", string[]> = {
  length: ["depth", "gap", "distance", "max", "mean", "p95", "gapmin", "room", "longest", "length", "dx", "dy", "dz", "thickness", "search", "farthest"],
  mass: ["mass"], time: ["step", "dt"], force: ["force", "largest"], energy: ["elastic"],
};
const unitOf = new Map<string, string>();
/** Before the first table: units of columns by their keys; a deck without units has none. */
export function setUnits(units: Units | null): void {
  const force = units && forceUnit(units);
  for (const [name, keys] of Object.entries(dimensions))
    for (const key of keys) if (units) unitOf.set(key, name === "force" ? force! : name === "energy" ? `${force}·${units.length}` : units[name as keyof Units]);
}
/** "Depth (mm)" */
export const headOf = (key: string, title: string): string => (unitOf.has(key) ? `${title} (${unitOf.get(key)})` : title);

/** Id of an interface, by its position. */
export function interfaceColumn<T>(report: Report, inter: (row: T) => number): Column<T> {
  const id = (r: T) => report.meta.interfaces[inter(r)].id;
  return { key: "inter", title: "Int.", hint: "Interface id", kind: "id", value: id, text: (r) => String(id(r)) };
}

/** Id and title of a part, by its position; -1: none. */
export function partColumn<T>(report: Report, key: string, title: string, part: (row: T) => number, more: Partial<Column<T>>): Column<T> {
  const text = (r: T) => report.partText(part(r));
  const cell = (r: T, room: number) => {
    const p = report.meta.parts[part(r)];
    return p ? named(p.id, p.title, report.commonPrefix, room) : "(no part)";
  };
  return { key, title, kind: "text", value: text, text, cell, ...more };
}

const dots = "…";
const cuts = new Map<string, string>();
/** Fits a text into `room` pixels: start (share `head`), dots, end; names mostly differ at the end, which starts with a word if one is near. */
function fitted(text: string, room: number, head = 0.4): string {
  const key = `${text}|${Math.floor(room)}|${head}`;
  let found = cuts.get(key);
  if (found !== undefined) return found;
  const cut = (n: number) => {
    if (n >= text.length) return text;
    const first = n < 12 ? 0 : Math.floor(head * n);
    return text.slice(0, first) + dots + text.slice(text.length - n + first).replace(/^[^\s_.:/-]{0,4}[\s_.:/-](?=.{6})/, "");
  };
  let [least, most] = [0, text.length];
  while (least < most) {
    const n = (least + most + 1) >> 1;
    if (widthOf(cut(n), false) <= room) least = n;
    else most = n - 1;
  }
  cuts.set(key, (found = cut(least)));
  return found;
}

/** Id and title of a part or interface in `room` pixels: the id is never cut, the common start of titles is folded. */
export function named(id: number | string, title: string, prefix: string, room: number): HTMLElement {
  const text = shortName(title, prefix, id === "" ? room : room - widthOf(String(id), false) - 6);
  return h("span", { class: "named", "data-name": title },
    id === "" ? null : h("span", { class: "id" }, String(id)),
    title ? h("span", { class: text === title ? "rest" : "rest fold" }, text) : null);
}
function shortName(title: string, prefix: string, left: number): string {
  const own = prefix !== "" && title.startsWith(prefix) ? title.slice(prefix.length) : "";
  const end = own === "" ? "" : fitted(own, left, 0);
  return own === "" ? fitted(title, left) : end !== own ? end : dots + (widthOf(dots + own, false) <= left ? own : own.slice(2));
}

/** Longest start, up to a separator, that most titles share; empty if not worth folding. */
export function commonStart(titles: string[]): string {
  const count = new Map<string, number>();
  for (const t of new Set(titles))
    for (let i = 8; i < t.length; i++) if (/[\s_\-.:/]/.test(t[i - 1])) count.set(t.slice(0, i), (count.get(t.slice(0, i)) ?? 0) + 1);
  const need = Math.max(3, 0.6 * new Set(titles).size);
  let best = "";
  for (const [prefix, n] of count) if (n >= need && prefix.length > best.length) best = prefix;
  return best;
}
