// Which Starter deck a file belongs to: commands on an included file are about the deck that includes it.
import * as vscode from "vscode";
import { basename } from "node:path";

const starter = /_0000\.rad(\.gz)?$/i;
const chosen = new Map<string, vscode.Uri>();

/** The deck of `file`; `ask`: somebody if several may be meant; undefined: nobody chose. */
export async function deckOf(file: vscode.Uri, ask = true): Promise<vscode.Uri | undefined> {
  if (starter.test(file.path)) return file;
  const before = chosen.get(file.toString());
  if (before) return before;
  const decks = await vscode.workspace.findFiles("**/*_0000.rad", null, 200);
  const name = basename(file.path);
  const including: vscode.Uri[] = [];
  for (const deck of decks) {
    const text = Buffer.from(await vscode.workspace.fs.readFile(deck)).toString("latin1");
    if (text.includes(name)) including.push(deck);
  }
  const among = including.length > 0 ? including : decks;
  if (among.length === 0) return file;
  let deck: vscode.Uri | undefined = among[0];
  if (among.length > 1) {
    if (!ask) return undefined;
    const items = among.map((d) => ({ label: vscode.workspace.asRelativePath(d), deck: d }));
    deck = (await vscode.window.showQuickPick(items, { title: `Which deck includes ${name}?` }))?.deck;
  }
  if (deck) chosen.set(file.toString(), deck);
  return deck;
}
