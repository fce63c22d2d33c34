// Every page begins with the answer of its verb, at every width, on paper too; units stand once in a head; a batch links to its pages.
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { check, corpus, deck, DECK_CORPUS, done, open, pageOf, sample, same, scratch } from "./support.mjs";
const dimensional = ["depth", "gap", "distance", "max", "mean", "p95", "gapmin", "room", "longest", "length", "dx", "dy", "dz", "thickness", "mass", "step", "dt", "force", "largest", "elastic"];
/** `own`: the section of the verb; `said`: how the verdict begins; `printed`: what else paper says of it. */
async function answer(browser, name, file, own, said, printed) {
  for (const width of [390, 1024, 1280, 1600]) {
    const p = await open(browser, file, { viewport: { width, height: width < 500 ? 844 : 1000 } });
    const seen = await p.evaluate(() => {
      const top = (e) => e.getBoundingClientRect().top;
      const sections = [...document.querySelectorAll(".left > section")].filter((e) => e.offsetHeight > 0).sort((a, b) => top(a) - top(b));
      return { ids: sections.map((e) => e.id), strong: document.querySelector("#verdict strong").textContent, text: document.querySelector(".verdict-text").textContent,
        heads: [...document.querySelectorAll(".vt-title")].map((e) => [e.dataset.key, e.innerText.replace(/[↑↓]/g, "").trim()]) };
    });
    same(`${name}, ${width} wide: verdict and the verb's own section come first`, seen.ids.slice(0, 2), ["verdict", own]);
    check(`${name}, ${width} wide: the verdict begins with the answer`, said.test(seen.strong), seen.strong);
    const wrong = seen.heads.filter(([key, text]) => dimensional.includes(key) && !/^[^()]+ \([a-zµN·/²]+\)$/.test(text));
    same(`${name}, ${width} wide: a unit stands once in the head of every column that has one`, wrong, []);
    if (width === 1280) {
      await p.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
      await p.emulateMedia({ media: "print" });
      const paper = await p.evaluate(() => document.querySelector(".left").innerText);
      check(`${name}: paper has the answer`, paper.includes(seen.strong) && printed.every((t) => paper.includes(t)), paper.slice(0, 600));
      check(`${name}: paper has no link to skip to`, await p.$eval(".skips", (e) => e.offsetHeight === 0));
    }
    await done(p, `${name}, ${width} wide`);
  }
}
/** Every changed value has a row, alike ones in a group; a click leaves what is new because of it. */
async function differences(browser) {
  const path = corpus("EuroSID_II/EuroSID_II_0000.rad"), wide = join(scratch, "EuroSID_II_inflated_0000.rad"), html = join(scratch, "inflated_diff.html"), file = join(scratch, "inflated_diff.json");
  if (!path) return;
  execFileSync("python3", [join(DECK_CORPUS, "check", "inflate_gaps.py"), path, wide, "2.5", "zero"]);
  const text = deck("diff", path, wide, "--html", html, "--json", file);
  const json = JSON.parse(execFileSync("cat", [file], { maxBuffer: 1 << 30 }));
  const p = await open(browser, html);
  same("difference: the verdict begins with the sentence of the terminal and the JSON", [await p.$eval("#verdict strong", (e) => e.textContent), text.includes(json.text)], [json.text, true]);
  same("difference: a row for every value that changed", await p.$$eval("#changes tbody tr", (r) => r.length), json.changes.length);
  check("difference: alike values are one line", (await p.$$eval("#changes summary", (s) => s.map((e) => e.textContent))).some((t) => t === "Gapmin × 2.5 in 30 interfaces"));
  const chips = await p.$$eval(".compare .chip", (c) => Object.fromEntries(c.map((e) => [/[a-z].*/.exec(e.textContent)[0], Number(e.querySelector("b").textContent.replace(/\D/g, ""))])));
  same("difference: the counts are those of the JSON", [chips.new, chips.worse, chips.better, chips.solved], ["new", "worse", "better", "gone"].map((k) => json.penetrations[k].length));
  await p.click("#changes summary >> nth=0");
  same("difference: a click on a group leaves the new pairs", await p.evaluate(() => window.deckReport.report.filtered.length), chips.new);
  await p.click("#changes details[open] button >> nth=6");
  const [n, id] = await p.evaluate(() => [window.deckReport.report.filtered.length, window.deckReport.report.meta.interfaces[window.deckReport.report.filter.interface]?.id]);
  same("difference: a click on a value those of its interface", n, json.penetrations.new.filter((x) => x.interface === id).length);
  // Pairs that only round-off makes, and ties that tie nothing, are on the page with the numbers of the JSON.
  const gaps = JSON.parse(deck("gaps", wide, "--json", "-", "--quiet"));
  same("dummy: pairs that only round-off makes", chips["only by the solver's round-off"], gaps.interfaces.flatMap((i) => i.contacts.flatMap((c) => c.penetrations)).filter((x) => x.in_contact === false).length);
  same("dummy: nodes that are not tied, counted and listed", [chips["not tied"], await p.$eval("#ties h3 .count", (e) => Number(e.textContent.replace(/\D/g, "")))], Array(2).fill(gaps.verdict.counts.untied_nodes));
  check("dummy: nothing says that all are tied", !/every node is tied/i.test(await p.evaluate(() => document.body.innerText)));
  await p.keyboard.press("Escape");
  await p.click(".compare .chip:has-text('round-off')");
  const seen = await p.evaluate(() => { const { report, viewport } = window.deckReport; return [report.filtered.every((x) => report.isRoundOff(x.row)), report.filtered.length, viewport.view.markers.hollow?.geometry.attributes.position.count, document.querySelector(".legend").textContent.includes("only by round-off")]; });
  same("dummy: the chip lists those pairs, each with a hollow marker that the legend names", seen, [true, chips["only by the solver's round-off"], chips["only by the solver's round-off"], true]);
  await done(p, "difference of the dummy");
}
/** The overview of many decks: links to pages that are there, short rows on a telephone, no column that says nothing. */
async function overview(browser) {
  const decks = join(scratch, "decks"), out = join(scratch, "batch");
  mkdirSync(decks, { recursive: true });
  for (const name of ["clean_plates", "too_close", "crash_box", "tied_layer", "every_mistake"]) cpSync(sample(name), join(decks, `${name}_0000.rad`));
  deck("batch", decks, "-o", out, "--verb", "gaps --html", "--force", "--quiet");
  const p = await open(browser, join(out, "index.html"), { viewport: { width: 390, height: 844 } }, false), links = await p.$$eval("a", (all) => all.map((a) => a.getAttribute("href")));
  check("batch: every link is a page that is there", links.length === 5 && links.every((l) => l.endsWith(".html") && existsSync(join(out, decodeURIComponent(l)))), links.join(" "));
  same("batch: a row is at most 160 pixels high on a telephone", await p.$$eval("tbody tr", (r) => r.map((e) => e.offsetHeight <= 160)), Array(5).fill(true));
  const columns = await p.$$eval("tbody tr", (r) => [...r[0].cells].map((_, i) => r.map((e) => e.cells[i].textContent)));
  check("batch: no column is constant, or another one again", columns.every((c) => new Set(c).size > 1) && new Set(columns.map((c) => c.join())).size === columns.length, JSON.stringify(columns));
  await done(p, "batch");
}
export async function answers(browser) {
  const box = sample("crash_box"), close = sample("too_close");
  await answer(browser, "cycle", pageOf("cycle", "answer_cycle", box), "cycle", /^28 pairs push at the start; node 20028 has the largest force 396\.4 k?N\.$/, ["First cycle", "The time step is limited by"]);
  const { total, slowest_node: node } = JSON.parse(deck("parts", box, "--json", "-", "--quiet")), four = (v) => Number(v.toPrecision(4));
  await answer(browser, "parts", pageOf("parts", "answer_parts", box), "parts", new RegExp(`${total.dt.element.id} of part .* limits the time step to ${four(total.dt.min)}.*${node.node} limits it to ${four(node.dt)}`), ["Parts", "Mass of all elements"]);
  await answer(browser, "fix of nodes", pageOf("fix", "answer_fix", box, "--strategy", "move-nodes"), "moved", /28 nodes moved by up to 1\.026/, ["The Starter will still stop", "Not treated"]);
  await answer(browser, "fix of cards", pageOf("fix", "answer_cards", close, "--strategy", "reduce-gap"), "moved", /Gapmin 1\.25 -> 0\.9 changed/, ["Nothing in the contacts stops the Starter"]);
  deck("fix", close, "--strategy", "reduce-gap", "--quiet", "-o", join(scratch, "reduced"), "--overwrite");
  await answer(browser, "diff", pageOf("diff", "answer_diff", close, join(scratch, "reduced", "too_close_0000.rad")), "changes", /^Different: 1 effective value/, ["Gapmin × 0.72"]);
  await differences(browser);
  await overview(browser);
}
