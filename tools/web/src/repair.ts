// Repairs of the deck in the page: what a strategy of `deck fix` would do, as its page, and taking it over.
import { button, h, replace } from "../../viewer/src/dom";
import type { Result } from "./engine";

const strategies: [name: string, says: string][] = [
  ["move-nodes", "Move nodes out of the gap"],
  ["reduce-gap", "Reduce the gap"],
  ["inacti", "Let the solver treat them (Inacti)"],
  ["fpenmax", "Switch off what is too deep (Fpenmax)"],
  ["move-part", "Move a whole part"],
  ["tie", "Reach the untied nodes of ties (dsearch)"],
];
const folder = "fixed";

export interface RepairHost {
  main: () => string;
  get: (name: string) => Uint8Array | undefined;
  run: (args: string[]) => Promise<Result | null>;
  frame: (page: Uint8Array, label: string) => HTMLElement;
  take: (files: Record<string, Uint8Array>) => void;
}

const same = (a: Uint8Array, b: Uint8Array) => a.length === b.length && a.every((v, i) => v === b[i]);

/** What a run wrote below `folder` and is other than in the page, by its name there. */
export function takenOver(folder: string, main: string, get: (name: string) => Uint8Array | undefined, files: Record<string, Uint8Array>): Record<string, Uint8Array> {
  const own = main.slice(0, main.lastIndexOf("/") + 1);
  const out: Record<string, Uint8Array> = {};
  for (const [path, bytes] of Object.entries(files)) {
    if (!path.startsWith(`${folder}/`)) continue;
    const name = path.slice(folder.length + 1);
    const known = [own + name, name].find((n) => get(n) !== undefined);
    if (known && !same(get(known)!, bytes)) out[known] = bytes;
  }
  return out;
}

export class RepairView {
  readonly element = h("div", { class: "output-page" });
  private readonly out = h("div", { class: "report" });
  private readonly take = button("Take it over", null, () => this.use(), { class: "primary", hidden: true });
  private files: Record<string, Uint8Array> = {};

  constructor(private readonly host: RepairHost) {
    this.reset();
    this.element.append(
      h("p", { class: "buttons", role: "group", "aria-label": "Repairs" }, ...strategies.map(([name, says]) => button(says, null, () => void this.try(name, says), { "data-strategy": name, title: `deck fix --strategy ${name}` })), this.take),
      this.out);
  }

  /** The text is another one: what was tried is of the old one. */
  reset(): void {
    this.take.hidden = true;
    this.files = {};
    replace(this.out, h("p", { class: "muted" }, "Choose a repair. It is computed and checked here; the deck stays as it is until you take it over, and Undo takes it back."));
  }

  private async try(strategy: string, says: string): Promise<void> {
    this.reset();
    replace(this.out, h("p", { class: "muted", role: "status" }, `${says} \u2026`));
    const r = await this.host.run(["fix", this.host.main(), "--strategy", strategy, "-o", folder, "--html", "page.html", "-q"]);
    if (!r) return this.reset();
    const page = r.files["page.html"];
    if (!page) return replace(this.out, h("pre", { class: "bad", tabindex: "0" }, new TextDecoder().decode(r.stderr) || "There is no report."));
    replace(this.out, this.host.frame(page, `Repair: ${strategy}`));
    this.files = takenOver(folder, this.host.main(), this.host.get, r.files);
    this.take.hidden = Object.keys(this.files).length === 0;
  }

  private use(): void {
    this.host.take(this.files);
  }
}
