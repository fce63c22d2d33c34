// Around the 3D view: tool bar, legend, list of parts, axes, and what is known about the selection.
// Over 600 lines: every control of the view acts on the one state that it shares with the others.
import { Color, Vector3, type WebGLRenderer } from "three";
import { colorAt, cssColor, mapNames, type MapName } from "./colormap";
import { contourOf, type Contour } from "./contour";
import { segmentOf } from "../sections/crossed";
import { cornersOf, nodeOf, type Untied } from "../sections/untied";
import { tieLines } from "./tied";
import { button, fileName, h, icon, lengthText, num, plural, replace, svg } from "../dom";
import { saveDataUrl } from "../exports";
import { framed } from "./framed";
import { frameOf } from "../find";
import { contourNames, ofCycle, type ContourKind, type Look } from "../look";
import { loadElements, kindNames, type ElementOrigin } from "../data";
import type { Shape } from "../decode/shape";
import { elementKey, type Look as PartLook, type Part3D } from "./parts3d";
import type { Cut } from "./section";
import type { Hit, Report } from "../report";
import { machineFor } from "./ready";
import { View3D, type Arrow, type Picked } from "./view3d";

const mostArrowsAtFirst = 400;

export class Viewport {
  readonly element = h("div", { class: "viewport", id: "view" });
  view: View3D | null = null;
  onRest: () => void = () => {};
  onMenu: (p: Picked, x: number, y: number) => void = () => {};
  private readonly legend = h("div", { class: "legend" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly label = h("div", { class: "label", hidden: true });
  private readonly axes = svg("svg", { viewBox: "-30 -30 60 60", class: "axes", "aria-hidden": "true" });
  private readonly partList = h("div", { class: "part-list", hidden: true });
  private readonly clipPanel = h("div", { class: "clip-panel", hidden: true });
  private readonly hidden = new Set<Part3D>();
  private isolated: Set<Part3D> | null = null;
  private rest: "ghost" | "hidden" = "ghost";
  private allSolid = false;
  private readonly ruler = h("div", { class: "tip ruler", hidden: true, "aria-live": "polite" });
  private readonly segmentTag = h("div", { class: "label small", hidden: true });
  private measuring = false;
  private measured: number[] = []; // page nodes
  private origins: ((part: number, item: number) => ElementOrigin) | null = null;
  private follow = true;
  private arrows = true;
  private edges = true;
  private cuts: (Cut | null)[] = [null, null];
  private contour: Contour | null = null;
  private readonly toggles = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly report: Report,
    private readonly look: Look,
    private readonly changeLook: (change: Partial<Look>) => void,
    private readonly shapes: Shape[],
    private readonly software: boolean,
    private readonly machine: WebGLRenderer | null,
  ) {
    this.element.append(this.legend, this.tip, this.label, this.segmentTag, this.ruler, this.partList, this.clipPanel, this.axes);
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
      this.view = new View3D(this.report, this.shapes, this.software, this.machine ?? machineFor(this.software), this.element);
    } catch {
      this.element.classList.add("no-webgl");
      replace(this.element, h("p", { class: "note" }, "There is no WebGL here, so there is no picture. All tables and lists work."));
      return;
    }
    const view = this.view;
    this.tiesOn = this.report.meta.ties.some((t) => t.lost > 0);
    // So many arrows hide what they point at.
    this.arrows = this.report.filtered.length <= mostArrowsAtFirst || ofCycle(this.look.contour);
    view.setArrows(this.arrows);
    this.axes.toggleAttribute("hidden", false);
    this.element.append(this.toolbar());
    this.buildParts();
    this.buildClip();
    view.onPick = (p) => {
      if (this.measuring) return this.measure(p);
      if (p.hit) this.report.select(p.hit);
      else if (!p.part) this.report.select(null);
      this.showTip(p.part ? this.elementText(p.part, p.item, p.node) : "");
    };
    view.onFrame = () => {
      this.drawAxes();
      this.placeLabel();
    };
    let zoomed = "";
    this.report.on("filter", () => {
      this.refresh();
      // An interface or part pair that is chosen is zoomed to, once.
      const { interface: inter, pair } = this.report.filter;
      const key = `${inter}/${pair}`;
      if (key === zoomed || this.report.selected) return;
      const all = inter === null && pair === null;
      const tie = inter === null ? null : this.report.tieOf(inter);
      if (tie) view.fitPoints(tieLines(this.report, inter));
      else if (!all || zoomed) view.fit(all ? null : this.report.filtered);
      zoomed = all ? "" : key;
    });
    this.report.on("selection", () => this.selection());
    this.report.on("look", () => this.refresh());
    view.onRest = () => this.onRest();
    view.onMenu = (p, x, y) => this.onMenu(p, x, y);
    this.refresh();
    if (this.later) this.state = this.later;
    view.drawFirst();
  }

  /** The page is complete: after the first picture comes the one at rest. */
  goOn(): void {
    this.view?.afterFirst();
  }

  // ---- tool bar -----------------------------------------------------------------------------

  private toolbar(): HTMLElement {
    const contour = h("select", { "aria-label": "Colours show", title: "What the colours show (keys 1 to 5)", onchange: () => this.changeLook({ contour: contour.value as ContourKind }) },
      ...Object.entries(contourNames).filter(([k]) => !ofCycle(k as ContourKind) || this.report.cycle?.nodes.length).map(([k, name]) => h("option", { value: k }, name)));
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
        toggle("arrows", "Arrows: the way out, or nodal forces where colours show those (a)", "arrows", this.arrows, () => this.toggleArrows()),
        toggle("edges", "Element sides (w)", "mesh", this.edges, () => this.toggleEdges()),
        toggle("rest", "Only what penetrates (h)", "ghost", false, () => this.toggleRest()),
        toggle("solid", "All parts solid (o)", "parts3d", false, () => this.toggleSolid()),
        toggle("follow", "Isolate the chosen pair (i)", "isolate", this.follow, () => this.toggleFollow()),
        this.report.crossed?.total ? toggle("crossed", "Edges of crossed elements (c)", "cross", false, () => this.toggleCrossed()) : null,
        this.report.ties.length > 0 ? toggle("ties", "Ties: from node to segment, what is not tied marked (n)", "tie", this.tiesOn, () => this.toggleTies()) : null,
        toggle("clip", "Section planes (x)", "clip", false, () => this.toggleClip()),
        toggle("measure", "Measure between two nodes (m)", "ruler", false, () => this.toggleMeasure()),
        toggle("parts", "Parts (p)", "parts", false, () => this.toggleParts())),
      h("span", { class: "bar" },
        axis("X", [1, 0, 0], [0, 0, 1]), axis("Y", [0, -1, 0], [0, 0, 1]), axis("Z", [0, 0, 1], [0, 1, 0]),
        button("", "fit", () => this.fit(), { "aria-label": "Fit (f)", title: "Fit (f)", class: "tool" }),
        button("", "camera", () => this.savePicture(false), { "aria-label": "Save a PNG", title: "Save a PNG", class: "tool" })));
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
    this.press("rest", this.rest === "hidden");
    this.applyLooks();
  }
  toggleSolid(): void {
    this.allSolid = !this.allSolid;
    this.press("solid", this.allSolid);
    this.applyLooks();
  }
  toggleMeasure(): void {
    this.measuring = !this.measuring;
    this.measured = [];
    this.press("measure", this.measuring);
    this.view?.setRule([]);
    this.ruler.hidden = !this.measuring;
    replace(this.ruler, icon("ruler"), "Click a node, then another one.");
  }
  /** Takes the node under the cursor as one end of the distance. */
  private measure(p: Picked): void {
    if (p.node < 0) return;
    if (this.measured.length === 2) this.measured = [];
    this.measured.push(p.node);
    this.showMeasure();
  }
  private showMeasure(): void {
    const x = this.report.nodePositions;
    const points = this.measured.map((n) => new Vector3(x[3 * n], x[3 * n + 1], x[3 * n + 2]));
    this.view?.setRule(points);
    const ids = this.measured.map((n) => `node ${this.report.nodeId(n)}`);
    if (points.length < 2) return replace(this.ruler, icon("ruler"), `${ids[0]} – click another node`);
    const d = points[1].clone().sub(points[0]);
    const unit = this.report.meta.deck.units.working?.length ?? "";
    replace(this.ruler, icon("ruler"), h("b", null, `${num(d.length(), 6)} ${unit}`), ` ${ids.join(" – ")} · ${d.toArray().map((v) => num(v, 5)).join("  ")}`);
  }
  /** Id, part, property, thickness, and where the element is defined. */
  private elementText(part: Part3D, item: number, node: number): string {
    this.origins ??= loadElements(this.report.mesh);
    const o = this.origins(part.index, item);
    const meta = part.data.part < 0 ? null : this.report.meta.parts[part.data.part];
    const thickness = o.thickness || meta?.thickness || 0;
    const file = this.report.meta.files[o.file];
    return [
      `${kindNames[part.elementKind[item]]} ${part.element[item]}`,
      `part ${this.report.partText(part.data.part)}`,
      meta && `property ${meta.prop}${meta.prop_type ? ` ${meta.prop_type.replace("/PROP/", "")}` : ""}`,
      thickness > 0 && `thickness ${num(thickness)}`,
      node >= 0 && `node ${this.report.nodeId(node)}`,
      o.line > 0 && file && `${fileName(file)}:${o.line}`,
    ].filter(Boolean).join(" · ");
  }
  toggleFollow(): void {
    this.follow = !this.follow;
    this.press("follow", this.follow);
    this.isolate();
    this.applyLooks();
  }
  private crossedOn = false;
  crossedShown: readonly (readonly number[])[] = [];
  toggleCrossed(): void {
    this.crossedOn = !this.crossedOn;
    this.press("crossed", this.crossedOn);
    this.drawCrossed();
  }
  private drawCrossed(): void {
    const parts = this.isolated && new Set([...this.isolated].map((p) => p.data.part));
    const inter = this.report.filter.interface;
    const own = (r: readonly number[]) =>
      (inter === null || this.report.meta.contacts[r[0]].interface === inter) && (!parts || parts.has(this.report.data.contacts[r[0]].mainOwner.part[r[5]]));
    const rows = (this.crossedShown = this.crossedOn ? (this.report.crossed?.rows ?? []).filter(own) : []);
    if (rows.length === 0) return this.view?.crossed.set([]);
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
    this.view?.crossed.set([
      { ends: Float32Array.from(outlines), color: this.look.dark ? "#ffb454" : "#b45309", width: 1.5 },
      { ends: edges, color: this.look.dark ? "#ff6b81" : "#c1123f", width: 4 }]);
  }
  private tiesOn = false;
  private tiesShown = "";
  toggleTies(): void {
    this.tiesOn = !this.tiesOn;
    this.press("ties", this.tiesOn);
    this.drawTies();
  }
  /** Ties that are switched on; a tie that is chosen is shown in any case, and alone. */
  private drawTies(): void {
    const { interface: inter } = this.report.filter;
    const chosen = inter !== null && this.report.tieOf(inter) !== null;
    const on = chosen || (this.tiesOn && inter === null);
    const key = `${on}/${inter}/${this.look.dark}`;
    if (!this.view || key === this.tiesShown) return;
    this.tiesShown = key;
    if (!on) return this.view.ties.set([]);
    const { tied, lost, lostNodes } = tieLines(this.report, inter);
    const [own, bad] = this.look.dark ? ["#b79bff", "#ff5fc4"] : ["#6d3fd4", "#c2087f"];
    this.view.ties.set([{ ends: tied, color: own, width: 1.5 }, { ends: lost, color: bad, width: 3 }], { at: lostNodes, color: bad });
  }
  /** Flies to a node of a tie and its segment, and says why it is not tied. */
  openTie(x: Untied): void {
    if (!this.tiesOn) this.toggleTies();
    const p = this.report.nodePositions;
    const at = (n: number) => new Vector3(p[3 * n], p[3 * n + 1], p[3 * n + 2]);
    const node = nodeOf(this.report, x);
    this.report.select(null, x);
    this.view?.setRule([at(node)]);
    this.view?.flyToPoints([node, ...cornersOf(this.report, x.tie, x.row[0])].map(at));
  }
  /** Flies to some points. */
  openPoints(points: number[][]): void {
    this.report.select(null);
    if (!this.crossedOn) this.toggleCrossed();
    this.view?.flyToPoints(points.map((p) => new Vector3(...p)));
  }
  toggleParts(): void {
    this.partList.hidden = !this.partList.hidden;
    this.press("parts", !this.partList.hidden);
  }
  toggleClip(): void {
    if (!this.view) return;
    const on = this.clipPanel.hasAttribute("hidden");
    this.clipPanel.hidden = !on;
    this.press("clip", on);
    this.cuts = [on ? { normal: new Vector3(1, 0, 0), at: 0.5 } : null, null];
    this.buildClip();
    this.setClip();
  }
  /** Shows everything again. */
  showAll(): void {
    this.hidden.clear();
    this.isolated = null;
    this.allSolid = true;
    this.press("solid", true);
    this.applyLooks();
    this.buildParts();
  }
  fit(): void {
    this.view?.fit();
  }
  /** The picture with title, legend and axes; the view has to be there. */
  pictured(scale: number, white: boolean): HTMLCanvasElement {
    const { meta, filter } = this.report;
    const legend = this.legendText();
    const inter = filter.interface === null ? plural(meta.interfaces.length, "interface", "interfaces") : `interface ${this.report.interfaceName(filter.interface)}`;
    return this.view!.pictured(scale, white ? "#ffffff" : null, (canvas) =>
      framed(canvas, {
        title: fileName(meta.deck.path), about: `${inter} · ${contourNames[this.look.contour]}`, white: white || !this.look.dark,
        scale: canvas.width / this.view!.canvas.clientWidth, turned: this.view!.control.camera.quaternion,
        legend: legend && { ...legend, color: (t) => this.color(t) },
      }));
  }
  /** DECK_INTERFACE_depth.png: what it is of. */
  private pictureName(): string {
    const inter = this.report.filter.interface;
    const stem = fileName(this.report.meta.deck.path).replace(/\.rad$/i, "");
    return `${stem}_${inter === null ? "all" : this.report.meta.interfaces[inter].id}_${this.look.contour === "none" ? "parts" : this.look.contour}.png`;
  }
  savePicture(white: boolean): void {
    if (this.view) saveDataUrl(this.pictureName(), this.pictured(2, white).toDataURL("image/png"));
  }
  async copyPicture(): Promise<void> {
    if (!this.view) return;
    const canvas = this.pictured(2, false);
    const png = new Promise<Blob>((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error("no picture")))));
    try {
      await navigator.clipboard.write([new ClipboardItem({ "image/png": png })]);
      this.showTip("The picture is in the clipboard");
    } catch {
      this.showTip("This browser lets no page write pictures into the clipboard: save it instead");
    }
  }

  // ---- found and linked ---------------------------------------------------------------------

  /** Flies to a node and says what is known about it. */
  showNode(node: number): void {
    const x = this.report.nodePositions;
    const at = new Vector3(x[3 * node], x[3 * node + 1], x[3 * node + 2]);
    const hit = this.report.hits.find((h) => this.report.secondaryNodes(h.row).includes(node));
    if (hit) this.report.select(hit);
    else if (Number.isFinite(at.x)) this.mark(at, this.view ? this.view.control.radius * 0.02 : 1);
    this.showTip(`node ${this.report.nodeId(node)} · ${at.toArray().map((v) => num(v, 6)).join("  ")}${hit ? "" : " · penetrates nothing"}`);
  }
  /** Flies to an element of a part of the mesh. */
  showElement(part: number, item: number, vertices: number[]): void {
    const { center, radius } = frameOf(this.report.mesh.parts[part].position, vertices);
    this.mark(center, radius * 3);
    const p = this.view?.parts.parts[part];
    if (p) this.showTip(this.elementText(p, item, -1));
  }
  /** What can be copied of what is under the cursor. */
  itemsOf(p: Picked): { label: string; text: string }[] {
    if (!p.part) return [];
    const element = p.part.element[p.item];
    const id = this.report.partId(p.part.data.part);
    const items = [{ label: `Copy ${kindNames[p.part.elementKind[p.item]]} ${element}`, text: String(element) }, { label: `Copy part ${id}`, text: String(id) }];
    return p.node < 0 ? items : [...items, { label: `Copy node ${this.report.nodeId(p.node)}`, text: String(this.report.nodeId(p.node)) }];
  }
  /** Shows a part alone. */
  showPart(part: number): void {
    this.report.select(null);
    const p = this.view?.partByIndex(part);
    if (p) {
      this.isolated = new Set([p]);
      this.hidden.delete(p);
      this.applyLooks();
      this.view!.fit();
    }
    this.showTip(`part ${this.report.partText(part)}`);
  }
  private mark(at: Vector3, radius: number): void {
    this.report.select(null);
    this.view?.setRule([at]);
    this.view?.control.fly(at, radius);
  }

  /** What the address of the page keeps of the picture. */
  get state(): Record<string, string> {
    const out: Record<string, string> = {};
    if (this.allSolid) out.all = "solid";
    if (this.rest === "hidden") out.rest = "hidden";
    if (!this.follow) out.isolate = "no";
    if (this.crossedOn) out.crossed = "yes";
    if (this.tiesOn) out.ties = "yes";
    if (this.hidden.size > 0) out.hidden = [...this.hidden].map((p) => this.report.partId(p.data.part)).join(",");
    const cuts = this.cuts.map((c) => (c ? [...c.normal.toArray(), c.at].map((v) => Number(v.toPrecision(5))).join(",") : ""));
    if (cuts.some((c) => c)) out.section = cuts.join("/");
    if (this.measured.length === 2) out.ruler = this.measured.map((n) => this.report.nodeId(n)).join(",");
    if (this.view) out.camera = this.view.control.pose;
    return out;
  }
  set state(s: Record<string, string>) {
    this.allSolid = s.all === "solid";
    this.rest = s.rest === "hidden" ? "hidden" : "ghost";
    this.follow = s.isolate !== "no";
    this.crossedOn = s.crossed === "yes";
    this.tiesOn = s.ties === "yes";
    if (!this.view) {
      this.later = s;
      return;
    }
    for (const [key, on] of [["solid", this.allSolid], ["rest", this.rest === "hidden"], ["follow", this.follow], ["crossed", this.crossedOn], ["ties", this.tiesOn]] as const) this.press(key, on);
    const hidden = new Set((s.hidden ?? "").split(",").filter(Boolean).map(Number));
    this.hidden.clear();
    for (const p of this.view.parts.parts) if (hidden.has(this.report.partId(p.data.part))) this.hidden.add(p);
    this.cuts = [0, 1].map((i) => {
      const v = (s.section ?? "").split("/")[i]?.split(",").map(Number) ?? [];
      return v.length === 4 && v.every(Number.isFinite) ? { normal: new Vector3(v[0], v[1], v[2]), at: v[3] } : null;
    });
    const cut = this.cuts.some((c) => c !== null);
    this.clipPanel.hidden = !cut;
    this.press("clip", cut);
    this.buildClip();
    this.setClip();
    this.measured = (s.ruler ?? "").split(",").filter(Boolean).map((id) => this.report.mesh.nodeId.indexOf(Number(id))).filter((n) => n >= 0);
    this.measuring = this.measured.length === 2;
    this.press("measure", this.measuring);
    this.ruler.hidden = !this.measuring;
    if (this.measuring) this.showMeasure();
    else this.view.setRule([]);
    this.refresh();
    if (s.camera) this.view.control.pose = s.camera;
  }
  private later: Record<string, string> | null = null;

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

  /** Isolates the parts of the selected row, else of the chosen part pair, else those of the chosen interface. */
  private isolate(): void {
    const { selected, filter } = this.report;
    const pair = selected ? [selected.secondaryPart, selected.mainPart] : filter.pair;
    const sides = pair ? { secondary: new Set([pair[0]]), main: new Set([pair[1]]) } : filter.interface !== null ? this.report.sidesOf(filter.interface) : null;
    for (const p of this.view?.parts.parts ?? []) {
      const [a, b] = [sides?.secondary.has(p.data.part), sides?.main.has(p.data.part)];
      p.side = a === b ? "none" : a ? "secondary" : "main";
    }
    const parts = (this.view?.parts.parts ?? []).filter((p) => sides?.secondary.has(p.data.part) || sides?.main.has(p.data.part));
    this.isolated = this.follow && parts.length > 0 ? new Set(parts) : null;
  }

  /** Chosen pairs are solid; of everything else only what penetrates is. */
  private lookOf(p: Part3D): PartLook {
    if (this.hidden.has(p)) return "hidden";
    if (this.isolated && !this.isolated.has(p)) return this.rest;
    const chosen = this.isolated !== null && (this.report.selected !== null || this.report.filter.pair !== null || this.report.filter.interface === null);
    const tie = this.report.filter.interface !== null && this.report.tieOf(this.report.filter.interface) !== null;
    if (this.allSolid || chosen || (this.isolated && tie) || (this.report.filtered.length === 0 && !this.isolated)) return "solid";
    return this.rest === "ghost" ? "hot" : "only";
  }

  private applyLooks(): void {
    this.view?.setLooks((p) => this.lookOf(p));
    this.ground();
    if (this.contour && this.hitsShownFor !== null && this.hitsShownFor !== this.isolationKey()) this.showHits();
  }

  private ground(): void {
    this.view?.setGround(this.look.dark, this.look.contour !== "none");
  }

  // ---- section planes -----------------------------------------------------------------------

  private buildClip(): void {
    replace(this.clipPanel, ...this.cuts.map((cut, i) => {
      const name = i === 0 ? "First" : "Second";
      const box = h("input", { type: "checkbox", checked: cut !== null, "aria-label": `${name} section plane`, onchange: () => {
        this.cuts[i] = box.checked ? { normal: new Vector3(i === 0 ? 1 : 0, i, 0), at: 0.5 } : null;
        this.buildClip();
        this.setClip();
      } });
      if (!cut) return h("div", { class: "clip-row" }, h("label", { class: "check" }, box, `${name} plane`));
      const slider = h("input", { type: "range", min: 0, max: 1, step: 0.001, value: cut.at, "aria-label": `Position of the ${name.toLowerCase()} section plane`, oninput: () => {
        cut.at = Number(slider.value);
        this.setClip();
      } });
      const set = (normal: Vector3, at: number) => {
        this.cuts[i] = { normal, at };
        this.buildClip();
        this.setClip();
      };
      const along = (label: string, n: Vector3) => button(label, null, () => set(n, cut.at), { class: "tool text" });
      return h("div", { class: "clip-row" }, box,
        along("X", new Vector3(1, 0, 0)), along("Y", new Vector3(0, 1, 0)), along("Z", new Vector3(0, 0, 1)),
        button("row", null, () => {
          const x = this.report.selected;
          if (!x || !this.view) return;
          const n = new Vector3(...x.row.normal);
          const side = new Vector3().crossVectors(n, Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
          if (side.lengthSq() > 0) set(side, this.view.clipThrough(new Vector3(...this.report.point(x.row)), side));
        }, { class: "tool text", title: "Cut through the chosen node, across the surface" }),
        slider,
        button("flip", null, () => set(cut.normal.clone().negate(), 1 - cut.at), { class: "tool text" }));
    }));
  }

  private setClip(): void {
    this.view?.setSection(this.cuts.filter((c) => c !== null));
  }

  // ---- what is shown ------------------------------------------------------------------------

  private color(t: number): [number, number, number] {
    const steps = this.look.bands;
    const u = steps > 0 ? (Math.min(steps - 1, Math.floor(t * steps)) + 0.5) / steps : t;
    return colorAt(this.look.map, u);
  }

  private refresh(): void {
    const view = this.view;
    if (!view) return;
    this.contour = contourOf(this.report, this.look.contour, this.report.filtered);
    view.parts.setColors((t) => this.color(t));
    view.parts.setContour(this.contour.values);
    this.markHot();
    this.isolate();
    this.applyLooks();
    this.showHits();
    this.drawLegend();
    view.setSelected(this.report.selected);
  }

  /** Penetrating elements: around penetrating nodes, and the elements of main sides and edges. */
  private markHot(): void {
    const node = new Uint8Array(this.report.mesh.nodeId.length);
    const touched = new Uint8Array(node.length);
    const { filtered } = this.report;
    for (const x of filtered) {
      const data = this.report.data.contacts[x.contact];
      const { secondary, main } = x.row;
      const edge = this.report.isEdge(x.row);
      const few = edge ? 2 : 1;
      const many = edge ? 2 : 4;
      if (!edge) node[data.secondaryNode[secondary]] = 1;
      for (let k = 0; k < few; k++) touched[data.secondaryNode[few * secondary + k]] = 1;
      for (let k = 0; k < many; k++) touched[data.mainNode[many * main + k]] = 1;
    }
    this.view?.parts.setHot(node, touched, () => this.hotElements(filtered));
  }
  private hotElements(hits: Hit[]): Set<number> {
    const out = new Set<number>();
    for (const { contact, row } of hits) {
      const { secondaryListed, secondaryOwner: s, mainOwner: m } = this.report.data.contacts[contact];
      const at = secondaryListed[row.secondary];
      if (this.report.isEdge(row)) out.add(elementKey(s.kind[at] - 1, s.id[at]));
      out.add(elementKey(m.kind[row.main] - 1, m.id[row.main]));
    }
    return out;
  }

  private hitsShownFor: unknown = null;
  /** Dots and arrows of the rows in the list; of an isolated pair only its own. */
  private showHits(): void {
    const parts = this.isolated && new Set([...this.isolated].map((p) => p.data.part));
    const own = (x: Hit) => !parts || (parts.has(x.secondaryPart) && parts.has(x.mainPart));
    const hidden = new Set([...this.hidden].map((p) => p.data.part));
    this.view?.setHits(this.report.filtered.filter((x) => own(x) && !(hidden.has(x.secondaryPart) && hidden.has(x.mainPart))),
      (x) => this.color(this.contour!.of(x)), ofCycle(this.look.contour) ? this.forces() : null);
    this.hitsShownFor = this.isolationKey();
    this.drawCrossed();
    this.drawTies();
  }
  /** Nodal forces, largest first: length by size, colour by what the colours show. */
  private forces(): Arrow[] {
    const x = this.report.nodePositions;
    const size = (n: readonly (number | null)[]) => Math.hypot(n[1]!, n[2]!, n[3]!);
    const nodes = (this.report.acted ?? []).filter((n) => size(n) > 0).sort((a, b) => size(b) - size(a));
    const c = new Color();
    return nodes.map((n) => {
      const [r, g, b] = this.color(this.contour!.values![n[0]]);
      return {
        at: [x[3 * n[0]], x[3 * n[0] + 1], x[3 * n[0] + 2]], along: [n[1], n[2], n[3]], length: 0.2 + 0.8 * (size(n) / size(nodes[0])),
        rgb: c.setRGB(r / 255, g / 255, b / 255, "srgb").toArray() as [number, number, number],
      };
    });
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
    // What is solid is looked around.
    this.isolate();
    this.applyLooks();
    this.view?.flyTo(hit);
  }

  /** What the colours stand for; null: there are none. */
  private legendText(): { title: string; tick: (t: number) => string } | null {
    const c = this.contour;
    const kind = this.look.contour;
    if (!c || (ofCycle(kind) ? !this.report.acted?.length : !["gap", "edge"].includes(kind) && this.report.filtered.length === 0)) return null;
    const unit = this.report.meta.deck.units.working?.length;
    return { title: contourNames[kind === "none" ? "depth" : kind] + (unit && ["none", "depth", "gap"].includes(kind) ? ` (${unit})` : ""), tick: c.tick };
  }
  private drawLegend(): void {
    const legend = this.legendText();
    this.legend.hidden = !legend;
    if (!legend) return;
    const stops = Array.from({ length: 33 }, (_, i) => {
      const [r, g, b] = this.color(Math.min(i / 32, 0.9999));
      return `rgb(${r} ${g} ${b}) ${(100 * i) / 32}%`;
    });
    const maps = h("select", { "aria-label": "Colour map", title: "Colour map", onchange: () => this.changeLook({ map: maps.value as MapName }) },
      ...mapNames.map((m) => h("option", { value: m, selected: m === this.look.map }, m)));
    const bands = h("input", { type: "checkbox", checked: this.look.bands > 0, onchange: () => this.changeLook({ bands: bands.checked ? 8 : 0 }) });
    replace(this.legend,
      h("div", { class: "legend-title" }, legend.title),
      h("div", { class: "legend-scale" }, h("div", { class: "legend-bar", style: `background:linear-gradient(to top, ${stops.join(",")})` }),
        h("div", { class: "legend-ticks" }, ...[1, 0.75, 0.5, 0.25, 0].map((t) => h("span", null, legend.tick(t))))),
      h("div", { class: "legend-options" }, maps, h("label", { class: "check" }, bands, "steps")));
    this.legend.style.setProperty("--low", cssColor(this.look.map, 0));
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
    this.label.hidden = this.segmentTag.hidden = !at;
    if (!x || !at) return;
    const r = this.element.getBoundingClientRect();
    if (this.label.dataset.key !== x.key + x.depth) {
      this.label.dataset.key = x.key + x.depth;
      replace(this.label,
        h("b", null, `${this.report.isEdge(x.row) ? "edge" : "node"} ${this.report.secondaryText(x.row)}`),
        h("span", null, `depth ${lengthText(this.report, x.depth, 5)} · gap ${lengthText(this.report, x.row.gap)} · distance ${num(x.row.distance)}`));
    }
    const left = Math.min(Math.max(at.x - r.left + 28, 8), r.width - this.label.offsetWidth - 8);
    const top = Math.min(Math.max(at.y - r.top - 74, 52), r.height - this.label.offsetHeight - 8);
    this.label.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    // The main side is named at its middle.
    const d = this.report.data;
    const corners = this.report.mainNodes(x.row).map((n) => new Vector3(d.x[d.exactOf[n]], d.y[d.exactOf[n]], d.z[d.exactOf[n]]));
    const middle = corners.reduce((a, b) => a.add(b), new Vector3()).divideScalar(corners.length);
    const tag = this.view!.place(middle);
    this.segmentTag.hidden = !tag;
    if (!tag) return;
    this.segmentTag.textContent = `${this.report.isEdge(x.row) ? "edge" : "segment"} ${this.report.mainText(x.row)}`;
    const across = Math.min(Math.max(tag.x - r.left - this.segmentTag.offsetWidth / 2, 8), r.width - this.segmentTag.offsetWidth - 8);
    const down = Math.min(Math.max(tag.y - r.top + 26, 52), r.height - this.segmentTag.offsetHeight - 8);
    this.segmentTag.style.transform = `translate(${Math.round(across)}px, ${Math.round(down)}px)`;
  }

  private tipTimer = 0;
  private showTip(text: string): void {
    this.tip.hidden = !text;
    replace(this.tip, icon("node"), text);
    clearTimeout(this.tipTimer);
    this.tipTimer = window.setTimeout(() => (this.tip.hidden = true), 20000);
  }
}
