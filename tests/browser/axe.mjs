// Accessibility by axe-core: nothing critical, nothing serious; and what the keyboard reaches.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { check, WORK } from "./support.mjs";
const axe = readFileSync(join(WORK, "node_modules/axe-core/axe.min.js"), "utf8");
export async function accessible(p, name) {
  await p.evaluate(axe);
  const found = await p.evaluate(async () => {
    const r = await window.axe.run(document, { resultTypes: ["violations"] });
    return r.violations.filter((v) => v.impact === "critical" || v.impact === "serious").map((v) => `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 120)}`);
  });
  check(`${name}: axe finds nothing critical or serious`, found.length === 0, found.join(" ;; "));
}
/** Everything that can be pressed can be reached with the tabulator key, in a toolbar with one stop by its arrows. */
export async function reachable(p, name) {
  const lost = await p.evaluate(() =>
    [...document.querySelectorAll("button, a[href], input, select, summary, [role=grid], canvas")]
      // Arrow keys go through a matrix or tool bar from its one stop; the space bar folds the chosen row of a table.
      .filter((e) => e.getClientRects().length > 0 && !e.disabled && e.tabIndex < 0 && !e.closest(".matrix:has([tabindex='0'])") && !e.matches("[role=grid] .fold-parts") &&
        !e.closest("[role=toolbar]")?.querySelector("[tabindex='0'], button:not([tabindex])"))
      .map((e) => e.outerHTML.slice(0, 80)));
  check(`${name}: the keyboard reaches everything`, lost.length === 0, lost.slice(0, 3).join(" ;; "));
}
