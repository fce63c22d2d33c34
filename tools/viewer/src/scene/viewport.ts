// Frame of the 3D view: tool bar, legend, list of parts, axes, data of the selection.
import { Vector3, type WebGLRenderer } from "three";
import { contourOf, type Contour } from "./contour";
import { colorOf, hasValues, largestOf, Legend, rescaled, titleOf } from "./legend";
import { crossedElements, drawCrossed, drawMoved, drawTies, forceArrows, markHot, outline } from "./marks/overlays";
import { toolbar, type SwitchName } from "./toolbar";
import { Ruler } from "./ruler";
import { nearText } from "../sections/nearest";
import type { Row } from "../rows";
import { placeOf, pointOf, wayOut } from "./drawn";
import type { Crossings } from "schema/page";
import { crossingText, segmentOf } from "../sections/crossed";
import { cornersOf, nodeOf, tieLines, type Untied } from "../tied";
import { button, fileName, h, icon, num, plural, replace, svg } from "../dom";
import { copyImage, saveDataUrl } from "../exports";
import { framed, showAxes } from "./framed";
import { frameOf } from "../find";
import { contourNames, ofCycle, type Look } from "../look";
import { loadElements, kindNames, type ElementOrigin } from "../data";
import type { Shape } from "../decode/model";
import { elementKey, type Look as PartLook, type Part3D } from "./parts3d";
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
  private readonly clip = new ClipPanel(() => this.view?.setSection(this.clip.cuts.filter((c) => c !== null)), () => this.cutThroughRow());
  private readonly hidden = new Set<Part3D>();
  private isolated: Set<Part3D> | null = null;
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
    this.element.append(...this.labels.elements, this.legend.element, h("div", { class: "said" }, this.ruler.element, this.tip), this.partList.element, this.clip.element, this.axes);
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
    this.element.append(toolbar(this, this.report, this.look, this.changeLook, this.buttons));
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
    view.onFrame = () => {
      showAxes(this.axes, view.control.camera.quaternion);
      this.placeLabels();
    };
    let zoomed = "";
    this.report.on("filter", () => {
      this.crossing = null;
      this.refresh();
      if (this.report.stepping) view.drawLater();
      // A newly chosen interface or part pair is zoomed to once.
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

  /** The page is complete: draw the picture at rest. */
  goOn(): void {
    this.view?.afterFirst();
  }

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
    follow: () => {
      this.isolate();
      this.applyLooks();
    },
    crossed: () => this.drawCrossed(),
    ties: () => this.drawTies(),
    clip: (on) => this.clip.show(on),
    measure: (on) => this.ruler.show(on),
    parts: (on) => (this.partList.element.hidden = !on),
    parallel: (on) => {
      this.view!.control.parallel = on;
      this.view!.request();
    },
  };
  toggle(name: SwitchName): void {
    if (!this.view && (name === "clip" || name === "parallel")) return;
    this.press(name, !this.on[name]);
    this.switched[name](this.on[name]);
  }
  private mouse: MouseScheme = "page";
  setMouse(scheme: MouseScheme): void {
    this.mouse = scheme;
    if (this.view) this.view.control.mouse = scheme;
  }
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
    this.crossedShown = rows;
    if (this.view) drawCrossed(this.view, this.report, rows, this.look.dark);
  }
  private tiesShown = "";
  /** Draws switched-on ties; a chosen tie is always drawn, alone. */
  private drawTies(): void {
    const { interface: inter } = this.report.filter;
    const chosen = inter !== null && this.report.tieOf(inter) !== null;
    const on = chosen || (this.on.ties && inter === null);
    const key = `${on}/${inter}/${this.look.dark}`;
    if (!this.view || key === this.tiesShown) return;
    this.tiesShown = key;
    drawTies(this.view, this.report, inter, on, this.look.dark);
  }
  /** Flies to a node of a tie and its segment, with the reason why it is not tied. */
  openTie(x: Untied): void {
    if (!this.on.ties) this.toggle("ties");
    const node = nodeOf(this.report, x);
    this.report.select(null, x);
    this.view?.setRule([this.at(node)]);
    this.view?.flyToPoints([node, ...cornersOf(this.report, x.tie, x.row[0])].map((n) => this.at(n)));
  }
  private at(node: number): Vector3 {
    return placeOf(this.report, node);
  }
  /** Flies to a pair without penetration, its parts alone, with its distance beyond the gap. */
  openNear(row: Row): void {
    const { report, view } = this;
    report.select(null);
    if (!view) return;
    const { secondaryOwner, secondaryListed, mainOwner } = report.data.contacts[row.contact];
    const parts = [secondaryOwner.part[secondaryListed[row.secondary]], mainOwner.part[row.main]].map((p) => view.partByIndex(p)).filter((p) => p !== undefined);
    if (parts.length > 0) this.isolated = new Set(parts);
    this.applyLooks();
    const [from, main] = [pointOf(report, row), report.mainNodes(row)];
    const foot = from.clone().addScaledVector(wayOut(report, row), -row.distance);
    view.setRule([from, foot], [...outline(report, main), ...(report.isEdge(row) && !report.meta.contacts[row.contact].points ? outline(report, report.secondaryNodes(row)) : [])]);
    view.flyToPoints([from, foot, ...main.map((n) => this.at(n))]);
    this.showTip(`Nearest: ${nearText(report, row)}`);
  }
  private crossing: Crossings["rows"][0] | null = null;
  /** Shows the two elements of a crossing, other parts transparent, with their names. */
  openCrossed(row: Crossings["rows"][0]): void {
    this.report.select(null);
    if (!this.view) return;
    this.crossing = row;
    if (!this.on.crossed) this.toggle("crossed");
    this.refresh();
    this.view.flyToPoints([row[1], row[2], ...segmentOf(this.report, row)].map((n) => this.at(n)));
    this.showTip(crossingText(this.report, row));
  }
  /** Flies to a page node. */
  openNode(node: number): void {
    const at = this.at(node);
    const row = this.report.moved?.rows.find((r) => r[0] === node);
    this.mark(at, row ? Math.max(12 * Math.hypot(row[1], row[2], row[3]), this.view?.control.pixel(at) ?? 0) : 1);
  }
  /** Shows the mesh before or after the repair, with lines between both positions. */
  showBefore(on: boolean): void {
    const moved = this.report.moved;
    if (!this.view || !moved) return;
    this.view.parts.showBefore(moved.rows, on);
    this.drawMoved();
    this.view.request();
  }
  private drawMoved(): void {
    if (this.view) drawMoved(this.view, this.report, this.look);
  }
  /** Shows everything again. */
  showAll(): void {
    this.hidden.clear();
    this.isolated = null;
    this.press("solid", true);
    this.applyLooks();
    this.buildParts();
  }
  fit = (): void => this.view?.fit();
  /** Picture with title, legend and axes, their letters so many times as large; needs the view. */
  pictured(scale: number, white: boolean, letters = 1): HTMLCanvasElement {
    const { meta, filter } = this.report;
    const legend = this.legendText();
    const inter = filter.interface === null ? plural(meta.interfaces.length, "interface", "interfaces") : `interface ${this.report.interfaceName(filter.interface)}`;
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

  /** State of the picture for the address. */
  get state(): Record<string, string> {
    const out: Record<string, string> = {};
    for (const [name, [key, text, otherwise]] of kept) if (this.on[name] !== otherwise) out[key] = text;
    if (this.context > 0) out.context = String(this.context);
    if (this.hidden.size > 0) out.hidden = [...this.hidden].map((p) => this.report.partId(p.data.part)).join(",");
    if (this.clip.any) out.section = this.clip.state;
    if (this.ruler.measured.length === 2) out.ruler = this.ruler.measured.map((n) => this.report.nodeId(n)).join(",");
    if (this.view && this.on.parallel) out.parallel = "yes";
    if (this.view) out.camera = this.view.control.pose;
    return out;
  }
  set state(s: Record<string, string>) {
    for (const [name, [key, text, otherwise]] of kept) this.press(name, (s[key] === text) !== otherwise);
    this.context = Math.min(Math.max(Number(s.context ?? 0) || 0, 0), 1);
    if (!this.view) {
      this.later = s;
      return;
    }
    const hidden = new Set((s.hidden ?? "").split(",").filter(Boolean).map(Number));
    this.hidden.clear();
    for (const p of this.view.parts.parts) if (hidden.has(this.report.partId(p.data.part))) this.hidden.add(p);
    this.clip.state = s.section ?? "";
    this.press("clip", this.clip.any);
    this.ruler.set((s.ruler ?? "").split(",").filter(Boolean).map((id) => this.report.mesh.nodeId.indexOf(Number(id))).filter((n) => n >= 0));
    this.press("measure", this.ruler.on);
    if (!this.ruler.on) this.view.setRule([]);
    this.press("parallel", (this.view.control.parallel = s.parallel === "yes"));
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

  /** Isolates the parts of the selected row, else of the chosen part pair, else of the chosen interface. */
  private isolate(): void {
    const { selected, filter } = this.report;
    const pair = selected ? [selected.secondaryPart, selected.mainPart] : filter.pair;
    const sides = pair ? { secondary: new Set([pair[0]]), main: new Set([pair[1]]) } : filter.interface !== null ? this.report.sidesOf(filter.interface) : null;
    for (const p of this.view?.parts.parts ?? []) {
      const [a, b] = [sides?.secondary.has(p.data.part), sides?.main.has(p.data.part)];
      p.side = a === b ? "none" : a ? "secondary" : "main";
    }
    const parts = (this.view?.parts.parts ?? []).filter((p) => sides?.secondary.has(p.data.part) || sides?.main.has(p.data.part));
    this.isolated = this.on.follow && parts.length > 0 ? new Set(parts) : null;
    if (!this.crossing) return;
    const own = crossedElements(this.report, this.crossing);
    this.isolated = new Set((this.view?.parts.parts ?? []).filter((p) => p.element.some((id, i) => own.has(elementKey(p.elementKind[i], id)))));
  }

  /** Chosen pairs are solid; of other parts only penetrating elements. */
  private lookOf(p: Part3D): PartLook {
    if (this.hidden.has(p)) return "hidden";
    if (this.isolated && !this.isolated.has(p)) return this.context > 0 && !this.on.rest ? "ghost" : "hidden";
    if (this.crossing) return "hot";
    const chosen = this.isolated !== null && (this.report.selected !== null || this.report.filter.pair !== null || this.report.filter.interface === null);
    const tie = this.report.filter.interface !== null && this.report.tieOf(this.report.filter.interface) !== null;
    if (this.on.solid || chosen || (this.isolated && tie) || this.report.filtered.length === 0) return "solid";
    return this.on.rest ? "only" : "hot";
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

  /** Section plane through the chosen row, normal to its surface. */
  private cutThroughRow(): Cut | null {
    const x = this.report.selected;
    if (!x || !this.view) return null;
    const n = wayOut(this.report, x.row);
    const side = new Vector3().crossVectors(n, Math.abs(n.z) < 0.8 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
    return side.lengthSq() > 0 ? { normal: side, at: this.view.clipThrough(pointOf(this.report, x.row), side) } : null;
  }

  // ---- what is shown ------------------------------------------------------------------------

  private color(t: number): [number, number, number] {
    return colorOf(this.look, t);
  }

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
    this.legend.element.hidden = !legend;
    if (legend) this.legend.draw(legend.title, this.contour!, this.isolated && this.contextSlider());
    this.largest = legend && this.look.maximum ? largestOf(this.contour!, this.look.contour) : null;
    this.placeLabels();
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
