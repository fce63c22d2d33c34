// The page of `deck parts --html`: the table of the parts against the JSON, the colours of the steps, a part shown alone.
import { join } from "node:path";
import { accessible } from "./axe.mjs";
import { check, deck, open, same, sample, settled } from "./support.mjs";

export async function partsPage(browser, scratch, shot) {
  const path = sample("crash_box");
  const file = join(scratch, "parts.html");
  deck("parts", path, "--quiet", "--html", file);
  const json = JSON.parse(deck("parts", path, "--all", "--json", "-", "--quiet"));
  const gaps = JSON.parse(deck("gaps", path, "--json", "-", "--quiet"));
  const p = await open(browser, file);
  const rows = await p.$$eval(".parts-table .vt-row", (all) => all.map((r) => Object.fromEntries([...r.children].map((c) => [c.dataset.key, c.textContent.replace(/\u202f/g, "")]))));
  const number = (v) => String(+v.toPrecision(4));
  const wanted = [...json.parts].sort((a, b) => a.dt.min - b.dt.min);
  same("parts: one row a part, the smallest step first", rows.map((r) => [r.id, r.mass, r.step]), wanted.map((q) => [String(q.id), number(q.mass), number(q.dt.min)]));
  same("parts: the verdict is that of deck gaps", await p.evaluate(() => window.deckReport.report.meta.verdict.text), gaps.verdict.text);
  // By node of the page: the smallest step of its elements, within a class of the scale.
  const dt = new Map(json.elements.map((e) => [`${e.kind} ${e.id}`, e.dt]));
  const low = Math.min(...dt.values());
  const high = Math.max(...dt.values());
  const steps = await p.evaluate(() => ({ low: window.deckReport.report.steps.low, largest: window.deckReport.report.steps.largest }));
  same("parts: the scale ends at the smallest and largest step", [steps.low, steps.largest], [low, high]);
  const slowest = json.total.dt.element;
  const hottest = await p.evaluate(() => {
    const { report } = window.deckReport;
    return [...report.steps.values].flatMap((v, n) => (v === 1 ? [report.nodeId(n)] : []));
  });
  const shown = JSON.parse(deck("show", path, `${slowest.kind === "shell4" ? "shell" : slowest.kind}:${slowest.id}`, "--json", "-", "--quiet"));
  const own = JSON.stringify(shown).match(/\d+/g).map(Number);
  check("parts: the nodes of the slowest element are the hottest", hottest.length >= 3 && hottest.filter((n) => own.includes(n)).length >= 3, JSON.stringify(hottest));
  same("parts: colours show the element time step", await p.$eval("select[aria-label='Colours show']", (s) => s.selectedOptions[0].textContent), "Element time step");
  await shot(p, "parts");
  await p.click(".parts-table .vt-row");
  await settled(p);
  const solid = await p.evaluate(() => window.deckReport.viewport.view.parts.parts.filter((q) => q.look === "solid").map((q) => window.deckReport.report.partId(q.data.part)));
  same("parts: a part that is chosen is shown alone", solid, [wanted[0].id]);
  await accessible(p, "parts");
  check("parts: no console error and no request", p.trouble.length === 0, p.trouble.join("; "));
  await p.close();
}
