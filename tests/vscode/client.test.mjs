// The parts of the extension against the real server: how it is called, and layouts of its answers. What the server answers is
// asked by tests/lsp/run.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";

const { ROOT, WORK, DECK } = process.env;
const require = createRequire(join(WORK, "x.js"));
const { StreamMessageReader, StreamMessageWriter, createMessageConnection } = require("vscode-jsonrpc/node");
const out = mkdtempSync(join(tmpdir(), "deck-client-"));
for (const name of ["program", "columns"])
  await require("esbuild").build({ entryPoints: [join(ROOT, `tools/vscode/src/${name}.ts`)], bundle: true, format: "esm", platform: "node", outfile: join(out, `${name}.mjs`) });
const { serverCall, serverOptions } = await import(join(out, "program.mjs"));
const { layoutOf, ruler } = await import(join(out, "columns.mjs"));

const settings = { path: DECK, includePaths: [join(ROOT, "samples")], arguments: ["--threads", "1"], geometryOnSave: false };
const server = spawn(DECK, serverCall(settings), { stdio: ["pipe", "pipe", "inherit"] });
const connection = createMessageConnection(new StreamMessageReader(server.stdout), new StreamMessageWriter(server.stdin));
connection.onRequest(() => null);
const waiting = new Map(); // by document: who waits for its findings
connection.onNotification("textDocument/publishDiagnostics", ({ uri }) => waiting.get(uri)?.());
connection.listen();
after(async () => {
  await connection.sendRequest("shutdown");
  await connection.sendNotification("exit");
  rmSync(out, { recursive: true });
});
const { capabilities } = await connection.sendRequest("initialize", {
  processId: process.pid, rootUri: null, initializationOptions: serverOptions(settings),
  capabilities: { general: { positionEncodings: ["utf-16"] }, textDocument: { documentSymbol: { hierarchicalDocumentSymbolSupport: true }, completion: { completionItem: { snippetSupport: true } } } },
});
await connection.sendNotification("initialized", {});

/** Opens a sample, `text` in place of what is on disk, and waits until the server knows it. */
async function open(name, text = readFileSync(join(ROOT, "samples", name), "utf8")) {
  const uri = pathToFileURL(join(ROOT, "samples", name)).href;
  const known = new Promise((resolve) => waiting.set(uri, resolve));
  await connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "radioss", version: 1, text } });
  await known;
  return { textDocument: { uri }, lines: text.split("\n") };
}
const close = ({ textDocument }) => connection.sendNotification("textDocument/didClose", { textDocument });
const card = (lines, header, down) => lines.findIndex((l) => header.test(l)) + down;

test("the server counts as the editor does", () => assert.equal(capabilities.positionEncoding, "utf-16"));

test("every line with cells has a layout that ends where they end, other lines have none", async () => {
  const deck = await open("crash_box_0000.rad");
  const at = card(deck.lines, /^\/INTER\/TYPE7\/1$/, 3);
  const ask = async (line, character) => layoutOf(await connection.sendRequest("deck/card", { textDocument: deck.textDocument, position: { line, character } }), deck.lines[line]);
  const layout = await ask(at, 25);
  assert.equal(layout.keyword, "/INTER/TYPE7");
  assert.deepEqual(layout.cells.slice(0, 3).map((c) => [c.name, c.start, c.end]), [["grnd_IDs", 0, 10], ["surf_IDm", 10, 20], ["Istf", 20, 30]]);
  assert.match(ruler(layout, deck.lines[at].length, 25).status, /^Istf {2}21–30$/);
  assert.match(layout.cells[2].about, /Istf.*: 4/);
  assert.equal(await ask(at - 3, 0), null, "the keyword");
  assert.equal(await ask(at - 1, 5), null, "a comment");
  await close(deck);
});

test("the report is that of the text, not of the file", async () => {
  const text = readFileSync(join(ROOT, "samples/crash_box_0000.rad"), "utf8").replace("a crash box against a barrier", "a title nobody saved");
  const deck = await open("crash_box_0000.rad", text);
  const { html } = await connection.sendRequest("deck/gapReport", { textDocument: deck.textDocument });
  assert.match(html, /a title nobody saved/);
  await close(deck);
});
