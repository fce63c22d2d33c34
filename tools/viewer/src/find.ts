// Search box for nodes, elements, parts and interfaces of the whole mesh, by id and title.
import { kindNames } from "./data";
import { group, h, replace } from "./dom";
import type { Report } from "./report";
import type { Viewport } from "./scene/viewport";

interface Found {
  kind: string;
  text: string;
  run(): void;
}

const most = 12;

export function findBox(report: Report, viewport: Viewport): HTMLElement {
  const list = h("div", { class: "found", role: "listbox", id: "found", "aria-label": "What was found", hidden: true });
  const input = h("input", {
    type: "search", id: "find", placeholder: "Find an id or a name", autocomplete: "off",
    role: "combobox", "aria-label": "Find a node, element, part or interface", "aria-expanded": "false", "aria-controls": "found", "aria-autocomplete": "list",
  });
  let shown: Found[] = [];
  let at = 0;
  const close = () => {
    list.hidden = true;
    replace(list);
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
  };
  const draw = () => {
    const open = input.value.trim() !== "";
    list.hidden = !open;
    input.setAttribute("aria-expanded", open ? "true" : "false");
    if (shown.length > 0 && open) input.setAttribute("aria-activedescendant", `found-${at}`);
    else input.removeAttribute("aria-activedescendant");
    replace(list, ...shown.map((f, i) => h("div", { role: "option", id: `found-${i}`, class: "found-row", "aria-selected": i === at ? "true" : "false", onpointerdown: (e) => {
      e.preventDefault();
      choose(f);
    } }, h("span", { class: "muted" }, f.kind), h("span", null, f.text))));
  };
  const choose = (f: Found) => {
    close();
    input.value = "";
    f.run();
  };
  input.addEventListener("input", () => {
    shown = search(report, viewport, input.value.trim());
    at = 0;
    draw();
  });
  input.addEventListener("blur", close);
  input.addEventListener("keydown", (e) => {
    if (e.key === "ArrowDown" || e.key === "ArrowUp") {
      at = Math.min(Math.max(at + (e.key === "ArrowDown" ? 1 : -1), 0), shown.length - 1);
      draw();
    } else if (e.key === "Enter" && shown[at]) choose(shown[at]);
    else if (e.key === "Escape") {
      input.value = "";
      close();
    } else return;
    e.preventDefault();
  });
  return h("div", { class: "find" }, input, list);
}

function search(report: Report, viewport: Viewport, text: string): Found[] {
  if (text === "") return [];
  const out: Found[] = [];
  const { mesh, meta } = report;
  const id = /^\d+$/.test(text) ? Number(text) : null;
  const lower = text.toLowerCase();
  if (id !== null) {
    const node = mesh.nodeId.indexOf(id);
    if (node >= 0) out.push({ kind: "node", text, run: () => viewport.showNode(node) });
    for (const [p, part] of mesh.parts.entries()) {
      let item = 0;
      for (const g of part.groups) {
        const i = g.element.indexOf(id);
        if (i >= 0 && !out.some((f) => f.kind === kindNames[g.kind])) {
          const corners = Array.from(g.vertex.subarray(g.corners * i, g.corners * (i + 1)));
          const found = item + i;
          out.push({ kind: kindNames[g.kind], text: `${text} in part ${report.partText(part.part)}`, run: () => viewport.showElement(p, found, corners) });
        }
        item += g.count;
      }
    }
  }
  const matches = (entity: { id: number; title: string }) => String(entity.id).startsWith(text) || entity.title.toLowerCase().includes(lower);
  const exactFirst = (a: { id: number }, b: { id: number }) => Number(b.id === id) - Number(a.id === id);
  meta.interfaces.map((inter, i) => ({ ...inter, i })).filter(matches).sort(exactFirst).slice(0, most).forEach((inter) =>
    out.push({ kind: "interface", text: report.interfaceName(inter.i), run: () => report.setFilter({ interface: inter.i, pairs: null }) }));
  meta.parts.map((part, i) => ({ ...part, i })).filter(matches).sort(exactFirst).slice(0, most).forEach((part) =>
    out.push({ kind: "part", text: report.partText(part.i), run: () => viewport.showPart(part.i) }));
  const rows = report.hits.filter((x) => report.matches(x, lower)).length;
  if (rows > 0) out.push({ kind: "rows", text: `only penetrations with “${text}”: ${group(rows)}`, run: () => report.setFilter({ text }) });
  return out.length > 0 ? out : [{ kind: "nothing", text: `No node, element, part or interface “${text}”`, run: () => {} }];
}
