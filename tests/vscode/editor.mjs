// The packaged extension in a real editor: the server of VS Code (npm package code-server) with a headless
// browser before it opens samples, and sees findings, hover, the column ruler and the report.
// Ends with 'N passed, N failed'; skipped where the editor cannot be had. Pictures go to DECK_ARTEFACTS.
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";

const { ROOT, WORK, DECK } = process.env;
const artefacts = process.env.DECK_ARTEFACTS ?? join(WORK, "artefacts");
mkdirSync(artefacts, { recursive: true });
let passed = 0;
let failed = 0;
const check = (name, ok, why = "") => {
  if (ok) ++passed;
  else {
    ++failed;
    console.log(`FAILED  ${name}${why ? `: ${why}` : ""}`);
  }
};
function skip(why) {
  console.log(`skipped  a real editor: ${why}`);
  console.log("0 passed, 0 failed, 1 skipped");
  process.exit(0);
}

// ---- the editor ------------------------------------------------------------------------------------
const executablePath = process.env.CHROMIUM ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!executablePath) skip("no chromium");
if (Number(process.versions.node.split(".")[0]) < 20) skip(`node ${process.versions.node}, and it needs 20`);
const version = "4.100.3"; // the last one for node 20
const home = join(WORK, `code-server-${version}`);
const editor = join(home, "node_modules/code-server/lib/vscode");
if (!existsSync(join(home, "installed"))) {
  rmSync(home, { recursive: true, force: true });
  mkdirSync(home, { recursive: true });
  writeFileSync(join(home, "package.json"), "{}");
  // Without the scripts of packages nothing is compiled: terminals and file watchers are missing, which are not needed here.
  const npm = (folder, ...more) => spawnSync("npm", ["install", "--ignore-scripts", "--no-audit", "--no-fund", ...more], { cwd: folder, encoding: "utf8" });
  for (const [folder, ...more] of [[home, `code-server@${version}`], [editor, "--omit=dev"]]) {
    const r = npm(folder, ...more);
    if (r.status !== 0) skip(`npm install: ${r.stderr.trim().split("\n").at(-1)}`);
  }
  writeFileSync(join(home, "installed"), "");
}
const { chromium } = createRequire(join(WORK, "x.js"))("playwright-core");

const out = mkdtempSync(join(tmpdir(), "deck-editor-"));
const decks = join(out, "decks");
const bin = join(out, "bin");
const data = join(out, "data");
const extensions = join(out, "extensions");
for (const d of [decks, bin, join(data, "data/Machine"), join(data, "data/User")]) mkdirSync(d, { recursive: true });
for (const name of ["crash_box_0000.rad", "every_mistake_0000.rad"]) cpSync(join(ROOT, "samples", name), join(decks, name));
symlinkSync(DECK, join(bin, "deck"));
const settings = { "security.workspace.trust.enabled": false, "workbench.startupEditor": "none", "telemetry.telemetryLevel": "off", "extensions.autoCheckUpdates": false, "workbench.enableExperiments": false, "editor.hover.delay": 100 };
for (const d of ["Machine", "User"]) writeFileSync(join(data, "data", d, "settings.json"), JSON.stringify(settings));
const main = (...more) => ["out/server-main.js", "--accept-server-license-terms", "--server-data-dir", data, "--extensions-dir", extensions, ...more];
execFileSync("node", main("--install-extension", join(WORK, "stage/libdeck.vsix")), { cwd: editor, stdio: "pipe" });

/** Starts the editor with a PATH; returns its address and how to end it. */
async function start(path) {
  const server = spawn("node", main("--host", "127.0.0.1", "--port", "0", "--without-connection-token", "--force-disable-user-env", "--telemetry-level", "off"), { cwd: editor, env: { ...process.env, PATH: path }, stdio: ["ignore", "pipe", "pipe"] });
  process.on("exit", () => server.kill());
  const port = await new Promise((resolve, reject) => {
    let said = "";
    server.stdout.on("data", (d) => {
      said += d;
      const found = said.match(/listening on (\d+)/);
      if (found) resolve(found[1]);
    });
    server.on("exit", () => reject(new Error(`the editor ended: ${said}`)));
  });
  return { address: `http://127.0.0.1:${port}`, end: () => server.kill() };
}
const browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--enable-unsafe-swiftshader"] });

/** The editor on the folder of the decks; nothing beyond this machine is asked for. */
async function open(address) {
  const page = await browser.newPage({ viewport: { width: 1700, height: 1000 } });
  await page.route(/^https?:\/\/(?!127\.0\.0\.1)/, (r) => r.abort());
  await page.goto(`${address}/?folder=${encodeURIComponent(decks)}`);
  await page.waitForSelector(".explorer-folders-view .monaco-list-row", { timeout: 60000 });
  return page;
}
const show = async (page, name) => {
  await page.dblclick(`.explorer-folders-view >> text=${name}`);
  await page.waitForSelector(`.tab.active:has-text("${name}")`);
};
/** By the palette; again if it was opened before the editor knew which file is active. */
const command = async (page, title) => {
  const done = await soon(async () => {
    await page.keyboard.press("F1");
    await page.waitForSelector(".quick-input-widget input", { timeout: 3000 });
    await page.keyboard.type(title);
    const row = await page.waitForSelector(`.quick-input-list .monaco-list-row:has-text("${title}")`, { timeout: 5000 }).catch(() => null);
    if (row) await row.click();
    else await page.keyboard.press("Escape");
    return row;
  });
  if (!done) await picture(page, "palette");
  check(`there is a command '${title}'`, done);
};
/** Puts the cursor on a line of the active editor. */
const line = async (page, at, column = 1) => {
  await page.keyboard.press("Control+g");
  await page.waitForSelector(".quick-input-widget input");
  await page.keyboard.type(`${at}:${column}`);
  await page.waitForSelector(`.quick-input-list .monaco-list-row:has-text("${at}")`);
  await page.waitForTimeout(300);
  await page.keyboard.press("Enter");
  if (!(await soon(() => page.$(`.statusbar-item:has-text("Ln ${at}, Col ${column}")`), 10))) {
    check(`the cursor goes to line ${at}`, false);
    await picture(page, `line_${at}`);
  }
};
const lineOf = (name, pattern) => readFileSync(join(decks, name), "utf8").split("\n").findIndex((l) => pattern.test(l)) + 1;
const picture = (page, name) => page.screenshot({ path: join(artefacts, `${name}.png`) });
/** What `f` gives once it gives something; null after a while. */
async function soon(f, seconds = 30) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; ) {
    const value = await f().catch(() => null);
    if (value) return value;
    await new Promise((r) => setTimeout(r, 200));
  }
  return null;
}

// ---- without the program ---------------------------------------------------------------------------
const node = join(process.execPath, "..");
let run = await start(`${node}${delimiter}/usr/bin${delimiter}/bin`.split(delimiter).filter((d) => !existsSync(join(d, "deck"))).join(delimiter));
let page = await open(run.address);
await show(page, "crash_box_0000.rad");
const told = await soon(() => page.textContent(".notification-list-item-message"));
check("without the program one is told what to do", told?.includes("The program 'deck' was not found on PATH"), told);
check("and decks are coloured", await soon(async () => (await page.$$eval(".view-line span[class*=mtk]", (s) => new Set(s.map((e) => e.className)).size)) > 2));
await picture(page, "no_program");
await page.close();
run.end();

// ---- with it ---------------------------------------------------------------------------------------
run = await start(`${bin}${delimiter}${process.env.PATH}`);
page = await open(run.address);
await show(page, "every_mistake_0000.rad");
const wrong = lineOf("every_mistake_0000.rad", /^\/INTER\/TYPE7\/31\b/) + 3;
await line(page, wrong, 15);
check("a finding is underlined", await soon(() => page.$(".squiggly-error, .squiggly-warning")));
const field = await soon(() => page.textContent("[id='libdeck.libdeck.deck.field']"));
check("the status bar names the field", field?.includes("surf_IDm  11–20"), field);
check("the fields of the card are marked", (await page.$$eval(".view-overlays [class*=ced-], .view-lines [class*=ced-]", (e) => e.length)) > 0);
await picture(page, "findings");
await page.keyboard.press("Control+k");
await page.keyboard.press(".");
const here = async () => (await page.textContent("[id='libdeck.libdeck.deck.field']")) ?? "";
check("one key goes to the next field", await soon(async () => (await here()).includes("Istf  21–30"), 10), await here());
await page.keyboard.press("Control+k");
await page.keyboard.press("Control+i");
const hover = await soon(async () => (await page.textContent(".monaco-hover:not(.hidden) .monaco-hover-content"))?.match(/Istf.*columns 21.30.*/s)?.[0]);
check("hover tells the field", hover);
await picture(page, "hover");
await page.keyboard.press("Escape");
await page.keyboard.press("Control+k");
await page.keyboard.press("=");
await page.waitForSelector(".quick-input-widget input");
await page.waitForTimeout(300);
await page.keyboard.type("5");
await page.keyboard.press("Enter");
const text = /^ {7}131 {7}131 {9}5 {16}1000 {29}2/;
const lines = () => page.$$eval(".view-line", (l) => l.map((e) => e.textContent.replaceAll("\u00a0", " ")));
check("a value is written where its columns end", await soon(async () => (await lines()).some((l) => text.test(l)), 10));
await page.keyboard.press("Control+k");
await page.keyboard.press("3");
check("a card becomes a comment in its first column", await soon(async () => (await lines()).some((l) => l.startsWith("#       131       131         5")), 10));
await page.keyboard.press("Control+k");
await page.keyboard.press("3");
check("and a card again", await soon(async () => (await lines()).some((l) => l.startsWith("       131       131         5")), 10));

// Lenses of lines out of sight are in the page as well, hidden, in an order of their own; those in sight are
// drawn anew when their numbers come, and a click in between is lost.
await soon(async () => {
  const inSight = page.locator(".codelens-decoration a:visible", { hasText: "Inacti" });
  await inSight.nth((await inSight.count()) >> 1).click({ timeout: 3000 }); // in the middle nothing lies over it
  return page.waitForSelector(".tab.active:has-text('Inacti')", { timeout: 3000 });
});
check("the lens over an interface tells what the solver does", await soon(async () => (await lines()).some((l) => l.startsWith("Inacti of /INTER/TYPE7")), 15));
await picture(page, "explained");
await page.click(".tab.active:has-text('Inacti') .codicon-close");
check("and is closed without a question", await soon(async () => (await page.$$(".tab:has-text('Inacti')")).length === 0, 5));

await show(page, "crash_box_0000.rad");
await command(page, "Deck: Show Gap Report");
const frame = await soon(async () => {
  for (const f of page.frames()) if (await f.evaluate(() => document.documentElement.dataset.ready === "true" && Boolean(window.deckReport)).catch(() => false)) return f;
  return null;
}, 60);
check("the report stands beside the text", frame);
await browser.close();
run.end();
rmSync(out, { recursive: true, force: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
