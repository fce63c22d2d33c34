// Bundles src/main.ts and src/style.css with esbuild.
//   node build.mjs [--modules DIR] [--out DIR] [--cpp FILE] [--minify no]
// --modules: the node_modules to take packages from (default: beside this file)
// --out:     writes viewer.js and viewer.css; --cpp: a C++ source with both as strings
import { createRequire } from "node:module";
import { mkdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const options = {};
for (let i = 2; i < process.argv.length; i += 2)
  options[process.argv[i].replace(/^--/, "")] = process.argv[i + 1];
const modules = resolve(options.modules ?? join(here, "node_modules"));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

/** `./x.ts?text` is the bundled script of a thread, as a text. */
const threads = {
  name: "threads",
  setup: (build) => {
    build.onResolve({ filter: /\?text$/ }, (from) => ({ path: resolve(from.resolveDir, from.path.replace(/\?text$/, "")), namespace: "thread" }));
    build.onLoad({ filter: /.*/, namespace: "thread" }, async (file) => ({ contents: (await bundle({ entryPoints: [file.path] })).outputFiles[0].text, loader: "text" }));
  },
};
const bundle = (entries) =>
  esbuild.build({
    bundle: true,
    write: false,
    minify: options.minify !== "no",
    format: "iife",
    target: ["es2022"],
    charset: "ascii",
    legalComments: "inline",
    nodePaths: [modules],
    logLevel: "warning",
    plugins: [threads],
    ...entries,
  });

const result = await bundle({
  entryPoints: { viewer: join(here, "src/main.ts"), style: join(here, "src/style.css") },
  outdir: join(here, "out"),
});
const text = (end) => result.outputFiles.find((f) => f.path.endsWith(end)).text;
const script = text("viewer.js");
const style = text("style.css");
if (/<\/script|<!--/i.test(script) || /<\/style/i.test(style))
  throw new Error("the bundle holds a tag that would end its element in a page");

// Raw string literals in pieces; the delimiter must not occur in the text.
function literal(text) {
  if (text.includes(')"v~')) throw new Error("the delimiter of the string literals occurs in the text");
  if (text.includes("\0") || text.includes("\r")) throw new Error("the bundle holds a byte that no literal can");
  const characters = Array.from(text);
  const pieces = ['""'];
  for (let i = 0; i < characters.length; i += 8000)
    pieces.push(`R"v~(${characters.slice(i, i + 8000).join("")})v~"`);
  return pieces.join("\n");
}

if (options.out) {
  mkdirSync(options.out, { recursive: true });
  writeFileSync(join(options.out, "viewer.js"), script);
  writeFileSync(join(options.out, "viewer.css"), style);
}
if (options.cpp)
  writeFileSync(
    options.cpp,
    `// Generated from tools/viewer; do not edit.
#include "report/html/page_steps.hpp"
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Woverlength-strings"
#endif
namespace deck::detail {
const ViewerBundle& viewer_bundle() {
  static constexpr char script[] = ${literal(script)};
  static constexpr char style[] = ${literal(style)};
  static const ViewerBundle bundle{{script, sizeof(script) - 1}, {style, sizeof(style) - 1}, {}};
  return bundle;
}
}  // namespace deck::detail
`,
  );
