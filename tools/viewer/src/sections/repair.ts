// Result of a repair: refusals with reasons, next commands, and its patch to save.
import { loadRepair } from "../data";
import { button, fileName, h, lengthText, plural, sectionHead } from "../dom";
import { copyText, save } from "../exports";
import type { NotTreated, Repair } from "schema/page";
import type { Report } from "../report";
import { VirtualTable } from "../table/table";

/** `fly` goes to a page node. */
export function repairSection(report: Report, fly: (node: number) => void): HTMLElement | null {
  const repair = loadRepair();
  if (!repair) return null;
  const stem = fileName(report.meta.deck.path).replace(/\.rad$/i, "");
  const patch = repair.patch ? button("Save the patch", "save", () => save(`${stem}_${repair.strategy.replaceAll(",", "_")}.patch`, repair.patch), { class: "small", title: "git apply and patch take it" }) : null;
  const left = repair.not_treated;
  const section = h("section", { id: "repair" },
    sectionHead(h("h2", null, "Not treated", h("span", { class: "muted count" }, plural(left.length, "pair", "pairs"))), patch));
  if (left.length === 0) section.append(h("p", { class: "note" }, repair.crossings.after > 0 ? "Every penetration that was looked at was treated; crossed elements stay." : "Everything was treated."));
  else section.append(refusals(report, repair, fly));
  if (repair.next.length > 0)
    section.append(h("h3", null, "Next"), h("dl", { class: "next" }, ...repair.next.flatMap((n) => {
      const copy = button("", "copy", async () => copy.classList.toggle("done", await copyText(n.command)), { "aria-label": `Copy: ${n.command}`, title: "Copy", class: "tool" });
      return [h("dt", null, n.does), h("dd", null, h("code", null, n.command), copy)];
    })));
  return section;
}

function refusals(report: Report, repair: Repair, fly: (node: number) => void): HTMLElement {
  const interfaceName = (r: NotTreated) => String(r.interface);
  const nodes = (r: NotTreated) => r.nodes.join("–") || "–";
  const table = new VirtualTable<NotTreated>(
    [
      { key: "inter", title: "Int.", hint: "Interface id", kind: "id", rank: 0, value: (r) => r.interface, text: interfaceName },
      { key: "nodes", title: "Node / edge", kind: "id", value: (r) => r.nodes[0] ?? 0, text: nodes },
      { key: "depth", title: "Depth", kind: "number", value: (r) => r.depth, text: (r) => (r.depth > 0 ? lengthText(report, r.depth) : "–") },
      { key: "reason", title: "Because", kind: "text", least: 200, value: (r) => r.reason, text: (r) => r.reason },
    ],
    { label: "Not treated", name: "refused", rows: [0, 8], sort: "depth", descending: true, select: (r) => {
      const at = r?.nodes.length ? report.mesh.nodeId.indexOf(r.nodes[0]) : -1;
      if (at >= 0) fly(at);
    } },
  );
  table.setRows(repair.not_treated);
  return h("div", null,
    h("ul", { class: "reasons" }, ...repair.groups.map((g) => h("li", null, `${g.text}: `, h("code", null, g.command)))), table.element);
}
