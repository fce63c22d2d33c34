// Tables at the widths that people have: no id, number or heading is cut, the page is never wider than its window, and
// the picture is there where it should be.
import { check, same } from "./support.mjs";
export const widths = [390, 768, 1024, 1280, 1440, 1920, 2560];
/** What is cut in the cells in sight: numbers and ids, headings, and the id that a text starts with. */
const cut = () => {
  const out = [];
  const seen = (e) => e.getClientRects().length > 0;
  const number = /^[-–\d\s.,%e∞*⁺⁻]+$/;
  for (const cell of document.querySelectorAll("[role=gridcell], [role=columnheader], table.plain td, .detail dd, .tile-value, .tile-name, .tile-note")) {
    const text = cell.textContent.trim();
    if (!seen(cell) || text === "") continue;
    const whole = cell.matches("[role=columnheader], .tile-value, .tile-name, .tile-note") || number.test(text);
    const over = [cell, ...cell.querySelectorAll("*")].some((e) => e.clientWidth > 0 && e.scrollWidth > e.clientWidth && getComputedStyle(e).overflowX !== "visible");
    if (whole) { if (over || cell.scrollWidth > cell.clientWidth) out.push(text); continue; }
    const id = /^\d+(?=\s)/.exec(text);
    if (!id) continue;
    // The id at the start of a name stays readable when the name does not fit.
    const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    const node = walker.nextNode();
    const range = document.createRange();
    range.setStart(node, 0);
    range.setEnd(node, Math.min(id[0].length, node.length));
    const frame = cell.getBoundingClientRect();
    const r = range.getBoundingClientRect();
    if (r.right > frame.right + 0.5 || r.left < frame.left - 0.5) out.push(text);
  }
  return { out, cells: document.querySelectorAll("[role=gridcell]").length, page: document.documentElement.scrollWidth, window: innerWidth };
};
/** The page is not wider than its window at any width; nor is a table wider than its box, unless that scrolls. */
export async function pageFits(p, name) {
  for (const width of widths) {
    await p.setViewportSize({ width, height: 900 });
    const over = await p.evaluate(() => [document.documentElement.scrollWidth > innerWidth, ...[...document.querySelectorAll("table")].map((t) => t.offsetWidth > t.parentElement.clientWidth && getComputedStyle(t.parentElement).overflowX === "visible")]);
    check(`${name}, ${width} wide: neither page nor table is too wide`, over.every((o) => !o), over.join(" "));
  }
  await p.setViewportSize({ width: 1280, height: 900 });
}
/** Measures a page that is open. */
export async function tablesFit(p, name, at) {
  const row = await p.$(".list-table .vt-row");
  for (const width of at) {
    await p.setViewportSize({ width, height: 900 });
    await p.waitForTimeout(60);
    if (row) await p.evaluate(() => window.deckReport.report.select(window.deckReport.report.filtered[0] ?? null));
    await p.waitForTimeout(60);
    const m = await p.evaluate(cut);
    check(`${name}, ${width} wide: no id, number or heading is cut`, m.out.length === 0, `${m.out.length}: ${m.out.slice(0, 6).join(" | ")}`);
    check(`${name}, ${width} wide: the page is not wider than the window`, m.page <= m.window, `${m.page}`);
  }
}
/** What a table does when it is asked: full texts, columns, widths, heading in sight, keyboard. */
export async function tablesBehave(p) {
  await p.setViewportSize({ width: 1024, height: 900 });
  const list = ".list-table";
  await p.$eval(".list-table", (e) => e.scrollIntoView({ block: "start" }));
  const titles = () => p.$$eval(`${list} [role=columnheader] button`, (b) => b.map((e) => e.textContent.replace(/\s[↑↓]$/, "")));
  const before = await titles();
  const menu = "#worst details:has(.columns)";
  await p.click(`${menu} summary`);
  await p.waitForSelector(`${menu} input`); // the menu is filled by an event of its own
  const boxes = await p.$$eval(`${menu} input`, (b) => b.map((e) => [e.value, e.checked]));
  same("the chooser ticks the columns in sight", boxes.filter((b) => b[1]).length, before.length);
  const off = boxes.find((b) => !b[1])?.[0];
  await p.click(`${menu} input[value=gap]`);
  check("a column can be taken away", !(await titles()).includes("Gap"));
  if (off) { await p.click(`${menu} input[value=${off}]`); same("and another one brought in", (await titles()).length, before.length); }
  await p.click(`${menu} button`);
  same("as many as fit: the columns of before", await titles(), before);
  await p.keyboard.press("Escape"); await p.click("#worst h2");
  const title = (n) => p.$(`${list} [role=columnheader]:nth-child(${n})`);
  const index = before.indexOf("Main part") + 1;
  const box = await (await title(index)).boundingBox();
  await p.mouse.move(box.x + box.width - 3, box.y + 15);
  await p.mouse.down();
  await p.mouse.move(box.x + box.width - 43, box.y + 15, { steps: 4 });
  await p.mouse.up();
  const narrow = (await (await title(index)).boundingBox()).width;
  check("a width can be dragged", Math.abs(box.width - narrow - 40) < 6, `${box.width} ${narrow}`);
  await p.click(`${list} [role=columnheader]:nth-child(1) button`);
  check("the width stays when the rows are sorted", Math.abs((await (await title(index)).boundingBox()).width - narrow) < 2);
  const depths = await p.$$eval(`${list} [data-key=depth]`, (c) => c.map((e) => Number(e.textContent)));
  check("a click on a heading sorts the other way", depths.every((d, i) => i === 0 || d >= depths[i - 1]));
  await p.click(`${list} [role=columnheader]:nth-child(1) button`);
  await p.$eval(`${list} .vt-body`, (e) => (e.scrollTop = 900));
  await p.waitForTimeout(50);
  const stuck = await p.$eval(`${list} .vt-body`, (e) => Math.abs(e.querySelector(".vt-head").getBoundingClientRect().top - e.getBoundingClientRect().top) < 2);
  check("the headings stay in sight", stuck);
  // Full text of what is cut: under the mouse, and at the cell of the keyboard.
  await p.evaluate(() => window.deckReport.report.select(null));
  await p.$eval(`${list} .vt-body`, (e) => (e.scrollTop = 0));
  const full = () => p.$$eval(".full-text:not([hidden])", (e) => e.map((x) => x.textContent).join());
  const cell = ".interfaces-table .vt-row [data-key=title]:has(.fold)";
  const said = await p.$eval(`${cell} .named[data-name]`, (e) => e.dataset.name);
  await p.hover(cell);
  const hovered = await full();
  same("a folded title is said in full under the mouse", hovered, said);
  await p.focus(".interfaces-table .vt-body");
  for (let i = 0; i < 12 && !(await full()); i++) await p.keyboard.press(i === 0 ? "ArrowDown" : i % 3 === 1 ? "ArrowRight" : "ArrowDown");
  check("and at the cell of the keyboard", (await full()).length > 0);
  await p.keyboard.press("Escape");
}
