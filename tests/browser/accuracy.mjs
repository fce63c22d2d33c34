// The page of `deck accuracy`: its figures against the JSON, labels that do not meet, the heat map and its examples.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, reachable } from "./axe.mjs";
import { check, deck, same, sample } from "./support.mjs";

const widths = [390, 768, 1024, 1280, 1440, 1920];

async function openPage(browser, file) {
  const p = await browser.newPage({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  p.trouble = [];
  p.on("console", (m) => m.type() === "error" && p.trouble.push(m.text()));
  p.on("pageerror", (e) => p.trouble.push(e.message));
  p.on("request", (r) => /^(file|data|blob):/.test(r.url()) || p.trouble.push(r.url()));
  await p.goto(`file://${file}`);
  return p;
}

export async function accuracyPage(browser, scratch, shot) {
  for (const [name, decks] of [["hard cases", []], ["a deck", [sample("crash_box")]]]) {
    const [html, json] = ["html", "json"].map((e) => join(scratch, `accuracy_${decks.length}.${e}`));
    deck("accuracy", ...decks, "--samples", "20", "--repeats", "1", "--quiet", "--html", html, "--json", json);
    const data = JSON.parse(readFileSync(json));
    const p = await openPage(browser, html);
    same(`${name}: the page holds the JSON document`, await p.$eval("#accuracy-json", (e) => JSON.parse(e.textContent)), data);
    const tier = (n) => data.tiers.find((t) => t.name === n && t.what === "gaps");
    const said = await p.$eval(".said", (e) => e.textContent);
    const [robust, plain, solver] = ["robust", "fast", "reference"].map(tier);
    const numbers = said.match(/[\d.]+/g).map(Number);
    same(`${name}: the sentence says the figures of the JSON`, numbers.slice(-5), [Number((robust.ns_per_pair / plain.ns_per_pair).toFixed(2)), robust.decision_errors, robust.samples, plain.decision_errors, solver.decision_errors]);
    // Charts.
    const charts = await p.$$eval("figure svg", (all) => all.map((s) => {
      const labels = [...s.querySelectorAll(".dk-label")].map((e) => ({ text: e.textContent, r: e.getBoundingClientRect() }));
      const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
      const out = s.getBoundingClientRect();
      return {
        collide: labels.flatMap((a, i) => labels.slice(i + 1).filter((b) => meet(a.r, b.r)).map((b) => `${a.text}/${b.text}`)),
        outside: labels.filter((l) => l.r.right > out.right || l.r.left < out.left).map((l) => l.text),
        marks: [...s.querySelectorAll(".dk-mark")].map((m) => ({ x: m.cx.baseVal.value, y: m.cy.baseVal.value, hollow: m.matches(".dk-hollow") })),
        standard: s.querySelectorAll(".dk-default").length, frontier: s.querySelectorAll(".dk-frontier").length,
        ticks: [...s.querySelectorAll("text")].map((t) => t.textContent).filter((t) => /^[\d.]+ (ns|µs|ms|s)$/.test(t)).length,
      };
    }));
    check(`${name}: a chart for decisions, distances and forces`, charts.length === 3);
    check(`${name}: no label meets another or leaves the chart`, charts.every((c) => c.collide.length + c.outside.length === 0), JSON.stringify(charts.map((c) => [c.collide, c.outside])));
    check(`${name}: the default and the frontier are marked, the axis of time has words`, charts.every((c) => c.standard === 1 && c.frontier === 1 && c.ticks >= 2));
    // Down is better, left is faster: hollow is what another mark beats on these two axes.
    const wrong = charts.flatMap((c) => c.marks.filter((m) => m.hollow !== c.marks.some((o) => o.x <= m.x && o.y >= m.y && (o.x < m.x || o.y > m.y))));
    check(`${name}: hollow marks are those that another one beats on these axes`, wrong.length === 0, JSON.stringify(wrong));
    // Stages.
    const shares = await p.$$eval(".share", (bars) => bars.map((b) => [...b.children].reduce((n, e) => n + e.getBoundingClientRect().width, 0) / b.getBoundingClientRect().width));
    check(`${name}: the shares fill their bars`, shares.length === 2 && shares.every((s) => Math.abs(s - 1) < 0.02), shares.join(" "));
    for (const width of widths) {
      await p.setViewportSize({ width, height: 900 });
      check(`${name}, ${width} wide: the page is not wider than the window`, await p.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    }
    await p.setViewportSize({ width: 1280, height: 900 });
    if (decks.length === 0) {
      const cells = await p.$$eval(".heat button", (b) => b.map((e) => [Number(e.dataset.family), e.dataset.tier, Number(e.textContent)]));
      const family = (id, t) => data.families.find((f) => f.id === id && f.tier === t);
      check("the heat map has every family and tier of the JSON", cells.length === data.families.length && cells.every(([id, t, n]) => family(id, t).decision_errors + family(id, t).non_finite === n));
      const wrongOne = cells.find(([id, t, n]) => n > 0 && t === "reference" && family(id, t).example);
      await p.click(`.heat button[data-family="${wrongOne[0]}"][data-tier="reference"]`);
      const example = family(wrongOne[0], "reference").example;
      const shown = await p.$eval("#example", (e) => ({ text: e.textContent, drawn: e.querySelectorAll("svg polygon, svg polyline, svg circle").length }));
      check("a cell shows its pair with both answers", shown.drawn >= 2 && shown.text.includes(String(example.exact_distance)) && shown.text.includes(`Gap ${example.gap}`), shown.text.slice(0, 200));
    }
    await accessible(p, `accuracy of ${name}`);
    await p.click("#theme");
    await accessible(p, `accuracy of ${name}, dark`);
    await reachable(p, `accuracy of ${name}`);
    await shot(p, `accuracy_${decks.length}_dark`);
    await p.click("#theme");
    await p.evaluate(() => scrollTo(0, 0));
    await shot(p, `accuracy_${decks.length}`);
    check(`${name}: no trouble`, p.trouble.length === 0, p.trouble.join("; "));
    await p.close();
  }
}
