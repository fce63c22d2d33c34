// Helpers to build elements. Text enters the page only as text nodes and attributes, never as markup: no text of a deck can
// become code.

type Child = Node | string | number | null | undefined | false;
type Props = Record<string, string | number | boolean | null | undefined | EventListener>;

function fill(e: Element, props: Props | null, children: Child[]): void {
  for (const [k, v] of Object.entries(props ?? {})) {
    if (v === null || v === undefined || v === false) continue;
    if (typeof v === "function") e.addEventListener(k.replace(/^on/, ""), v);
    else e.setAttribute(k, v === true ? "" : String(v));
  }
  for (const c of children) if (c !== null && c !== undefined && c !== false) e.append(c instanceof Node ? c : String(c));
}

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props | null = null, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  fill(e, props, children);
  return e;
}

export function svg(tag: string, props: Props | null = null, ...children: Child[]): SVGElement {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(e, props, children);
  return e;
}

/** Line icons, 16 by 16. */
const icons: Record<string, string> = {
  fit: "M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4",
  arrows: "M8 14V3M4 7l4-4 4 4",
  clip: "M3 3h10v10H3zM3 13L13 3",
  mesh: "M2 2h12v12H2zM2 8h12M8 2v12",
  only: "M2 3h12l-4.500 5.500V13l-3-1.500V8.500z",
  isolate: "M8 5a3 3 0 100 6 3 3 0 000-6zM8 1v2M8 13v2M1 8h2M13 8h2",
  all: "M1.500 8S4 3.500 8 3.500 14.500 8 14.500 8 12 12.500 8 12.500 1.500 8 1.500 8zM8 6a2 2 0 100 4 2 2 0 000-4z",
  sun: "M8 5a3 3 0 100 6 3 3 0 000-6zM8 1v1.500M8 13.500V15M1 8h1.500M13.500 8H15M3 3l1 1M12 12l1 1M3 13l1-1M12 4l1-1",
  print: "M4 6V2h8v4M4 12H2V6h12v6h-2M4 10h8v4H4z",
  save: "M8 2v8M5 7l3 3 3-3M2 12v2h12v-2",
  help: "M6 6a2 2 0 113 1.700c-.7.4-1 .8-1 1.800M8 12v.5",
  parts: "M2 4h12M2 8h12M2 12h12",
  cross: "M2 12l12-8M2 4l5 3.500M9.500 9L14 12",
  tie: "M3 3h4v4H3zM9 9h4v4H9zM7 7l2 2",
  lock: "M4 7h8v7H4zM6 7V5a2 2 0 014 0v2",
  unlocked: "M4 7h8v7H4zM6 7V4a2 2 0 014-1",
  close: "M4 4l8 8M12 4l-8 8",
  parts3d: "M8 1.500l6 3v7l-6 3-6-3v-7zM2 4.500l6 3 6-3M8 7.500v7",
  ruler: "M1.500 11L11 1.500l3.500 3.500L5 14.500zM4 8.500l1.500 1.500M6.500 6l1.500 1.500M9 3.500L10.500 5",
  copy: "M5 5V2h9v9h-3M2 5h9v9H2z",
  reset: "M3 8a5 5 0 105-5H4M6.500.500L4 3l2.500 2.500",
  node: "M8 5.500a2.500 2.500 0 100 5 2.500 2.500 0 000-5z",
  undo: "M3 7a5.500 5.500 0 1110 4M3 3v4h4",
  redo: "M13 7a5.500 5.500 0 10-10 4M13 3v4h-4",
  link: "M7 9a2.500 2.500 0 003.500 0l2.500-2.500a2.500 2.500 0 00-3.500-3.500L8 4.500M9 7a2.500 2.500 0 00-3.500 0L3 9.500A2.500 2.500 0 006.500 13L8 11.500",
  up: "M4 10l4-4 4 4",
  down: "M4 6l4 4 4-4",
  right: "M6 4l4 4-4 4",
  parallel: "M2 5h8v8H2zM6 2h8v8M2 5l4-3M10 5l4-3M10 13l4-3M14 2v8",
  camera: "M2 5h3l1-2h4l1 2h3v8H2zM8 6.500a2.500 2.500 0 100 5 2.500 2.500 0 000-5z",
};

export function icon(name: string): SVGElement {
  return svg(
    "svg",
    { viewBox: "0 0 16 16", width: 16, height: 16, class: "icon", "aria-hidden": "true" },
    svg("path", { d: icons[name] ?? "", fill: "none", stroke: "currentColor", "stroke-width": 1.4, "stroke-linecap": "round", "stroke-linejoin": "round" }),
  );
}

export function button(label: string, iconName: string | null, onclick: () => void, props: Props = {}): HTMLButtonElement {
  const b = h("button", { type: "button", ...props, onclick: () => onclick() });
  if (iconName) b.append(icon(iconName));
  if (props["aria-label"] === undefined) b.append(h("span", null, label));
  return b;
}

export function replace(e: Element, ...children: Child[]): void {
  e.replaceChildren();
  fill(e, null, children);
}

/** Calls `then` after the present state is painted. */
export function onceShown(then: () => void): void {
  if (document.hidden) setTimeout(then);
  else requestAnimationFrame(() => setTimeout(then));
}

/** Title of a section with its buttons. */
export function sectionHead(title: Node, ...tools: Child[]): HTMLElement {
  return h("div", { class: "section-head" }, title, h("div", { class: "tools" }, ...tools));
}

/** A drop-down menu; a click elsewhere closes it. */
export function dropDown(props: Props, summary: HTMLElement, list: HTMLElement): HTMLDetailsElement {
  const menu = h("details", { class: "menu", ...props }, summary, list);
  document.addEventListener("click", (e) => { if (!menu.contains(e.target as Node)) menu.open = false; });
  return menu;
}

/** A small table of texts. */
export function plainTable(titles: string[], rows: (string | number)[][], name = "plain"): HTMLElement {
  return h("table", { class: name }, h("thead", null, h("tr", null, ...titles.map((t) => h("th", null, t)))),
    h("tbody", null, ...rows.map((r) => h("tr", null, ...r.map((t) => h("td", null, t))))));
}

/** Four significant digits; `zeros` keeps those at the end, for columns. Put the full value into a title. */
export function num(v: number, digits = 4, zeros = false): string {
  if (v === 0) return "0";
  if (!(Math.abs(v) < 1e30)) return "unbounded"; // the solver's "no limit"
  const a = Math.abs(v);
  if (a >= 1e6 || a < 1e-4) return v.toExponential(Math.max(0, digits - 2)).replace("e+", "e");
  const t = v.toPrecision(digits);
  return zeros && !t.includes("e") ? t : t.includes(".") && !t.includes("e") ? t.replace(/\.?0+$/, "") : String(Number(t));
}

export const amount = (v: number | null, digits = 4): string => (v === null ? "–" : num(v, digits));

/** A length; "unbounded" beyond the size of any model. */
export function lengthText(report: { unbounded(v: number): boolean }, v: number, digits = 4, zeros = false): string {
  return report.unbounded(v) ? "unbounded" : num(v, digits, zeros);
}

export function percent(ratio: number): string {
  const p = 100 * ratio;
  return `${p >= 99.95 || p === 0 ? p.toFixed(0) : p >= 10 ? p.toFixed(0) : p.toFixed(1)} %`;
}

export function group(n: number): string { return String(n).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f"); }

export function plural(n: number, one: string, many: string): string { return `${group(n)} ${n === 1 ? one : many}`; }

export function fileName(path: string): string { return path.slice(Math.max(path.lastIndexOf("/"), path.lastIndexOf("\\")) + 1); }

/** Shortest text that reads back to `v`, with point or exponent, as cards need it. */
export function shortest(v: number): string { const t = String(v); return /[.eE]/.test(t) ? t : `${t}.0`; }
