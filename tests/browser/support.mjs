// What the browser checks share: counting, running `deck`, opening pages that may ask for nothing.
import { execFile, execFileSync, spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
export const { ROOT, WORK, DECK, DECK_CORPUS, DECK_ARTEFACTS, CHROMIUM } = process.env;
/** Every deck at every width, which takes minutes. */
export const ALL = process.env.ALL === "yes";
export const { chromium } = createRequire(join(WORK, "x.js"))("playwright-core");
/** Where pages and changed decks are written. */
export const scratch = join(WORK, "pages");
mkdirSync(scratch, { recursive: true });
mkdirSync(DECK_ARTEFACTS, { recursive: true });

let passed = Number(process.env.PASSED ?? 0);
let failed = Number(process.env.FAILED ?? 0);
let skipped = Number(process.env.SKIPPED ?? 0);
export function check(name, ok, why = "") {
  if (ok) passed++;
  else {
    failed++;
    console.log(`FAILED  ${name}${why ? `: ${why}` : ""}`);
  }
  return ok;
}
export function same(name, a, b) {
  return check(name, Object.is(a, b) || JSON.stringify(a) === JSON.stringify(b), `${JSON.stringify(a)?.slice(0, 300)} is not ${JSON.stringify(b)?.slice(0, 300)}`);
}
export function skip(what) {
  skipped++;
  console.log(`skipped  ${what}`);
}
export function finish() {
  console.log(`${passed} passed, ${failed} failed${skipped ? `, ${skipped} skipped` : ""}`);
  process.exit(failed ? 1 : 0);
}
/** Runs deck; exit code 1 (findings) is no failure. */
export function deck(...args) {
  try {
    return execFileSync(DECK, args, { encoding: "utf8", maxBuffer: 1 << 30, stdio: ["ignore", "pipe", "pipe"] });
  } catch (e) {
    if (e.status === 1) return e.stdout;
    throw new Error(`deck ${args.join(" ")}: exit code ${e.status}: ${e.stderr}`);
  }
}
/** The same, while the browser goes on. */
export const deckLater = (...args) =>
  new Promise((done, fail) =>
    execFile(DECK, args, { encoding: "utf8", maxBuffer: 1 << 30 }, (e, out, err) => (e && e.code !== 1 ? fail(new Error(`deck ${args.join(" ")}: exit code ${e.code}: ${err}`)) : done(out))));
/** Exit code and standard error of a run that may fail. */
export function run(...args) {
  const r = spawnSync(DECK, args, { encoding: "utf8", maxBuffer: 1 << 30 });
  return { code: r.status, err: r.stderr };
}
export const gaps = (path, ...args) => JSON.parse(deck("gaps", path, "--json", "-", "--quiet", ...args));
export const gapsLater = async (path, ...args) => JSON.parse(await deckLater("gaps", path, "--json", "-", "--quiet", ...args));
export const sample = (name) => join(ROOT, "samples", `${name}_0000.rad`);
export const corpus = (path) => { const full = join(DECK_CORPUS, "corpus", path); return existsSync(full) ? full : null; };

const flags = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader",
];
export const launch = (...more) => chromium.launch({ executablePath: CHROMIUM, args: [...flags, ...more] });
/** Writes the page of `deck gaps`, or of another verb. */
export function page(name, path, ...more) { return pageOf("gaps", name, path, ...more); }
export function pageOf(verb, name, ...args) {
  const file = join(scratch, `${name}.html`);
  deck(verb, ...args, "--quiet", "--html", file);
  return file;
}
/** Opens a page; `trouble` collects console errors, page errors and requests. `scripted`: it says when it is ready. */
export async function open(browser, file, options = {}, scripted = true) {
  const page = await browser.newPage({ viewport: { width: 1600, height: 1000 }, colorScheme: "light", ...options });
  page.trouble = [];
  page.on("console", (m) => m.type() === "error" && page.trouble.push(`console: ${m.text()}`));
  page.on("pageerror", (e) => page.trouble.push(`error: ${e.message}`));
  page.on("dialog", (d) => { page.trouble.push(`dialog: ${d.message()}`); void d.dismiss(); });
  page.on("request", (r) => { if (!/^(file|data|blob):/.test(r.url())) page.trouble.push(`request: ${r.url()}`); });
  await page.goto(`file://${file}`);
  if (!scripted) return page;
  try {
    await page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 30000 });
  } catch {
    page.trouble.push("the page was not ready in 30 s");
  }
  return page;
}
/** Closes a page, which must have had no trouble. */
export async function done(p, name) {
  check(`${name}: no console error and no request`, p.trouble.length === 0, p.trouble.join("; "));
  await p.close();
}
export const shot = (p, name) => p.screenshot({ path: join(DECK_ARTEFACTS, `${name}.png`) });
/** Rows of a table in sight: text of each column by the column's key. */
export const cells = (p, selector) =>
  p.$$eval(`${selector} .vt-row`, (rows) => rows.map((r) => Object.fromEntries([...r.children].map((c) => [c.dataset.key, c.textContent.replace(/\u202f/g, "")]))));
/** Gives the picture of a page what only measurements need. */
export const measuring = (p) => p.evaluate(() => {
  const { view } = window.deckReport.viewport;
  const { renderer, control } = view;
  view.picture = () => view.pictured(1, null, (canvas) => canvas.toDataURL("image/png"));
  // The picture at rest as it is drawn on a slow machine, but at once: what each slice took, and the picture.
  view.inSlices = () => {
    const times = [];
    view.setCoarse(false);
    control.update(performance.now());
    do {
      const start = performance.now();
      if (!view.slice()) view.render();
      times.push(performance.now() - start);
    } while (view.slices.drawing);
    return { times, url: view.canvas.toDataURL("image/png") };
  };
  // Mean time of a frame over a turn of the camera, waiting for the picture each time; `coarse`: as drawn while a slow machine moves.
  view.measure = (frames, coarse = false) => {
    view.setCoarse(coarse);
    const gl = renderer.getContext();
    const start = performance.now();
    for (let i = 0; i < frames; i++) {
      control.rotate(4, 0);
      control.update(performance.now());
      view.render();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
    const mean = (performance.now() - start) / frames;
    view.setCoarse(false);
    view.request();
    return mean;
  };
});
/** Waits until the picture is drawn and no flight goes on. */
export const settled = (p) => p.waitForFunction(() => window.deckReport.report.told && (window.deckReport.viewport.view?.resting ?? true));
/** Numbers without the state of the machine: same seed, same settings. */
export function random(seed) {
  let s = seed >>> 0;
  return () => { s = (Math.imul(s, 1664525) + 1013904223) >>> 0; return s / 4294967296; };
}
