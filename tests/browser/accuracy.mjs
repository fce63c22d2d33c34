// The page of `deck accuracy`: its first screen against the JSON, the lever, families with their worst pair, the hard case in motion.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, reachable } from "./axe.mjs";
import { check, deck, DECK_ARTEFACTS, done, open, same, sample, scratch, shot } from "./support.mjs";
import { pageFits } from "./tables.mjs";
/** The first screen says per accuracy what the JSON says, within the window. */
async function firstScreen(p, name, data) {
  for (const [width, height] of [[1440, 900], [390, 844]]) {
    await p.setViewportSize({ width, height });
    const rows = await p.$$eval(".words tbody tr", (all) => all.map((r) => ({ word: r.dataset.accuracy, text: r.innerText, bottom: r.getBoundingClientRect().bottom + scrollY })));
    same(`${name}, ${width} wide: the four words of --accuracy`, rows.map((r) => r.word), ["reference", "fast", "robust", "exact"]);
    check(`${name}, ${width} wide: all four are seen without scrolling`, rows.every((r) => r.bottom <= height), rows.map((r) => Math.round(r.bottom)).join(" "));
    const texts = await p.evaluate(() => {
      const small = [], table = [];
      const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      for (let n = walk.nextNode(); n; n = walk.nextNode()) {
        const e = n.parentElement, box = e.getBoundingClientRect();
        if (!n.textContent.trim() || box.width === 0 || e.closest("script,style")) continue;
        const svg = e.closest("svg"), zoom = svg ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
        if (parseFloat(getComputedStyle(e).fontSize) * zoom < 10.95) small.push(`${n.textContent.slice(0, 30)} ${parseFloat(getComputedStyle(e).fontSize) * zoom}`);
      }
      for (const t of document.querySelectorAll("table")) if (t.offsetWidth > t.parentElement.clientWidth) table.push(`${t.className} ${t.offsetWidth} in ${t.parentElement.clientWidth}`);
      return { small, table, wide: document.documentElement.scrollWidth > innerWidth };
    });
    same(`${name}, ${width} wide: no text is smaller than 11 pixels`, texts.small, []);
    same(`${name}, ${width} wide: no table is wider than its box`, texts.table, []);
    check(`${name}, ${width} wide: the page is not wider than the window`, !texts.wide);
  }
  await p.setViewportSize({ width: 1440, height: 900 });
  for (const c of data.choices) {
    const text = await p.$eval(`.words [data-accuracy=${c.word}]`, (r) => r.innerText), part = c.deck ?? c.hard;
    check(`${name}, ${c.word}: time, ratio, wrong decisions`, /\d (ns|µs|ms|s|min)\b/.test(text) && /\d x\b/.test(text) && text.includes(`${part.wrong} of ${part.pairs}`), text);
    const noisy = part.spread > 0.2 && part.ratio / (1 + part.spread) <= 1 && part.ratio * (1 + part.spread) >= 1;
    same(`${name}, ${c.word}: noise is called noise`, text.includes("noisy"), c.word !== "fast" && noisy);
  }
  same(`${name}: six families`, (await p.$$eval(".families thead th", (t) => t.map((e) => e.textContent))).slice(1, -1).sort(), [...new Set(data.families.map((k) => k.group))].sort());
  const shares = await p.$$eval(".families button", (all) => all.map((b) => [b.closest("tr").dataset.accuracy, b.dataset.group, b.title]));
  for (const [word, group, title] of shares) {
    const of = data.families.filter((k) => k.group === group), sum = (f) => of.reduce((n, k) => n + f(k), 0);
    same(`${name}, ${word}, ${group}: wrong decisions of the family`, title, `${sum((k) => k.wrong[word])} wrong of ${sum((k) => k.pairs)}`);
  }
  const lowest = await p.$eval(".families", (e) => e.getBoundingClientRect().bottom + scrollY);
  check(`${name}: the families are seen without scrolling`, lowest <= 900, lowest);
  check(`${name}: "never wrong" is said of decisions only`, !(await p.innerText("body")).includes("never wrong"));
  same(`${name}: the sentences are those of the JSON`, await p.$eval(".said", (e) => e.textContent.trim().replace(/\s+/g, " ")), data.advice.join(" "));
}
/** The lever: as many filled dots as the word decides wrongly; a dot shows both node lists. */
async function lever(p, name, data) {
  for (const c of data.choices) {
    await p.check(`[name=word][value=${c.word}]`);
    same(`${name}, ${c.word}: a filled dot for every pair decided wrongly`, await p.$$eval("#picture .wrong", (d) => d.length), c.deck.wrong);
  }
  const pairs = data.wrong_pairs.filter((e) => e.word === "reference"), e = pairs[0] ?? data.nearest;
  await p.check("[name=word][value=reference]");
  same(`${name}: the list has the pairs`, await p.$$eval("#pairs button", (b) => b.length), Math.max(pairs.length, e ? 1 : 0));
  if (!e) return;
  await p.click("#pairs button");
  const text = await p.textContent("#pair");
  check(`${name}: a pair shows its nodes, its gap and both figures`, text.includes(`${e.secondary.join("-")} on ${e.main.join("-")}`) && text.includes(`gap ${e.gap}`), text);
}
/** A family shows the worst pair of its worst kind, with the gap between both answers. */
async function families(p, name, data) {
  for (const group of new Set(data.families.map((k) => k.group))) {
    const kind = data.families.filter((k) => k.group === group).reduce((a, k) => (k.wrong.reference / k.pairs > a.wrong.reference / a.pairs ? k : a));
    const worst = kind.worst.find((w) => w.word === "reference");
    await p.click(`.families tr[data-accuracy=reference] [data-group="${group}"]`);
    const shown = await p.$eval("#example", (e) => ({
      text: e.textContent, drawn: e.querySelectorAll("svg polygon, svg polyline, svg circle").length,
      exact: e.querySelector(".exact")?.cy.baseVal.value, got: e.querySelector(".got")?.getBBox().y + 5, gap: e.querySelector(".gap")?.y1.baseVal.value,
    }));
    if (!worst) { check(`${name}, ${group}: nothing wrong is said`, shown.text.includes("are decided rightly"), shown.text); continue; }
    check(`${name}, ${group}: the worst pair with both answers`, shown.drawn >= 3 && shown.text.includes(`${kind.wrong.reference} of ${kind.pairs}`) && shown.text.includes(`gap ${String(worst.gap).length > 18 ? worst.gap.toExponential() : worst.gap}`), shown.text);
    check(`${name}, ${group}: the answers stand on both sides of the gap`, worst.in_contact ? shown.exact > shown.gap && shown.got < shown.gap : shown.exact < shown.gap && shown.got > shown.gap, JSON.stringify(shown));
  }
}
/** The hard case in motion: a band and a line for every word, a ring and a sentence for every jump. */
async function motion(p, name, data) {
  const m = data.motion;
  for (const width of [390, 1280]) {
    await p.setViewportSize({ width, height: 900 });
    const shown = await p.$eval("#motion", (e) => ({
      lines: [...e.querySelectorAll("polyline")].map((l) => l.points.length), rings: [...e.querySelectorAll(".ring")].map((r) => `${r.dataset.accuracy} ${r.dataset.step}`).sort(),
      bands: Object.fromEntries([...e.querySelectorAll(".band")].map((b) => [b.dataset.accuracy, b.getAttribute("d").replace(/ \d+H/g, " H")])),
      sentences: [...e.querySelectorAll(".jump")].map((j) => j.textContent), cut: [...e.querySelectorAll("svg text, .ring")].filter((t) => t.getBoundingClientRect().right > e.querySelector("figure").getBoundingClientRect().right).length,
    }));
    same(`${name}, ${width} wide: four lines over the steps`, shown.lines, m.lines.map((l) => l.force.length));
    same(`${name}, ${width} wide: a ring at every jump`, shown.rings, m.lines.flatMap((l) => l.jumps.map((k) => `${l.word} ${k}`)).sort());
    same(`${name}, ${width} wide: the band of contact of robust is that of exact`, shown.bands.robust, shown.bands.exact);
    check(`${name}, ${width} wide: that of reference is another`, shown.bands.reference !== shown.bands.exact);
    same(`${name}, ${width} wide: a sentence for every jump`, shown.sentences, m.sentences);
    check(`${name}, ${width} wide: jumps are shown, nothing is cut`, shown.rings.length > 0 && m.sentences.length > 0 && shown.cut === 0);
    await (await p.$("#motion")).screenshot({ path: join(DECK_ARTEFACTS, `accuracy_motion_${width}.png`) });
  }
  await p.focus("#step");
  await p.keyboard.press("Home");
  check(`${name}: the slider says who is in contact`, (await p.textContent("#at")).startsWith("Step 0. In contact? reference"), await p.textContent("#at"));
}
export async function accuracyPage(browser) {
  for (const [name, decks] of [["hard cases", []], ["a deck", [sample("crash_box")]]]) {
    const [html, json] = ["html", "json"].map((e) => join(scratch, `accuracy_${decks.length}.${e}`));
    deck("accuracy", ...decks, "--samples", "40", "--repeats", "3", "--quiet", "--html", html, "--json", json);
    const data = JSON.parse(readFileSync(json));
    const p = await open(browser, html, { viewport: { width: 1280, height: 900 } }, false);
    same(`${name}: the page holds the JSON document`, await p.$eval("#accuracy-json", (e) => JSON.parse(e.textContent)), data);
    await firstScreen(p, name, data);
    await families(p, name, data);
    if (decks.length > 0) await lever(p, name, data);
    await shot(p, `accuracy_${decks.length}`);
    await p.setViewportSize({ width: 390, height: 844 });
    await shot(p, `accuracy_${decks.length}_phone`);
    await motion(p, name, data);
    await pageFits(p, name);
    await accessible(p, `accuracy of ${name}`);
    await p.click("#theme");
    await accessible(p, `accuracy of ${name}, dark`);
    await reachable(p, `accuracy of ${name}`);
    await shot(p, `accuracy_${decks.length}_dark`);
    await done(p, `${name}`);
  }
}
