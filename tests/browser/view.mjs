// What can be set in the picture: limits of the colours, parallel projection, what is measured, the mouse; and what is
// nearest where nothing penetrates.
import { accessible } from "./axe.mjs";
import { check, done, gaps, open, page, same, sample, settled, shot } from "./support.mjs";
const near = (a, b, share = 1e-3) => Math.abs(a - b) <= share * Math.abs(b);
/** `file`: the page of the crash box. */
export async function viewTools(browser, file) {
  const p = await open(browser, file, { viewport: { width: 1280, height: 800 } });
  await settled(p);
  const ticks = () => p.$$eval(".legend-ticks span", (t) => t.map((e) => Number(e.textContent)));
  same("the legend has the unit of a length", await p.$eval(".legend-title", (e) => e.textContent), "Penetration depth (mm)");
  await p.click(".legend-limits summary");
  const set = async (box, value) => { await p.fill(box, value); await p.keyboard.press("Enter"); };
  await set(".legend-low", "0.2");
  await set(".legend-high", "1");
  same("the scale has the limits that were set", await ticks(), [1, 0.8, 0.6, 0.4, 0.2]);
  const place = (v) => p.evaluate((depth) => {
    const { report, viewport } = window.deckReport;
    const hit = report.filtered.reduce((a, b) => (Math.abs(b.depth - depth) < Math.abs(a.depth - depth) ? b : a));
    return { depth: hit.depth, place: viewport.contour.of(hit) };
  }, v);
  let at = await place(0.5);
  check("a depth between them has its place", near(at.place, (Math.min(Math.max(at.depth, 0.2), 1) - 0.2) / 0.8), JSON.stringify(at));
  same("what is deeper has the colour of the upper limit", (await place(1.6)).place, 1);
  await p.check(".legend-log");
  await set(".legend-low", "0.01");
  at = await place(0.5);
  check("equal ratios", near(at.place, Math.log(Math.min(at.depth, 1) / 0.01) / Math.log(100)), JSON.stringify(at));
  same("the ticks are equal ratios", await ticks(), [1, 0.316, 0.1, 0.0316, 0.01]);
  await p.selectOption(".legend-steps", "6");
  const colors = await p.evaluate(() => new Set(Array.from({ length: 200 }, (_, i) => window.deckReport.viewport.color(i / 200).join())).size);
  same("six steps are six colours", colors, 6);
  await p.check(".legend-maximum");
  await p.keyboard.press("Escape"); await settled(p);
  const label = await p.$eval("#view .label:not([hidden])", (e) => e.textContent);
  const deepest = await p.evaluate(() => ({ depth: window.deckReport.report.deepest.depth, nodes: [...window.deckReport.report.secondaryNodes(window.deckReport.report.deepest.row), ...window.deckReport.report.mainNodes(window.deckReport.report.deepest.row)].map((n) => window.deckReport.report.nodeId(n)) }));
  const said = /^largest (\S+) at node (\d+)$/.exec(label);
  check("the largest value is labelled where it is", said !== null && near(Number(said[1]), deepest.depth), `${label} ${JSON.stringify(deepest)}`);
  await p.waitForFunction(() => /low=0.01/.test(location.hash) && /log=yes/.test(location.hash) && /maximum=yes/.test(location.hash));
  await shot(p, "legend");
  await accessible(p, "legend with limits");
  await p.keyboard.press("2");
  check("another kind of values has limits of its own", (await ticks()).at(-1) === 0);
  await p.keyboard.press("1");

  // Parallel projection: what is far is not smaller, and picking goes on.
  await p.keyboard.press("o"); await p.keyboard.press("v");
  await settled(p);
  const sizes = await p.evaluate(() => {
    const { view } = window.deckReport.viewport;
    const Vector = view.control.center.constructor;
    const q = view.control.camera.quaternion;
    const side = new Vector(1, 0, 0).applyQuaternion(q);
    const away = new Vector(0, 0, -1).applyQuaternion(q);
    return [-0.5, 0.5].map((k) => {
      const a = view.control.target.clone().addScaledVector(away, k * view.control.radius);
      const [s, t] = [view.place(a), view.place(a.clone().addScaledVector(side, 0.2 * view.control.radius))];
      return Math.hypot(s.x - t.x, s.y - t.y);
    });
  });
  check("in parallel projection near and far things are of one size", near(sizes[0], sizes[1], 1e-6) && sizes[0] > 20, JSON.stringify(sizes));
  const picked = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const r = viewport.view.canvas.getBoundingClientRect();
    const x = report.nodePositions;
    const Vector = viewport.view.control.center.constructor;
    const out = [];
    for (let i = 3; i < 8; i++)
      for (let k = 3; k < 8; k++) {
        const at = [r.x + (i / 10) * r.width, r.y + (k / 10) * r.height];
        const got = viewport.view.pick(...at);
        if (!got.part || got.node < 0) continue;
        const n = viewport.view.place(new Vector(x[3 * got.node], x[3 * got.node + 1], x[3 * got.node + 2]));
        out.push(Math.hypot(n.x - at[0], n.y - at[1]));
      }
    return out;
  });
  check("picking finds a corner near the cursor there", picked.length > 3 && Math.max(...picked) < 60, JSON.stringify(picked));
  await p.keyboard.press("v");

  // From a node to the surface of a part.
  await p.keyboard.press("m");
  await p.selectOption(".ruler select", "surface");
  const measured = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const hit = report.filtered.find((x) => !x.row.onSurface && !report.isEdge(x.row));
    const part = viewport.view.partByIndex(hit.mainPart);
    const [node] = report.secondaryNodes(hit.row);
    viewport.ruler.take({ hit: null, part, item: 0, node });
    viewport.ruler.take({ hit: null, part, item: 0, node: part.data.node[0] });
    return { said: document.querySelector("#view .ruler").textContent, distance: hit.row.distance, node: report.nodeId(node) };
  });
  check("the distance of a node and a part is that of the pair", near(parseFloat(measured.said), measured.distance, 2e-3) && measured.said.includes(`node ${measured.node}`), JSON.stringify(measured));
  await p.keyboard.press("m");

  // The mouse as other programs have it.
  const drag = async (button, key) => {
    const before = await p.evaluate(() => window.deckReport.viewport.view.control.pose.split(",").map(Number));
    const box = await p.$eval("#view canvas", (e) => e.getBoundingClientRect().toJSON());
    if (key) await p.keyboard.down(key);
    await p.mouse.move(box.x + 200, box.y + 400);
    await p.mouse.down({ button });
    await p.mouse.move(box.x + 230, box.y + 440, { steps: 4 });
    await p.mouse.up({ button });
    if (key) await p.keyboard.up(key);
    const after = await p.evaluate(() => window.deckReport.viewport.view.control.pose.split(",").map(Number));
    const moved = (from, to) => Math.hypot(...before.slice(from, to).map((v, k) => v - after[from + k])) > 1e-6;
    return moved(4, 8) ? "turn" : !near(before[3], after[3], 1e-6) ? "zoom" : moved(0, 3) ? "move" : "nothing";
  };
  const scheme = async (name) => {
    await p.keyboard.press("?");
    await p.selectOption("#mouse-scheme", name);
    await p.keyboard.press("Escape");
  };
  const does = async (list) => {
    const out = [];
    for (const [button, key] of list) out.push(await drag(button, key));
    return out;
  };
  await p.keyboard.press("f");
  same("the mouse of the page", await does([["left"], ["left", "Shift"], ["middle"]]), ["turn", "move", "move"]);
  await scheme("control");
  same("the mouse with Ctrl", await does([["left", "Control"], ["middle", "Control"], ["right", "Control"]]), ["turn", "zoom", "move"]);
  await scheme("shift");
  same("the mouse with Shift", await does([["left", "Shift"], ["middle", "Shift"], ["right", "Shift"]]), ["turn", "move", "zoom"]);
  await done(p, "the picture's tools");
}
/** A page without penetrations says what is nearest: a gap a little larger is penetrated there and nowhere else. */
export async function nearest(browser) {
  const path = sample("clean_plates");
  const p = await open(browser, page("nearest", path), { viewport: { width: 1280, height: 800 } });
  await p.waitForSelector(".nearest-table .vt-row");
  const row = await p.evaluate(() => {
    const { report } = window.deckReport;
    const r = report.evaluator.nearest(0, report.results[0].setting);
    return { distance: r.distance, gap: r.gap, text: document.querySelector(".nearest-said").textContent, node: report.secondaryText(r) };
  });
  const at = (distance) => gaps(path, "--what-if", `1:Igap=0,Gapmin=${distance}`).interfaces[0].contacts[0].totals.pairs;
  same("no pair is nearer than the one that is named", at(row.distance * (1 - 1e-9)), 0);
  check("and that one is no farther", at(row.distance * (1 + 1e-9)) > 0, JSON.stringify(row));
  check("node, room and gap are said, and what limits the step", row.text.includes(`node ${row.node}`) && row.text.includes(String(row.distance - row.gap)) && /time step is limited by shell \d+: [\d.]+ ms/.test(row.text), row.text);
  await p.click(".nearest-said .link"); await settled(p);
  const shown = await p.evaluate(() => ({ tip: document.querySelector("#view .tip:not(.ruler)").textContent, solid: window.deckReport.viewport.view.parts.parts.filter((x) => x.look === "solid").length }));
  check("the link shows the pair", shown.tip.startsWith("Nearest: node") && shown.solid > 0, JSON.stringify(shown));
  await shot(p, "nearest");
  await accessible(p, "nearest");
  await p.keyboard.press("t");
  await accessible(p, "nearest, dark");
  await done(p, "nearest");
}
