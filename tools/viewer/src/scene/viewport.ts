// Around the 3D view: tool bar, legend, list of parts, axes, and what is known about the selection.
// Over 600 lines: every control of the view acts on the one state that it shares with the others.
import { Color, Vector3, type WebGLRenderer } from "three";
import { colorAt, cssColor, mapNames, type MapName } from "./colormap";
import { contourOf, type Contour } from "./contour";
import type { Crossed } from "../meta";
import { crossingText, segmentOf } from "../sections/crossed";
import { cornersOf, nodeOf, type Untied } from "../sections/untied";
import { tieLines } from "./tied";
import { button, fileName, h, icon, num, plural, replace, svg } from "../dom";
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
import { ClipPanel } from "./clippanel";
import { Labels } from "./labels";
import { PartList } from "./partlist";
import type { MenuItem } from "../menu";
import { View3D, type Arrow, type Picked } from "./view3d";

const mostArrowsAtFirst = 400;

export class Viewport {
  readonly element = h("div", { class: "viewport", id: "view" });
  view: View3D | null = null;
  onRest: () => void = () => {};
  onMenu: (p: Picked, x: number, y: number) => void = () => {};
  private readonly legend = h("div", { class: "legend" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly labels = new Labels();
  private readonly axes = svg("svg", { viewBox: "-30 -30 60 60", class: "axes", "aria-hidden": "true" });
  private readonly partList = new PartList();
  private readonly clip = new ClipPanel(() => this.view?.setSection(this.clip.cuts.filter((c) => c !== null)), () => this.cutThroughRow());
  private readonly hidden = new Set<Part3D>();
  private isolated: Set<Part3D> | null = null;
  private rest: "ghost" | "hidden" = "ghost";
  /** How much of the parts that are not chosen is seen, 0 to 1. */
  private context = 0;
  private allSolid = false;
  private readonly ruler = h("div", { class: "tip ruler", hidden: true, "aria-live": "polite" });
  private measuring = false;
  private measured: number[] = []; // page nodes
  private origins: ((part: number, item: number) => ElementOrigin) | null = null;
  private follow = true;
  private arrows = true;
  private edges = true;
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
    this.element.append(...this.labels.elements, this.legend, h("div", { class: "said" }, this.ruler, this.tip), this.partList.element, this.clip.element, this.axes);
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
    this.press("solid", (this.allSolid = this.report.meta.page === "parts"));
    this.buildParts();
    this.clip.build();
    view.onPick = (p) => {
      if (this.measuring) return this.measure(p);
      if (p.hit) this.report.select(p.hit);
      else if (!p.part) this.report.select(null);
      this.showTip(p.part ? this.elementText(p.part, p.item, p.node) : "");
    };
    view.onFrame = () => {
      this.drawAxes();
      this.placeLabels();
    };
    let zoomed = "";
    this.report.on("filter", () => {
      this.crossing = null;
      this.refresh();
      if (this.report.stepping) view.drawLater();
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
    this.drawMoved();
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
      ...Object.entries(contourNames).filter(([k]) => (k === "element" ? this.report.steps : !ofCycle(k as ContourKind) || this.report.cycle?.nodes.length)).map(([k, name]) => h("option", { value: k }, name)));
    this.report.on("look", () => (contour.value = this.look.contour));
    contour.value = this.look.contour;
    const toggle = (key: string, name: string, iconName: string, on: boolean, run: () => void) => {
      const b = button("", iconName, run, { "aria-label": name, title: name, "aria-pressed": on ? "true" : "false", class: "tool" });
      this.toggles.set(key, b);
      return b;
    };
    let last = "";
    const axis = (name: string, d: [number, number, number], up: [number, number, number], title = `Look along ${name}; again: from the other side`) =>
      button(name, null, () => {
        const back = last === name && name !== "ISO";
        last = back ? "" : name;
        this.view!.look(new Vector3(...d).multiplyScalar(back ? -1 : 1), new Vector3(...up));
      }, { class: "tool text", title });
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
        axis("ISO", [1, -1, 1], [0, 0, 1], "Look from a corner"), axis("X", [1, 0, 0], [0, 0, 1]), axis("Y", [0, -1, 0], [0, 0, 1]), axis("Z", [0, 0, 1], [0, 1, 0]),
        button("", "fit", () => this.fit(), { "aria-label": "Fit (f)", title: "Fit (f)", class: "tool" }),
        button("", "camera", () => this.savePicture(false), { "aria-label": "Save a PNG", title: "Save a PNG", class: "tool" })));
  }

  private contextSlider(): HTMLElement {
    const slider = h("input", { type: "range", class: "context-share", min: 0, max: 1, step: 0.05, value: this.context, oninput: () => {
      this.context = Number(slider.value);
      this.applyLooks();
      this.onRest();
    } });
    return slider;
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
    const rows = (this.crossedShown = this.crossing ? [this.crossing] : this.crossedOn ? (this.report.crossed?.rows ?? []).filter(own) : []);
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
  private crossing: Crossed["rows"][0] | null = null;
  /** Shows the two elements of a crossing, the rest of their parts see-through, and says which they are. */
  openCrossed(row: Crossed["rows"][0]): void {
    this.report.select(null);
    if (!this.view) return;
    this.crossing = row;
    if (!this.crossedOn) this.toggleCrossed();
    this.refresh();
    const x = this.report.nodePositions;
    this.view.flyToPoints([row[1], row[2], ...segmentOf(this.report, row)].map((n) => new Vector3(x[3 * n], x[3 * n + 1], x[3 * n + 2])));
    this.showTip(crossingText(this.report, row));
  }
  private crossedElements(row: Crossed["rows"][0]): Set<number> {
    const main = this.report.data.contacts[row[0]].mainOwner;
    return new Set([elementKey(row[3], row[4]), ...(main.kind[row[5]] > 0 ? [elementKey(main.kind[row[5]] - 1, main.id[row[5]])] : [])]);
  }
  /** Flies to a node by its number in the page. */
  openNode(node: number): void {
    const x = this.report.nodePositions;
    const at = new Vector3(x[3 * node], x[3 * node + 1], x[3 * node + 2]);
    const row = this.report.moved?.rows.find((r) => r[0] === node);
    this.mark(at, row ? Math.max(12 * Math.hypot(row[1], row[2], row[3]), this.view?.control.pixel(at) ?? 0) : 1);
  }
  /** The mesh before the repair, or after it; lines run from where nodes stood to where they stand. */
  showBefore(on: boolean): void {
    const moved = this.report.moved;
    if (!this.view || !moved) return;
    this.view.parts.showBefore(moved.rows, on);
    this.drawMoved();
    this.view.request();
  }
  private drawMoved(): void {
    const rows = this.report.moved?.rows ?? [];
    const x = this.report.nodePositions;
    const ends = Float32Array.from(rows.flatMap((r) => [0, 1, 2].map((k) => x[3 * r[0] + k] - r[k + 1]).concat([0, 1, 2].map((k) => x[3 * r[0] + k]))));
    this.view?.moved.set([{ ends, color: this.look.dark ? "#7cc7ff" : "#1d4ed8", width: 2.5 }]);
  }
  toggleParts(): void {
    const list = this.partList.element;
    list.hidden = !list.hidden;
    this.press("parts", !list.hidden);
  }
  toggleClip(): void {
    if (!this.view) return;
    const on = !!this.clip.element.hidden;
    this.press("clip", on);
    this.clip.show(on);
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
  itemsOf(p: Picked): MenuItem[] {
    if (!p.part) return [];
    const part = p.part;
    const element = p.part.element[p.item];
    const id = this.report.partId(p.part.data.part);
    const hide = () => {
      this.hidden.add(part);
      this.applyLooks();
      this.buildParts();
    };
    const items: MenuItem[] = [
      { label: "Hide part", run: hide }, { label: "Isolate part", run: () => this.showPart(part.data.part) },
      { label: "Fit to part", run: () => this.view!.control.fly(part.sphere.center, part.sphere.radius) }, { label: "Show everything", run: () => this.showAll() },
      { label: `Copy ${kindNames[p.part.elementKind[p.item]]} ${element}`, text: String(element) }, { label: `Copy part ${id}`, text: String(id) }];
    return p.node < 0 ? items : [...items, { label: `Copy node ${this.report.nodeId(p.node)}`, text: String(this.report.nodeId(p.node)) }];
  }
  /** Shows a part alone, by its position in Meta.parts; null: all. */
  showPart(part: number | null): void {
    this.report.select(null);
    if (part === null) return this.showAll();
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
    if (this.context > 0) out.context = String(this.context);
    if (this.crossedOn) out.crossed = "yes";
    if (this.tiesOn) out.ties = "yes";
    if (this.hidden.size > 0) out.hidden = [...this.hidden].map((p) => this.report.partId(p.data.part)).join(",");
    if (this.clip.any) out.section = this.clip.state;
    if (this.measured.length === 2) out.ruler = this.measured.map((n) => this.report.nodeId(n)).join(",");
    if (this.view) out.camera = this.view.control.pose;
    return out;
  }
  set state(s: Record<string, string>) {
    this.allSolid = s.all === "solid";
    this.rest = s.rest === "hidden" ? "hidden" : "ghost";
    this.follow = s.isolate !== "no";
    this.context = Math.min(Math.max(Number(s.context ?? 0) || 0, 0), 1);
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
    this.clip.state = s.section ?? "";
    this.press("clip", this.clip.any);
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
    this.partList.fill(this.report, this.view!.parts.parts, {
      hidden: this.hidden, apply: () => this.applyLooks(), only: (p) => this.showPart(p.data.part), all: () => this.showAll(),
    });
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
    if (!this.crossing) return;
    const own = this.crossedElements(this.crossing);
    this.isolated = new Set((this.view?.parts.parts ?? []).filter((p) => p.element.some((id, i) => own.has(elementKey(p.elementKind[i], id)))));
  }

  /** Chosen pairs are solid; of everything else only what penetrates is. */
  private lookOf(p: Part3D): PartLook {
    if (this.hidden.has(p)) return "hidden";
    if (this.isolated && !this.isolated.has(p)) return this.context > 0 ? this.rest : "hidden";
    if (this.crossing) return "hot";
    const chosen = this.isolated !== null && (this.report.selected !== null || this.report.filter.pair !== null || this.report.filter.interface === null);
    const tie = this.report.filter.interface !== null && this.report.tieOf(this.report.filter.interface) !== null;
    if (this.allSolid || chosen || (this.isolated && tie) || this.report.filtered.length === 0) return "solid";
    return this.rest === "ghost" ? "hot" : "only";
  }

  private applyLooks(): void {
    this.view?.setLooks((p) => this.lookOf(p));
    this.ground();
    if (this.legendIsolated !== (this.isolated !== null)) this.drawLegend();
    if (this.contour && this.hitsShownFor !== null && this.hitsShownFor !== this.isolationKey()) this.showHits();
  }

  private ground(): void {
    this.view?.setGround(this.look.dark, this.look.contour !== "none", this.isolated ? 2 * this.context : 1);
  }

  /** A section plane through the chosen row, across its surface. */
  private cutThroughRow(): Cut | null {
    const x = this.report.selected;
    if (!x || !this.view) return null;
    const n = new Vector3(...x.row.normal);
    const side = new Vector3().crossVectors(n, Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
    return side.lengthSq() > 0 ? { normal: side, at: this.view.clipThrough(new Vector3(...this.report.point(x.row)), side) } : null;
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
    if (this.crossing) {
      for (const n of [this.crossing[1], this.crossing[2], ...segmentOf(this.report, this.crossing)]) touched[n] = 1;
      return this.view?.parts.setHot(node, touched, () => this.crossedElements(this.crossing!));
    }
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
    if (this.crossing) {
      this.crossing = null;
      this.refresh();
    }
    this.isolate();
    this.applyLooks();
    this.view?.setSelected(x);
    this.placeLabels();
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
    if (!c || (kind === "element" ? !this.report.steps : ofCycle(kind) ? !this.report.acted?.length : !["gap", "edge"].includes(kind) && this.report.filtered.length === 0)) return null;
    const unit = this.report.meta.deck.units.working?.length;
    return { title: contourNames[kind === "none" ? "depth" : kind] + (unit && ["none", "depth", "gap"].includes(kind) ? ` (${unit})` : ""), tick: c.tick };
  }
  private legendIsolated = false;
  private drawLegend(): void {
    const legend = this.legendText();
    this.legendIsolated = this.isolated !== null;
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
      h("div", { class: "legend-options" }, maps, h("label", { class: "check" }, bands, "steps")),
      this.isolated && h("label", { class: "legend-options", title: "How much of the other parts is seen beside what is chosen" }, "context", this.contextSlider()));
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

  private placeLabels(): void {
    const x = this.report.selected;
    if (!x || !this.view) return this.labels.hide();
    const r = this.element.getBoundingClientRect();
    const taken = [...this.element.querySelectorAll<HTMLElement>(".legend, .toolbar > *, .part-list, .clip-panel, .tip")].filter((e) => !e.hidden).map((e) => {
      const b = e.getBoundingClientRect();
      return { left: b.left - r.left, right: b.right - r.left, top: b.top - r.top, bottom: b.bottom - r.top };
    });
    const place = (at: Vector3) => {
      const p = this.view!.place(at);
      return p && { x: p.x - r.left, y: p.y - r.top };
    };
    this.view.control.update(performance.now());
    this.labels.show(this.report, x, place, { left: 8, top: 8, right: r.width - 8, bottom: r.height - 8 }, taken);
  }

  private tipTimer = 0;
  private showTip(text: string): void {
    this.tip.hidden = !text;
    replace(this.tip, icon("node"), text, button("", "close", () => this.showTip(""), { "aria-label": "Close", class: "tool" }));
    clearTimeout(this.tipTimer);
    this.tipTimer = window.setTimeout(() => (this.tip.hidden = true), 20000);
  }
}
