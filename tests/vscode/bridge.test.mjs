// The report's page with the script that the extension adds, in a real browser: what is chosen in the page
// is told, and what is asked for is chosen.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

const { ROOT, WORK, DECK } = process.env;
const { chromium } = createRequire(join(WORK, "x.js"))("playwright-core");
const executablePath = process.env.CHROMIUM ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const skip = executablePath ? false : "no chromium";
const out = mkdtempSync(join(tmpdir(), "deck-bridge-"));
let browser;
let page;
const deck = join(ROOT, "samples/include_tree_0000.rad");

/** All messages since the last call. */
const said = async () => {
  await page.waitForTimeout(200);
  return page.evaluate(() => window.said.splice(0));
};
const ask = (message) => page.evaluate((m) => window.postMessage(m, "*"), message);
const read = (place) => readFileSync(place.file, "utf8").split("\n")[place.line - 1];

before(async () => {
  if (skip) return;
  const html = join(out, "report.html");
  try {
    execFileSync(DECK, ["gaps", deck, "--html", html, "--quiet"], { stdio: "pipe" });
  } catch (e) {
    assert.equal(e.status, 1, String(e.stderr));
  }
  const text = readFileSync(html, "utf8");
  const end = text.lastIndexOf("</body>");
  const editor = "window.said = []; window.acquireVsCodeApi = () => ({ postMessage: (m) => window.said.push(m) });";
  writeFileSync(html, `${text.slice(0, end)}<script>${editor}</script><script>${readFileSync(join(WORK, "stage/dist/bridge.js"), "utf8")}</script>${text.slice(end)}`);
  browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--enable-unsafe-swiftshader"] });
  page = await browser.newPage();
  await page.goto(`file://${html}`);
  await page.waitForFunction(() => window.said.some((m) => m.type === "ready"), null, { timeout: 60000 });
  await said();
});
after(async () => {
  await browser?.close();
  rmSync(out, { recursive: true });
});

test("a pair that is chosen tells where its node and its card stand", { skip }, async () => {
  const [node, id] = await page.evaluate(() => {
    const { report } = window.deckReport;
    report.select(report.hits[0]);
    return [report.hits[0].nodes[0], report.meta.interfaces[report.meta.contacts[report.hits[0].contact].interface].id];
  });
  const [m, ...more] = await said();
  assert.deepEqual(more, []);
  assert.equal(m.type, "selected");
  assert.match(m.pair, new RegExp(`^(node|edge) ${node}.* of interface ${id}$`));
  assert.match(read(m.node), new RegExp(`^ *${node}\\b`), "the line of the node");
  assert.match(read(m.card), new RegExp(`^/INTER/TYPE\\d+/${id}\\b`), "the keyword of the interface");
});

test("the places in the panel of a pair are links", { skip }, async () => {
  const { file, line } = await page.evaluate(() => window.deckReport.report.place(window.deckReport.report.selected.row));
  await page.click("#detail dt:text-matches('ode at$') + dd");
  await page.click("#detail dt:text-is('Card at') + dd");
  const messages = await said();
  assert.deepEqual(messages.map((m) => m.type), ["open", "open"]);
  assert.deepEqual(messages[0].place, { file, line });
  assert.match(read(messages[1].place), /^\/INTER\//);
  await page.click("#detail dt:text-is('Depth') + dd");
  assert.deepEqual(await said(), [], "other values are none");
});

test("an interface that is chosen tells its card, and that it is chosen no longer", { skip }, async () => {
  await page.evaluate(() => window.deckReport.report.setFilter({ interface: 0 }));
  const [m] = await said();
  assert.equal(m.type, "interface");
  assert.match(read(m.card), new RegExp(`^/INTER/TYPE\\d+/${m.id}\\b`));
  await page.evaluate(() => window.deckReport.report.setFilter({ interface: null }));
  assert.deepEqual(await said(), [{ type: "interface", id: null, card: null }]);
});

test("a line of a card chooses its interface, a line of a node its pair, without an echo", { skip }, async () => {
  const places = await page.evaluate(() => {
    const { report } = window.deckReport;
    const inter = report.meta.interfaces[report.meta.contacts[report.hits[0].contact].interface];
    report.select(null);
    return { card: { file: inter.card.file, line: inter.card.line }, id: inter.id, node: report.place(report.hits.at(-1).row), name: report.hits.at(-1).nodes[0] };
  });
  await said();
  await ask({ type: "show", file: places.card.file, line: places.card.line + 3, header: places.card.line });
  let [m, ...more] = await said();
  assert.deepEqual(more, []);
  assert.deepEqual([m.type, m.what, m.chosen.interface], ["shown", `interface ${places.id}`, places.id]);
  assert.equal(await page.evaluate(() => window.deckReport.report.filter.interface !== null && window.deckReport.report.selected !== null), true);
  await ask({ type: "show", file: places.node.file, line: places.node.line, header: 1 });
  [m, ...more] = await said();
  assert.deepEqual(more, []);
  assert.match(m.what, new RegExp(`\\b${places.name}\\b`));
  assert.equal(await page.evaluate(() => window.deckReport.report.selected.key), m.chosen.key);
  await ask({ type: "show", file: places.node.file, line: 1, header: 0 });
  [m] = await said();
  assert.equal(m.what, null);
});

test("what was chosen is chosen again in a page that was made anew", { skip }, async () => {
  const chosen = await page.evaluate(() => {
    const { report } = window.deckReport;
    report.setFilter({ interface: null });
    report.select(null);
    return { interface: report.meta.interfaces[report.meta.contacts[report.hits[0].contact].interface].id, key: report.hits[0].key };
  });
  await said();
  await ask({ type: "restore", ...chosen });
  assert.deepEqual(await said(), []);
  assert.equal(await page.evaluate(() => window.deckReport.report.selected.key), chosen.key);
  await ask({ type: "restore", interface: 999999, key: "nothing" });
  assert.equal(await page.evaluate(() => window.deckReport.report.selected.key), chosen.key);
});

test("the page is as dark as the editor", { skip }, async () => {
  const theme = async (c) => {
    await page.evaluate((names) => (document.body.className = names), c);
    await page.waitForTimeout(200);
    return page.evaluate(() => document.documentElement.dataset.theme);
  };
  assert.deepEqual([await theme("vscode-dark"), await theme("vscode-light"), await theme("vscode-high-contrast"), await theme("vscode-high-contrast vscode-high-contrast-light")], ["dark", "light", "dark", "light"]);
  assert.deepEqual(await said(), []);
});
