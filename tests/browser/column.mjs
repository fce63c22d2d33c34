// The left column and what it does to the picture: the table in sight at once, settings beside the row, rows that do not jump, few
// stops of the Tab key; what is chosen stands alone, its names beside it.
import { check, same, settled } from "./support.mjs";
/** `p` shows the crash box. */
export async function column(p) {
  await p.setViewportSize({ width: 1280, height: 800 });
  await p.evaluate(() => document.querySelector(".left").scrollTo(0, 0));
  const top = await p.$eval(".interfaces-table .vt-row", (e) => e.getBoundingClientRect().top);
  check("1280 x 800: the first row of the table starts within 265 pixels", top <= 265, `${top}`);

  // Settings.
  same("without settings under test no number stands twice above the table", await p.$eval(".tiles", (e) => e.hidden), true);
  await p.click(".interfaces-table .vt-row:has-text('tube rim')"); await settled(p);
  const panel = await p.$eval("#whatif", (e) => e.getBoundingClientRect().toJSON());
  check("the settings of the chosen interface are in sight", panel.top > 0 && panel.bottom <= 800 && panel.height > 80, JSON.stringify(panel));
  const order = () => p.$$eval(".interfaces-table .vt-row", (rows) => rows.map((r) => r.querySelector("[data-key=id]").textContent));
  const before = await order();
  const slider = await p.$("#f-Gapmin");
  const box = await slider.boundingBox();
  await p.mouse.move(box.x + box.width - 4, box.y + box.height / 2);
  await p.mouse.down();
  for (let i = 1; i <= 6; i++) await p.mouse.move(box.x + (box.width * (6 - i)) / 6 + 2, box.y + box.height / 2);
  same("rows keep their place while a slider is held", await order(), before);
  await p.mouse.up();
  same("a bar lists the setting under test", await p.$$eval(".tests .chip", (c) => c.length), 1);
  check("it names interface, field, old and new value", /^1 Gapmin \S+ → \S+$/.test(await p.$eval(".tests .chip", (c) => c.textContent)), await p.$eval(".tests .chip", (c) => c.textContent));
  same("the numbers follow in a line", await p.$eval(".tiles", (e) => e.hidden), false);
  const address = (has) => p.waitForFunction((wanted) => location.hash.includes("card.1=") === wanted, has); // a state that is kept for undo
  await address(true);
  await p.click(".tests button:has-text('Reset all')");
  await address(false);
  same("and are gone when it is reset", await p.$eval(".tests", (e) => e.hidden), true);
  await settled(p);
  await p.keyboard.press("u");
  check("undo brings the setting back", await p.evaluate(() => window.deckReport.report.anyChanged));
  await settled(p);
  await p.keyboard.press("Shift+U");
  check("redo takes it away again", await p.evaluate(() => !window.deckReport.report.anyChanged));
  await p.evaluate(() => window.deckReport.report.setFilter({ interface: null }));

  // Keyboard.
  // From the top of the page.
  await p.evaluate(() => {
    document.body.tabIndex = -1;
    document.body.focus();
    document.body.removeAttribute("tabindex");
  });
  let stops = 0;
  for (; stops < 40; stops++) { await p.keyboard.press("Tab"); if (await p.evaluate(() => document.activeElement?.textContent === "To the picture")) break; }
  check("the picture is two Tab stops away", stops < 3, `${stops}`);
  await p.keyboard.press("Enter");
  check("and has the focus then", await p.evaluate(() => document.activeElement instanceof HTMLCanvasElement));
  same("the matrix is one Tab stop", await p.$$eval(".matrix button", (b) => b.filter((e) => e.tabIndex === 0).length), 1);
  await p.$eval(".matrix button[tabindex='0']", (e) => e.focus());
  await p.keyboard.press("ArrowDown");
  check("arrow keys go on in it", await p.evaluate(() => document.activeElement?.matches(".matrix button[tabindex='0']")));

  await p.$eval(".interfaces-table .vt-body", (e) => e.focus());
  await p.click(".interfaces-table .vt-row:has(.fold-parts) [data-key=id]");
  const rows = (await order()).length;
  await p.keyboard.press("Space");
  check("the space bar unfolds the chosen interface", (await order()).length > rows);
  await p.keyboard.press("Space");
  same("and folds it", (await order()).length, rows);
  await p.keyboard.press("Escape");

  // Two parts with different names do not look alike.
  const names = await p.$$eval("#pairs .vt-row [data-key=s], #pairs .vt-row [data-key=m]", (cells) => cells.map((c) => [c.textContent, c.innerText]));
  check("different parts have different texts in sight", names.every(([full, seen]) => names.every(([other, text]) => (full === other) === (seen === text))), JSON.stringify(names));
  await p.setViewportSize({ width: 1600, height: 1000 });
}
/** What is chosen stands alone; labels are beside what they name. */
export async function chosenAlone(p) {
  await p.evaluate(() => window.deckReport.report.setFilter({ interface: 0 }));
  await settled(p);
  const parts = () => p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const { secondary, main } = report.sidesOf(0);
    return viewport.view.parts.parts.filter((x) => x.faces).map((x) => [secondary.has(x.data.part) || main.has(x.data.part), x.look]);
  });
  check("only the parts of the chosen interface are drawn", (await parts()).every(([own, look]) => own === (look !== "hidden")), JSON.stringify(await parts()));
  await p.$eval(".legend .context-share", (e) => { e.value = "0.5"; e.dispatchEvent(new Event("input")); });
  check("the context slider brings the others back, see-through", (await parts()).every(([own, look]) => own || look === "ghost"));
  await p.$eval(".legend .context-share", (e) => { e.value = "0"; e.dispatchEvent(new Event("input")); });
  await p.evaluate(() => window.deckReport.report.setFilter({ interface: null }));
  const rows = await p.evaluate(() => window.deckReport.report.filtered.length);
  for (const i of [0, 1, Math.floor(rows / 2), rows - 1]) {
    await p.evaluate((k) => window.deckReport.report.select(window.deckReport.report.filtered[k]), i);
    await settled(p);
    const near = await p.evaluate(() => {
      const { report, viewport } = window.deckReport;
      const x = report.selected;
      const v = viewport.view;
      const at = v.screen(x);
      const n = x.row.normal;
      const p3 = report.point(x.row);
      const Vector = v.control.center.constructor;
      const foot = v.place(new Vector(...p3.map((c, k) => c - n[k] * x.row.distance)));
      const gap = (r, q) => Math.hypot(Math.max(r.left - q.x, 0, q.x - r.right), Math.max(r.top - q.y, 0, q.y - r.bottom));
      const boxes = [...document.querySelectorAll("#view .label:not([hidden])")].map((e) => e.getBoundingClientRect());
      return { least: Math.min(...boxes.flatMap((r) => [at, foot].filter(Boolean).map((q) => gap(r, q)))), labels: boxes.length, lines: document.querySelectorAll("#view .leaders line").length };
    });
    check(`row ${i}: no label is nearer than 20 pixels to node or foot point`, near.least >= 20, JSON.stringify(near));
    same(`row ${i}: each label has a line to what it names`, near.lines, near.labels);
  }
  await p.keyboard.press("Escape");
  // A crossing: its two elements are the only ones that are not see-through.
  await p.click("#crossed .vt-row"); await settled(p);
  const crossing = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const r = report.crossed.rows.find((c) => viewport.crossedShown[0] === c);
    const drawn = viewport.view.parts.parts.flatMap((x) => (x.look === "solid" ? [`part ${x.data.part}`] : x.look === "hot" && x.hot ? [...new Set([...x.hot.userData.triangleElement].map((e) => x.element[e]))] : []));
    return { drawn: drawn.sort(), wanted: [r[4], report.data.contacts[r[0]].mainOwner.id[r[5]]].sort(), said: document.querySelector("#view .tip:not(.ruler)").textContent };
  });
  same("a crossing shows its two elements alone", crossing.drawn, crossing.wanted);
  check("and says which they are", crossing.wanted.every((id) => crossing.said.includes(String(id))), crossing.said);
  await p.keyboard.press("Escape");
}
