// Makes the page of the engine: one file, and a folder to be served.
//   node pack.mjs --engine DIR --command FILE --modules NODE_MODULES --out DIR
// --engine: deck.js and deck.wasm; gets engine.mjs as well, the function run() for other programs.
// --command: what emscripten made of the program for node; becomes node/deck.js, beside its deck.wasm.
// --out: deck.html; site/index.html (the same) with site/service-worker.js
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const options = {};
for (let i = 2; i < process.argv.length; i += 2) options[process.argv[i].replace(/^--/, "")] = resolve(process.argv[i + 1]);
const esbuild = createRequire(join(options.modules, "x.js"))("esbuild");
const limit = 8e6;

/** What emscripten wrote asks for modules of node where it finds itself there; pages have none. */
async function bundled(entry, more = {}) {
  const result = await esbuild.build({
    entryPoints: [join(here, "src", entry)],
    bundle: true,
    write: false,
    minify: true,
    target: ["es2022"],
    charset: "ascii",
    legalComments: "none",
    format: "iife",
    nodePaths: [options.modules],
    alias: { "deck-engine": join(options.engine, "deck.js") },
    external: ["fs", "path", "crypto", "perf_hooks", "worker_threads"],
    logLevel: "warning",
    ...more,
  });
  return result.outputFiles[0].text;
}
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString("base64");

const [page, style, worker, service, bridge, engine, command] = await Promise.all([
  bundled("main.ts"),
  bundled("style.css"),
  bundled("worker.ts"),
  bundled("service-worker.ts"),
  bundled("../../vscode/src/bridge.ts"),
  bundled("engine.ts", { format: "esm", minify: false }),
  bundled("../node.mjs", { format: "cjs", platform: "node", alias: { "deck-engine": options.command }, banner: { js: "#!/usr/bin/env node" } }),
]);
if (/<\/script|<!--/i.test(page + bridge) || /<\/style/i.test(style)) throw new Error("the bundle holds a tag that would end its element in a page");
writeFileSync(join(options.engine, "engine.mjs"), engine);

// Scripts may run, also those of the report in its frame; threads come from the page itself. Nothing may
// be fetched: there is no connect-src, and default-src is none. 'self' is for the service worker.
const policy = [
  "default-src 'none'", "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:", "style-src 'unsafe-inline'", "img-src data: blob:",
  "worker-src blob: 'self'", "frame-src 'self'", "base-uri 'none'", "form-action 'none'",
].join("; ");
const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>deck: Radioss contact decks</title>
<link rel="icon" href="data:,">
<style>${style}</style>
</head>
<body>
<noscript>This page is a program: it needs scripts.</noscript>
<script type="text/plain" id="engine">${packed(readFileSync(join(options.engine, "deck.wasm")))}</script>
<script type="text/plain" id="sample">${packed(readFileSync(join(here, "../../samples/crash_box_0000.rad")))}</script>
<script type="text/plain" id="bridge">${packed(Buffer.from(bridge))}</script>
<script type="text/plain" id="worker">${packed(Buffer.from(worker))}</script>
<script>${page}</script>
</body>
</html>
`;
if (html.length > limit) throw new Error(`deck.html would have ${html.length} bytes; the limit is ${limit}`);
mkdirSync(join(options.out, "site"), { recursive: true });
mkdirSync(join(options.out, "node"), { recursive: true });
writeFileSync(join(options.out, "node/deck.js"), command, { mode: 0o755 });
writeFileSync(join(options.out, "deck.html"), html);
writeFileSync(join(options.out, "site/index.html"), html);
writeFileSync(join(options.out, "site/service-worker.js"), service.replace("deck-VERSION", `deck-${createHash("sha256").update(html).digest("hex").slice(0, 12)}`));
const mb = (n) => `${(n / 1e6).toFixed(2)} MB`;
console.log(`deck.wasm ${mb(statSync(join(options.engine, "deck.wasm")).size)}, deck.html ${mb(html.length)}`);
