// The files that a page was given: as they were, as they are now, and what became of them.
import { gunzipSync, gzipSync, unzipSync, zipSync } from "fflate";
import { plainName } from "./engine";

export interface Edit {
  file: string;
  line: number;
  column: number;
  end_line: number;
  end_column: number;
  text: string;
}

const isZip = (b: Uint8Array) => b[0] === 0x50 && b[1] === 0x4b && b[2] === 3 && b[3] === 4;
const isGzip = (b: Uint8Array) => b[0] === 0x1f && b[1] === 0x8b;
const base = (name: string) => name.slice(name.lastIndexOf("/") + 1);
/** No page holds more. */
const most = 1.5e9;
const mostShown = 2e8;

// Decks are bytes: a character for each keeps those that are no UTF-8.
export function latin(bytes: Uint8Array): string {
  let out = "";
  for (let i = 0; i < bytes.length; i += 32768) out += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return out;
}
export function bytesOf(text: string): Uint8Array {
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

/** Files that were dropped, archives unpacked. Throws an Error that says what is too large. */
export function unpack(given: { name: string; bytes: Uint8Array }[]): Map<string, Uint8Array> {
  const out = new Map<string, Uint8Array>();
  let total = 0;
  const put = (name: string, bytes: Uint8Array) => {
    const plain = plainName(name);
    if (plain === null) return;
    total += bytes.length;
    if (total > most) throw new Error("these files are larger than a page can hold (1.5 GB)");
    out.set(plain, bytes);
  };
  for (const { name, bytes } of given) {
    if (!isZip(bytes)) {
      put(name, bytes);
      continue;
    }
    let size = 0;
    const inside = unzipSync(bytes, {
      filter: (f) => {
        size += f.originalSize;
        if (size > most) throw new Error(`${name}: unpacked it is larger than a page can hold (1.5 GB)`);
        return !f.name.endsWith("/") && !f.name.startsWith("__MACOSX/");
      },
    });
    for (const [n, b] of Object.entries(inside)) put(n, b);
  }
  // A folder that holds everything is left out of the names.
  const names = [...out.keys()];
  const first = names[0]?.split("/")[0];
  if (names.length > 0 && names.every((n) => n.startsWith(`${first}/`))) return new Map([...out].map(([n, b]) => [n.slice((first as string).length + 1), b]));
  return out;
}

/** One archive; what is packed already is only put in. */
export function zipped(files: Record<string, Uint8Array>): Uint8Array {
  return zipSync(Object.fromEntries(Object.entries(files).map(([n, b]) => [n, isGzip(b) ? [b, { level: 0 }] : b])), { level: 6 });
}

export class Tree {
  readonly original = new Map<string, Uint8Array>();
  private files = new Map<string, Uint8Array>();
  private past: Map<string, Uint8Array>[] = [];
  private readonly texts = new WeakMap<Uint8Array, string>();
  private readonly lines = new WeakMap<Uint8Array, number[]>();

  get names(): string[] {
    return [...this.files.keys()];
  }
  get(name: string): Uint8Array | undefined {
    return this.files.get(name);
  }
  all(): Record<string, Uint8Array> {
    return Object.fromEntries(this.files);
  }
  map(): Map<string, Uint8Array> {
    return new Map(this.files);
  }
  add(files: Map<string, Uint8Array>): void {
    for (const [name, bytes] of files) {
      this.original.set(name, bytes);
      this.files.set(name, bytes);
    }
  }

  /** Starter decks, best first: those that no other file includes, by name. */
  roots(): string[] {
    const decks = this.names.filter((n) => /_0000\.rad(\.gz)?$/i.test(n)).sort();
    const some = decks.length > 0 ? decks : this.names.filter((n) => /\.(rad|k|key|dyn)(\.gz)?$/i.test(n)).sort();
    const included = new Set<string>();
    for (const n of this.names) {
      const bytes = this.files.get(n) as Uint8Array;
      if (isGzip(bytes)) continue;
      for (const m of latin(bytes.subarray(0, 4e6)).matchAll(/^#include\s+(.+?)\s*$/gm)) included.add(base(m[1].replace(/\\/g, "/")));
    }
    const free = some.filter((n) => !included.has(base(n)));
    return free.length > 0 ? free : some.length > 0 ? some : this.names.slice(0, 1);
  }

  /** The text of a file, one character a byte; packed files are unpacked. "": it is too large to be shown. */
  text(name: string): string {
    const bytes = this.files.get(name);
    if (!bytes || !this.showable(name)) return "";
    const known = this.texts.get(bytes);
    if (known !== undefined) return known;
    const text = latin(isGzip(bytes) ? gunzipSync(bytes) : bytes);
    this.texts.set(bytes, text);
    return text;
  }
  /** Where its lines begin. */
  starts(name: string): number[] {
    const bytes = this.files.get(name) as Uint8Array;
    let known = this.lines.get(bytes);
    if (!known) this.lines.set(bytes, (known = lineStarts(this.text(name))));
    return known;
  }
  /** Text takes twice its bytes here: beyond this size only the program sees it. */
  showable(name: string): boolean {
    const bytes = this.files.get(name) ?? new Uint8Array();
    // A packed file says its size, modulo 2^32, in its last four bytes.
    const size = isGzip(bytes) ? new DataView(bytes.buffer, bytes.byteOffset + bytes.length - 4, 4).getUint32(0, true) : bytes.length;
    return size <= mostShown && bytes.length <= mostShown;
  }
  packed(name: string): boolean {
    const bytes = this.files.get(name);
    return bytes !== undefined && isGzip(bytes);
  }

  /** Puts new bytes in place of files; one step that undo() takes back. */
  change(files: Record<string, Uint8Array>): void {
    this.past.push(new Map(this.files));
    for (const [name, bytes] of Object.entries(files)) this.files.set(name, bytes);
  }
  /** Places are bytes, counted from 1; edits do not overlap. */
  apply(edits: Edit[]): void {
    const changed: Record<string, Uint8Array> = {};
    for (const file of new Set(edits.map((e) => e.file))) {
      if (!this.showable(file)) throw new Error(`${file} is too large to be edited in a page`);
      const text = this.text(file);
      const starts = this.starts(file);
      const at = (line: number, column: number) => Math.min((starts[line - 1] ?? text.length) + column - 1, text.length);
      const mine = edits.filter((e) => e.file === file).map((e) => ({ from: at(e.line, e.column), to: at(e.end_line, e.end_column), by: new TextEncoder().encode(e.text) }));
      mine.sort((a, b) => a.from - b.from);
      // Bytes are copied in pieces, and the text that is shown is made of its pieces, too.
      const before = this.packed(file) ? bytesOf(text) : (this.files.get(file) as Uint8Array);
      const out = new Uint8Array(mine.reduce((size, e) => size + e.by.length - (e.to - e.from), before.length));
      let shownText = "";
      let from = 0;
      let size = 0;
      for (const e of [...mine, { from: text.length, to: text.length, by: new Uint8Array() }]) {
        for (const piece of [before.subarray(from, e.from), e.by]) {
          out.set(piece, size);
          size += piece.length;
        }
        shownText += text.slice(from, e.from) + latin(e.by);
        from = e.to;
      }
      changed[file] = this.packed(file) ? gzipSync(out) : out;
      this.texts.set(changed[file], shownText);
    }
    this.change(changed);
  }
  undo(): boolean {
    const before = this.past.pop();
    if (before) this.files = before;
    return before !== undefined;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  changed(): string[] {
    return this.names.filter((n) => this.files.get(n) !== this.original.get(n));
  }

  zip(): Uint8Array {
    return zipped(this.all());
  }
  /** What was changed as a patch that `git apply` takes. */
  patch(): string {
    const unpackedText = (b: Uint8Array | undefined) => (b ? latin(isGzip(b) ? gunzipSync(b) : b) : "");
    return this.changed().map((n) => filePatch(n, unpackedText(this.original.get(n)), this.text(n))).join("");
  }
}

export function lineStarts(text: string): number[] {
  const out = [0];
  for (let i = text.indexOf("\n"); i >= 0; i = text.indexOf("\n", i + 1)) if (i + 1 < text.length) out.push(i + 1);
  return out;
}

interface Run {
  at: number;
  old: string[];
  now: string[];
}

/** Lines with their ends that differ: line by line where their number is the same, else all between the first and the last. */
function runs(a: string[], b: string[]): Run[] {
  const out: Run[] = [];
  if (a.length === b.length) {
    for (let i = 0; i < a.length; ++i) {
      if (a[i] === b[i]) continue;
      const last = out.at(-1);
      if (last && last.at + last.old.length === i) {
        last.old.push(a[i]);
        last.now.push(b[i]);
      } else out.push({ at: i, old: [a[i]], now: [b[i]] });
    }
    return out;
  }
  let head = 0;
  while (head < a.length && head < b.length && a[head] === b[head]) ++head;
  let tail = 0;
  while (tail < a.length - head && tail < b.length - head && a[a.length - 1 - tail] === b[b.length - 1 - tail]) ++tail;
  return [{ at: head, old: a.slice(head, a.length - tail), now: b.slice(head, b.length - tail) }];
}

export function filePatch(name: string, before: string, after: string): string {
  const a = before.match(/[^\n]*\n|[^\n]+$/g) ?? [];
  const b = after.match(/[^\n]*\n|[^\n]+$/g) ?? [];
  const around = 3;
  const end = (line: string) => (line.endsWith("\n") ? line : `${line}\n\\ No newline at end of file\n`);
  const all = runs(a, b);
  if (all.length === 0) return "";
  // Runs whose surroundings touch are one piece.
  const pieces: Run[][] = [];
  for (const r of all) {
    const last = pieces.at(-1)?.at(-1);
    if (last && r.at - (last.at + last.old.length) <= 2 * around) pieces.at(-1)?.push(r);
    else pieces.push([r]);
  }
  let out = `--- a/${name}\n+++ b/${name}\n`;
  let shift = 0;
  for (const piece of pieces) {
    const first = piece[0];
    const last = piece[piece.length - 1];
    const from = Math.max(0, first.at - around);
    const to = Math.min(a.length, last.at + last.old.length + around);
    let body = "";
    let at = from;
    let more = 0;
    for (const r of piece) {
      for (; at < r.at; ++at) body += end(` ${a[at]}`);
      for (const line of r.old) body += end(`-${line}`);
      for (const line of r.now) body += end(`+${line}`);
      at += r.old.length;
      more += r.now.length - r.old.length;
    }
    for (; at < to; ++at) body += end(` ${a[at]}`);
    const count = to - from;
    out += `@@ -${count === 0 ? from : from + 1},${count} +${count + more === 0 ? from + shift : from + shift + 1},${count + more} @@\n${body}`;
    shift += more;
  }
  return out;
}
