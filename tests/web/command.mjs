// The program as a command of node (node/deck.js of tools/web/build) against the native one: what is printed and
// written, over real files. Ends with 'N passed, N failed'.
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { ALL, check, DECK, finish, ROOT, same } from "../browser/support.mjs";

const script = process.env.COMMAND;
const scratch = mkdtempSync(join(tmpdir(), "deck-command-"));
const folders = ["native", "node"].map((n) => join(scratch, n));
const samples = readdirSync(join(ROOT, "samples")).filter((n) => n.endsWith("_0000.rad"));
for (const f of folders) {
  cpSync(join(ROOT, "samples"), f, { recursive: true });
  symlinkSync("crash_box_0000.rad", join(f, "link_0000.rad"));
}
/** Runs both, each in its folder; what one of them said and did. */
function both(args, input = "") {
  return folders.map((cwd, i) => {
    const r = spawnSync(i ? process.execPath : DECK, i ? [script, ...args] : args, { cwd, input, encoding: "latin1", maxBuffer: 1 << 30 });
    return { exit: r.status, out: r.stdout, error: r.stderr };
  });
}
const files = (folder) => readdirSync(folder, { recursive: true }).filter((n) => statSync(join(folder, n)).isFile()).sort().map((n) => [relative(folder, join(folder, n)), readFileSync(join(folder, n), "latin1")]);
function alike(name, args, input) {
  const [native, node] = both(args, input);
  check(`${name}: as the native program says it`, native.exit === node.exit && native.out === node.out && native.error === node.error, `exit codes ${native.exit} and ${node.exit}; ${node.error.slice(0, 300)}`);
}

for (const name of ALL ? samples : ["crash_box_0000.rad", "every_mistake_0000.rad", "include_tree_0000.rad"])
  for (const args of [["lint", name], ["gaps", name, "--json", "-"], ["parts", name, "--json", "-"]]) alike(args.slice(0, 2).join(" "), args);
alike("a deck by a link", ["params", "link_0000.rad"]);
alike("a deck on standard input", ["lint", "-"], readFileSync(join(ROOT, "samples/too_close_0000.rad")));
alike("a folder", ["lint", ".", "--statistics"]);
alike("a deck that is not there", ["lint", "none_0000.rad"]);
alike("wrong usage", ["gaps"]);
alike("colours where there is no terminal", ["rules"]);
alike("a conversion", ["convert", "include_tree_0000.rad", "--units", "kg,m,s", "--verify", "-o", "out/metric", "--report", "losses.json"]);
alike("a repair in place", ["fix", "crash_box_0000.rad", "--strategy", "reduce-gap", "--in-place", "--backup"]);
const [native, node] = folders.map(files);
same("both have written the same files", node.map(([n]) => n), native.map(([n]) => n));
for (const [i, [name, text]] of native.entries()) if (node[i]?.[1] !== text) check(`${name} has the same bytes`, false);
rmSync(scratch, { recursive: true });
finish();
