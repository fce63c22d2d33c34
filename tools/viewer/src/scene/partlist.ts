// The list of parts over the picture: which are drawn, and one of them alone.
import { button, h, replace } from "../dom";
import { named } from "../table/names";
import type { Report } from "../report";
import type { Part3D } from "./parts3d";

export interface PartChoices {
  hidden: Set<Part3D>;
  apply(): void; // after `hidden` has changed
  only(part: Part3D): void;
  all(): void;
}

export class PartList {
  readonly element = h("div", { class: "part-list", hidden: true });

  fill(report: Report, parts: Part3D[], choices: PartChoices): void {
    const filter = h("input", { type: "search", placeholder: "Find a part", "aria-label": "Find a part", oninput: () => rows() });
    const list = h("div", { class: "part-rows" });
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
        h("label", { title: about }, box, h("span", { class: "swatch", style: `background:#${p.color.getHexString()}` }), part ? named(part.id, part.title, report.commonPrefix) : h("span", null, text)),
        button("only", null, () => choices.only(p), { class: "link" }));
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
        button("all", null, () => choices.all(), { class: "link" }), button("none", null, none, { class: "link" }))),
      filter, list);
    rows();
  }
}
