// The report in the browser: tables against the JSON, rows and picture linked both ways, settings
// under test, comparison, exports, hostile text, no WebGL, print; and how long it takes.
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { ALL, cells, check, corpus, deck, DECK_ARTEFACTS, DECK_CORPUS, deckLater, done, finish, gaps, gapsLater, launch, measuring, open, page, ROOT, run, same, sample, scratch, settled, shot, skip } from "./support.mjs";
import { answers } from "./answers.mjs";
import { accuracyPage } from "./accuracy.mjs";
import { accessible, reachable } from "./axe.mjs";
import { effectsPage } from "./effects.mjs";
import { find } from "./find.mjs";
import { beforeThePicture, withoutScripts } from "./first_picture.mjs";
import { budget } from "./budget.mjs";
import { choosing } from "./choosing.mjs";
import { chosenAlone, column } from "./column.mjs";
import { repairPages } from "./moved.mjs";
import { partsPage } from "./parts.mjs";
import { picture, section } from "./picture.mjs";
import { largeModel } from "./large.mjs";
import { tablesBehave, tablesFit, widths } from "./tables.mjs";
import { banner, paperSays, pictureSays, scalesFit } from "./verdict.mjs";
import { tiesAndModern } from "./ties.mjs";
import { nearest, viewTools } from "./view.mjs";
import { thumbnails } from "./thumbnails.mjs";
import { panelsWrite, startedWith, stepTime, tryDeck } from "./what_if.mjs";
const timings = {};
const pagesOf = (name) => readFileSync(join(DECK_ARTEFACTS, name), "latin1").match(/\/Type \/Page\b/g).length;

const browser = await launch();
async function crashBox() {
  const path = sample("crash_box");
  const json = gaps(path);
  const p = await open(browser, page("crash_box", path), { acceptDownloads: true });
  await shot(p, "crash_box");
  // Tables.
  const tiles = await p.$$eval(".tile-value", (t) => t.map((e) => e.textContent));
  same("verdict counts the penetrations of the JSON", tiles[0], String(json.summary.pairs));
  same("verdict counts the nodes and edges of the JSON", tiles.slice(1, 3), [String(json.summary.nodes), String(json.summary.edges)]);
  await banner(p, "crash box");
  await scalesFit(p, "crash box");
  // One row per interface; a TYPE19 unfolds into its contacts, which stay below it.
  same("one row per interface", (await cells(p, ".interfaces-table")).length, json.interfaces.length);
  for (const b of await p.$$(".fold-parts")) await b.click();
  const rows = await cells(p, ".interfaces-table");
  const inParts = json.interfaces.filter((i) => i.contacts.length > 1);
  same("and one per contact of an interface with several", rows.length, json.interfaces.length + inParts.reduce((n, i) => n + i.contacts.length, 0));
  let last = "";
  for (const r of rows) r.id = last = r.id || last;
  const key = (id, pairs, nodes, edges) => `${id} ${pairs} ${nodes} ${edges}`;
  const whole = (i) => i.totals ?? i.contacts[0].totals;
  same("interface table agrees with the JSON", rows.filter((r) => !inParts.some((i) => String(i.id) === r.id)).map((r) => key(r.id, r.pairs, r.nodes, r.edges)).sort(),
    json.interfaces.filter((i) => !inParts.includes(i)).map((i) => key(i.id, whole(i).pairs, whole(i).nodes, whole(i).edges)).sort());
  for (const i of inParts) {
    const own = rows.filter((r) => r.id === String(i.id));
    const at = rows.indexOf(own[0]);
    same(`interface ${i.id}: its contacts stand below it and agree with the JSON`, [own.map((r) => rows.indexOf(r) - at), own.slice(1).map((r) => key(r.title, r.pairs, r.nodes, r.edges))],
      [own.map((_, k) => k), i.contacts.map((c) => key(c.role, c.totals.pairs, c.totals.nodes, c.totals.edges))]);
    same(`interface ${i.id}: pairs of its contacts add up`, Number(own[0].pairs), i.contacts.reduce((n, c) => n + c.totals.pairs, 0));
  }
  for (const b of await p.$$(".fold-parts")) await b.click();
  same("folded again", (await cells(p, ".interfaces-table")).length, json.interfaces.length);
  const pairs = await cells(p, "#pairs");
  same("part-pair table agrees with the JSON", pairs.map((r) => `${parseInt(r.s)} ${parseInt(r.m)} ${r.pairs} ${r.nodes} ${r.edges}`).sort(),
    json.part_pairs.map((x) => `${x.secondary} ${x.main} ${x.pairs} ${x.nodes} ${x.edges}`).sort());
  await p.$eval("#touches", (e) => e.scrollIntoView()); // made when it comes into sight
  await p.waitForSelector("#touches svg.tw");
  const touching = await p.$eval("#touches svg.tw", (s) => {
    const frame = s.getBoundingClientRect();
    const cut = [...s.querySelectorAll("text")].map((t) => t.getBoundingClientRect()).filter((r) => r.left < frame.left - 0.5 || r.top < frame.top - 0.5).length;
    return { red: s.querySelectorAll(".deep").length, said: [...s.querySelectorAll(".touch:has(.deep) title")].map((e) => Number(/; (\d+) penetration/.exec(e.textContent)[1])).sort(), cut };
  });
  same("who touches whom: the red cells are the part pairs of the JSON, no name is cut", touching, { red: json.part_pairs.length, said: json.part_pairs.map((x) => x.pairs).sort(), cut: 0 });
  await p.click("#touches .touch:has(.deep)");
  // The drawing of the command line has the same cells, in the same order.
  const drawn = join(scratch, "touches.svg");
  deck("gaps", path, "--quiet", "--svg", drawn);
  const read = (root) => ({
    cells: [...root.querySelectorAll(":scope > rect, :scope > g.touch")].map((e) => (e.tagName === "rect" ? "." : `${e.querySelector("rect").getAttribute("class")} ${e.querySelector("text").textContent}`)),
    names: [...root.querySelectorAll(":scope > text")].map((e) => parseInt(e.querySelector("title").textContent)),
    said: [...root.querySelectorAll("g.touch title")].map((e) => e.textContent),
  });
  const q = await browser.newPage();
  await q.setContent(readFileSync(drawn, "utf8"));
  same("deck gaps --svg draws what the page draws", await q.$eval("svg.tw", read), await p.$eval("#touches svg.tw", read));
  await q.close();
  check("a cell of it chooses its part pair", await p.evaluate(() => window.deckReport.report.filter.pairs !== null));
  await p.keyboard.press("Escape");
  const followed = await p.evaluate(() => {
    const { report } = window.deckReport;
    const red = () => [...document.querySelectorAll("#touches .touch:has(.deep)")].map((e) => `${e.dataset.s} ${e.dataset.m}${/; \d+ penetration/.test(e.textContent)}`).sort();
    const wanted = () => [...new Set(report.hits.map((x) => `${x.secondaryPart} ${x.mainPart}true`))].sort();
    report.setOverrides(report.meta.interfaces.map((_, i) => ({ Gapmin: 1e-9, Igap: 0 })));
    const out = { red: red(), wanted: wanted(), plain: document.querySelectorAll("#touches .near").length, pairs: report.hits.length };
    report.clearOverrides(null);
    return { ...out, again: report.hits.length };
  });
  same("for other settings it marks the cells that penetrate then", followed.red, followed.wanted);
  check("and fewer pairs penetrate than before", followed.pairs < followed.again && followed.plain > 0, JSON.stringify(followed));
  const deepest = await p.evaluate(() => window.deckReport.report.hits[0].depth);
  same("the deepest row is that of the JSON", deepest, json.summary.max_depth);
  check("the page counts what the program counts", await p.evaluate(() => window.deckReport.report.verified));
  // Row to picture.
  await p.click(".list-table .vt-row:nth-child(4)"); await settled(p);
  const chosen = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    const at = viewport.view.screen(report.selected);
    const r = viewport.view.canvas.getBoundingClientRect();
    return { text: report.secondaryText(report.selected.row), dx: at.x - r.x - r.width / 2, dy: at.y - r.y - r.height / 2, label: document.querySelector(".label").textContent };
  });
  const listed = (await cells(p, ".list-table"))[3].node;
  same("the row clicked is the one selected", chosen.text, listed);
  check("the picture flies to the node", Math.hypot(chosen.dx, chosen.dy) < 6, `${chosen.dx}, ${chosen.dy}`);
  check("the picture names the node and its distance", chosen.label.includes(listed) && chosen.label.includes("distance"), chosen.label);
  check("the other parts are not drawn", await p.evaluate(() => window.deckReport.viewport.view.parts.parts.some((x) => x.look === "hidden")));
  await shot(p, "crash_box_selected");
  // Picture to row: a dot that is not the selected one, on the barrier.
  await p.keyboard.press("Escape"); await p.click("#pairs .vt-row:has-text('barrier')");
  await p.click(".list-table .vt-row:nth-child(2)"); await settled(p);
  const target = await p.evaluate(() => {
    const { report, viewport } = window.deckReport;
    viewport.view.setSelected(null);
    const r = viewport.view.canvas.getBoundingClientRect();
    for (const x of report.filtered) {
      if (x === report.selected) continue;
      const at = viewport.view.screen(x);
      if (!at || at.x < r.x + 40 || at.x > r.right - 220 || at.y < r.y + 70 || at.y > r.bottom - 60) continue;
      const picked = viewport.view.pick(at.x, at.y);
      if (picked.hit && picked.hit !== report.selected) return { x: at.x, y: at.y, key: picked.hit.key };
    }
    return null;
  });
  if (check("there is a second node in sight", target !== null)) {
    await p.mouse.click(target.x, target.y);
    await settled(p);
    const got = await p.evaluate(() => ({ key: window.deckReport.report.selected?.key, row: document.querySelectorAll(".list-table .vt-row.selected").length }));
    same("a click on a node selects its row", got, { key: target.key, row: 1 });
  }
  // A slider, by hand.
  await p.keyboard.press("Escape"); await p.click(".interfaces-table .vt-row:has-text('tube rim on barrier')");
  for (const value of [0.9, 2.2]) {
    await p.fill("#f-Igap, #f-Igap", "").catch(() => {});
    await p.selectOption("#f-Igap", "0");
    await p.$eval("#f-Gapmin", (e, v) => {
      e.value = String(v);
      e.dispatchEvent(new Event("input", { bubbles: true }));
    }, value);
    const set = await p.evaluate(() => window.deckReport.report.overrides[0].Gapmin);
    const said = Number(await p.$eval(".outcome", (e) => e.dataset.pairs));
    const real = gaps(path, "--what-if", `1:Igap=0,Gapmin=${set}`).interfaces[0].contacts[0].totals.pairs;
    same(`the slider at ${set} gives the count of deck gaps`, said, real);
  }
  const card = await p.$eval(".card", (e) => e.textContent);
  const marked = await p.$$eval(".card mark", (m) => m.map((e) => e.textContent.trim()));
  check("the card holds the changed values", marked.includes("1000") && marked.length === 2, marked.join(" "));
  writeFileSync(join(scratch, "card.rad"), readFileSync(path, "utf8").replace(/\/INTER\/TYPE7\/1\n[^]*?(?=\n\/)/, card.trimEnd()));
  const changed = gaps(join(scratch, "card.rad")).interfaces[0].contacts[0];
  const gapmin = await p.evaluate(() => window.deckReport.report.overrides[0].Gapmin);
  same("the copied card does in the deck what the page says", [changed.gapmin, changed.totals.pairs], [gapmin, Number(await p.$eval(".outcome", (e) => e.dataset.pairs))]);
  await p.$eval("#whatif", (e) => e.scrollIntoView());
  await shot(p, "crash_box_what_if");
  await p.click("#whatif button:has-text('Reset')"); await p.keyboard.press("Escape");
  // Keys.
  await p.keyboard.press("j"); await p.keyboard.press("j");
  const second = await p.evaluate(() => window.deckReport.report.selected?.key === window.deckReport.report.filtered[1].key);
  check("j j selects the second row", second);
  await p.keyboard.press("2");
  same("key 2 shows depth over gap", await p.$eval(".legend-title", (e) => e.textContent), "Depth ÷ gap");
  for (const k of ["3", "4", "5", "1", "a", "a", "w", "w", "h", "h", "x", "x", "p", "p", "i", "i", "f", "s"]) await p.keyboard.press(k);
  await p.keyboard.press("?");
  check("? opens the list of keys", await p.$eval("dialog", (d) => d.open));
  await p.keyboard.press("Escape"); await p.keyboard.press("t");
  await settled(p);
  same("t turns the lights off", await p.$eval("html", (e) => e.dataset.theme), "dark");
  await shot(p, "crash_box_dark");
  await p.keyboard.press("t"); await p.keyboard.press("Escape");
  // Exports.
  same("the CSV is that of deck gaps --csv", (await p.evaluate(() => window.deckReport.csv())).split("\r\n").length,
    deck("gaps", path, "--quiet", "--csv", "-").split("\r\n").length);
  const grnod = await p.evaluate(() => window.deckReport.grnod());
  const with_group = join(scratch, "grnod.rad");
  writeFileSync(with_group, readFileSync(path, "utf8").replace(/\/END\s*$/, `${grnod}/END\n`));
  const errors = (file) => JSON.parse(deck("lint", file, "--format", "json")).summary.errors;
  same("the /GRNOD/NODE block reads without an error", errors(with_group), errors(path));
  await p.click("#export summary");
  const [download] = await Promise.all([p.waitForEvent("download"), p.click("#export button:has-text('all columns')")]);
  same("the export has the deck's name", download.suggestedFilename(), "crash_box_0000_penetrations.csv");
  const fetched = async (label) => {
    await p.click("#export summary");
    const [d] = await Promise.all([p.waitForEvent("download"), p.click(`#export button:has-text('${label}')`)]);
    return readFileSync(await d.path(), "utf8");
  };
  const list = (await fetched("the columns in sight")).trimEnd().split("\r\n");
  const titles = await p.$$eval(".list-table [role=columnheader] button", (b) => b.map((e) => e.textContent.replace(/\s[↑↓]$/, "")));
  same("the list as CSV has the columns and rows in sight", [list[0], list.length - 1], [titles.join(","), await p.evaluate(() => window.deckReport.report.filtered.length)]);
  const tcl = await fetched("(Tcl)");
  const marked_nodes = [...tcl.matchAll(/^\*(?:create|append)mark nodes 1 (.*)$/gm)].flatMap((m) => m[1].split(" ").map(Number));
  same("the Tcl marks the nodes of the list", marked_nodes, await p.evaluate(() => [...new Set(window.deckReport.report.filtered.flatMap((x) => x.nodes.filter((n) => n > 0)))].sort((a, b) => a - b)));
  // The same text run by tclsh, with HyperMesh's public commands in place of HyperMesh.
  const script = join(scratch, "marks.tcl");
  writeFileSync(script, `set marked {}
proc *clearmark {type mark} { if {$type ne "nodes" || $mark != 1} {error "clearmark $type $mark"}; set ::marked {} }
proc *createmark {type mark args} { if {$type ne "nodes" || $mark != 1 || [llength $args] == 0} {error "createmark"}; set ::marked $args }
proc *appendmark {type mark args} { if {$type ne "nodes" || $mark != 1 || [llength $args] == 0} {error "appendmark"}; lappend ::marked {*}$args }
proc *entitysetcreate {name type mark} { if {$name eq "" || $type ne "nodes" || $mark != 1} {error "entitysetcreate"}; puts "set [llength $::marked]" }
proc *numbersmark {type mark on} { if {$type ne "nodes" || $mark != 1 || $on != 1} {error "numbersmark"} }
${tcl}
puts $marked
`);
  const ran = spawnSync("tclsh", [script], { encoding: "utf8" });
  if (ran.error) skip("the Tcl, run: no tclsh");
  else same("tclsh runs the Tcl and has marked the same nodes", [ran.stderr, ...ran.stdout.trim().split("\n")], ["", `set ${marked_nodes.length}`, marked_nodes.join(" ")]);
  await pictureSays(p, "crash_box_0000");
  // Print.
  await paperSays(p);
  await p.emulateMedia({ media: "print" });
  await p.pdf({ path: join(DECK_ARTEFACTS, "crash_box.pdf"), format: "A4" });
  same("a report is printed on two pages", pagesOf("crash_box.pdf"), 2);
  const paper = await p.$eval(".paper", (e) => ({ picture: e.querySelectorAll("img").length, rows: [...e.querySelectorAll("tbody")].map((b) => b.rows.length) }));
  same("paper has the picture, the ten worst and the interfaces", paper, { picture: 1, rows: [10, json.interfaces.length] });
  await p.emulateMedia({ media: "screen" });
  await done(p, "crash box");
}
async function layout() {
  const fit = async (name, file, at) => {
    const p = await open(browser, file);
    await banner(p, name);
    await scalesFit(p, name);
    await tablesFit(p, name, at);
    await done(p, name);
  };
  await fit("crash box", join(scratch, "crash_box.html"), widths);
  await fit("every mistake", page("every_mistake", sample("every_mistake")), ALL ? widths : [390, 1280]);
  if (ALL)
    for (const path of readdirSync(join(ROOT, "samples")).filter((f) => f.endsWith("_0000.rad")).map((f) => join(ROOT, "samples", f)))
      await fit(basename(path), page("any", path), widths);
  // Titles with the same long beginning.
  const folded = join(scratch, "folded_0000.rad");
  writeFileSync(folded, readFileSync(sample("crash_box"), "utf8").replace(/^(\/(?:PART|INTER\/TYPE\d+)\/\d+\n)(.*)$/gm, "$1FRONT_STRUCTURE_$2"));
  const p = await open(browser, page("folded", folded));
  await tablesBehave(p);
  await p.close();
}
async function accessibility() {
  const p = await open(browser, join(scratch, "crash_box.html"));
  await accessible(p, "report");
  await reachable(p, "report");
  await p.keyboard.press("t");
  await p.evaluate(() => {
    const { report } = window.deckReport;
    report.setFilter({ interface: 0 });
    report.select(report.filtered[0]);
  });
  for (const k of ["x", "p", "m"]) await p.keyboard.press(k);
  await settled(p);
  await accessible(p, "report, dark, everything open");
  await shot(p, "everything_open_dark");
  await p.close();
}
async function pictures() {
  let p = await open(browser, join(scratch, "crash_box.html"));
  await picture(p, sample("crash_box"));
  await chosenAlone(p);
  await column(p);
  await done(p, "picture");
  // Element sides are drawn where they can be told apart, and not from afar.
  p = await open(browser, join(scratch, "crash_box.html"));
  await p.keyboard.press("o");
  const sides = async (factor) => {
    await p.evaluate((f) => window.deckReport.viewport.view.control.zoom(f, null), factor); await settled(p);
    return p.evaluate(() => window.deckReport.viewport.view.parts.parts.filter((x) => x.lines?.visible).length);
  };
  const near = await sides(1);
  check("element sides are drawn, and left out from afar", near > 0 && (await sides(30)) === 0 && (await sides(1 / 30)) === near, `${near}`);
  await p.close();
  // A browser without threads and an inflater of its own.
  const old = await browser.newContext();
  await old.addInitScript(() => { delete window.DecompressionStream; delete window.Worker; });
  p = await open(old, join(scratch, "crash_box.html"));
  check("the page unpacks its data itself where the browser cannot", await p.evaluate(() => typeof DecompressionStream === "undefined" && !window.deckReport.beside && window.deckReport.report.verified));
  check("nothing is left of the progress", (await p.$(".unpacking")) === null);
  await done(p, "without an inflater");
  await old.close();
  // Where nothing penetrates, who touches whom can be in sight before the picture is there.
  const watched = await browser.newContext();
  await watched.addInitScript(() => {
    window.IntersectionObserver = class { constructor(f) { this.f = f; } observe() { queueMicrotask(() => this.f([{ isIntersecting: true }], this)); } disconnect() {} };
    new MutationObserver(() => {
      if (document.documentElement.dataset.ready && window.early === undefined) window.early = document.querySelector("#touches svg.tw") !== null;
    }).observe(document, { subtree: true, attributes: true, childList: true });
  });
  p = await open(watched, page("clean", sample("clean_plates")));
  await p.waitForSelector("#touches svg.tw");
  same("the first picture does not wait for the drawing of who touches whom", await p.evaluate(() => window.early), false);
  await done(p, "clean plates");
  await watched.close();
  p = await open(browser, page("solids", sample("solid_and_skin")));
  await section(p);
  await done(p, "section planes");
}
async function comparison() {
  const path = sample("too_close");
  const old = join(scratch, "old.json");
  // The earlier state: a smaller gap, so that all of today's penetrations are new or worse.
  deck("gaps", path, "--quiet", "--json", old, "--what-if", "1:Gapmin=1.1");
  const before = JSON.parse(readFileSync(old)).summary.nodes;
  let p = await open(browser, page("compare", path, "--compare", old));
  const chips = await p.$$eval(".compare .chip", (c) => c.map((e) => e.textContent));
  const now = gaps(path).summary.nodes;
  const count = (name) => Number(chips.find((c) => c.endsWith(name)).split(" ")[0]);
  same("every node of both reports is accounted for", [count("new") + count("worse") + count("better") + count("same"), count("worse") + count("better") + count("same") + count("solved")], [now, before]);
  check("a larger gap makes it worse", count("worse") > 0 && count("better") === 0, chips.join(", "));
  await p.click(".compare .worse");
  same("the chip filters the list", (await p.evaluate(() => window.deckReport.report.filtered.every((x) => x.status === "worse"))), true);
  await shot(p, "compare");
  await done(p, "comparison");
  p = await open(browser, page("compare2", path, "--compare", old, "--what-if", "1:Gapmin=0.1"));
  const solved = await p.$$eval(".compare .chip", (c) => c.map((e) => e.textContent).find((t) => t.endsWith("solved")));
  same("with a small gap all is solved", solved, `${before} solved`);
  await p.close();
}
/** A report that cannot be compared with is wrong usage with a reason, not a page. */
function badComparison() {
  for (const [name, text] of [["text", "no json"], ["list", "[]"], ["other", '{"interfaces":3}'], ["inner", '{"interfaces":[{"id":1,"contacts":[{"penetrations":[7]}]}]}']]) {
    const file = join(scratch, `bad_${name}.json`);
    writeFileSync(file, text);
    const r = run("gaps", sample("too_close"), "--quiet", "--html", join(scratch, "bad.html"), "--compare", file);
    check(`--compare with ${name} is refused with a reason`, r.code === 2 && r.err.includes(file) && /deck gaps --json/.test(r.err), `${r.code} ${r.err}`);
  }
  same("--compare alone is wrong usage", run("gaps", sample("too_close"), "--quiet", "--compare", "x.json").code, 2);
}
async function firstCycle() {
  const path = sample("crash_box");
  const p = await open(browser, join(scratch, "crash_box.html"));
  const cycle = JSON.parse(deck("cycle", path, "--json", "-", "--quiet", "--all"));
  const mine = await p.evaluate(() => {
    const { report } = window.deckReport;
    return report.hits.map((x) => [report.meta.interfaces[report.meta.contacts[x.contact].interface].id, report.meta.contacts[x.contact].role, report.secondaryText(x.row), report.mainText(x.row), report.forceOf(x.row)?.force ?? null]);
  });
  const key = (...t) => t.join("/");
  const forces = new Map();
  for (const i of cycle.interfaces)
    for (const c of i.contacts)
      for (const pair of c.pairs) {
        const main = pair.main_edge ?? pair.segment;
        const text = pair.main_edge ? main.join("–") : (main[2] === main[3] ? main.slice(0, 3) : main).join(" ");
        forces.set(key(i.id, c.role, (pair.edge ?? [pair.node]).join("–"), text), Math.hypot(...pair.force));
      }
  check("deck cycle has forces", forces.size > 0);
  const unlike = mine.filter(([id, role, s, m, f]) => forces.has(key(id, role, s, m)) && !(Math.abs(f - forces.get(key(id, role, s, m))) <= 1e-12 * Math.abs(f)));
  check("forces of the list are those of deck cycle", unlike.length === 0 && mine.some((r) => r[4] > 0), JSON.stringify(unlike.slice(0, 3)));
  const table = await cells(p, "#cycle");
  check("the first cycle has one row per interface", table.length > 0 && new Set(table.map((r) => r.id)).size === table.length, table.map((r) => r.id).join(" "));
  const added = table.filter((r) => Number(r.pairs) !== cycle.interfaces.find((i) => String(i.id) === r.id).contacts.reduce((n, c) => n + c.pairs.filter((x) => Math.hypot(...x.force) > 0).length, 0));
  same("its pairs with a force are those of deck cycle, all contacts of the interface together", added, []);
  const crossed = await p.evaluate(() => window.deckReport.report.crossed?.total ?? -1);
  check("crossed elements were searched for", crossed >= 0, `${crossed}`);
  if (crossed > 0) {
    same("every crossing has a row", (await p.evaluate(() => window.deckReport.report.crossed.rows.length)), crossed);
    await p.click("#crossed .vt-row"); await settled(p);
    await shot(p, "crash_box_crossed");
  }
  await done(p, "first cycle");
}
async function hostileText() {
  const evil = '<script>alert(1)</script>"\'&<img src=x onerror=alert(2)>';
  const text = readFileSync(sample("too_close"), "utf8").replace(/^(\/(?:PART|INTER\/TYPE7)\/\d+\n).*$/gm, `$1${evil}`).replace(/^(\/BEGIN\n).*$/m, `$1${evil.slice(0, 79)}`);
  check("the hostile deck holds the text", text.split(evil).length > 2);
  const path = join(scratch, "<b>evil_0000.rad");
  writeFileSync(path, text);
  const file = page("evil", path);
  const p = await open(browser, file);
  await p.click(".list-table .vt-row"); await p.click(".interfaces-table .vt-row");
  await p.keyboard.press("p"); await settled(p);
  check("the title is shown as text", (await p.$eval(".interfaces-table", (e) => e.textContent)).includes("<script>alert("));
  same("no element came from the deck", await p.$$eval("img, b > b, .left script", (e) => e.length), 0);
  await done(p, "hostile text");
  const q = await browser.newPage({ javaScriptEnabled: false });
  await q.goto(`file://${file}`);
  check("without scripts the verdict and a table are there", /initial penetrations? on/.test(await q.$eval("#static", (e) => e.textContent)));
  await q.close();
}
async function withoutWebGL() {
  const plain = await launch("--disable-3d-apis", "--disable-webgl");
  const p = await open(plain, join(scratch, "crash_box.html"));
  check("without WebGL the page says so", /no WebGL/.test(await p.$eval("#view", (e) => e.textContent)));
  await p.click(".list-table .vt-row");
  check("without WebGL rows can be chosen", /Inacti/.test(await p.$eval("#detail", (e) => e.textContent)));
  check("nothing but WebGL is missed", p.trouble.every((t) => /WebGL/.test(t)), p.trouble.join("; "));
  await shot(p, "no_webgl");
  await plain.close();
}
async function sled() {
  const path = corpus("EuroSID_II/example_es2_sled_0000.rad");
  if (!path) return skip("the sled is not in the corpus");
  // The same with gaps 2.5 times as large, so that there is something to see.
  const wide = join(scratch, "sled");
  mkdirSync(wide, { recursive: true });
  cpSync(path, join(wide, "example_es2_sled_0000.rad"));
  execFileSync("python3", [join(DECK_CORPUS, "check", "inflate_gaps.py"), corpus("EuroSID_II/EuroSID_II_0000.rad"), join(wide, "EuroSID_II_0000.rad"), "2.5", "zero"]);
  for (const [name, deckPath] of [["sled", path], ["sled_inflated", join(wide, "example_es2_sled_0000.rad")]]) {
    const file = join(scratch, `${name}.html`);
    const [json] = await Promise.all([gapsLater(deckPath), deckLater("gaps", deckPath, "--quiet", "--html", file)]);
    const size = statSync(file).size;
    check(`${name}: at most 12 MB`, size <= 12 * 2 ** 20, `${size}`);
    const p = await open(browser, file);
    await settled(p);
    await measuring(p);
    const info = await p.evaluate(() => {
      const { times, report, viewport } = window.deckReport;
      return { ...times, verified: report.verified, pairs: report.hits.length, calls: viewport.view.drawCalls, frame: viewport.view.measure(6), moving: viewport.view.measure(6, true), segments: report.meta.contacts.reduce((n, c) => n + c.main, 0) };
    });
    const slices = await p.evaluate(() => {
      const { view } = window.deckReport.viewport;
      const { times, url } = view.inSlices();
      return { same: url === view.picture(), times: times.sort((a, b) => a - b) };
    });
    check(`${name}: in slices it is the same picture`, slices.same && slices.times.length > 0);
    timings[name] = { slice_ms: Math.round(slices.times[slices.times.length >> 1]), slices: slices.times.length, megabytes: +(size / 1e6).toFixed(2), decoded_ms: Math.round(info.decoded), evaluated_ms: Math.round(info.evaluated), tables_ms: Math.round(info.tables), picture_ms: Math.round(info.pictureSinceNavigation), frame_ms: +info.frame.toFixed(1), frame_moving_ms: +info.moving.toFixed(1), draw_calls: info.calls, segments: info.segments };
    check(`${name}: counted in the page as in the program`, info.verified);
    same(`${name}: penetrations of the JSON`, info.pairs, json.summary.pairs);
    if (name === "sled") {
      // Against the same page without scripts, in turns: shared machines stall.
      const turns = [];
      for (let i = 0; i < 3; i++) turns.push([await withoutScripts(browser, file), (await beforeThePicture(browser, file)).picture]);
      const [plain, first] = [0, 1].map((k) => turns.reduce((n, t) => n + t[k], 0) / turns.length);
      Object.assign(timings[name], { without_scripts_ms: Math.round(plain), to_the_picture_ms: Math.round(first) });
      check("the first picture of the sled costs little beside the page itself", first < 5.4 * plain, `${Math.round(first)} ms of processor time, ${Math.round(plain)} ms without scripts`);
    }
    if (name === "sled_inflated") {
      const step = (timings[name].step = await stepTime(p));
      check("a movement of a slider is seen within 100 ms, or a quarter of the time to unpack the page, on the inflated sled", Math.min(step.shown_ms, step.worked_ms) <= Math.max(100, info.decoded / 4), JSON.stringify({ ...step, decoded_ms: info.decoded }));
    }
    check(`${name}: draw calls are bounded`, info.calls < 800, `${info.calls}`);
    if (json.summary.pairs > 0) {
      await p.click(".list-table .vt-row"); await settled(p);
      check("a row of the sled selects its node", await p.evaluate(() => window.deckReport.report.selected === window.deckReport.report.filtered[0]));
    }
    await settled(p);
    await shot(p, name);
    await p.pdf({ path: join(DECK_ARTEFACTS, `${name}.pdf`) });
    same(`${name}: printed on two pages`, pagesOf(`${name}.pdf`), 2);
    await tablesFit(p, name, ALL ? widths : [390, 1440]);
    await done(p, name);
  }
  await settings([[join(wide, "example_es2_sled_0000.rad"), 6]]);
}
let compared = 0;
async function settings(list) {
  // Two decks at a time: the program answers for one while the browser does for the other.
  const left = list.map((item, i) => [...item, 20 + i]);
  await Promise.all([0, 1].map(async (worker) => {
    for (let next = left.shift(); next; next = left.shift()) {
      const [path, count, seed] = next;
      const file = join(scratch, `settings_${worker}.html`);
      await deckLater("gaps", path, "--quiet", "--html", file);
      const r = await tryDeck(browser, path, file, count, seed);
      compared += r.compared;
      timings.settings_beyond_reach = (timings.settings_beyond_reach ?? 0) + r.beyond;
    }
  }));
}
async function manySettings() {
  const most = { crash_box: 30, inacti_variants: 15, two_surfaces: 15, variable_gap: 20, solid_and_skin: 12, crossing_edges: 15 };
  const names = readdirSync(join(ROOT, "samples")).filter((f) => f.endsWith("_0000.rad")).map((f) => f.slice(0, -"_0000.rad".length));
  await settings(names.map((name) => [sample(name), most[name] ?? 4]));
  const more = ["syna", "synb", "sync", "synd", "syne", "synf", "syng"].map((n) => corpus(`synthetic/${n}_0000.rad`)).filter(Boolean);
  if (more.length > 0) await settings(more.map((path) => [path, 4]));
  else skip("settings on the synthetic decks of the corpus");
}
// ONLY=crashBox,layout runs some pieces; the later ones read pages that crashBox writes. `timed` ones miss their times on a busy machine.
const timed = ["largeModel", "budget", "sled"];
const pieces = { crashBox, answers: () => answers(browser), layout, pictures, accessibility, accuracy: () => accuracyPage(browser), effects: () => effectsPage(browser), finding: () => find(browser, join(scratch, "crash_box.html"), sample("crash_box")), largeModel: () => largeModel(browser, timings), view: () => viewTools(browser, join(scratch, "crash_box.html")), nearest: () => nearest(browser), budget: () => budget(browser, timings), choosing: () => choosing(browser), thumbnails: () => thumbnails(browser), ties: () => tiesAndModern(browser), parts: () => partsPage(browser), repair: () => repairPages(browser), firstCycle, comparison, badComparison, hostileText, withoutWebGL, panels: () => panelsWrite(browser), started: () => startedWith(browser), manySettings, sled };
const only = process.env.ONLY?.split(",") ?? (ALL ? null : Object.keys(pieces).filter((name) => timed.includes(name) === (process.env.TIMES === "yes")));
timings.seconds = {};
for (const [name, piece] of Object.entries(pieces)) {
  if (only && !only.includes(name)) continue;
  const start = performance.now();
  await piece();
  timings.seconds[name] = +((performance.now() - start) / 1000).toFixed(1);
}
if (!only || only.includes("manySettings")) check("at least 100 settings were compared bit for bit", compared >= 100, `${compared}`);
timings.settings_compared = compared;
writeFileSync(join(DECK_ARTEFACTS, process.env.TIMES === "yes" ? "times.json" : "timings.json"), JSON.stringify(timings, null, 1));
console.log(JSON.stringify(timings));
await browser.close();
finish();
