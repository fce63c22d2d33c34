// Findings of a deck: the list, and one of them beside the text.
import { button, h, plural, replace } from "../../viewer/src/dom";
import type { Edit } from "./tree";

export interface Finding {
  rule: string;
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

export class FindingList {
  readonly element = h("div", { class: "finding-list" });
  private readonly list = h("ol", { class: "findings", "aria-label": "Findings" });
  private readonly search = h("input", { type: "search", placeholder: "Filter findings", "aria-label": "Filter findings" });
  private readonly count = h("span", { class: "muted count", role: "status" });
  private all: Finding[] = [];
  private most = 300;
  selected: Finding | null = null;
  /** Somebody chose what is shown: what comes later does not take its place. */
  chosen = false;

  constructor(private readonly choose: (f: Finding) => void) {
    this.search.addEventListener("input", () => this.draw());
    this.list.addEventListener("keydown", (e) => {
      const step = e.key === "ArrowDown" ? 1 : e.key === "ArrowUp" ? -1 : 0;
      if (step === 0) return;
      e.preventDefault();
      const items = [...this.list.querySelectorAll("button")];
      items[Math.max(0, Math.min(items.length - 1, items.indexOf(document.activeElement as HTMLButtonElement) + step))]?.focus();
    });
    this.element.append(h("div", { class: "list-tools" }, this.search, this.count), this.list);
  }

  show(findings: Finding[]): void {
    this.all = [...findings].sort((a, b) => rank(a.severity) - rank(b.severity));
    const old = this.selected;
    this.selected = old ? (this.all.find((f) => f.fingerprint === old.fingerprint && f.line === old.line && f.column === old.column) ?? this.all.find((f) => f.fingerprint === old.fingerprint) ?? null) : null;
    this.draw();
  }

  private draw(): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.all.filter((f) => words.every((w) => `${f.rule} ${f.severity} ${f.message} ${f.file} ${f.entity?.keyword ?? ""}/${f.entity?.id ?? ""}`.toLowerCase().includes(w)));
    this.count.textContent = plural(found.length, "finding", "findings");
    const focused = this.list.contains(document.activeElement);
    replace(
      this.list,
      ...found.slice(0, this.most).map((f) =>
        h("li", null, h(
          "button", { type: "button", class: `finding ${f.severity}`, "aria-current": f === this.selected ? "true" : null, onclick: () => this.pick(f, true) },
          h("span", { class: "finding-head" }, h("b", null, `${f.severity} ${f.rule}`), h("span", { class: "muted" }, ` ${f.file}:${f.line}:${f.column}`)),
          h("span", { class: "finding-text" }, f.message),
        ))),
      found.length > this.most && h("li", null, button(`Show all ${found.length}`, null, () => {
        this.most = found.length;
        this.draw();
      })),
    );
    if (focused) this.list.querySelector<HTMLElement>("[aria-current]")?.focus();
  }

  reset(): void {
    this.selected = null;
    this.chosen = false;
  }

  /** The worst. */
  pickFirst(): void {
    if (this.all.length > 0) this.pick(this.all[0], false);
  }

  private pick(f: Finding, chosen: boolean): void {
    this.selected = f;
    this.chosen = chosen;
    this.draw();
    this.choose(f);
  }
}

/** What a finding says, with what can be done about it. */
export function drawFinding(into: HTMLElement, f: Finding, on: { explain: (rule: string) => void; fix: (f: Finding) => void; go: (file: string, line: number, column: number, end: number) => void }): void {
  replace(
    into,
    h("h2", null, h("span", { class: `severity ${f.severity}` }, f.severity), button(f.rule, null, () => on.explain(f.rule), { class: "link rule", title: "What this rule says" })),
    h("p", { class: "message" }, f.message),
    f.reference_behaviour && h("p", { class: "note" }, `Solver: ${f.reference_behaviour}`),
    f.help && h("p", { class: "note" }, `Help: ${f.help}`),
    ...f.notes.map((n) => h("p", { class: "note" }, `${n.message} `, button(`${n.file}:${n.line}`, null, () => on.go(n.file, n.line, n.column, n.end_column), { class: "link" }))),
    f.fix && h("p", { class: "buttons" }, button(`${f.fix.safe ? "Fix" : "Fix (changes the meaning)"}: ${f.fix.title}`, null, () => on.fix(f), { class: "fix" })),
  );
}
