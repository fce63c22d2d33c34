// The page: reads its data, builds the sections, wires keys and exports.
import { loadModel } from "./decode/client";
import { crossedSection } from "./sections/crossed";
import { cycleSection, withoutSection } from "./sections/cycle";
import { loadCrossed, loadCycle, loadEarlier, loadMeta, loadTies, unpack } from "./data";
import type { Model } from "./decode/model";
import { detail, notChecked } from "./sections/detail";
import { button, fileName, group, h, onceShown } from "./dom";
import { allChangedCards, copyText, csv, grnodBlock, plainNodes, save, tclMarks } from "./exports";
import { distribution, exportMenu, listSection, pairsSection } from "./sections/lists";
import type { ContourKind, Look } from "./look";
import type { Overrides } from "./card";
import { interfaces } from "./sections/overview";
import { printing } from "./paper";
import { changesSection } from "./sections/changes";
import { movedSection } from "./sections/moved";
import { repairSection } from "./sections/repair";
import { loadPartsDocument, partsSection } from "./sections/parts";
import type { Document as CycleDocument } from "schema/cycle";
import type { Document as PartsDocument } from "schema/parts";
import { effectsSection, loadCycleDocument } from "./sections/effects";
import { findBox } from "./find";
import { openMenu, rowItems } from "./menu";
import { ViewState } from "./state";
import { setUnits } from "./table/columns";
import { unselectRows } from "./table/table";
import { touchesSection } from "./sections/touches";
import { verdict } from "./sections/verdict";
import { tiesSection } from "./sections/ties";
import { nearestSection } from "./sections/nearest";
import { noFilter, Report, type Hit } from "./report";
import type { WebGLRenderer } from "three";
import { drawsInSoftware, readyToDraw } from "./scene/ready";
import { switchHelp, switchOf } from "./scene/toolbar";
import { mouseSchemes, type MouseScheme } from "./scene/camera";
import { Viewport } from "./scene/viewport";

const started = performance.now();

/** Decodes the data beside the page with a progress display, prepares drawing, then builds the page. */
async function start(): Promise<void> {
  const bar = h("progress", { max: 1, value: 0, "aria-label": "Unpacking" });
  const said = h("span", null, "Unpacking the model …");
  const wait = h("div", { class: "unpacking", role: "status" }, bar, said);
  document.body.prepend(wait);
  const software = drawsInSoftware();
  const model = loadModel(software, (done, next) => { bar.value = done; said.textContent = next; });
  const machine = matchMedia(telephone).matches ? null : readyToDraw(software);
  try {
    await unpack(["deck-moved", "deck-repair", "deck-changes", "deck-earlier", "deck-cycle", "deck-crossed", "deck-ties"]);
  } catch {
    // Fallback: the page reads the blocks itself.
  }
  const ready = await model;
  await new Promise((painted) => setTimeout(painted));
  wait.remove();
  build(ready, software, machine);
}

const telephone = "(max-width: 600px)";
const oneColumn = "(max-width: 1100px)";

interface Page {
  report: Report;
  viewport: Viewport;
  look: Look;
  doc: CycleDocument | null; // of deck cycle
  parts: PartsDocument | null; // of deck parts
  stem: string; // of names of files
  pictured: Promise<void>; // resolves after the first picture
}
/** Sections in order: id, name among the links above them, and their maker; null if the page lacks it. */
const sections: [string, string, (p: Page) => HTMLElement | null][] = [
  ["verdict", "", (p) => verdict(p.report, p.doc, p.parts)],
  ["changes", "Changed", (p) => changesSection(p.report)],
  ["moved", "Moved", (p) => movedSection(p.report, (node) => p.viewport.openNode(node), (on) => p.viewport.showBefore(on), (part) => p.viewport.showPart(part))],
  ["repair", "Not treated", (p) => repairSection(p.report, (node) => p.viewport.showNode(node))],
  ["parts", "Parts", (p) => p.parts && partsSection(p.report, p.parts, (part) => p.viewport.showPart(part))],
  ["nearest", "Nearest", (p) => nearestSection(p.report, (row) => p.viewport.openNear(row), p.pictured)],
  ["interfaces", "Interfaces", (p) => interfaces(p.report)],
  ["pairs", "Part pairs", (p) => pairsSection(p.report, p.look)],
  ["touches", "Contacts", (p) => touchesSection(p.report, `${p.stem}_contacts.svg`, p.pictured)],
  ["distribution", "Distribution", (p) => distribution(p.report, p.look)],
  ["worst", "Worst first", () => null], // made before the others, which export it
  ["ties", "Ties", (p) => tiesSection(p.report, (x) => p.viewport.openTie(x))],
  ["crossed", "Crossed", (p) => crossedSection(p.report, (row) => p.viewport.openCrossed(row))],
  ["cycle", "First cycle", (p) => cycleSection(p.report)],
  ["without", "With and without", (p) => p.doc && withoutSection(p.report, p.doc)],
  ["effects", "Effects", (p) => p.doc && effectsSection(p.report, p.doc)],
  ["notes", "About", (p) => notChecked(p.report)],
];
/** Sections that answer what the verb of the page was asked. */
const own: Record<string, string[]> = { gaps: [], cycle: ["cycle", "without", "effects"], parts: ["parts"], fix: ["moved", "repair"], diff: ["changes", "moved"] };

// Over 80 lines: header, picture, tables and keys refer to each other, and their order decides what is painted first.
function build(model: Model & { beside: boolean }, software: boolean, machine: WebGLRenderer | null): void {
  const times: Record<string, number> = { decoded: performance.now() - started };
  const meta = loadMeta();
  setUnits(meta.deck.units.working);
  const report = new Report(meta, model.mesh, model.contacts, loadEarlier(), loadCycle(), loadCrossed(), loadTies());
  times.evaluated = performance.now() - started;
  const doc = loadCycleDocument();
  const parts = loadPartsDocument(report);
  const look: Look = { map: "heat", dark: false, contour: report.steps ? "element" : doc && report.acted?.length ? "force" : "depth", bands: 0, low: null, high: null, log: false, maximum: false };
  const changeLook = (change: Partial<Look>) => {
    // Limits belong to one kind of values.
    const other = change.contour !== undefined && change.contour !== look.contour;
    Object.assign(look, other ? { low: null, high: null, log: false } : null, change);
    document.documentElement.dataset.theme = look.dark ? "dark" : "light";
    report.emit("look");
  };
  look.dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = look.dark ? "dark" : "light";

  const viewport = new Viewport(report, look, changeLook, model.shapes, software, machine);
  const fly = (x: Hit) => viewport.open(x);
  let state: ViewState | null = null;
  // Choosing a row flies there.
  report.on("selection", () => report.selected && fly(report.selected));

  const help = helpDialog((scheme) => viewport.setMouse(scheme));
  const undo = button("", "undo", () => state?.undo(), { "aria-label": "Undo (u)", title: "Undo (u)", class: "tool", disabled: true });
  const redo = button("", "redo", () => state?.redo(), { "aria-label": "Redo (U)", title: "Redo (U)", class: "tool", disabled: true });
  const link = button("", "link", async () => {
    link.classList.toggle("done", await copyText(location.href));
    setTimeout(() => link.classList.remove("done"), 1200);
  }, { "aria-label": "Copy a link to this view", title: "Copy a link to this view", class: "tool" });
  const units = meta.deck.units.working;
  const header = h("header", { class: "top" },
    h("div", { class: "brand" }, h("span", { class: "mark", "aria-hidden": "true" }), h("b", null, `deck ${meta.page}`)),
    h("div", { class: "deck-name", title: meta.deck.path }, h("h1", null, fileName(meta.deck.path)), meta.deck.title ? h("span", { class: "muted ellipsis" }, meta.deck.title) : null),
    h("div", { class: "facts" },
      h("span", null, `version ${meta.deck.version}`),
      units ? h("span", null, `${units.mass} · ${units.length} · ${units.time}`) : null,
      h("span", null, `${group(meta.deck.counts.nodes ?? 0)} nodes`)),
    findBox(report, viewport),
    h("div", { class: "buttons" }, undo, redo, link,
      button("", "sun", () => changeLook({ dark: !look.dark }), { "aria-label": "Dark or light (t)", title: "Dark or light (t)", class: "tool" }),
      button("", "print", () => window.print(), { "aria-label": "Print", title: "Print", class: "tool" }),
      button("", "help", () => help.showModal(), { "aria-label": "Keys (?)", title: "Keys (?)", class: "tool" })));
  const left = h("div", { class: "left", id: "tables", "data-page": meta.page });
  const divider = h("div", { class: "divider", role: "separator", "aria-orientation": "vertical", "aria-label": "Width of the tables", "aria-valuemin": 25, "aria-valuemax": 80, "aria-valuenow": 53, tabindex: 0 });
  const right = h("aside", { class: "right" }, viewport.element, detail(report, fly));
  const split = h("div", { class: "split" }, left, divider, right);
  const skip = (name: string, to: () => HTMLElement | null) => h("a", { href: "#", class: "skip", onclick: (e) => {
    e.preventDefault();
    to()?.focus();
  } }, name);
  const skips = h("div", { class: "skips" }, skip("To the tables", () => left.querySelector<HTMLElement>(".vt-body")), skip("To the picture", () => viewport.element.querySelector("canvas")));
  const app = h("div", { class: "app" }, skips, header, split, help);
  document.getElementById("static")?.remove();
  document.body.append(app);
  dragDivider(divider, split);
  viewport.onRest = () => state?.note();
  viewport.onMenu = (p, x, y) => openMenu(p.hit ? rowItems(report, p.hit) : viewport.itemsOf(p), x, y);

  let tell = (): void => {};
  const pictured = new Promise<void>((done) => (tell = done));
  /** Makes sections and keys and applies the address; true if the address sets something. */
  const tables = (): boolean => {
    const stem = fileName(meta.deck.path).replace(/\.rad$/i, "");
    const exports = exportMenu([
      { label: "Node ids, one per line", run: () => save(`${stem}_nodes.txt`, plainNodes(report.filtered)) },
      { label: "Node ids to the clipboard", run: () => void copyText(plainNodes(report.filtered)) },
      { label: "/GRNOD/NODE block", hint: "A node group for the deck, with an id that is free", run: () => save(`${stem}_grnod.inc`, grnodBlock(report.filtered, meta.free_group_id, "initial penetrations")) },
      { label: "Marked nodes (Tcl)", hint: "*createmark and *entitysetcreate, for HyperMesh", run: () => save(`${stem}_nodes.tcl`, tclMarks(report.filtered, "initial penetrations")) },
      { label: "List (CSV), the columns in sight", run: () => save(`${stem}_list.csv`, list.table.csv()) },
      { label: "Table (CSV), all columns", run: () => save(`${stem}_penetrations.csv`, csv(report, report.filtered)) },
      { label: "Changed cards", hint: "Cards of all interfaces with settings under test", run: () => save(`${stem}_cards.inc`, allChangedCards(report)) },
      { label: "Picture (PNG)", run: () => viewport.savePicture(false) },
      { label: "Picture (PNG), white ground", run: () => viewport.savePicture(true) },
      { label: "Picture to the clipboard", run: () => void viewport.copyPicture() },
    ]);
    const list = listSection(report, fly, exports, () => state?.note());
    const page: Page = { report, viewport, look, doc, parts, stem, pictured };
    const all = sections.map(([id, name, make]) => ({ id, name, element: id === "worst" ? list.element : make(page) }));
    const there = all.flatMap(({ element }) => element ?? []);
    const nav = h("nav", { "aria-label": "Sections" }, ...all.filter((s) => s.name).map((s) => h("a", { href: `#${s.id}`, hidden: s.element?.hidden ?? true }, s.name)));
    // The page of a verb begins with its answer, at every width.
    const first = there.filter((e) => ["verdict", ...own[meta.page]].includes(e.id));
    first[1]?.classList.add("own");
    left.append(nav, ...first, ...there.filter((e) => !first.includes(e)));
    // Links scroll to sections; the address stores the state of the page.
    nav.addEventListener("click", (e) => {
      const link = (e.target as Element).closest("a");
      if (!link) return;
      e.preventDefault();
      document.querySelector(link.hash)?.scrollIntoView();
    });
    state = new ViewState(report, viewport, look, changeLook, { list: list.table }, (back, forth) => {
      undo.disabled = !back;
      redo.disabled = !forth;
    });
    const linked = state.open();
    keys(report, viewport, list.table, help, look, changeLook, () => state!.undo(), () => state!.redo());
    printing(report, viewport);
    times.tables = performance.now() - started;
    return linked;
  };
  const picture = (offer: boolean) => {
    if (offer) viewport.offer();
    else viewport.start();
    times.picture = performance.now() - started;
    times.pictureSinceNavigation = performance.now();
  };
  const ready = () => {
    viewport.goOn();
    document.documentElement.dataset.ready = "true";
    setTimeout(tell);
  };
  (window as unknown as Record<string, unknown>).deckReport = { report, viewport, times, beside: model.beside, whatIf: (id: number, o: Overrides) => evaluateFor(report, id, o), csv: () => csv(report, report.hits), grnod: () => grnodBlock(report.filtered, meta.free_group_id, "initial penetrations") };

  if (!matchMedia(oneColumn).matches && !location.hash.includes("=")) {
    // Picture first; tables after it is painted.
    picture(false);
    onceShown(() => { tables(); ready(); });
    return;
  }
  // Tables are above the picture, or the address sets its view.
  const linked = tables();
  onceShown(() => { picture(matchMedia(telephone).matches && !linked); ready(); });
}

/** For scripts: rows of all contacts with other settings of one interface, named as in the JSON. */
function evaluateFor(report: Report, id: number, change: Overrides): unknown {
  const overrides = report.meta.interfaces.map((inter, i) => ({ ...report.overrides[i], ...(inter.id === id ? change : {}) }));
  const known = { overrides: report.overrides, results: report.results };
  return report.evaluator.evaluate(overrides, known).map((r, i) => {
    const c = report.meta.contacts[i];
    return {
      interface: report.meta.interfaces[c.interface].id,
      role: c.role,
      gapmin: r.setting.gapmin,
      gapmin_from: r.setting.gapminFrom,
      igap: r.setting.igap,
      max_gap: r.setting.maxGap,
      complete: r.beyond === 0,
      totals: r.totals,
      penetrations: r.rows.map((row) => ({
        secondary: report.secondaryNodes(row).map((n) => report.nodeId(n)),
        main: report.mainNodes(row).map((n) => report.nodeId(n)),
        depth: row.depth, gap: row.gap, distance: row.distance, normal: row.normal, on_surface: row.onSurface,
        action: row.action, gap0: row.gap0, p0: row.p0, moved_by: row.movedBy,
      })),
    };
  });
}

function dragDivider(divider: HTMLElement, split: HTMLElement): void {
  const set = (wanted: number) => {
    const percent = Math.min(Math.max(wanted, 0.25), 0.8) * 100;
    split.style.setProperty("--left", `${percent}%`);
    divider.setAttribute("aria-valuenow", percent.toFixed(0));
  };
  let share = 0.53;
  divider.addEventListener("pointerdown", (e) => {
    divider.setPointerCapture(e.pointerId);
    const move = (m: PointerEvent) => set((share = (m.clientX - split.getBoundingClientRect().left) / split.clientWidth));
    divider.addEventListener("pointermove", move);
    divider.addEventListener("pointerup", () => divider.removeEventListener("pointermove", move), { once: true });
  });
  divider.addEventListener("keydown", (e) => {
    if (e.key === "ArrowLeft") set((share -= 0.03));
    if (e.key === "ArrowRight") set((share += 0.03));
  });
}

/** Descriptions of the keys. */
const keyList: [string, string][] = [
  ["j  k", "next and previous row"],
  ["Enter", "fly to the chosen row"],
  ["Esc", "clear the selection, then the filters"],
  ["Space", "show or fold the contacts of a TYPE19"],
  ["/", "find a node, element, part or interface"],
  ["u  U", "undo and redo"],
  ["Ctrl  Shift", "with a click on part pairs: one more; all with its secondary part; both keys: all with its main part"],
  ["Menu", "copy ids and cards of the row; in the picture: hide or isolate the part"],
  ["f", "fit the visible parts"],
  ...switchHelp.slice(0, 4),
  ["s", "show everything again"],
  ["b", "parts beside those in sight, too"],
  ...switchHelp.slice(4),
  ["1 … 9", "colours: depth, depth ÷ gap, gap, gap ÷ side, parts, force, stiffness, time step of node, of element"],
  ["t", "dark or light"],
  ["wheel", "zoom"],
  ["← ↑ → ↓", "turn the picture when it has the focus"],
];

/** Stored if the browser allows it. */
const mouseKey = "deck-mouse";
function chooseMouse(set: (scheme: MouseScheme) => void): HTMLElement {
  const said = h("span", { class: "muted" });
  const names = Object.keys(mouseSchemes) as MouseScheme[];
  let kept: string | null = null;
  try {
    kept = localStorage.getItem(mouseKey);
  } catch {
    // A framed page may have no storage.
  }
  const choice = h("select", { id: "mouse-scheme", "aria-label": "Mouse", onchange: () => use(choice.value as MouseScheme) },
    ...names.map((n) => h("option", { value: n, selected: n === kept }, mouseSchemes[n].name)));
  const use = (scheme: MouseScheme) => {
    set(scheme);
    said.textContent = mouseSchemes[scheme].says;
    try {
      localStorage.setItem(mouseKey, scheme);
    } catch {
      // As above: the setting lasts for this page.
    }
  };
  use(choice.value as MouseScheme);
  return h("p", { class: "mouse" }, h("label", { for: "mouse-scheme" }, "Mouse like "), choice, said);
}

function helpDialog(mouse: (scheme: MouseScheme) => void): HTMLDialogElement {
  const dialog = h("dialog", { class: "help", "aria-label": "Keys" },
    h("div", { class: "panel-head" }, h("h3", null, "Keys"), button("", "close", () => dialog.close(), { "aria-label": "Close", class: "tool" })),
    chooseMouse(mouse),
    h("dl", null, ...keyList.flatMap(([k, t]) => [h("dt", null, ...k.split(/  | · /).map((x) => h("kbd", null, x))), h("dd", null, t)])));
  return dialog;
}

function keys(report: Report, viewport: Viewport, list: { move(by: number): void }, help: HTMLDialogElement, look: Look, changeLook: (l: Partial<Look>) => void, undo: () => void, redo: () => void): void {
  const contours: ContourKind[] = ["depth", "ratio", "gap", "edge", "none", ...(report.cycle?.nodes.length ? (["force", "stiffness", "step"] as const) : []), ...(report.steps ? (["element"] as const) : [])];
  const run: Record<string, () => void> = {
    j: () => list.move(1),
    k: () => list.move(-1),
    Enter: () => report.selected && viewport.open(report.selected),
    f: () => viewport.fit(),
    s: () => viewport.showAll(),
    t: () => changeLook({ dark: !look.dark }),
    "?": () => help.showModal(),
    "/": () => document.getElementById("find")?.focus(),
    u: undo,
    U: redo,
    Escape: () => { unselectRows(); if (!viewport.clear()) report.setFilter(noFilter); },
    b: () => viewport.neighbours(),
  };
  contours.forEach((c, i) => (run[String(i + 1)] = () => changeLook({ contour: c })));
  document.addEventListener("keydown", (e) => {
    const at = e.target as HTMLElement;
    const typing = at.matches("input:not([type=range]):not([type=checkbox]), select, textarea");
    if (e.ctrlKey || e.metaKey || e.altKey || help.open) return;
    if (typing) { if (e.key === "Escape") at.blur(); return; }
    if (at instanceof HTMLCanvasElement && e.key.startsWith("Arrow")) {
      const step = 24;
      viewport.view?.control.rotate(e.key === "ArrowLeft" ? -step : e.key === "ArrowRight" ? step : 0, e.key === "ArrowUp" ? -step : e.key === "ArrowDown" ? step : 0);
      e.preventDefault();
      return;
    }
    if (e.key === "Enter" && at.matches("button, summary, a, .vt-body")) return;
    const flip = switchOf[e.key];
    if (flip) viewport.toggle(flip);
    else if (run[e.key]) run[e.key]();
    else return;
    e.preventDefault();
  });
}

void start();
