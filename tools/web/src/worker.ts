// A thread that runs `deck`: gets the compiled module once, then arguments and files, answers with
// what the run printed and wrote. Whoever wants a run to end ends the thread.
import createDeck from "deck-engine";
import { internalError, Kept, run, type Factory, type Files, type Result } from "./engine";

/** `keep`: the files are those that changed since the last request, and the deck is looked at again. */
export type Request = { code: WebAssembly.Module } | { id: number; args: string[]; files: Files } | { id: number; keep: string; files: Record<string, Uint8Array> };

let code: WebAssembly.Module;
let kept: Kept | undefined;

async function lintAgain(deck: string, files: Record<string, Uint8Array>): Promise<Result> {
  kept ??= new Kept(createDeck as Factory, code);
  const stdout = await kept.lint(deck, files);
  return { exitCode: stdout ? 0 : internalError, stdout: stdout ?? new Uint8Array(), stderr: new Uint8Array(), files: {} };
}

addEventListener("message", (event: MessageEvent<Request>) => {
  const request = event.data;
  if ("code" in request) {
    code = request.code;
    return;
  }
  const answer = "keep" in request ? lintAgain(request.keep, request.files) : run(createDeck as Factory, code, request.args, request.files);
  void answer.then((result) => {
    const owned = [result.stdout, result.stderr, ...Object.values(result.files)].map((b) => b.buffer as ArrayBuffer);
    postMessage({ id: request.id, result }, { transfer: [...new Set(owned)] });
  });
});
