// Effective values as a matrix: fields down, interfaces across; ids and figures as the program printed them.
import { h, replace } from "../../viewer/src/dom";

export interface Source {
  file: string;
  line: number;
  column: number;
  end_column: number;
}
export interface Parameter {
  input: unknown;
  value: unknown;
  origin: string;
  source?: Source | null;
}
export interface ParamsDocument {
  interfaces: { id: number; type: number; title: string; source: { file: string; line: number }; parameters: Record<string, Parameter> }[];
}

/** Values as the program printed them: ids whole, no figure formed anew. */
export function asPrinted(key: string, v: unknown, at?: { source?: string }): unknown {
  return (key === "value" || key === "input") && typeof v === "number" ? (at?.source ?? String(v)) : v;
}

const textOf = (v: unknown): string => (v === null || v === undefined ? "\u2013" : typeof v === "string" ? v : JSON.stringify(v));

export class Values {
  readonly element = h("div", { class: "values" });
  private readonly search = h("input", { type: "search", placeholder: "Field or interface", "aria-label": "Filter values" });
  private readonly which = h("select", { "aria-label": "Which fields" },
    h("option", { value: "card" }, "what the cards say"), h("option", { value: "derived" }, "what is not from a card"), h("option", { value: "differs" }, "what differs between interfaces"), h("option", { value: "all", selected: true }, "all fields"));
  private readonly table = h("div", { class: "values-scroll", tabindex: 0, role: "region", "aria-label": "Values" });
  document: ParamsDocument | null = null;

  /** `go` opens the place of a value in the text. */
  constructor(private readonly go: (s: Source, keyword: string, id: number) => void) {
    for (const [e, event] of [[this.search, "input"], [this.which, "change"]] as const) e.addEventListener(event, () => this.draw());
    this.element.append(h("div", { class: "list-tools" }, this.search, this.which), this.table);
  }

  show(document: ParamsDocument): void {
    this.document = document;
    this.draw();
  }

  private draw(): void {
    const all = this.document?.interfaces ?? [];
    if (all.length === 0) return replace(this.table, h("p", null, "This deck has no contact interface that deck knows."));
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const named = (i: (typeof all)[0]) => `type${i.type} ${i.id} ${i.title}`.toLowerCase();
    // Words name fields where a field has them, else interfaces.
    const fields = [...new Set(all.flatMap((i) => Object.keys(i.parameters)))];
    const ofFields = words.filter((w) => fields.some((f) => f.toLowerCase().includes(w)));
    const rest = words.filter((w) => !ofFields.includes(w));
    const shown = all.filter((i) => rest.every((w) => named(i).includes(w)));
    const which = this.which.value;
    const rows = fields.filter((f) => ofFields.every((w) => f.toLowerCase().includes(w))).filter((f) => {
      const cells = shown.map((i) => i.parameters[f]).filter((p) => p !== undefined);
      if (which === "card") return cells.some((p) => p.origin === "card");
      if (which === "derived") return cells.some((p) => p.origin !== "card");
      return which === "all" ? cells.length > 0 : new Set(cells.map((p) => textOf(p.value))).size > 1;
    });
    replace(this.table, h("p", { class: "muted" }, `${rows.length} of ${fields.length} fields, ${shown.length} of ${all.length} interfaces. Bold: the card says so; plain: a default, in the tip from where. A click opens the place.`),
      h("table", { class: "plain matrix-values" },
        h("thead", null, h("tr", null, h("th", { scope: "col" }, "Field"), ...shown.map((i) => h("th", { scope: "col", title: i.title }, `TYPE${i.type} ${i.id}`, h("span", { class: "muted" }, i.title))))),
        h("tbody", null, ...rows.map((f) => h("tr", null, h("th", { scope: "row" }, f), ...shown.map((i) => this.cell(f, i)))))));
  }

  private cell(field: string, inter: ParamsDocument["interfaces"][0]): HTMLElement {
    const p = inter.parameters[field];
    if (!p) return h("td", { class: "none" });
    const text = textOf(p.value);
    const title = `${field} of TYPE${inter.type} ${inter.id}: ${p.origin === "card" ? "on the card" : `${p.origin}${p.input === null ? ", the card is blank" : `; the card says ${textOf(p.input)}`}`}${p.source ? ` (${p.source.file}:${p.source.line})` : ""}`;
    const { source } = p;
    return h("td", { class: p.origin === "card" ? "own" : "", "data-field": field, "data-interface": inter.id, title },
      source ? h("button", { type: "button", class: "link", onclick: () => this.go(source, `/INTER/TYPE${inter.type}`, inter.id) }, text) : text);
  }
}
