// Findings of a deck: the list, and one of them beside the text.
import { button, h, plural, replace } from "../../viewer/src/dom";
import type { Edit } from "./tree";

export interface Finding {
  rule: string;
  field: string;
  severity: string;
  file: string;
  line: number;
  column: number;
  end_column: number;
  message: string;
  reference_behaviour: string | null;
  help: string | null;
  entity: { keyword: string; id: number } | null;
  notes: { file: string; line: number; column: number; end_column: number; message: string }[];
  fix: { title: string; safe: boolean; edits: Edit[] } | null;
  fingerprint: string;
}
export interface LintDocument {
  deck: { path: string; title: string; version: number; counts: Record<string, number>; includes: unknown[] };
  diagnostics: Finding[];
  summary: Record<string, number>;
}

const severities = ["error", "warning", "info"];
const rank = (s: string) => (severities.includes(s) ? severities.indexOf(s) : severities.length);

/** What `deck rules --json` says of a rule, as far as it is shown here. */
export interface Rule {
  id: string;
  title: string;
  found_by: string;
}
/** In this order the program looks: what it finds early can be the cause of what it finds later. */
const stages = ["reading", "model", "check", "linter", "gate", "geometry"];

interface Group {
  key: string;
  title: string;
  findings: Finding[];
  stage: number;
}
type GroupBy = "rule" | "interface" | "none";

/** "DK201:Istf" where a rule says the same of several fields. */
const nameOf = (f: Finding): string => (f.field ? `${f.rule}:${f.field}` : f.rule);
const interfaceOf = (f: Finding): string => (f.entity?.keyword.startsWith("/INTER/") ? `${f.entity.keyword}/${f.entity.id}` : "");

export class FindingList {
  readonly element = h("div", { class: "finding-list" });
  private readonly list = h("ol", { class: "findings", "aria-label": "Findings" });
  private readonly search = h("input", { type: "search", placeholder: "Filter findings", "aria-label": "Filter findings" });
  private readonly by = h("select", { "aria-label": "Group findings" }, h("option", { value: "rule" }, "by rule"), h("option", { value: "interface" }, "by interface"), h("option", { value: "none" }, "one list"));
  private readonly chips = h("span", { class: "severity-chips" });
  private readonly count = h("span", { class: "muted count", role: "status" });
  private all: Finding[] = [];
  private most = 300;
  private only: string | null = null;
  private readonly opened = new Map<string, boolean>();
  private rules = new Map<string, Rule>();
  selected: Finding | null = null;
  /** Somebody chose what is shown: what comes later does not take its place. */
  chosen = false;

  constructor(private readonly choose: (f: Finding) => void) {
    this.search.addEventListener("input", () => this.draw());
    this.by.addEventListener("change", () => this.draw());
    this.list.addEventListener("keydown", (e) => {
      const step = e.key === "ArrowDown" ? 1 : e.key === "ArrowUp" ? -1 : 0;
      if (step === 0) return;
      e.preventDefault();
      const items = [...this.list.querySelectorAll<HTMLButtonElement>("button.finding")].filter((b) => b.closest("details")?.open !== false);
      items[Math.max(0, Math.min(items.length - 1, items.indexOf(document.activeElement as HTMLButtonElement) + step))]?.focus();
    });
    this.element.append(h("div", { class: "list-tools" }, this.search, this.by), h("div", { class: "list-tools" }, this.chips, this.count), this.list);
  }

  setRules(rules: Rule[]): void {
    this.rules = new Map(rules.map((r) => [r.id, r]));
    this.draw();
  }

  show(findings: Finding[]): void {
    this.all = [...findings].sort((a, b) => rank(a.severity) - rank(b.severity));
    const old = this.selected;
    this.selected = old ? (this.all.find((f) => f.fingerprint === old.fingerprint && f.line === old.line && f.column === old.column) ?? this.all.find((f) => f.fingerprint === old.fingerprint) ?? null) : null;
    this.draw();
  }

  private stage(f: Finding): number {
    const at = stages.indexOf(this.rules.get(f.rule)?.found_by ?? "");
    return at < 0 ? stages.length : at;
  }
  /** Errors first, and among what is equally severe what the program finds earlier: causes before what follows from them. */
  private groups(found: Finding[]): Group[] {
    const by = this.by.value as GroupBy;
    const groups = new Map<string, Group>();
    for (const f of found) {
      const key = by === "rule" ? f.rule : by === "interface" ? interfaceOf(f) : "";
      const title = by === "rule" ? (this.rules.get(f.rule)?.title ?? "") : key === "" ? "Not of an interface" : "";
      const g = groups.get(key) ?? { key, title, findings: [], stage: stages.length };
      groups.set(key, g);
      g.findings.push(f);
      g.stage = Math.min(g.stage, this.stage(f));
    }
    const worst = (g: Group) => Math.min(...g.findings.map((f) => rank(f.severity)));
    return [...groups.values()].sort((a, b) => worst(a) - worst(b) || a.stage - b.stage || a.key.localeCompare(b.key, "en", { numeric: true }));
  }

  private draw(): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const said = this.all.filter((f) => words.every((w) => `${nameOf(f)} ${f.severity} ${f.message} ${f.file} ${f.entity?.keyword ?? ""}/${f.entity?.id ?? ""}`.toLowerCase().includes(w)));
    const found = said.filter((f) => this.only === null || f.severity === this.only);
    this.count.textContent = plural(found.length, "finding", "findings");
    replace(this.chips, ...severities.map((s) => {
      const n = said.filter((f) => f.severity === s).length;
      return n === 0 ? null : h("button", { type: "button", class: `severity ${s}`, "aria-pressed": this.only === s ? "true" : "false", title: `Only these: ${s}`, onclick: () => {
        this.only = this.only === s ? null : s;
        this.draw();
      } }, plural(n, s, `${s}s`));
    }));
    const focused = this.list.contains(document.activeElement);
    const shown = found.slice(0, this.most);
    const groups = this.by.value === "none" ? [] : this.groups(shown);
    const few = shown.length <= 12 || words.length > 0 || groups.length === 1;
    replace(
      this.list,
      ...(this.by.value === "none" ? shown.map((f) => this.item(f)) : groups.map((g, i) => this.group(g, few || i === 0, groups))),
      found.length > this.most && h("li", null, button(`Show all ${found.length}`, null, () => {
        this.most = found.length;
        this.draw();
      })),
    );
    if (focused) this.list.querySelector<HTMLElement>("[aria-current]")?.focus();
  }

  private group(g: Group, open: boolean, all: Group[]): HTMLElement {
    const worst = g.findings.reduce((a, b) => (rank(b.severity) < rank(a.severity) ? b : a)).severity;
    // While files are missing, what is said of what is not there may follow from that.
    const missing = all.some((x) => x.findings.some((f) => f.rule === "DK004"));
    const follows = missing && g.stage > stages.indexOf("reading");
    const details = h("details", { class: "finding-group", open: this.opened.get(g.key) ?? (g.findings.includes(this.selected as Finding) || (open && !follows)) },
      h("summary", { onclick: () => this.opened.set(g.key, !details.open) }, h("span", { class: `severity ${worst}` }, String(g.findings.length)), h("b", null, g.key), h("span", { class: "muted" }, ` ${g.title}${follows ? " (may follow from the missing files)" : ""}`)),
      h("ol", null, ...g.findings.map((f) => this.item(f))));
    return h("li", { "data-group": g.key }, details);
  }

  private item(f: Finding): HTMLElement {
    return h("li", null, h(
      "button", { type: "button", class: `finding ${f.severity}`, "aria-current": f === this.selected ? "true" : null, onclick: () => this.pick(f, true) },
      h("span", { class: "finding-head" }, h("b", null, `${f.severity} ${nameOf(f)}`), h("span", { class: "muted" }, ` ${f.file}:${f.line}:${f.column}`)),
      h("span", { class: "finding-text" }, f.message),
    ));
  }

  reset(): void {
    this.selected = null;
    this.chosen = false;
    this.only = null;
    this.opened.clear();
  }

  /** The worst, of these the one found first. */
  pickFirst(): void {
    const first = this.groups(this.all)[0]?.findings[0];
    if (first) this.pick(first, false);
  }

  private pick(f: Finding, chosen: boolean): void {
    this.selected = f;
    this.chosen = chosen;
    this.draw();
    this.choose(f);
  }
}

/** What a finding says, with what can be done about it. */
export function drawFinding(into: HTMLElement, f: Finding, on: { explain: (rule: string) => void; fix: (f: Finding) => void; picture: (() => void) | null; go: (file: string, line: number, column: number, end: number) => void }): void {
  replace(
    into,
    h("h2", null, h("span", { class: `severity ${f.severity}` }, f.severity), button(nameOf(f), null, () => on.explain(f.rule), { class: "link rule", title: "What this rule says" })),
    h("p", { class: "message" }, f.message),
    f.reference_behaviour && h("p", { class: "note" }, `Solver: ${f.reference_behaviour}`),
    f.help && h("p", { class: "note" }, `Help: ${f.help}`),
    ...f.notes.map((n) => h("p", { class: "note" }, `${n.message} `, button(`${n.file}:${n.line}`, null, () => on.go(n.file, n.line, n.column, n.end_column), { class: "link" }))),
    on.picture && h("p", { class: "buttons" }, button("Show in the picture", "camera", on.picture, { class: "small to-picture" })),
    f.fix && h("p", { class: "buttons" }, button(`${f.fix.safe ? "Fix" : "Fix (changes the meaning)"}: ${f.fix.title}`, null, () => on.fix(f), { class: "fix" })),
  );
}
