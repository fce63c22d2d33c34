// Frame of the 3D view: tool bar, legend, parts, axes, selection. Over 600 lines: one class joins the parts of scene/ and has their state.
import { Sphere, Vector3, type WebGLRenderer } from "three";
import { contourOf, type Contour } from "./contour";
import { colorOf, hasValues, largestOf, Legend, rescaled, titleOf } from "./legend";
import { crossedElements, drawCrossed, drawMoved, drawTies, forceArrows, markHot, outline } from "./marks/overlays";
import { toolbar, type SwitchName } from "./toolbar";
import { Ruler } from "./ruler";
import { choosePart } from "../sections/lists";
import { nearText } from "../sections/nearest";
import type { Row } from "../rows";
import { placeOf, pointOf, wayOut } from "./drawn";
import type { Crossings } from "schema/page";
import { crossingText, segmentOf } from "../sections/crossed";
import { cornersOf, nodeOf, tieLines, type Untied } from "../tied";
import { button, fileName, h, icon, num, plural, replace, svg } from "../dom";
import { copyImage, saveDataUrl } from "../exports";
import { framed, showAxes } from "./framed";
import { contourNames, ofCycle, type Look } from "../look";
import { loadElements, kindNames, type ElementOrigin } from "../data";
import type { Shape } from "../decode/model";
import { elementKey, solidColor, type Look as PartLook, type Part3D, type Side } from "./parts3d";
import type { Cut } from "./section";
import type { Hit, Report } from "../report";
import { machineFor } from "./ready";
import { elementText, Labels } from "./marks/labels";
import { ClipPanel, PartList } from "./panels";
import type { MenuItem } from "../menu";
import type { MouseScheme } from "./camera";
import { View3D, type Picked } from "./view3d";

const mostArrowsAtFirst = 400;
/** Switches stored in the address: words, and default. */
const kept: [SwitchName, [string, string, boolean]][] = [
  ["solid", ["all", "solid", false]], ["rest", ["rest", "hidden", false]], ["follow", ["isolate", "no", true]], ["crossed", ["crossed", "yes", false]], ["ties", ["ties", "yes", false]]];

export class Viewport {
  readonly element = h("div", { class: "viewport", id: "view" });
  view: View3D | null = null;
  onRest: () => void = () => {};
  onMenu: (p: Picked, x: number, y: number) => void = () => {};
  private readonly legend: Legend;
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly labels = new Labels();
  private readonly axes = svg("svg", { viewBox: "-30 -30 60 60", class: "axes", "aria-hidden": "true" });
  private readonly partList = new PartList();
  private readonly clip = new ClipPanel(() => this.view?.setSection(this.clip.cuts.filter((c) => c !== null)), () => this.cutThroughRow(), (normal) => this.cutAt(normal));
  private readonly hidden = new Set<Part3D>();
  private isolated: Set<Part3D> | null = null;
  /** Parts isolated by hand or by a search; null: isolation follows the selection. */
  private alone: Set<Part3D> | null = null;
  /** Sphere around a found node, element, tie or crossing. */
  private place: Sphere | null = null;
  /** By position: parts whose nodes stay in a repair, and parts that alone move. */
  private readonly locks = new Map<number, "lock" | "only">();
  /** Camera before the first choice; Esc returns to it. */
  private before: string | null = null;
  /** Opacity of unchosen parts, 0 to 1. */
  private context = 0;
  private readonly ruler: Ruler;
  private origins: ((part: number, item: number) => ElementOrigin) | null = null;
  private contour: Contour | null = null;
  /** Active switches; the buttons of the tool bar show them. */
  readonly on: Record<SwitchName, boolean> = { arrows: true, edges: true, rest: false, solid: false, follow: true, crossed: false, ties: false, clip: false, measure: false, parts: false, parallel: false };
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly report: Report,
    private readonly look: Look,
    private readonly changeLook: (change: Partial<Look>) => void,
    private readonly shapes: Shape[],
    private readonly software: boolean,
    private readonly machine: WebGLRenderer | null,
  ) {
    this.ruler = new Ruler(report, () => this.view);
    this.legend = new Legend(look, changeLook);
    this.element.append(...this.labels.elements, this.legend.element, h("div", { class: "said" }, this.clip.element, this.ruler.element, this.tip), h("div", { class: "above" }, this.partList.element), this.axes);
  }

  /** Shows a button instead of the picture: small screens show the list first. */
  offer(): void {
    const show = button("Show the picture", "camera", () => {
      show.remove();
      this.element.classList.remove("waiting");
      this.start();
    });
    this.element.classList.add("waiting");
    this.legend.element.hidden = true;
    this.axes.toggleAttribute("hidden", true);
    this.element.append(show);
  }

  /** Makes the 3D view, or a note without WebGL. */
  start(): void {
    try {
      this.view = new View3D(this.report, this.shapes, this.software, this.machine ?? machineFor(this.software), this.element);
    } catch {
      this.element.classList.add("no-webgl");
      replace(this.element, h("p", { class: "note" }, "There is no WebGL here, so there is no picture. All tables and lists work."));
      return;
    }
    const view = this.view;
    view.control.mouse = this.mouse;
    this.axes.toggleAttribute("hidden", false);
    this.partList.element.before(toolbar(this, this.report, this.look, this.changeLook, this.buttons));
    this.press("ties", this.report.meta.ties.some((t) => t.lost > 0));
    // So many arrows would hide their targets.
    this.press("arrows", this.report.filtered.length <= mostArrowsAtFirst || ofCycle(this.look.contour));
    view.setArrows(this.on.arrows);
    this.press("solid", this.report.meta.page === "parts");
    this.buildParts();
    this.clip.build();
    view.onPick = (p) => {
      if (this.ruler.on) return this.ruler.take(p);
      if (p.hit) this.report.select(p.hit);
      else if (!p.part) this.report.select(null);
      this.showTip(p.part ? this.elementText(p.part, p.item, p.node) : "");
    };
    view.onFrame = () => { showAxes(this.axes, view.control.camera.quaternion); this.placeLabels(); };
    let zoomed = "";
    this.report.on("filter", () => {
      this.crossing = null;
      this.forget();
      this.refresh();
      if (this.report.stepping) view.drawLater();
      // A newly chosen interface or part pair is zoomed to once.
      const { interface: inter, pairs } = this.report.filter;
      const key = `${inter}/${pairs}`;
      if (key === zoomed || this.report.selected) return;
      const all = inter === null && pairs === null;
      if (!all) this.choosing();
      if (!all || zoomed || this.before) this.backToFilter();
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

  /** The page is complete: draw the picture at rest. */
  goOn(): void { this.view?.afterFirst(); }

  // ---- tool bar -----------------------------------------------------------------------------

  private contextSlider(): HTMLElement {
    const slider = h("input", { type: "range", class: "context-share", min: 0, max: 1, step: 0.05, value: this.context, oninput: () => {
      this.context = Number(slider.value);
      this.applyLooks();
      this.onRest();
    } });
    return slider;
  }
  private press(name: SwitchName, on: boolean): void {
    this.on[name] = on;
    this.buttons.get(name)?.setAttribute("aria-pressed", on ? "true" : "false");
  }
  /** Effects of the switches. */
  private readonly switched: Record<SwitchName, (on: boolean) => void> = {
    arrows: (on) => this.view?.setArrows(on),
    edges: (on) => {
      if (!this.view) return;
      this.view.parts.edgesOn = on;
      this.view.request();
    },
    rest: () => this.applyLooks(),
    solid: () => this.applyLooks(),
    follow: () => { this.isolate(); this.applyLooks(); },
    crossed: () => this.drawCrossed(),
    ties: () => this.drawTies(),
    clip: (on) => this.clip.show(on),
    measure: (on) => this.ruler.show(on),
    parts: (on) => (this.partList.element.hidden = !on),
    parallel: (on) => { this.view!.control.parallel = on; this.view!.request(); },
  };
  toggle(name: SwitchName): void {
    if (!this.view && (name === "clip" || name === "parallel")) return;
    this.press(name, !this.on[name]);
    this.switched[name](this.on[name]);
  }
  private mouse: MouseScheme = "page";
  setMouse(scheme: MouseScheme): void { this.mouse = scheme; if (this.view) this.view.control.mouse = scheme; }
  private elementText(part: Part3D, item: number, node: number): string {
    this.origins ??= loadElements(this.report.mesh);
    return elementText(this.report, this.origins(part.index, item), part, item, node);
  }
  crossedShown: readonly (readonly number[])[] = [];
  private drawCrossed(): void {
    const parts = this.isolated && new Set([...this.isolated].map((p) => p.data.part));
    const inter = this.report.filter.interface;
    const own = (r: readonly number[]) =>
      (inter === null || this.report.meta.contacts[r[0]].interface === inter) && (!parts || parts.has(this.report.data.contacts[r[0]].mainOwner.part[r[5]]));
    const rows = this.crossing ? [this.crossing] : this.on.crossed ? (this.report.crossed?.rows ?? []).filter(own) : [];
    const had = this.crossedShown.length > 0;
    this.crossedShown = rows;
    if (!this.view) return;
    drawCrossed(this.view, this.report, rows, this.look.dark);
    if (had !== rows.length > 0) this.drawLegend();
  }
  private tiesShown = "";
  /** Draws switched-on ties; a chosen tie is always drawn, alone. */
  private drawTies(): void {
    const { interface: inter } = this.report.filter;
    const chosen = inter !== null && this.report.tieOf(inter) !== null;
    const on = chosen || (this.on.ties && inter === null && (!this.isolated || this.report.untied !== null));
    const key = `${on}/${inter}/${this.look.dark}`;
    if (!this.view || key === this.tiesShown) return;
    this.tiesShown = key;
    drawTies(this.view, this.report, inter, on, this.look.dark);
    this.drawLegend();
  }
  /** Flies to a node of a tie and its segment, with the reason why it is not tied. */
  openTie(x: Untied): void {
    if (!this.on.ties) this.toggle("ties");
    const node = nodeOf(this.report, x);
    this.markNodes([node, ...cornersOf(this.report, x.tie, x.row[0])], [], x);
  }
  private at(node: number): Vector3 { return placeOf(this.report, node); }
  /** Flies to a pair without penetration, its parts alone, with its distance beyond the gap. */
  openNear(row: Row): void {
    const { report, view } = this;
    this.choose();
    if (!view) return;
    const { secondaryOwner, secondaryListed, mainOwner } = report.data.contacts[row.contact];
    const parts = [secondaryOwner.part[secondaryListed[row.secondary]], mainOwner.part[row.main]].map((p) => view.partByIndex(p)).filter((p) => p !== undefined);
    this.showAlone(parts, [pointOf(report, row), ...report.mainNodes(row).map((n) => this.at(n))]);
    const [from, main] = [pointOf(report, row), report.mainNodes(row)];
    const foot = from.clone().addScaledVector(wayOut(report, row), -row.distance);
    view.setRule([from, foot], [...outline(report, main), ...(report.isEdge(row) && !report.meta.contacts[row.contact].points ? outline(report, report.secondaryNodes(row)) : [])]);
    view.flyToPoints([from, foot, ...main.map((n) => this.at(n))]);
    this.showTip(`Nearest: ${nearText(report, row)}`);
  }
  private crossing: Crossings["rows"][0] | null = null;
  /** Shows the two elements of a crossing, other parts transparent, with their names. */
  openCrossed(row: Crossings["rows"][0]): void {
    this.choose();
    if (!this.view) return;
    this.crossing = row;
    const points = [row[1], row[2], ...segmentOf(this.report, row)].map((n) => this.at(n));
    this.place = new Sphere().setFromPoints(points);
    if (!this.on.crossed) this.toggle("crossed");
    this.refresh();
    this.view.flyToPoints(points);
    this.showTip(crossingText(this.report, row));
  }
  /** Flies to a page node. */
  openNode(node: number): void {
    const row = this.report.moved?.rows.find((r) => r[0] === node);
    const way = row ? new Vector3(row[1], row[2], row[3]).multiplyScalar(3) : null;
    this.markNodes([node], way ? [this.at(node).add(way), this.at(node).sub(way)] : []);
  }
  /** Flies to the first node, its elements and the other nodes; isolates their parts. */
  private markNodes(nodes: number[], points: Vector3[], untied: Untied | null = null): void {
    const parts: Part3D[] = [];
    points.push(...nodes.map((n) => this.at(n)));
    for (const p of this.view?.parts.parts ?? []) {
      if (!nodes.some((n) => p.data.node.includes(n))) continue;
      parts.push(p);
      const vertex = p.data.node.indexOf(nodes[0]);
      for (const { vertex: v, corners } of p.data.groups)
        for (let i = v.indexOf(vertex); i >= 0; i = v.indexOf(vertex, i + 1)) for (let k = i - (i % corners); k < i - (i % corners) + corners; k++) points.push(new Vector3().fromArray(p.data.position, 3 * v[k]));
    }
    this.mark(this.at(nodes[0]), points, parts, untied);
  }
  /** Shows the mesh before or after the repair, with lines between both positions. */
  showBefore(on: boolean): void {
    const moved = this.report.moved;
    if (!this.view || !moved) return;
    this.view.parts.showBefore(moved.rows, on);
    this.drawMoved();
    this.view.request();
  }
  private drawMoved(): void { if (this.view) drawMoved(this.view, this.report, this.look); }
  /** Shows everything again. */
  showAll(): void {
    this.hidden.clear();
    this.isolated = this.alone = null;
    this.press("solid", true);
    this.applyLooks();
    this.buildParts();
  }
  fit = (): void => this.view?.fit();
  private choosing(): void { if (this.view) this.before ??= this.view.control.pose; }
  /** Deselects the row but keeps the camera to return to. */
  private choose(untied: Untied | null = null): void {
    this.choosing();
    const { before } = this;
    this.report.select(null, untied);
    this.before = before;
  }
  /** Clears isolation by hand, message and measured line. */
  private forget(): void {
    this.alone = this.place = null;
    this.showTip("");
    if (!this.ruler.on) this.view?.setRule([]);
  }
  /** Flies to the rows that pass the filters; without filters returns to the camera before the first choice. */
  private backToFilter(): void {
    const { filter, filtered } = this.report;
    const tie = filter.interface === null ? null : this.report.tieOf(filter.interface);
    if (!this.view) return;
    if (tie) this.view.fitPoints(tieLines(this.report, filter.interface));
    else if (filter.interface !== null || filter.pairs !== null) this.view.fit(filtered);
    else {
      this.view.control.cut = null;
      if (this.before) this.view.control.pose = this.before;
      else this.view.fit();
      this.before = null;
    }
  }
  /** Esc: clears row, tie, crossing, search and measurement; false if there was none. */
  clear(): boolean {
    const { report } = this;
    const own = this.before !== null && report.filter.interface === null && report.filter.pairs === null;
    const any = own || report.selected !== null || report.untied !== null || this.alone !== null || this.crossing !== null || this.ruler.on || !this.tip.hidden;
    if (!any) return false;
    if (this.ruler.on) this.toggle("measure");
    const { before } = this;
    report.select(null);
    this.before = before;
    this.backToFilter();
    return true;
  }
  /** Shows parts that share nodes with a part or touch it, by default with all visible parts. */
  neighbours(of?: Part3D): void {
    const parts = this.view?.parts.parts ?? [];
    const own = new Set(of ? [of] : (this.isolated ?? parts.filter((p) => p.look === "solid" || p.look === "hot")));
    const marked = new Uint8Array(this.report.mesh.nodeId.length);
    for (const p of own) for (const n of p.data.node) marked[n] = 1;
    const ids = new Set([...own].map((p) => p.data.part));
    const near = new Set(this.report.meta.touches.flatMap(([s, m]) => (ids.has(s) || ids.has(m) ? [s, m] : [])));
    this.showAlone(parts.filter((p) => own.has(p) || near.has(p.data.part) || p.data.node.some((n) => marked[n] === 1)));
    this.view?.fit();
  }
  /** Isolates parts; `points`: what a section plane must not hide. */
  private showAlone(parts: Part3D[], points: Vector3[] = []): void {
    this.place = points.length > 0 ? new Sphere().setFromPoints(points) : null;
    this.alone = parts.length > 0 ? new Set(parts) : null;
    for (const p of parts) this.hidden.delete(p);
    this.isolate();
    this.applyLooks();
    this.buildParts();
  }
  /** Position of a section plane through the chosen row, else through the middle of the isolated parts. */
  private cutAt(normal: Vector3): number {
    const x = this.report.selected;
    if (!this.view) return 0.5;
    // Beyond the chosen object, so that it stays visible.
    const around = x ? this.view.sphereOf(x) : this.place;
    const at = x ? pointOf(this.report, x.row) : (around?.center ?? this.view.middle(this.isolated)).clone();
    return this.view.clipThrough(at.addScaledVector(normal.clone().normalize(), (x ? 0.2 : 1) * (around?.radius ?? 0)), normal);
  }
  private followed = "";
  /** Moves the section planes when the selection changes; else cuts the parts that are drawn now. */
  private followSection(): void {
    const key = `${this.report.selected?.key}/${[...(this.isolated ?? [])].map((p) => p.index)}/${this.place?.center.toArray()}`;
    const moves = key !== this.followed;
    this.followed = key;
    if (!this.clip.any || !this.view) return;
    if (moves) this.clip.follow();
    else this.view.setSection(this.clip.cuts.filter((c) => c !== null));
  }
  /** Picture with title, legend and axes, their letters so many times as large; needs the view. */
  pictured(scale: number, white: boolean, letters = 1): HTMLCanvasElement {
    const { meta, filter } = this.report;
    const legend = this.legendText();
    const inter = filter.interface === null ? plural(meta.interfaces.length - this.report.welds.length, "interface", "interfaces") : `interface ${this.report.interfaceName(filter.interface)}`;
    return this.view!.pictured(scale, white ? "#ffffff" : null, (canvas) =>
      framed(canvas, {
        title: fileName(meta.deck.path), about: `${inter} · ${contourNames[this.look.contour]}`, white: white || !this.look.dark,
        scale: (letters * canvas.width) / this.view!.canvas.clientWidth, turned: this.view!.control.camera.quaternion,
        legend: legend && { ...legend, color: (t) => this.color(t) },
      }));
  }
  /** DECK_INTERFACE_depth.png: named by content. */
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
    const copied = await copyImage(this.pictured(2, false));
    this.showTip(copied ? "The picture is in the clipboard" : "This browser lets no page write pictures into the clipboard: save it instead");
  }

  // ---- found and linked ---------------------------------------------------------------------

  /** Flies to a node and shows its data. */
  showNode(node: number): void {
    const at = this.at(node);
    const hit = this.report.hits.find((h) => this.report.secondaryNodes(h.row).includes(node));
    if (hit) this.report.select(hit);
    else if (Number.isFinite(at.x)) this.openNode(node);
    this.showTip(`node ${this.report.nodeId(node)} · ${at.toArray().map((v) => num(v, 6)).join("  ")}${hit ? "" : " · penetrates nothing"}`);
  }
  /** Flies to an element of a part of the mesh. */
  showElement(part: number, item: number, vertices: number[]): void {
    const points = vertices.map((v) => new Vector3().fromArray(this.report.mesh.parts[part].position, 3 * v));
    const p = this.view?.parts.parts[part];
    this.mark(points.reduce((a, b) => a.clone().add(b)).divideScalar(points.length), points, p ? [p] : []);
    if (p) this.showTip(this.elementText(p, item, -1));
  }
  /** Items to copy of the object under the cursor. */
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
      { label: "Neighbours of the part", run: () => this.neighbours(part) }, { label: "All pairs of the part", run: () => choosePart(this.report, part.data.part) },
      { label: "Fit to part", run: () => this.view!.control.fly(part.sphere.center, part.sphere.radius) }, { label: "Show everything", run: () => this.showAll() },
      { label: `Copy ${kindNames[p.part.elementKind[p.item]]} ${element}`, text: String(element) }, { label: `Copy part ${id}`, text: String(id) }];
    return p.node < 0 ? items : [...items, { label: `Copy node ${this.report.nodeId(p.node)}`, text: String(this.report.nodeId(p.node)) }];
  }
  /** Shows a part alone, by its position in Meta.parts; null: all. */
  showPart(part: number | null): void {
    this.choose();
    if (part === null) return this.showAll();
    const p = this.view?.partByIndex(part);
    if (p) { this.showAlone([p]); this.view!.fit(); }
    this.showTip(`part ${this.report.partText(part)}`);
  }
  /** Marks a point and flies to `points` of isolated `parts`. */
  private mark(at: Vector3, points: Vector3[], parts: Part3D[], untied: Untied | null = null): void {
    this.choose(untied);
    if (!this.view) return;
    this.showAlone(parts, points);
    this.view.setRule([at]);
    this.view.flyToPoints(points, at);
  }

  /** State of the picture for the address. */
  get state(): Record<string, string> {
    const out: Record<string, string> = {};
    for (const [name, [key, text, otherwise]] of kept) if (this.on[name] !== otherwise) out[key] = text;
    if (this.context > 0) out.context = String(this.context);
    if (this.hidden.size > 0) out.hidden = [...this.hidden].map((p) => this.report.partId(p.data.part)).join(",");
    if (this.clip.any) out.section = this.clip.state;
    for (const how of ["lock", "only"]) {
      const own = [...this.locks].filter(([, v]) => v === how);
      if (own.length > 0) out[how] = own.map(([p]) => this.report.partId(p)).join(",");
    }
    if (this.ruler.measured.length === 2) out.ruler = this.ruler.measured.map((n) => this.report.nodeId(n)).join(",");
    if (this.view && this.on.parallel) out.parallel = "yes";
    if (this.view) out.camera = this.view.control.pose;
    return out;
  }
  set state(s: Record<string, string>) {
    for (const [name, [key, text, otherwise]] of kept) this.press(name, (s[key] === text) !== otherwise);
    this.context = Math.min(Math.max(Number(s.context ?? 0) || 0, 0), 1);
    if (!this.view) { this.later = s; return; }
    const hidden = new Set((s.hidden ?? "").split(",").filter(Boolean).map(Number));
    this.hidden.clear();
    this.locks.clear();
    for (const p of this.view.parts.parts) if (hidden.has(this.report.partId(p.data.part))) this.hidden.add(p);
    for (const how of ["lock", "only"] as const) for (const id of (s[how] ?? "").split(",").filter(Boolean)) this.locks.set(this.report.meta.parts.findIndex((p) => String(p.id) === id), how);
    this.buildParts();
    this.ruler.set((s.ruler ?? "").split(",").filter(Boolean).map((id) => this.report.mesh.nodeId.indexOf(Number(id))).filter((n) => n >= 0));
    this.press("measure", this.ruler.on);
    if (!this.ruler.on) this.view.setRule([]);
    this.press("parallel", (this.view.control.parallel = s.parallel === "yes"));
    this.refresh();
    this.clip.state = s.section ?? ""; // where it was, not where it follows to
    this.press("clip", this.clip.any);
    if (s.camera) this.view.control.pose = s.camera;
  }
  private later: Record<string, string> | null = null;
  // ---- parts --------------------------------------------------------------------------------

  private buildParts(): void {
    this.partList.fill(this.report, this.view!.parts.parts, {
      hidden: this.hidden, apply: () => this.applyLooks(), only: (p) => this.showPart(p.data.part), all: () => this.showAll(), neighbours: () => this.neighbours(), locks: this.locks, noted: () => this.onRest(),
    });
  }

  /** Isolates the parts of the selected row, else of the chosen part pair, else of the chosen interface. */
  private isolate(): void {
    const { selected, filter } = this.report;
    const pairs = selected ? [[selected.secondaryPart, selected.mainPart]] : filter.pairs;
    const sides = pairs ? { secondary: new Set(pairs.map((p) => p[0])), main: new Set(pairs.map((p) => p[1])) } : filter.interface !== null ? this.report.sidesOf(filter.interface) : null;
    for (const p of this.view?.parts.parts ?? []) {
      const [a, b] = [sides?.secondary.has(p.data.part), sides?.main.has(p.data.part)];
      p.side = a === b ? "none" : a ? "secondary" : "main";
    }
    const parts = (this.view?.parts.parts ?? []).filter((p) => sides?.secondary.has(p.data.part) || sides?.main.has(p.data.part));
    this.isolated = this.alone ?? (this.on.follow && parts.length > 0 ? new Set(parts) : null);
    if (!this.crossing) return;
    const own = crossedElements(this.report, this.crossing);
    this.isolated = new Set((this.view?.parts.parts ?? []).filter((p) => p.element.some((id, i) => own.has(elementKey(p.elementKind[i], id)))));
  }

  /** Chosen pairs are solid; of other parts only penetrating elements. */
  private lookOf(p: Part3D): PartLook {
    if (this.hidden.has(p)) return "hidden";
    if (this.isolated && !this.isolated.has(p)) return this.context > 0 && !this.on.rest ? "ghost" : "hidden";
    if (this.crossing) return "hot";
    const chosen = this.isolated !== null && (this.alone !== null || this.report.selected !== null || this.report.filter.pairs !== null || this.report.filter.interface === null);
    const tie = this.report.filter.interface !== null && this.report.tieOf(this.report.filter.interface) !== null;
    if (this.on.solid || chosen || (this.isolated && tie) || this.report.filtered.length === 0) return "solid";
    return this.on.rest ? "only" : "hot";
  }

  private applyLooks(): void {
    this.view?.setLooks((p) => this.lookOf(p));
    this.followSection();
    this.ground();
    if (this.legendIsolated !== (this.isolated !== null)) this.drawLegend();
    if (this.contour && this.hitsShownFor !== null && this.hitsShownFor !== this.isolationKey()) this.showHits();
  }

  private ground(): void {
    this.view?.setGround(this.look.dark, this.look.contour !== "none", this.isolated ? 2 * this.context : 1);
  }

  /** Section plane through the chosen row, normal to its surface. */
  private cutThroughRow(): Cut | null {
    const x = this.report.selected;
    if (!x || !this.view) return null;
    const n = wayOut(this.report, x.row);
    const side = new Vector3().crossVectors(n, Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
    return side.lengthSq() > 0 ? { normal: side, at: this.view.clipThrough(pointOf(this.report, x.row), side) } : null;
  }

  // ---- what is shown ------------------------------------------------------------------------

  private color(t: number): [number, number, number] { return colorOf(this.look, t); }

  private refresh(): void {
    const view = this.view;
    if (!view) return;
    this.contour = rescaled(contourOf(this.report, this.look.contour, this.report.filtered), this.look, this.look.contour);
    view.parts.setColors((t) => this.color(t));
    view.parts.setContour(this.contour.values);
    markHot(view.parts, this.report, this.crossing);
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
      (x) => this.color(this.contour!.of(x)), ofCycle(this.look.contour) ? forceArrows(this.report, (n) => this.color(this.contour!.values![n])) : null);
    this.hitsShownFor = this.isolationKey();
    this.drawCrossed();
    this.drawTies();
  }
  private isolationKey(): string {
    const list = (s: Iterable<Part3D> | null) => (s ? [...s].map((p) => p.index).join(",") : "-");
    return `${list(this.isolated)}/${list(this.hidden)}`;
  }

  private selection(): void {
    const x = this.report.selected;
    this.forget();
    if (this.crossing) { this.crossing = null; this.refresh(); }
    const { interface: inter, pairs } = this.report.filter;
    if (!x && !this.report.untied && inter === null && pairs === null) this.before = null;
    this.isolate();
    this.applyLooks();
    this.view?.setSelected(x);
    this.placeLabels();
  }

  /** Flies to a row. */
  open(hit: Hit): void {
    this.choosing();
    // Isolate first: the view then looks around solid parts.
    this.isolate();
    this.applyLooks();
    this.view?.flyTo(hit);
  }

  /** Meaning of the colours; null without colours. */
  private legendText(): { title: string; tick: (t: number) => string } | null {
    const kind = this.look.contour;
    if (!this.contour || !hasValues(kind, this.report.steps !== null, (this.report.acted?.length ?? 0) > 0, this.report.filtered.length > 0)) return null;
    return { title: titleOf(kind, this.report.meta.deck.units.working), tick: this.contour.tick };
  }
  private legendIsolated = false;
  private drawLegend(): void {
    const legend = this.legendText();
    this.legendIsolated = this.isolated !== null;
    const sides = this.sidesText();
    this.legend.element.hidden = !legend && !sides;
    if ((legend || sides) && this.contour) this.legend.draw(legend?.title ?? null, this.contour, this.isolated && this.contextSlider(), sides);
    this.largest = legend && this.look.maximum ? largestOf(this.contour!, this.look.contour) : null;
    this.placeLabels();
  }
  /** Colours of parts while something is chosen, of lines and of hollow dots. */
  private sidesText(): HTMLElement | null {
    const { filter, selected } = this.report;
    const chosen = filter.interface !== null || filter.pairs !== null || selected;
    const seen = new Set((this.view?.parts.parts ?? []).filter((p) => chosen && this.isolated?.has(p)).map((p) => p.side));
    const one = (style: string, text: string) => h("span", { class: "check" }, h("span", { class: "swatch", style }), text);
    const side = (of: Side, text: string) => seen.has(of) && one(`background:${solidColor(of, this.look.dark)}`, text);
    const lines = this.view ? [this.view.crossed, this.view.ties, this.view.moved].flatMap((l) => [...l.keys]) : [];
    if (!chosen && lines.length === 0 && !this.view?.markers.hollow) return null;
    return h("div", { class: "sides" }, side("secondary", "secondary"), side("main", "main"), side("none", "secondary and main"),
      ...lines.map(([text, color]) => one(`background:${color}`, text)), this.view?.markers.hollow && one("border:2px solid currentColor;border-radius:50%", "only by round-off"));
  }
  private largest: { node: number; text: string } | null = null;

  private placeLabels(): void {
    const x = this.report.selected;
    if (!this.view || (!x && !this.largest)) return this.labels.hide();
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
    const room = { left: 8, top: 8, right: r.width - 8, bottom: r.height - 8 };
    if (x) this.labels.show(this.report, x, place, room, taken);
    else this.labels.one(`${this.largest!.text} at node ${this.report.nodeId(this.largest!.node)}`, this.at(this.largest!.node), place, room, taken);
  }

  private tipTimer = 0;
  private showTip(text: string): void {
    this.tip.hidden = !text;
    replace(this.tip, icon("node"), text, button("", "close", () => this.showTip(""), { "aria-label": "Close", class: "tool" }));
    clearTimeout(this.tipTimer);
    this.tipTimer = window.setTimeout(() => (this.tip.hidden = true), 20000);
  }
}
