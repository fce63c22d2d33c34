// What the page of the inflated dummy may cost: bytes, and script beside the time to unpack its own data. Time in the picture is not counted:
// it is that of the machine's graphics.
import { execFileSync } from "node:child_process";
import { statSync } from "node:fs";
import { join } from "node:path";
import { check, corpus, DECK_CORPUS, open, page, scratch, settled, skip } from "./support.mjs";
export async function budget(browser, timings) {
  const deck = corpus("EuroSID_II/EuroSID_II_0000.rad");
  if (!deck) return skip("the dummy is not in the corpus");
  const path = join(scratch, "EuroSID_II_inflated_0000.rad");
  execFileSync("python3", [join(DECK_CORPUS, "check", "inflate_gaps.py"), deck, path, "2.5", "zero"]);
  const file = page("dummy", path), size = statSync(file).size;
  const p = await open(browser, file), client = await p.context().newCDPSession(p);
  await client.send("Performance.enable");
  await p.evaluate(() => {
    const { view } = window.deckReport.viewport, draw = view.draw.bind(view);
    window.drawn = 0;
    view.draw = (now) => { const start = performance.now(); draw(now); window.drawn += performance.now() - start; };
  });
  const spent = async () => 1000 * (await client.send("Performance.getMetrics")).metrics.find((m) => m.name === "ScriptDuration").value - (await p.evaluate(() => window.drawn));
  /** The least of several: other work of the machine only adds. */
  const least = async (times, act) => {
    const all = [];
    for (let i = 0; i < times; i++) { await settled(p); const before = await spent(); await act(i); await settled(p); all.push((await spent()) - before); }
    return Math.min(...all);
  };
  const { decoded, picture } = await p.evaluate(() => window.deckReport.times);
  await p.click(".interfaces-table .vt-row:has-text('15000031')");
  const row = await least(6, () => p.keyboard.press("j"));
  const step = await least(5, (i) => p.evaluate((v) => window.deckReport.report.setOverride(window.deckReport.report.filter.interface, "Gapmin", v), 2.4 - 0.1 * i));
  check("the page of the dummy has at most 3.5 MB", size <= 3.5e6, `${size}`);
  timings.dummy = { megabytes: +(size / 1e6).toFixed(2), unpacked_ms: Math.round(decoded), first_view_ms: Math.round(picture), row_ms: Math.round(row), what_if_ms: Math.round(step) };
  check("dummy: the first view takes at most three times as long as unpacking", picture <= 3 * decoded, JSON.stringify(timings.dummy));
  check("dummy: a row and a step of a setting are quick", row <= 120 && step <= Math.max(100, decoded / 4), JSON.stringify(timings.dummy));
  await p.close();
}
