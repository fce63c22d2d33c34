// Texts to read only, such as explanations, reports of the program and patches: nobody is asked whether to save them.
import * as vscode from "vscode";

const scheme = "deck-text";
const texts = new Map<string, string>();
const changed = new vscode.EventEmitter<vscode.Uri>();

export const textProvider = (): vscode.Disposable =>
  vscode.workspace.registerTextDocumentContentProvider(scheme, { onDidChange: changed.event, provideTextDocumentContent: (uri) => texts.get(uri.path) ?? "" });

/** Shows `content` beside the active editor; `name` is the title of its tab, and its ending tells its language. */
export async function showText(name: string, content: string): Promise<void> {
  const uri = vscode.Uri.from({ scheme, path: `/${name}` });
  texts.set(uri.path, content);
  changed.fire(uri);
  await vscode.window.showTextDocument(await vscode.workspace.openTextDocument(uri), { viewColumn: vscode.ViewColumn.Beside, preview: true });
}
