// Draws the column ruler: fields of the card under the cursor, their names behind the end of the line, and
// the field under the cursor in the status bar. The server says where the fields are.
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { cellAt, layoutOf, nextCell, ruler, type CardAnswer, type CardLayout } from "./columns";

const border = { borderStyle: "solid", borderWidth: "0 0 0 1px", borderColor: new vscode.ThemeColor("editorRuler.foreground") };
const even = vscode.window.createTextEditorDecorationType(border);
const odd = vscode.window.createTextEditorDecorationType({ ...border, backgroundColor: new vscode.ThemeColor("editor.hoverHighlightBackground") });
const current = vscode.window.createTextEditorDecorationType({ ...border, backgroundColor: new vscode.ThemeColor("editor.wordHighlightBackground") });
const tail = vscode.window.createTextEditorDecorationType({ after: { color: new vscode.ThemeColor("editorCodeLens.foreground") } });
const kinds = [even, odd, current, tail];

export class RulerView implements vscode.Disposable {
  private readonly status = vscode.window.createStatusBarItem("deck.field", vscode.StatusBarAlignment.Right, 101);
  private readonly listeners: vscode.Disposable[];
  private asked = 0;
  private drawn: { uri: string; line: number } | null = null; // the line with something behind its end

  constructor(private readonly client: LanguageClient) {
    this.status.name = "Field of the card";
    this.listeners = [
      vscode.window.onDidChangeTextEditorSelection((e) => void this.draw(e.textEditor)),
      vscode.window.onDidChangeActiveTextEditor((e) => void this.draw(e)),
      vscode.workspace.onDidChangeTextDocument((e) => {
        const editor = vscode.window.activeTextEditor;
        if (editor && e.document === editor.document) void this.draw(editor);
      }),
      vscode.workspace.onDidChangeConfiguration((e) => {
        if (e.affectsConfiguration("deck.ruler")) void this.draw(vscode.window.activeTextEditor);
      }),
    ];
    this.listeners.push(client.onDidChangeState(() => void this.draw(vscode.window.activeTextEditor)));
  }

  private async ask(editor: vscode.TextEditor): Promise<CardLayout | null> {
    if (!this.client.isRunning()) return null;
    const at = this.at(editor);
    const answer = await this.client.sendRequest<CardAnswer | null>("deck/card", at).catch(() => null);
    return layoutOf(answer, editor.document.lineAt(at.position.line).text);
  }

  private at(editor: vscode.TextEditor) {
    const { code2ProtocolConverter: to } = this.client;
    return { textDocument: to.asTextDocumentIdentifier(editor.document), position: to.asPosition(editor.selection.active) };
  }

  private async draw(editor: vscode.TextEditor | undefined): Promise<void> {
    const mine = ++this.asked;
    const wanted = editor?.document.languageId === "radioss" && vscode.workspace.getConfiguration("deck", editor.document).get("ruler.enabled", true);
    // The server, too, wants to know where the cursor is: for hints, and for findings on the line that is being typed.
    if (editor?.document.languageId === "radioss" && this.client.isRunning()) void this.client.sendNotification("deck/cursor", this.at(editor));
    const layout = editor && wanted ? await this.ask(editor) : null;
    if (mine !== this.asked) return; // the cursor went on
    this.drawn = null;
    if (!editor || !layout) {
      if (editor) for (const kind of kinds) editor.setDecorations(kind, []);
      this.status.hide();
      return;
    }
    const { line, character } = editor.selection.active;
    const text = editor.document.lineAt(line).text;
    const r = ruler(layout, text.length, character);
    if (r.tail) this.drawn = { uri: editor.document.uri.toString(), line };
    const range = (c: { start: number; end: number }) => new vscode.Range(line, c.start, line, c.end);
    editor.setDecorations(current, r.cells.filter((c) => c.current).map(range));
    editor.setDecorations(odd, r.cells.filter((c) => c.odd && !c.current).map(range));
    editor.setDecorations(even, r.cells.filter((c) => !c.odd && !c.current).map(range));
    const end = new vscode.Range(line, text.length, line, text.length);
    editor.setDecorations(tail, r.tail ? [{ range: end, renderOptions: { after: { contentText: r.tail } } }] : []);
    this.status.text = `$(symbol-ruler) ${r.status}`;
    this.status.tooltip = r.tooltip;
    this.status.show();
  }

  /** Moves the cursor to the next or the previous field; blanks are written where the line ends early. */
  async go(step: 1 | -1): Promise<void> {
    const editor = vscode.window.activeTextEditor;
    const layout = editor && (await this.ask(editor));
    const cell = editor && layout && nextCell(layout.cells, editor.selection.active.character, step);
    if (!cell) return;
    const { line } = editor.selection.active;
    const length = editor.document.lineAt(line).text.length;
    if (length < cell.start) await editor.edit((e) => e.insert(new vscode.Position(line, length), " ".repeat(cell.start - length)));
    editor.selection = new vscode.Selection(line, cell.start, line, cell.start);
    editor.revealRange(editor.selection);
  }

  /** Asks for a value of the field under the cursor; the server writes it where its columns end. */
  async edit(): Promise<void> {
    const editor = vscode.window.activeTextEditor;
    const layout = editor && (await this.ask(editor));
    const cell = editor && layout && cellAt(layout.cells, editor.selection.active.character);
    if (!cell) return void vscode.window.showInformationMessage("The cursor is on no field of a card.");
    const { textDocument, position } = this.at(editor);
    const old = editor.document.getText(new vscode.Range(position.line, cell.start, position.line, cell.end)).trim();
    const value = await vscode.window.showInputBox({ title: cell.about, prompt: cell.doc, value: old });
    if (value === undefined) return;
    await vscode.commands.executeCommand("deck.setField", { textDocument, position, field: cell.name, value });
  }

  /** Hints at the end of the line would push aside what the ruler draws there. */
  covers(document: vscode.TextDocument, line: number): boolean {
    return this.drawn?.line === line && this.drawn.uri === document.uri.toString();
  }

  dispose(): void {
    for (const l of this.listeners) l.dispose();
    for (const kind of kinds) vscode.window.activeTextEditor?.setDecorations(kind, []);
    this.status.dispose();
  }
}
