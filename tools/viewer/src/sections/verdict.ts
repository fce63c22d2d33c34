// Verdict at the top: sentences and level of the program; with settings under test their figures.
import { group, h, lengthText, num, percent, plural, replace } from "../dom";
import type { Document as Cycle } from "schema/cycle";
import type { Verdict } from "schema/page";
import type { Document as Parts } from "schema/parts";
import { loadChanges, loadRepair } from "../data";
import type { Report } from "../report";
import { forceUnit } from "../scene/legend";
import { stepText } from "./nearest";
import { settingsBar } from "./overview";

/** Colour of a level: red if the solver would stop, green only if nothing was found. */
export function colourOf(verdict: Verdict): "error" | "warning" | "good" {
  if (verdict.level === "stops") return "error";
  // Tied pairs push without penetrating.
  if ((verdict.counts.pairs_with_force ?? 0) > 0) return "warning";
  return verdict.level === "clean" || verdict.level === "remarks" ? "good" : "warning";
}

/** The page of the first cycle shows these first. */
const physics = ["forces", "time_step", "acceleration", "removed"];

function partsAnswer(report: Report, { total, slowest_node: node, parts }: Parts): string {
  const unit = (name: "mass" | "time") => (report.meta.deck.units.working ? ` ${report.meta.deck.units.working[name]}` : "");
  const { min, element } = total.dt;
  const part = parts.find((p) => p.dt.min === min);
  const steps = [
    min !== null && element && `${element.kind} ${element.id}${part ? ` of part ${part.id}${part.title ? ` ${part.title}` : ""}` : ""} limits the time step to ${num(min)}${unit("time")}`,
    node?.dt && `${min === null ? "Node" : "with /DT/NODA node"} ${node.node} limits it to ${num(node.dt)}${unit("time")}`];
  const text = steps.filter(Boolean).join("; ") || "Nothing is known to limit the time step";
  return `${text.charAt(0).toUpperCase()}${text.slice(1)}.${total.mass === null ? "" : ` Mass of all elements: ${num(total.mass)}${unit("mass")}.`}`;
}

/** The answer of the verb, then what the program says of the deck. */
function sentencesOf(report: Report, doc: Cycle | null, parts: Parts | null): string[] {
  const all = report.meta.verdict.sentences;
  const texts = all.map((s) => s.text);
  if (parts) return [partsAnswer(report, parts), ...texts];
  const repair = loadRepair();
  if (repair) return [`${repair.text}.`, repair.starter, ...texts];
  const changes = loadChanges();
  if (changes) return [changes.text, ...texts];
  if (!doc) return texts;
  const rank = (what: string) => (physics.includes(what) ? physics.indexOf(what) : physics.length);
  const units = report.meta.deck.units.working;
  const sorted = [...all].sort((a, b) => rank(a.what) - rank(b.what)).map(({ what, text }) => {
    const unit = units && { forces: forceUnit(units), acceleration: `${units.length}/${units.time}²` }[what];
    return unit ? text.replace(/(force|acceleration) ([-\d.e+]*\d)/, `$1 $2 ${unit}`) : text;
  });
  return [sorted[0], stepText(report), ...sorted.slice(1).filter((t) => !t.startsWith("Contact limits the time step"))];
}

function itemsText(c: { nodes: number; edges: number }): string {
  const nodes = plural(c.nodes, "node", "nodes");
  const edges = plural(c.edges, "edge", "edges");
  return c.edges === 0 ? nodes : c.nodes === 0 ? edges : `${nodes} and ${edges}`;
}

export function verdict(report: Report, doc: Cycle | null, parts: Parts | null): HTMLElement {
  const { verdict: said, contacts } = report.meta;
  const [first, ...rest] = sentencesOf(report, doc, parts).filter((t) => t !== "");
  const test = h("span", { class: "tag test", hidden: true }, "numbers below: with settings under test");
  const tiles = h("div", { class: "tiles" });
  const compare = h("div", { class: "compare" });
  const marks = h("div", { class: "compare" });
  const element = h("section", { class: "verdict", id: "verdict", "aria-label": "Verdict", "data-level": colourOf(said), "data-verdict": said.level },
    h("p", { class: "verdict-text" }, h("strong", null, first ?? ""), ...rest.map((t) => ` ${t}`), test), settingsBar(report), tiles, compare, marks);
  const errors = said.counts.errors ?? 0;
  const { tie_errors: lost = 0, main_and_tied: main = 0 } = said.counts;
  const crossed = report.crossed?.total ?? said.counts.crossed_elements ?? null;
  const roundOff = report.meta.contacts.reduce((n, c) => n + c.round_off.length, 0);
  const draw = () => {
    const ties = report.meta.ties.reduce((sum, t) => ({ nodes: sum.nodes + t.nodes, lost: sum.lost + report.lost(t) }), { nodes: 0, lost: 0 });
    const now = report.totals("now", null);
    const base = report.totals("base", null);
    test.hidden = tiles.hidden = !report.anyChanged; // the banner shows the deck's figures
    const deepest = report.deepest;
    const beyond = report.unboundedRows;
    const tile = (name: string, value: string, note: string, old: string | null, to: string, bad = false) => {
      const changed = old !== null && report.anyChanged && old !== value;
      return h("button", { type: "button", class: "tile", "data-tile": name, "data-bad": bad, title: note, onclick: () => document.getElementById(to)?.scrollIntoView() },
        h("span", { class: "tile-name" }, name), h("b", { class: "tile-value" }, value), changed && h("span", { class: "tile-note" }, `deck: ${old}`));
    };
    const ratio = deepest || now.pairs === 0 ? (t: { pairs: number; max_ratio: number }) => (t.pairs ? percent(t.max_ratio) : "–") : () => "–";
    const stops = errors + now.solver_errors + lost + main;
    const acted = now.acted > 0 ? `${plural(now.acted, "pair is", "pairs are")} acted on` : "no pair is acted on";
    const contact = report.tiesOnly ? [] : [
      tile("Penetrations", group(now.pairs), `pairs in ${plural(contacts.length, "contact", "contacts")}`, group(base.pairs), "worst"),
      tile("Nodes", group(now.nodes), acted, group(base.nodes), "worst"),
      (now.edges > 0 || base.edges > 0) && tile("Edges", group(now.edges), acted, group(base.edges), "worst"),
      tile("Deepest", deepest ? num(deepest.depth) : beyond > 0 ? "unbounded" : "–",
        beyond > 0 ? `${plural(beyond, "pair has", "pairs have")} an unbounded gap` : deepest ? `of a gap of ${lengthText(report, deepest.row.gap)}` : "", deepest ? num(base.max_depth) : null, "worst"),
      tile("Depth ÷ gap", ratio(now), "at worst", ratio(base), "worst")];
    replace(tiles, ...contact,
      tile("Solver stops", group(stops), [errors > 0 && plural(errors, "error in the deck", "errors in the deck"), now.solver_errors > 0 && `${plural(now.solver_errors, "node", "nodes")} on a segment`,
        lost > 0 && `${plural(lost, "node", "nodes")} without a segment`, main > 0 && `${plural(main, "main node", "main nodes")} tied`,
        stops === 0 && (now.on_segment.pairs > 0 ? `${itemsText(now.on_segment)} on a segment` : "no reason known")].filter((t) => t).join(", "), group(errors + base.solver_errors + lost + main), "notes", stops > 0),
      ties.nodes > 0 && tile("Not tied", group(ties.lost), `of ${plural(ties.nodes, "node", "nodes")} of ${plural(report.meta.ties.length, "tie", "ties")}`, null, "ties", report.meta.ties.some((t) => t.stops)),
      crossed !== null && crossed > 0 && tile("Crossed", group(crossed), "elements pass through segments", null, "crossed"));
    chips();
  };
  const chips = () => {
    if (report.earlier) drawCompare(report, compare);
    if (roundOff > 0 || ties10(report) > 0) drawMarks(report, marks, roundOff);
  };
  report.on("results", draw);
  report.on("filter", chips);
  draw();
  return element;
}

/** Number of untied nodes. */
const ties10 = (report: Report): number => report.meta.ties.reduce((n, t) => n + report.lost(t), 0);

/** Remarks that are easily missed among the rows. */
function drawMarks(report: Report, element: HTMLElement, roundOff: number): void {
  const on = report.filter.roundOff;
  const lost = ties10(report);
  replace(element,
    lost > 0 && h("button", { type: "button", class: "chip", "data-chip": "Not tied", onclick: () => document.getElementById("ties")?.scrollIntoView() }, h("b", null, group(lost)), " not tied"),
    roundOff > 0 && h("button", {
      type: "button", class: `chip${on ? " on" : ""}`, "data-chip": "round-off", "aria-pressed": on ? "true" : "false",
      title: "Exactly, these pairs are no nearer than their gap", onclick: () => report.setFilter({ roundOff: !on, perNode: on }),
    }, h("b", null, group(roundOff)), " only by the solver's round-off"));
}

function drawCompare(report: Report, element: HTMLElement): void {
  const count = { new: 0, worse: 0, better: 0, same: 0 };
  for (const x of report.hits) if (x.status && x.status !== "solved") count[x.status]++;
  const chip = (status: "new" | "worse" | "better" | "same" | "solved", n: number) =>
    h("button", {
      type: "button", class: `chip ${status}${report.filter.status === status ? " on" : ""}`, disabled: n === 0,
      "aria-pressed": report.filter.status === status ? "true" : "false",
      onclick: () => report.setFilter({ status: report.filter.status === status ? null : status, perNode: true }),
    }, h("b", null, group(n)), ` ${status}`);
  replace(
    element,
    h("span", { class: "muted" }, report.meta.page === "fix" ? "Against the deck before the repair:" : report.meta.page === "diff" ? `Against ${report.earlier!.deck}:` : `Compared with ${report.earlier!.path}:`),
    chip("new", count.new), chip("worse", count.worse), chip("better", count.better), chip("same", count.same),
    chip("solved", report.solved.length),
  );
}
