// The extension: starts `deck lsp` and adds what an editor cannot ask a server for (ruler, report, commands).
import * as vscode from "vscode";
import { LanguageClient, TransportKind } from "vscode-languageclient/node";
import { toggled } from "./comments";
import { registerCommands } from "./commands";
import { noServer, notFound, serverCall, serverOptions } from "./program";
import { Report } from "./report";
import { RulerView } from "./ruler";
import { run } from "./run";
import { program, settings } from "./settings";
import { showText, textProvider } from "./texts";

const alone = ["deck.restart", "deck.toggleComment"]; // need no program
let client: LanguageClient | undefined;
let parts: vscode.Disposable[] = [];

async function stop(): Promise<void> {
  for (const p of parts) p.dispose();
  parts = [];
  void vscode.commands.executeCommand("setContext", "deck.running", false);
  const old = client;
  client = undefined;
  await old?.dispose(2000).catch(() => undefined);
}

/** The editor's own command would put the mark where the text begins, which makes another card of the line. */
async function toggleComment(): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (!editor) return;
  const ranges = editor.selections.map((s) => {
    // A selection that ends before a line's first character does not mean that line.
    const last = s.end.line > s.start.line && s.end.character === 0 ? s.end.line - 1 : s.end.line;
    return new vscode.Range(s.start.line, 0, last, editor.document.lineAt(last).text.length);
  });
  await editor.edit((e) => {
    for (const r of ranges) e.replace(r, toggled(editor.document.getText(r).split(/\r?\n/)).join(editor.document.eol === vscode.EndOfLine.LF ? "\n" : "\r\n"));
  });
}

/** Without a program every command says what is missing. */
function missing(context: vscode.ExtensionContext, why: string): void {
  const say = async () => {
    if ((await vscode.window.showErrorMessage(why, "Open Settings")) === "Open Settings") await vscode.commands.executeCommand("workbench.action.openSettings", "deck.path");
  };
  const commands: { command: string }[] = context.extension.packageJSON.contributes.commands;
  parts = commands.filter((c) => !alone.includes(c.command)).map((c) => vscode.commands.registerCommand(c.command, say));
  void say();
}

// Over 80 lines: the commands share the client, which lives as long as they do.
async function start(context: vscode.ExtensionContext, channel: vscode.LogOutputChannel): Promise<void> {
  await stop();
  const s = settings();
  const deck = program(s);
  if (deck === null) return missing(context, notFound(s.path));
  if ((await run(deck, ["lsp", "--help"], context.extensionPath)).code !== 0) return missing(context, noServer(deck));
  channel.info(`${deck} ${serverCall(s).join(" ")}`);
  const server = new LanguageClient(
    "deck",
    "libdeck",
    { command: deck, args: serverCall(s), transport: TransportKind.stdio },
    {
      documentSelector: [{ language: "radioss", scheme: "file" }],
      initializationOptions: serverOptions(s),
      outputChannel: channel,
      middleware: {
        // The server's commands are known by name; these two want a window.
        executeCommand: (name, [argument], next) => (name === "deck.explain" ? explain(argument.topic) : name === "deck.openGapReport" ? showReport(argument) : next(name, [argument])),
        provideInlayHints: async (document, range, cancel, next) => (await next(document, range, cancel))?.filter((h) => !ruler.covers(document, h.position.line)),
      },
    },
  );
  const report = new Report(server);
  const ruler = new RulerView(server);
  const explain = async (topic: string) => {
    const { text } = await server.sendRequest<{ text: string }>("deck/explain", { topic });
    await showText(topic.replaceAll("/", " ").trim(), text);
  };
  /** From a lens, or from the palette without its document. */
  const showReport = async (of?: { textDocument?: { uri: string } }) => {
    const uri = of?.textDocument ? server.protocol2CodeConverter.asUri(of.textDocument.uri) : deckEditor()?.document.uri;
    if (uri) await report.show(uri);
  };
  const deckEditor = () => {
    const editor = vscode.window.activeTextEditor;
    if (editor?.document.languageId === "radioss") return editor;
    void vscode.window.showInformationMessage("Open a Radioss deck first.");
    return undefined;
  };
  /** The keyword above the cursor is offered; a field, a rule or a message of the solver can be asked for as well. */
  const explainHere = async () => {
    const editor = deckEditor();
    if (!editor) return;
    let line = editor.selection.active.line;
    while (line > 0 && !editor.document.lineAt(line).text.startsWith("/")) line--;
    const value = editor.document.lineAt(line).text.trim().replace(/\/\d+$/, "");
    const topic = await vscode.window.showInputBox({ prompt: "Keyword, field, rule (DK301) or message of the solver (611)", value });
    if (topic) await explain(topic);
  };
  const fixAll = async (unsafe: boolean) => {
    const editor = deckEditor();
    if (editor) await vscode.commands.executeCommand("deck.fixAll", { textDocument: server.code2ProtocolConverter.asTextDocumentIdentifier(editor.document), unsafe });
  };
  parts = [
    report,
    ruler,
    ...registerCommands(deck, channel),
    vscode.commands.registerCommand("deck.showGapReport", showReport),
    vscode.commands.registerCommand("deck.explainHere", explainHere),
    vscode.commands.registerCommand("deck.fixSafely", () => fixAll(false)),
    vscode.commands.registerCommand("deck.fixUnsafely", () => fixAll(true)),
    vscode.commands.registerCommand("deck.editField", () => ruler.edit()),
    vscode.commands.registerCommand("deck.nextField", () => ruler.go(1)),
    vscode.commands.registerCommand("deck.previousField", () => ruler.go(-1)),
  ];
  client = server;
  void vscode.commands.executeCommand("setContext", "deck.running", true);
  await server.start().catch((e: unknown) => channel.error(String(e)));
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const channel = vscode.window.createOutputChannel("libdeck", { log: true });
  context.subscriptions.push(
    channel,
    textProvider(),
    vscode.commands.registerCommand("deck.restart", () => start(context, channel)),
    vscode.commands.registerCommand("deck.toggleComment", toggleComment),
    vscode.workspace.onDidChangeConfiguration((e) => {
      if (["path", "includePaths", "arguments", "geometryOnSave"].some((k) => e.affectsConfiguration(`deck.${k}`))) void start(context, channel);
    }),
  );
  await start(context, channel);
}

export const deactivate = stop;
