// Columns of several tables, and names of parts and interfaces in them: ids are never cut, the common start of titles is folded,
// titles are cut in the middle.
import type { Units } from "schema/page";
import { h } from "../dom";
import type { Report } from "../report";
import { forceUnit } from "../scene/legend";
import type { Column } from "./table";

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
  const cell = (r: T) => {
    const p = report.meta.parts[part(r)];
    return p ? named(p.id, p.title, report.commonPrefix) : "(no part)";
  };
  return { key, title, kind: "text", value: text, text, cell, ...more };
}

/** Id and title of a part or interface: the id is never cut, the common start of titles is folded. */
export function named(id: number | string, title: string, prefix: string): HTMLElement {
  const folded = prefix !== "" && title.startsWith(prefix) && title.length > prefix.length;
  return h("span", { class: "named" },
    id === "" ? null : h("span", { class: "id" }, String(id)),
    title ? h("span", { class: `rest${folded ? " fold" : ""}` }, folded && h("i", null, "…"), ...cutInMiddle(folded ? title.slice(prefix.length) : title)) : null);
}

const tailLength = 9;
/** A text that keeps its end visible when cut: names mostly differ there. */
function cutInMiddle(text: string): HTMLElement[] {
  const at = text.length > 2 * tailLength ? text.length - tailLength : text.length;
  return [h("span", { class: "name-head" }, text.slice(0, at)), h("span", { class: "name-tail" }, text.slice(at))];
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
