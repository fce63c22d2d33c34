// Who touches whom: parts against parts, with the interfaces through which they come near each other; red where they
// penetrate. Drawn as SVG, so that it can be taken along.
import { button, h, num, plural, replace, sectionHead, svg } from "./dom";
import { save } from "./exports";
import type { Report } from "./report";

interface Touch {
  secondary: number;
  main: number;
  interfaces: Set<number>; // positions
  penetrating: number; // pairs
  depth: number;
}

const mostParts = 60;

/** Part pairs with a pair of a contact within the page's reach (found by the program), or a penetration at the settings under test. */
export function touches(report: Report): Touch[] {
  const found = new Map<string, Touch>();
  const at = (secondary: number, main: number): Touch => {
    const key = `${secondary},${main}`;
    let t = found.get(key);
    if (!t) found.set(key, (t = { secondary, main, interfaces: new Set(), penetrating: 0, depth: 0 }));
    return t;
  };
  for (const [secondary, main, ...interfaces] of report.meta.touches) for (const i of interfaces) at(secondary, main).interfaces.add(i);
  for (const x of report.hits) {
    const t = at(x.secondaryPart, x.mainPart);
    t.interfaces.add(report.meta.contacts[x.contact].interface);
    t.penetrating++;
    t.depth = Math.max(t.depth, x.depth);
  }
  return [...found.values()];
}

export function touchesSection(report: Report, name: string): HTMLElement {
  const drawing = h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Who touches whom" });
  const count = h("span", { class: "muted count" });
  const saveIt = button("Save as SVG", "save", () => save(name, drawing.querySelector("svg.tw")!.outerHTML), { class: "small" });
  const section = h("section", { id: "touches" }, sectionHead(h("h2", null, "Who touches whom", count), saveIt), drawing,
    h("p", { class: "note" }, "Interfaces by number of the part pairs that come near each other; red where they penetrate. Choose a cell to see the pair."));
  const draw = () => {
    const all = touches(report);
    section.hidden = all.length === 0;
    const near = plural(all.length, "part pair", "part pairs");
    count.textContent = `${near}, ${all.filter((t) => t.penetrating > 0).length} penetrating`;
    replace(drawing, matrix(report, all));
  };
  report.on("results", draw);
  // The first picture does not wait for it.
  requestIdleCallback(draw, { timeout: 2000 });
  return section;
}

function matrix(report: Report, all: Touch[]): SVGElement {
  // Deepest first, then those with the most neighbours.
  const order = (pick: (t: Touch) => number) => {
    const rank = new Map<number, [number, number]>();
    for (const t of all) {
      const [depth, n] = rank.get(pick(t)) ?? [0, 0];
      rank.set(pick(t), [Math.max(depth, t.depth), n + 1]);
    }
    return [...rank].sort((a, b) => b[1][0] - a[1][0] || b[1][1] - a[1][1] || a[0] - b[0]).slice(0, mostParts).map(([p]) => p);
  };
  const down = order((t) => t.secondary);
  const across = order((t) => t.main);
  const short = (p: number) => {
    const t = report.partShort(p);
    return t.length > 28 ? `${t.slice(0, 27)}…` : t;
  };
  const left = 14 + 8.6 * Math.max(...down.map((p) => short(p).length), 12);
  const top = 14 + 8.6 * Math.max(...across.map((p) => short(p).length), 6);
  const size = 24;
  const [w, hgt] = [left + size * across.length + 8, top + size * down.length + 8];
  const g: SVGElement[] = [svg("style", null, ".tw text{font:12px system-ui,sans-serif;fill:#5c6979} .tw .near{fill:#c9d6e6} .tw .deep{fill:#bd0026} .tw .none{fill:#8881} .tw .n{fill:#fff} .tw .m{fill:#17202b}")];
  across.forEach((p, i) => g.push(svg("text", { transform: `translate(${left + size * i + 16} ${top - 6}) rotate(-90)` }, short(p), svg("title", null, report.partText(p)))));
  const cell = new Map(all.map((t) => [`${t.secondary},${t.main}`, t]));
  down.forEach((s, j) => {
    g.push(svg("text", { x: left - 8, y: top + size * j + 16, "text-anchor": "end" }, short(s), svg("title", null, report.partText(s))));
    across.forEach((m, i) => {
      const t = cell.get(`${s},${m}`);
      const [x, y] = [left + size * i, top + size * j];
      const box = { x: x + 1, y: y + 1, width: size - 2, height: size - 2, rx: 3 };
      if (!t) return void g.push(svg("rect", { ...box, class: "none" }));
      const names = [...t.interfaces].map((k) => report.interfaceName(k)).join(", ");
      const said = `${report.partText(s)} and ${report.partText(m)}: ${names}${t.penetrating ? `; ${plural(t.penetrating, "penetration", "penetrations")}, deepest ${num(t.depth)}` : ""}`;
      g.push(svg("g", { class: "touch", onclick: () => report.setFilter({ pair: [s, m] }) },
        svg("title", null, said), svg("rect", { ...box, class: t.penetrating ? "deep" : "near" }),
        svg("text", { x: x + size / 2, y: y + 16, "text-anchor": "middle", class: t.penetrating ? "n" : "m" }, t.interfaces.size)));
    });
  });
  return svg("svg", { xmlns: "http://www.w3.org/2000/svg", class: "tw", viewBox: `0 0 ${w} ${hgt}`, width: w, height: hgt, role: "img", "aria-label": "Parts against parts" }, ...g);
}
