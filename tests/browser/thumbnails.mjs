// The small pictures of samples/README.md, held against those of the repository (samples/pictures); and the picture of README.md.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { check, DECK_ARTEFACTS, done, open, page, ROOT, sample, settled } from "./support.mjs";
const names = ["clean_plates", "inacti_variants", "crossing_edges", "welds", "airbag_fold", "coated_block", "solid_and_skin", "crash_box"];
const most = 30000; // bytes
const folder = join(ROOT, "samples/pictures");

/** Of the page in samples/: the chosen row, its side view, the whole crash box. Copied to tools/viewer/screenshot.png when it looks different. */
async function readmePicture(browser) {
  const p = await open(browser, join(ROOT, "samples/crash_box.html"), { viewport: { width: 1120, height: 1400 } });
  await p.evaluate(({ report } = window.deckReport) => (report.setFilter({ interface: 0 }), report.select(report.filtered[0])));
  await settled(p);
  await p.addStyleTag({ content: ".toolbar, .legend, .axes, .leaders, .label { visibility: hidden } .side-row { padding: 12px 0 0 16px }" });
  const url = async (selector) => `data:image/png;base64,${(await p.locator(selector).screenshot()).toString("base64")}`;
  const left = `<img src="${await url(".interfaces-table")}"><img src="${await url(".side-row")}">`;
  await p.setViewportSize({ width: 1120, height: 860 });
  await p.evaluate(({ viewport } = window.deckReport) => (viewport.showAll(), viewport.fit()));
  await settled(p);
  const q = await browser.newPage({ viewport: { width: 900, height: 600 } });
  await q.setContent(`<body style="margin:0"><div style="display:flex;background:url(${await url("#view")}) calc(100% + 80px) 50%"><div style="background:white;width:546px">${left}</div></div>`);
  await q.locator("div").first().screenshot({ path: join(DECK_ARTEFACTS, "readme.png") });
  await q.close();
  await done(p, "the page of samples/");
}
export async function thumbnails(browser) {
  await readmePicture(browser);
  const made = join(DECK_ARTEFACTS, "thumbnails"); // copied to samples/pictures when one looks different
  mkdirSync(made, { recursive: true });
  const readme = readFileSync(join(ROOT, "samples/README.md"), "utf8");
  for (const name of names) {
    const p = await open(browser, page(`thumbnail_${name}`, sample(name)), { viewport: { width: 1600, height: 880 }, colorScheme: "light" });
    await p.evaluate(() => {
      const { report, viewport } = window.deckReport;
      document.querySelector(".split").style.setProperty("--left", "25%"); // the picture has the shape of a thumbnail
      if (report.hits.length === 0 || report.welds.length > 0) viewport.showAll();
    });
    await p.waitForFunction(() => window.deckReport.viewport.view.canvas.clientWidth > 1100);
    await settled(p); // the new width is drawn
    await p.evaluate(() => window.deckReport.viewport.fit()); await settled(p);
    const [bytes, different] = await p.evaluate(async (old) => {
      const small = (image, w, h) => {
        const c = document.createElement("canvas");
        [c.width, c.height] = [240, 150];
        const scale = Math.min(240 / w, 150 / h);
        c.getContext("2d").fillStyle = "#ffffff";
        c.getContext("2d").fillRect(0, 0, 240, 150);
        c.getContext("2d").drawImage(image, (240 - scale * w) / 2, (150 - scale * h) / 2, scale * w, scale * h);
        return c;
      };
      const { view } = window.deckReport.viewport;
      const now = view.pictured(1, "#ffffff", (canvas) => small(canvas, canvas.width, canvas.height));
      const pixels = (c) => c.getContext("2d").getImageData(0, 0, 240, 150).data;
      let share = 1;
      if (old) {
        const image = new Image();
        image.src = `data:image/png;base64,${old}`;
        await image.decode();
        const [a, b] = [pixels(now), pixels(small(image, image.width, image.height))];
        let n = 0;
        for (let i = 0; i < a.length; i += 4) n += Number(Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 60);
        share = n / (240 * 150);
      }
      return [now.toDataURL("image/png").split(",")[1], share];
    }, existsSync(join(folder, `${name}.png`)) ? readFileSync(join(folder, `${name}.png`)).toString("base64") : null);
    const png = Buffer.from(bytes, "base64");
    writeFileSync(join(made, `${name}.png`), png);
    check(`${name}: its picture has 30 KB at most`, png.length <= most, `${png.length}`);
    check(`${name}: the picture of samples/pictures looks like the page (else copy ${made}/${name}.png)`, different <= 0.02, `${(100 * different).toFixed(1)} % of the pixels`);
    check(`${name}: samples/README.md shows it`, readme.includes(`pictures/${name}.png`));
    await done(p, `${name}`);
  }
}
