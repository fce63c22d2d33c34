// Runs of `deck` as the page asks for them: threads that can be ended, and the module they share.
import type { Files, Result } from "./engine";

export class Cancelled extends Error {
  constructor() {
    super("cancelled");
  }
}

/** base64 of gzip in an element of the page. */
export async function unpacked(id: string): Promise<ArrayBuffer> {
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

  protected get started(): boolean {
    return this.worker !== null;
  }

  /** Rejects with Cancelled where it is ended before it is done. */
  run(args: string[], files: Files): Promise<Result> {
    // What a machine took is given back at once only with its thread.
    const stays = (args[0] === "lint" && args.includes("--no-geometry")) || args[0] === "params" || args[0] === "show";
    return this.ask({ args, files }, () => stays);
  }

  protected async ask(request: object, stays: (r: Result) => boolean): Promise<Result> {
    this.halt();
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
        if (!stays(e.data.result)) {
          worker.terminate();
          if (this.worker === worker) this.worker = null;
        }
        resolve(e.data.result);
      };
      worker.postMessage({ id, ...request });
    });
  }

  private halt(): void {
    ++this.id;
    this.stop?.();
    this.stop = null;
  }
  protected end(): void {
    this.worker?.terminate();
    this.worker = null;
  }

  cancel(): void {
    this.halt();
  }

  /** Ends the thread as well. */
  close(): void {
    this.cancel();
    this.end();
  }
}

/** The thread that keeps a deck: findings of its text after an edit. */
export class KeptLane extends Lane {
  private there = new Map<string, Uint8Array>();
  private before: Promise<unknown> = Promise.resolve();
  private newest = 0;

  /**
   * What `deck lint DECK --json -` prints; null where only the command itself can say. A newer text waits for
   * the one before it and takes the place of those between.
   */
  async lint(deck: string, files: Map<string, Uint8Array>): Promise<Uint8Array | null> {
    const mine = ++this.newest;
    const last = this.before;
    let done = () => {};
    this.before = new Promise<void>((ok) => (done = ok));
    try {
      await last;
      if (mine !== this.newest) throw new Cancelled();
      return await this.follow(deck, files);
    } finally {
      done();
    }
  }

  private async follow(deck: string, files: Map<string, Uint8Array>): Promise<Uint8Array | null> {
    if (!this.started || [...this.there.keys()].some((n) => !files.has(n))) {
      this.end();
      this.there.clear();
    }
    const changed = Object.fromEntries([...files].filter(([n, b]) => this.there.get(n) !== b));
    this.there = new Map(files);
    try {
      const r = await this.ask({ keep: deck, files: changed }, (x) => x.exitCode === 0);
      return r.exitCode === 0 ? r.stdout : null;
    } catch (e) {
      this.end(); // nobody knows which files arrived
      throw e;
    }
  }

  override cancel(): void {
    ++this.newest;
    super.cancel();
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
