// How the sources of the page become one script: also for tests that run parts of them in node.
import { resolve } from "node:path";

/** `./x.ts?text` is the bundled script of a thread, as a text. */
const threads = (esbuild, modules, options) => ({
  name: "threads",
  setup: (build) => {
    build.onResolve({ filter: /\?text$/ }, (from) => ({ path: resolve(from.resolveDir, from.path.replace(/\?text$/, "")), namespace: "thread" }));
    build.onLoad({ filter: /.*/, namespace: "thread" }, async (file) => {
      const made = await bundle(esbuild, modules, { entryPoints: [file.path], write: false, format: "iife", minify: options.minify !== false });
      return { contents: made.outputFiles[0].text, loader: "text" };
    });
  },
});

/** `esbuild`: the package; `modules`: the node_modules that the sources import from. */
export const bundle = (esbuild, modules, options) =>
  esbuild.build({
    bundle: true,
    target: ["es2022"],
    charset: "ascii",
    legalComments: "inline",
    nodePaths: [modules],
    logLevel: "warning",
    plugins: [threads(esbuild, modules, options)],
    ...options,
  });
