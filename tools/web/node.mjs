// The program as a command of node: `node deck.js ARGUMENTS` is what `deck ARGUMENTS` is, over the files
// of the machine. The language server must not wait: it is called when bytes arrive, and when it has asked for it.
import createDeck from "deck-engine";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { isatty } from "node:tty";

const piece = 65536; // of what is handed over at once: it goes over the stack of the program

async function start() {
  const machine = await createDeck({
    wasmBinary: readFileSync(join(__dirname, "deck.wasm")), // what emscripten wrote would fetch it
    preRun: [(m) => Object.assign(m.ENV, process.env)],
    printErr: (text) => process.stderr.write(`deck: ${text}\n`),
  });
  for (const fd of [0, 1, 2]) machine.FS.getStream(fd).tty = isatty(fd);
  return machine;
}

/** Until the editor says exit, or closes. */
function serve(machine) {
  return new Promise((resolve, reject) => {
    let timer;
    const step = () => {
      clearTimeout(timer);
      try {
        const wait = machine.ccall("deck_step", "number", [], []);
        if (wait < -1) resolve(-2 - wait);
        else if (wait >= 0) timer = setTimeout(step, wait);
      } catch (e) {
        reject(e);
      }
    };
    const soon = () => {
      clearTimeout(timer);
      timer = setTimeout(step, 0); // what arrives in several pieces is looked at together
    };
    process.stdin.on("data", (bytes) => {
      for (let at = 0; at < bytes.length; at += piece) {
        const part = bytes.subarray(at, at + piece);
        machine.ccall("deck_receive", null, ["array", "number"], [part, part.length]);
      }
      soon();
    });
    process.stdin.on("end", () => {
      machine.ccall("deck_close", null, [], []);
      soon();
    });
  });
}

async function main() {
  const args = process.argv.slice(2);
  try {
    const machine = await start();
    const code = machine.callMain(args);
    const serving = args[0] === "lsp" && machine.ccall("deck_step", "number", [], []) !== -4;
    return serving ? await serve(machine) : code;
  } catch (e) {
    const text = e instanceof Error ? e.message : String(e);
    process.stderr.write(`deck: ${/memory/i.test(text) ? "out of memory: as WebAssembly it has 2 GB" : `internal error: ${text}`}\n`);
    return 4;
  }
}
void main().then((code) => process.exit(code));
