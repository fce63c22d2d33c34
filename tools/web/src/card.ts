// The cards of one entity: names of the fields over their columns, cells that can be written in,
// carets below the one in question.
import { h, replace } from "../../viewer/src/dom";
import { shown, type Mark } from "./text";

export interface Cell {
  field: string;
  columns: [number, number];
  text: string;
}
export interface Card {
  line: number;
  file: string;
  card: string;
  text: string;
  cells: Cell[];
}
export interface Shown {
  entity: { keyword: string; id: number; title: string };
  source: { file: string; line: number };
  cards: Card[];
}

/** `write`: puts a text into a cell; what it gives back says why not ("" for done). */
export type Write = (card: Card, cell: Cell, text: string) => string;

/** At most this many cards: sets and meshes have thousands. */
const MOST = 60;

function cellInput(card: Card, cell: Cell, hit: boolean, write: Write, say: (text: string) => void): HTMLElement {
  const [from, to] = cell.columns;
  const width = to - from + 1;
  const input = h("input", {
    class: hit ? "cell hit" : "cell", value: cell.text, "aria-label": `${cell.field}, line ${card.line}, columns ${from} to ${to}`,
    title: `${cell.field}: columns ${from} to ${to}`, spellcheck: "false", autocomplete: "off", "data-field": cell.field, style: `left:${from - 1}ch;width:${width}ch`,
  });
  const commit = () => {
    if (input.value === cell.text) return;
    const why = write(card, cell, input.value.trim());
    input.setAttribute("aria-invalid", String(why !== ""));
    say(why);
  };
  input.addEventListener("change", commit);
  input.addEventListener("keydown", (e) => {
    if (e.key === "Escape") {
      input.value = cell.text;
      say("");
    }
  });
  return input;
}

export function drawCards(into: HTMLElement, entity: Shown, mark: Mark & { file: string }, write: Write): void {
  const problem = h("p", { class: "note warn", role: "alert", hidden: true });
  const say = (text: string) => {
    problem.textContent = text;
    problem.hidden = text === "";
  };
  const rows: Node[] = [];
  const here = entity.cards.findIndex((c) => c.line === mark.line && c.file === mark.file);
  const first = Math.max(0, Math.min(here - MOST / 2, entity.cards.length - MOST));
  for (const card of entity.cards.slice(first, first + MOST)) {
    const marked = card.line === mark.line && card.file === mark.file;
    const width = Math.max(card.text.length, ...card.cells.map((c) => c.columns[1]), 1);
    const line = h("div", { class: "deck-card-line", style: `width:${width}ch` });
    if (card.cells.length === 0) line.append(h("span", { class: "deck-card-text" }, shown(card.text)));
    // Cells that share their columns (readings of different versions) are one input.
    const seen = new Map<number, string>();
    for (const c of card.cells) seen.set(c.columns[0], seen.has(c.columns[0]) ? `${seen.get(c.columns[0])}, ${c.field}` : c.field);
    for (const [at, field] of seen) {
      const c = card.cells.find((x) => x.columns[0] === at) as Cell;
      const hit = marked && mark.column <= c.columns[1] && mark.endColumn > c.columns[0];
      line.append(h("span", { class: "cell-name", title: field, style: `left:${at - 1}ch;width:${c.columns[1] - at + 1}ch` }, field));
      line.append(cellInput(card, { ...c, field }, hit, write, say));
    }
    const carets = marked ? h("div", { class: "carets", "aria-hidden": "true" }, " ".repeat(Math.max(0, mark.column - 1)) + "^".repeat(Math.max(1, Math.min(mark.endColumn, mark.column + 200) - mark.column))) : null;
    rows.push(h("div", { class: `deck-card${card.cells.length > 0 ? "" : " plain"}${marked ? " marked" : ""}` }, h("span", { class: "number", title: card.card }, card.line), h("div", null, line, carets)));
  }
  const left = entity.cards.length - Math.min(MOST, entity.cards.length);
  replace(
    into, h("h3", null, `${entity.entity.keyword}/${entity.entity.id} `, h("span", { class: "muted" }, entity.entity.title)),
    h("div", { class: "cards", tabindex: "0", role: "region", "aria-label": "Cards" }, ...rows), problem,
    left > 0 && h("p", { class: "note" }, `${left} more lines of this entity are in the text below.`),
  );
}
