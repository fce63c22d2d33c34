// The deck that the page keeps: after random edits its findings are what `deck lint --no-geometry` prints of the
// same text, byte for byte.
//   node edits.mjs DECK-PROGRAM ENGINE-FOLDER [--edits N] [--times]      Ends with 'N passed, N failed'.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const [program, engineFolder, ...rest] = process.argv.slice(2);
const deck = resolve(program);
const edits = Number(rest.includes("--edits") ? rest[rest.indexOf("--edits") + 1] : 12);
const corpus = process.env.DECK_CORPUS ?? join(root, "../shared");
const create = createRequire(import.meta.url)(resolve(engineFolder, "deck.js"));
const code = await WebAssembly.compile(readFileSync(resolve(engineFolder, "deck.wasm")));
const { Kept } = await import(resolve(engineFolder, "engine.mjs"));

let seed = 20;
const below = (n) => {
  seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
  return Math.floor((seed / 4294967296) * n);
};

/** A digit, a cell, a line more or one less: as hands do it. */
function edited(text) {
  const lines = text.split("\n");
  const at = below(lines.length);
  const line = lines[at];
  const kind = below(10);
  if (kind === 0) lines.splice(at, 0, line);
  else if (kind === 1) lines.splice(at, 1);
  else if (kind === 2) lines[at] = line.slice(0, 10) + "         7" + line.slice(20);
  else {
    const digits = [...line.matchAll(/\d/g)];
    if (digits.length === 0) return edited(text);
    const c = digits[below(digits.length)].index;
    lines[at] = line.slice(0, c) + String(below(10)) + line.slice(c + 1);
  }
  return lines.join("\n");
}

const decks = readdirSync(join(root, "samples")).filter((n) => /_0000\.rad$/.test(n)).map((n) => join(root, "samples", n));
for (const name of ["EuroSID_II/EuroSID_II_0000.rad", "SEAT_ADYREL/SEAT_ADYREL_0000.rad"])
  if (existsSync(join(corpus, "corpus", name))) decks.push(join(corpus, "corpus", name));

let passed = 0;
let failed = 0;
for (const path of decks) {
  const folder = mkdtempSync(join(tmpdir(), "deck-edits-"));
  cpSync(dirname(path), folder, { recursive: true });
  const files = {};
  for (const e of readdirSync(folder, { recursive: true, withFileTypes: true })) {
    const file = join(e.parentPath ?? e.path, e.name);
    if (e.isFile()) files[relative(folder, file)] = readFileSync(file);
  }
  const main = basename(path);
  // The deck and the files of its own folder of includes.
  const texts = Object.keys(files).filter((n) => n === main || n.startsWith(main.replace("_0000.rad", "/")));
  const kept = new Kept(create, code);
  let changed = files;
  const times = [];
  for (let i = 0; i <= edits; ++i) {
    const started = process.cpuUsage();
    const got = await kept.lint(main, changed);
    const used = process.cpuUsage(started);
    if (i > 0) times.push((used.user + used.system) / 1000);
    const expected = spawnSync(deck, ["lint", main, "--no-geometry", "--json", "-", "-q"], { cwd: folder, maxBuffer: 1 << 30 });
    const ok = got ? expected.stdout.equals(Buffer.from(got)) : expected.status > 1;
    if (ok) ++passed;
    else {
      ++failed;
      const [a, b] = [expected.stdout.toString("latin1").split("\n"), Buffer.from(got ?? "").toString("latin1").split("\n")];
      const k = a.findIndex((l, n) => l !== b[n]);
      console.log(`FAILED  ${main} after ${i} edits: line ${k + 1}: ${a[k]} <> ${b[k]}`);
    }
    // A machine that had nothing to say is gone: the next call brings everything.
    const file = texts[below(texts.length)];
    files[file] = Buffer.from(edited(files[file].toString("latin1")), "latin1");
    writeFileSync(join(folder, file), files[file]);
    changed = got ? { [file]: files[file] } : files;
  }
  times.sort((a, b) => a - b);
  if (rest.includes("--times")) console.log(`${main}: median ${times[times.length >> 1].toFixed(0)} ms, longest ${times.at(-1).toFixed(0)} ms of processor time`);
  rmSync(folder, { recursive: true, force: true });
}
// What only the command can say is left to it; after that the deck can be looked at again.
{
  const name = "two_surfaces_0000.rad";
  const text = readFileSync(join(root, "samples", name));
  const kept = new Kept(create, code);
  const wrong = await kept.lint(name, { [name]: text, ".decklint.toml": Buffer.from("select = 1\n") });
  const right = await kept.lint(name, { [name]: text });
  if (wrong === null && right !== null) ++passed;
  else {
    ++failed;
    console.log("FAILED  a configuration that is wrong has no findings, and the deck without it has");
  }
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
