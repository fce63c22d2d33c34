// A thread that runs `deck`: gets the compiled module once, then arguments and files, answers with
// what the run printed and wrote. Whoever wants a run to end ends the thread.
import createDeck from "deck-engine";
import { run, type Factory, type Files } from "./engine";

export type Request = { code: WebAssembly.Module } | { id: number; args: string[]; files: Files };

let code: WebAssembly.Module;

addEventListener("message", (event: MessageEvent<Request>) => {
  const request = event.data;
  if ("code" in request) {
    code = request.code;
    return;
  }
  void run(createDeck as Factory, code, request.args, request.files).then((result) => {
    const owned = [result.stdout, result.stderr, ...Object.values(result.files)].map((b) => b.buffer as ArrayBuffer);
    postMessage({ id: request.id, result }, { transfer: [...new Set(owned)] });
  });
});
