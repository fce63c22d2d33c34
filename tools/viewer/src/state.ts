// State of the view as text after the '#' of the address, so that links open an equal view; undo is a list of these texts.
import { fieldNames, type Overrides } from "./card";
import type { ContourKind, Look, MapName } from "./look";
import type { Filter, Report, Status } from "./report";
import type { Viewport } from "./scene/viewport";

interface Table {
  state: string;
}

export class ViewState {
  private past: string[] = [];
  private undone: string[] = [];
  private now = "";
  private timer = 0;

  constructor(
    private readonly report: Report,
    private readonly viewport: Viewport,
    private readonly look: Look,
    private readonly changeLook: (change: Partial<Look>) => void,
    private readonly tables: Record<string, Table>,
    private readonly changed: (canUndo: boolean, canRedo: boolean) => void,
  ) {
    for (const topic of ["filter", "selection", "results", "look"] as const) report.on(topic, () => this.note());
    window.addEventListener("hashchange", () => {
      const text = location.hash.slice(1);
      if (text.includes("=") && text !== this.now) this.apply(text);
    });
  }

  /** Called after possible changes: updates the address when the view is at rest. */
  note(): void { clearTimeout(this.timer); this.timer = window.setTimeout(() => this.write(), 250); }

  /** Applies the address of the page; false if it is empty. */
  open(): boolean {
    const text = location.hash.slice(1);
    if (text.includes("=")) this.apply(text);
    this.now = withoutCamera(this.text()); // the first view needs no undo; it enters the address after drawing
    return text.includes("=");
  }

  undo(): void { this.step(this.past, this.undone); }
  redo(): void { this.step(this.undone, this.past); }
  private step(from: string[], to: string[]): void {
    clearTimeout(this.timer);
    this.write();
    const text = from.pop();
    if (text === undefined) return;
    to.push(this.now);
    this.apply(text);
    this.now = this.text();
    this.address();
    this.changed(this.past.length > 0, this.undone.length > 0);
  }

  private write(): void {
    const text = this.text();
    if (text === this.now) return;
    // Turning the picture is not a step of undo.
    if (withoutCamera(text) !== withoutCamera(this.now)) { this.past.push(this.now); this.undone = []; }
    if (this.past.length > 200) this.past.shift();
    this.now = text;
    this.address();
    this.changed(this.past.length > 0, this.undone.length > 0);
  }
  private address(): void {
    try {
      history.replaceState(null, "", `#${this.now}`);
    } catch {
      // A framed page may not change its address.
    }
  }

  private text(): string {
    const { report } = this;
    const f = report.filter;
    const out = new URLSearchParams();
    const set = (key: string, value: string | null | false | undefined) => value && out.set(key, value);
    set("interface", f.interface !== null && String(report.meta.interfaces[f.interface].id));
    set("pair", f.pairs?.map((pair) => pair.map((p) => report.partId(p)).join("-")).join(","));
    set("depth", f.depth?.join("-to-"));
    set("ratio", f.ratio?.join("-to-"));
    set("status", f.status);
    set("find", f.text);
    set("roundoff", f.roundOff && "yes");
    set("rows", !f.perNode && "all");
    set("row", report.selected?.key);
    report.overrides.forEach((o, i) => set(`card.${report.meta.interfaces[i].id}`, Object.entries(o).map(([k, v]) => `${k}:${v}`).join(",")));
    set("colours", this.look.contour !== "depth" && this.look.contour);
    set("map", this.look.map !== "heat" && this.look.map);
    set("steps", this.look.bands > 0 && String(this.look.bands));
    set("low", this.look.low !== null && String(this.look.low));
    set("high", this.look.high !== null && String(this.look.high));
    set("log", this.look.log && "yes");
    set("maximum", this.look.maximum && "yes");
    set("theme", this.look.dark ? "dark" : "light");
    for (const [name, table] of Object.entries(this.tables)) set(`table.${name}`, table.state);
    for (const [key, value] of Object.entries(this.viewport.state)) set(`view.${key}`, value);
    return out.toString();
  }

  private apply(text: string): void {
    const { report } = this;
    const given = new URLSearchParams(text);
    const range = (key: string): [number, number] | null => {
      const [a, b] = (given.get(key) ?? "").split("-to-").map(Number);
      return b > a ? [a, b] : null;
    };
    const at = report.meta.interfaces.findIndex((i) => String(i.id) === given.get("interface"));
    const part = (id: string) => (id === "0" ? -1 : report.meta.parts.findIndex((p) => String(p.id) === id));
    const pairs = (given.get("pair") ?? "").split(",").map((p) => p.split("-").map(part)).flatMap(([s, m]): [number, number][] => (m === undefined ? [] : [[s, m]]));
    const overrides = report.meta.interfaces.map((inter) => {
      const out: Overrides = {};
      for (const item of (given.get(`card.${inter.id}`) ?? "").split(",")) {
        const [k, v] = item.split(":");
        const field = fieldNames.find((n) => n === k);
        if (field && Number.isFinite(Number(v))) out[field] = Number(v);
      }
      return out;
    });
    report.setOverrides(overrides);
    const filter: Filter = {
      interface: at < 0 ? null : at, pairs: pairs.length > 0 ? pairs : null, depth: range("depth"), ratio: range("ratio"),
      status: (given.get("status") as Status | null) ?? null, text: given.get("find") ?? "", roundOff: given.get("roundoff") === "yes", perNode: given.get("rows") !== "all",
    };
    report.setFilter(filter);
    report.select(report.hits.find((x) => x.key === given.get("row")) ?? null);
    const limit = (key: string) => (given.has(key) && Number.isFinite(Number(given.get(key))) ? Number(given.get(key)) : null);
    this.changeLook({
      contour: (given.get("colours") as ContourKind | null) ?? "depth", map: (given.get("map") as MapName | null) ?? "heat",
      bands: Number(given.get("steps") ?? 0), dark: given.get("theme") === "dark",
      low: limit("low"), high: limit("high"), log: given.get("log") === "yes", maximum: given.get("maximum") === "yes",
    });
    for (const [name, table] of Object.entries(this.tables)) table.state = given.get(`table.${name}`) ?? "";
    const view: Record<string, string> = {};
    for (const [k, v] of given) if (k.startsWith("view.")) view[k.slice(5)] = v;
    this.viewport.state = view;
    this.now = this.text();
  }
}

const withoutCamera = (text: string): string => text.replace(/&?view\.camera=[^&]*/, "");
