// Around the 3D view: tool bar, legend, list of parts, axes, and what is known about the selection.
import { Vector3 } from "three";
import { colorAt, cssColor, mapNames, type MapName } from "./colormap";
import { contourOf, type Contour } from "./contour";
import { segmentOf } from "./crossed";
import { button, h, icon, num, replace, svg } from "../dom";
import { saveDataUrl } from "../exports";
import { contourNames, type ContourKind, type Look } from "../look";
import type { Part3D } from "./parts3d";
import type { Hit, Report } from "../report";
import { View3D } from "./view3d";

export class Viewport {
  readonly element = h("div", { class: "viewport", id: "view" });
  view: View3D | null = null;
  private readonly legend = h("div", { class: "legend" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly label = h("div", { class: "label", hidden: true });
  private readonly axes = svg("svg", { viewBox: "-30 -30 60 60", class: "axes", "aria-hidden": "true" });
  private readonly partList = h("div", { class: "part-list", hidden: true });
  private readonly clipPanel = h("div", { class: "clip-panel", hidden: true });
  private readonly hidden = new Set<Part3D>();
  private isolated: Set<Part3D> | null = null;
  private rest: "ghost" | "hidden" = "ghost";
  private follow = true;
  private arrows = true;
  private edges = true;
  private clip: { normal: Vector3 | null; at: number } = { normal: null, at: 0.5 };
  private contour: Contour | null = null;
  private readonly toggles = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly report: Report,
    private readonly look: Look,
    private readonly changeLook: (change: Partial<Look>) => void,
  ) {
    this.element.append(this.legend, this.tip, this.label, this.partList, this.clipPanel, this.axes);
  }

  /** A button in place of the picture: small screens show the list first. */
  offer(): void {
    const show = button("Show the picture", "camera", () => {
      show.remove();
      this.element.classList.remove("waiting");
      this.start();
    });
    this.element.classList.add("waiting");
    this.legend.hidden = true;
    this.axes.toggleAttribute("hidden", true);
    this.element.append(show);
  }

  /** Makes the 3D view; without WebGL a note takes its place. */
  start(): void {
    try {
      this.view = new View3D(this.report, this.element);
    } catch {
      this.element.classList.add("no-webgl");
      replace(this.element, h("p", { class: "note" }, "There is no WebGL here, so there is no picture. All tables and lists work."));
      return;
    }
    const view = this.view;
    this.axes.toggleAttribute("hidden", false);
    this.element.append(this.toolbar());
    this.buildParts();
    this.buildClip();
    view.onPick = (p) => {
      if (p.hit) this.report.select(p.hit);
      this.showTip(p.text);
      if (!p.hit && !p.text) this.report.select(null);
    };
    view.onFrame = () => {
      this.drawAxes();
      this.placeLabel();
    };
    this.report.on("filter", () => this.refresh());
    this.report.on("selection", () => this.selection());
    this.report.on("look", () => this.refresh());
    this.refresh();
  }

  // ---- tool bar -----------------------------------------------------------------------------

  private toolbar(): HTMLElement {
    const contour = h("select", { "aria-label": "Colours show", title: "What the colours show (keys 1 to 5)", onchange: () => this.changeLook({ contour: contour.value as ContourKind }) },
      ...Object.entries(contourNames).map(([k, name]) => h("option", { value: k }, name)));
    this.report.on("look", () => (contour.value = this.look.contour));
    contour.value = this.look.contour;
    const toggle = (key: string, name: string, iconName: string, on: boolean, run: () => void) => {
      const b = button("", iconName, run, { "aria-label": name, title: name, "aria-pressed": on ? "true" : "false", class: "tool" });
      this.toggles.set(key, b);
      return b;
    };
    const axis = (name: string, d: [number, number, number], up: [number, number, number]) =>
      button(name, null, () => this.view!.look(new Vector3(...d), new Vector3(...up)), { class: "tool text", title: `Look along ${name}` });
    return h("div", { class: "toolbar", role: "toolbar", "aria-label": "3D view" },
      contour,
      h("span", { class: "bar" },
        toggle("arrows", "Arrows: the way out (a)", "arrows", this.arrows, () => this.toggleArrows()),
        toggle("edges", "Element sides (w)", "mesh", this.edges, () => this.toggleEdges()),
        toggle("rest", "Rest see-through or hidden (h)", "ghost", true, () => this.toggleRest()),
        toggle("follow", "Isolate the chosen pair (i)", "isolate", this.follow, () => this.toggleFollow()),
        this.report.crossed?.total ? toggle("crossed", "Edges of crossed elements (c)", "cross", true, () => this.toggleCrossed()) : null,
        toggle("clip", "Clip plane (x)", "clip", false, () => this.toggleClip()),
        toggle("parts", "Parts (p)", "parts", false, () => this.toggleParts())),
      h("span", { class: "bar" },
        axis("X", [1, 0, 0], [0, 0, 1]), axis("Y", [0, -1, 0], [0, 0, 1]), axis("Z", [0, 0, 1], [0, 1, 0]),
        button("", "fit", () => this.fit(), { "aria-label": "Fit (f)", title: "Fit (f)", class: "tool" }),
        button("", "camera", () => this.savePicture(), { "aria-label": "Save a PNG", title: "Save a PNG", class: "tool" })));
  }

  private press(key: string, on: boolean): void {
    this.toggles.get(key)?.setAttribute("aria-pressed", on ? "true" : "false");
  }
  toggleArrows(): void {
    this.arrows = !this.arrows;
    this.press("arrows", this.arrows);
    this.view?.setArrows(this.arrows);
  }
  toggleEdges(): void {
    this.edges = !this.edges;
    this.press("edges", this.edges);
    this.view?.parts.setEdges(this.edges);
    this.view?.request();
  }
  toggleRest(): void {
    this.rest = this.rest === "ghost" ? "hidden" : "ghost";
    this.press("rest", this.rest === "ghost");
    this.applyLooks();
  }
  toggleFollow(): void {
    this.follow = !this.follow;
    this.press("follow", this.follow);
    this.isolate();
    this.applyLooks();
  }
  private crossedOn = true;
  toggleCrossed(): void {
    this.crossedOn = !this.crossedOn;
    this.press("crossed", this.crossedOn);
    this.drawCrossed();
  }
  private drawCrossed(): void {
    const parts = this.isolated && new Set([...this.isolated].map((p) => p.data.part));
    const own = (r: readonly number[]) => !parts || parts.has(this.report.data.contacts[r[0]].mainOwner.part[r[5]]);
    const rows = this.crossedOn ? (this.report.crossed?.rows ?? []).filter(own) : [];
    const x = this.report.nodePositions;
    const edges = new Float32Array(6 * rows.length);
    const outlines: number[] = [];
    rows.forEach((r, i) => {
      edges.set(x.subarray(3 * r[1], 3 * r[1] + 3), 6 * i);
      edges.set(x.subarray(3 * r[2], 3 * r[2] + 3), 6 * i + 3);
      const n = segmentOf(this.report, r);
      n.forEach((a, k) => {
        const b = n[(k + 1) % n.length];
        outlines.push(...x.subarray(3 * a, 3 * a + 3), ...x.subarray(3 * b, 3 * b + 3));
      });
    });
    this.view?.setCrossed(edges, Float32Array.from(outlines));
  }
  /** Flies to some points. */
  openPoints(points: number[][]): void {
    this.report.select(null);
    this.view?.flyToPoints(points.map((p) => new Vector3(...p)));
  }
  toggleParts(): void {
    this.partList.hidden = !this.partList.hidden;
    this.press("parts", !this.partList.hidden);
  }
  toggleClip(): void {
    if (!this.view) return;
    const on = this.clip.normal === null;
    this.clipPanel.hidden = !on;
    this.press("clip", on);
    this.setClip(on ? new Vector3(1, 0, 0) : null, 0.5);
  }
  /** Shows everything again. */
  showAll(): void {
    this.hidden.clear();
    this.isolated = null;
    this.applyLooks();
    this.buildParts();
  }
  fit(): void {
    this.view?.fit();
  }
  savePicture(): void {
    if (this.view) saveDataUrl("penetrations.png", this.view.picture(2));
  }

  // ---- parts --------------------------------------------------------------------------------

  private buildParts(): void {
    const view = this.view!;
    const filter = h("input", { type: "search", placeholder: "Find a part", "aria-label": "Find a part", oninput: () => fill() });
    const list = h("div", { class: "part-rows" });
    const fill = () => {
      const t = filter.value.toLowerCase();
      replace(list, ...view.parts.parts
        .filter((p) => this.report.partText(p.data.part).toLowerCase().includes(t))
        .map((p) => {
          const box = h("input", { type: "checkbox", checked: !this.hidden.has(p), onchange: () => {
            if (box.checked) this.hidden.delete(p);
            else this.hidden.add(p);
            this.applyLooks();
          } });
          return h("div", { class: "part-row" },
            h("label", null, box, h("span", { class: "swatch", style: `background:#${p.color.getHexString()}` }), h("span", { class: "ellipsis", title: this.report.partText(p.data.part) }, this.report.partText(p.data.part))),
            button("only", null, () => {
              this.isolated = new Set([p]);
              this.hidden.delete(p);
              this.applyLooks();
              view.fit();
            }, { class: "link" }));
        }));
    };
    replace(this.partList,
      h("div", { class: "panel-head" }, h("b", null, "Parts"), h("span", { class: "buttons" },
        button("all", null, () => this.showAll(), { class: "link" }),
        button("none", null, () => {
          for (const p of view.parts.parts) this.hidden.add(p);
          this.applyLooks();
          fill();
        }, { class: "link" }))),
      filter, list);
    fill();
  }

  /** Isolates the parts of the selected row, else of the chosen part pair. */
  private isolate(): void {
    const pair = this.report.selected
      ? [this.report.selected.secondaryPart, this.report.selected.mainPart]
      : this.report.filter.pair;
    const parts = (pair ?? []).map((p) => this.view?.partByIndex(p)).filter((p) => p !== undefined);
    this.isolated = this.follow && parts.length > 0 ? new Set(parts) : null;
  }

  private applyLooks(): void {
    this.view?.setLooks((p) => {
      if (this.hidden.has(p)) return "hidden";
      return this.isolated && !this.isolated.has(p) ? this.rest : "solid";
    });
    this.ground();
    if (this.contour && this.hitsShownFor !== null && this.hitsShownFor !== this.isolationKey()) this.showHits();
  }

  private ground(): void {
    this.view?.setGround(this.look.dark, this.look.contour !== "none");
  }

  // ---- clip plane ---------------------------------------------------------------------------

  private buildClip(): void {
    const slider = h("input", { type: "range", min: 0, max: 1, step: 0.001, value: 0.5, "aria-label": "Position of the clip plane", oninput: () => this.setClip(this.clip.normal, Number(slider.value)) });
    const along = (name: string, n: () => Vector3 | null) =>
      button(name, null, () => {
        const v = n();
        if (v) this.setClip(v, this.clip.at);
      }, { class: "tool text" });
    replace(this.clipPanel,
      along("X", () => new Vector3(1, 0, 0)), along("Y", () => new Vector3(0, 1, 0)), along("Z", () => new Vector3(0, 0, 1)),
      button("selection", null, () => {
        const x = this.report.selected;
        if (!x || !this.view) return;
        const n = new Vector3(...x.row.normal);
        const side = new Vector3().crossVectors(n, Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
        if (side.lengthSq() === 0) return;
        const at = this.view.clipThrough(new Vector3(...this.report.point(x.row)), side);
        slider.value = String(at);
        this.setClip(side, at);
      }, { class: "tool text", title: "Cut through the selected node, across the surface" }),
      slider,
      button("flip", null, () => {
        if (!this.clip.normal) return;
        slider.value = String(1 - this.clip.at);
        this.setClip(this.clip.normal.clone().negate(), 1 - this.clip.at);
      }, { class: "tool text" }));
  }

  private setClip(normal: Vector3 | null, at: number): void {
    this.clip = { normal, at };
    this.view?.setClip(normal, at);
  }

  // ---- what is shown ------------------------------------------------------------------------

  private color(t: number): [number, number, number] {
    const steps = this.look.bands;
    const u = steps > 0 ? (Math.min(steps - 1, Math.floor(t * steps)) + 0.5) / steps : t;
    return colorAt(this.look.map, u, this.look.flip);
  }

  private refresh(): void {
    const view = this.view;
    if (!view) return;
    this.contour = contourOf(this.report, this.look.contour, this.report.filtered);
    view.parts.setColors((t) => this.color(t));
    view.parts.setContour(this.contour.values);
    this.isolate();
    this.applyLooks();
    this.showHits();
    this.drawLegend();
    view.setSelected(this.report.selected);
  }

  private hitsShownFor: unknown = null;
  /** Dots and arrows of the rows in the list; of an isolated pair only its own. */
  private showHits(): void {
    const parts = this.isolated && new Set([...this.isolated].map((p) => p.data.part));
    const own = (x: Hit) => !parts || (parts.has(x.secondaryPart) && parts.has(x.mainPart));
    const hidden = new Set([...this.hidden].map((p) => p.data.part));
    this.view?.setHits(this.report.filtered.filter((x) => own(x) && !(hidden.has(x.secondaryPart) && hidden.has(x.mainPart))),
      (x) => this.color(this.contour!.of(x)));
    this.hitsShownFor = this.isolationKey();
    this.drawCrossed();
  }
  private isolationKey(): string {
    const list = (s: Iterable<Part3D> | null) => (s ? [...s].map((p) => p.index).join(",") : "-");
    return `${list(this.isolated)}/${list(this.hidden)}`;
  }

  private selection(): void {
    const x = this.report.selected;
    this.isolate();
    this.applyLooks();
    this.view?.setSelected(x);
    this.placeLabel();
  }

  /** Flies to a row. */
  open(hit: Hit): void {
    this.view?.flyTo(hit);
  }

  private drawLegend(): void {
    const c = this.contour;
    this.legend.hidden = !c || (!["gap", "edge"].includes(this.look.contour) && this.report.filtered.length === 0);
    if (!c) return;
    const stops = Array.from({ length: 33 }, (_, i) => {
      const [r, g, b] = this.color(Math.min(i / 32, 0.9999));
      return `rgb(${r} ${g} ${b}) ${(100 * i) / 32}%`;
    });
    const maps = h("select", { "aria-label": "Colour map", title: "Colour map", onchange: () => this.changeLook({ map: maps.value as MapName }) },
      ...mapNames.map((m) => h("option", { value: m, selected: m === this.look.map }, m)));
    const bands = h("input", { type: "checkbox", checked: this.look.bands > 0, onchange: () => this.changeLook({ bands: bands.checked ? 8 : 0 }) });
    const name = contourNames[this.look.contour === "none" ? "depth" : this.look.contour];
    const unit = this.report.meta.deck.units.working?.length;
    const lengthUnit = unit && ["none", "depth", "gap"].includes(this.look.contour) ? ` (${unit})` : "";
    replace(this.legend,
      h("div", { class: "legend-title" }, name + lengthUnit),
      h("div", { class: "legend-scale" }, h("div", { class: "legend-bar", style: `background:linear-gradient(to top, ${stops.join(",")})` }),
        h("div", { class: "legend-ticks" }, ...[1, 0.75, 0.5, 0.25, 0].map((t) => h("span", null, num(t * c.top, 3))))),
      h("div", { class: "legend-options" }, maps, h("label", { class: "check" }, bands, "steps")));
    this.legend.style.setProperty("--low", cssColor(this.look.map, 0, this.look.flip));
  }

  private drawAxes(): void {
    const q = this.view!.control.camera.quaternion.clone().invert();
    const items = ([["X", "#c0392b", 1, 0, 0], ["Y", "#2e8b57", 0, 1, 0], ["Z", "#2f6fde", 0, 0, 1]] as const).map(([name, color, x, y, z]) => {
      const v = new Vector3(x, y, z).applyQuaternion(q);
      return { z: v.z, e: [
        svg("line", { x1: 0, y1: 0, x2: 18 * v.x, y2: -18 * v.y, stroke: color, "stroke-width": 2, "stroke-linecap": "round" }),
        svg("text", { x: 25 * v.x, y: -25 * v.y + 3, fill: color }, name)] };
    });
    items.sort((a, b) => a.z - b.z);
    replace(this.axes, ...items.flatMap((i) => i.e));
  }

  private placeLabel(): void {
    const x = this.report.selected;
    const at = x && this.view?.screen(x);
    this.label.hidden = !at;
    if (!x || !at) return;
    const r = this.element.getBoundingClientRect();
    if (this.label.dataset.key !== x.key + x.depth) {
      this.label.dataset.key = x.key + x.depth;
      replace(this.label,
        h("b", null, `${this.report.isEdge(x.row) ? "edge" : "node"} ${this.report.secondaryText(x.row)}`),
        h("span", null, `depth ${num(x.depth, 5)} · gap ${num(x.row.gap)} · distance ${num(x.row.distance)}`));
    }
    const left = Math.min(Math.max(at.x - r.left + 28, 8), r.width - this.label.offsetWidth - 8);
    const top = Math.min(Math.max(at.y - r.top - 74, 52), r.height - this.label.offsetHeight - 8);
    this.label.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
  }

  private tipTimer = 0;
  private showTip(text: string): void {
    this.tip.hidden = !text;
    replace(this.tip, icon("node"), text);
    clearTimeout(this.tipTimer);
    this.tipTimer = window.setTimeout(() => (this.tip.hidden = true), 4000);
  }
}
