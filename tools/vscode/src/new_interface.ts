// A new interface: where it goes, which id is free and which types there are, all asked of the server,
// which writes the card itself (`deck.insertCard`). Knows nothing of the editor.

export interface Position {
  line: number;
  character: number;
}
interface Symbol {
  name: string;
  selectionRange: { start: Position };
}
interface Item {
  label: string;
  detail: string;
}
export type Ask = <T>(method: string, params: object) => Promise<T>;

export interface Plan {
  position: Position; // in the block behind which the new one goes
  id: number;
  keywords: Item[]; // those whose cards the server knows in this version, by number
}

/** Behind the last interface of the file, or, if it has none, behind the block of the cursor; never inside a submodel,
 *  whose ids are others. */
function behind(symbols: Symbol[], cursor: Position): Symbol | undefined {
  let inside = 0;
  let last: Symbol | undefined;
  let here: Symbol | undefined;
  for (const s of symbols) {
    if (s.name.startsWith("//SUBMODEL")) ++inside;
    if (s.name.startsWith("//ENDSUB")) --inside;
    if (inside > 0) continue;
    if (s.name.startsWith("/INTER/")) last = s;
    if (!here || s.selectionRange.start.line <= cursor.line) here = s;
  }
  return last ?? here;
}

/** null: the file has no block behind which one could go. */
export async function planOf(ask: Ask, textDocument: { uri: string }, cursor: Position): Promise<Plan | null> {
  const symbols = (await ask<Symbol[] | null>("textDocument/documentSymbol", { textDocument })) ?? [];
  const block = behind(symbols, cursor);
  if (!block) return null;
  const position = block.selectionRange.start;
  // The ids of this file are known; those of other files are asked for.
  let id = 1 + Math.max(0, ...symbols.map((s) => Number(s.name.match(/^\/INTER\/(?:[A-Z]\w*\/)+(\d+)/)?.[1] ?? 0)));
  while (await ask("deck/locate", { textDocument, kind: "inter", id })) ++id;
  const { items } = await ask<{ items: Item[] }>("textDocument/completion", { textDocument, position: { line: position.line, character: 1 } });
  const whole = new Set(items.map((i) => i.label)); // 'KEYWORD …' stands for all lines of a card
  const keywords = items.filter((i) => i.label.startsWith("/INTER/") && whole.has(`${i.label} …`)).map(({ label, detail }) => ({ label, detail }));
  const parts = (k: Item) => k.label.split("/").length; // /INTER/LAGMUL/TYPE7 goes behind the others
  return { position, id, keywords: keywords.sort((a, b) => parts(a) - parts(b) || a.label.localeCompare(b.label, "en", { numeric: true })) };
}
