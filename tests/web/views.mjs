// The page of the whole program with the native `deck` in place of its WebAssembly: what it shows, without em++.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, relative } from "node:path";
import { gzipSync } from "node:zlib";
import { accessible } from "../browser/axe.mjs";
import { check, DECK, DECK_ARTEFACTS, deck, finish, launch, open, ROOT, same, sample, WORK } from "../browser/support.mjs";

const esbuild = createRequire(join(WORK, "x.js"))("esbuild");
const scratch = mkdtempSync(join(tmpdir(), "deck-views-"));
mkdirSync(DECK_ARTEFACTS, { recursive: true });

// ---- the page -------------------------------------------------------------------------------------

const client = `
  export class Cancelled extends Error {}
  export const engine = async () => ({});
  export const unpacked = async (id) => {
    const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  };
  const coded = (b) => { let s = ""; for (const c of typeof b === "string" ? new TextEncoder().encode(b) : b) s += String.fromCharCode(c); return btoa(s); };
  const bytes = (s) => Uint8Array.from(atob(s), (c) => c.charCodeAt(0));
  export class Lane {
    async run(args, files) {
      const r = await window.native(args, Object.entries(files).map(([n, b]) => [n, coded(b)]));
      return { exitCode: r.exitCode, stdout: bytes(r.stdout), stderr: bytes(r.stderr), files: Object.fromEntries(r.files.map(([n, b]) => [n, bytes(b)])) };
    }
    cancel() {}
    close() {}
  }
  export class KeptLane extends Lane { async lint() { return null; } }
  export const deck = async () => { throw new Error("not here"); };`;
const bundled = async (entry) => (await esbuild.build({
  entryPoints: [join(ROOT, "tools/web/src", entry)], bundle: true, write: false, target: ["es2022"], charset: "ascii", format: "iife", nodePaths: [join(WORK, "node_modules")],
  plugins: [{ name: "native", setup: (b) => {
    b.onResolve({ filter: /^\.\/client$/ }, () => ({ path: "client", namespace: "native" }));
    b.onLoad({ filter: /.*/, namespace: "native" }, () => ({ contents: client, loader: "js" }));
  } }],
})).outputFiles[0].text;
const packed = (bytes) => gzipSync(bytes).toString("base64");
const page = join(scratch, "deck.html");
writeFileSync(page, `<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>deck</title><link rel="icon" href="data:,"><style>${await bundled("style.css")}</style></head><body>
<script type="text/plain" id="sample">${packed(readFileSync(sample("crash_box")))}</script><script type="text/plain" id="bridge">${packed(await bundled("../../vscode/src/bridge.ts"))}</script><script>${await bundled("main.ts")}</script></body></html>`);

let runs = 0;
function native(args, files) {
  const folder = join(scratch, `run${runs++}`);
  mkdirSync(folder);
  for (const [name, text] of files) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), Buffer.from(text, "base64"));
  }
  const given = new Set(files.map(([n]) => n));
  const r = spawnSync(DECK, args, { cwd: folder, maxBuffer: 1 << 30 });
  const made = readdirSync(folder, { recursive: true }).map((n) => join(folder, n)).filter((n) => statSync(n).isFile() && !given.has(relative(folder, n)));
  return { exitCode: r.status, stdout: r.stdout.toString("base64"), stderr: r.stderr.toString("base64"), files: made.map((n) => [relative(folder, n), readFileSync(n).toString("base64")]) };
}

const browser = await launch();
async function start(options = {}) {
  const context = await browser.newContext({ acceptDownloads: true, ...options });
  await context.exposeFunction("native", native);
  const p = await open(context, page);
  return p;
}
const idle = (p) => p.waitForFunction(() => document.documentElement.dataset.busy === "false" && document.documentElement.dataset.linted === "all", null, { timeout: 120000 });
const shot = (p, name) => p.screenshot({ path: join(DECK_ARTEFACTS, `views-${name}.png`) });
const framed = async (p, tab) => {
  await p.click(`#tab-${tab}`);
  await p.waitForSelector(`#panel-${tab} iframe`, { timeout: 60000 });
  const frame = await (await p.$(`#panel-${tab} iframe`)).contentFrame();
  await frame.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 60000 });
  return frame;
};

// ---- from nothing to the verdict -------------------------------------------------------------------

{
  const p = await start({ viewport: { width: 1280, height: 800 } });
  const drop = await p.$eval(".drop-area", (e) => ({ border: getComputedStyle(e).borderStyle, area: e.clientWidth * e.clientHeight }));
  check("a drop area is seen", drop.border === "dashed" && drop.area > 60000, JSON.stringify(drop));
  check("there is nothing to download before there is a deck", await p.$eval(".downloads", (e) => e.hidden));
  await accessible(p, "welcome");
  await shot(p, "welcome");
  await p.evaluate(() => {
    window.said = [];
    new MutationObserver(() => {
      const s = document.querySelector(".stages");
      if (!s.hidden && s.querySelector("progress")) window.said.push(s.textContent);
    }).observe(document.querySelector("main.work"), { subtree: true, childList: true, attributes: true });
  });
  await p.click(".sample");
  await idle(p);
  const json = JSON.parse(deck("gaps", sample("crash_box"), "--json", "-", "-q"));
  same("the sample is read: the verdict is that of the command line, red as the solver stops", await p.$eval(".verdict-line", (e) => [e.textContent, e.dataset.level]), [json.verdict.text, "error"]);
  check("while it works the page names what it does", (await p.evaluate(() => window.said)).some((s) => /findings|gaps/.test(s)), JSON.stringify(await p.evaluate(() => window.said.slice(0, 3))));

  // Findings by rule and by interface.
  const lint = JSON.parse(deck("lint", sample("crash_box"), "--geometry", "--json", "-", "-q")).diagnostics;
  const groups = () => p.$$eval(".findings > li[data-group]", (all) => all.map((e) => [e.dataset.group, e.querySelectorAll(".finding").length]));
  const tally = (key) => [...lint.reduce((m, f) => m.set(key(f), (m.get(key(f)) ?? 0) + 1), new Map())].sort();
  same("findings are grouped by rule", (await groups()).sort(), tally((f) => f.rule));
  const ranks = await p.$$eval(".findings > li[data-group] summary .severity", (all) => all.map((e) => ["error", "warning", "info"].findIndex((s) => e.classList.contains(s))));
  check("errors come first", ranks.every((r, i) => i === 0 || r >= ranks[i - 1]), ranks.join(" "));
  const counts = await p.$$eval(".severity-chips button", (all) => all.reduce((n, e) => n + parseInt(e.textContent), 0));
  same("the chips count all findings", counts, lint.length);
  await shot(p, "findings");
  await accessible(p, "findings by rule");
  await p.selectOption("[aria-label='Group findings']", "interface");
  same("and by interface", (await groups()).sort(), tally((f) => (f.entity?.keyword.startsWith("/INTER/") ? `${f.entity.keyword}/${f.entity.id}` : "")));
  await p.selectOption("[aria-label='Group findings']", "rule");

  // From a finding to the picture, and from a place in the report to the text.
  const of = lint.find((f) => f.entity?.keyword.startsWith("/INTER/") && f.rule === "DK301");
  await p.fill("[aria-label='Filter findings']", of.message.slice(0, 40));
  await p.click(".finding");
  await p.click(".to-picture");
  let frame = await framed(p, "gaps");
  await frame.waitForFunction(() => window.deckReport.report.selected !== null, null, { timeout: 30000 });
  same("a finding leads to its interface in the picture", await frame.evaluate(() => window.deckReport.report.meta.interfaces[window.deckReport.report.filter.interface].id), of.entity.id);
  const line = await frame.evaluate(() => window.deckReport.report.place(window.deckReport.report.selected.row).line);
  await frame.evaluate(() => document.querySelector("#detail dd.place").click());
  await p.waitForFunction(() => !document.getElementById("panel-findings").hidden);
  same("a place in the report leads to its line in the text", await p.$eval(".text-line.marked .number", (e) => Number(e.textContent)), line);
  await p.fill("[aria-label='Filter findings']", "");

  // Values as a matrix.
  await p.click("#tab-values");
  const params = JSON.parse(deck("params", sample("crash_box"), "--json", "-", "-q"));
  const cell = (field, id) => p.$eval(`td[data-field="${field}"][data-interface="${id}"]`, (e) => [e.textContent, e.className]);
  for (const i of params.interfaces)
    for (const [name, v] of Object.entries(i.parameters).slice(0, 6)) {
      const [text, own] = await cell(name, i.id);
      check(`${name} of interface ${i.id} is that of deck params`, Number.isNaN(Number(text)) ? text === "–" || text === String(v.value) : Number(text) === v.value, `${text} ${JSON.stringify(v)}`);
      same(`${name} of interface ${i.id}: bold where the card says it`, own === "own", v.origin === "card");
    }
  await p.selectOption("[aria-label='Which fields']", "differs");
  const rows = await p.$$eval(".matrix-values tbody tr", (all) => all.map((r) => new Set([...r.querySelectorAll("td[data-field]")].map((c) => c.textContent)).size));
  check("fields that are alike everywhere can be left out", rows.length > 2 && rows.every((n) => n > 1), rows.join(" "));
  await shot(p, "values");
  await accessible(p, "values");

  // The pages of the command line.
  frame = await framed(p, "gaps");
  same("the gap report is that of deck gaps --html", await frame.$eval("#verdict", (e) => e.dataset.verdict), json.verdict.level);
  frame = await framed(p, "cycle");
  same("the first cycle is the page of deck cycle --html", await frame.$eval(".brand", (e) => e.textContent), "deck cycle");
  await shot(p, "cycle");
  // A repair, taken over.
  await p.click("#tab-repair");
  await p.click("[data-strategy=move-nodes]");
  frame = await framed(p, "repair");
  same("a repair is the page of deck fix --html", await frame.$eval(".brand", (e) => e.textContent), "deck fix");
  await accessible(p, "repair");
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click("#panel-repair .primary");
  await idle(p);
  const repaired = join(scratch, "fixed");
  deck("fix", sample("crash_box"), "--strategy", "move-nodes", "-o", repaired, "-q");
  same("taken over, the verdict is that of the repaired deck", await p.textContent(".verdict-line"), JSON.parse(deck("gaps", join(repaired, "crash_box_0000.rad"), "--json", "-", "-q")).verdict.text);
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click('button:has-text("Undo")');
  await idle(p);
  same("and undone it is the old one", await p.textContent(".verdict-line"), json.verdict.text);
  // A conversion: what the program lists, to be saved and taken over.
  const set = (option, value) => (typeof value === "boolean" ? p.setChecked(`[data-option="${option}"]`, value) : option === "--version" ? p.selectOption(`[data-option="${option}"]`, value) : p.fill(`[data-option="${option}"]`, value));
  const converted = async (options) => {
    for (const [option, value] of Object.entries(options)) await set(option, value);
    await p.click("#panel-convert .primary");
    await p.waitForSelector(".conversion-result");
    for (const [option, value] of Object.entries(options)) await set(option, value === true ? false : "");
    return { result: await p.textContent(".conversion-result"), exit: Number(await p.getAttribute(".conversion-result", "data-exit")), told: await p.$eval(".conversion", (e) => e.querySelector("pre")?.textContent ?? "") };
  };
  const natively = (name, ...args) => {
    const folder = join(scratch, name);
    mkdirSync(folder);
    writeFileSync(join(folder, "crash_box_0000.rad"), readFileSync(sample("crash_box")));
    const r = spawnSync(DECK, ["convert", "crash_box_0000.rad", ...args, "--verify", "-o", "converted", "--report", "losses.json"], { cwd: folder, encoding: "utf8" });
    return { told: (r.stdout + r.stderr).trim(), exit: r.status, losses: JSON.parse(readFileSync(join(folder, "losses.json"), "utf8")), deck: join(folder, "converted/crash_box_0000.rad") };
  };
  const listed = () => p.$$eval(".conversion details", (all) => Object.fromEntries(all.map((e) => [e.dataset.kind, e.querySelectorAll("tbody tr").length])));
  const counted = (losses) => Object.fromEntries(["undecided", "dropped", "approximated", "kept"].filter((k) => losses[k].length > 0).map((k) => [k, losses[k].length]));
  await p.click("#tab-convert");
  await p.click("#panel-convert .primary");
  check("without a choice nothing is converted", /Nothing is chosen/.test(await p.textContent(".conversion")));
  const refusal = natively("refused", "--version", "110");
  const refused = await converted({ "--version": "110" });
  same("a conversion that is refused says why in the words of the program, and there is nothing to save", [refused, await p.isVisible('#panel-convert button:has-text("Download")')], [{ result: "Nothing was written. The conversion would do this:", exit: refusal.exit, told: refusal.told }, false]);
  same("and lists what would be lost", await listed(), counted(refusal.losses));
  await p.click(".conversion td .link");
  same("with its place in the text", await p.$eval(".text-line.marked .number", (e) => Number(e.textContent)), refusal.losses.undecided[0].line);
  await p.click("#tab-convert");
  const lossy = natively("lossy", "--version", "110", "--allow-loss");
  same("it is done if losses are accepted", await converted({ "--version": "110", "--allow-loss": true }), { result: "1 file is changed.", exit: lossy.exit, told: lossy.told });
  const wrong = await converted({ "--units": "kg, mm, fortnights" });
  check("a wrong value is answered by the program", wrong.exit === 2 && wrong.result === "Nothing was written." && /fortnights/.test(wrong.told), JSON.stringify(wrong));
  const older = natively("older", "--version", "2018");
  same("a conversion says what the command line says", await converted({ "--version": "2018" }), { result: "1 file is changed.", exit: older.exit, told: older.told });
  same("and lists the same values", await listed(), counted(older.losses));
  await accessible(p, "convert");
  await shot(p, "convert");
  const [download] = await Promise.all([p.waitForEvent("download"), p.click('#panel-convert button:has-text("Download")')]);
  same("what is saved is the converted deck", [download.suggestedFilename(), readFileSync(await download.path(), "utf8")], ["crash_box_0000.rad", readFileSync(older.deck, "utf8")]);
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click('#panel-convert button:has-text("Take it over")');
  await idle(p);
  check("taken over, the deck is the converted one", (await p.textContent("h1")).includes("(changed)") && JSON.parse(deck("gaps", older.deck, "--json", "-", "-q")).verdict.text === (await p.textContent(".verdict-line")));
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click('button:has-text("Undo")');
  await idle(p);
  for (const version of await p.$$eval('[data-option="--version"] option', (all) => all.map((e) => e.value).filter(Boolean)))
    check(`the program knows version ${version}`, spawnSync(DECK, ["convert", sample("crash_box"), "--version", version, "--check", "-q"]).status < 2);
  for (const system of await p.$$eval("#unit-systems option", (all) => all.map((e) => e.value)))
    check(`the program knows the units ${system}`, spawnSync(DECK, ["convert", sample("crash_box"), "--units", system, "--check", "-q"]).status < 2);
  await p.click("#tab-diff");
  check("an empty difference says what to do", /Choose or drop/.test(await p.textContent("#panel-diff")));
  await p.setInputFiles("#second", [join(repaired, "crash_box_0000.rad")]);
  frame = await framed(p, "diff");
  same("the difference is the page of deck diff --html", await frame.$eval(".brand", (e) => e.textContent), "deck diff");
  await shot(p, "diff");
  same("no console error and no request", p.trouble, []);
  await p.context().close();
}

// ---- causes before what follows from them ------------------------------------------------------------

{
  const p = await start({ viewport: { width: 390, height: 800 }, colorScheme: "dark" });
  const input = join(scratch, "include_tree_0000.rad");
  writeFileSync(input, readFileSync(sample("include_tree")));
  await p.setInputFiles("#files", [input]);
  await idle(p);
  const groups = await p.$$eval(".findings > li[data-group]", (all) => all.map((e) => [e.dataset.group, e.querySelector("details").open, e.querySelector("summary").textContent.includes("may follow")]));
  same("a missing file stands before what may follow from it, which is folded", [groups[0][0], groups[0][2], groups.slice(1).every((g) => g[2])], ["DK004", false, true]);
  check("the missing file is asked for", (await p.textContent(".missing")).includes("mesh.inc"));
  for (const tab of ["findings", "values"]) {
    await p.click(`#tab-${tab}`);
    check(`${tab} at 390: nothing beyond the right edge`, (await p.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
    await shot(p, `${tab}-390-dark`);
  }
  await accessible(p, "390 dark");
  same("missing file: no console error and no request", p.trouble, []);
  await p.context().close();
}
await browser.close();
finish();
