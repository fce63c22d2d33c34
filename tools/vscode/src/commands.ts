// Commands that run the program on a deck: findings, and changes that are shown as a patch before anything is written.
import * as vscode from "vscode";
import { deckOf } from "./deck_of";
import { convert, fix, lintCall, sinceHead, type Change, type Settings } from "./program";
import { run } from "./run";
import { settings } from "./settings";
import { showText } from "./texts";

/** The deck of the active editor with its changes on disk; undefined: there is none, or somebody said no. */
async function savedDeck(): Promise<vscode.Uri | undefined> {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || document.languageId !== "radioss") {
    void vscode.window.showInformationMessage("Open a Radioss deck first.");
    return undefined;
  }
  const dirty = vscode.workspace.textDocuments.filter((d) => d.isDirty && d.languageId === "radioss");
  if (dirty.length > 0 && (await vscode.window.showWarningMessage("The program reads the files on disk, and the text has changes.", { modal: true }, "Save")) !== "Save") return undefined;
  for (const d of dirty) await d.save();
  return deckOf(document.uri);
}

const strategies = [
  { label: "move-nodes", description: "move nodes out of each other's gap" },
  { label: "reduce-gap", description: "the largest gap without a penetration" },
  { label: "inacti", description: "let the solver treat them" },
  { label: "fpenmax", description: "switch off deep ones" },
];
const conversions = [
  { label: "Input version …", option: "--version", prompt: "Input version to write: 110, 120, 130, 140, 2017 … 2026, 2612" },
  { label: "Unit system …", option: "--units", prompt: "Unit system to write: kg,mm,ms or Mg,mm,s" },
  { label: "Effective values onto the contact cards", option: "--resolve-defaults", prompt: null },
  { label: "Every TYPE19 as the TYPE7 and TYPE11 that the solver makes of it", option: "--expand-type19", prompt: null },
  { label: "New ids …", option: "--renumber", prompt: "KIND+N, KIND-N or KIND=N, KIND being node, part, element, surf, all …" },
];

export function registerCommands(program: string, channel: vscode.LogOutputChannel): vscode.Disposable[] {
  const busy = <T>(title: string, work: (cancel: vscode.CancellationToken) => Promise<T>) =>
    vscode.window.withProgress({ location: vscode.ProgressLocation.Notification, title, cancellable: true }, (_, cancel) => work(cancel));

  /** Shows the patch; carries it out if that is wanted. */
  async function change(title: string, make: (s: Settings, file: string) => Change): Promise<void> {
    const deck = await savedDeck();
    if (!deck) return;
    const file = deck.fsPath;
    const calls = make(settings(deck), file);
    const seen = await busy(title, (cancel) => run(program, calls.preview, file, cancel));
    if (seen.error) channel.info(seen.error);
    if (seen.out.trim() === "") {
      const why = seen.error.trim().split("\n").at(-1);
      if (seen.code < 0) return; // cancelled
      void vscode.window.showInformationMessage(why ? `Nothing to change: ${why}` : "Nothing to change.");
      return;
    }
    await showText(`${title}.diff`, seen.out);
    if ((await vscode.window.showInformationMessage(`${title}: the patch shows what would change.`, "Change the Files")) !== "Change the Files") return;
    const done = await busy(title, (cancel) => run(program, calls.apply, file, cancel));
    channel.info(`${done.out}${done.error}`);
    if (done.code !== 0 && done.code !== 1) void vscode.window.showErrorMessage(`${title}: ${done.error.trim().split("\n")[0]}`);
  }

  const command = (name: string, f: () => Promise<void>) => vscode.commands.registerCommand(name, f);
  return [
    command("deck.lint", async () => {
      const deck = await savedDeck();
      if (!deck) return;
      const said = await busy("Checking the deck", (cancel) => run(program, lintCall(settings(deck), deck.fsPath), deck.fsPath, cancel));
      await showText(`findings of ${deck.path.split("/").at(-1)}.txt`, `${said.out}${said.error}`);
    }),
    command("deck.compareWithHead", async () => {
      const deck = await savedDeck();
      if (!deck) return;
      const said = await busy("Comparing with HEAD", (cancel) => run(program, sinceHead(settings(deck), deck.fsPath), deck.fsPath, cancel));
      if (said.code >= 0) await showText(`${deck.path.split("/").at(-1)} since HEAD.txt`, `${said.out}${said.error}` || "Nothing has changed in meaning since HEAD.");
    }),
    command("deck.fixPenetrations", async () => {
      const chosen = await vscode.window.showQuickPick(strategies, { title: "Repair initial penetrations by", canPickMany: true });
      if (chosen?.length) await change("Repair", (s, file) => fix(s, file, chosen.map((c) => c.label)));
    }),
    command("deck.convert", async () => {
      const chosen = await vscode.window.showQuickPick(conversions, { title: "Convert the deck" });
      if (!chosen) return;
      const value = chosen.prompt === null ? null : await vscode.window.showInputBox({ prompt: chosen.prompt });
      if (value === undefined || value === "") return;
      await change("Conversion", (s, file) => convert(s, file, value === null ? [chosen.option] : [chosen.option, value]));
    }),
  ];
}
