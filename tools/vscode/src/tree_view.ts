// The view with the tree of the deck in the active editor, as it was saved (tree.ts says what is in it).
import * as vscode from "vscode";
import { statSync } from "node:fs";
import type { LanguageClient } from "vscode-languageclient/node";
import { deckOf } from "./deck_of";
import { gapsCall, partsCall } from "./program";
import { open } from "./report";
import { run, type Said } from "./run";
import { settings } from "./settings";
import { treeOf, type Gaps, type Parts, type Row } from "./tree";

const icon = (name: string, color?: string) => new vscode.ThemeIcon(name, color ? new vscode.ThemeColor(color) : undefined);
const warning = icon("warning", "list.warningForeground");
const icons: Record<Row["icon"], vscode.ThemeIcon | undefined> = {
  stops: icon("error", "list.errorForeground"), penetrates: warning, crossed: warning, untied: warning, warnings: warning, unseen: warning,
  remarks: icon("info"), "not-examined": icon("circle-slash"), clean: icon("pass", "testing.iconPassed"), include: icon("file-code"), part: icon("symbol-field"), group: undefined,
};

/** Changes when one of the files does. */
const stampOf = (files: string[]): string => files.map((f) => statSync(f, { throwIfNoEntry: false })?.mtimeMs ?? 0).join();

export class DeckTree implements vscode.TreeDataProvider<Row>, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<void>();
  readonly onDidChangeTreeData = this.changed.event;
  private readonly view = vscode.window.createTreeView("deck.tree", { treeDataProvider: this, showCollapseAll: true });
  private root: Row | null = null;
  private deck: vscode.Uri | undefined; // whose tree it is
  private files: string[] = []; // of the deck
  private unclear = ""; // a file that several decks may include: nobody is asked unless by hand
  private stamp = "";
  private timer: NodeJS.Timeout | undefined;
  private work: vscode.CancellationTokenSource | null = null;
  private readonly listeners: vscode.Disposable[];

  constructor(
    private readonly program: string,
    private readonly client: LanguageClient,
  ) {
    const soon = () => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => void this.refresh(false), 300);
    };
    this.listeners = [
      this.view,
      this.changed,
      this.view.onDidChangeVisibility(soon),
      vscode.window.onDidChangeActiveTextEditor(soon),
      vscode.workspace.onDidSaveTextDocument(soon),
      vscode.languages.onDidChangeDiagnostics(soon),
      vscode.commands.registerCommand("deck.refreshTree", () => this.refresh(true)),
      vscode.commands.registerCommand("deck.goToRow", (row: Row) => this.go(row)),
    ];
    soon();
  }

  getChildren(row?: Row): Row[] {
    return row ? row.rows : this.root ? [this.root] : [];
  }

  getTreeItem(row: Row): vscode.TreeItem {
    const { None, Collapsed, Expanded } = vscode.TreeItemCollapsibleState;
    const opened = row === this.root || row.label === "Interfaces";
    const item = new vscode.TreeItem(row.label, row.rows.length === 0 ? None : opened ? Expanded : Collapsed);
    item.description = row.description;
    item.tooltip = row.tooltip;
    item.iconPath = icons[row.icon];
    if (row.place || row.find) item.command = { command: "deck.goToRow", title: "Go to the Place", arguments: [row] };
    return item;
  }

  /** `asked`: by hand; else only if the view is seen, another deck is edited or a file of it has changed on disk. */
  private async refresh(asked: boolean): Promise<void> {
    const document = vscode.window.activeTextEditor?.document;
    if ((!asked && !this.view.visible) || (document?.languageId !== "radioss" && !this.deck)) return;
    const its = document?.languageId !== "radioss" || this.files.includes(document.uri.fsPath);
    if (!its && !asked && this.unclear === document.uri.fsPath) return;
    const deck = its ? this.deck : await deckOf(document.uri, asked);
    if (!deck) this.unclear = document?.uri.fsPath ?? "";
    if (!deck || (!asked && !settings(deck).geometryOnSave)) return;
    const same = deck.toString() === this.deck?.toString();
    if (!asked && same && this.stamp === stampOf(this.files)) return;
    this.work?.cancel();
    const work = (this.work = new vscode.CancellationTokenSource());
    this.deck = deck;
    if (!same) this.files = [deck.fsPath];
    this.stamp = stampOf(this.files);
    await vscode.window.withProgress({ location: { viewId: "deck.tree" } }, () => this.read(deck, work.token));
  }

  private async read(deck: vscode.Uri, cancel: vscode.CancellationToken): Promise<void> {
    const file = deck.fsPath;
    const ask = (call: string[]) => run(this.program, call, file, cancel);
    const [gaps, parts] = await Promise.all([ask(gapsCall(settings(deck), file)), ask(partsCall(settings(deck), file))]);
    if (cancel.isCancellationRequested) return;
    const fine = (s: Said) => s.code === 0 || s.code === 1; // 1: read, with findings
    this.view.message = [gaps, parts].find((s) => !fine(s))?.error.trim().split("\n")[0];
    this.root = null;
    if (fine(gaps)) {
      const said: Gaps = JSON.parse(gaps.out);
      this.root = treeOf(said, fine(parts) ? (JSON.parse(parts.out) as Parts) : null);
      this.files = [file, ...said.deck.includes.map((i) => i.path)];
      this.stamp = stampOf(this.files);
    }
    this.changed.fire();
  }

  private async go(row: Row): Promise<void> {
    if (!this.deck) return;
    if (row.place) return open(row.place, this.deck, true);
    const document = await vscode.workspace.openTextDocument(this.deck); // the server knows open decks
    const found = await this.client.sendRequest<{ uri: string; range: { start: { line: number } } } | null>("deck/locate", { textDocument: this.client.code2ProtocolConverter.asTextDocumentIdentifier(document), ...row.find });
    if (found) await open({ file: this.client.protocol2CodeConverter.asUri(found.uri).fsPath, line: found.range.start.line + 1 }, this.deck, true);
    else void vscode.window.showInformationMessage(`${row.tooltip} is not in the text any more.`);
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.work?.cancel();
    for (const l of this.listeners) l.dispose();
  }
}
