// The page of `deck parts --html`: the table of the parts against the JSON, the colours of the steps, a part shown alone.
import { accessible } from "./axe.mjs";
import { cells, check, deck, done, gaps, open, pageOf, same, sample, settled, shot } from "./support.mjs";
export async function partsPage(browser) {
  const path = sample("crash_box");
  const json = JSON.parse(deck("parts", path, "--all", "--json", "-", "--quiet"));
  const p = await open(browser, pageOf("parts", "parts", path));
  const rows = await cells(p, ".parts-table");
  const number = (v) => String(+v.toPrecision(4));
  const wanted = [...json.parts].sort((a, b) => a.dt.min - b.dt.min);
  same("parts: one row a part, the smallest step first", rows.map((r) => [r.id, r.mass, r.step]), wanted.map((q) => [String(q.id), number(q.mass), number(q.dt.min)]));
  same("parts: the verdict is that of deck gaps", await p.evaluate(() => window.deckReport.report.meta.verdict.text), gaps(path).verdict.text);
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
  await p.click(".parts-table .vt-row"); await settled(p);
  const solid = await p.evaluate(() => window.deckReport.viewport.view.parts.parts.filter((q) => q.look === "solid").map((q) => window.deckReport.report.partId(q.data.part)));
  same("parts: a part that is chosen is shown alone", solid, [wanted[0].id]);
  await accessible(p, "parts");
  await done(p, "parts");
}
