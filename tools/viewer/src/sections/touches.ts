// Parts that touch, with their interfaces; red with penetrations. The program makes the drawing (deck gaps --svg); the page
// updates it with settings under test.
import { button, h, num, plural, replace, sectionHead } from "../dom";
import { loadTouches } from "../data";
import { save } from "../exports";
import type { Report } from "../report";

/** `pictured`: resolves after the first picture. */
export function touchesSection(report: Report, name: string, pictured: Promise<void>): HTMLElement | null {
  if (report.meta.touches.length === 0) return null;
  const frame = h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Who touches whom" });
  const count = h("span", { class: "muted count" });
  let drawing: SVGElement | null = null;
  const saveIt = button("Save as SVG", "save", () => save(name, drawn().outerHTML), { class: "small" });
  const section = h("section", { id: "touches" }, sectionHead(h("h2", null, "Who touches whom", count), saveIt), frame,
    h("p", { class: "note" }, "Interfaces by number of the part pairs within 1.5 times the largest gap (1.1 where pairs are too many), or nearest where nothing penetrates and settings can be tried; red where they penetrate. Choose a cell to see the pair."));
  const pairOf = (cell: SVGElement): [number, number] => [Number(cell.dataset.s), Number(cell.dataset.m)];
  frame.addEventListener("click", (e) => {
    const cell = (e.target as Element).closest<SVGElement>(".touch");
    if (cell) report.setFilter({ pairs: [pairOf(cell)] });
  });

  const keyOf = (secondary: number, main: number) => (secondary + 1) * 2 ** 26 + main + 1;
  const update = () => {
    const deep = new Map<number, { pairs: number; depth: number }>(); // with settings under test
    for (const x of report.hits) {
      const key = keyOf(x.secondaryPart, x.mainPart);
      const t = deep.get(key);
      if (t) t.pairs++;
      else deep.set(key, { pairs: 1, depth: x.depth }); // deepest first
    }
    count.textContent = `${plural(report.meta.touches.length, "part pair", "part pairs")}, ${deep.size} penetrating`;
    for (const cell of drawing?.querySelectorAll<SVGElement>(".touch") ?? []) {
      const t = deep.get(keyOf(...pairOf(cell)));
      cell.querySelector("rect")!.setAttribute("class", t ? "deep" : "near");
      cell.querySelector("text")!.setAttribute("class", t ? "n" : "m");
      cell.querySelector("title")!.textContent = `${cell.dataset.near}${t ? `; ${plural(t.pairs, "penetration", "penetrations")}, deepest ${num(t.depth)}` : ""}`;
    }
  };
  const drawn = () => {
    if (!drawing) {
      drawing = document.importNode(new DOMParser().parseFromString(loadTouches() ?? "<svg/>", "image/svg+xml").documentElement as unknown as SVGElement, true);
      for (const cell of drawing.querySelectorAll<SVGElement>(".touch")) {
        const said = cell.querySelector("title")!.textContent ?? "";
        cell.dataset.near = cell.querySelector(".deep") ? said.slice(0, said.lastIndexOf("; ")) : said;
      }
      replace(frame, drawing);
      update();
    }
    return drawing;
  };
  report.on("results", update);
  update();
  // Made when scrolled into view: the first picture does not wait for it.
  new IntersectionObserver((seen, watch) => {
    if (!seen.some((s) => s.isIntersecting)) return;
    watch.disconnect();
    void pictured.then(drawn);
  }).observe(section);
  return section;
}
