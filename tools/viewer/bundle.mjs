// How the sources of the page become one script: also for tests that run parts of them in node.
import { readFileSync } from "node:fs";
import { deflateSync } from "node:zlib";

/** WebAssembly modules become packed bytes in the script. */
const packed = {
  name: "packed",
  setup: (build) =>
    build.onLoad({ filter: /\.wasm$/ }, (file) => ({ contents: deflateSync(readFileSync(file.path), { level: 9 }), loader: "binary" })),
};

/** `esbuild`: the package; `modules`: the node_modules that the sources import from. */
export const bundle = (esbuild, modules, options) =>
  esbuild.build({
    bundle: true,
    target: ["es2022"],
    charset: "ascii",
    legalComments: "inline",
    nodePaths: [modules],
    logLevel: "warning",
    plugins: [packed],
    ...options,
  });
