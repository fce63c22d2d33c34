// A model with many elements on a machine without a graphics processor: decoded beside the page, drawn coarsely at first
// and while it moves, in full at rest.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { beforeThePicture, median, spent } from "./first_picture.mjs";
import { check, measuring, open, page, ROOT, same, scratch, settled } from "./support.mjs";
export async function largeModel(browser, timings) {
  const path = join(scratch, "sheets_0000.rad");
  execFileSync("python3", [join(ROOT, "tools/bench/sheets"), "300", path], { stdio: "ignore" });
  const file = page("sheets", path);

  const context = await browser.newContext();
  // What the page says while it decodes, and what its first picture is made of.
  await context.addInitScript(() => {
    window.said = [];
    new MutationObserver(() => {
      const wait = document.querySelector(".unpacking");
      const now = wait && `${wait.querySelector("progress").value} ${wait.textContent}`;
      if (now && window.said.at(-1) !== now) window.said.push(now);
      const report = window.deckReport;
      if (document.documentElement.dataset.ready && window.first === undefined) window.first = report.viewport.view.drawnTriangles;
    }).observe(document, { subtree: true, childList: true, attributes: true, characterData: true });
  });
  const p = await open(context, file, { viewport: { width: 1440, height: 900 } });
  check("the model is decoded beside the page", await p.evaluate(() => window.deckReport.beside));
  check("what the page counts is what the program counts", await p.evaluate(() => window.deckReport.report.verified));
  const said = await p.evaluate(() => window.said);
  const shares = said.map((s) => parseFloat(s));
  check("the page says how far it is, and never less than before", said.some((s) => s.includes("Reading the contacts")) && shares.every((v, i) => i === 0 || v >= shares[i - 1]), said.join(" | "));
  await settled(p);
  await measuring(p);
  const drawn = await p.evaluate(() => {
    const { view } = window.deckReport.viewport;
    const all = view.parts.parts.reduce((n, x) => n + x.triangleElement.length, 0);
    const out = { all, first: window.first, rest: view.drawnTriangles };
    view.measure(1, true);
    out.moving = view.drawnTriangles;
    out.hot = view.parts.parts.filter((x) => x.coarser[0]?.group.children[1]?.visible).length;
    view.measure(1, false);
    out.near = view.drawnTriangles;
    return out;
  });
  // At rest it is drawn in slices that hold nothing up, and nothing of them is seen in the picture.
  const sliced = await p.evaluate(() => {
    const { view } = window.deckReport.viewport;
    const { times, url } = view.inSlices();
    const triangles = view.drawnTriangles;
    const whole = view.picture();
    return { same: url === whole, bytes: url.length, times, triangles, whole: view.drawnTriangles };
  });
  check("the picture at rest comes in several slices", sliced.times.length > 3 && sliced.triangles === sliced.whole, JSON.stringify(sliced));
  check("and is the picture that is drawn at once, pixel by pixel", sliced.same && sliced.bytes > 20000, JSON.stringify(sliced));
  // While it comes, the one before stays; a movement meanwhile is drawn at once.
  const between = await p.evaluate(async () => {
    const { view } = window.deckReport.viewport;
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    while (!view.resting) await frame();
    view.request();
    await frame();
    await frame();
    const out = { resting: view.resting, frames: view.frames };
    view.control.rotate(30, 0);
    for (let i = 0; i < 4; i++) await frame();
    out.moved = view.frames - out.frames;
    while (!view.resting) await frame();
    out.triangles = view.drawnTriangles;
    return out;
  });
  check("a picture in slices gives way to a movement and comes afterwards", !between.resting && between.moved > 0 && between.triangles > 4 * drawn.moving, JSON.stringify(between));
  timings.slices = { median_ms: Math.round(median(sliced.times)), longest_ms: Math.round(Math.max(...sliced.times)), count: sliced.times.length };
  const hits = await p.evaluate(() => window.deckReport.report.hits.length);
  check("the first picture has a tenth of the triangles at most", drawn.first > 1000 && drawn.first < drawn.all / 10, JSON.stringify(drawn));
  check("and so have the pictures of a movement", drawn.moving > 1000 && drawn.moving < drawn.all / 10, JSON.stringify(drawn));
  check("at rest there are more", drawn.rest > 4 * drawn.moving, JSON.stringify(drawn));
  check("what penetrates is told apart while the view moves", hits > 4000 && drawn.hot > 0, `${hits} ${JSON.stringify(drawn)}`);

  // Whoever comes near sees every element, and of a large part only what is in sight is drawn.
  const near = await p.evaluate(async () => {
    const { report, viewport } = window.deckReport;
    viewport.showAll();
    report.select(report.filtered[report.filtered.length >> 1]);
    await new Promise((done) => { const wait = () => (viewport.view.resting ? done() : setTimeout(wait, 50)); setTimeout(wait, 700); });
    const { parts } = viewport.view.parts;
    return { ranges: parts.filter((x) => x.faces?.visible).map((x) => x.faces.geometry.drawRange.count / 3), whole: parts.map((x) => x.triangleElement.length) };
  });
  check("near by the elements themselves are drawn, and not those out of sight", near.ranges.length > 0 && near.ranges.every((n) => n > 0) && near.ranges.some((n, i) => n < 0.9 * near.whole[i]), JSON.stringify(near));
  await p.keyboard.press("Escape"); await p.keyboard.press("f");
  await settled(p);

  // Processor time, as the machine may be busy with other work.
  const system = await browser.newBrowserCDPSession();
  const cost = async (coarse) => {
    const list = [];
    for (let i = 0; i < 3; i++) {
      const before = await spent(system);
      await p.evaluate((c) => window.deckReport.viewport.view.measure(2, c), coarse);
      list.push(((await spent(system)) - before) / 2);
    }
    return Math.round(median(list));
  };
  timings.large = { moving_ms: await cost(true), still_ms: await cost(false) };
  check("a picture of a movement costs half of one at rest at most", timings.large.moving_ms < timings.large.still_ms / 2, JSON.stringify(timings.large));
  same("no console error and no request", p.trouble, []);
  await context.close();

  const runs = [];
  for (let i = 0; i < 3; i++) runs.push(await beforeThePicture(browser, file));
  const { there, rows } = runs[0];
  check("the first picture is there before a row of a table is", there.triangles > 1000 && there.rows === 0 && there.ready === "no" && rows > 10, JSON.stringify(runs[0]));
  same("its programs were compiled while the model was decoded", there.programs, 0);
  timings.large.picture_ms = median(runs.map((r) => Math.round(r.picture)));
  timings.large.ready_ms = median(runs.map((r) => Math.round(r.ready)));
  const share = median(runs.map((r) => r.picture / r.ready));
  check("what is done after the first picture is no small part of the work", share < 0.93, `${share.toFixed(3)} of the processor time`);
}
