// What a page does up to its first picture: in which order, what is compiled when, and the processor time, which says the same
// on a busy machine.
/** Processor time of all processes of the browser but its own, in ms. */
export async function spent(system) {
  const { processInfo } = await system.send("SystemInfo.getProcessInfo");
  return 1000 * processInfo.filter((p) => p.type !== "browser").reduce((n, p) => n + p.cpuTime, 0);
}
/** The same from now on, whatever processes come and go. */
async function meter(browser) {
  const system = await browser.newBrowserCDPSession();
  const list = async () => (await system.send("SystemInfo.getProcessInfo")).processInfo.filter((p) => p.type !== "browser");
  const before = new Map((await list()).map((p) => [p.id, p.cpuTime]));
  return async () => 1000 * (await list()).reduce((n, p) => n + p.cpuTime - (before.get(p.id) ?? 0), 0);
}
export const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
/** Up to the first picture, and then until the page is ready. */
export async function beforeThePicture(browser, file) {
  const context = await browser.newContext();
  await context.addInitScript(() => {
    // What waits for the next frame waits at the first picture until it is let go.
    const frame = window.requestAnimationFrame.bind(window);
    const held = [];
    const seen = () => window.deckReport?.times.picture !== undefined;
    let hold = true;
    window.requestAnimationFrame = (f) => frame((t) => (hold && seen() ? held.push(f) : f(t)));
    window.goOn = () => { hold = false; for (const f of held) frame(f); };
    // Programs that are linked once the model is there.
    window.late = { programs: 0 };
    const link = WebGL2RenderingContext.prototype.linkProgram;
    WebGL2RenderingContext.prototype.linkProgram = function (program) {
      if (!document.querySelector(".unpacking") && !seen()) window.late.programs++;
      return link.call(this, program);
    };
  });
  const since = await meter(browser);
  const p = await context.newPage();
  await p.setViewportSize({ width: 1440, height: 900 });
  await p.goto(`file://${file}`, { waitUntil: "commit" });
  await p.waitForFunction(() => window.deckReport?.times.picture !== undefined, null, { polling: 50 });
  const picture = await since();
  const there = await p.evaluate(() => ({ rows: document.querySelectorAll(".vt-row").length, ready: document.documentElement.dataset.ready ?? "no", triangles: window.deckReport.viewport.view.drawnTriangles, ...window.late }));
  await p.evaluate(() => window.goOn());
  await p.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { polling: 50 });
  const ready = await since();
  const rows = await p.evaluate(() => document.querySelectorAll(".vt-row").length);
  await context.close();
  return { picture, ready, there, rows };
}
/** Processor time to open the page without scripts. */
export async function withoutScripts(browser, file) {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const since = await meter(browser);
  const p = await context.newPage();
  await p.setViewportSize({ width: 1440, height: 900 });
  await p.goto(`file://${file}`);
  const all = await since();
  await context.close();
  return all;
}
