// What is chosen or found is seen, with a section plane or without, and Esc takes it back; settings beside their row; names, panels and numbers
// in full; several part pairs, a depth to begin with, neighbours and padlocks.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { check, deck, done, open, page, pageOf, same, sample, scratch, settled } from "./support.mjs";
/** Share of the picture, in percent, that is not ground. */
const filled = (p) => p.evaluate(() => window.deckReport.viewport.view.pictured(1, null, (c) => {
  const k = Object.assign(document.createElement("canvas"), { width: c.width, height: c.height }), g = k.getContext("2d");
  g.drawImage(c, 0, 0);
  const d = new Uint32Array(g.getImageData(0, 0, c.width, c.height).data.buffer);
  return (100 * d.reduce((n, v) => n + Number(v !== d[0]), 0)) / d.length;
}));
const pose = (p) => p.evaluate(() => window.deckReport.viewport.view.control.pose);
const left = (p) => p.evaluate(() => [...document.querySelectorAll("[aria-selected=true], .tip")].filter((e) => e.getClientRects().length > 0).length);
const enter = async (p, box, text) => {
  await p.fill(box, text); await p.keyboard.press("Enter");
  await p.evaluate(() => document.activeElement.blur());
};
const press = async (p, keys) => { for (const k of keys) await p.keyboard.press(k); };
/** A click on a row of any table, or a find, shows something; Esc Esc brings back the view before it. */
async function seenAndTakenBack(p, name) {
  await settled(p);
  const before = await pose(p);
  const quiet = await p.evaluate(() => {
    const { report } = window.deckReport, busy = new Set(report.hits.flatMap((x) => x.nodes));
    return report.mesh.parts.flatMap((q) => [...q.node]).map((n) => report.nodeId(n)).find((id) => !busy.has(id));
  });
  for (const section of [false, true]) {
    if (section) await p.keyboard.press("x");
    for (const table of [".interfaces-table", "#pairs", ".list-table", "#crossed", ".untied-table", ".moved-table", "find"]) {
      const rows = p.locator(`${table} .vt-row`);
      if (table === "find") await enter(p, "#find", String(quiet));
      else if ((await rows.count()) > 0) await rows.nth(Math.min(1, (await rows.count()) - 1)).click();
      else continue;
      await settled(p);
      const share = await filled(p);
      check(`${name}, ${table}${section ? ", section" : ""}: what is chosen is seen`, share >= 2, `${share} %`);
      if (table === ".interfaces-table") check(`${name}: the legend tells secondary from main`, /secondary.*main/.test(await p.$eval(".legend", (e) => e.textContent)));
      await press(p, ["Escape", "Escape"]);
      await settled(p);
      same(`${name}, ${table}${section ? ", section" : ""}: Esc Esc leaves nothing chosen, in the view before it`, [await left(p), await pose(p)], [0, before]);
    }
  }
  await p.keyboard.press("x");
}
/** Row and settings, and the panels over the picture, do not cover one another; all controls are in the window. */
async function nothingCovered(p, name) {
  const place = () => p.evaluate(() => {
    const [row, panel, ...controls] = [...document.querySelectorAll(".interfaces-table .vt-row.selected, #whatif, #whatif :is(button, input, select)")].map((e) => e.getBoundingClientRect()).filter((r) => r.width > 0);
    return row.top >= 0 && row.bottom <= Math.min(innerHeight, panel.top) && controls.length > 4 && controls.every((r) => r.left >= 0 && r.right <= innerWidth);
  });
  await p.locator(".interfaces-table .vt-row:has([data-name*='rim'])").click();
  for (const [when, value] of [["before", ""], ["after", "0.9"], ["without a gap", "0"]]) {
    if (value) await enter(p, "#whatif [aria-label=Gapmin]", value);
    await p.waitForTimeout(100);
    check(`${name}, ${when}: the chosen row is seen above its settings`, await place());
  }
  check(`${name}: Gapmin 0 is labelled as from the mesh`, /mesh/.test(await p.$eval(".control:has(#f-Gapmin) .control-note", (e) => e.textContent)));
  await p.evaluate(() => window.deckReport.report.clearOverrides(null));
  await p.click("#whatif [aria-label='Close the settings']");
  await press(p, "xm");
  const over = await p.evaluate(() => {
    window.deckReport.viewport.showTip("a node ".repeat(12)); // here, because the next move of the mouse hides it
    const b = [...document.querySelectorAll(".clip-panel, .tip, .legend, .toolbar")].map((e) => e.getBoundingClientRect()).filter((r) => r.width > 0);
    return [b.length, b.flatMap((r, i) => b.slice(i + 1).filter((q) => r.left < q.right && q.left < r.right && r.top < q.bottom && q.top < r.bottom)).length];
  });
  check(`${name}: no panel lies over another`, over[0] > 3 && over[1] === 0, over.join());
  await press(p, "xm");
}
/** A cut name is a beginning, dots and an end; no two are alike; numbers of a column have the same decimals; ticks say what they are. */
async function told(p, name) {
  const names = await p.$$eval(".named[data-name]", (all) => all.filter((e) => e.getClientRects().length > 0).map((e) => ({
    id: e.querySelector(".id")?.textContent ?? "", full: e.dataset.name, text: e.querySelector(".rest")?.textContent ?? "", over: e.closest("[role=gridcell], .part-row, .matrix-head").scrollWidth > e.closest("[role=gridcell], .part-row, .matrix-head").clientWidth })));
  const bad = names.filter(({ full, text, over }) => over || !(text === full || (/…/.test(text) && full.startsWith(text.split("…")[0]) && full.endsWith(text.split("…")[1]))));
  check(`${name}: every cut name is a beginning and an end of it`, names.length > 4 && bad.length === 0, JSON.stringify(bad.slice(0, 3)));
  const alike = names.filter((a) => a.id && names.some((b) => b.full !== a.full && b.id + b.text === a.id + a.text));
  same(`${name}: no two parts look alike`, alike, []);
  const figures = await p.evaluate(() => ({
    ticks: [...document.querySelectorAll(".tick[data-value]")].filter((t) => Number(t.textContent.replace(/\u202f/g, "")) !== Number(t.dataset.value)).length,
    select: [...document.querySelectorAll(".toolbar select")].every((s) => s.scrollWidth <= s.clientWidth),
    icons: new Set([...document.querySelectorAll(".toolbar .icon path")].map((e) => e.getAttribute("d"))).size - document.querySelectorAll(".toolbar .icon").length,
    digits: [...document.querySelectorAll(".list-table [data-key=depth]")].filter((e) => e.textContent.replace(/^0\.0*|\./g, "").length !== 5).length,
  }));
  same(`${name}: ticks, choice of colours, icons and decimals`, figures, { ticks: 0, select: true, icons: 0, digits: 0 });
}
/** Several pairs, a depth to begin with, neighbours, padlocks. */
async function verbs(p, path) {
  const pairs = () => p.evaluate(() => window.deckReport.report.filter.pairs);
  const row = (i) => p.locator("#pairs .vt-row").nth(i);
  const shown = await p.evaluate(() => window.deckReport.report.hits.map((x) => [x.secondaryPart, x.mainPart]).filter((a, i, all) => all.findIndex((b) => String(a) === String(b)) === i));
  await row(0).click();
  const [first] = await pairs();
  await row(1).click({ modifiers: ["Control"] });
  same("Ctrl adds a pair", [(await pairs()).length, await p.$$eval("#pairs [aria-selected=true]", (r) => r.length)], [2, 2]);
  await row(1).click({ modifiers: ["Control"] });
  same("and takes it away", await pairs(), [first]);
  await row(0).click({ modifiers: ["Shift"] });
  same("Shift adds all pairs with the same secondary part", (await pairs()).map(String).sort(), shown.filter((a) => a[0] === first[0]).map(String).sort());
  await row(0).click({ button: "right" });
  await p.click(".context button:has-text('All pairs of part')");
  same("all pairs of a part", (await pairs()).map(String).sort(), shown.filter((a) => a.includes(first[0])).map(String).sort());
  await p.evaluate(() => window.deckReport.report.setFilter({ pairs: null }));
  await enter(p, ".from-depth", "0.5");
  check("from a depth: nothing shallower is listed", await p.evaluate(() => window.deckReport.report.filtered.length > 0 && window.deckReport.report.filtered.every((x) => x.depth >= 0.5)));
  await p.evaluate(() => window.deckReport.report.setFilter({ depth: null }));
  const seen = () => p.evaluate(() => window.deckReport.viewport.view.parts.parts.filter((x) => x.look !== "hidden").map((x) => x.data.part));
  await p.evaluate(() => window.deckReport.viewport.showPart(window.deckReport.report.meta.touches[0][0]));
  const [alone] = await seen();
  await press(p, "b");
  const near = await p.evaluate((a) => window.deckReport.report.meta.touches.filter((t) => t[0] === a || t[1] === a).flatMap((t) => [t[0], t[1]]), alone);
  const now = await seen();
  check("b shows the neighbours of a part", now.length > 1 && near.every((n) => now.includes(n)), `${now} ${near}`);
  await press(p, "p");
  for (const i of [0, 1, 1]) await p.locator(".padlock").nth(i).click();
  const command = await p.$eval(".fix-command code", (e) => e.textContent), ids = await p.$$eval(".part-row .id", (e) => e.map((x) => x.textContent));
  check("padlocks write the command", command.endsWith(` --strategy move-nodes --lock ${ids[0]} --only ${ids[1]}`), command);
  check("which can be called", deck(...command.replace(/^deck (\S+) .*? --strategy/, `$1 ${path} --strategy`).split(" "), "--quiet", "--diff") !== null);
  await press(p, "p");
}
export async function choosing(browser) {
  for (const [name, file] of [["crash box", page("chosen", sample("crash_box"))], ["a repair", pageOf("fix", "chosen_moved", sample("too_close"), "--strategy", "move-nodes", "--max-moved", "100%")], ["dummy", join(scratch, "dummy.html")]]) {
    if (!existsSync(file)) continue; // of budget.mjs, from the corpus
    const p = await open(browser, file, { viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" });
    await seenAndTakenBack(p, name);
    await press(p, "p");
    await told(p, name);
    await press(p, "p");
    if (name === "crash box") {
      await nothingCovered(p, "1280 x 800");
      await verbs(p, sample("crash_box"));
      await p.setViewportSize({ width: 390, height: 844 });
      await p.evaluate(() => window.deckReport.report.setFilter({ pairs: null }));
      await nothingCovered(p, "390 x 844");
    }
    await done(p, name);
  }
}
