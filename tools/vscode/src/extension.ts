// The extension: starts `deck lsp` and adds what an editor cannot ask a server for (ruler, report, commands).
import * as vscode from "vscode";
import { readFileSync } from "node:fs";
import { LanguageClient, TransportKind } from "vscode-languageclient/node";
import { registerCommands } from "./commands";
import { notFound, serverCall } from "./program";
import { Reports } from "./report";
import { RulerView } from "./ruler";
import { run } from "./run";
import { program, settings } from "./settings";

let client: LanguageClient | undefined;
let parts: vscode.Disposable[] = [];

async function stop(): Promise<void> {
  for (const p of parts) p.dispose();
  parts = [];
  const old = client;
  client = undefined;
  // A server that did not start cannot be stopped.
  await old?.dispose(2000).catch(() => undefined);
}

async function start(context: vscode.ExtensionContext, channel: vscode.LogOutputChannel): Promise<void> {
  await stop();
  const s = settings();
  const path = program(s);
  if (path === null) {
    // Each command says what is missing, too.
    const say = async () => {
      if ((await vscode.window.showErrorMessage(notFound(s.path), "Open Settings")) === "Open Settings")
        await vscode.commands.executeCommand("workbench.action.openSettings", "deck.path");
    };
    const commands: { command: string }[] = context.extension.packageJSON.contributes.commands;
    parts = commands.filter((c) => c.command !== "deck.restart").map((c) => vscode.commands.registerCommand(c.command, say));
    void say();
    return;
  }
  channel.info(`${path} ${serverCall(s).join(" ")}`);
  const bridge = readFileSync(vscode.Uri.joinPath(context.extensionUri, "dist/bridge.js").fsPath, "utf8");
  const reports = new Reports(path, bridge, channel);
  const server = new LanguageClient(
    "deck",
    "libdeck",
    { command: path, args: serverCall(s), transport: TransportKind.stdio },
    { documentSelector: [{ language: "radioss", scheme: "file" }], outputChannel: channel },
  );
  const ruler = new RulerView(server);
  parts = [
    reports,
    ruler,
    ...registerCommands(path, channel),
    vscode.commands.registerCommand("deck.showGapReport", () => reports.show()),
    vscode.commands.registerCommand("deck.showInReport", () => reports.showLine()),
    vscode.commands.registerCommand("deck.nextField", () => ruler.go(1)),
    vscode.commands.registerCommand("deck.previousField", () => ruler.go(-1)),
  ];
  // An older program without a server still makes reports, and changes decks.
  if ((await run(path, ["lsp", "--help"], context.extensionPath)).code !== 0) {
    void vscode.window.showWarningMessage(`${path} has no language server ('deck lsp'): there are colours, commands and the report, but no findings. Install a newer libdeck.`);
    return;
  }
  client = server;
  await server.start().catch((e: unknown) => channel.error(String(e)));
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const channel = vscode.window.createOutputChannel("libdeck", { log: true });
  context.subscriptions.push(
    channel,
    vscode.commands.registerCommand("deck.restart", () => start(context, channel)),
    vscode.workspace.onDidChangeConfiguration((e) => {
      if (["path", "includePaths", "arguments"].some((k) => e.affectsConfiguration(`deck.${k}`))) void start(context, channel);
    }),
  );
  await start(context, channel);
}

export const deactivate = stop;
