// The column ruler of one card: which characters belong to which field, what stands to the right of a
// line that ends early, what the status bar says. Knows nothing of the editor.

/** The server's answer to `deck/card`: the card on the line that was asked for (tools/docs/editors.md). */
export interface CardAnswer {
  keyword: string;
  card?: string; // not there: the line is no card
  cells?: { field: string; columns: [number, number]; label: string; used: string; doc: string }[];
}

/** A cell of a card; characters count from 0, `end` is behind the last. */
export interface Cell {
  name: string;
  start: number;
  end: number;
  about: string; // name, columns, type, unit and value in one line
  doc: string;
}

export interface CardLayout {
  keyword: string;
  card: string;
  cells: Cell[];
}

/** Columns are bytes and count from 1; a letter like é has two, but is one character. */
function characterAt(text: string, column: number): number {
  let bytes = 0;
  let at = 0;
  for (const c of text) {
    if (bytes >= column) return at;
    bytes += new TextEncoder().encode(c).length;
    at += c.length;
  }
  return at + column - bytes;
}

/** What the ruler needs of an answer; null: there is no card on the line, whose text is `text`. */
export function layoutOf(answer: CardAnswer | null, text: string): CardLayout | null {
  if (!answer?.card || !answer.cells?.length) return null;
  const cells = answer.cells.map((c) => ({
    name: c.field,
    start: characterAt(text, c.columns[0] - 1),
    end: characterAt(text, c.columns[1]),
    about: [c.label, c.used].filter(Boolean).join(": "),
    doc: c.doc,
  }));
  return { keyword: answer.keyword, card: answer.card, cells: cells.sort((a, b) => a.start - b.start) };
}

export interface Ruler {
  cells: { start: number; end: number; odd: boolean; current: boolean }[]; // within the line
  tail: string; // drawn behind the end of the line, with a stroke where a field begins
  status: string;
  tooltip: string;
}

const blank = "\u00a0"; // plain blanks would be drawn as one

/** `length`: of the line; `character`: where the cursor is. */
export function ruler(layout: CardLayout, length: number, character: number): Ruler {
  const { cells } = layout;
  const current = cellAt(cells, character);
  const right = cells.at(-1)?.end ?? 0;
  let tail = "";
  for (let at = length; at < right; ) {
    const begins = cells.find((c) => c.start === at);
    if (!begins) {
      tail += blank;
      ++at;
      continue;
    }
    // The name of the field, as much of it as fits between the strokes.
    const text = `│${begins.name}`.slice(0, begins.end - begins.start);
    tail += text.padEnd(begins.end - begins.start, blank);
    at = begins.end;
  }
  return {
    cells: cells.filter((c) => c.start < length).map((c) => ({ start: c.start, end: Math.min(c.end, length), odd: cells.indexOf(c) % 2 === 1, current: c === current })),
    tail: tail.trimEnd() === "" ? "" : tail,
    status: current ? `${current.name}  ${current.start + 1}–${current.end}` : `column ${character + 1}: no field`,
    tooltip: [`${layout.keyword}, ${layout.card}`, current?.about, current?.doc].filter(Boolean).join("\n\n"),
  };
}

/** The cell under the cursor; behind the last column of a cell the cursor is still in it unless the next begins there. */
export function cellAt(cells: Cell[], character: number): Cell | null {
  return cells.find((c) => c.start <= character && character < c.end) ?? cells.find((c) => c.end === character) ?? null;
}

/** The field behind the one under the cursor, or before it; null: there is none. */
export function nextCell(cells: Cell[], character: number, step: 1 | -1): Cell | null {
  const here = cellAt(cells, character);
  if (here) return cells[cells.indexOf(here) + step] ?? null;
  return (step === 1 ? cells.find((c) => c.start > character) : cells.findLast((c) => c.end <= character)) ?? null;
}
