// Context menu (right mouse button or menu key): actions on a part; ids and cards to copy.
import { button, h, replace } from "./dom";
import { copyText, grnodBlock, nodeIds, setBlock } from "./exports";
import type { Hit, Report } from "./report";

export interface MenuItem {
  label: string;
  text?: string; // for the clipboard
  run?: () => void; // further action
}

const menu = h("div", { class: "menu-list context", role: "menu", "aria-label": "Part, node and row", hidden: true });
let before: Element | null = null;

function close(): void {
  if (menu.hidden) return;
  menu.hidden = true;
  if (before instanceof HTMLElement) before.focus();
}

export function openMenu(items: MenuItem[], x: number, y: number): void {
  if (items.length === 0) return;
  if (!menu.isConnected) {
    document.body.append(menu);
    document.addEventListener("pointerdown", (e) => !menu.contains(e.target as Node) && close());
    menu.addEventListener("keydown", (e) => {
      const all = [...menu.children] as HTMLElement[];
      const at = all.indexOf(document.activeElement as HTMLElement);
      if (e.key === "Escape") close();
      else if (e.key === "ArrowDown") all[(at + 1) % all.length].focus();
      else if (e.key === "ArrowUp") all[(at + all.length - 1) % all.length].focus();
      else return;
      e.preventDefault();
      e.stopPropagation();
    });
  }
  before = document.activeElement;
  replace(menu, ...items.map((i) => button(i.label, null, () => {
    close();
    if (i.text !== undefined) void copyText(i.text);
    i.run?.();
  }, { role: "menuitem" })));
  menu.hidden = false;
  menu.style.left = `${Math.min(x, window.innerWidth - menu.offsetWidth - 6)}px`;
  menu.style.top = `${Math.min(y, window.innerHeight - menu.offsetHeight - 6)}px`;
  (menu.firstElementChild as HTMLElement).focus({ preventScroll: true });
}

/** Items to copy of a row. */
export function rowItems(report: Report, x: Hit): MenuItem[] {
  const free = report.meta.free_group_id;
  const inter = report.meta.interfaces[report.meta.contacts[x.contact].interface].id;
  const nodes = [x.nodes[0], x.nodes[1]].filter((n) => n > 0);
  const title = `initial penetrations of interface ${inter}`;
  return [
    { label: `Copy ${nodes.length > 1 ? "edge" : "node"} ${nodes.join("–")}`, text: nodes.join(" ") },
    { label: `Copy the main side ${report.mainText(x.row)}`, text: report.mainNodes(x.row).map((n) => report.nodeId(n)).join(" ") },
    { label: `Copy interface ${inter}`, text: String(inter) },
    { label: "Copy /GRNOD/NODE of this row", text: grnodBlock([x], free, title) },
    { label: `Copy /GRNOD/NODE of the list (${nodeIds(report.filtered).length} nodes)`, text: grnodBlock(report.filtered, free, "initial penetrations") },
    ...(report.meta.deck.version >= 2021 ? [{ label: "Copy /SET/GENERAL of the list", text: setBlock(report.filtered, free, "initial penetrations") }] : []),
  ];
}
