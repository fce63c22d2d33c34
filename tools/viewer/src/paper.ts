// Print on two pages: verdict, picture with legend, the ten worst of all and of the filter, interfaces.
import { deckCommand } from "./exports";
import { group, h, lengthText, num, percent, plainTable, plural, replace } from "./dom";
import type { Hit, Report } from "./report";
import type { Viewport } from "./scene/viewport";
import { headOf } from "./table/columns";

const mostTies = 10;
const most = 30; // interfaces on the second page

/** The active filter as text; "" without filter. */
export function filterText(report: Report): string {
  const f = report.filter;
  const between = (name: string, range: [number, number] | null) => range && `${name} from ${num(range[0])} to ${num(range[1])}`;
  return [
    f.interface !== null && `interface ${report.interfaceName(f.interface)}`,
    f.pairs && `parts ${report.pairsText}`,
    between("depth", f.depth), between("depth ÷ gap", f.ratio),
    f.roundOff && "only by the solver's round-off",
    f.status && `${f.status} against ${report.earlier?.path}`,
    f.text.trim() && `"${f.text.trim()}"`,
  ].filter((t) => t).join(", ");
}

function worst(report: Report, hits: Hit[]): HTMLElement {
  const id = (x: Hit) => report.meta.interfaces[report.meta.contacts[x.contact].interface].id;
  return plainTable([headOf("depth", "Depth"), headOf("gap", "Gap"), "Interface", "Node / edge", "Segment / edge", "Part", "Main part", "Action"],
    hits.slice(0, 10).map((x) => [lengthText(report, x.depth, 5), lengthText(report, x.row.gap), id(x), report.secondaryText(x.row), report.mainText(x.row), report.partShort(x.secondaryPart), report.partShort(x.mainPart), report.fateText(x.row)]), "plain worst");
}

/** Incomplete ties, and the number of complete ones. */
function ties(report: Report): HTMLElement[] {
  const all = report.meta.ties;
  if (all.length === 0) return [];
  const bad = all.filter((t) => t.lost > 0 || !t.evaluated);
  const name = (i: number) => report.meta.interfaces[i];
  const rest = all.length - Math.min(bad.length, mostTies);
  return [h("h2", null, "Ties"),
    ...(bad.length > 0 ? [plainTable(["Id", "Title", "Result", "What happens"], bad.slice(0, mostTies).map((t) => [name(t.interface).id, name(t.interface).title, t.text, t.losses]))] : []),
    ...(rest > 0 ? [h("p", { class: "note" }, bad.length > mostTies ? `… and ${plural(rest, "tie", "ties")}` : `${plural(rest, "tie holds", "ties hold")} all nodes`)] : [])];
}

export function printing(report: Report, viewport: Viewport): void {
  const paper = h("div", { class: "paper" });
  document.querySelector(".left")!.append(paper);
  let picture = ""; // last drawn picture: the view has no size in print
  window.addEventListener("beforeprint", () => {
    if (viewport.view && viewport.element.clientWidth > 0) picture = viewport.pictured(1.5, true, 2).toDataURL("image/png");
    const { meta } = report;
    const all = meta.interfaces
      .map((inter, i) => ({ inter, contacts: report.contactsOf(i), t: report.totals("now", i) }))
      .filter((x) => x.contacts.length > 0)
      .sort((a, b) => b.t.max_depth - a.t.max_depth);
    const filter = filterText(report);
    replace(paper,
      picture !== "" && h("img", { alt: "The picture", src: picture }),
      ...report.answers.flatMap(([title, table]) => [h("h2", null, title), table()]),
      h("h2", null, "Ten worst of all"),
      worst(report, report.worst()),
      filter !== "" && h("h2", { class: "selection" }, `Ten worst of the selection: ${filter}`),
      filter !== "" && worst(report, report.filtered),
      h("h2", { class: "second" }, "Interfaces"),
      plainTable(["Id", "Title", "Kind", headOf("gapmin", "Gapmin"), "Pairs", "Nodes", "Edges", headOf("depth", "Deepest"), "Of gap"],
        all.slice(0, most).map(({ inter, contacts, t }) => [inter.id, inter.title, `TYPE${inter.type}`, lengthText(report, report.results[contacts[0]].setting.gapmin), ...[t.pairs, t.nodes, t.edges].map((n) => (contacts.some((c) => meta.contacts[c].evaluated) ? group(n) : "–")), t.unbounded ? "unbounded" : t.pairs ? lengthText(report, t.max_depth) : "–", t.pairs && !t.unbounded ? percent(t.max_ratio) : "–"])),
      all.length > most && h("p", { class: "note" }, `… and ${group(all.length - most)} with shallower penetrations or none`),
      ...ties(report),
      h("p", { class: "paper-foot" },
        `deck ${meta.tool.version} · ${new Date().toISOString().slice(0, 10)} · ${deckCommand(report)} · ${plural(meta.files.length, "file", "files")}, ${plural(meta.bytes, "byte", "bytes")}`));
  });
}
