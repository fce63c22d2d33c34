// The program `deck` as a function over files in memory: every call has a machine of its own, so
// that nothing of one run is left for the next, whatever became of it. Only `Kept` goes on with a
// deck that it has.

export type Files = Record<string, string | Uint8Array>;
export interface Result {
  /** As the program's; 4 (internal error) also where the machine gave up: stderr says why. */
  exitCode: number;
  stdout: Uint8Array;
  stderr: Uint8Array;
  /** What the run wrote, by name. */
  files: Record<string, Uint8Array>;
}

interface Stat {
  mode: number;
}
interface FileSystem {
  isDir(mode: number): boolean;
  lstat(path: string): Stat;
  readdir(path: string): string[];
  mkdirTree(path: string): void;
  chdir(path: string): void;
  writeFile(path: string, data: Uint8Array, options: { canOwn: boolean }): void;
  readFile(path: string): Uint8Array;
  makedev(major: number, minor: number): number;
  registerDevice(device: number, operations: object): void;
  mkdev(path: string, mode: number, device: number): void;
  open(path: string, flags: string): unknown;
  close(stream: unknown): void;
  getStream(fd: number): unknown;
}
interface Machine {
  FS: FileSystem;
  callMain(args: string[]): number;
  ccall(name: string, result: "number", types: ["string"], args: [string]): number;
}
export type Factory = (options: object) => Promise<Machine>;

const HOME = "/decks";
export const internalError = 4;

/** Bytes that a run prints. */
class Sink {
  private parts: Uint8Array[] = [];
  private size = 0;
  readonly operations = {
    open: (stream: { seekable: boolean }) => {
      stream.seekable = false;
    },
    write: (_stream: object, memory: Int8Array, offset: number, length: number) => {
      this.add(new Uint8Array(memory.buffer, memory.byteOffset + offset, length).slice());
      return length;
    },
  };
  say(text: string): void {
    this.add(new TextEncoder().encode(`deck: ${text}\n`));
  }
  add(bytes: Uint8Array): void {
    this.parts.push(bytes);
    this.size += bytes.length;
  }
  /** All that was printed since the last call. */
  take(): Uint8Array {
    const out = new Uint8Array(this.size);
    let at = 0;
    for (const p of this.parts) {
      out.set(p, at);
      at += p.length;
    }
    this.parts = [];
    this.size = 0;
    return out;
  }
}

/** A name below the folder that the program runs in; null: it leads out of it. */
export function plainName(name: string): string | null {
  const parts: string[] = [];
  for (const part of name.replace(/\\/g, "/").split("/")) {
    if (part === "" || part === ".") continue;
    if (part !== "..") parts.push(part);
    else if (parts.pop() === undefined) return null;
  }
  return parts.length > 0 ? parts.join("/") : null;
}

function sameBytes(a: Uint8Array, b: Uint8Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return false;
  return true;
}

function collect(fs: FileSystem, folder: string, given: Map<string, Uint8Array>, out: Record<string, Uint8Array>): void {
  for (const name of fs.readdir(folder)) {
    if (name === "." || name === "..") continue;
    const path = `${folder}/${name}`;
    if (fs.isDir(fs.lstat(path).mode)) {
      collect(fs, path, given, out);
      continue;
    }
    const relative = path.slice(HOME.length + 1);
    const bytes = fs.readFile(path);
    const before = given.get(relative);
    if (!before || !sameBytes(before, bytes)) out[relative] = bytes;
  }
}

function whyStopped(e: unknown): string {
  const text = e instanceof Error ? e.message : String(e);
  if (/memory/i.test(text)) return "out of memory: a page has 2 GB";
  if (/stack|recursion/i.test(text)) return "the deck is nested too deeply";
  return `internal error: ${text}`;
}

/** A machine in an empty folder, with its two outputs. */
async function start(create: Factory, code: WebAssembly.Module, stdout: Sink, stderr: Sink): Promise<Machine> {
  const machine = await create({
    instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => {
      void WebAssembly.instantiate(code, imports).then(done);
      return {};
    },
    stdin: () => null,
    print: () => {},
    printErr: (text: string) => stderr.say(text),
  });
  const fs = machine.FS;
  fs.mkdirTree(HOME);
  fs.chdir(HOME);
  [stdout, stderr].forEach((sink, i) => {
    const device = fs.makedev(80, i);
    fs.registerDevice(device, sink.operations);
    fs.mkdev(`/dev/deck${i}`, 0o666, device);
    fs.close(fs.getStream(i + 1));
    fs.open(`/dev/deck${i}`, "w"); // the lowest number that is free: the one just closed
  });
  return machine;
}

function put(fs: FileSystem, name: string, bytes: Uint8Array): string {
  const plain = plainName(name);
  if (plain === null) throw new Error(`${name}: a file of this name cannot be given`);
  const slash = plain.lastIndexOf("/");
  if (slash > 0) fs.mkdirTree(`${HOME}/${plain.slice(0, slash)}`);
  fs.writeFile(`${HOME}/${plain}`, bytes, { canOwn: false });
  return plain;
}

/**
 * Runs `deck` with these arguments (without the program's name) in a folder that holds these files.
 * @param create what emscripten made of the program
 * @param code its compiled module
 */
export async function run(create: Factory, code: WebAssembly.Module, args: string[], files: Files): Promise<Result> {
  const stdout = new Sink();
  const stderr = new Sink();
  const written: Record<string, Uint8Array> = {};
  let exitCode = internalError;
  try {
    const machine = await start(create, code, stdout, stderr);
    const given = new Map<string, Uint8Array>();
    for (const [name, content] of Object.entries(files)) {
      const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
      given.set(put(machine.FS, name, bytes), bytes);
    }
    exitCode = machine.callMain(args);
    collect(machine.FS, HOME, given, written);
  } catch (e) {
    exitCode = internalError;
    stderr.say(whyStopped(e));
  }
  return { exitCode, stdout: stdout.take(), stderr: stderr.take(), files: written };
}

/** One machine for a deck that is edited: of a text it looks only at what is not as in the last one. */
export class Kept {
  private readonly stdout = new Sink();
  private machine: Machine | null = null;

  constructor(private readonly create: Factory, private readonly code: WebAssembly.Module) {}

  /**
   * What `deck lint DECK --no-geometry --json -` prints after these files have changed; null: the command is to be asked
   * itself. After that the machine is gone, and the next call has to bring all files.
   */
  async lint(deck: string, changed: Record<string, Uint8Array>): Promise<Uint8Array | null> {
    try {
      this.machine ??= await start(this.create, this.code, this.stdout, new Sink());
      for (const [name, bytes] of Object.entries(changed)) put(this.machine.FS, name, bytes);
      const printed = this.machine.ccall("deck_lint_again", "number", ["string"], [deck]) === 1;
      const text = this.stdout.take();
      if (printed) return text;
    } catch {
      // A machine that gave up says nothing more; the command says why.
    }
    this.machine = null;
    return null;
  }
}
