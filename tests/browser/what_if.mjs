// Settings under test: what the page computes is, to the last bit, what `deck gaps --what-if` prints.
import { median } from "./first_picture.mjs";
import { join } from "node:path";
import { check, done, gaps, gapsLater, open, page, random, run, same, sample, WORK } from "./support.mjs";
/** First difference of two values compared bit for bit (0 and -0 print alike in JSON: as numbers). */
function difference(a, b, path) {
  if (typeof a === "number" && typeof b === "number") return a === b ? null : `${path}: ${a} is not ${b}`;
  if (a === null || b === null || typeof a !== "object" || typeof b !== "object")
    return a === b ? null : `${path}: ${JSON.stringify(a)} is not ${JSON.stringify(b)}`;
  const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
  for (const k of keys) { const d = difference(a[k], b[k], `${path}.${k}`); if (d) return d; }
  return null;
}
/** Rows of a contact in the JSON, as the page names them. */
function rowsOf(contact) {
  return [...contact.penetrations, ...(contact.tied_pairs ?? [])].map((p) => ({
    secondary: p.edge ?? [p.node],
    main: p.main_edge ?? (p.segment[2] === p.segment[3] ? p.segment.slice(0, 3) : p.segment),
    depth: p.penetration,
    gap: p.gap,
    distance: p.distance,
    normal: p.normal,
    on_surface: p.on_surface,
    action: p.action,
    gap0: p.gap0,
    p0: p.p0,
    moved_by: p.moved_by,
  }));
}
/** First difference of a page and a JSON; "beyond": the page carries too few pairs. Of pairs that penetrate with other settings
 * alone the page has no normal. */
function compare(document, page) {
  const left = [...page]; // ids can occur twice
  for (const inter of document.interfaces)
    for (const contact of inter.contacts) {
      const [mine] = left.splice(left.findIndex((c) => c.interface === inter.id && c.role === contact.role), 1);
      const name = `interface ${inter.id} ${contact.role}`;
      if (!mine.complete) return "beyond";
      if (inter.type === 24 || inter.type === 25) continue; // ties.mjs
      const theirs = rowsOf(contact);
      mine.penetrations.forEach((row, i) => row.normal === null && theirs[i] && (theirs[i].normal = null));
      const d =
        ["gapmin", "gapmin_from", "max_gap"].reduce((found, k) => found ?? difference(Number.isNaN(mine[k]) ? null : mine[k], contact[k], `${name} ${k}`), null) ??
        difference(mine.penetrations, theirs, name) ?? difference(mine.totals, Object.fromEntries(Object.keys(mine.totals).map((k) => [k, contact.totals[k]])), `${name} totals`);
      if (d) return d;
    }
  return null;
}
/** A setting of the fields that the page tries, often extreme. */
function setting(next, inter) {
  const pick = (list) => list[Math.floor(next() * list.length)];
  const base = Math.max(...inter.contacts.map((c) => Math.max(c.max_gap, c.gapmin)), 1e-3);
  const fields = {};
  const maybe = (name, share, value) => { if (next() < share) fields[name] = value(); };
  maybe("Gapmin", 0.6, () => (next() < 0.15 ? 0 : base * (0.2 + 1.7 * next())));
  if (inter.type !== 10) maybe("Igap", 0.5, () => pick(inter.type === 11 ? [0, 1, 3, 1000] : [0, 1, 2, 3, 1000]));
  if (inter.type === 7 || inter.type === 19) { maybe("Fscalegap", 0.4, () => 0.3 + 1.3 * next()); maybe("Gapmax", 0.3, () => base * (0.2 + 1.5 * next())); }
  return fields;
}
/** Tries `count` settings on one deck; returns how many were compared. */
export async function tryDeck(browser, path, html, count, seed) {
  const [p, document] = await Promise.all([open(browser, html), gapsLater(path)]);
  const next = random(seed);
  const tried = await p.evaluate(() => window.deckReport.report.meta.interfaces.filter((_, i) => window.deckReport.report.evaluator.fixed(i) === "").map((i) => i.id));
  const inters = document.interfaces.filter((i) => i.contacts.length > 0 && tried.includes(i.id));
  let compared = 0;
  let beyond = 0;
  let unlike = "";
  let d = compare(document, await p.evaluate(() => window.deckReport.whatIf(-1, {})));
  check(`the rows of the page of ${path} are those of the JSON`, d === null, d ?? "");
  for (let i = 0; i < count && inters.length > 0 && !unlike; i++) {
    const inter = inters[Math.floor(next() * inters.length)];
    const fields = setting(next, inter);
    const text = Object.entries(fields).map(([k, v]) => `${k}=${v}`).join(",");
    if (!text) { i--; continue; }
    const [mine, theirs] = await Promise.all([
      p.evaluate(([id, f]) => window.deckReport.whatIf(id, f), [inter.id, fields]), gapsLater(path, "--what-if", `${inter.id}:${text}`),
    ]);
    d = compare(theirs, mine);
    if (d === "beyond") beyond++;
    else if (d) unlike = `--what-if ${inter.id}:${text}: ${d}`;
    else compared++;
  }
  check(`what-if settings of ${path} are those of the program`, unlike === "", unlike);
  await done(p, `page of ${path}`);
  return { compared, beyond };
}
/** A page that was written with other settings has their rows, and without them those of the deck. */
export async function startedWith(browser) {
  const path = sample("crash_box");
  const started = ["--what-if", "1:Gapmin=2,Igap=0"];
  const p = await open(browser, page("started", path, ...started));
  const rows = () => p.evaluate(() => window.deckReport.whatIf(-1, {}));
  same("written with --what-if the page has the rows of that", compare(gaps(path, ...started), await rows()), null);
  await p.evaluate(() => window.deckReport.report.clearOverrides(null));
  same("and reset those of the deck", compare(gaps(path), await rows()), null);
  await done(p, "written with --what-if");
}
/** Where the page tries nothing the panel writes the command, and the command is one that deck knows. */
export async function panelsWrite(browser) {
  let p = await open(browser, page("panel", sample("crash_box")));
  const at = await p.evaluate(() => {
    const { report } = window.deckReport;
    const inter = report.meta.interfaces.findIndex((_, i) => report.evaluator.fixed(i) === "");
    report.setFilter({ interface: inter });
    return { inter, contact: report.contactsOf(inter)[0] };
  });
  const panel = () => p.$eval("#whatif", (e) => ({ text: e.innerText, commands: [...e.querySelectorAll("code")].map((c) => c.textContent), numbers: e.querySelector(".outcome")?.hidden === false }));
  const within = await panel();
  check("within its reach the panel has numbers, and the command for other fields", within.numbers && within.commands.some((c) => /--what-if \d+:Inacti=5/.test(c)), within.text);
  const wide = await p.evaluate(({ inter, contact }) => {
    const { report } = window.deckReport;
    report.setOverride(inter, "Gapmin", 1.5 * report.meta.contacts[contact].reach);
    return { rows: report.results[contact].rows === report.evaluator.written[contact].rows, beyond: report.results[contact].beyond };
  }, at);
  const beyond = await panel();
  check("beyond it the command stands in their place, and the lists stay", wide.rows && wide.beyond > 0 && !beyond.numbers && beyond.commands.some((c) => /--what-if \d+:Gapmin=/.test(c)), beyond.text);
  for (const c of [...within.commands, ...beyond.commands]) {
    const [, ...words] = c.split(" ");
    words[words.length - 1] = join(WORK, "pages", "tried.html");
    same(`${c} runs`, run(...words, "--quiet").code <= 1, true);
  }
  await p.close();
  p = await open(browser, page("moving", sample("inacti_variants")));
  const fixed = await p.evaluate(() => {
    const { report } = window.deckReport;
    return report.meta.interfaces.map((_, i) => {
      report.setFilter({ interface: i });
      report.setOverride(i, "Gapmin", 0.1);
      return { why: report.evaluator.fixed(i), text: document.getElementById("whatif").innerText, changed: report.anyChanged, controls: document.querySelectorAll("#whatif input, #whatif select").length };
    }).filter((x) => x.why !== "");
  });
  check("behind an Inacti 3 nothing is tried, and the panel says why", fixed.length > 0 && fixed.every((x) => x.controls === 0 && x.text.includes("Inacti 3 moves nodes") && x.text.includes("--what-if")), JSON.stringify(fixed));
  await p.close();
}
/** Milliseconds from a movement of a slider to the picture of the browser that has its numbers, the median over the three
 * interfaces with the most pairs; and those that the page's thread worked for each, as the machine may be busy. */
export async function stepTime(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable", { timeDomain: "threadTicks" });
  const worked = async () => (await client.send("Performance.getMetrics")).metrics.find((m) => m.name === "TaskDuration").value * 1000;
  const before = await worked();
  const times = await page.evaluate(async () => {
    const { report } = window.deckReport;
    const pairs = (i) => report.contactsOf(i).reduce((n, c) => n + report.data.contacts[c].pairMain.length, 0);
    const most = report.meta.interfaces.map((_, i) => i).filter((i) => report.contactsOf(i).length > 0 && report.evaluator.fixed(i) === "").sort((a, b) => pairs(b) - pairs(a)).slice(0, 3);
    const out = [];
    for (const i of most) {
      report.setFilter({ interface: i });
      const slider = document.getElementById("f-Gapmin");
      const gapmin = report.results[report.contactsOf(i)[0]].setting.gapmin;
      for (let k = 0; k < 12; k++) {
        const start = performance.now();
        slider.value = String(gapmin * (0.8 + 0.04 * k));
        slider.dispatchEvent(new Event("input"));
        await new Promise((shown) => requestAnimationFrame(() => setTimeout(shown)));
        out.push(performance.now() - start);
      }
    }
    return out;
  });
  const step = { shown_ms: Math.round(median(times)), worked_ms: Math.round(((await worked()) - before) / times.length) };
  await page.evaluate(() => { window.deckReport.report.clearOverrides(null); window.deckReport.report.setFilter({ interface: null }); });
  return step;
}
