// Where the program `deck` is, and how it is called. Knows nothing of the editor.
import { accessSync, constants, statSync } from "node:fs";
import { delimiter, isAbsolute, join } from "node:path";

export interface Settings {
  path: string; // of the program; a bare name is looked for on PATH
  includePaths: string[];
  arguments: string[]; // of `deck lsp`
  geometryOnSave: boolean; // whether penetrations are looked for when a deck is saved
}

function runs(path: string): boolean {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}

/** Path of the program, or null: it is not there. `folders`: what PATH says. */
export function locate(name: string, folders: string | undefined, windows = process.platform === "win32"): string | null {
  const names = windows && !/\.exe$/i.test(name) ? [name, `${name}.exe`] : [name];
  if (isAbsolute(name)) return names.find(runs) ?? null;
  // A relative path is none: what it would be relative to differs from window to window.
  if (/[\\/]/.test(name)) return null;
  for (const folder of (folders ?? "").split(delimiter)) {
    const found = folder && names.map((n) => join(folder, n)).find(runs);
    if (found) return found;
  }
  return null;
}

/** What to tell somebody whose `deck` is not there. */
export const notFound = (name: string): string =>
  name === "deck"
    ? "The program 'deck' was not found on PATH. Install libdeck, or set deck.path to the program. Until then decks are coloured only."
    : `deck.path is '${name}', but there is no such program. Give an absolute path or a name that is on PATH. Until then decks are coloured only.`;

export const noServer = (path: string): string => `${path} has no language server ('deck lsp'): install a newer libdeck. Until then decks are coloured only.`;

const includes = (s: Settings): string[] => s.includePaths.flatMap((p) => ["--include-path", p]);

export const serverCall = (s: Settings): string[] => ["lsp", ...s.arguments];
/** What the server is told at its start. Its lenses name the command that shows the report here. */
export const serverOptions = (s: Settings) => ({ includePaths: s.includePaths, geometryOnSave: s.geometryOnSave, showReportCommand: "deck.showGapReport" });
export const lintCall = (s: Settings, file: string): string[] => ["lint", file, "--geometry", "--color", "never", ...includes(s)];

/** What has changed in meaning since the last commit. */
export const sinceHead = (s: Settings, file: string): string[] => ["diff", "--git", "HEAD", file, "--color", "never", ...includes(s)];

/** A change of files: how to see it as a patch, and how to carry it out. */
export interface Change {
  preview: string[];
  apply: string[];
}
const change = (s: Settings, call: string[]): Change => ({ preview: [...call, "--diff", ...includes(s)], apply: [...call, "--in-place", ...includes(s)] });

export const fix = (s: Settings, file: string, strategies: string[]): Change => change(s, ["fix", file, "--strategy", strategies.join(",")]);
export const convert = (s: Settings, file: string, what: string[]): Change => change(s, ["convert", file, ...what]);
