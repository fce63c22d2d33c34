// Puts the extension together in a folder of its own: one bundled script, the grammar made from the
// keyword schemas, manifest and pages.
//   node build.mjs [--modules DIR] [--out DIR]
// --modules: the node_modules to take packages from (default: beside this file); --out: default build
import { createRequire } from "node:module";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { grammar, schemasOf } from "./grammar.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../..");
const options = {};
for (let i = 2; i < process.argv.length; i += 2) options[process.argv[i].replace(/^--/, "")] = process.argv[i + 1];
const modules = resolve(options.modules ?? join(here, "node_modules"));
const out = resolve(options.out ?? join(here, "build"));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

/** All keyword schemas of the project. */
export function schemas() {
  const folder = join(root, "schemas/keywords");
  return readdirSync(folder)
    .filter((f) => f.endsWith(".json"))
    .sort()
    .flatMap((f) => schemasOf(JSON.parse(readFileSync(join(folder, f), "utf8"))));
}

const bundle = (entry, outfile, more) =>
  esbuild.build({ entryPoints: [join(here, "src", entry)], outfile: join(out, "dist", outfile), bundle: true, minify: true, target: "es2022", nodePaths: [modules], logLevel: "warning", ...more });

rmSync(join(out, "dist"), { recursive: true, force: true });
mkdirSync(join(out, "syntaxes"), { recursive: true });
const { metafile } = await bundle("extension.ts", "extension.js", { platform: "node", format: "cjs", external: ["vscode"], metafile: true });
writeFileSync(join(out, "syntaxes/radioss.tmLanguage.json"), JSON.stringify(grammar(schemas())));

// The licences of the packages that the script is bundled from.
const bundled = new Set(Object.keys(metafile.inputs).flatMap((f) => f.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//g)?.at(-1).slice(13, -1) ?? []));
const notice = (name) => {
  const folder = join(modules, name);
  const file = readdirSync(folder).find((f) => /^licen[cs]e/i.test(f));
  return `${name}\n\n${file ? readFileSync(join(folder, file), "utf8") : JSON.parse(readFileSync(join(folder, "package.json"), "utf8")).license}\n`;
};
writeFileSync(join(out, "NOTICES.txt"), [...bundled].sort().map(notice).join("\n----\n\n"));

// The version has its home in CMakeLists.txt; what only development needs stays here.
const { scripts, devDependencies, private: _, ...manifest } = JSON.parse(readFileSync(join(here, "package.json"), "utf8"));
manifest.version = readFileSync(join(root, "CMakeLists.txt"), "utf8").match(/project\(\w+ VERSION ([\d.]+)/)[1];
writeFileSync(join(out, "package.json"), JSON.stringify(manifest, null, 2));
writeFileSync(join(out, ".vscodeignore"), "*.vsix\n");
for (const name of ["README.md", "language-configuration.json", "icon.png", "screenshot.png"]) copyFileSync(join(here, name), join(out, name));
copyFileSync(join(root, "LICENSE"), join(out, "LICENSE"));
