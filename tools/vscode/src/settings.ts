// The settings of the extension, as the editor holds them for a file.
import * as vscode from "vscode";
import { homedir } from "node:os";
import { locate, type Settings } from "./program";

/** `~` and `${workspaceFolder}` stand for what they stand for elsewhere. */
function expanded(text: string, folder: string): string {
  return text.replace(/^~(?=[\\/]|$)/, homedir()).replaceAll("${workspaceFolder}", folder);
}

export function settings(scope?: vscode.Uri): Settings {
  const c = vscode.workspace.getConfiguration("deck", scope);
  const folder = ((scope && vscode.workspace.getWorkspaceFolder(scope)) ?? vscode.workspace.workspaceFolders?.[0])?.uri.fsPath ?? ".";
  const list = (key: string) => c.get<string[]>(key, []).map((s) => expanded(s, folder));
  return { path: expanded(c.get("path", "deck"), folder), includePaths: list("includePaths"), arguments: list("arguments"), geometryOnSave: c.get("geometryOnSave", true) };
}

/** Path of the program, or null: it is not there. */
export const program = (s: Settings): string | null => locate(s.path, process.env.PATH);
