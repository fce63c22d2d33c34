// The panel of the two section planes.
import { Vector3 } from "three";
import { button, h, replace } from "../dom";
import type { Cut } from "./section";

export class ClipPanel {
  readonly element = h("div", { class: "clip-panel", hidden: true });
  cuts: (Cut | null)[] = [null, null];

  /** `changed`: after a plane has changed; `through`: a plane through the chosen row across the surface, null where none is chosen. */
  constructor(
    private readonly changed: () => void,
    private readonly through: () => Cut | null,
  ) {}

  show(on: boolean): void {
    this.element.hidden = !on;
    this.cuts = [on ? { normal: new Vector3(1, 0, 0), at: 0.5 } : null, null];
    this.build();
    this.changed();
  }

  /** As text for the address; empty: none. */
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
  get any(): boolean {
    return this.cuts.some((c) => c !== null);
  }

  build(): void {
    replace(this.element, ...this.cuts.map((cut, i) => this.row(cut, i)));
  }

  private set(i: number, cut: Cut | null): void {
    this.cuts[i] = cut;
    this.build();
    this.changed();
  }

  private row(cut: Cut | null, i: number): HTMLElement {
    const name = i === 0 ? "First" : "Second";
    const box = h("input", { type: "checkbox", checked: cut !== null, "aria-label": `${name} section plane`,
      onchange: () => this.set(i, box.checked ? { normal: new Vector3(i === 0 ? 1 : 0, i, 0), at: 0.5 } : null) });
    if (!cut) return h("div", { class: "clip-row" }, h("label", { class: "check" }, box, `${name} plane`));
    const slider = h("input", { type: "range", min: 0, max: 1, step: 0.001, value: cut.at, "aria-label": `Position of the ${name.toLowerCase()} section plane`, oninput: () => {
      cut.at = Number(slider.value);
      this.changed();
    } });
    const along = (label: string, n: Vector3) => button(label, null, () => this.set(i, { normal: n, at: cut.at }), { class: "tool text", title: `Across ${label}` });
    const row = () => {
      const found = this.through();
      if (found) this.set(i, found);
    };
    return h("div", { class: "clip-row" }, box,
      along("X", new Vector3(1, 0, 0)), along("Y", new Vector3(0, 1, 0)), along("Z", new Vector3(0, 0, 1)),
      button("row", null, row, { class: "tool text", title: "Cut through the chosen node, across the surface" }),
      slider,
      button("flip", null, () => this.set(i, { normal: cut.normal.clone().negate(), at: 1 - cut.at }), { class: "tool text", title: "Keep the other side" }));
  }
}
