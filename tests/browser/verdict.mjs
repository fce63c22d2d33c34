// What is said is what is known: banner and tiles against the verdict of the program, paper with and without a filter, the
// picture that is saved, lengths that no model can need.
import { readFileSync } from "node:fs";
import { cells, check, same, settled } from "./support.mjs";
const plain = (t) => t.replace(/\u202f/g, "");
/** Every sentence of the program stands in the banner; red exactly where the solver stops, green only where nothing is. */
export async function banner(p, name) {
  const seen = await p.evaluate(() => {
    const element = document.getElementById("verdict");
    return { said: window.deckReport.report.meta.verdict, text: element.querySelector(".verdict-text").textContent, level: element.dataset.level,
      tiles: Object.fromEntries([...element.querySelectorAll(".tile")].map((t) => [t.dataset.tile, t.querySelector(".tile-value").textContent])) };
  });
  const { said } = seen;
  check(`${name}: the banner has every sentence`, said.sentences.length > 0 && said.sentences.every((s) => seen.text.replace(/ (kN|mm\/ms²)/g, "").includes(s.text)), seen.text);
  same(`${name}: red exactly where the solver stops`, seen.level === "error", said.level === "stops");
  check(`${name}: green only where nothing is found`, seen.level !== "good" || ["clean", "remarks"].includes(said.level), said.level);
  same(`${name}: the tile of stops is errors of the deck and nodes on a segment`, Number(plain(seen.tiles["Solver stops"])), (said.counts.errors ?? 0) + (said.counts.solver_errors ?? 0));
  const crossed = said.counts.crossed_elements ?? 0;
  if (crossed > 0) {
    same(`${name}: crossed elements have a tile`, Number(plain(seen.tiles.Crossed)), crossed);
    check(`${name}: crossed elements are never green`, seen.level !== "good");
  }
  const words = await p.evaluate(() => document.body.innerText.replace(document.querySelector(".verdict-text").innerText, "").match(/\b(NaN|Infinity|-?inf|-?nan)\b|[\d.]+e\+?30\d/g) ?? []);
  same(`${name}: no figure that is none in what the page forms`, words, []);
}
/** The ten worst of all are printed whatever is chosen; a filter has its own list, by name. */
export async function paperSays(p) {
  const print = () =>
    p.evaluate(() => {
      window.dispatchEvent(new Event("beforeprint"));
      const paper = document.querySelector(".paper");
      return { heads: [...paper.querySelectorAll("h2")].map((e) => e.textContent), tables: [...paper.querySelectorAll("table")].map((t) => [...t.tBodies[0].rows].map((r) => r.innerText || r.textContent)), foot: paper.querySelector(".paper-foot").textContent };
    });
  const whole = await print(), screen = (await cells(p, ".list-table")).slice(0, 10).map((r) => r.action);
  same("paper: the actions of the ten worst are those of the screen", whole.tables[0].map((t, i) => t.endsWith(screen[i])), Array(10).fill(true));
  const chosen = await p.evaluate(() => {
    const { report } = window.deckReport;
    const deepest = report.meta.contacts[report.hits[0].contact].interface;
    const inter = report.meta.contacts[report.hits.find((x) => report.meta.contacts[x.contact].interface !== deepest).contact].interface;
    report.setFilter({ interface: inter });
    return report.interfaceName(inter);
  });
  const part = await print();
  same("paper: the first table is the same with a filter", part.tables[0], whole.tables[0]);
  check("paper: a filter has its own list, which names it", whole.heads.length + 1 === part.heads.length && part.heads[1].includes(chosen), part.heads.join(" | "));
  check("paper: and other rows", JSON.stringify(part.tables[1]) !== JSON.stringify(part.tables[0]));
  check("paper: version, date, command and size at its foot", /deck \d+\.\d+.* · \d{4}-\d\d-\d\d · deck gaps \S+.* · \d+ files?, [\d\u202f]+ bytes/.test(whole.foot), whole.foot);
  await p.evaluate(() => window.deckReport.report.setFilter({ interface: null }));
  await settled(p);
}
/** A saved picture has the colours of the legend below the view, and says by its name what it is of. */
export async function pictureSays(p, stem) {
  const [download] = await Promise.all([p.waitForEvent("download"), p.click('[aria-label="Save a PNG"]')]);
  check("the saved picture is named by deck, interface and colours", download.suggestedFilename() === `${stem}_all_depth.png`, download.suggestedFilename());
  const bytes = readFileSync(await download.path()).toString("base64");
  const seen = await p.evaluate(async (data) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: "image/png" }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const g = canvas.getContext("2d");
    g.drawImage(image, 0, 0);
    const bar = document.querySelector(".legend-bar").style.background.match(/rgb\([^)]+\)/g).map((c) => c.match(/\d+/g).map(Number));
    const foot = g.getImageData(0, Math.round(image.height * 0.85), image.width, Math.round(image.height * 0.15)).data;
    const has = ([r, gr, b]) => {
      for (let i = 0; i < foot.length; i += 4) if (Math.abs(foot[i] - r) < 5 && Math.abs(foot[i + 1] - gr) < 5 && Math.abs(foot[i + 2] - b) < 5) return true;
      return false;
    };
    return { missing: bar.filter((c) => !has(c)).length, all: bar.length };
  }, bytes);
  check("the saved picture has all colours of the legend", seen.all > 10 && seen.missing === 0, JSON.stringify(seen));
}
/** Nothing on a scale is longer than ten times the model. */
export async function scalesFit(p, name) {
  const seen = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const { low, high } = report.mesh;
    return { size: Math.hypot(...low.map((v, i) => high[i] - v)), top: viewport.contour?.top ?? 0, deepest: report.totals("now", null).max_depth, unbounded: report.unboundedRows,
      rows: report.hits.filter((x) => !(x.row.gap <= report.meta.largest_gap)).length };
  });
  check(`${name}: the legend ends below the model's size`, seen.top <= 10 * seen.size && seen.deepest <= 10 * seen.size, JSON.stringify(seen));
  const shown = await p.$$eval(".interfaces-table .vt-row", (rows) => rows.filter((r) => r.textContent.includes("unbounded")).length);
  same(`${name}: an interface with an unbounded gap says so, at the top`, shown > 0, seen.rows > 0);
  same(`${name}: unbounded gaps are counted`, seen.unbounded, seen.rows);
}
