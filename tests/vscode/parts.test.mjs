// Parts of the extension that need no editor: finding the program, calls, the column ruler, the manifest
// and what the package holds.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { chmodSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { after, test } from "node:test";

const { ROOT, WORK, DECK } = process.env;
const require = createRequire(join(WORK, "x.js"));
const out = mkdtempSync(join(tmpdir(), "deck-vscode-"));
after(() => rmSync(out, { recursive: true }));
const part = async (name) => {
  const outfile = join(out, `${name}.mjs`);
  await require("esbuild").build({ entryPoints: [join(ROOT, "tools/vscode/src", `${name}.ts`)], bundle: true, format: "esm", platform: "node", outfile, logLevel: "warning" });
  return import(outfile);
};
const { convert, fix, lintCall, locate, noServer, notFound } = await part("program");
const { cellAt, layoutOf, nextCell, ruler } = await part("columns");
const { toggled } = await part("comments");
const manifest = JSON.parse(readFileSync(join(WORK, "stage/package.json"), "utf8"));
const settings = { path: "deck", includePaths: [], arguments: [], geometryOnSave: true };
const source = readdirSync(join(ROOT, "tools/vscode/src")).map((f) => readFileSync(join(ROOT, "tools/vscode/src", f), "utf8")).join("\n");

test("the first deck on PATH that can be run is found, and nothing else", () => {
  for (const d of ["a", "b", "c"]) mkdirSync(join(out, d));
  writeFileSync(join(out, "a/deck"), "not to be run");
  chmodSync(join(out, "a/deck"), 0o644);
  mkdirSync(join(out, "b/deck"));
  writeFileSync(join(out, "c/deck"), "#!/bin/sh\n");
  chmodSync(join(out, "c/deck"), 0o755);
  const path = ["a", "b", "", "c"].map((d) => d && join(out, d)).join(delimiter);
  // Root may read what is not to be run, but not run it.
  assert.equal(locate("deck", path, false), join(out, "c/deck"));
  assert.equal(locate("deck", join(out, "b"), false), null);
  assert.equal(locate("deck", undefined, false), null);
  assert.equal(locate(join(out, "c/deck"), "", false), join(out, "c/deck"));
  assert.equal(locate(join(out, "c/nothing"), path, false), null);
  assert.equal(locate("c/deck", path, false), null);
  writeFileSync(join(out, "c/deck.exe"), "MZ");
  chmodSync(join(out, "c/deck.exe"), 0o755);
  rmSync(join(out, "c/deck"));
  assert.equal(locate("deck", path, true), join(out, "c/deck.exe"));
});

test("who has no deck is told what to do", () => {
  assert.match(notFound("deck"), /not found on PATH.*Install.*deck\.path/);
  assert.match(notFound("/opt/deck"), /'\/opt\/deck'.*no such program/);
  assert.match(noServer("/opt/deck"), /\/opt\/deck has no language server.*install a newer libdeck/);
});

test("every call is one that the program takes", () => {
  const folder = join(out, "calls");
  mkdirSync(folder);
  const file = join(folder, "crash_box_0000.rad");
  const original = readFileSync(join(ROOT, "samples/crash_box_0000.rad"));
  writeFileSync(file, original);
  const s = { path: "deck", includePaths: [folder], arguments: [], geometryOnSave: true };
  const run = (call) => spawnSync(DECK, call, { encoding: "utf8" });
  const lint = run(lintCall(s, file));
  assert.ok([0, 1].includes(lint.status), lint.stderr);
  assert.match(lint.stdout, /DK3/);
  for (const c of [fix(s, file, ["inacti", "move-nodes"]), convert(s, file, ["--version", "2026"]), convert(s, file, ["--resolve-defaults"])]) {
    const preview = run(c.preview);
    assert.ok([0, 1].includes(preview.status), `${c.preview.join(" ")}: ${preview.stderr}`);
    assert.deepEqual(readFileSync(file), original, `${c.preview.join(" ")} is to write nothing`);
    if (!preview.stdout.trim()) continue;
    assert.match(preview.stdout, /^--- a\//m);
    const apply = run(c.apply);
    assert.ok([0, 1].includes(apply.status), `${c.apply.join(" ")}: ${apply.stderr}`);
    assert.notDeepEqual(readFileSync(file), original, c.apply.join(" "));
    writeFileSync(file, original);
  }
});

/** As the server answers `deck/card`. */
const answer = { keyword: "/INTER/TYPE7", card: "gap", cells: [
  { field: "Fpenmax", columns: [41, 60], label: "Fpenmax · columns 41-60", used: "", doc: "" },
  { field: "Fscalegap", columns: [1, 20], label: "Fscalegap · columns 1-20", used: "1", doc: "" },
  { field: "Gapmax", columns: [21, 40], label: "Gapmax · columns 21-40 · real · mm", used: "1e+30, built-in", doc: "Upper bound" },
  { field: "ITIED", columns: [81, 90], label: "ITIED · columns 81-90", used: "", doc: "" },
] };
const layout = layoutOf(answer, "");
test("an answer becomes a layout from left to right; a line that is no card has none", () => {
  assert.deepEqual(layout.cells.map((c) => [c.name, c.start, c.end]), [["Fscalegap", 0, 20], ["Gapmax", 20, 40], ["Fpenmax", 40, 60], ["ITIED", 80, 90]]);
  assert.equal(layoutOf(null, ""), null);
  assert.equal(layoutOf({ keyword: "/INTER/TYPE7", title: "a" }, "a"), null);
});

test("columns are bytes, characters are the editor's", () => {
  const cells = ["a", "b"].map((field, i) => ({ field, columns: [10 * i + 1, 10 * i + 10], label: "", used: "", doc: "" }));
  const at = (text) => layoutOf({ keyword: "k", card: "c", cells }, text).cells.map((c) => [c.start, c.end]);
  assert.deepEqual(at("plain     text"), [[0, 10], [10, 20]]);
  assert.deepEqual(at("\u00e9         7"), [[0, 9], [9, 19]]);
  assert.deepEqual(at("\ud83d\ude97      7"), [[0, 8], [8, 18]], "four bytes, two units of UTF-16");
});

test("the ruler marks the fields on the line and names those behind its end", () => {
  const r = ruler(layout, 30, 25);
  assert.deepEqual(r.cells, [{ start: 0, end: 20, odd: false, current: false }, { start: 20, end: 30, odd: true, current: true }]);
  const tail = r.tail.replaceAll("\u00a0", ".");
  assert.equal(tail, `${".".repeat(10)}│Fpenmax${".".repeat(12)}${".".repeat(20)}│ITIED....`);
  assert.equal(30 + r.tail.length, 90);
  assert.doesNotMatch(r.tail, / /);
  assert.equal(r.status, "Gapmax  21–40");
  assert.equal(r.tooltip, "/INTER/TYPE7, gap\n\nGapmax · columns 21-40 · real · mm: 1e+30, built-in\n\nUpper bound");
});

test("on a full line nothing is drawn behind it, on an empty one every field", () => {
  assert.equal(ruler(layout, 100, 0).tail, "");
  assert.equal(ruler(layout, 90, 0).cells.length, 4);
  assert.equal(ruler(layout, 0, 0).cells.length, 0);
  assert.match(ruler(layout, 0, 0).tail, /^│Fscalegap/);
});

test("between fields the ruler says that there is none", () => {
  assert.equal(ruler(layout, 100, 70).status, "column 71: no field");
  assert.equal(cellAt(layout.cells, 20).name, "Gapmax");
  assert.equal(cellAt(layout.cells, 60).name, "Fpenmax", "behind its last character");
});

test("a name that does not fit ends at the next field", () => {
  const cells = ["IBCX", "IBCY", "IBCZ"].map((name, i) => ({ name, start: 7 + i, end: 8 + i, about: "", doc: "" }));
  assert.equal(ruler({ keyword: "k", card: "c", cells }, 0, 0).tail.replaceAll("\u00a0", "."), ".......│││");
});

test("field by field, over gaps, to the end and back", () => {
  const names = [];
  for (let at = 0, cell; (cell = nextCell(layout.cells, at, 1)); at = cell.start) names.push(cell.name);
  assert.deepEqual(names, ["Gapmax", "Fpenmax", "ITIED"]);
  assert.equal(nextCell(layout.cells, 65, 1).name, "ITIED");
  assert.equal(nextCell(layout.cells, 65, -1).name, "Fpenmax");
  assert.equal(nextCell(layout.cells, 5, -1), null);
});

test("lines become comments in the first column, and what they were again", () => {
  const card = ["         1       2.5", "", "# heading"];
  assert.deepEqual(toggled(card), ["#         1       2.5", "#", "## heading"]);
  assert.deepEqual(toggled(toggled(card)), card);
  assert.deepEqual(toggled(["# heading"]), [" heading"]);
});

test("every command of the manifest is carried out, and every one carried out is in it", () => {
  const contributed = manifest.contributes.commands.map((c) => c.command).sort();
  const registered = [...source.matchAll(/(?:registerCommand|command)\("(deck\.\w+)"/g)].map((m) => m[1]).sort();
  assert.deepEqual(registered, contributed);
  const { menus, keybindings } = manifest.contributes;
  for (const item of [...Object.values(menus).flat(), ...keybindings]) assert.ok(contributed.includes(item.command), item.command);
});

test("every setting is read somewhere and told in the README", () => {
  const readme = readFileSync(join(WORK, "stage/README.md"), "utf8");
  for (const key of Object.keys(manifest.contributes.configuration.properties)) {
    const name = key.replace(/^deck\./, "");
    if (name === "trace.server") continue; // the client reads it by itself
    assert.ok(source.includes(`"${name}"`) || source.includes(`${name}"`), key);
    assert.ok(readme.includes(`\`${key}\``), key);
  }
});

test("the version is the project's", () => {
  assert.equal(manifest.version, spawnSync(DECK, ["--version"], { encoding: "utf8" }).stdout.match(/\d+\.\d+\.\d+/)[0]);
  assert.equal(manifest.devDependencies, undefined);
});

test("the package holds scripts, texts, and two pictures", () => {
  const unpacked = join(out, "vsix");
  assert.equal(spawnSync("python3", ["-m", "zipfile", "-e", join(WORK, "stage/libdeck.vsix"), unpacked]).status, 0);
  const files = readdirSync(unpacked, { recursive: true, withFileTypes: true }).filter((f) => f.isFile()).map((f) => join(f.parentPath ?? f.path, f.name));
  assert.deepEqual(files.map((f) => f.slice(unpacked.length + 1)).sort(), [
    "[Content_Types].xml", "extension.vsixmanifest", "extension/LICENSE.txt", "extension/NOTICES.txt", "extension/README.md",
    "extension/dist/extension.js", "extension/icon.png", "extension/language-configuration.json", "extension/package.json", "extension/screenshot.png", "extension/syntaxes/radioss.tmLanguage.json",
  ].sort());
  for (const f of files.filter((f) => !/[.]png$/.test(f))) assert.doesNotMatch(readFileSync(f, "latin1"), /\0/, f);
  const notices = readFileSync(join(unpacked, "extension/NOTICES.txt"), "utf8");
  for (const name of ["vscode-languageclient", "vscode-jsonrpc", "minimatch", "semver"]) assert.ok(notices.includes(`${name}\n`), name);
});

test("no key of the editor is taken, and no file but decks", () => {
  const { languages, keybindings } = manifest.contributes;
  // Keys that follow Ctrl+K alone and are nobody's in VS Code.
  for (const k of keybindings) assert.match(k.key, /^ctrl\+k [.,=3]$/, k.key);
  for (const k of keybindings) assert.match(k.mac, /^cmd\+k [.,=3]$/, k.mac);
  assert.equal(languages[0].extensions, undefined, "*.inc belongs to PHP, too");
  const first = new RegExp(languages[0].firstLine);
  for (const line of ["#RADIOSS STARTER", "/BEGIN", "/NODE", "/MAT/LAW1/1"]) assert.match(line, first);
  for (const line of ["<?php", "; assembler", "# makefile", "/* C */", "// C++", "/usr/bin/env node"]) assert.doesNotMatch(line, first);
});
