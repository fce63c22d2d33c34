// The page of `deck cycle --html`: effects, the fields that ask for them and their costs against the JSON; forces and time
// steps in the picture against the JSON; keyboard, axe, widths.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, reachable } from "./axe.mjs";
import { check, deck, done, open, run, same, sample, scratch, settled, shot } from "./support.mjs";
import { pageFits } from "./tables.mjs";
import { banner } from "./verdict.mjs";
/** What is shown against what was measured. */
async function costs(p, data) {
  await banner(p, "first cycle");
  const head = await p.$eval("#effects h2", (e) => e.textContent), on = data.effects.filter((e) => e.on);
  check("the head says how many effects run", head.includes(`${on.length} of ${data.effects.length} effects`), head);
  const round = (v) => `${Math.abs(v) < 10 ? v.toFixed(1) : v.toFixed(0)} ns`;
  const bars = await p.$$eval(".bars tr", (b) => b.map((e) => ({ text: e.textContent, width: e.querySelector(".bar").getBoundingClientRect().width })));
  const loops = [data.costs.loop_ns, data.costs.flags_ns, data.costs.all_ns];
  same("three bars, as long as their times", bars.map((b) => loops.findIndex((v) => b.text.includes(`${round(v)} a pair`)) >= 0), [true, true, true]);
  check("everything is the longest", bars[2].width >= bars[0].width, JSON.stringify(bars));
  check("the note says that the answers are equal bit for bit", (await p.textContent("#effects")).includes("equal bit for bit"));
  const rows = await p.$$eval("#effects .sums tbody tr", (r) => r.map((e) => ({ name: e.dataset.effect, cells: [...e.querySelectorAll("td")].map((c) => c.textContent) })));
  same("a row for every effect, those that run first", rows.map((r) => r.name), data.effects.map((e) => e.name));
  for (const [k, e] of data.effects.entries()) {
    const cost = e.ns === undefined ? "–" : e.low > 0 ? round(e.ns) : `under ${round(Math.max(e.high, 0.1))}`;
    same(`${e.name}: in how many interfaces, and what it costs`, rows[k].cells.slice(2, 4), [`${e.in}/${e.of}`, cost]);
    check(`${e.name}: who asks for it, or what would begin it`, rows[k].cells[1] === (e.on ? e.because : (e.against ?? `off: ${e.because}`)), rows[k].cells[1]);
  }
  const timed = data.interfaces.flatMap((i) => i.contacts).filter((c) => !c.cost.problem), kinds = timed.map((c) => `${c.kind} ${c.cost.effects.filter((e) => e.on).map((e) => e.name)}`);
  check("no cost is negative, none is of fewer than 100 pairs, equal effects are timed once", timed.every((c) => c.cost.measured >= 100) && new Set(kinds).size === kinds.length && !(await p.$$eval("#effects td", (t) => t.some((e) => /^-\d/.test(e.textContent)))), kinds.join("; "));
  await p.click("#effects .by-interface summary");
}
/** Every cell of the matrix, and one of each kind in words. */
async function matrix(p, data, path) {
  const names = await p.$$eval("table.effects thead th", (t) => t.map((e) => e.dataset.name));
  const rows = await p.$$eval("table.effects tbody tr", (r) => r.map((e) => [parseInt(e.querySelector("th").textContent), ...[...e.querySelectorAll("td")].map((c) => c.classList.contains("on"))]));
  same("one row per interface", rows.map((r) => r[0]), data.interfaces.map((i) => i.id));
  const wrong = rows.flatMap((r, k) => names.filter((n, c) => r[c + 1] !== (data.interfaces[k].effects.find((e) => e.name === n)?.on ?? false)).map((n) => `${r[0]} ${n}`));
  check("cells are filled where the effect runs", wrong.length === 0, wrong.join(" "));
  // By mouse, then by keyboard: the detail names the line that decides, and the line holds the field's value.
  const inter = data.interfaces.find((i) => i.effects.some((e) => e.on && e.name.startsWith("friction-")));
  const effect = inter.effects.find((e) => e.on && e.name.startsWith("friction-"));
  const row = data.interfaces.indexOf(inter);
  await p.click(`#ef-${row}-${names.indexOf(effect.name)}`);
  const detail = await p.$eval(".effect-detail", (e) => e.textContent);
  check("a cell says which field on which line asks for the effect", detail.includes(`${effect.source.file.split("/").pop()}:${effect.source.line}`) && detail.includes(effect.because), detail);
  const line = readFileSync(path, "utf8").split("\n")[effect.source.line - 1];
  const value = /= (\S+)/.exec(effect.because)[1];
  check("the line of the deck has that value in that column", line.slice(effect.source.column - 1).trim().startsWith(value), `${line} ${value}`);
  same("choosing a cell filters by its interface", await p.evaluate(() => window.deckReport.report.meta.interfaces[window.deckReport.report.filter.interface]?.id), inter.id);
  await p.focus("table.effects");
  await p.keyboard.press("ArrowRight"); await p.keyboard.press("Enter");
  const next = names[Math.min(names.indexOf(effect.name) + 1, names.length - 1)];
  check("arrows and Enter do the same", (await p.$eval(".effect-detail h3", (e) => e.textContent)).startsWith(next), next);
  await p.evaluate(() => window.deckReport.report.setFilter({ interface: null }));
}
/** Nodes with forces: the picture has what the JSON says. */
async function forces(p, path) {
  const all = JSON.parse(deck("cycle", path, "--all", "--quiet", "--json", "-")).nodes;
  const mine = await p.evaluate(() => window.deckReport.report.cycle.nodes.map((n) => ({ node: window.deckReport.report.nodeId(n[0]), force: n.slice(1, 4), stiffness: n[4], dt: n[5] })));
  check("there are nodes with forces", all.some((n) => Math.hypot(...n.force) > 0));
  same("forces, stiffness and steps of the nodes are those of the JSON", mine, all);
  same("the page opens with forces in the picture", await p.$eval(".legend-title", (e) => e.textContent), "Nodal contact force (kN)");
  await settled(p);
  const seen = await p.evaluate(() => {
    const { view } = window.deckReport.viewport;
    return { count: view.markers.list.length, first: view.markers.list[0], visible: view.markers.arrows.visible };
  });
  const pushed = all.filter((n) => Math.hypot(...n.force) > 0);
  same("an arrow per node that is pushed", [seen.count, seen.visible], [pushed.length, true]);
  const most = pushed.reduce((a, b) => (Math.hypot(...a.force) >= Math.hypot(...b.force) ? a : b));
  same("the longest arrow is the largest force, along it", [seen.first.length, seen.first.along], [1, most.force]);
  const steps = all.filter((n) => n.dt !== null).map((n) => n.dt);
  await p.keyboard.press("8");
  const ticks = await p.$$eval(".legend-ticks span", (t) => t.map((e) => e.textContent));
  const smallest = Math.min(...steps);
  check("time steps: the scale ends at the smallest", Math.abs(Number(ticks[0]) / smallest - 1) < 0.01 && ticks.at(-1) === "∞", ticks.join(" "));
  const hottest = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const v = viewport.contour.values;
    let best = -1;
    v.forEach((x, i) => x > (v[best] ?? -1) && (best = i));
    return report.nodeId(best);
  });
  same("the hottest node has the smallest step", all.find((n) => n.node === hottest).dt, smallest);
  await p.keyboard.press("6");
}
export async function effectsPage(browser) {
  const path = sample("crash_box");
  const [html, json] = ["html", "json"].map((e) => join(scratch, `cycle.${e}`));
  deck("cycle", path, "--quiet", "--html", html, "--json", json);
  const data = JSON.parse(readFileSync(json));
  const p = await open(browser, html, { viewport: { width: 1440, height: 900 } });
  same("the page holds the JSON document", await p.$eval("#cycle-json", (e) => JSON.parse(e.textContent)), data);
  await costs(p, data);
  await matrix(p, data, path);
  await forces(p, path);
  await pageFits(p, "cycle page");
  await p.setViewportSize({ width: 1440, height: 900 });
  await accessible(p, "cycle page");
  await reachable(p, "cycle page");
  await p.keyboard.press("f"); await settled(p);
  await p.$eval(".left", (e) => e.scrollTo({ top: 0, behavior: "instant" }));
  await shot(p, "cycle");
  await p.keyboard.press("t");
  await accessible(p, "cycle page, dark");
  await shot(p, "cycle_dark");
  await done(p, "cycle page");
  // Without scripts the table is there; a hostile title stays text.
  const evil = '<script>alert(1)</script>"\'&';
  const bad = join(scratch, "cycle_evil_0000.rad");
  writeFileSync(bad, readFileSync(path, "utf8").replace(/^(\/INTER\/TYPE7\/\d+\n).*$/gm, `$1${evil}`));
  deck("cycle", bad, "--quiet", "--html", html);
  const q = await browser.newPage({ javaScriptEnabled: false });
  await q.goto(`file://${html}`);
  const text = await q.$eval("#static", (e) => e.textContent);
  check("without scripts effects and their fields are listed", /friction-incremental/.test(text) && /Iform = 2/.test(text));
  await q.close();
  const r = await open(browser, html);
  check("a hostile title is text in the cycle page", r.trouble.length === 0 && (await r.$$eval(".left script", (e) => e.length)) === 0, r.trouble.join("; "));
  await r.close();
  // With and without an effect, side by side.
  const call = [sample("inacti_variants"), "--without", "gap-reduction", "--quiet"];
  deck("cycle", ...call, "--html", html, "--json", json);
  const both = JSON.parse(readFileSync(json));
  const w = await open(browser, html, { viewport: { width: 1280, height: 800 } });
  const shown = await w.$$eval(".without tbody tr", (rows) => rows.map((e) => [Number(e.dataset.interface), ...[...e.querySelectorAll("td")].map((c) => c.textContent.replace(/ \(.*/, "").replace(/\u202f/g, ""))]));
  const forces_of = (i) => both.interfaces.find((x) => x.id === i).contacts.reduce((n, c) => n + c.sum.sizes, 0);
  check("without an effect: one row an interface", shown.length === both.without.interfaces.length && shown.length > 3, JSON.stringify(shown));
  for (const o of both.without.interfaces) {
    const row = shown.find((r) => r[0] === o.id);
    const near = (text, v) => (v === null ? text === "–" : Math.abs(Number(text) - v) <= 1e-3 * Math.abs(v));
    check(`without an effect: figures of interface ${o.id} are those of the JSON`, near(row[1], forces_of(o.id)) && near(row[2], o.force_sum) && near(row[4], o.elastic_energy) && near(row[6], o.contact_dt), JSON.stringify([row, o, forces_of(o.id)]));
  }
  check("without an effect: what changes is marked and stands first", (await w.$$eval(".without tbody tr", (r) => r.map((e) => e.querySelector(".changed") !== null))).join() === [...shown.map((_, i) => i < shown.filter((r) => r[1] !== r[2]).length)].join());
  await accessible(w, "with and without an effect");
  await shot(w, "cycle_without");
  await done(w, "with and without an effect");
  const refused = run("cycle", path, "--quiet", "--html", html, "--steps", "3", "--dt", "1e-3");
  check("--html with --steps is refused with a reason", refused.code === 2 && /--steps/.test(refused.err), refused.err);
}
