// Settings under test: what the page computes is, to the last bit, what `deck gaps --what-if` prints.
import { difference } from "./difference.mjs";
import { median } from "./first_picture.mjs";
import { check, gapsLater, open, random } from "./support.mjs";

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

export function compare(document, page) {
  for (const inter of document.interfaces)
    for (const contact of inter.contacts) {
      const mine = page.find((c) => c.interface === inter.id && c.role === contact.role);
      const name = `interface ${inter.id} ${contact.role}`;
      if (!mine) return `${name} is not in the page`;
      if (!mine.complete) return "incomplete";
      const d =
        difference(mine.gapmin, contact.gapmin, `${name} gapmin`) ??
        difference(mine.max_gap, contact.max_gap, `${name} max_gap`) ??
        difference(mine.penetrations, rowsOf(contact), name);
      if (d) return d;
    }
  return null;
}

/** A setting that makes sense for the type, often extreme. */
function setting(next, inter) {
  const pick = (list) => list[Math.floor(next() * list.length)];
  const base = Math.max(...inter.contacts.map((c) => Math.max(c.max_gap, c.gapmin)), 1e-3);
  const fields = {};
  const maybe = (name, share, value) => {
    if (next() < share) fields[name] = value();
  };
  maybe("Gapmin", 0.6, () => (next() < 0.15 ? 0 : base * (0.2 + 2.3 * next())));
  if (inter.type !== 10) {
    maybe("Igap", 0.5, () => pick(inter.type === 11 ? [0, 1, 3, 1000] : [0, 1, 2, 3, 1000]));
    maybe("Inacti", 0.6, () => pick([0, 1, 2, 3, 5, 6, 1000]));
  }
  if (inter.type === 7 || inter.type === 19) {
    maybe("Fscalegap", 0.4, () => 0.3 + 1.3 * next());
    maybe("Gapmax", 0.3, () => base * (0.2 + 1.5 * next()));
  }
  if (inter.type === 7) maybe("Fpenmax", 0.25, () => next());
  return fields;
}

/** Tries `count` settings on one deck; returns how many were compared. */
export async function tryDeck(browser, path, html, count, seed) {
  const [page, document] = await Promise.all([open(browser, html), gapsLater(path)]);
  const next = random(seed);
  const inters = document.interfaces.filter((i) => i.contacts.length > 0);
  let compared = 0;
  let beyond = 0;
  let unlike = "";
  let d = compare(document, await page.evaluate(() => window.deckReport.whatIf(-1, {})));
  check(`page of ${path} repeats the deck's own settings`, d === null, d ?? "");
  for (let i = 0; i < count && inters.length > 0 && !unlike; i++) {
    const inter = inters[Math.floor(next() * inters.length)];
    const fields = setting(next, inter);
    const text = Object.entries(fields).map(([k, v]) => `${k}=${v}`).join(",");
    if (!text) {
      i--;
      continue;
    }
    const [mine, theirs] = await Promise.all([
      page.evaluate(([id, f]) => window.deckReport.whatIf(id, f), [inter.id, fields]), gapsLater(path, "--what-if", `${inter.id}:${text}`),
    ]);
    d = compare(theirs, mine);
    if (d === "incomplete") beyond++;
    else if (d) unlike = `--what-if ${inter.id}:${text}: ${d}`;
    else compared++;
  }
  check(`what-if settings of ${path} are those of the program`, unlike === "", unlike);
  check(`nothing went wrong in the page of ${path}`, page.trouble.length === 0, page.trouble.join("; "));
  await page.close();
  return { compared, beyond };
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
    const most = report.meta.interfaces.map((_, i) => i).filter((i) => report.contactsOf(i).length > 0 && !report.meta.contacts[report.contactsOf(i)[0]].given).sort((a, b) => pairs(b) - pairs(a)).slice(0, 3);
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
  await page.evaluate(() => {
    window.deckReport.report.clearOverrides(null);
    window.deckReport.report.setFilter({ interface: null });
  });
  return step;
}
