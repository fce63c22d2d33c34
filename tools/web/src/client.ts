// Runs of `deck` as the page asks for them: threads that can be ended, and the module they share.
import type { Files, Result } from "./engine";

export class Cancelled extends Error {
  constructor() {
    super("cancelled");
  }
}

/** base64 of gzip in an element of the page. */
async function unpacked(id: string): Promise<ArrayBuffer> {
  const text = atob(document.getElementById(id)?.textContent?.trim() ?? "");
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

let parts: Promise<{ code: WebAssembly.Module; source: string }> | undefined;

/** The module, compiled once, and the source of the threads. */
export function engine(): Promise<{ code: WebAssembly.Module; source: string }> {
  parts ??= (async () => {
    const [wasm, script] = await Promise.all([unpacked("engine"), unpacked("worker")]);
    return { code: await WebAssembly.compile(wasm), source: URL.createObjectURL(new Blob([script], { type: "text/javascript" })) };
  })();
  return parts;
}

/** One thread: a run at a time. A newer run ends the one before it. */
export class Lane {
  private worker: Worker | null = null;
  private stop: (() => void) | null = null;
  private id = 0;

  get busy(): boolean {
    return this.stop !== null;
  }

  /** Rejects with Cancelled where it is ended before it is done. */
  async run(args: string[], files: Files): Promise<Result> {
    this.cancel();
    const id = ++this.id;
    const { code, source } = await engine();
    if (id !== this.id) throw new Cancelled();
    if (!this.worker) {
      this.worker = new Worker(source);
      this.worker.postMessage({ code });
    }
    const worker = this.worker;
    return new Promise((resolve, reject) => {
      this.stop = () => {
        worker.terminate();
        this.worker = null;
        reject(new Cancelled());
      };
      const failed = (why: string) => {
        this.stop = null;
        worker.terminate();
        this.worker = null;
        resolve({ exitCode: 4, stdout: new Uint8Array(), stderr: new TextEncoder().encode(`deck: internal error: ${why}\n`), files: {} });
      };
      worker.onerror = (e) => failed(e.message || "the thread ended");
      worker.onmessage = (e: MessageEvent<{ id: number; result: Result }>) => {
        if (e.data.id !== id) return;
        this.stop = null;
        // What a machine took is given back at once only with its thread.
        if (args[0] !== "lint" && args[0] !== "params" && args[0] !== "show") {
          worker.terminate();
          if (this.worker === worker) this.worker = null;
        }
        resolve(e.data.result);
      };
      worker.postMessage({ id, args, files });
    });
  }

  cancel(): void {
    ++this.id;
    this.stop?.();
    this.stop = null;
  }

  /** Ends the thread as well. */
  close(): void {
    this.cancel();
    this.worker?.terminate();
    this.worker = null;
  }
}

/** `await deck(["lint", "car_0000.rad", "--json", "-"], { "car_0000.rad": text })`: each on a thread of its own. */
export async function deck(args: string[], files: Files = {}): Promise<{ exitCode: number; stdout: string; stderr: string; files: Record<string, Uint8Array> }> {
  const lane = new Lane();
  try {
    const r = await lane.run(args.map(String), files);
    const text = (b: Uint8Array) => new TextDecoder().decode(b);
    return { exitCode: r.exitCode, stdout: text(r.stdout), stderr: text(r.stderr), files: r.files };
  } finally {
    lane.close();
  }
}
