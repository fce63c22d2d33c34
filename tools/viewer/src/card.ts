// Card of an interface with changed cells: only the columns of changed fields differ.
import { shortest } from "./dom";
import type { CardValues, Cell, InterfaceMeta } from "schema/page";

export type FieldName = Exclude<keyof CardValues, "Edge_scale_gap">;
export const fieldNames: FieldName[] = ["Igap", "Gapmin", "Fscalegap", "Gapmax", "Inacti", "Fpenmax"];
export type Overrides = Partial<Record<FieldName, number>>;

export interface ChangedCard {
  lines: { text: string; was: string | null }[]; // `was`: the line before a change
  notes: string[];
  changes: { line: number; first: number; last: number; was: string; text: string }[];
}

/** Text of a number for `width` columns with as many digits as fit; null if none fits. */
export function cellText(v: number, width: number): string | null {
  const full = shortest(v);
  if (full.length <= width) return full;
  for (let digits = 17; digits > 0; digits--) {
    for (const t of [v.toPrecision(digits), v.toExponential(digits - 1).replace("e+", "e")]) {
      const text = /[.e]/.test(t) ? t : `${t}.`;
      if (text.length <= width) return text;
    }
  }
  return null;
}

function newText(cell: Cell, value: number): string | null {
  const width = cell.last - cell.first + 1;
  if (cell.real) return cellText(value / cell.factor, width);
  // 0 would mean the default; some cells have a number for "off".
  const t = String(value === 0 ? cell.nothing : value);
  return t.length <= width ? t : null;
}

export function changedCard(inter: InterfaceMeta, overrides: Overrides): ChangedCard {
  const out: ChangedCard = { lines: inter.card.lines.map((text) => ({ text, was: null })), notes: [], changes: [] };
  for (const [name, value] of Object.entries(overrides) as [FieldName, number][]) {
    const cell = inter.card.cells.find((c) => c.field === name);
    if (!cell) {
      out.notes.push(`${name} has no cell on this card (input version or missing line).`);
      continue;
    }
    if (cell.free) { out.notes.push(`${name} is on a line with commas: change it by hand.`); continue; }
    const text = newText(cell, value);
    const line = out.lines[cell.line];
    if (text === null || !line) {
      out.notes.push(`${name} = ${value} does not fit its columns ${cell.first}–${cell.last}.`);
      continue;
    }
    if (cell.parameter) out.notes.push(`${name} was a parameter; the number replaces it.`);
    const padded = line.text.padEnd(cell.last, " ");
    const was = padded.slice(cell.first - 1, cell.last);
    line.was ??= line.text;
    line.text = padded.slice(0, cell.first - 1) + text.padStart(cell.last - cell.first + 1, " ") + padded.slice(cell.last);
    out.changes.push({ line: cell.line, first: cell.first, last: cell.last, was: was.trim(), text });
  }
  return out;
}

export function cardText(card: ChangedCard): string { return card.lines.map((l) => l.text).join("\n") + "\n"; }
