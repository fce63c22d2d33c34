// Panels over the picture: list of drawn parts; two section planes.
import { Vector3 } from "three";
import { button, h, replace } from "../dom";
import { copyText, fixCommand } from "../exports";
import { named } from "../table/columns";
import type { Report } from "../report";
import type { Part3D } from "./parts3d";
import type { Cut } from "./section";

export interface PartChoices {
  hidden: Set<Part3D>;
  apply(): void; // after `hidden` has changed
  only(part: Part3D): void;
  all(): void;
  neighbours(): void;
  /** By position: parts whose nodes stay in a repair, and parts that alone move. */
  locks: Map<number, "lock" | "only">;
  noted(): void; // after `locks` has changed
}

const lockSays = { free: "its nodes may move", lock: "locked: its nodes stay", only: "only nodes of such parts move" };

export class PartList {
  readonly element = h("div", { class: "part-list", hidden: true });

  fill(report: Report, parts: Part3D[], choices: PartChoices): void {
    const filter = h("input", { type: "search", placeholder: "Find a part", "aria-label": "Find a part", oninput: () => rows() });
    const list = h("div", { class: "part-rows" });
    const { locks } = choices;
    const command = h("div", { class: "fix-command" });
    const locked = () => {
      const text = fixCommand(report, locks);
      const copy = button("Copy", "copy", async () => copy.classList.toggle("done", await copyText(text)), { class: "small" });
      replace(command, ...(locks.size > 0 ? [h("code", null, text), copy] : []));
    };
    const padlock = (part: number, text: string) => {
      const now = locks.get(part) ?? "free";
      const b = button("", now === "free" ? "unlocked" : "lock", () => {
        if (now === "only") locks.delete(part);
        else locks.set(part, now === "free" ? "lock" : "only");
        b.replaceWith(padlock(part, text));
        locked();
        choices.noted();
      }, { class: `tool padlock ${now}`, "aria-label": `${text}: ${lockSays[now]}`, title: `${lockSays[now]} (deck fix)` });
      return b;
    };
    const row = (p: Part3D) => {
      const box = h("input", { type: "checkbox", checked: !choices.hidden.has(p), onchange: () => {
        if (box.checked) choices.hidden.delete(p);
        else choices.hidden.add(p);
        choices.apply();
      } });
      const text = report.partText(p.data.part);
      const part = report.meta.parts[p.data.part];
      const about = part ? [text, `property ${part.prop}`, `material ${part.mat}`, part.thickness ? `thickness ${part.thickness}` : ""].filter((t) => t).join(" · ") : text;
      return h("div", { class: "part-row" },
        h("label", { title: about }, box, h("span", { class: "swatch", style: `background:#${p.color.getHexString()}` }), part ? named(part.id, part.title, report.commonPrefix, 196) : h("span", null, text)),
        part && padlock(p.data.part, text), button("only", null, () => choices.only(p), { class: "link" }));
    };
    const rows = () => {
      const t = filter.value.toLowerCase();
      replace(list, ...parts.filter((p) => report.partText(p.data.part).toLowerCase().includes(t)).map(row));
    };
    const none = () => {
      for (const p of parts) choices.hidden.add(p);
      choices.apply();
      rows();
    };
    replace(this.element,
      h("div", { class: "panel-head" }, h("b", null, "Parts"), h("span", { class: "buttons" },
        button("neighbours", null, () => choices.neighbours(), { class: "link", title: "Also what shares nodes with the parts in sight or comes near them (b)" }),
        button("all", null, () => choices.all(), { class: "link" }), button("none", null, none, { class: "link" }))),
      filter, list, command);
    rows();
    locked();
  }
}

export class ClipPanel {
  readonly element = h("div", { class: "clip-panel", hidden: true });
  cuts: (Cut | null)[] = [null, null];

  /** `changed`: called after a plane has changed; `through`: plane through the chosen row, normal to its surface; null without row;
   * `middle`: position of a plane through the middle of the chosen parts. */
  constructor(
    private readonly changed: () => void,
    private readonly through: () => Cut | null,
    private readonly middle: (normal: Vector3) => number,
  ) {}
  private across(normal: Vector3): Cut { return { normal, at: this.middle(normal) }; }

  /** Moves the planes to the chosen parts; elsewhere they could hide them. */
  follow(): void {
    this.cuts = this.cuts.map((c) => c && this.across(c.normal));
    this.build();
    this.changed();
  }

  show(on: boolean): void {
    this.element.hidden = !on;
    this.cuts = [on ? this.across(new Vector3(1, 0, 0)) : null, null];
    this.build();
    this.changed();
  }

  /** For the address; empty without plane. */
  get state(): string {
    const cuts = this.cuts.map((c) => (c ? [...c.normal.toArray(), c.at].map((v) => Number(v.toPrecision(5))).join(",") : ""));
    return cuts.some((c) => c) ? cuts.join("/") : "";
  }
  set state(text: string) {
    this.cuts = [0, 1].map((i) => {
      const v = text.split("/")[i]?.split(",").map(Number) ?? [];
      return v.length === 4 && v.every(Number.isFinite) ? { normal: new Vector3(v[0], v[1], v[2]), at: v[3] } : null;
    });
    this.element.hidden = !this.any;
    this.build();
    this.changed();
  }
  get any(): boolean { return this.cuts.some((c) => c !== null); }

  build(): void { replace(this.element, ...this.cuts.map((cut, i) => this.row(cut, i))); }

  private set(i: number, cut: Cut | null): void {
    this.cuts[i] = cut;
    this.build();
    this.changed();
  }

  private row(cut: Cut | null, i: number): HTMLElement {
    const name = i === 0 ? "First" : "Second";
    const box = h("input", { type: "checkbox", checked: cut !== null, "aria-label": `${name} section plane`,
      onchange: () => this.set(i, box.checked ? this.across(new Vector3(i === 0 ? 1 : 0, i, 0)) : null) });
    if (!cut) return h("div", { class: "clip-row" }, h("label", { class: "check" }, box, `${name} plane`));
    const slider = h("input", { type: "range", min: 0, max: 1, step: 0.001, value: cut.at, "aria-label": `Position of the ${name.toLowerCase()} section plane`, oninput: () => {
      cut.at = Number(slider.value);
      this.changed();
    } });
    const along = (label: string, n: Vector3) => button(label, null, () => this.set(i, this.across(n)), { class: "tool text", title: `Across ${label}` });
    const row = () => { const found = this.through(); if (found) this.set(i, found); };
    return h("div", { class: "clip-row" }, box,
      along("X", new Vector3(1, 0, 0)), along("Y", new Vector3(0, 1, 0)), along("Z", new Vector3(0, 0, 1)),
      button("row", null, row, { class: "tool text", title: "Cut through the chosen node, across the surface" }),
      slider,
      button("flip", null, () => this.set(i, { normal: cut.normal.clone().negate(), at: 1 - cut.at }), { class: "tool text", title: "Keep the other side" }));
  }
}
