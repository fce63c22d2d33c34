// What the picture shows and says, without looking at its pixels.
import { readFileSync } from "node:fs";
import { check, same, settled } from "./support.mjs";
const looks = (p) => p.evaluate(() => window.deckReport.viewport.view.parts.parts.filter((x) => x.faces).map((x) => x.look));
const every = (list, what) => list.length > 0 && list.every((l) => l === what);
const inSight = (p) =>
  p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const r = viewport.view.canvas.getBoundingClientRect();
    return report.filtered.filter((x) => {
      const at = viewport.view.screen(x);
      return at && at.x > r.x && at.x < r.right && at.y > r.y && at.y < r.bottom;
    }).length / report.filtered.length;
  });
/** `p` shows the crash box, of which `path` is the deck. */
export async function picture(p, path) {
  // Penetrations first.
  check("at first what penetrates is solid and the rest see-through", every(await looks(p), "hot"));
  const hot = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const shown = new Set();
    for (const part of viewport.view.parts.parts) if (part.hot) for (const e of part.hot.userData.triangleElement) shown.add(part.element[e]);
    const wanted = new Set(report.filtered.map((x) => report.elementId(x.row, "main")));
    return { shown: shown.size, missing: [...wanted].filter((id) => !shown.has(id)).length, all: viewport.view.parts.parts.reduce((n, x) => n + x.element.length, 0) };
  });
  check("every main element that is penetrated is among the solid ones, and not everything is", hot.missing === 0 && hot.shown > 0 && hot.shown < hot.all, JSON.stringify(hot));
  await p.keyboard.press("h");
  check("h shows nothing but what penetrates", every(await looks(p), "only"));
  await p.keyboard.press("h"); await p.keyboard.press("o");
  check("o makes everything solid", every(await looks(p), "solid"));
  await p.keyboard.press("o");

  // An interface is isolated, zoomed to, and its sides told apart.
  await p.evaluate(() => window.deckReport.viewport.toggle("crossed"));
  const all = await p.evaluate(() => window.deckReport.viewport.crossedShown.length);
  await p.click(".interfaces-table .vt-row:has-text('tube rim on barrier')"); await settled(p);
  const chosen = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const sides = report.sidesOf(report.filter.interface);
    const of = (side) => viewport.view.parts.parts.filter((x) => x.side === side).map((x) => x.data.part);
    return {
      ghosts: viewport.view.parts.parts.filter((x) => x.look === "ghost").every((x) => !sides.main.has(x.data.part) && !sides.secondary.has(x.data.part)),
      secondary: of("secondary").length, main: of("main").length, behind: ["secondary", "main"].map((side) => viewport.view.parts.parts.filter((x) => x.side === side && x.hot).map((x) => x.hot.material.polygonOffsetUnits)),
      crossed: viewport.crossedShown.every((r) => report.meta.contacts[r[0]].interface === report.filter.interface), count: viewport.crossedShown.length,
    };
  });
  check("only the parts of the chosen interface are not see-through", chosen.ghosts);
  check("both sides have a colour of their own", chosen.secondary > 0 && chosen.main > 0, JSON.stringify(chosen));
  check("of skins on one another the main one is drawn behind", Math.max(...chosen.behind[0]) < Math.min(...chosen.behind[1]), JSON.stringify(chosen.behind));
  check("crossed elements are those of the chosen interface", chosen.crossed && chosen.count < all, `${chosen.count} of ${all}`);
  check("the picture zooms to the penetrations of the interface", (await inSight(p)) === 1);
  await p.evaluate(() => window.deckReport.viewport.toggle("crossed"));
  same("crossed elements can be switched off", await p.evaluate(() => window.deckReport.viewport.crossedShown.length), 0);

  // A row: node and segment are named.
  await p.evaluate(() => window.deckReport.report.select(window.deckReport.report.filtered.find((x) => !x.row.onSurface)));
  await settled(p);
  const named = await p.evaluate(() => {
    const { report } = window.deckReport;
    return { labels: [...document.querySelectorAll("#view .label:not([hidden])")].map((e) => e.textContent).join(" | "), node: report.secondaryText(report.selected.row), segment: report.mainText(report.selected.row) };
  });
  check("the picture names node and segment of the row", named.labels.includes(named.node) && named.labels.includes(named.segment), named.labels);
  await p.keyboard.press("Escape");
  await p.keyboard.press("Escape");

  // One meaning of colours.
  const bar = () => p.$eval(".legend-bar", (e) => e.style.background);
  const light = await bar();
  await p.keyboard.press("t");
  same("colours mean the same on dark ground", await bar(), light);
  await p.keyboard.press("t");
  const lightness = [...light.matchAll(/rgb\((\d+), ?(\d+), ?(\d+)\)/g)].map((m) => 0.2126 * m[1] + 0.7152 * m[2] + 0.0722 * m[3]);
  check("deeper is darker all the way", lightness.length > 20 && lightness.every((l, i) => i === 0 || l <= lightness[i - 1] + 0.5), lightness.join(" "));

  // Picking and measuring.
  await p.evaluate(() => window.deckReport.viewport.toggle("solid"));
  const pickable = () => p.evaluate(() => {
    const { viewport } = window.deckReport;
    const r = viewport.view.canvas.getBoundingClientRect();
    const out = [];
    for (let y = 0.3; y < 0.8; y += 0.04)
      for (let x = 0.3; x < 0.7; x += 0.04) {
        const at = [r.x + x * r.width, r.y + y * r.height];
        const picked = viewport.view.pick(...at);
        if (picked.part && picked.node >= 0 && !out.some((o) => o.node === picked.node)) out.push({ at, node: picked.node, id: picked.part.element[picked.item] });
      }
    return out;
  });
  await settled(p);
  let spots = await pickable();
  if (check("there is something to pick", spots.length > 4)) {
    await p.mouse.click(...spots[0].at);
    await settled(p);
    const said = await p.$eval("#view .tip:not(.ruler)", (e) => e.textContent);
    check("picking says part, property and thickness", /part \d+/.test(said) && /property \d+/.test(said) && /thickness [\d.]+/.test(said), said);
    const line = Number(/:(\d+)$/.exec(said)?.[1]);
    const text = readFileSync(path, "utf8").split("\n")[line - 1] ?? "";
    check("and the line of the element", Number(text.slice(0, 10)) === spots[0].id, `${said}: ${text}`);
    await p.keyboard.press("Escape"); await settled(p);
    await p.keyboard.press("m");
    spots = await pickable(); // a row of the page may have come or gone
    await p.mouse.click(...spots[0].at);
    await p.mouse.click(...spots.at(-1).at);
    const measured = await p.$eval("#view .ruler", (e) => e.textContent);
    const want = await p.evaluate(([a, b]) => {
      const { report } = window.deckReport;
      const x = report.nodePositions;
      return { d: Math.hypot(...[0, 1, 2].map((k) => x[3 * a + k] - x[3 * b + k])), ids: [a, b].map((n) => report.nodeId(n)) };
    }, [spots[0].node, spots.at(-1).node]);
    check("the ruler says the distance of two nodes", Math.abs(parseFloat(measured) - want.d) <= 1e-5 * want.d && want.ids.every((id) => measured.includes(`node ${id}`)), `${measured} ${JSON.stringify(want)}`);
    await p.keyboard.press("m");
  }
  await p.evaluate(() => window.deckReport.viewport.toggle("solid"));
}
/** Section planes through solids and shells. */
export async function section(p) {
  await p.keyboard.press("x"); await p.click(".clip-row:nth-child(2) input[type=checkbox]");
  const cut = await p.evaluate(() => {
    const { section } = window.deckReport.viewport.view;
    const lines = section.group.children.filter((c) => c.isLineSegments);
    const off = lines.map((l, i) => {
      const x = l.geometry.attributes.position.array;
      let most = 0;
      for (let k = 0; k < x.length; k += 3) most = Math.max(most, Math.abs(section.planes[i].normal.x * x[k] + section.planes[i].normal.y * x[k + 1] + section.planes[i].normal.z * x[k + 2] + section.planes[i].constant));
      return { count: x.length / 6, most };
    });
    return { planes: section.planes.length, off, caps: section.group.children.filter((c) => c.geometry?.type === "PlaneGeometry").length, radius: window.deckReport.viewport.view.control.radius };
  });
  same("there are two section planes", cut.planes, 2);
  check("the section's lines lie on their planes", cut.off.every((o) => o.count > 0 && o.most < 1e-4 * cut.radius), JSON.stringify(cut.off));
  same("solids are capped on both", cut.caps, 2);
  await p.keyboard.press("x");
  same("x takes the planes away", await p.evaluate(() => window.deckReport.viewport.view.section.planes.length), 0);
}
