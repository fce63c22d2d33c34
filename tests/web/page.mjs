// The page of the whole program in a browser: what it shows against the command line, editing, files
// in and out, the automation face, and that nothing leaves.
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { accessible, reachable } from "../browser/axe.mjs";
import { ALL, check, corpus, DECK, DECK_ARTEFACTS, DECK_CORPUS, finish, launch, open, ROOT, same, sample, skip, WORK } from "../browser/support.mjs";

const PAGE = process.env.PAGE;
const { unzipSync, zipSync } = createRequire(join(WORK, "x.js"))("fflate");
mkdirSync(DECK_ARTEFACTS, { recursive: true });
const scratch = mkdtempSync(join(tmpdir(), "deck-page-"));
const samples = join(ROOT, "samples");

/** The program in a folder; what it prints. */
const native = (folder, ...args) => {
  const r = spawnSync(DECK, args, { cwd: folder, encoding: "utf8", maxBuffer: 1 << 30 });
  return { exitCode: r.status, stdout: r.stdout, stderr: r.stderr };
};
const nativeFindings = (folder, deck) => JSON.parse(native(folder, "lint", deck, "--geometry", "--json", "-", "-q").stdout).diagnostics;
const nativeVerdict = (folder, deck) => JSON.parse(native(folder, "gaps", deck, "--json", "-", "-q").stdout).verdict.text;

const browser = await launch();

async function idle(p, timeout = 240000) {
  await p.waitForFunction(() => document.documentElement.dataset.busy === "false" && ["all", "failed"].includes(document.documentElement.dataset.linted), null, { timeout });
}
async function give(p, paths, input = "#files") {
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.setInputFiles(input, paths);
  await idle(p);
}
const findings = (p) => p.$$eval(".finding", (all) => all.map((e) => [e.querySelector("b").textContent.replace(/.* /, ""), e.querySelector(".muted").textContent.trim(), e.querySelector(".finding-text").textContent]));
const sorted = (rows) => rows.map((r) => JSON.stringify(r)).sort();
const asRows = (found) => found.map((f) => [f.field ? `${f.rule}:${f.field}` : f.rule, `${f.file}:${f.line}:${f.column}`, f.message]);
const quiet = (name, p) => check(`${name}: no console error and no request`, p.trouble.length === 0, p.trouble.join("; "));
const shot = (p, name) => p.screenshot({ path: join(DECK_ARTEFACTS, `web-${name}.png`) });
async function saved(p, label) {
  await p.click(".downloads summary");
  const [download] = await Promise.all([p.waitForEvent("download"), p.click(`.downloads button:has-text("${label}")`)]);
  const bytes = readFileSync(await download.path());
  await p.keyboard.press("Escape");
  await p.evaluate(() => (document.querySelector(".downloads").open = false));
  return bytes;
}

// ---- the file itself ----------------------------------------------------------------------------

const html = readFileSync(PAGE, "utf8");
check("the page has 8 MB at most", html.length <= 8e6, String(html.length));
const policy = /http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(html)?.[1] ?? "";
check("the policy allows nothing by default and no connections", policy.includes("default-src 'none'") && !policy.includes("connect-src"), policy);

// ---- findings, cards, editing -------------------------------------------------------------------

{
  const p = await open(browser, PAGE, { acceptDownloads: true });
  console.log(`page ready after ${(await p.evaluate(() => performance.now())).toFixed(0)} ms`);
  await shot(p, "welcome");
  await give(p, [sample("every_mistake")]);
  const expected = nativeFindings(samples, "every_mistake_0000.rad");
  same("the page lists the findings of the command line", sorted(await findings(p)), sorted(asRows(expected)));
  same("the page says the verdict of the command line", await p.textContent(".verdict-line"), nativeVerdict(samples, "every_mistake_0000.rad"));
  await accessible(p, "findings");
  await reachable(p, "findings");
  await shot(p, "findings");

  // A rule is explained in the words of the program.
  await p.click(".rule");
  await p.waitForSelector("dialog[open] pre");
  const rule = await p.textContent(".rule");
  same("a rule is explained as on the command line", await p.textContent("dialog pre"), native(samples, "explain", rule).stdout);
  await p.keyboard.press("Escape");

  // A safe fix: what the program says of the text after its edits.
  const fixable = expected.find((f) => f.fix?.safe);
  await p.fill(".list-tools input", `${fixable.rule} ${fixable.message.slice(0, 30)}`);
  await p.click(".finding");
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click(".fix");
  await idle(p);
  await p.fill(".list-tools input", "");
  const text = (await saved(p, "zip"), unzipSync(await saved(p, "zip")))["every_mistake_0000.rad"];
  const folder = join(scratch, "fixed");
  mkdirSync(folder);
  writeFileSync(join(folder, "every_mistake_0000.rad"), text);
  const after = nativeFindings(folder, "every_mistake_0000.rad");
  same("after a fix the findings are those of the fixed text", sorted(await findings(p)), sorted(asRows(after)));
  const ofItsRule = (list) => list.filter((f) => f.rule === fixable.rule).length; // other rules may now see what was hidden
  check("the fix takes its finding away", ofItsRule(after) < ofItsRule(expected));
  const original = join(scratch, "patched");
  mkdirSync(original);
  cpSync(sample("every_mistake"), join(original, "every_mistake_0000.rad"));
  execFileSync("git", ["apply", "--unsafe-paths", "-"], { cwd: original, input: await saved(p, "patch") });
  check("git applies the patch, and the result is the deck of the page", readFileSync(join(original, "every_mistake_0000.rad")).equals(Buffer.from(text)));
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.click('button:has-text("Undo")');
  await idle(p);
  same("undo brings the findings back", sorted(await findings(p)), sorted(asRows(expected)));
  quiet("every mistake", p);
  await p.close();
}

{
  const p = await open(browser, PAGE, { acceptDownloads: true });
  await give(p, [sample("two_surfaces")]);
  await p.click("#tab-values");
  // Every value is the text of `deck params`: ids whole, no figure formed anew.
  const printed = (await p.evaluate(([name, text]) => window.deck(["params", name, "--json", "-", "-q"], { [name]: text }), [basename(sample("two_surfaces")), readFileSync(sample("two_surfaces"), "latin1")])).stdout;
  const texts = await p.$$eval("#panel-values td[data-field]", (cells) => cells.map((c) => c.textContent));
  same("values are those of deck params, text by text", texts.filter((t) => t !== "–" && !printed.includes(`"value": ${t},`) && !printed.includes(`"value": "${t}",`)), []);
  await p.click('#panel-values td[data-field="Gapmin"] button');
  await p.waitForSelector('input.cell[data-field="Gapmin"]');
  // Names stand over their columns: as the card says.
  const card = JSON.parse(native(samples, "show", "two_surfaces_0000.rad", "1", "--json", "-", "-q").stdout).cards.find((c) => c.cells.some((x) => x.field === "Gapmin"));
  const cell = card.cells.find((x) => x.field === "Gapmin");
  const at = await p.$eval('input.cell[data-field="Gapmin"]', (e) => ({ left: e.style.left, width: e.style.width, value: e.value }));
  same("a cell lies in its columns", at, { left: `${cell.columns[0] - 1}ch`, width: `${cell.columns[1] - cell.columns[0] + 1}ch`, value: cell.text });
  await shot(p, "card");
  await p.evaluate(() => delete document.documentElement.dataset.linted);
  await p.fill('input.cell[data-field="Gapmin"]', "2.25");
  await p.keyboard.press("Enter");
  await idle(p);
  const text = unzipSync(await saved(p, "zip"))["two_surfaces_0000.rad"];
  const folder = join(scratch, "edited");
  mkdirSync(folder);
  writeFileSync(join(folder, "two_surfaces_0000.rad"), text);
  const line = Buffer.from(text).toString().split("\n")[card.line - 1];
  same("the value stands in its columns", line.slice(cell.columns[0] - 1, cell.columns[1]).trim(), "2.25");
  same("findings follow the cell", sorted(await findings(p)), sorted(asRows(nativeFindings(folder, "two_surfaces_0000.rad"))));
  const verdict = await p.textContent(".verdict-line");
  same("gaps follow the cell", verdict, nativeVerdict(folder, "two_surfaces_0000.rad"));
  check("and are others than before", verdict !== nativeVerdict(samples, "two_surfaces_0000.rad"));
  await p.click("#tab-values");
  same("values follow the cell", await p.$eval('#panel-values td[data-field="Gapmin"]', (e) => e.textContent), "2.25");
  await p.click("#tab-findings");
  await p.fill('input.cell[data-field="Gapmin"]', "123456789012345678901");
  await p.keyboard.press("Enter");
  check("a text that does not fit is refused", (await p.textContent(".card-panel [role=alert]")).includes("columns"));

  // The report in its frame, the first cycle, the difference.
  const framed = async (tab) => {
    await p.click(`#tab-${tab}`);
    await p.waitForSelector(`#panel-${tab} iframe`);
    const inner = await (await p.$(`#panel-${tab} iframe`)).contentFrame();
    await inner.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 60000 });
    return inner;
  };
  const frame = await framed("gaps");
  const json = JSON.parse(native(folder, "gaps", "two_surfaces_0000.rad", "--json", "-", "-q").stdout);
  same("the report in the page counts what the command line counts", (await frame.$$eval(".tile-value", (t) => t.map((e) => e.textContent)))[0].replace(/\u202f/g, ""), String(json.summary.pairs));
  await accessible(p, "gaps");
  await shot(p, "gaps");
  // The document in the page is that of the command line but for what was measured.
  const cycle = await (await framed("cycle")).$eval("#cycle-json", (e) => JSON.parse(e.textContent).dt);
  same("the first cycle is that of the command line", cycle, JSON.parse(native(folder, "cycle", "two_surfaces_0000.rad", "--json", "-", "-q").stdout).dt);
  await p.click("#tab-diff");
  await p.setInputFiles("#second", [sample("two_surfaces")]);
  const changed = await (await framed("diff")).evaluate(() => ["new", "worse", "better", "solved"].map((c) => parseInt(document.querySelector(`.compare .${c} b`).textContent)));
  const before = JSON.parse(native(samples, "gaps", "two_surfaces_0000.rad", "--json", "-", "-q").stdout).summary;
  check("the difference is that of the two decks", changed.some((n) => n > 0) && changed[0] - changed[3] === json.summary.nodes + json.summary.edges - before.nodes - before.edges, `${changed} ${JSON.stringify([before, json.summary])}`);
  await accessible(p, "difference");
  const sarif = JSON.parse((await saved(p, "SARIF")).toString());
  same("SARIF holds the findings", sarif.runs[0].results.length, nativeFindings(folder, "two_surfaces_0000.rad").length);
  quiet("two surfaces", p);
  await p.close();
}

// ---- files in many shapes -----------------------------------------------------------------------

{
  const p = await open(browser, PAGE);
  await give(p, [sample("include_tree")]);
  check("missing includes are asked for by name", (await p.textContent(".missing")).includes("mesh.inc"));
  await give(p, readdirSync(join(samples, "include_tree")).map((n) => join(samples, "include_tree", n)));
  check("files that were asked for go where the deck looks for them", await p.$eval(".missing", (e) => e.hidden));
  // Files that are given without a folder lie where the deck names them, not where its folder has them.
  const bare = (rows) => sorted(rows.map(([rule, at, message]) => [rule, basename(at), message]));
  const whole = asRows(nativeFindings(samples, "include_tree_0000.rad"));
  same("with its includes the deck has the findings of the command line", bare(await findings(p)), bare(whole));
  const zip = join(scratch, "tree.zip");
  const inside = { "car/include_tree_0000.rad": readFileSync(sample("include_tree")) };
  for (const n of readdirSync(join(samples, "include_tree"))) inside[`car/include_tree/${n}`] = readFileSync(join(samples, "include_tree", n));
  writeFileSync(zip, zipSync(inside));
  await p.reload();
  await p.waitForFunction(() => document.documentElement.dataset.ready === "true");
  await give(p, [zip]);
  same("a zip is a folder", sorted(await findings(p)), sorted(whole));
  const packed = join(scratch, "two_surfaces_0000.rad.gz");
  writeFileSync(packed, gzipSync(readFileSync(sample("two_surfaces"))));
  await give(p, [packed]);
  same("a packed deck is read", await p.textContent(".verdict-line"), nativeVerdict(scratch, "two_surfaces_0000.rad.gz"));
  quiet("files", p);
  await p.close();
}

// ---- the automation face ------------------------------------------------------------------------

{
  const p = await open(browser, PAGE);
  const ask = (args, files) => p.evaluate(async ([a, f]) => {
    const r = await window.deck(a, f);
    return { ...r, files: Object.fromEntries(Object.entries(r.files).map(([n, b]) => [n, new TextDecoder().decode(b)])) };
  }, [args, files]);
  const decks = readdirSync(samples).filter((n) => n.endsWith("_0000.rad"));
  const files = Object.fromEntries(decks.map((n) => [n, readFileSync(join(samples, n), "latin1")]));
  for (const n of readdirSync(join(samples, "include_tree"))) files[`include_tree/${n}`] = readFileSync(join(samples, "include_tree", n), "latin1");
  for (const name of ALL ? decks : decks.slice(0, 4))
    for (const args of [["lint", name, "--json", "-"], ["gaps", name, "--all", "--json", "-"], ["cycle", name, "--all", "--json", "-"]]) {
      const r = await ask(args, files);
      const expected = native(samples, ...args, "-q");
      check(`window.deck: ${args.slice(0, 2).join(" ")} as on the command line`, r.exitCode === expected.exitCode && r.stdout === expected.stdout, `${r.exitCode} ${expected.exitCode} ${r.stderr.slice(0, 200)}`);
    }
  const converted = await ask(["convert", "hot_contact_0000.rad", "--units", "kg,m,s", "--verify", "-o", "out"], files);
  const natively = native(samples, "convert", "hot_contact_0000.rad", "--units", "kg,m,s", "--verify", "-o", join(scratch, "out"));
  same("a conversion writes what the command line writes", [converted.exitCode, converted.stderr, converted.files["out/hot_contact_0000.rad"]], [natively.exitCode, natively.stderr, readFileSync(join(scratch, "out/hot_contact_0000.rad"), "latin1")]);
  const made = await ask(["convert", "two_surfaces_0000.rad", "-o", "out", "-q"], files);
  same("what a run wrote comes back", Object.keys(made.files), ["out/two_surfaces_0000.rad"]);
  same("wrong usage has its exit code", (await ask(["gaps"], {})).exitCode, 2);
  const outside = await p.evaluate(async () => {
    try {
      await fetch("https://example.invalid/");
      return "sent";
    } catch {
      return "refused";
    }
  });
  same("the page may not send anything", outside, "refused");
  check("nothing was stored", await p.evaluate(async () => {
    try {
      return localStorage.length + sessionStorage.length === 0;
    } catch {
      return true;
    }
  }));
  const asked = p.trouble.filter((t) => t.startsWith("request"));
  check("no request was made", asked.every((t) => t.includes("example.invalid")), asked.join("; "));
  await p.close();
}

// ---- files that come late, again or not at all --------------------------------------------------

{
  const p = await open(browser, PAGE);
  await p.evaluate(() => {
    const read = File.prototype.arrayBuffer;
    window.late = new Promise((ok) => (window.goOn = ok));
    File.prototype.arrayBuffer = async function () {
      if (this.name.startsWith("late")) await window.late;
      if (this.name.startsWith("gone")) throw new Error("it went away");
      return read.call(this);
    };
  });
  const deckText = readFileSync(sample("clean_plates"));
  const named = (name) => ({ name, mimeType: "text/plain", buffer: deckText });
  await p.setInputFiles("#files", [named("gone_0000.rad")]);
  await p.waitForFunction(() => document.querySelector(".trouble").textContent !== "");
  same("a file that cannot be read is named", await p.textContent(".trouble"), "gone_0000.rad cannot be read: it went away");
  await p.setInputFiles("#files", [named("late_0000.rad")]);
  await give(p, [named("soon_0000.rad")]);
  await p.evaluate(() => window.goOn());
  await p.waitForTimeout(200);
  await idle(p);
  check("what was chosen last is shown, however long the one before takes", (await p.textContent(".deck-name")).includes("soon_0000.rad"), await p.textContent(".deck-name"));
  same("the same file can be chosen again", await p.$$eval("input[type=file]", (all) => all.map((i) => i.value)), ["", "", ""]);
  await p.close();
}

// ---- hostile decks ------------------------------------------------------------------------------

const hostile = [];
const findingsFolder = join(DECK_CORPUS, "findings");
if (existsSync(findingsFolder)) {
  for (const e of readdirSync(findingsFolder, { recursive: true })) if (/_0000\.rad$/.test(e)) hostile.push(join(findingsFolder, e));
} else skip("hostile decks: no corpus");
{
  const p = await open(browser, PAGE);
  for (const path of ALL ? hostile : hostile.slice(0, 6)) {
    await p.reload();
    await p.waitForFunction(() => document.documentElement.dataset.ready === "true");
    // Some take the program itself minutes: then there is the button.
    await p.evaluate(() => delete document.documentElement.dataset.linted);
    await p.setInputFiles("#files", [path]);
    try {
      await idle(p, 45000);
    } catch {
      await p.click('button:has-text("Cancel")');
      await p.waitForFunction(() => document.documentElement.dataset.busy === "false");
    }
    const said = await p.evaluate(() => document.querySelector(".verdict-line").textContent + document.querySelector(".trouble").textContent + document.querySelector(".count").textContent);
    check(`${basename(path)} ends with an answer or a message`, said.length > 0);
  }
  const bomb = join(scratch, "bomb_0000.rad.gz");
  writeFileSync(bomb, gzipSync(Buffer.alloc(600e6, "#\n")));
  await p.reload();
  await p.waitForFunction(() => document.documentElement.dataset.ready === "true");
  await p.setInputFiles("#files", [bomb]);
  await p.waitForFunction(() => document.querySelector(".trouble").textContent !== "" || document.documentElement.dataset.busy === "false", null, { timeout: 120000 });
  check("a packed file that is too large ends with a message", (await p.textContent(".trouble")).length > 0);
  await p.close();
}

// ---- a large deck: speed and the cancel button --------------------------------------------------

const large = corpus("EuroSID_II/EuroSID_II_0000.rad");
if (large) {
  const p = await open(browser, PAGE);
  // The button is pressed as soon as a run begins: while the text is looked at, before any other run, and
  // again once those others go on.
  for (const during of ["the first run", "the runs after it"]) {
    await p.reload();
    await p.waitForFunction(() => document.documentElement.dataset.ready === "true");
    await p.evaluate((first) => {
      const root = document.documentElement;
      window.begunAfter = null;
      delete root.dataset.linted;
      new MutationObserver((seen) => {
        if (window.begunAfter !== null) window.begunAfter += seen.filter((m) => m.attributeName === "data-busy" && m.oldValue === "false").length;
        else if (root.dataset.busy === "true" && (first || root.dataset.linted)) {
          window.begunAfter = 0;
          [...document.querySelectorAll("button")].find((b) => b.textContent === "Cancel").click();
        }
      }).observe(root, { attributes: true, attributeOldValue: true });
    }, during === "the first run");
    await p.setInputFiles("#files", [large]);
    await p.waitForFunction(() => window.begunAfter !== null && document.documentElement.dataset.busy === "false");
    await p.waitForTimeout(200);
    check(`cancel during ${during} ends all work, and says so`, (await p.textContent(".trouble")).includes("Cancelled"));
    same(`cancel during ${during} lets nothing begin after it`, await p.evaluate(() => window.begunAfter), 0);
  }
  await p.reload();
  await p.waitForFunction(() => document.documentElement.dataset.ready === "true");
  await give(p, [large]);
  same("the findings of the dummy are those of the command line", sorted(await p.evaluate(() => {
    document.querySelector(".findings li:last-child > button:not(.finding)")?.click();
    return [...document.querySelectorAll(".finding")].map((e) => [e.querySelector("b").textContent.replace(/.* /, ""), e.querySelector(".muted").textContent.trim(), e.querySelector(".finding-text").textContent]);
  })), sorted(asRows(nativeFindings(dirname(large), basename(large)))));
  await shot(p, "dummy");

  const protocol = await browser.newBrowserCDPSession();
  const processor = async () => (await protocol.send("SystemInfo.getProcessInfo")).processInfo.filter((i) => i.type === "renderer").reduce((sum, i) => sum + i.cpuTime, 0);
  const whole = []; // the same deck from nothing, what a fast or slow machine takes
  for (let i = 0; i < 3; ++i) {
    const before = await processor();
    await p.evaluate(([name, text]) => window.deck(["lint", name], { [name]: text }), [basename(large), readFileSync(large, "latin1")]);
    whole.push(1000 * ((await processor()) - before));
  }

  // A cell is written: from the key to the findings in the list. Processor time of the page with its threads,
  // as nobody knows what else the machine does; the best counts. Runs for other views wait meanwhile.
  await p.click("#tab-values");
  await p.evaluate(() => [...document.querySelectorAll("#panel-values tr")].find((r) => r.cells[0].textContent === "Gapmin" && r.querySelector("button")).querySelector("button").click());
  await p.waitForSelector('input.cell[data-field="Gapmin"]');
  await p.evaluate(() => {
    window.post = Worker.prototype.postMessage;
    Worker.prototype.postMessage = function (message, ...more) {
      if (!message.args) window.post.call(this, message, ...more);
    };
  });
  const write = (value) => p.evaluate((written) => new Promise((ok) => {
    const root = document.documentElement;
    delete root.dataset.linted;
    const began = performance.now();
    new MutationObserver((_, observer) => {
      if (root.dataset.linted !== "text") return;
      observer.disconnect();
      ok(performance.now() - began);
    }).observe(root, { attributes: true });
    const input = document.querySelector('input.cell[data-field="Gapmin"]');
    input.value = written;
    input.dispatchEvent(new Event("change", { bubbles: true }));
  }), value);
  const used = [];
  const passes = [];
  for (const value of ["0.31", "0.32", "0.5", "0.45", "0.6", "0.33", "0.34", "0.35", "0.36", "0.37", "0.38"]) {
    const before = await processor();
    passes.push(await write(value));
    used.push(1000 * ((await processor()) - before));
    await p.waitForTimeout(100);
  }
  const told = (list) => `best ${Math.min(...list).toFixed(0)} ms, median ${list.sort((x, y) => x - y)[list.length >> 1].toFixed(0)} ms, longest ${Math.max(...list).toFixed(0)} ms`;
  console.log(`findings of the dummy after an edit, processor time: ${told(used)}; by the clock: ${told(passes)}; from nothing, processor time: ${told(whole)}`);
  check("findings of a 4 MB deck follow an edit with half of the processor time that they take from nothing", 2 * used[0] <= whole[0], `${used[0]} ms of ${whole[0]} ms`);
  await p.evaluate(() => (Worker.prototype.postMessage = window.post));
  await p.click('button:has-text("Cancel")');
  await write("100.");
  await idle(p);
  const edited = join(scratch, "dummy");
  mkdirSync(edited);
  writeFileSync(join(edited, basename(large)), unzipSync(await saved(p, "zip"))[basename(large)]);
  same("the findings of the edited dummy are those of the command line", sorted(await p.evaluate(() => {
    document.querySelector(".findings li:last-child > button:not(.finding)")?.click();
    return [...document.querySelectorAll(".finding")].map((e) => [e.querySelector("b").textContent.replace(/.* /, ""), e.querySelector(".muted").textContent.trim(), e.querySelector(".finding-text").textContent]);
  })), sorted(asRows(nativeFindings(edited, basename(large)))));
  quiet("dummy", p);
  await p.close();
} else skip("the dummy: no corpus");

// ---- served as a folder -------------------------------------------------------------------------

{
  const site = join(dirname(PAGE), "site");
  const asked = [];
  const server = createServer((request, answer) => {
    asked.push(request.url);
    const name = request.url === "/" ? "index.html" : request.url.slice(1);
    if (!existsSync(join(site, name))) return answer.writeHead(404).end();
    answer.writeHead(200, { "content-type": name.endsWith(".js") ? "text/javascript" : "text/html" }).end(readFileSync(join(site, name)));
  });
  await new Promise((ok) => server.listen(0, "127.0.0.1", ok));
  const context = await browser.newContext();
  const p = await context.newPage();
  await p.goto(`http://127.0.0.1:${server.address().port}/`);
  await p.evaluate(() => navigator.serviceWorker.ready.then(() => 0));
  await p.waitForFunction(() => navigator.serviceWorker.controller !== null, null, { timeout: 30000 });
  server.close();
  server.closeAllConnections();
  await p.reload();
  await p.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 60000 });
  await give(p, [sample("two_surfaces")]);
  same("the folder works without its server once it was opened", await p.textContent(".verdict-line"), nativeVerdict(samples, "two_surfaces_0000.rad"));
  check("the server was asked for nothing but the page and its keeper", asked.every((u) => ["/", "/index.html", "/service-worker.js"].includes(u)), asked.join(" "));
  await context.close();
}

// ---- widths and colours -------------------------------------------------------------------------

for (const [width, height] of [[390, 800], [900, 700], [1600, 1000], [2560, 1300]])
  for (const colorScheme of ["light", "dark"]) {
    const p = await open(browser, PAGE, { viewport: { width, height }, colorScheme });
    await accessible(p, `welcome ${width} ${colorScheme}`);
    await give(p, [sample("crash_box")]);
    for (const tab of ["findings", "values", "cycle"]) {
      await p.click(`#tab-${tab}`);
      await p.waitForFunction(() => document.documentElement.dataset.busy === "false");
      const over = await p.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      check(`${tab} at ${width}: nothing beyond the right edge`, over <= 0, `${over} px`);
      if (width === 390 || width === 1600) await accessible(p, `${tab} ${width} ${colorScheme}`);
      if (width !== 900) await shot(p, `${tab}-${width}-${colorScheme}`);
    }
    await p.close();
  }

await browser.close();
finish();
