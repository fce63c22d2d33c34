// Conversions of the deck in the page: what `deck convert` makes of it, with its losses, to be saved or taken over.
import { button, h, plural, replace } from "../../viewer/src/dom";
import type { Result } from "./engine";
import { save } from "./files";
import { takenOver } from "./repair";
import { zipped } from "./tree";

const folder = "converted";
const versions = ["2026", "2025", "2024", "2023", "2022", "2021", "2020", "2019", "2018", "2017", "140", "130", "120", "110"];
const units = ["kg,mm,ms", "Mg,mm,s", "kg,m,s", "g,mm,ms"];

interface Entry {
  file: string;
  line: number;
  keyword: string;
  id: number;
  field: string;
  old: string;
  new: string;
  note: string;
}
type Kind = "undecided" | "dropped" | "approximated" | "kept";
type Losses = Record<Kind, Entry[]>;
const kinds: [Kind, string][] = [["undecided", "To be decided by you"], ["dropped", "Lost"], ["approximated", "Approximated"], ["kept", "Changed, with the same meaning"]];
const mostRows = 500;

export interface ConvertHost {
  main: () => string;
  stem: () => string;
  get: (name: string) => Uint8Array | undefined;
  run: (args: string[]) => Promise<Result | null>;
  take: (files: Record<string, Uint8Array>) => void;
  go: (file: string, line: number) => void;
}

const text = (b: Uint8Array | undefined) => new TextDecoder().decode(b);
const line = (option: string, holder: string, more = {}) => h("input", { type: "text", "data-option": option, placeholder: holder, autocomplete: "off", spellcheck: "false", ...more });
const tick = (option: string) => h("input", { type: "checkbox", "data-option": option });

export class ConvertView {
  readonly element = h("div", { class: "output-page" });
  private readonly version = h("select", { "data-option": "--version" }, h("option", { value: "" }, "unchanged"), ...versions.map((v) => h("option", { value: v }, v)));
  private readonly units = line("--units", "unchanged", { list: "unit-systems" });
  private readonly ids = line("--renumber", "unchanged");
  private readonly only = line("--extract-contacts", "all");
  private readonly ticks = { "--expand-type19": tick("--expand-type19"), "--resolve-defaults": tick("--resolve-defaults"), "--flatten": tick("--flatten") };
  private readonly losses = tick("--allow-loss");
  private readonly out = h("div", { class: "conversion", tabindex: "0", role: "region", "aria-label": "Result of the conversion" });
  private readonly take = button("Take it over", null, () => this.host.take(this.changed), { hidden: true });
  private readonly download = button("Download", null, () => this.save(), { hidden: true });
  private readonly report = button("Report (JSON)", null, () => save(`${this.host.stem()}.losses.json`, this.said, "application/json"), { hidden: true });
  private changed: Record<string, Uint8Array> = {};
  private written: Record<string, Uint8Array> = {};
  private said = "";

  constructor(private readonly host: ConvertHost) {
    const field = (label: string, input: HTMLElement, tip: string) => h("label", { title: tip }, h("span", null, label), input);
    const choice = (label: string, input: HTMLElement, tip: string) => h("label", { class: "tick", title: tip }, input, h("span", null, label));
    const form = h("form", { class: "conversions", "aria-label": "Conversions", onsubmit: (e: Event) => {
      e.preventDefault();
      void this.convert();
    } },
      field("Input version", this.version, "deck convert --version: rewrites every block whose columns differ"),
      field("Unit system", this.units, "deck convert --units: mass,length,time, such as kg,mm,ms, or factors to kg, m, s"),
      field("New ids", this.ids, "deck convert --renumber: node+1000 shifts, part=1 counts from 1 on; several with a comma"),
      field("Only the interfaces", this.only, "deck convert --extract-contacts: their ids; the deck then holds only what they need"),
      choice("TYPE19 as TYPE7 and TYPE11", this.ticks["--expand-type19"], "deck convert --expand-type19"),
      choice("Effective values on the cards", this.ticks["--resolve-defaults"], "deck convert --resolve-defaults: /DEFAULT/INTER is not needed any more"),
      choice("One file without includes", this.ticks["--flatten"], "deck convert --flatten"),
      choice("Also if values are lost", this.losses, "deck convert --allow-loss --partial: what is lost or left as it is, is listed"),
      h("button", { class: "primary" }, "Convert"), this.take, this.download, this.report,
      h("datalist", { id: "unit-systems" }, ...units.map((u) => h("option", { value: u }))));
    this.reset();
    this.element.append(form, this.out);
  }

  /** The text is another one: what was converted is the old one. */
  reset(): void {
    this.forget();
    replace(this.out, h("p", { class: "muted" }, "Choose what to change. The result is read again and compared with the deck; the deck stays as it is until you take it over, and Undo takes it back."));
  }

  private forget(): void {
    for (const b of [this.take, this.download, this.report]) b.hidden = true;
    this.changed = this.written = {};
    this.said = "";
  }

  /** Options as the program takes them; empty: nothing is chosen. */
  private options(): string[] {
    const value = (option: string, given: string) => (given.trim() ? [option, given.replace(/\s+/g, "")] : []);
    const version = value("--version", this.version.value);
    const system = value("--units", this.units.value);
    const ids = value("--renumber", this.ids.value);
    const ticked = Object.entries(this.ticks).flatMap(([option, e]) => (e.checked ? [option] : []));
    const all = [...value("--extract-contacts", this.only.value), ...ticked, ...version, ...system, ...ids];
    if (!this.losses.checked) return all;
    // Each of the two goes with some conversions only.
    if (version.length > 0 || system.length > 0 || this.ticks["--resolve-defaults"].checked) all.push("--allow-loss");
    if (system.length > 0 || ids.length > 0) all.push("--partial");
    return all;
  }

  private async convert(): Promise<void> {
    this.forget();
    const options = this.options();
    if (options.length === 0) return replace(this.out, h("p", { role: "status" }, "Nothing is chosen: the deck would stay as it is."));
    replace(this.out, h("p", { class: "muted", role: "status" }, "The deck is being converted \u2026"));
    const main = this.host.main();
    const r = await this.host.run(["convert", main, ...options, "--verify", "-o", folder, "--report", "losses.json"]);
    if (!r) return this.reset();
    this.written = Object.fromEntries(Object.entries(r.files).flatMap(([n, b]) => (n.startsWith(`${folder}/`) ? [[n.slice(folder.length + 1), b]] : [])));
    this.changed = takenOver(folder, main, this.host.get, r.files);
    this.said = text(r.files["losses.json"]);
    this.draw(r);
  }

  private draw(r: Result): void {
    const made = Object.keys(this.written).length;
    const differ = Object.keys(this.changed).length;
    this.download.hidden = made === 0;
    this.take.hidden = differ === 0;
    this.report.hidden = this.said === "";
    const losses = this.said ? (JSON.parse(this.said) as Losses) : null;
    const told = (text(r.stdout) + text(r.stderr)).trim();
    const result = made === 0 ? `Nothing was written.${losses ? " The conversion would do this:" : ""}` : `${plural(differ, "file is", "files are")} changed${made > differ ? `, ${made - differ} unchanged` : ""}.`;
    replace(this.out, h("p", { role: "status", class: "conversion-result", "data-exit": String(r.exitCode) }, result), told && h("pre", { class: made === 0 ? "bad" : "" }, told), ...(losses ? kinds.map(([k, says]) => this.list(k, says, losses[k])) : []));
  }

  private list(kind: Kind, says: string, entries: Entry[]): HTMLElement | null {
    if (entries.length === 0) return null;
    const row = (e: Entry) => {
      const place = `${e.file}:${e.line}`;
      const known = e.line > 0 && this.host.get(e.file) !== undefined;
      return h("tr", null, h("td", null, known ? h("button", { type: "button", class: "link", onclick: () => this.host.go(e.file, e.line) }, place) : place), h("td", null, e.id > 0 ? `${e.keyword}/${e.id}` : e.keyword), h("td", null, e.field), h("td", null, e.old), h("td", null, e.new), h("td", null, e.note));
    };
    const more = entries.length - mostRows;
    return h("details", { open: kind !== "kept", "data-kind": kind }, h("summary", null, `${says} (${entries.length})`),
      h("table", { class: "plain" }, h("thead", null, h("tr", null, ...["Place", "Card", "Field", "Old", "New", "Why"].map((t) => h("th", { scope: "col" }, t)))), h("tbody", null, ...entries.slice(0, mostRows).map(row))),
      more > 0 && h("p", { class: "muted" }, `${more} more are in the report.`));
  }

  private save(): void {
    const names = Object.keys(this.written);
    if (names.length === 1) save(names[0].slice(names[0].lastIndexOf("/") + 1), this.written[names[0]], "text/plain");
    else save(`${this.host.stem()}_converted.zip`, zipped(this.written), "application/zip");
  }
}
