// Colour scale: title with unit, ticks, and options: map, steps, limits, equal ratios, label of the largest value.
import type { Units } from "schema/page";
import { colorAt, contourNames, cssColor, mapNames, ofCycle, type ContourKind, type Look, type MapName } from "../look";
import { h, num, replace } from "../dom";
import type { Contour } from "./contour";

const prefixes: Record<string, number> = { "": 1, G: 1e9, M: 1e6, k: 1e3, d: 0.1, c: 0.01, m: 1e-3, u: 1e-6, mu: 1e-6, n: 1e-9 };
function inSI(unit: string, base: string, value: number): number | null {
  const prefix = unit.endsWith(base) ? prefixes[unit.slice(0, unit.length - base.length)] : undefined;
  return prefix === undefined ? null : prefix * value;
}
/** "kN" if the units give it, else composed: "g·mm/s²". */
export function forceUnit(u: Units): string {
  const [mass, length, time] = [inSI(u.mass, "g", 1e-3), inSI(u.length, "m", 1), inSI(u.time, "s", 1)];
  if (mass !== null && length !== null && time !== null) {
    const newton = (mass * length) / time ** 2;
    for (const [name, value] of [["N", 1], ["kN", 1e3], ["MN", 1e6], ["mN", 1e-3], ["GN", 1e9], ["uN", 1e-6]] as const)
      if (Math.abs(newton / value - 1) < 1e-9) return name;
  }
  return `${u.mass}·${u.length}/${u.time}²`;
}

function unitOf(kind: ContourKind, u: Units | null): string {
  if (!u) return "";
  if (kind === "none" || kind === "depth" || kind === "gap") return u.length;
  if (kind === "step" || kind === "element") return u.time;
  return kind === "force" ? forceUnit(u) : kind === "stiffness" ? `${forceUnit(u)}/${u.length}` : "";
}

export const titleOf = (kind: ContourKind, units: Units | null): string => {
  const unit = unitOf(kind, units);
  return contourNames[kind === "none" ? "depth" : kind] + (unit ? ` (${unit})` : "");
};

/** Colour at a position of the scale. */
export function colorOf(look: Look, t: number): [number, number, number] {
  return colorAt(look.map, look.bands > 0 ? (Math.min(look.bands - 1, Math.floor(t * look.bands)) + 0.5) / look.bands : t);
}

const steps = [0, 4, 6, 8, 9, 10, 12];

export class Legend {
  readonly element = h("div", { class: "legend" });
  private open = false;

  constructor(private readonly look: Look, private readonly change: (change: Partial<Look>) => void) {}

  /** `title`: null where no value has a colour; `sides`: what the colours of parts mean. */
  draw(title: string | null, contour: Contour, context: Node | null, sides: Node | null): void {
    const { look } = this;
    this.open = this.element.querySelector<HTMLDetailsElement>(".legend-limits")?.open ?? this.open;
    const stops = Array.from({ length: 33 }, (_, i) => {
      const [r, g, b] = colorOf(look, Math.min(i / 32, 0.9999));
      return `rgb(${r} ${g} ${b}) ${(100 * i) / 32}%`;
    });
    const maps = h("select", { "aria-label": "Colour map", title: "Colour map", onchange: () => this.change({ map: maps.value as MapName }) },
      ...mapNames.map((m) => h("option", { value: m, selected: m === look.map }, m)));
    const bands = h("select", { class: "legend-steps", "aria-label": "Steps of colour", title: "Steps of colour", onchange: () => this.change({ bands: Number(bands.value) }) },
      ...steps.map((n) => h("option", { value: n, selected: n === look.bands }, n === 0 ? "smooth" : `${n} steps`)));
    replace(this.element, ...(title === null ? [] : [
      h("div", { class: "legend-title" }, title),
      h("div", { class: "legend-scale" }, h("div", { class: "legend-bar", style: `background:linear-gradient(to top, ${stops.join(",")})` }),
        h("div", { class: "legend-ticks" }, ...[1, 0.75, 0.5, 0.25, 0].map((t) => h("span", null, contour.tick(t))))),
      h("div", { class: "legend-options" }, maps, bands),
      contour.scaled ? this.limits(contour) : null]), sides,
      context && h("label", { class: "legend-options", title: "How much of the other parts is seen beside what is chosen" }, "context", context));
    this.element.style.setProperty("--low", cssColor(look.map, 0));
  }

  private limits(contour: Contour): HTMLElement {
    const { look } = this;
    const { low, high } = contour.scaled!;
    const field = (name: "low" | "high", now: number) => {
      const input = h("input", { type: "number", step: "any", class: `legend-${name}`, "aria-label": name === "low" ? "Lower limit" : "Upper limit", value: Number(now.toPrecision(4)), onchange: () => {
        const v = Number(input.value);
        this.change({ [name]: input.value === "" || !Number.isFinite(v) ? null : v });
      } });
      return input;
    };
    const box = (name: "log" | "maximum", label: string, title: string) => {
      const input = h("input", { type: "checkbox", class: `legend-${name}`, checked: look[name], onchange: () => this.change({ [name]: input.checked }) });
      return h("label", { class: "check", title }, input, label);
    };
    const own = look.low !== null || look.high !== null || look.log;
    return h("details", { class: "legend-limits", open: this.open },
      h("summary", null, own ? "limits (own)" : "limits"),
      h("div", { class: "legend-options" }, field("low", low), "to", field("high", high)),
      h("div", { class: "legend-options" }, box("log", "log", "Equal ratios in place of equal differences"), box("maximum", "label the maximum", "Says the largest value where it is"),
        own && h("button", { type: "button", class: "link", onclick: () => this.change({ low: null, high: null, log: false }) }, "reset")));
  }
}

/** The colours between other limits, or by equal ratios; values beyond a limit have its colour. */
export function rescaled(c: Contour, look: Look, kind: ContourKind): Contour {
  if (kind === "step" || kind === "element") return c; // ratios already, the smallest is the hottest
  let least = Infinity;
  if (look.log && look.low === null)
    for (const v of c.values ?? []) if (v > 0 && v < least) least = v;
  const high = look.high ?? c.top;
  const low = look.low ?? (look.log ? (Number.isFinite(least) ? least * c.top : c.top / 1000) : 0);
  const plain = { ...c, scaled: { low, high } };
  const log = look.log && low > 0;
  if (!(high > low) || (look.low === null && look.high === null && !log)) return plain;
  const place = (t: number) => {
    const v = t * c.top;
    return Math.min(1, Math.max(0, log ? (v > 0 ? Math.log(v / low) / Math.log(high / low) : 0) : (v - low) / (high - low)));
  };
  return {
    ...plain, of: (x) => place(c.of(x)), values: c.values && c.values.map((v) => (Number.isNaN(v) ? v : place(v))), unscaled: c.values,
    tick: (t) => num(log ? low * (high / low) ** t : low + (high - low) * t, 3),
  };
}

/** Page node of the largest value, and its text; null without values. */
export function largestOf(c: Contour, kind: ContourKind): { node: number; text: string } | null {
  const values = c.unscaled ?? c.values;
  if (!values) return null;
  let node = -1;
  for (let i = 0; i < values.length; i++) if (values[i] > (node < 0 ? -Infinity : values[node])) node = i;
  if (node < 0) return null;
  const smallest = kind === "step" || kind === "element";
  return { node, text: smallest ? `smallest ${c.tick(values[node])}` : `largest ${num(values[node] * c.top, 4)}` };
}

/** True if there are values of a kind. */
export const hasValues = (kind: ContourKind, steps: boolean, acted: boolean, rows: boolean): boolean =>
  kind === "element" ? steps : ofCycle(kind) ? acted : kind === "gap" || kind === "edge" || rows;
