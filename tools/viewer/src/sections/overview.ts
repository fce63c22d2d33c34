// The table of interfaces and the settings under test.
import { cardText, changedCard, type FieldName } from "../card";
import { button, group, h, lengthText, num, percent, plural, replace, sectionHead } from "../dom";
import { copyText, deckCommand } from "../exports";
import type { Report } from "../report";
import { stopsSolver, type Action, type Totals } from "../rows";
import { commonStart, named } from "../table/columns";
import { VirtualTable } from "../table/table";
import { igapWords, inactiWords, modernIgapWords, modernInactiWords } from "../words";
import type { Result } from "../what_if";

/** An interface with all contacts, or one of several contacts. */
interface ContactRow {
  inter: number;
  contacts: number[];
  part: boolean;
}

const mostRows = 11;

/** Table of interfaces, contacts of a TYPE19 folded; choosing a row filters everything and opens its settings. Over 80 lines: shared row type. */
export function interfaces(report: Report): HTMLElement {
  const open = new Set<number>();
  const rowsNow = (): ContactRow[] =>
    report.meta.interfaces.flatMap((_, inter) => {
      const contacts = report.contactsOf(inter);
      if (contacts.length === 0) return [];
      const parts = contacts.length > 1 && open.has(inter) ? contacts.map((c) => ({ inter, contacts: [c], part: true })) : [];
      return [{ inter, contacts, part: false }, ...parts];
    });
  let rows = rowsNow();
  const inter = (r: ContactRow) => report.meta.interfaces[r.inter];
  const setting = (r: ContactRow, of: Result[]) => of[r.contacts[0]].setting;
  // A TYPE24 has no Igap; TYPE24 and TYPE25 have no smallest gap.
  const igap = (r: ContactRow, of: Result[]) => (inter(r).type === 24 ? "–" : String(setting(r, of).igap));
  const gapmin = (r: ContactRow) => !report.meta.contacts[r.contacts[0]].modern;
  // Nodes and edges count once per interface: totals of contacts do not add up.
  const totals = (r: ContactRow, which: "now" | "base" = "now"): Totals =>
    r.part ? (which === "now" ? report.results : report.base)[r.contacts[0]].totals : report.totals(which, r.inter);
  // Contacts stay below their interface in every sort order.
  const head = (r: ContactRow): ContactRow => (r.part ? { inter: r.inter, contacts: report.contactsOf(r.inter), part: false } : r);
  const changedCell = (text: string, was: string) =>
    text === was ? text : h("span", { class: "changed", title: `deck: ${was}` }, text);
  const deepest = (t: Totals) => (t.unbounded ? "unbounded" : t.pairs ? lengthText(report, t.max_depth, 4, true) : "–");
  const prefix = commonStart(report.meta.interfaces.map((i) => i.title));
  const unfold = (r: ContactRow) => {
    if (report.contactsOf(r.inter).length < 2) return;
    if (!open.delete(r.inter)) open.add(r.inter);
    draw();
  };
  const fold = (r: ContactRow) => {
    const on = open.has(r.inter);
    const b = button("", on ? "down" : "right", () => unfold(r), { tabindex: -1, class: "fold-parts", "data-interface": r.inter, "aria-expanded": on ? "true" : "false", "aria-label": `Contacts of interface ${inter(r).id}`, title: "Its contacts (space bar)" });
    b.addEventListener("click", (e) => e.stopPropagation());
    return b;
  };
  const step = (r: ContactRow): number | null => r.contacts.reduce<number | null>((least, c) => {
    const dt = report.cycle!.contacts[c]?.dt ?? null;
    return dt === null || (least !== null && least < dt) ? least : dt;
  }, null);
  // Without evaluation no figure is known.
  const known = (r: ContactRow, key = "pairs") => {
    const all = r.contacts.map((c) => report.meta.contacts[c]);
    const own = all.filter((c) => key === "pairs" || (key === "edges") === (c.kind === "edge_edge"));
    return (own.length > 0 ? own : all).some((c) => c.evaluated);
  };
  const clean = (r: ContactRow) => totals(r).pairs === 0 && (inter(r).level === "clean" || report.settingsDiffer(r.contacts[0]));
  const kind = (r: ContactRow) => (r.part ? report.roleText(r.contacts[0]) : `TYPE${inter(r).type}`);
  const count = (key: "pairs" | "nodes" | "edges", title: string, hint: string, rank?: number) => ({
    key, title, hint, kind: "number" as const, rank, value: (r: ContactRow) => totals(head(r))[key], text: (r: ContactRow) => (known(r, key) ? group(totals(r)[key]) : "–"),
    cell: (r: ContactRow) => (known(r, key) ? changedCell(group(totals(r)[key]), group(totals(r, "base")[key])) : "–"),
  });
  const table = new VirtualTable<ContactRow>(
    [
      { key: "id", title: "Id", kind: "id", value: (r) => inter(r).id, text: (r) => (r.part ? "" : String(inter(r).id)) },
      { key: "title", title: "Interface", kind: "text", least: 210, extra: 28, value: (r) => inter(r).title.toLowerCase(), text: (r) => (r.part ? report.meta.contacts[r.contacts[0]].role : inter(r).title || "(no title)"),
        cell: (r, room) => {
          if (r.part) return h("span", { class: "part-of" }, report.meta.contacts[r.contacts[0]].role);
          const title = inter(r).title ? named("", inter(r).title, prefix, r.contacts.length > 1 ? room - 28 : room) : h("span", null, "(no title)");
          return r.contacts.length > 1 ? h("span", { class: "named" }, fold(r), title) : title;
        } },
      { key: "kind", title: "Kind", kind: "text", rank: 6, value: (r) => kind(head(r)), text: kind },
      { key: "igap", title: "Igap", kind: "number", rank: 7, value: (r) => setting(head(r), report.results).igap, text: (r) => igap(r, report.results),
        cell: (r) => changedCell(igap(r, report.results), igap(r, report.base)) },
      { key: "gapmin", title: "Gapmin", hint: "Smallest pair gap, and where it comes from", kind: "number", rank: 5, value: (r) => setting(head(r), report.results).gapmin, text: (r) => (gapmin(r) ? `${lengthText(report, setting(r, report.results).gapmin)} *` : "–"),
        cell: (r) => {
          if (!gapmin(r)) return "–";
          const s = setting(r, report.results);
          const was = setting(r, report.base).gapmin;
          return h("span", { class: s.gapmin !== was ? "changed" : "", title: `${s.gapmin} (${s.gapminFrom})` },
            lengthText(report, s.gapmin), s.gapminFrom === "card" ? null : h("i", { class: "derived" }, " *"));
        } },
      count("pairs", "Pairs", "Penetrating pairs"),
      count("nodes", "Nodes", "Distinct secondary nodes", 3),
      count("edges", "Edges", "Distinct secondary edges", 4),
      { key: "depth", title: "Deepest", kind: "number", value: (r) => (totals(head(r)).unbounded ? Infinity : totals(head(r)).max_depth || (clean(head(r)) ? 0 : Number.MIN_VALUE)), text: (r) => deepest(totals(r)),
        cell: (r) => changedCell(deepest(totals(r)), deepest(totals(r, "base"))) },
      { key: "ratio", title: "Of gap", kind: "number", rank: 2, value: (r) => totals(head(r)).max_ratio, text: (r) => (totals(r).pairs && !totals(r).unbounded ? percent(totals(r).max_ratio) : "–") },
      ...(report.cycle ? [{ key: "step", title: "Step", hint: "Largest stable time step that the contact allows in the first cycle", kind: "number" as const, rank: 8, value: (r: ContactRow) => step(r) ?? Infinity, text: (r: ContactRow) => (step(r) === null ? "–" : num(step(r)!)) }] : []),
      { key: "action", title: "Action", hint: "What the solver does about it at start-up", kind: "text", rank: 1, least: 150, extra: 12, value: (r) => actionsText(report, head(r).contacts), text: (r) => actionsText(report, r.contacts),
        cell: (r) => {
          const text = actionsText(report, r.contacts);
          return totals(r).solver_errors > 0 ? h("span", { class: "bad", title: "A node lies exactly on a segment and the options do not avoid the error" }, text) : text;
        } },
    ],
    {
      label: "Interfaces", name: "interfaces", rows: [0, mostRows], sort: "depth", descending: true, toggle: unfold,
      select: (r) => report.setFilter({ interface: r && report.filter.interface !== r.inter ? r.inter : null, pairs: null, depth: null, ratio: null }),
      chosen: (r) => !r.part && report.filter.interface === r.inter,
      classOf: (r) => `${clean(r) ? "quiet" : ""} ${report.filter.interface === r.inter ? "group" : ""}`,
      same: (a, b) => a.inter === b.inter && a.part === b.part && a.contacts[0] === b.contacts[0],
    },
  );
  const chosen = (reveal: boolean) => table.setSelected(rows.find((r) => r.inter === report.filter.interface) ?? null, reveal);
  const draw = () => {
    rows = rowsNow();
    table.setRows(rows, report.held);
    chosen(true);
    if (report.anyChanged === bar) return;
    // The bar of settings above appears or disappears: keep the slider under the pointer.
    bar = report.anyChanged;
    panel.closest(".left")?.scrollBy({ top: panel.getBoundingClientRect().top - top, behavior: "instant" });
  };
  let bar = report.anyChanged;
  let top = 0;
  const note = () => void (top = panel.getBoundingClientRect().top);
  const panel = whatIf(report);
  draw();
  report.on("results", draw);
  report.on("filter", () => chosen(false));
  // Table and settings fit into the window together, so that the chosen row stays visible.
  new ResizeObserver(() => {
    const frame = panel.closest(".left")!;
    const height = getComputedStyle(frame).display === "contents" ? window.innerHeight : frame.clientHeight;
    table.most = panel.hidden ? mostRows : Math.min(mostRows, Math.max(3, Math.floor((height - panel.offsetHeight - 190) / 30)));
    if (!panel.hidden) panel.scrollIntoView({ block: "nearest", behavior: "instant" });
    note();
    frame.addEventListener("scroll", note, { passive: true });
  }).observe(panel);
  return h(
    "section", { id: "interfaces", hidden: report.tiesOnly },
    sectionHead(h("h2", null, "Interfaces", h("span", { class: "muted count" }, plural(report.meta.interfaces.length - report.welds.length, "interface", "interfaces"))), table.chooser()),
    table.element,
    h("p", { class: "note" }, h("i", { class: "derived" }, "*"), " Gapmin derived from the mesh. Choose a row to filter everything below and to try other settings."),
    panel,
  );
}

/** Actions of the solver on the penetrations of some contacts. */
export function actionsText(report: Report, contacts: number[]): string {
  const { meta } = report;
  const out = contacts.filter((c) => !meta.contacts[c].evaluated);
  if (out.length === contacts.length && contacts.length === 1) return "not evaluated";
  const left = out.map((c) => `${meta.contacts[c].role === "primary" ? "nodes" : meta.contacts[c].role} not evaluated`).join(", ");
  const first = meta.contacts[contacts[0]];
  if (first.ties && report.results[contacts[0]].totals.solver_errors === 0) {
    const tie = meta.ties.find((t) => t.interface === first.interface)!;
    const lost = report.lost(tie);
    return lost > 0 ? `${group(lost)} of ${plural(tie.nodes, "node", "nodes")} not tied` : plural(report.results[contacts[0]].rows.length, "pair tied", "pairs tied");
  }
  const count = new Map<Action, number>();
  for (const c of contacts) for (const [action, n] of actionsOf(report.results[c])) count.set(action, (count.get(action) ?? 0) + n);
  const all = [...count.values()].reduce((sum, n) => sum + n, 0);
  const words = [...count].sort(([a], [b]) => Number(stopsSolver(b)) - Number(stopsSolver(a))).map(([a, n]) => (n === all ? report.actionText(a, n) : `${n} ${report.actionText(a, n)}`));
  return [words.join(", "), left].filter((t) => t).join("; ") || "–";
}
const counted = new WeakMap<Result, Map<Action, number>>();
function actionsOf(result: Result): Map<Action, number> {
  const known = counted.get(result);
  if (known) return known;
  const count = new Map<Action, number>();
  for (const r of result.rows) count.set(r.action, (count.get(r.action) ?? 0) + 1);
  counted.set(result, count);
  return count;
}

// ---- settings under test ----------------------------------------------------------------------

/** Fields that the page can try. */
function fieldsOf(report: Report, inter: number): FieldName[] {
  if (report.evaluator.fixed(inter) !== "") return [];
  const { type } = report.meta.interfaces[inter];
  if (type === 10) return ["Gapmin"];
  return type === 11 ? ["Igap", "Gapmin"] : ["Igap", "Gapmin", "Fscalegap", "Gapmax"];
}

/** Largest gap to try; 0 if there is no pair. */
function reachOf(report: Report, inter: number): number {
  const all = report.contactsOf(inter).map((i) => report.meta.contacts[i].reach).filter((r) => r > 0);
  return all.length > 0 ? Math.min(...all) : 0;
}

/** All settings under test in a line, with their buttons. */
export function settingsBar(report: Report): HTMLElement {
  const bar = h("div", { class: "tests", hidden: true });
  const command = button("Copy command", "copy", async () => flash(command, await copyText(deckCommand(report, "gaps"))), { class: "small", title: "deck gaps … --what-if …: the same settings evaluated on the command line" });
  const reset = button("Reset all", "reset", () => report.clearOverrides(null), { class: "small" });
  const draw = () => {
    bar.hidden = !report.anyChanged;
    if (bar.hidden) return;
    const items = report.overrides.flatMap((o, inter) => Object.entries(o).map(([field, v]) => ({ inter, field: field as FieldName, v })));
    replace(bar, h("b", null, plural(items.length, "setting under test", "settings under test"), ":"),
      ...items.map(({ inter, field, v }) => button(`${report.meta.interfaces[inter].id} ${field} ${num(deckValue(report, inter, field))} → ${num(v!)}`, null, () => report.setFilter({ interface: inter }), { class: "chip filter", title: "Show this interface" })),
      command, reset);
  };
  report.on("results", draw);
  draw();
  return bar;
}

/** Value of a field in the deck; Gapmin 0: from the mesh. */
function deckValue(report: Report, inter: number, field: FieldName): number {
  const { card } = report.meta.contacts[report.contactsOf(inter)[0]];
  return field === "Gapmax" && card.Gapmax >= 1e30 ? 0 : card[field];
}

function whatIf(report: Report): HTMLElement {
  const panel = h("div", { class: "panel whatif", id: "whatif", hidden: true });
  let shown: number | null = null;
  let update: (() => void) | null = null;
  const draw = () => {
    const i = report.filter.interface;
    panel.hidden = i === null;
    if (i === null) {
      shown = null;
      update = null;
      return;
    }
    if (i !== shown) update = build(report, i, panel);
    shown = i;
    update?.();
  };
  report.on("filter", draw);
  report.on("results", draw);
  return panel;
}

let cardOpen = false;

// Over 80 lines: the returned function fills these elements.
function build(report: Report, inter: number, panel: HTMLElement): () => void {
  const meta = report.meta.interfaces[inter];
  const contacts = report.contactsOf(inter);
  const controls: (() => void)[] = [];
  const grid = h("div", { class: "controls" });
  if (contacts.length === 0) {
    const tie = report.meta.ties.find((t) => t.interface === inter);
    replace(panel, h("p", { class: "note" }, tie ? `TYPE2 ${meta.id}: ${tie.text}. Its nodes are listed under Ties.` : "This interface has no contact that could be evaluated."));
    return () => {};
  }
  const fields = fieldsOf(report, inter);
  if (fields.length === 0) {
    replace(panel, h("div", { class: "panel-head" }, h("h3", null, h("span", { class: "muted" }, `Interface ${report.interfaceName(inter)}`))), ...asFound(report, inter));
    return () => {};
  }
  for (const field of fields) {
    const c = control(report, inter, field);
    grid.append(c.element);
    controls.push(c.update);
  }
  const outcome = h("p", { class: "outcome", "aria-live": "polite" });
  const reach = h("p", { class: "note warn" });
  const card = h("pre", { class: "card", tabindex: 0, "aria-label": "Card" });
  const notes = h("p", { class: "note" });
  const reset = button("Reset", "reset", () => report.clearOverrides(inter), { class: "small" });
  const copy = button("Copy card", "copy", async () => flash(copy, await copyText(cardText(changedCard(meta, report.overrides[inter])))), { class: "small" });
  const command = button("Copy command", "copy", async () => flash(command, await copyText(deckCommand(report, "gaps"))), {
    class: "small", title: "deck gaps … --what-if …: the same settings evaluated on the command line",
  });
  replace(
    panel,
    h("div", { class: "panel-head" }, h("h3", null, "What if? ", h("span", { class: "muted" }, `Interface ${report.interfaceName(inter)}`)), h("span", { class: "buttons" }, reset, button("", "close", () => report.setFilter({ interface: null }), { "aria-label": "Close the settings", title: "Close", class: "tool" }))),
    grid, outcome, reach,
    meta.type !== 10 && h("p", { class: "note" }, "Other fields, such as Inacti: ", h("code", null, tryCommand(report, inter))),
    h("details", { class: "card-fold", open: cardOpen, ontoggle: (e) => (cardOpen = (e.target as HTMLDetailsElement).open) },
      h("summary", null, "Card with these values"), h("div", { class: "buttons" }, command, copy), card, notes),
  );
  return () => {
    for (const c of controls) c();
    const now = report.totals("now", inter);
    const base = report.totals("base", inter);
    const part = (name: string, a: string, b: string) =>
      h("span", { class: "change" }, `${name} `, a === b ? h("b", null, b) : h("span", null, h("s", null, a), " → ", h("b", null, b)));
    replace(
      outcome,
      part("pairs", group(base.pairs), group(now.pairs)),
      part("nodes", group(base.nodes), group(now.nodes)),
      part("edges", group(base.edges), group(now.edges)),
      part("deepest", num(base.max_depth), num(now.max_depth)),
      part("of gap", percent(base.max_ratio), percent(now.max_ratio)),
      part("solver errors", group(base.solver_errors), group(now.solver_errors)),
    );
    outcome.dataset.pairs = String(now.pairs);
    const beyond = Math.max(...contacts.map((i) => report.results[i].beyond));
    outcome.hidden = beyond > 0;
    reach.hidden = beyond === 0;
    replace(reach, `With these values gaps reach ${num(beyond)}, and this page carries pairs up to ${num(reachOf(report, inter))}: lists and picture stay as they were written. The command that evaluates them: `, h("code", null, `${deckCommand(report, "gaps")} --html page.html`));
    const changed = changedCard(meta, report.overrides[inter]);
    replace(
      card,
      ...changed.lines.map((l, i) => {
        const changes = changed.changes.filter((c) => c.line === i).sort((a, b) => a.first - b.first);
        const line = h("span", { class: l.text.startsWith("#") ? "comment" : l.text.startsWith("/") ? "keyword" : "" });
        let at = 0;
        for (const c of changes) {
          line.append(l.text.slice(at, c.first - 1), h("mark", { title: `was ${c.was || "blank"}` }, l.text.slice(c.first - 1, c.last)));
          at = c.last;
        }
        line.append(l.text.slice(at) + "\n");
        return line;
      }),
    );
    notes.textContent = [`${meta.card.file}:${meta.card.line}`, ...changed.notes].join(" · ");
    reset.disabled = !report.changed(inter);
  };
}

/** Command that tries a field beyond the page. */
function tryCommand(report: Report, inter: number): string {
  const { id, type } = report.meta.interfaces[inter];
  return `${deckCommand(report, "gaps")} --what-if ${id}:${type === 25 ? "Igap=2,Inacti=-1" : type === 24 ? "Inacti=-1" : "Inacti=5"} --html page.html`;
}

/** Replaces the controls if the page tries nothing. */
function asFound(report: Report, inter: number): Node[] {
  const { type } = report.meta.interfaces[inter];
  const c = report.meta.contacts[report.contactsOf(inter)[0]];
  const [igap, inacti] = c.modern ? [modernIgapWords, modernInactiWords] : [igapWords, inactiWords];
  const words = [type !== 24 && `Igap ${c.igap} – ${igap[c.igap] ?? "unknown"}`, `Inacti ${c.inacti} – ${inacti[c.inacti] ?? "unknown"}`].filter(Boolean).join(", ");
  const missing = report.contactsOf(inter).filter((k) => !report.meta.contacts[k].complete);
  return [
    h("p", { class: "note" }, `TYPE${type}: ${words}. The page tries no other settings of it: ${report.evaluator.fixed(inter)}. The program does: `, h("code", null, tryCommand(report, inter))),
    ...(missing.length > 0 ? [h("p", { class: "note warn" }, `Of ${missing.length === 1 ? "a contact" : "several contacts"} of it the page holds only the deepest pairs.`)] : []),
  ];
}

function flash(b: HTMLButtonElement, ok: boolean): void {
  b.classList.add(ok ? "done" : "failed");
  setTimeout(() => b.classList.remove("done", "failed"), 1200);
}

function control(report: Report, inter: number, field: FieldName): { element: HTMLElement; update: () => void } {
  const id = `f-${field}`;
  const deck = deckValue(report, inter, field);
  const current = () => report.overrides[inter][field] ?? deck;
  const set = (v: number) => report.setOverride(inter, field, v === deck ? undefined : v);
  if (field === "Igap") {
    const options = report.meta.interfaces[inter].type === 11 ? [0, 1, 3] : [0, 1, 2, 3];
    for (const v of [deck, current()]) if (!options.includes(v)) options.push(v);
    const select = h("select", { id, onchange: () => set(Number(select.value)) },
      ...options.map((v) => h("option", { value: v }, `${v} – ${igapWords[v] ?? "unknown"}` + (v === deck ? " (deck)" : ""))));
    const element = h("div", { class: "control wide" }, h("label", { for: id }, field), select);
    return { element, update: () => { select.value = String(current()); element.classList.toggle("on", current() !== deck); } };
  }
  const contacts = report.contactsOf(inter);
  const gaps = contacts.map((i) => report.base[i].setting);
  const top = { Gapmin: Math.max(reachOf(report, inter), deck) || 1, Gapmax: niceTop(Math.max(...gaps.map((s) => s.maxGap)) * 1.5), Fscalegap: 1.5 * (deck || 1) }[field as "Gapmin" | "Gapmax" | "Fscalegap"];
  const meaning = { Gapmin: "from the mesh", Gapmax: "no limit", Fscalegap: "" }[field as "Gapmin" | "Gapmax" | "Fscalegap"];
  const step = top / 400;
  const slider = h("input", { type: "range", id, min: field === "Fscalegap" ? step : 0, max: top, step, oninput: () => set(tidy(Number(slider.value), step)), onpointerdown: () => report.hold() });
  const number = h("input", { type: "number", min: 0, step: "any", "aria-label": field, onchange: () => {
    const v = Number(number.value);
    if (number.value !== "" && Number.isFinite(v) && v >= 0) set(v);
  } });
  const note = h("span", { class: "control-note" });
  const element = h("div", { class: "control" }, h("label", { for: id }, field), slider, number, note);
  const update = () => {
    const v = current();
    if (document.activeElement !== slider) slider.value = String(Math.min(v, top));
    number.value = v === 0 && meaning ? "0" : String(v);
    element.classList.toggle("on", v !== deck);
    const s = report.results[contacts[0]].setting;
    const unused = (field === "Fscalegap" || field === "Gapmax") && s.igap < 2;
    element.classList.toggle("unused", unused);
    note.textContent = unused ? "no effect with this Igap"
      : v === 0 && field === "Gapmin" ? `${meaning}: ${num(s.gapmin)}`
      : v === 0 ? meaning
      : [field === "Gapmin" ? `0: ${meaning}` : "", v !== deck ? `deck: ${deck === 0 && meaning ? meaning : num(deck, 6)}` : ""].filter(Boolean).join(" · ");
  };
  return { element, update };
}

/** Rounds slider positions to short numbers. */
function tidy(v: number, step: number): number {
  const digits = Math.max(0, Math.ceil(-Math.log10(step)) + 1);
  return Number(v.toFixed(Math.min(digits, 12)));
}

function niceTop(v: number): number {
  if (!(v > 0) || !Number.isFinite(v)) return 1;
  const p = 10 ** Math.floor(Math.log10(v));
  return (Math.ceil((v / p) * 2) / 2) * p;
}
