// The page of `deck accuracy`: its first screen against the JSON, kinds with their worst pair, the hard case in motion.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, reachable } from "./axe.mjs";
import { check, deck, DECK_ARTEFACTS, done, open, same, sample, scratch, shot } from "./support.mjs";
import { pageFits } from "./tables.mjs";

/** The first screen says per accuracy what the JSON says, within the window. */
async function firstScreen(p, name, data) {
  for (const [width, height] of [[1440, 900], [390, 844]]) {
    await p.setViewportSize({ width, height });
    const rows = await p.$$eval(".choices tbody tr", (all) => all.map((r) => ({ accuracy: r.dataset.accuracy, text: r.innerText, bottom: r.getBoundingClientRect().bottom + scrollY })));
    same(`${name}, ${width} wide: the four words of --accuracy`, rows.map((r) => r.accuracy), ["reference", "fast", "robust", "exact"]);
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
    const text = await p.$eval(`.choices [data-accuracy=${c.word}]`, (r) => r.innerText);
    const wrong = (part) => text.includes(`${part.wrong} of ${part.pairs}`);
    check(`${name}, ${c.word}: wrong decisions, other answers`, wrong(c.hard) && text.includes(`${c.hard.other_answer} of ${c.hard.rewritten}`) && (!c.deck || wrong(c.deck)), text);
    const noisy = [c.hard, c.deck].filter((t) => t && t.ratio / (1 + t.spread) <= 1 && t.ratio * (1 + t.spread) >= 1 && t.spread > 0.2).length;
    check(`${name}, ${c.word}: times, and a ratio to each`, (text.match(/\d (ns|µs|ms|s|min)\b/g) ?? []).length >= (c.deck ? 2 : 1) && (text.match(/\d x\b/g) ?? []).length === (c.deck ? 2 : 1), text);
    check(`${name}, ${c.word}: noise is called noise`, c.word === "fast" || (text.match(/too noisy here/g) ?? []).length === noisy, text);
    const kinds = await p.$eval(`.strip[data-accuracy=${c.word}]`, (e) => ({ text: e.querySelector(".who").textContent, marks: [...e.querySelectorAll("button")].map((b) => Number(b.className[1])) }));
    same(`${name}, ${c.word}: kinds never wrong`, kinds.text.trim(), `${c.word} ${data.families.filter((k) => k.wrong[c.word] === 0).length} of ${data.families.length} kinds`);
    same(`${name}, ${c.word}: a mark for every kind`, kinds.marks, data.families.map((k) => (k.wrong[c.word] === 0 ? 0 : 10 * k.wrong[c.word] < k.pairs ? 1 : 2)));
  }
  check(`${name}: "never wrong" is said of decisions only`, !(await p.innerText("body")).includes("never wrong"));
  const said = await p.$eval(".said", (e) => ({ text: e.textContent.trim().replace(/\s+/g, " "), names: [...e.querySelectorAll("code")].map((c) => c.textContent) }));
  same(`${name}: the sentences are those of the JSON`, said.text, data.advice.join(" "));
  const names = data.choices.map((c) => c.word);
  check(`${name}: names in the sentences are names in the table`, said.names.length > 0 && said.names.every((n) => names.includes(n)), said.names.join(" "));
}

/** A mark shows its worst pair, with the gap between both answers. */
async function kinds(p, name, data) {
  const wrong = data.families.filter((k) => k.wrong.reference > 0);
  for (const kind of wrong) {
    const worst = kind.worst.find((w) => w.word === "reference");
    await p.click(`.strip[data-accuracy=reference] [data-kind="${kind.id}"]`);
    const shown = await p.$eval("#example", (e) => ({
      text: e.textContent, drawn: e.querySelectorAll("svg polygon, svg polyline, svg circle").length,
      exact: e.querySelector(".exact")?.cy.baseVal.value, got: e.querySelector(".got")?.getBBox().y + 5, gap: e.querySelector(".gap")?.y1.baseVal.value,
      texts: [...e.querySelectorAll("svg:last-of-type text")].map((t) => ({ text: t.textContent, r: t.getBoundingClientRect() })), box: e.querySelector("svg:last-of-type").getBoundingClientRect(),
    }));
    check(`${name}, ${kind.name}: the worst pair with both answers`, shown.drawn >= 3 && shown.text.includes(`${kind.wrong.reference} of ${kind.pairs}`) && shown.text.includes(`gap ${String(worst.gap).length > 18 ? worst.gap.toExponential() : worst.gap}`), shown.text);
    check(`${name}, ${kind.name}: the answers stand on both sides of the gap`, worst.in_contact ? shown.exact > shown.gap && shown.got < shown.gap : shown.exact < shown.gap && shown.got > shown.gap, JSON.stringify(shown));
    const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 3 && b.top < a.bottom - 3;
    const collide = shown.texts.flatMap((a, i) => shown.texts.slice(i + 1).filter((b) => meet(a.r, b.r)).map((b) => `${a.text}/${b.text}`));
    same(`${name}, ${kind.name}: texts do not meet`, collide, []);
    check(`${name}, ${kind.name}: texts stay in the drawing`, shown.texts.every((t) => t.r.right <= shown.box.right + 1), shown.texts.map((t) => t.text).join(" / "));
  }
  await p.focus(".strip[data-accuracy=robust] button");
  await p.keyboard.press("ArrowRight");
  await p.keyboard.press("Enter");
  check(`${name}: arrows lead along the kinds`, (await p.textContent("#example")).includes(`${data.families[1].name}, robust`));
}

/** The hard case in motion: a line for every word, a ring and a sentence for every jump. */
async function motion(p, name, data) {
  const m = data.motion;
  for (const width of [390, 1280]) {
    await p.setViewportSize({ width, height: 900 });
    const shown = await p.$eval("#motion", (e) => ({
      lines: [...e.querySelectorAll("polyline")].map((l) => l.points.length), rings: [...e.querySelectorAll(".dk-default")].map((r) => `${r.dataset.accuracy} ${r.dataset.step}`).sort(),
      bands: Object.fromEntries([...e.querySelectorAll(".dk-band")].map((b) => [b.dataset.accuracy, b.getAttribute("d").replace(/M[\d.]+ [\d.]+/g, (m) => m.split(" ")[0])])),
      sentences: [...e.querySelectorAll(".jump")].map((j) => j.textContent), cut: [...e.querySelectorAll("svg text, .dk-default")].filter((t) => t.getBoundingClientRect().right > e.querySelector("figure").getBoundingClientRect().right).length,
    }));
    same(`${name}, ${width} wide: four lines over the steps`, shown.lines, m.lines.map((l) => l.force.length));
    same(`${name}, ${width} wide: a ring at every jump`, shown.rings, m.lines.flatMap((l) => l.jumps.map((k) => `${l.word} ${k}`)).sort());
    same(`${name}, ${width} wide: the band of contact of robust is that of exact`, shown.bands.robust, shown.bands.exact);
    check(`${name}, ${width} wide: that of reference is another`, shown.bands.reference !== shown.bands.exact);
    same(`${name}, ${width} wide: a sentence for every jump`, shown.sentences, m.sentences);
    check(`${name}, ${width} wide: jumps are shown, nothing is cut`, shown.rings.length > 0 && m.sentences.length > 0 && shown.cut === 0);
    await (await p.$("#motion")).screenshot({ path: join(DECK_ARTEFACTS, `accuracy_motion_${width}.png`) });
  }
}

export async function accuracyPage(browser) {
  for (const [name, decks] of [["hard cases", []], ["a deck", [sample("crash_box")]]]) {
    const [html, json] = ["html", "json"].map((e) => join(scratch, `accuracy_${decks.length}.${e}`));
    deck("accuracy", ...decks, "--samples", "40", "--repeats", "3", "--quiet", "--html", html, "--json", json);
    const data = JSON.parse(readFileSync(json));
    const p = await open(browser, html, { viewport: { width: 1280, height: 900 } }, false);
    same(`${name}: the page holds the JSON document`, await p.$eval("#accuracy-json", (e) => JSON.parse(e.textContent)), data);
    await firstScreen(p, name, data);
    await kinds(p, name, data);
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
