// The gap report beside the text: made by the server from the text as it stands in the editor, shown in a
// panel, and tied to the text in both directions (bridge.ts speaks for the page).
import * as vscode from "vscode";
import { dirname, isAbsolute, resolve } from "node:path";
import type { LanguageClient } from "vscode-languageclient/node";
import type { Chosen, FromPage, Place, ToPage } from "./messages";
import { headerAbove, withScript } from "./page";

const most = 100 << 20; // characters of a page for a panel; larger ones are for a browser

/** The editor shows a line, beside the report if that is open. */
export async function open(place: Place, deck: vscode.Uri, focus: boolean): Promise<void> {
  const uri = vscode.Uri.file(isAbsolute(place.file) ? place.file : resolve(dirname(deck.fsPath), place.file));
  const shown = vscode.window.visibleTextEditors.find((e) => e.document.uri.fsPath === uri.fsPath);
  const line = Math.max(0, place.line - 1);
  const selection = new vscode.Range(line, 0, line, 0);
  await vscode.window.showTextDocument(uri, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One, preserveFocus: !focus, preview: true, selection });
}

const follows = (of: vscode.Uri): string => vscode.workspace.getConfiguration("deck", of).get<string>("report.follow", "card");

/** There is one panel: the report of the deck that was asked for last. */
export class Report implements vscode.Disposable {
  private panel: vscode.WebviewPanel | null = null;
  private document: vscode.Uri | null = null; // the deck, or a file that it includes
  private chosen: Chosen = { interface: null, key: null };
  private ready = false;
  private waiting: ToPage | null = null; // asked for before the page was there
  private work: vscode.CancellationTokenSource | null = null;
  private readonly listeners: vscode.Disposable[];

  /** `bridge`: the script for the page. */
  constructor(
    private readonly client: LanguageClient,
    private readonly bridge: string,
  ) {
    this.listeners = [
      vscode.workspace.onDidSaveTextDocument((d) => {
        if (this.panel && d.languageId === "radioss" && vscode.workspace.getConfiguration("deck", d).get("report.refreshOnSave", true)) void this.refresh();
      }),
      vscode.window.onDidChangeTextEditorSelection((e) => {
        // What the report itself shows in the text is no choice of the user.
        const byHand = e.kind === vscode.TextEditorSelectionChangeKind.Mouse;
        if (byHand && this.panel && e.textEditor.document.languageId === "radioss" && follows(e.textEditor.document.uri) !== "off") this.choose(e.textEditor);
      }),
    ];
  }

  /** Shows the report of a deck or of the deck that includes a file; `interface`: only that one at first. */
  async show(document: vscode.Uri, id: number | null = null): Promise<void> {
    const another = this.document?.toString() !== document.toString();
    this.document = document;
    if (another || id !== null) this.chosen = { interface: id, key: null };
    if (!this.panel) {
      this.panel = vscode.window.createWebviewPanel("deck.report", "Gaps", { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { enableScripts: true, retainContextWhenHidden: true, enableFindWidget: true });
      this.panel.webview.onDidReceiveMessage((m: FromPage) => void this.heard(m));
      this.panel.onDidDispose(() => {
        this.work?.cancel();
        this.panel = null;
        this.ready = false;
      });
    }
    this.panel.title = `Gaps of ${document.path.split("/").at(-1)}`;
    this.panel.reveal(undefined, true);
    await this.refresh();
  }

  /** Makes the page again and keeps the selection. */
  private async refresh(): Promise<void> {
    this.work?.cancel();
    const work = (this.work = new vscode.CancellationTokenSource());
    const textDocument = { uri: this.client.code2ProtocolConverter.asUri(this.document!) };
    try {
      const { html } = await vscode.window.withProgress({ location: vscode.ProgressLocation.Window, title: "Searching for penetrations" }, () => this.client.sendRequest<{ html: string }>("deck/gapReport", { textDocument }, work.token));
      if (work.token.isCancellationRequested || !this.panel) return;
      if (html.length > most) {
        void vscode.window.showWarningMessage(`The report has ${Math.round(html.length / (1 << 20))} MB, too much for a panel. 'deck gaps --html' writes it for a browser.`);
        return;
      }
      this.ready = false;
      this.panel.webview.html = withScript(html, this.bridge);
    } catch (e) {
      if (!work.token.isCancellationRequested) void vscode.window.showErrorMessage(`The report could not be made: ${e instanceof Error ? e.message : String(e)}`);
    }
  }

  private post(message: ToPage): void {
    this.waiting = this.ready ? null : message;
    if (this.ready) void this.panel?.webview.postMessage(message);
  }

  private async heard(m: FromPage): Promise<void> {
    const deck = this.document!;
    const follow = follows(deck);
    switch (m.type) {
      case "ready":
        this.ready = true;
        if (this.waiting) this.post(this.waiting);
        else if (this.chosen.key !== null || this.chosen.interface !== null) this.post({ type: "restore", ...this.chosen });
        break;
      case "selected":
        this.chosen.key = m.key;
        if (follow !== "off") await open(follow === "node" ? (m.node ?? m.card) : m.card, deck, false);
        vscode.window.setStatusBarMessage(`$(link) ${m.pair}`, 4000);
        break;
      case "interface":
        this.chosen.interface = m.id;
        if (m.card && follow !== "off") await open(m.card, deck, false);
        break;
      case "open":
        await open(m.place, deck, true);
        break;
      case "shown":
        this.chosen = m.chosen;
        vscode.window.setStatusBarMessage(m.what ? `$(link) ${m.what}` : "The report has nothing on this line", 4000);
        break;
    }
  }

  private choose(editor: vscode.TextEditor): void {
    const line = editor.selection.active.line + 1;
    this.post({ type: "show", file: editor.document.uri.fsPath, line, header: headerAbove((at) => editor.document.lineAt(at - 1).text, line) });
  }

  /** Chooses in the report what stands on the line of the cursor; opens the report if need be. */
  async showLine(editor: vscode.TextEditor): Promise<void> {
    if (this.panel) this.panel.reveal(undefined, true);
    else await this.show(editor.document.uri);
    this.choose(editor);
  }

  dispose(): void {
    for (const l of this.listeners) l.dispose();
    this.panel?.dispose();
  }
}
