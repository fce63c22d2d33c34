// Runs inside the report's page: tells the editor what was chosen there, and chooses what the editor asks
// for. It uses what the page offers to scripts (window.deckReport); the page knows nothing of it.
import type { FromPage, Place, ToPage } from "./messages";

interface Hit {
  key: string;
  contact: number;
  row: unknown;
  nodes: [number, number];
}
interface Report {
  meta: { interfaces: { id: number; card: Place }[]; contacts: { interface: number }[] };
  hits: Hit[];
  selected: Hit | null;
  filter: { interface: number | null };
  on(topic: string, f: () => void): void;
  select(hit: Hit | null): void;
  setFilter(change: { interface?: number | null }): void;
  place(row: unknown): Place | null;
}
declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };

const editor = acquireVsCodeApi();
let asked = false; // what the editor asks for is not reported back to it

// Over 80 lines: what the editor asks for must not be reported back to it, which both directions share.
function start(report: Report): void {
  const cardOf = (hit: Hit) => report.meta.interfaces[report.meta.contacts[hit.contact].interface];
  const place = ({ file, line }: Place): Place => ({ file, line });
  const name = (hit: Hit) => `${hit.nodes[1] ? `edge ${hit.nodes.join("–")}` : `node ${hit.nodes[0]}`} of interface ${cardOf(hit).id}`;

  report.on("selection", () => {
    const hit = report.selected;
    if (!asked && hit) editor.postMessage({ type: "selected", key: hit.key, pair: name(hit), node: report.place(hit.row), card: place(cardOf(hit).card) });
  });
  let shown = report.filter.interface;
  report.on("filter", () => {
    const at = report.filter.interface;
    if (at === shown) return;
    shown = at;
    const inter = at === null ? null : report.meta.interfaces[at];
    if (!asked) editor.postMessage({ type: "interface", id: inter?.id ?? null, card: inter && place(inter.card) });
  });

  // The places in the panel of a pair are links here.
  const style = document.createElement("style");
  style.textContent = "#detail dd.place { cursor: pointer; text-decoration: underline; }";
  document.head.append(style);
  const target = (dd: Element): Place | null => {
    const hit = report.selected;
    const title = dd.previousElementSibling?.textContent;
    if (!hit || dd.tagName !== "DD") return null;
    return title === "Card at" ? place(cardOf(hit).card) : title === "Node at" || title === "First node at" ? report.place(hit.row) : null;
  };
  const mark = () => {
    for (const dd of document.querySelectorAll("#detail dd")) if (target(dd)) dd.classList.add("place");
  };
  new MutationObserver(mark).observe(document.body, { childList: true, subtree: true });
  mark();
  document.addEventListener("click", (e) => {
    const dd = (e.target as Element).closest?.("#detail dd");
    const to = dd && target(dd);
    if (to) editor.postMessage({ type: "open", place: to });
  });

  const chosen = () => ({ interface: report.filter.interface === null ? null : report.meta.interfaces[report.filter.interface].id, key: report.selected?.key ?? null });
  // The page is as dark as the editor, now and when that changes.
  const colours = () => {
    const dark = document.body.matches(".vscode-dark, .vscode-high-contrast:not(.vscode-high-contrast-light)");
    if (dark !== (document.documentElement.dataset.theme === "dark")) document.querySelector<HTMLElement>("[aria-label='Dark or light (t)']")?.click();
  };
  if (document.body.matches("[class*=vscode-]")) colours();
  new MutationObserver(colours).observe(document.body, { attributes: true, attributeFilter: ["class"] });

  const show = (m: Extract<ToPage, { type: "show" }>): string | null => {
    const at = report.meta.interfaces.findIndex((i) => i.card.file === m.file && i.card.line === m.header);
    if (at >= 0) {
      report.setFilter({ interface: at });
      const hit = report.hits.find((h) => report.meta.contacts[h.contact].interface === at) ?? null;
      report.select(hit);
      return `interface ${report.meta.interfaces[at].id}`;
    }
    const hit = report.hits.find((h) => {
      const p = report.place(h.row);
      return p !== null && p.line === m.line && p.file === m.file;
    });
    if (!hit) return null;
    const only = report.filter.interface;
    if (only !== null && report.meta.contacts[hit.contact].interface !== only) report.setFilter({ interface: null });
    report.select(hit);
    return name(hit);
  };
  window.addEventListener("message", (e: MessageEvent<ToPage>) => {
    const m = e.data;
    asked = true;
    try {
      if (m.type === "show") editor.postMessage({ type: "shown", what: show(m), chosen: chosen() });
      else if (m.type === "restore") {
        const at = report.meta.interfaces.findIndex((i) => i.id === m.interface);
        if (at >= 0) report.setFilter({ interface: at });
        const hit = report.hits.find((h) => h.key === m.key);
        if (hit) report.select(hit);
      }
    } finally {
      asked = false;
    }
  });
  editor.postMessage({ type: "ready" });
}

const wait = setInterval(() => {
  const page = (window as unknown as { deckReport?: { report: Report } }).deckReport;
  if (!page || document.documentElement.dataset.ready !== "true") return;
  clearInterval(wait);
  start(page.report);
}, 50);
