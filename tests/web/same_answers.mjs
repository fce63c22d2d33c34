// The same answers as the command line's: decks of samples and corpus through verbs of the module in
// node or in a browser, byte for byte with the native program.
//   node same_answers.mjs DECK-PROGRAM ENGINE-FOLDER [--only TEXT] [--verbs a,b] [--sampled] [--times]
//     [--page FILE [--firefox]]
// --sampled: the corpus through lint and gaps only; --page: window.deck of this page, in the browser of
// tests/browser/support.mjs or in that of $FIREFOX. Ends with 'N passed, N failed'.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync, existsSync, cpSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const [program, engineFolder, ...rest] = process.argv.slice(2);
const deck = resolve(program);
const option = (name) => (rest.includes(name) ? rest[rest.indexOf(name) + 1] : null);
const corpus = process.env.DECK_CORPUS ?? join(root, "../shared");

/** Arguments of a verb for a deck; `{}` stands for it. What it writes is compared as well. */
const verbs = {
  lint: ["lint", "{}", "--json", "-", "--geometry", "--fail-on", "never"],
  params: ["params", "{}", "--json", "-"],
  gaps: ["gaps", "{}", "--all", "--json", "-"],
  cycle: ["cycle", "{}", "--all", "--json", "-"],
  convert: ["convert", "{}", "-o", "out", "--version", "2026", "--allow-loss", "--partial", "--report", "losses.json"],
  json: ["convert", "{}", "--to", "json", "-o", "deck.json"],
};
const wanted = option("--verbs")?.split(",") ?? Object.keys(verbs);

function decksBelow(folder) {
  if (!existsSync(folder)) return [];
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((e) => e.isFile() && /_0000\.rad(\.gz)?$/.test(e.name))
    .map((e) => join(e.parentPath ?? e.path, e.name))
    .sort();
}

/** All files of a folder by name, without the large ones that belong to no deck. */
function filesBelow(folder) {
  const out = {};
  for (const e of readdirSync(folder, { recursive: true, withFileTypes: true })) {
    if (!e.isFile()) continue;
    const path = join(e.parentPath ?? e.path, e.name);
    if (statSync(path).size < 64e6) out[relative(folder, path)] = readFileSync(path);
  }
  return out;
}

function native(folder, args) {
  const copy = mkdtempSync(join(tmpdir(), "deck-web-"));
  try {
    cpSync(folder, copy, { recursive: true });
    const before = filesBelow(copy);
    const started = process.hrtime.bigint();
    const r = spawnSync(deck, args, { cwd: copy, maxBuffer: 1 << 30, env: { PATH: process.env.PATH } });
    const ms = Number(process.hrtime.bigint() - started) / 1e6;
    const files = {};
    for (const [name, bytes] of Object.entries(filesBelow(copy)))
      if (!before[name] || !before[name].equals(bytes)) files[name] = bytes;
    return { exitCode: r.status, stdout: r.stdout, stderr: r.stderr, files, ms };
  } finally {
    rmSync(copy, { recursive: true, force: true });
  }
}

let neighbours = 0;
/** The one number that is not the same to the last bit: solids give nodes a stiffness by the cube root of
 * their volume, and C libraries round cbrt() differently (tools/docs/web.md). A node's is the sum over its
 * solids: some steps of a double. */
function sameButForCubeRoots(a, b) {
  const stiffness = /"nodal_stiffness": ([-+.0-9e]+)/;
  const [x, y] = [stiffness.exec(a), stiffness.exec(b)];
  if (!x || !y || a.replace(stiffness, "") !== b.replace(stiffness, "")) return false;
  if (!(Math.abs(x[1] - y[1]) <= 1e-15 * Math.abs(x[1]))) return false;
  ++neighbours;
  return true;
}

/** Where two outputs part, in words. */
function difference(a, b) {
  if (Buffer.compare(Buffer.from(a), Buffer.from(b)) === 0) return null;
  const x = Buffer.from(a).toString("latin1").split("\n");
  const y = Buffer.from(b).toString("latin1").split("\n");
  const i = x.findIndex((line, k) => line !== y[k] && !sameButForCubeRoots(line, y[k] ?? ""));
  if (i < 0 && x.length === y.length) return null;
  return i < 0 ? `lines ${x.length} and ${y.length}` : `line ${i + 1}: ${x[i]?.slice(0, 200)} <> ${y[i]?.slice(0, 200)}`;
}

const require = createRequire(import.meta.url);
const create = require(resolve(engineFolder, "deck.js"));
const code = await WebAssembly.compile(readFileSync(resolve(engineFolder, "deck.wasm")));
const { run } = await import(resolve(engineFolder, "engine.mjs"));

/** The same call in the page: files go there once a deck, and what a run wrote comes back as base64. */
async function inBrowser(file) {
  let page;
  let close;
  if (rest.includes("--firefox")) {
    const { openInFirefox } = await import("./firefox.mjs");
    page = await openInFirefox(process.env.FIREFOX, file);
    close = page.close;
    console.log(`Firefox ${page.version}`);
  } else {
    const { launch, open } = await import("../browser/support.mjs");
    const browser = await launch();
    page = await open(browser, file);
    close = () => browser.close();
  }
  let there = null;
  const answer = async (args, files) => {
    if (there !== files) {
      await page.evaluate((list) => {
        window.given = Object.fromEntries(list.map(([name, text]) => [name, Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]));
      }, Object.entries(files).map(([name, bytes]) => [name, bytes.toString("base64")]));
      there = files;
    }
    const r = await page.evaluate(async (a) => {
      const base64 = (bytes) => {
        let text = "";
        for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
        return btoa(text);
      };
      const made = await window.deck(a, window.given);
      return { ...made, files: Object.entries(made.files).map(([name, bytes]) => [name, base64(bytes)]) };
    }, args);
    return { ...r, files: Object.fromEntries(r.files.map(([name, text]) => [name, Buffer.from(text, "base64")])) };
  };
  return { answer, close };
}
const inPage = option("--page") ? await inBrowser(resolve(option("--page"))) : null;
const answerOf = inPage ? inPage.answer : (args, files) => run(create, code, args, files);

let passed = 0;
let failed = 0;
const times = {};
for (const path of [...decksBelow(join(root, "samples")), ...decksBelow(join(corpus, "corpus"))]) {
  if (option("--only") && !path.includes(option("--only"))) continue;
  const folder = dirname(path);
  const files = filesBelow(folder);
  const sampled = rest.includes("--sampled") && !path.startsWith(root);
  for (const verb of sampled ? wanted.filter((v) => v === "lint" || v === "gaps") : wanted) {
    const args = [...verbs[verb].map((a) => (a === "{}" ? basename(path) : a)), "--quiet"];
    const expected = native(folder, [...args, "--threads", "1"]);
    const started = performance.now();
    const got = await answerOf(args, files);
    const ms = performance.now() - started;
    const entry = (times[verb] ??= { native: 0, web: 0 });
    entry.native += expected.ms;
    entry.web += ms;
    const why = [];
    if (expected.exitCode !== got.exitCode) why.push(`exit code ${expected.exitCode} <> ${got.exitCode}`);
    for (const stream of ["stdout", "stderr"]) {
      const d = difference(expected[stream], got[stream]);
      if (d) why.push(`${stream}: ${d}`);
    }
    for (const name of new Set([...Object.keys(expected.files), ...Object.keys(got.files)])) {
      const d = difference(expected.files[name] ?? "", got.files[name] ?? "");
      if (d || !expected.files[name] || !got.files[name]) why.push(`${name}: ${d ?? "only one of them writes it"}`);
    }
    if (why.length === 0) ++passed;
    else {
      ++failed;
      console.log(`FAILED  ${relative(root, path)} ${verb}: ${why.join("; ")}`);
    }
    if (rest.includes("--times")) console.log(`${basename(path)} ${verb}: native ${expected.ms.toFixed(0)} ms, wasm ${ms.toFixed(0)} ms, ${got.stdout.length} bytes`);
  }
}
for (const [verb, t] of Object.entries(times)) console.log(`${verb}: native ${(t.native / 1000).toFixed(2)} s, WebAssembly ${(t.web / 1000).toFixed(2)} s`);
if (neighbours > 0) console.log(`${neighbours} nodal stiffnesses of solids differ in their last digit (cube roots)`);
await inPage?.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
