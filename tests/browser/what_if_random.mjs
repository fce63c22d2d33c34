// Settings under test on random decks: what the modules of the page compute is, to the last bit, what
// the library makes of the deck written with these settings. Runs in node, without a browser.
//   node what_if_random.mjs CASES-PROGRAM NODE-MODULES COUNT
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { cpus, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath, pathToFileURL } from "node:url";
import { bundle } from "../../tools/viewer/bundle.mjs";
import { difference } from "./difference.mjs";

const [program, modules, count] = [process.argv[2], resolve(process.argv[3]), Number(process.argv[4])];
const viewer = fileURLToPath(new URL("../../tools/viewer", import.meta.url));
const scratch = mkdtempSync(join(tmpdir(), "what_if_"));
const built = join(scratch, "page.mjs");
await bundle(createRequire(join(modules, "x.js"))("esbuild"), modules, {
  stdin: { contents: 'export * from "./data"; export * from "./evaluate"; export * from "./look";', resolveDir: join(viewer, "src"), loader: "ts" },
  outfile: built, write: true, format: "esm", platform: "neutral",
});
let blocks = {};
globalThis.document = { getElementById: (id) => (id in blocks ? { textContent: blocks[id] } : null) };
const { loadMeta, loadMesh, loadContacts, Evaluator } = await import(pathToFileURL(built));

/** Rows of the page as the library names them. */
function answer(evaluator, mesh, fields) {
  const { meta, data } = evaluator;
  const ids = (list) => [...new Set(list)].map((n) => mesh.nodeId[n]);
  const items = (list, width, i) => ids(list.subarray(width * i, width * i + width));
  return evaluator.evaluate([fields]).map((r, i) => {
    const edges = meta.contacts[i].kind === "edge_edge";
    return {
      complete: r.complete,
      role: meta.contacts[i].role, gapmin: r.setting.gapmin, max_gap: r.setting.maxGap, igap: r.setting.igap, irem_gap: r.setting.irem,
      penetrations: r.rows.map((row) => ({
        secondary: items(data.contacts[i].secondaryNode, edges ? 2 : 1, row.secondary),
        main: items(data.contacts[i].mainNode, edges ? 2 : 4, row.main),
        depth: row.depth, gap: row.gap, distance: row.distance, normal: row.normal, on_surface: row.onSurface,
        action: row.action, gap0: row.gap0, p0: row.p0, moved_by: row.movedBy,
      })),
    };
  });
}

const seen = { decks: 0, compared: 0, beyond: 0, unlike: 0, rows: 0, removed: 0 };
const kinds = new Set();
function judge(line) {
  const it = JSON.parse(line);
  blocks = it;
  const meta = loadMeta();
  const mesh = loadMesh();
  const evaluator = new Evaluator(meta, loadContacts(meta, mesh));
  seen.decks++;
  for (const { fields, expected } of it.trials) {
    const mine = answer(evaluator, mesh, fields);
    if (mine.some((c) => !c.complete)) {
      seen.beyond++;
      continue;
    }
    for (const c of mine) {
      delete c.complete;
      seen.rows += c.penetrations.length;
      kinds.add(`Igap ${c.igap}`).add(`Irem_gap ${c.irem_gap}`);
      for (const p of c.penetrations) kinds.add(p.action);
    }
    const d = difference(mine, expected, "contacts");
    seen.compared++;
    if (d && seen.unlike++ < 5) console.log(`FAILED  deck ${it.seed} (TYPE${it.type}) with ${JSON.stringify(fields)}: ${d}`);
  }
}

const workers = Math.min(cpus().length, 4);
const share = Math.ceil(count / workers);
await Promise.all(
  Array.from({ length: workers }, async (_, k) => {
    const child = spawn(program, [String(1 + k * share), String(Math.min(share, count - k * share))], { stdio: ["ignore", "pipe", "inherit"] });
    const ended = new Promise((done) => child.on("close", done));
    for await (const line of createInterface({ input: child.stdout })) judge(line);
    if ((await ended) !== 0) throw new Error("the program of the cases failed");
  }),
);
rmSync(scratch, { recursive: true });
// Nothing may pass because nothing was tried.
const wanted = ["none", "node-stiffness-zero", "segment-stiffness-zero", "node-moved", "gap-reduced", "edge-stiffness-zero", "Igap 0", "Igap 1", "Igap 2", "Igap 3", "Irem_gap 1", "Irem_gap 2"];
const lacking = wanted.filter((k) => !kinds.has(k));
const enough = lacking.length === 0 && seen.beyond < seen.compared / 4;
if (!enough) console.log(`FAILED  the cases cover everything: lacking ${lacking.join(", ") || "nothing"}, ${seen.beyond} beyond the page of ${seen.compared}`);
console.log(`what-if on random decks: ${seen.decks} decks, ${seen.compared} settings with ${seen.rows} rows compared, ${seen.beyond} beyond what a page carries, ${seen.unlike} unlike`);
const failed = Number(seen.unlike > 0) + Number(!enough);
console.log(`${2 - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
