// The page: files come in, `deck` runs over them in threads, what it says is drawn. Nothing is
// sent and nothing is kept.
import { button, h, plural, replace } from "../../viewer/src/dom";
import { drawCards, type Card, type Cell, type Shown } from "./card";
import { Cancelled, deck, engine, KeptLane, Lane, unpacked } from "./client";
import { ConvertView } from "./convert";
import type { Result } from "./engine";
import { chosen, dropped, save, type Given } from "./files";
import { drawFinding, FindingList, type Finding, type LintDocument, type Rule } from "./findings";
import { Picture } from "./picture";
import { RepairView } from "./repair";
import { TextView, type Mark } from "./text";
import { Tree, unpack } from "./tree";
import { asPrinted, Values, type ParamsDocument } from "./values";

const text = (b: Uint8Array) => new TextDecoder().decode(b);
const OTHER = "other";

let tree = new Tree();
let main = "";
let other: Tree | null = null;
let lint: LintDocument | null = null;
let place: (Mark & { file: string }) | null = null;
const lanes = { kept: new KeptLane(), lint: new Lane(), values: new Lane(), gaps: new Lane(), card: new Lane(), rules: new Lane(), repair: new Lane(), convert: new Lane(), page: new Lane(), cycle: new Lane(), diff: new Lane() };

/* ---- parts of the page ---- */

const status = h("span", { class: "status muted", role: "status" });
const cancel = button("Cancel", null, () => stopAll(), { class: "small", hidden: true });
const title = h("h1", null, "deck");
const roots = h("select", { "aria-label": "Deck", hidden: true });
const verdict = h("p", { class: "verdict-line", role: "status" });
const stage = h("div", { class: "stages", hidden: true });
const trouble = h("div", { class: "note warn trouble", role: "alert", hidden: true });
const missing = h("div", { class: "note warn missing", hidden: true });
const files = h("input", { type: "file", multiple: true, hidden: true, id: "files", "aria-label": "Files" });
const folder = h("input", { type: "file", webkitdirectory: true, hidden: true, id: "folder", "aria-label": "Folder" });
const second = h("input", { type: "file", multiple: true, hidden: true, id: "second", "aria-label": "Deck to compare with" });
const list = new FindingList((f) => showFinding(f));
const about = h("section", { class: "about", "aria-label": "Finding" });
const cards = h("section", { class: "card-panel", "aria-label": "Cards" });
const view = new TextView();
const which = h("select", { "aria-label": "File" });
const values = new Values((s, keyword, id) => goTo(s, keyword, id));
const gapsPage = h("div", { class: "report" });
const cyclePage = h("div", { class: "report" });
const picture = new Picture(unpacked("bridge").then((b) => new TextDecoder().decode(b)), (file, line) => goTo({ file, line, column: 1, end_column: 1 }, null, 0));
const takeOver = (files: Record<string, Uint8Array>) => {
  tree.change(files);
  list.reset();
  void refresh();
};
const repair = new RepairView({
  main: () => main,
  get: (name) => tree.get(name),
  run: (args) => run(lanes.repair, args),
  frame: (page, label) => frameOf(text(page), label),
  take: takeOver,
});
const convert = new ConvertView({
  main: () => main,
  stem: () => stem(),
  get: (name) => tree.get(name),
  run: (args) => run(lanes.convert, args),
  take: takeOver,
  go: (file, line) => goTo({ file, line, column: 1, end_column: 1 }, null, 0),
});
const diffPage = h("div", { class: "output-page" });
const explained = h("dialog", { class: "explain", "aria-label": "Explanation" });
const undo = button("Undo", "undo", () => {
  if (tree.undo()) void refresh();
}, { disabled: true });

const save1 = (label: string, name: () => string, make: () => Promise<string | Uint8Array>, type: string) =>
  button(label, null, () => {
    void make().then((content) => save(name(), content, type), (e: Error) => e instanceof Cancelled || say(e.message));
  }, { class: "small" });
const stem = () => main.slice(main.lastIndexOf("/") + 1).replace(/(_0000)?\.[a-z]+(\.gz)?$/i, "");
async function output(args: string[], file?: string): Promise<string | Uint8Array> {
  const r = await lanes.page.run(args, tree.all());
  const out = file ? r.files[file] : r.stdout;
  if (!out || r.exitCode > 3) throw new Error(text(r.stderr) || "there is nothing to save");
  return out;
}
const downloads = h(
  "details", { class: "downloads" }, h("summary", { class: "button" }, "Download"),
  h("div", { class: "menu-list" },
    save1("Deck with its files (zip)", () => `${stem()}.zip`, async () => tree.zip(), "application/zip"),
    save1("Changes (patch)", () => `${stem()}.patch`, async () => Uint8Array.from([...tree.patch()].map((c) => c.charCodeAt(0))), "text/x-patch"),
    save1("Gap report (HTML)", () => `${stem()}.html`, () => output(["gaps", main, "--html", "gaps.html", "-q"], "gaps.html"), "text/html"),
    save1("Gaps (JSON)", () => `${stem()}.gaps.json`, () => output(["gaps", main, "--json", "-", "-q"]), "application/json"),
    save1("Findings (JSON)", () => `${stem()}.lint.json`, () => output(["lint", main, "--geometry", "--json", "-", "-q"]), "application/json"),
    save1("Findings (SARIF)", () => `${stem()}.sarif`, () => output(["lint", main, "--geometry", "--format", "sarif", "-q"]), "application/json"),
  ),
);

const tabs: { id: string; label: string; body: HTMLElement; open?: () => void }[] = [
  { id: "findings", label: "Findings", body: h("div", { class: "two" }, list.element, h("div", { class: "beside" }, about, cards, h("div", { class: "text-head" }, which), view.element)) },
  { id: "values", label: "Values", body: values.element },
  { id: "gaps", label: "Gaps", body: gapsPage, open: () => void openGaps() },
  { id: "cycle", label: "First cycle", body: cyclePage, open: () => void openCycle() },
  { id: "repair", label: "Repair", body: repair.element },
  { id: "convert", label: "Convert", body: convert.element },
  { id: "diff", label: "Difference", body: diffPage, open: () => void openDiff() },
];
let tab = "findings";
const tabButtons = tabs.map((t) => h("button", { type: "button", role: "tab", id: `tab-${t.id}`, "aria-controls": `panel-${t.id}`, onclick: () => show(t.id) }, t.label));
for (const t of tabs) {
  t.body.id = `panel-${t.id}`;
  t.body.setAttribute("role", "tabpanel");
  t.body.setAttribute("aria-labelledby", `tab-${t.id}`);
}
const tabList = h("div", { class: "tabs", role: "tablist", "aria-label": "Views", onkeydown: ((e: KeyboardEvent) => {
  const step = e.key === "ArrowRight" ? 1 : e.key === "ArrowLeft" ? -1 : 0;
  if (step === 0) return;
  const at = tabs.findIndex((t) => t.id === tab);
  show(tabs[(at + step + tabs.length) % tabs.length].id);
  tabButtons[(at + step + tabs.length) % tabs.length].focus();
}) as EventListener }, ...tabButtons);

function show(id: string): void {
  tab = id;
  tabs.forEach((t, i) => {
    t.body.hidden = t.id !== id;
    tabButtons[i].setAttribute("aria-selected", String(t.id === id));
  });
  if (main !== "") tabs.find((t) => t.id === id)?.open?.();
}

const welcome = h(
  "main", { class: "welcome" },
  h("div", { class: "drop-area" },
    h("h2", null, "Drop a Radioss deck here"),
    h("p", null, "A Starter deck (", h("code", null, "NAME_0000.rad"), "), its folder with all includes, a .zip or a .gz."),
    h("p", { class: "buttons" }, button("Choose files\u2026", null, () => files.click(), { class: "primary" }), button("Choose a folder\u2026", null, () => folder.click()))),
  h("p", { class: "buttons" }, "No deck at hand? ", button("Try the crash box", null, () => void arrive(sampleDeck(), open), { class: "sample" })),
  h("p", { class: "muted" }, "The deck is checked by ", h("code", null, "deck"), " itself, in this page: nothing is installed, nothing is sent, nothing is kept."),
);
/** The sample that the page brings. */
async function sampleDeck(): Promise<Given[]> {
  return [{ name: "crash_box_0000.rad", bytes: new Uint8Array(await unpacked("sample")) }];
}
const work = h("main", { class: "work", hidden: true }, h("div", { class: "work-head" }, stage, verdict, missing), tabList, ...tabs.map((t) => t.body));
const dark = button("Dark or light", "sun", () => {
  const now = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  document.documentElement.dataset.theme = now;
}, { class: "tool", "aria-label": "Dark or light", title: "Dark or light" });
const header = h(
  "header", { class: "top" }, h("div", { class: "brand" }, h("span", { class: "mark" }), "deck"), h("div", { class: "deck-name" }, title, roots), status, cancel,
  h("div", { class: "tools" }, undo, downloads, button("Open…", null, () => files.click()), dark),
);

/* ---- runs ---- */

let running = 0;
let began = 0;
let clock = 0;

function say(message: string): void {
  trouble.textContent = message;
  trouble.hidden = message === "";
}

/** What runs now, by what it is called on the page. */
const doing: string[] = [];
let done = 0;

function drawStages(): void {
  const seconds = ((performance.now() - began) / 1000).toFixed(1);
  status.textContent = `working, ${seconds} s`;
  stage.hidden = running === 0 || performance.now() - began < 300;
  replace(stage, h("progress", { max: done + doing.length, value: done, "aria-label": "Runs that are done" }), h("span", null, `${[...new Set(doing)].join(", ")} (${done} of ${done + doing.length} done, ${seconds} s)`));
}

function tick(): void {
  const busy = running > 0;
  cancel.hidden = !busy;
  if (busy && clock === 0) {
    began = performance.now();
    clock = window.setInterval(drawStages, 150);
  } else if (!busy && clock !== 0) {
    clearInterval(clock);
    clock = 0;
    done = 0;
    status.textContent = "";
    stage.hidden = true;
  }
  document.documentElement.dataset.busy = String(busy);
}

const stageNames: Record<string, string> = { lint: "findings", params: "values", gaps: "gaps and penetrations", cycle: "first cycle", diff: "difference", show: "card", explain: "explanation", rules: "rules", fix: "repair", convert: "conversion" };

/** null: a newer run took its place, or it was cancelled. */
const run = (lane: Lane, args: string[], given = tree.all()): Promise<Result | null> =>
  whileBusy(args.includes("--no-geometry") && args[0] === "lint" ? "findings of the text" : args[0] === "lint" ? "findings of the geometry" : (stageNames[args[0]] ?? args[0]), () => lane.run(args, given));

async function whileBusy<T>(what: string, work: () => Promise<T>): Promise<T | null> {
  ++running;
  doing.push(what);
  tick();
  try {
    return await work();
  } catch (e) {
    if (!(e instanceof Cancelled)) throw e;
    return null;
  } finally {
    --running;
    doing.splice(doing.indexOf(what), 1);
    ++done;
    tick();
  }
}

function stopAll(): void {
  ++turns;
  for (const lane of Object.values(lanes)) lane.cancel();
  say("Cancelled. What is shown may be out of date; “Undo”, another change or another file starts again.");
}

function parsed<T>(r: Result, reviver?: (key: string, v: unknown) => unknown): T | null {
  try {
    return JSON.parse(text(r.stdout), reviver) as T;
  } catch {
    say(text(r.stderr).trim() || `deck ended with exit code ${r.exitCode} and said nothing`);
    return null;
  }
}

/** The chain of runs that goes on: a newer text and "Cancel" end the one before, also between two of its runs. */
let turns = 0;

/** All that follows the text. */
async function refresh(): Promise<void> {
  ++versions;
  const turn = ++turns;
  undo.disabled = !tree.canUndo;
  title.textContent = `${main}${tree.changed().length > 0 ? " (changed)" : ""}`;
  say("");
  drawText();
  repair.reset();
  convert.reset();
  // The findings of the text come first, with the machine to themselves.
  for (const lane of [lanes.lint, lanes.values, lanes.gaps]) lane.cancel();
  await refreshText();
  if (turn !== turns) return;
  await Promise.all([refreshGeometry(), refreshValues(), refreshGaps()]);
  if (turn !== turns) return;
  for (const t of tabs) if (t.id === tab) t.open?.();
}

/** Larger decks are not kept beside what else a page holds. */
const mostKept = 64e6;

async function refreshText(): Promise<void> {
  const files = tree.map();
  const size = [...files.values()].reduce((sum, b) => sum + b.length, 0);
  const again = size > mostKept ? null : await whileBusy("findings of the text", async () => ({ stdout: await lanes.kept.lint(main, files) }));
  if (size <= mostKept && !again) return;
  const r = again?.stdout ? { exitCode: 0, stdout: again.stdout, stderr: new Uint8Array(), files: {} } : await run(lanes.lint, ["lint", main, "--no-geometry", "--json", "-", "-q"]);
  if (r) showLint(r, "text");
}

async function refreshGeometry(): Promise<void> {
  const r = await run(lanes.lint, ["lint", main, "--geometry", "--json", "-", "-q"]);
  if (r) showLint(r, "all");
}

function showLint(r: Result, linted: string): void {
  const found = parsed<LintDocument>(r);
  document.documentElement.dataset.linted = found ? linted : "failed";
  if (!found) return;
  lint = found;
  list.show(lint.diagnostics);
  askForMissing();
  if (list.selected && list.chosen) showFinding(list.selected);
  else if (!place || !list.chosen) list.pickFirst();
  if (!list.selected && lint.diagnostics.length === 0) replace(about, h("p", null, "No findings."));
}

function askForMissing(): void {
  const names = (lint?.diagnostics ?? []).filter((f) => f.rule === "DK004").map((f) => /'([^']+)'/.exec(f.message)?.[1]).filter((n): n is string => n !== undefined);
  missing.hidden = names.length === 0;
  if (names.length === 0) return;
  replace(missing, h("span", null, `${plural(names.length, "included file is", "included files are")} not here: `), h("span", null, names.slice(0, 8).join(", ")), names.length > 8 && " …", " ", button("Add files…", null, () => files.click(), { class: "small" }), " or drop them.");
  missing.dataset.names = JSON.stringify(names);
}

async function refreshValues(): Promise<void> {
  const r = await run(lanes.values, ["params", main, "--json", "-", "-q"]);
  const document = r && parsed<ParamsDocument>(r, asPrinted);
  if (!document) return;
  values.show(document);
}

async function refreshGaps(): Promise<void> {
  // What is printed ends with the verdict, a paragraph of its own; the JSON of a large deck would be hundreds of MB.
  const r = await run(lanes.gaps, ["gaps", main, "--color", "always"]);
  if (r) showVerdict(text(r.stdout).trimEnd().split("\n\n").at(-1)!.split("\n", 1)[0]);
}

/** The program colours its verdict by its level: that is the level here, too. */
function showVerdict(line: string): void {
  const code = /^\u001b\[(?:\d+;)*(3[123])m/.exec(line)?.[1];
  verdict.dataset.level = code === "31" ? "error" : code === "33" ? "warning" : code === "32" ? "good" : "none";
  verdict.textContent = line.replace(/\u001b\[[\d;]*m/g, "");
}

/* ---- findings, cards, text ---- */

function drawText(): void {
  const name = place && tree.get(place.file) ? place.file : main;
  replace(which, ...tree.names.map((n) => h("option", { value: n, selected: n === name }, n)));
  const seen = tree.showable(name);
  if (seen) view.show(tree.text(name), tree.starts(name), place?.file === name ? place : null);
  else view.show(`${name} is too large to be shown in a page.\n`, [0], null);
}

function showFinding(f: Finding): void {
  drawFinding(about, f, { explain, fix: applyFix, picture: pictureOf(f), go: (file, line, column, end) => goTo({ file, line, column, end_column: end }, null, 0) });
  place = { file: f.file, line: f.line, column: f.column, endColumn: f.end_column };
  drawText();
  if (f.entity) void showCards(f.entity.keyword, f.entity.id);
  else replace(cards);
}

/** Shows the interface of a finding in the gap report; null: it is not one of an interface. */
function pictureOf(f: Finding): (() => void) | null {
  const source = f.entity?.keyword.startsWith("/INTER/") ? values.document?.interfaces.find((i) => i.id === f.entity!.id)?.source : undefined;
  return source ? () => {
    picture.show(source.file, source.line);
    show("gaps");
  } : null;
}

function goTo(s: { file: string; line: number; column: number; end_column: number }, keyword: string | null, id: number): void {
  place = { file: s.file, line: s.line, column: s.column, endColumn: Math.max(s.end_column, s.column + 1) };
  show("findings");
  drawText();
  if (keyword) {
    list.selected = null;
    list.chosen = true;
    replace(about, h("h2", null, `${keyword}/${id}`));
    void showCards(keyword, id);
  }
}

async function showCards(keyword: string, id: number): Promise<void> {
  const r = await run(lanes.card, ["show", main, `${keyword}/${id}`, "--no-geometry", "--json", "-", "-q"]);
  if (!r || !place) return;
  try {
    const entity = JSON.parse(text(r.stdout)) as Shown;
    const focused = cards.contains(document.activeElement) ? document.activeElement?.getAttribute("aria-label") : null;
    drawCards(cards, entity, place, writeCell);
    if (focused) cards.querySelector<HTMLElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
  } catch {
    replace(cards);
  }
}

function writeCell(card: Card, cell: Cell, entered: string): string {
  const [from, to] = cell.columns;
  const width = to - from + 1;
  if (entered.length > width) return `“${entered}” needs ${entered.length} columns; ${cell.field} has ${width}.`;
  if (/[^\x20-\x7e]/.test(entered)) return "A cell holds letters, digits and signs only.";
  const lineText = lineOf(card.file, card.line);
  const column = Math.min(from, lineText.length + 1);
  const blanks = " ".repeat(from - column);
  place = { file: card.file, line: card.line, column: from, endColumn: to + 1 };
  tree.apply([{ file: card.file, line: card.line, column, end_line: card.line, end_column: Math.min(to, lineText.length) + 1, text: blanks + entered.padStart(width) }]);
  void refresh().then(() => {
    const open = cards.querySelector("h3")?.firstChild?.textContent?.trim() ?? "";
    const slash = open.lastIndexOf("/");
    if (list.selected) return;
    replace(about, h("h2", null, open));
    if (slash > 0) void showCards(open.slice(0, slash), Number(open.slice(slash + 1)));
  });
  return "";
}

function lineOf(file: string, line: number): string {
  const starts = tree.starts(file);
  return starts[line - 1] === undefined ? "" : tree.text(file).slice(starts[line - 1], starts[line]).replace(/\r?\n?$/, "");
}

function applyFix(f: Finding): void {
  if (!f.fix) return;
  try {
    tree.apply(f.fix.edits);
  } catch (e) {
    say(e instanceof Error ? e.message : String(e));
    return;
  }
  list.reset();
  void refresh();
}

async function explain(rule: string): Promise<void> {
  const r = await run(lanes.page, ["explain", rule], {});
  if (!r) return;
  replace(explained, h("pre", { tabindex: "0" }, text(r.stdout) || text(r.stderr)), h("form", { method: "dialog" }, h("button", null, "Close")));
  explained.showModal();
}

/* ---- the other views ---- */

let versions = 0;
let gapsOf = -1;
/** A page of the program in a frame of its own without rights: it reaches neither this page nor anything else. */
async function framed(into: HTMLElement, lane: Lane, args: string[], label: string, given = tree.all(), more = (page: string) => Promise.resolve(page)): Promise<boolean> {
  if (into.childElementCount === 0) replace(into, h("p", { class: "muted" }, `${label} is being made \u2026`));
  const r = await run(lane, [...args, "--html", "page.html", "-q"], given);
  if (!r) return false;
  const page = r.files["page.html"];
  if (!page) {
    replace(into, h("pre", { class: "bad", tabindex: "0" }, text(r.stderr) || "There is no report."));
    return false;
  }
  replace(into, frameOf(await more(text(page)), label));
  return true;
}
function frameOf(page: string, label: string): HTMLElement {
  const frame = h("iframe", { title: label, sandbox: "allow-scripts allow-downloads allow-modals" });
  frame.srcdoc = page;
  return frame;
}

/** Made anew when the text is another one. */
async function openGaps(): Promise<void> {
  const state = versions;
  if (gapsOf !== state && (await framed(gapsPage, lanes.page, ["gaps", main], "Gap report", tree.all(), (page) => picture.with(page)))) {
    gapsOf = state;
    picture.use(gapsPage.querySelector("iframe")!);
  }
}
let cycleOf = -1;
async function openCycle(): Promise<void> {
  const state = versions;
  if (cycleOf !== state && (await framed(cyclePage, lanes.cycle, ["cycle", main], "First cycle"))) cycleOf = state;
}

let diffOf = -1;
async function openDiff(): Promise<void> {
  if (diffOf === versions && !other) return;
  diffOf = versions;
  const choose = button("Compare with another deck\u2026", null, () => second.click(), { class: "primary" });
  const out = h("div", { class: "report" });
  const siblings = tree.roots().filter((n) => n !== main);
  const pick = h("select", { "aria-label": "Deck to compare with" }, ...siblings.map((n) => h("option", { value: n }, n)));
  const compared = async (with_: string, given = tree.all()) => {
    replace(out);
    await framed(out, lanes.diff, ["diff", with_, main], "Difference", given);
  };
  pick.addEventListener("change", () => void compared(pick.value));
  const unchanged = tree.changed().length > 0 ? button("With the deck as it was opened", null, () => {
    const both = tree.all();
    for (const [n, b] of tree.original) both[`${OTHER}/${n}`] = b;
    void compared(`${OTHER}/${main}`, both);
  }) : null;
  const what = !other && siblings.length === 0 ? h("p", { class: "muted" }, unchanged ? "Compare with the deck as it was opened, or with another one." : "Choose or drop the deck to compare with: an earlier state of this one, or a variant.") : null;
  replace(diffPage, h("p", { class: "buttons" }, siblings.length > 0 && pick, choose, unchanged), what, out);
  if (other) {
    const both = tree.all();
    for (const n of other.names) both[`${OTHER}/${n}`] = other.get(n) as Uint8Array;
    await compared(`${OTHER}/${other.roots()[0]}`, both);
  } else if (siblings.length > 0) await compared(pick.value);
}

/* ---- files ---- */

function missingNames(): string[] {
  return missing.hidden ? [] : (JSON.parse(missing.dataset.names ?? "[]") as string[]);
}

function placed(given: Map<string, Uint8Array>): Map<string, Uint8Array> {
  // Files that a deck asked for go where it looks for them.
  const names = missingNames();
  const base = (n: string) => n.slice(n.lastIndexOf("/") + 1);
  const folderOf = main.slice(0, main.lastIndexOf("/") + 1);
  return new Map([...given].map(([n, b]) => {
    const wanted = names.find((m) => base(m) === base(n));
    return [wanted ? folderOf + wanted : n, b];
  }));
}

let openings = 0;

/** What was chosen or dropped last is what is shown; what cannot be read is said. */
async function arrive(coming: Promise<Given[]>, then: (given: Given[]) => void): Promise<void> {
  const mine = ++openings;
  try {
    const given = await coming;
    if (mine === openings) then(given);
  } catch (e) {
    if (mine === openings) say(e instanceof Error ? e.message : String(e));
  }
}

function open(given: Given[]): void {
  say("");
  const unpacked = unpack(given);
  if (unpacked.size === 0) return;
  const asked = placed(unpacked);
  const answers = main !== "" && [...asked.keys()].some((n) => !unpacked.has(n) || missingNames().includes(n));
  if (answers) tree.add(asked);
  else {
    tree = new Tree();
    tree.add(unpacked);
    other = null;
    place = null;
    list.reset();
    main = tree.roots()[0];
    gapsOf = -1;
  }
  start();
}

function compareWith(given: Given[]): void {
  const unpacked = unpack(given);
  if (unpacked.size === 0) return;
  other = new Tree();
  other.add(unpacked);
  void openDiff();
}

function start(): void {
  const all = tree.roots();
  roots.hidden = all.length < 2;
  replace(roots, ...all.map((n) => h("option", { value: n, selected: n === main }, n)));
  welcome.hidden = true;
  work.hidden = false;
  for (const page of [gapsPage, cyclePage]) replace(page);
  cycleOf = diffOf = -1;
  verdict.textContent = "";
  delete verdict.dataset.level;
  downloads.hidden = false;
  show(tab);
  void refresh();
}

roots.addEventListener("change", () => {
  main = roots.value;
  place = null;
  list.reset();
  void refresh();
});
which.addEventListener("change", () => {
  place = { file: which.value, line: 1, column: 1, endColumn: 1 };
  list.chosen = true;
  drawText();
});
for (const [input, then] of [[files, open], [folder, open], [second, compareWith]] as const)
  input.addEventListener("change", () => {
    void arrive(chosen(input.files as FileList), then);
    input.value = ""; // or the same file, changed on disk, could not be chosen again
  });
addEventListener("dragover", (e) => {
  e.preventDefault();
  document.documentElement.dataset.drag = "true";
});
addEventListener("dragleave", (e) => {
  if (e.relatedTarget === null) delete document.documentElement.dataset.drag;
});
addEventListener("drop", (e) => {
  e.preventDefault();
  delete document.documentElement.dataset.drag;
  if (e.dataTransfer) void arrive(dropped(e.dataTransfer), (given) => (tab === "diff" && main !== "" ? compareWith(given) : open(given)));
});
addEventListener("keydown", (e) => {
  const busyTyping = e.target instanceof HTMLInputElement || e.target instanceof HTMLSelectElement;
  if (!busyTyping && !e.ctrlKey && !e.metaKey && !e.altKey && /^[1-7]$/.test(e.key) && main !== "") show(tabs[Number(e.key) - 1].id);
  if (!busyTyping && (e.ctrlKey || e.metaKey) && e.key === "z" && tree.undo()) void refresh();
});
document.addEventListener("click", (e) => {
  if (downloads.open && !downloads.contains(e.target as Node)) downloads.open = false;
});

document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
document.body.append(header, trouble, welcome, work, files, folder, second, explained);
show("findings");
Object.assign(globalThis, { deck });
downloads.hidden = true; // there is nothing to save yet
async function loadRules(): Promise<void> {
  const r = await lanes.rules.run(["rules", "--json", "-"], {});
  list.setRules((JSON.parse(text(r.stdout)) as { rules: Rule[] }).rules);
}
void engine().then(() => {
  document.documentElement.dataset.ready = "true";
  void loadRules().catch(() => {}); // without them findings are grouped by their numbers alone
}, (e: Error) => say(`This browser cannot run deck: ${e.message}`));
if (location.protocol.startsWith("http") && "serviceWorker" in navigator) void navigator.serviceWorker.register("service-worker.js").catch(() => {});
