// Finding things, chips, undo, links that open the same view, and what the context menu copies.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { check, deck, done, open, same, scratch, settled } from "./support.mjs";
/** The crash box: `file` is the report, `path` the deck. */
export async function find(browser, file, path) {
  const p = await open(browser, file);
  await p.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: { writeText: (t) => Promise.resolve((window.copied = t)) } }));
  const ask = async (text) => {
    await p.keyboard.press("/"); await p.fill("#find", text);
    return p.$$eval(".found-row", (r) => r.map((e) => e.textContent));
  };
  const filter = () => p.evaluate(() => ({ ...window.deckReport.report.filter }));

  // A node that penetrates nothing, an element, a part, an interface.
  const quiet = await p.evaluate(() => {
    const { report } = window.deckReport;
    const busy = new Set(report.hits.flatMap((x) => report.secondaryNodes(x.row)));
    const node = [...report.mesh.parts[0].node].find((n) => !busy.has(n));
    return { id: report.nodeId(node), x: [...report.nodePositions.subarray(3 * node, 3 * node + 3)] };
  });
  check("a node of the mesh is found by its id", (await ask(String(quiet.id))).some((t) => t.startsWith("node")));
  await p.keyboard.press("Enter"); await settled(p);
  const target = await p.evaluate(() => window.deckReport.viewport.view.control.target.toArray());
  check("and flown to", Math.hypot(...target.map((v, k) => v - quiet.x[k])) < 1e-3, `${target} ${quiet.x}`);
  const shells = await ask("817");
  check("an element is found with its part", shells.some((t) => t.startsWith("shell817 in part 1 tube")), shells.join(" | "));
  const parts = await ask("barrier");
  check("parts and interfaces are found by title", parts.some((t) => t.startsWith("part3 barrier")) && parts.some((t) => t.startsWith("interface1 tube rim on barrier")), parts.join(" | "));
  await p.keyboard.press("Enter");
  same("choosing an interface filters", (await filter()).interface, 0);
  check("and says so with a chip", (await p.$$eval(".filters .chip", (c) => c.map((e) => e.textContent))).some((t) => t.includes("tube rim on barrier")));
  check("what is not there is said", (await ask("nowhere"))[0].includes("No node, element, part or interface"));
  await p.keyboard.press("Escape");
  await p.evaluate(() => document.activeElement.blur());

  // Undo.
  await p.waitForTimeout(500);
  await p.click(".filters .chip");
  await p.waitForTimeout(500);
  same("a chip takes its filter away", (await filter()).interface, null);
  await p.keyboard.press("u");
  same("undo brings it back", (await filter()).interface, 0);

  // A link opens the same view.
  await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    report.setOverride(0, "Gapmin", 2.25);
    report.setFilter({ perNode: false, depth: [0.1, 3] });
    report.select(report.filtered[2]);
    viewport.toggle("clip");
    viewport.toggle("solid");
  });
  await p.click("#worst details:has(.columns) summary");
  await p.click("#worst details:has(.columns) input[value=action]"); await p.keyboard.press("t");
  await p.waitForTimeout(1200);
  const state = (q) =>
    q.evaluate(() => {
      const { report, viewport } = window.deckReport;
      return {
        hash: location.hash, filter: report.filter, row: report.selected?.key, overrides: report.overrides, pose: viewport.view.control.pose,
        planes: viewport.view.section.planes.length, theme: document.documentElement.dataset.theme,
        columns: [...document.querySelectorAll(".list-table [role=columnheader]")].map((e) => e.textContent),
      };
    });
  const here = await state(p);
  const q = await open(browser, `${file}${here.hash}`);
  await settled(q);
  same("the address opens the same view in another window", await state(q), here);
  check("without trouble", q.trouble.length === 0, q.trouble.join("; "));
  await q.close();

  // The context menu.
  await p.click(".list-table .vt-row:nth-child(2)", { button: "right" });
  const labels = await p.$$eval(".context [role=menuitem]", (b) => b.map((e) => e.textContent));
  check("the menu copies ids and cards", ["node", "main side", "interface", "/GRNOD/NODE", "/SET/GENERAL"].every((t) => labels.some((l) => l.toLowerCase().includes(t.toLowerCase()))), labels.join(" | "));
  const errors = (name, text) => {
    const to = join(scratch, name);
    writeFileSync(to, text);
    return JSON.parse(deck("lint", to, "--format", "json")).summary.errors;
  };
  const text = readFileSync(path, "utf8");
  for (const [label, name] of [["/GRNOD/NODE of the list", "menu_grnod.rad"], ["/SET/GENERAL of the list", "menu_set.rad"]]) {
    if (!(await p.$(".context:not([hidden])"))) await p.click(".list-table .vt-row:nth-child(2)", { button: "right" });
    await p.click(`.context [role=menuitem]:has-text('${label}')`);
    const card = await p.evaluate(() => window.copied);
    check(`${label} reads without an error`, card.split("\n").length > 3 && errors(name, text.replace(/\/END\s*$/, `${card}/END\n`)) === errors("menu_none.rad", text), card?.slice(0, 80));
  }
  await done(p, "finding things");
}
