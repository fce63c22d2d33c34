// Ties, TYPE24 and TYPE25 on the page against the JSON: tables, lines and marks in the picture, the panel; what was not
// evaluated is said; and the side view of a pair, to scale.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { accessible } from "./axe.mjs";
import { cells, check, corpus, deck, done, gaps, open, page, same, sample, scratch, settled, shot } from "./support.mjs";
async function ties(browser) {
  const path = sample("welds");
  const json = gaps(path, "--all");
  const p = await open(browser, page("welds", path));
  const lost = (t) => t.nodes.filter((n) => !n.tied && ![1630, 1209].includes(n.message) && !/\((1630|1209)\)/.test(n.why));
  const said = await p.evaluate(() => window.deckReport.report.meta.ties.map((t) => [t.nodes, t.tied, t.lost, t.beyond_rim]));
  same("ties: counts are those of the JSON", said, json.ties.map((t) => [t.summary.nodes, t.summary.tied, lost(t).length, t.summary.outside]));
  const list = await cells(p, ".ties-table");
  check("ties: the row says how many nodes are not tied", list.some((r) => r.id === "2" && r.text === "4 of 10 nodes are not tied"), JSON.stringify(list));
  const untied = await cells(p, ".untied-table");
  same("ties: the untied nodes of the JSON, with distance and search distance", untied.map((r) => `${r.inter} ${r.node} ${r.distance} ${r.search}`),
    json.ties.flatMap((t) => lost(t).map((n) => `${t.id} ${n.node} ${+(n.distance ?? n.nearest.distance).toPrecision(6)} ${+n.search.toPrecision(6)}`)));
  // Lines: one a node that is tied, one a node that is not, none for what something else holds.
  const lines = () => p.evaluate(() => window.deckReport.viewport.view.ties.lines.map((l) => l.geometry.attributes.instanceStart?.count ?? l.geometry.attributes.position.count / 2));
  same("ties: lines in the picture", await lines(), [json.ties.reduce((n, t) => n + t.summary.tied, 0), json.ties.reduce((n, t) => n + lost(t).length, 0)]);
  same("ties: the legend has the colours of the lines", await p.$$eval(".legend .sides .check", (e) => e.map((x) => x.textContent)), ["tied", "not tied"]);
  await p.click(".ties-table .vt-row:has-text('4 of 10')");
  const two = json.ties.find((t) => t.id === 2);
  same("ties: a tie that is chosen is shown alone", await lines(), [two.summary.tied, lost(two).length]);
  same("ties: and its nodes are listed alone", (await cells(p, ".untied-table")).length, lost(two).length);
  await p.click(".untied-table .vt-row"); await settled(p);
  same("ties: the panel says why, in the words of the JSON", await p.$eval(".detail .fate", (e) => e.textContent), lost(two)[0].why);
  await shot(p, "ties");
  await p.keyboard.press("Escape"); await p.keyboard.press("Escape");
  await p.keyboard.press("n");
  same("ties: the key takes the lines away", await lines(), []);
  await accessible(p, "ties");
  await done(p, "ties");
}
async function modern(browser) {
  for (const name of ["airbag_fold", "coated_block"]) {
    const path = sample(name);
    const p = await open(browser, page(name, path));
    const json = gaps(path);
    const rows = (list) => list.map((r) => JSON.stringify([r.interface, r.secondary, r.main, r.depth, r.gap, r.distance, r.normal, r.action, r.stored])).sort();
    const shown = await p.evaluate(() => {
      const { report } = window.deckReport;
      return report.hits.map(({ row: r }) => ({
        interface: report.meta.interfaces[report.meta.contacts[r.contact].interface].id, secondary: report.secondaryNodes(r).map((n) => report.nodeId(n)),
        main: report.data.contacts[r.contact].mainNode.length ? report.mainNodes(r).map((n) => report.nodeId(n)) : [], depth: r.depth, gap: r.gap, distance: r.distance, normal: r.normal, action: r.action, stored: r.stored,
      }));
    });
    const wanted = json.interfaces.flatMap((i) => i.contacts.flatMap((c) => [...c.penetrations, ...(c.edge_penetrations ?? []).filter((r) => r.counted !== false)].map((r) => {
      const main = r.segment ?? r.main_edge;
      return { interface: i.id, secondary: r.edge ?? [r.node], main: main.length === 4 && main[2] === main[3] ? main.slice(0, 3) : main, depth: r.depth ?? r.penetration, gap: r.gap, distance: r.distance, normal: r.normal, action: r.action, stored: r.stored };
    })));
    same(`${name}: rows are those of the JSON, bit for bit`, rows(shown), rows(wanted));
    check(`${name}: counts of the page are those of the program`, await p.evaluate(() => window.deckReport.report.verified));
    // The page tries nothing, and names the command.
    for (const inter of json.interfaces) {
      await p.evaluate((id) => window.deckReport.report.setFilter({ interface: window.deckReport.report.meta.interfaces.findIndex((i) => i.id === id) }), inter.id);
      const panel = await p.$eval("#whatif", (e) => ({ controls: e.querySelectorAll("input, select").length, text: e.textContent }));
      check(`${name} ${inter.id}: no control, and how to try other settings`, panel.controls === 0 && panel.text.includes(`--what-if ${inter.id}:`), JSON.stringify(panel));
    }
    await p.keyboard.press("Escape"); await p.click(".list-table .vt-row");
    await settled(p);
    await shot(p, name);
    await accessible(p, name);
    await done(p, name);
  }
}
/** Lengths of the drawing are those of the row. */
async function sideViews(browser) {
  for (const name of ["inacti_variants", "crossing_edges", "airbag_fold", "coated_block"]) {
    const p = await open(browser, page(`side_${name}`, sample(name)));
    const found = await p.evaluate(() => {
      const { report } = window.deckReport;
      return report.hits.slice(0, 40).map((x) => {
        report.select(x);
        const s = document.querySelector(".side-view");
        const length = (k) => Math.abs(s.querySelector(`.${k}`).y1.baseVal.value - s.querySelector(`.${k}`).y2.baseVal.value) / Number(s.dataset.scale);
        const ids = (text) => text.match(/\d+/g).join("-");
        return {
          want: [x.row.gap, x.row.distance, x.depth], have: [length("gap-length"), length("distance"), length("depth")], text: document.querySelector(".side figcaption").textContent,
          pair: `pair:${ids(report.secondaryText(x.row))}/${ids(report.mainText(x.row))}`, interface: report.meta.interfaces[report.meta.contacts[x.contact].interface].id,
        };
      });
    });
    check(`${name}: the side view is to scale`, found.length > 0 && found.every((f) => f.want.every((v, k) => Math.abs(f.have[k] - v) <= 0.01 * f.want[0])), JSON.stringify(found[0]));
    // The program has the same pair, with the same lengths.
    for (const f of found.filter((_, i) => i % 8 === 0)) {
      const text = deck("show", sample(name), f.pair, "--interface", String(f.interface));
      const have = text.match(/depth (\S+) = gap (\S+) [-+] distance ([^\s:]+)/)?.slice(1).map(Number) ?? [];
      check(`${name} ${f.pair}: deck show has the lengths of the page`, [f.want[2], f.want[0], f.want[1]].every((v, k) => Math.abs(have[k] - v) <= 1e-3 * f.want[0]), JSON.stringify([f, have]));
    }
    check(`${name}: and has its equation`, found.every((f) => /^depth .* = gap .* − distance /.test(f.text)), found[0]?.text);
    await p.close();
  }
}
/** What was not evaluated is not clean. */
async function leftOut(browser) {
  const edges = corpus("../oracle/modern/m24_edge/m24_edge_0000.rad");
  if (!edges) return;
  const path = join(scratch, "left_out_0000.rad");
  writeFileSync(path, readFileSync(edges, "latin1").replace(/^( {9}0 {28}) 1/m, "$1-1"), "latin1"); // Iedge -1
  const p = await open(browser, page("left_out", path));
  const json = gaps(path);
  same("left out: the verdict is that of the JSON", await p.$eval("#verdict", (e) => e.dataset.verdict), json.verdict.level);
  check("left out: the colour is not green", await p.$eval("#verdict", (e) => e.dataset.level !== "good"));
  check("left out: the interface says so", (await cells(p, ".interfaces-table")).some((r) => r.action.includes("not evaluated")));
  await p.close();
}
/** A TYPE10 that ties nothing is as visible as a TYPE2. */
async function untied10(browser) {
  const nothing = ["--what-if", "1:Gapmin=0.001"];
  const json = gaps(sample("tied_layer"), ...nothing);
  const contact = json.interfaces.find((i) => i.id === 1).contacts[0];
  const p = await open(browser, page("untied10", sample("tied_layer"), ...nothing));
  const lost = contact.untied_nodes.length;
  check("TYPE10: nodes are not tied", lost > 0, JSON.stringify(json.verdict));
  same("TYPE10: the chip counts them", parseInt((await p.$eval("[data-chip='Not tied']", (e) => e.textContent)).replace(/\D/g, "")), lost);
  same("TYPE10: the verdict counts them", json.verdict.counts.untied_nodes, lost);
  same("TYPE10: they are listed", await p.$eval("#ties h3 .count", (e) => parseInt(e.textContent.replace(/\D/g, ""))), lost);
  check("TYPE10: nothing says that every node is tied", !(await p.evaluate(() => /Every node is tied/.test(document.body.innerText))));
  check("TYPE10: its row is no clean one", await p.$$eval(".interfaces-table .vt-row", (rows) => rows.some((r) => r.textContent.includes("not tied") && !r.classList.contains("quiet"))));
  await done(p, "TYPE10");
}
/** A point that a TYPE24 puts on a side of a segment is drawn as a point: the side as a whole has no colour. */
async function pointsOnEdges(browser) {
  const path = corpus("../oracle/modern/m24_params/m24_params_0000.rad"), p = path && (await open(browser, page("points", path)));
  if (!p) return;
  const seen = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const isPoint = (x) => report.meta.contacts[x.contact].points, taken = new Set(report.hits.flatMap((x) => [...(isPoint(x) ? [] : report.secondaryNodes(x.row)), ...report.mainNodes(x.row)]));
    const points = report.hits.filter(isPoint), alone = points.flatMap((x) => report.secondaryNodes(x.row).filter((n) => !taken.has(n)));
    report.select(points[0]);
    return { points: points.length, alone: alone.length, coloured: alone.filter((n) => !Number.isNaN(viewport.contour.values[n])).length, head: document.querySelector("#detail h3").textContent };
  });
  check("points on edges: none colours a whole side", seen.points > 0 && seen.alone > 0 && seen.coloured === 0 && seen.head.startsWith("Point on "), JSON.stringify(seen));
  await done(p, "points on edges");
}
export async function tiesAndModern(browser) {
  await ties(browser);
  await untied10(browser);
  await modern(browser);
  await sideViews(browser);
  await leftOut(browser);
  await pointsOnEdges(browser);
}
