// The gap report beside the text: made by `deck gaps --html`, shown in a panel, and tied to the text in
// both directions (bridge.ts speaks for the page).
import * as vscode from "vscode";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, isAbsolute, join, resolve } from "node:path";
import { deckOf } from "./deck_of";
import type { FromPage, Place, ToPage } from "./messages";
import { headerAbove, withScript } from "./page";
import { reportCall } from "./program";
import { run } from "./run";
import { settings } from "./settings";

const most = 100 << 20; // bytes of a page for a panel; larger ones are for a browser

/** Somebody else's line: the editor shows the file beside the report and marks the line. */
async function open(place: Place, deck: vscode.Uri, focus: boolean): Promise<void> {
  const uri = vscode.Uri.file(isAbsolute(place.file) ? place.file : resolve(dirname(deck.fsPath), place.file));
  const shown = vscode.window.visibleTextEditors.find((e) => e.document.uri.fsPath === uri.fsPath);
  const line = Math.max(0, place.line - 1);
  const selection = new vscode.Range(line, 0, line, 0);
  await vscode.window.showTextDocument(uri, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One, preserveFocus: !focus, preview: true, selection });
}

class Panel {
  private chosen: { interface: number | null; key: string | null } = { interface: null, key: null };
  private readonly panel: vscode.WebviewPanel;
  private work: vscode.CancellationTokenSource | null = null;
  private ready = false;
  private waiting: ToPage | null = null; // asked for before the page was there

  constructor(
    private readonly program: string,
    private readonly bridge: string,
    readonly deck: vscode.Uri,
    private readonly channel: vscode.LogOutputChannel,
    closed: () => void,
  ) {
    const title = `Gaps of ${deck.path.split("/").at(-1)}`;
    this.panel = vscode.window.createWebviewPanel("deck.report", title, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { enableScripts: true, retainContextWhenHidden: true, enableFindWidget: true });
    this.panel.webview.onDidReceiveMessage((m: FromPage) => void this.heard(m));
    this.panel.onDidDispose(() => {
      this.work?.cancel();
      closed();
    });
  }

  reveal(): void {
    this.panel.reveal(undefined, true);
  }

  /** Runs the program and shows the page it writes. */
  async refresh(): Promise<void> {
    this.work?.cancel();
    const work = (this.work = new vscode.CancellationTokenSource());
    const folder = mkdtempSync(join(tmpdir(), "deck-report-"));
    try {
      const to = join(folder, "report.html");
      const said = await vscode.window.withProgress({ location: vscode.ProgressLocation.Window, title: "Searching for penetrations" }, () =>
        run(this.program, reportCall(settings(this.deck), this.deck.fsPath, to), this.deck.fsPath, work.token));
      if (work.token.isCancellationRequested) return;
      let html: Buffer;
      try {
        html = readFileSync(to);
      } catch {
        this.channel.error(said.error);
        void vscode.window.showErrorMessage(`The report could not be made: ${said.error.trim().split("\n")[0] || `exit code ${said.code}`}`);
        return;
      }
      if (html.length > most) {
        void vscode.window.showWarningMessage(`The report has ${Math.round(html.length / (1 << 20))} MB, too much for a panel. Open it in a browser: deck gaps ${this.deck.fsPath} --html report.html`);
        return;
      }
      this.ready = false;
      this.panel.webview.html = withScript(html.toString("utf8"), this.bridge);
    } finally {
      rmSync(folder, { recursive: true, force: true });
      if (this.work === work) this.work = null;
    }
  }

  private post(message: ToPage): void {
    this.waiting = this.ready ? null : message;
    if (this.ready) void this.panel.webview.postMessage(message);
  }

  private async heard(m: FromPage): Promise<void> {
    const follow = vscode.workspace.getConfiguration("deck", this.deck).get<string>("report.follow", "card");
    switch (m.type) {
      case "ready":
        this.ready = true;
        if (this.waiting) this.post(this.waiting);
        else if (this.chosen.key !== null || this.chosen.interface !== null) this.post({ type: "restore", ...this.chosen });
        break;
      case "selected": {
        this.chosen.key = m.key;
        const to = follow === "node" ? (m.node ?? m.card) : m.card;
        if (follow !== "off") await open(to, this.deck, false);
        vscode.window.setStatusBarMessage(`$(link) ${m.pair}`, 4000);
        break;
      }
      case "interface":
        this.chosen.interface = m.id;
        if (follow !== "off") await open(m.card, this.deck, false);
        break;
      case "open":
        await open(m.place, this.deck, true);
        break;
      case "shown":
        vscode.window.setStatusBarMessage(m.what ? `$(link) ${m.what}` : "Nothing of the report stands on this line", 4000);
        break;
    }
  }

  /** Chooses in the page what stands on a line of the text. */
  show(document: vscode.TextDocument, line: number): void {
    this.post({ type: "show", file: document.uri.fsPath, line: line + 1, header: headerAbove((at) => document.lineAt(at - 1).text, line + 1) });
  }
}

export class Reports implements vscode.Disposable {
  private readonly panels = new Map<string, Panel>();
  private readonly listeners: vscode.Disposable[];

  /** `bridge`: the script for the page. */
  constructor(
    private readonly program: string,
    private readonly bridge: string,
    private readonly channel: vscode.LogOutputChannel,
  ) {
    this.listeners = [
      vscode.workspace.onDidSaveTextDocument((d) => {
        if (d.languageId !== "radioss" || !vscode.workspace.getConfiguration("deck", d).get("report.refreshOnSave", true)) return;
        for (const p of this.panels.values()) void p.refresh();
      }),
      // What the report itself shows in the text is no choice of the user.
      vscode.window.onDidChangeTextEditorSelection((e) => {
        const byHand = e.kind === vscode.TextEditorSelectionChangeKind.Mouse;
        if (!byHand || e.textEditor.document.languageId !== "radioss" || this.panels.size !== 1) return;
        if (vscode.workspace.getConfiguration("deck", e.textEditor.document).get<string>("report.follow", "card") === "off") return;
        for (const p of this.panels.values()) p.show(e.textEditor.document, e.selections[0].active.line);
      }),
    ];
  }

  async show(): Promise<void> {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || document.languageId !== "radioss") {
      void vscode.window.showInformationMessage("Open a Radioss deck first.");
      return;
    }
    const deck = await deckOf(document.uri);
    if (!deck) return;
    const dirty = vscode.workspace.textDocuments.filter((d) => d.isDirty && d.languageId === "radioss");
    if (dirty.length > 0) {
      const answer = await vscode.window.showWarningMessage("The report is made from the files on disk, and the text has changes.", "Save", "Use the Files");
      if (!answer) return;
      if (answer === "Save") for (const d of dirty) await d.save();
    }
    let panel = this.panels.get(deck.toString());
    if (panel) panel.reveal();
    else {
      const key = deck.toString();
      panel = new Panel(this.program, this.bridge, deck, this.channel, () => this.panels.delete(key));
      this.panels.set(key, panel);
    }
    await panel.refresh();
  }

  /** Chooses in the report what stands on the line of the cursor; opens the report if need be. */
  async showLine(): Promise<void> {
    const editor = vscode.window.activeTextEditor;
    if (!editor) return;
    const deck = await deckOf(editor.document.uri);
    const open = deck && this.panels.get(deck.toString());
    if (!open) await this.show();
    else open.reveal();
    (deck && this.panels.get(deck.toString()))?.show(editor.document, editor.selection.active.line);
  }

  dispose(): void {
    for (const l of this.listeners) l.dispose();
  }
}
