// The gap report beside the text: formed by the server from the text as it is in the editor, shown in a panel.
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";

const most = 100 << 20; // characters of a page for a panel; larger ones are for a browser

/** There is one panel: the report of the deck that was asked for last. */
export class Report implements vscode.Disposable {
  private panel: vscode.WebviewPanel | null = null;
  private document: vscode.Uri | null = null; // the deck, or a file that it includes
  private work: vscode.CancellationTokenSource | null = null;
  private readonly saved: vscode.Disposable;

  constructor(private readonly client: LanguageClient) {
    this.saved = vscode.workspace.onDidSaveTextDocument((d) => {
      if (this.panel && d.languageId === "radioss" && vscode.workspace.getConfiguration("deck", d).get("report.refreshOnSave", true)) void this.refresh();
    });
  }

  /** The report of a deck or of the deck that includes a file. */
  async show(document: vscode.Uri): Promise<void> {
    this.document = document;
    if (!this.panel) {
      this.panel = vscode.window.createWebviewPanel("deck.report", "Gaps", { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { enableScripts: true, retainContextWhenHidden: true, enableFindWidget: true });
      this.panel.onDidDispose(() => {
        this.work?.cancel();
        this.panel = null;
      });
    }
    this.panel.title = `Gaps of ${document.path.split("/").at(-1)}`;
    this.panel.reveal(undefined, true);
    await this.refresh();
  }

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
      this.panel.webview.html = html;
    } catch (e) {
      if (!work.token.isCancellationRequested) void vscode.window.showErrorMessage(`The report could not be formed: ${e instanceof Error ? e.message : String(e)}`);
    }
  }

  dispose(): void {
    this.saved.dispose();
    this.panel?.dispose();
  }
}
