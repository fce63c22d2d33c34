// Numbers of the page's blocks: base64, whole numbers of variable length, doubles by byte planes.

declare global {
  interface Uint8ArrayConstructor {
    fromBase64?(text: string): Uint8Array<ArrayBuffer>; // newer than the types
  }
}

export function fromBase64(text: string): Uint8Array {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const table = new Uint8Array(128);
  const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (let i = 0; i < 64; i++) table[digits.charCodeAt(i)] = i;
  let end = text.length;
  while (end > 0 && text.charCodeAt(end - 1) === 61) end--;
  const out = new Uint8Array((end * 3) >> 2);
  let o = 0;
  for (let i = 0; i < end; i += 4) {
    const v =
      (table[text.charCodeAt(i)] << 18) |
      (table[text.charCodeAt(i + 1)] << 12) |
      (i + 2 < end ? table[text.charCodeAt(i + 2)] << 6 : 0) |
      (i + 3 < end ? table[text.charCodeAt(i + 3)] : 0);
    out[o++] = v >> 16;
    if (o < out.length) out[o++] = (v >> 8) & 255;
    if (o < out.length) out[o++] = v & 255;
  }
  return out;
}

export class Reader {
  private at = 0;
  constructor(private readonly b: Uint8Array) {}

  u(): number {
    let v = this.b[this.at++];
    if (v < 0x80) return v;
    v &= 0x7f;
    let scale = 128;
    for (;;) {
      const c = this.b[this.at++];
      v += (c & 0x7f) * scale;
      if (c < 0x80) return v;
      scale *= 128;
    }
  }
  s(): number {
    const v = this.u();
    return v % 2 === 0 ? v / 2 : -(v + 1) / 2;
  }
  bytes(n: number): Uint8Array {
    return this.b.subarray(this.at, (this.at += n));
  }
  f64(n: number): Float64Array {
    const bytes = new Uint8Array(8 * n);
    const b = this.b;
    let at = this.at;
    for (let plane = 0; plane < 8; plane++) for (let k = plane; k < bytes.length; k += 8) bytes[k] = b[at++];
    this.at = at;
    return new Float64Array(bytes.buffer);
  }
  deltas32(n: number): Uint32Array {
    const out = new Uint32Array(n);
    const b = this.b;
    let v = 0;
    for (let i = 0; i < n; i++) {
      // Most differences have one byte.
      const c = b[this.at];
      if (c < 0x80) {
        this.at++;
        v += (c >> 1) ^ -(c & 1);
      } else v += this.s();
      out[i] = v;
    }
    return out;
  }
  deltas(n: number): Float64Array {
    const out = new Float64Array(n);
    let v = 0;
    for (let i = 0; i < n; i++) out[i] = v += this.s();
    return out;
  }
  /** Numbers counted backwards from the lowest that has not occurred yet, `next`: 0 is that one. */
  backwards(n: number, next: number): Uint32Array {
    const out = new Uint32Array(n);
    for (let i = 0; i < n; i++) {
      const back = this.u();
      out[i] = next - back;
      if (back === 0) next++;
    }
    return out;
  }
  /** Values by index into a list of distinct ones. */
  palette(n: number): Float64Array {
    const values = this.f64(this.u());
    const out = new Float64Array(n);
    if (values.length === 1) out.fill(values[0]);
    if (values.length > 1) for (let i = 0; i < n; i++) out[i] = values[this.u()];
    return out;
  }
}
