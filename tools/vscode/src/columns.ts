// The column ruler of one card: which characters belong to which field, what stands to the right of a
// line that ends early, what the status bar says. Knows nothing of the editor.

/** A cell of a card as the server describes it; characters count from 0, `end` is behind the last. */
export interface Cell {
  name: string;
  start: number;
  end: number;
  type: string;
  doc?: string;
  unit?: string;
}

/** Answer to `deck/card`: the card on the line that was asked for. */
export interface CardLayout {
  keyword: string;
  card: string;
  cells: Cell[];
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
  const cells = [...layout.cells].sort((a, b) => a.start - b.start);
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
    tooltip: current ? [`${layout.keyword}, ${layout.card}: ${current.name} (${[current.type, current.unit].filter(Boolean).join(", ")})`, current.doc].filter(Boolean).join("\n\n") : `${layout.keyword}, ${layout.card}`,
  };
}

/** The cell under the cursor; behind the last column of a cell the cursor is still in it unless the next begins there. */
export function cellAt(cells: Cell[], character: number): Cell | null {
  return cells.find((c) => c.start <= character && character < c.end) ?? cells.find((c) => c.end === character) ?? null;
}

/** Where Tab goes: the last character of the next cell, where a number ends; null: there is none. */
export function nextCell(cells: Cell[], character: number, step: 1 | -1): Cell | null {
  const sorted = [...cells].sort((a, b) => a.start - b.start);
  const here = cellAt(sorted, character);
  if (here) return sorted[sorted.indexOf(here) + step] ?? null;
  return (step === 1 ? sorted.find((c) => c.start > character) : sorted.findLast((c) => c.end <= character)) ?? null;
}
