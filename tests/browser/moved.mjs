// The pages of `deck fix --html` and `deck diff --html`: moved nodes against the JSON, the mesh before and after, what was solved.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { accessible } from "./axe.mjs";
import { cells, check, deck, done, open, pageOf, same, sample, scratch, settled, shot } from "./support.mjs";
/** Largest height of a part's vertices as they are drawn. */
const height = (p, part) =>
  p.evaluate((id) => {
    const { report, viewport } = window.deckReport;
    const x = viewport.view.parts.parts.find((q) => report.partId(q.data.part) === id).data.position;
    return Math.max(...x.filter((_, i) => i % 3 === 2));
  }, part);
async function patchOf(p) {
  const [download] = await Promise.all([p.waitForEvent("download"), p.click("#repair button:has-text('Save the patch')")]);
  return readFileSync(await download.path(), "utf8");
}
export async function repairPages(browser) {
  const call = [sample("too_close"), "--strategy", "move-nodes", "--max-moved", "100%"];
  const json = JSON.parse(deck("fix", ...call, "--quiet", "--json", "-"));
  let p = await open(browser, pageOf("fix", "fix", ...call), { acceptDownloads: true });
  const shown = await p.evaluate(() => window.deckReport.report.moved.rows.map((r) => [window.deckReport.report.nodeId(r[0]), Math.hypot(r[1], r[2], r[3]), window.deckReport.report.partId(r[4])]));
  const sorted = (list) => list.map(([id, d, part]) => `${id} ${d.toPrecision(6)} ${part}`).sort();
  same("repair: nodes, lengths and parts are those of the JSON", sorted(shown), sorted(json.moved.map((m) => [m.node, m.distance, m.part])));
  const byPart = await cells(p, "#moved");
  same("repair: one row a part", byPart.filter((r) => r.nodes).map((r) => [parseInt(r.part), Number(r.nodes)]).sort(), [[1, 9], [2, 9]]);
  const after = await height(p, 2);
  await p.click("#moved button:has-text('Before')");
  const before = await height(p, 2);
  const most = Math.max(...json.moved.filter((m) => m.part === 2).map((m) => m.by[2]));
  check("repair: 'Before' puts the nodes back in the picture", Math.abs(after - before - most) < 1e-4 && most > 0.1, `${before} ${after}`);
  await shot(p, "repair");
  await p.click("#moved button:has-text('After')");
  same("repair: and 'After' where they stand now", await height(p, 2), after);
  same("repair: what was solved is counted", await p.$eval(".compare .solved b", (e) => Number(e.textContent)), json.interfaces[0].before.nodes);
  same("repair: everything was treated, and the patch is that of --diff", [await p.$$eval(".refused-table .vt-row", (r) => r.length), await patchOf(p)], [json.not_treated.length, deck("fix", ...call, "--quiet", "--diff")]);
  await p.click(".moved-table .vt-row"); await settled(p);
  await accessible(p, "repair");
  await done(p, "repair");
  // What is left, why, and what to call next.
  const half = [sample("crash_box"), "--strategy", "move-nodes"];
  const left = JSON.parse(deck("fix", ...half, "--quiet", "--json", "-")).not_treated;
  p = await open(browser, pageOf("fix", "fix_some", ...half), { viewport: { width: 1280, height: 800 } });
  same("repair: what was not treated is that of the JSON", (await p.$eval("#repair .count", (e) => parseInt(e.textContent))), left.length);
  const listed = await p.$eval(".reasons", (e) => e.textContent);
  check("repair: every reason is said", left.length > 0 && left.every((r) => listed.includes(r.reason)), listed);
  same("repair: at most eight bullets, each with its next command", await p.$$eval(".reasons li", (all) => all.length > 0 && all.length <= 8 && all.every((e) => /^deck (fix|gaps) /.test(e.querySelector("code").textContent))), true);
  await p.click(".refused-table .vt-row"); await settled(p);
  const commands = await p.$$eval(".next code", (c) => c.map((e) => e.textContent));
  check("repair: the next commands are there", commands.length === 3 && commands[0].endsWith("--strategy move-nodes -o fixed") && commands[1].endsWith("--crossings") && commands[2].endsWith("--interface 2"), commands.join("; "));
  for (const c of commands) {
    const words = c.split(" ").slice(1).map((w) => (w === "fixed" ? join(scratch, "fixed") : w.replace(/^fixed\//, `${scratch}/fixed/`)));
    check(`repair: ${words[0]} ${words.at(-1)} can be called`, deck(...words, "--quiet") !== null);
  }
  await accessible(p, "repair, some left");
  await shot(p, "repair_left");
  await done(p, "repair, some left");
  // Two decks: the patch applied, against the old one.
  const folder = join(scratch, "mended");
  deck("fix", ...call, "--quiet", "-o", folder);
  p = await open(browser, pageOf("diff", "diff", call[0], `${folder}/too_close_0000.rad`));
  same("difference: the same nodes have moved", (await p.evaluate(() => window.deckReport.report.moved.rows.map((r) => window.deckReport.report.nodeId(r[0])))).sort(), json.moved.map((m) => m.node).sort());
  check("difference: the page says what it is", (await p.$eval(".brand", (e) => e.textContent)) === "deck diff");
  await done(p, "difference");
}
