// Tokens of decks by the grammar of the extension and the engine that VS Code uses.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const { WORK } = process.env;
const require = createRequire(join(WORK, "x.js"));
const { loadWASM, OnigScanner, OnigString } = require("vscode-oniguruma");
const { INITIAL, Registry, parseRawGrammar } = require("vscode-textmate");
await loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")));
const onigLib = Promise.resolve({ createOnigScanner: (s) => new OnigScanner(s), createOnigString: (s) => new OnigString(s) });
const text = readFileSync(join(WORK, "stage/syntaxes/radioss.tmLanguage.json"), "utf8");
const grammar = await new Registry({ onigLib, loadGrammar: () => Promise.resolve(parseRawGrammar(text, "radioss.json")) }).loadGrammar("source.radioss");

/** Tokens of every line, without those of blanks alone. */
export function tokens(content) {
  let state = INITIAL;
  return content.split(/\r?\n/).map((line) => {
    const r = grammar.tokenizeLine(line, state);
    state = r.ruleStack;
    return { line, tokens: r.tokens.map((t) => ({ start: t.startIndex, end: Math.min(t.endIndex, line.length), scope: t.scopes.at(-1), scopes: t.scopes })).filter((t) => line.slice(t.start, t.end).trim()) };
  });
}
