// Data of the selected row, and the effect of every Inacti on its node.
import { amount, button, fileName, group, h, lengthText, num, percent, plural, replace } from "../dom";
import type { Hit, Report } from "../report";
import { stopsSolver, type Row } from "../rows";
import { outcomeOf } from "../what_if";
import { cornersOf, nodeOf, type Untied } from "../tied";
import { sideView } from "./sideview";
import { actionLong, inactiWords } from "../words";

export function detail(report: Report, fly: (hit: Hit) => void): HTMLElement {
  const element = h("section", { class: "detail", id: "detail", "aria-live": "polite" });
  const draw = () => {
    const x = report.selected;
    if (report.untied) return drawUntied(report, report.untied, element);
    if (!x) {
      replace(element, h("p", { class: "note" }, report.hits.length > 0
        ? "Choose a row of a list or a dot in the picture to see the pair, its distance and what the solver will do about it."
        : report.meta.ties.some((t) => t.lost > 0) ? "Choose a node under Ties to see why it is not tied."
        : report.tiesOnly ? `Every node is tied${report.leftOut}.` : `Nothing penetrates${report.leftOut}.`));
      element.classList.add("empty");
      return;
    }
    element.classList.remove("empty");
    const r = x.row;
    const edge = report.isEdge(r);
    const meta = report.meta.contacts[x.contact];
    const setting = report.results[x.contact].setting;
    const place = report.place(r);
    const item = (name: string, value: string | Node, title = "") => [h("dt", null, name), h("dd", { title }, value)];
    const p = report.point(r);
    const force = report.forceOf(r);
    replace(
      element,
      h("div", { class: "panel-head" },
        h("h3", null, `${meta.points ? "Point on" : edge ? "Edge" : "Node"} ${report.secondaryText(r)}`, h("span", { class: "muted" }, ` in ${meta.points ? "the segment at" : edge ? "edge" : "segment"} ${report.mainText(r)}`)),
        h("span", { class: "buttons" }, document.querySelector("#view canvas") && button("Fly there", "fit", () => fly(x), { class: "small", title: "Enter" }), button("", "close", () => report.select(null), { "aria-label": "Close", title: "Esc", class: "tool" }))),
      h("div", { class: "detail-grid" },
        h("dl", null,
          ...item("Depth", h("b", null, lengthText(report, x.depth, 6)), String(x.depth)),
          ...item("Pair gap", `${lengthText(report, r.gap, 6)} (${percent(x.ratio)} used)`, String(r.gap)),
          ...item("Distance left", num(r.distance, 6), String(r.distance)),
          ...item("Gap formed by", gapWords(report, x)),
          ...item("Normal", r.onSurface ? "none: exactly on the surface" : r.normal?.map((v) => v.toFixed(3)).join("  ") ?? "–"),
          ...item("Position", p?.map((v) => num(v, 6)).join("  ") ?? "–", p?.join(" "))),
        h("dl", null,
          ...item("Interface", `${report.interfaceName(meta.interface)} (${report.roleText(x.contact)})`),
          ...item("Element", `${report.elementText(r, "secondary")} · ${report.partText(x.secondaryPart)}`),
          ...item("Main element", `${report.elementText(r, "main")} · ${report.partText(x.mainPart)}`),
          ...item(edge ? "First node at" : "Node at", place ? `${fileName(place.file)}:${place.line}` : "–", place ? `${place.file}:${place.line}` : ""),
          ...item("Card at", `${fileName(report.meta.interfaces[meta.interface].card.file)}:${report.meta.interfaces[meta.interface].card.line}`),
          ...(force ? item("First cycle", `force ${num(force.force, 5)} · stiffness ${num(force.stiffness, 4)}`, "With the deck's settings") : []),
          ...(x.status ? item("Earlier", x.earlier === null ? "did not penetrate" : `${num(x.earlier, 6)} (${x.status})`) : []))),
      h("div", { class: "side-row" }, sideView(report, x),
        h("p", { class: "fate" }, h("b", null, stopsSolver(r.action) ? `The solver stops with error ${r.action.slice(6)}. ` : ""), fate(report, r),
          report.isRoundOff(r) && " Only the round-off of the solver's formula makes this pair a penetration: exactly, it is no nearer than its gap.")),
      edge || meta.type === 10 || meta.modern ? null : alternatives(report, x, setting.inacti, setting.fpenmax),
    );
  };
  report.on("selection", draw);
  draw();
  return element;
}

function drawUntied(report: Report, x: Untied, element: HTMLElement): void {
  const [position, distance, search, part, , why, file, line] = x.row;
  const tie = report.meta.ties[x.tie];
  const node = report.nodeId(nodeOf(report, x));
  const segment = cornersOf(report, x.tie, position).map((n) => report.nodeId(n)).join(" ");
  const item = (name: string, value: string) => [h("dt", null, name), h("dd", { title: value }, value)];
  element.classList.remove("empty");
  replace(element,
    h("div", { class: "panel-head" },
      h("h3", null, `Node ${node}`, h("span", { class: "muted" }, segment ? ` and segment ${segment}` : " finds no segment")),
      h("span", { class: "buttons" }, button("", "close", () => report.select(null), { "aria-label": "Close", title: "Esc", class: "tool" }))),
    h("p", { class: "fate" }, why),
    h("div", { class: "detail-grid" },
      h("dl", null, ...item("Distance", amount(distance, 6)), ...item("Search distance", amount(search, 6))),
      h("dl", null, ...item("Tie", `${report.interfaceName(tie.interface)} (TYPE${report.meta.interfaces[tie.interface].type})`), ...item("Part", report.partText(part)),
        ...item("Node at", file < 0 ? "–" : `${fileName(report.meta.files[file])}:${line}`))));
}

function gapWords(report: Report, x: Hit): string {
  const s = report.results[x.contact].setting;
  const meta = report.meta.contacts[x.contact];
  if (meta.modern) {
    const data = report.data.contacts[x.contact];
    const [a, b] = [data.secondaryThickness[x.row.secondary], data.mainThickness[x.row.main]];
    return `${num(a)} of the ${meta.kind === "edge_edge" ? "edge" : "node"} and ${num(b)} of the other side${s.rule === 3 ? ", limited by the mesh size" : ""}`;
  }
  if (s.igap === 0) return `Gapmin (${s.gapminFrom})`;
  if (x.row.gap === s.gapmin) return `Gapmin ${num(s.gapmin)} (the thickness gives less)`;
  if (x.row.gap === s.gapmax) return `Gapmax ${num(s.gapmax)}`;
  return s.igap === 1 || s.scale === 1 ? "half thicknesses of both sides" : `half thicknesses × ${num(s.scale)}`;
}

function fate(report: Report, r: Row): string {
  const s = report.results[r.contact].setting;
  let text = actionLong[r.action];
  if (r.action === "node-stiffness-zero" && s.inacti !== 1) text = `Deeper than Fpenmax ${num(s.fpenmax)} × gap. ${text}`;
  if (r.action === "offset-stored") text += ` Stored: ${num(r.stored, 5)}.`;
  if (r.action === "gap-reduced" && r.gap0 !== null) text += ` Gap left ${num(r.gap0, 5)}, taken off ${num(r.p0!, 5)}.`;
  if (r.movedBy) {
    const d = Math.hypot(...r.movedBy);
    text += d > 0 ? ` Moved by ${num(d, 5)}.` : " An earlier pair has moved it far enough already.";
  }
  return text;
}

/** The pair under every Inacti. */
function alternatives(report: Report, x: Hit, current: number, fpenmax: number): HTMLElement {
  const r = x.row;
  const meta = report.meta.contacts[x.contact];
  const text = (inacti: number): string => {
    const then = outcomeOf(r, meta, inacti, fpenmax);
    const left = r.gap - then.stored;
    const words = report.actionText(then.action);
    if (stopsSolver(then.action)) return words;
    if (then.action === "node-stiffness-zero" && inacti !== 1) return `${words} (Fpenmax)`;
    switch (inacti) {
      case 1:
      case 2: return `${words} for the whole run`;
      case 3: return `moved by ${num(then.stored, 5)}`;
      case 5:
      case 6: return `gap ${num(r.gap)} → ${num(left, 5)}`;
      default: return "pushed out from the first cycle on";
    }
  };
  return h("div", { class: "alternatives", role: "list", "aria-label": "What each Inacti does to this node" },
    ...[0, 1, 2, 3, 5, 6].map((k) => h("div", { class: `alternative${k === current ? " on" : ""}`, role: "listitem" },
      h("b", null, `Inacti ${k === 0 ? "0" : k}`), h("span", { class: "muted" }, inactiWords[k]), h("span", null, text(k)))));
}

export function notChecked(report: Report): HTMLElement {
  const meta = report.meta;
  const fixed = meta.interfaces.filter((_, i) => report.evaluator.fixed(i) !== "").length;
  const items: (Node | string)[] = [
    "Gaps, distances and actions follow the Starter of the reference solver at cycle 0. Forces and time steps are those of deck cycle for the deck's settings; they are not evaluated again in the page.",
    report.crossed
      ? "Crossed elements are searched for exactly, among the edges and main segments of each node-to-segment contact."
      : "Crossed elements were not searched for: an edge through a face shows as a penetration only within the gap.",
    `Igap, Gapmin, Fscalegap and Gapmax can be tried in this page: it carries the distances of all pairs up to 1.5 times the largest gap of each interface (1.1 times where pairs are too many), and depth = gap − distance gives the numbers of the command line. Beyond that reach, and for all other fields, it writes the command${fixed > 0 ? `; for ${plural(fixed, "interface", "interfaces")} it carries only what penetrates` : ""}.`,
  ];
  if (meta.contacts.some((c) => c.modern)) items.push("In Who touches whom TYPE24 and TYPE25 count where they penetrate only.");
  if (meta.ties.length > 0) items.push("Ties (TYPE2, TYPE10) are formed as the Starter forms them. A line ends at the nearest point of the segment.");
  const odd = meta.contacts.filter((c) => c.repaired + c.degenerate + c.reoriented + c.no_carrier > 0);
  const counts = meta.deck.counts;
  return h("section", { id: "notes" },
    h("h2", null, "About this report"),
    meta.contacts.length > 0 && h("p", { class: "note" }, report.verified
      ? `Counted again in this page: counts and depths of all ${group(meta.contacts.length)} contacts are those of deck ${meta.tool.version}.`
      : h("b", { class: "bad" }, "Counting in this page gave other numbers than the program. Please report this.")),
    h("ul", null, ...items.map((t) => h("li", null, t))),
    odd.length ? h("table", { class: "plain" },
      h("thead", null, h("tr", null, ...["Interface", "Segments repaired", "Turned outward", "Degenerate", "Without element"].map((t) => h("th", null, t)))),
      h("tbody", null, ...odd.map((c) => h("tr", null, h("td", null, report.interfaceName(c.interface)), ...[c.repaired, c.reoriented, c.degenerate, c.no_carrier].map((n) => h("td", { class: "right" }, n)))))) : null,
    h("p", { class: "note" }, `${meta.deck.path} · ${group(counts.nodes ?? 0)} nodes, ${group(counts.shells ?? 0)} shells, ${group(counts.solids ?? 0)} solids, ${group(counts.parts ?? 0)} parts`,
      meta.deck.includes.length ? ` · ${meta.deck.includes.length} included files` : ""),
    meta.deck.includes.length ? h("details", null, h("summary", null, "Included files"), h("ul", null, ...meta.deck.includes.slice(0, 200).map((i) => h("li", null, i.path)))) : null);
}
