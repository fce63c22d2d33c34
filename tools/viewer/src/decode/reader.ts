// Reads the page's blocks: base64, integers of variable length, doubles as byte planes.

declare global {
  interface Uint8ArrayConstructor {
    fromBase64?(text: string): Uint8Array<ArrayBuffer>; // newer than the types
  }
}

export function fromBase64(text: string): Uint8Array {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const bytes = atob(text);
  const out = new Uint8Array(bytes.length);
  for (let i = 0; i < out.length; i++) out[i] = bytes.charCodeAt(i);
  return out;
}

/** Doubles from byte planes, lowest first. */
export function fromPlanes(b: Uint8Array): Float64Array {
  const n = b.length / 8;
  const out = new Float64Array(n);
  const words = new Uint32Array(out.buffer);
  for (let i = 0; i < n; i++) {
    words[2 * i] = b[i] | (b[n + i] << 8) | (b[2 * n + i] << 16) | (b[3 * n + i] << 24);
    words[2 * i + 1] = b[4 * n + i] | (b[5 * n + i] << 8) | (b[6 * n + i] << 16) | (b[7 * n + i] << 24);
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
  s(): number { const v = this.u(); return v % 2 === 0 ? v / 2 : -(v + 1) / 2; }
  /** As u(), faster for one byte. */
  small(): number {
    const c = this.b[this.at];
    if (c >= 0x80) return this.s();
    this.at++;
    return (c >> 1) ^ -(c & 1);
  }
  bytes(n: number): Uint8Array { return this.b.subarray(this.at, (this.at += n)); }
  f64(n: number): Float64Array { return fromPlanes(this.bytes(8 * n)); }
  // The loops below dominate the load time of a page with a million elements, so each reads numbers of up to four bytes itself.
  /** Running sums of signed differences (sign in the lowest bit); most have one byte. */
  private sums<T extends Uint32Array | Float64Array>(out: T): T {
    const b = this.b;
    let at = this.at;
    let last = 0;
    for (let i = 0; i < out.length; i++) {
      let v = b[at++];
      if (v >= 0x80) {
        let c = b[at++];
        v = (v & 0x7f) | ((c & 0x7f) << 7);
        if (c >= 0x80) v |= ((c = b[at++]) & 0x7f) << 14;
        if (c >= 0x80) v |= ((c = b[at++]) & 0x7f) << 21;
        if (c >= 0x80) {
          // Too long for the fast path.
          this.at = at - 4;
          out[i] = last += this.s();
          at = this.at;
          continue;
        }
      }
      out[i] = last += (v >> 1) ^ -(v & 1);
    }
    this.at = at;
    return out;
  }
  /** Values below 2^32; differences may be twice as large. */
  deltas32(n: number): Uint32Array { return this.sums(new Uint32Array(n)); }
  deltas(n: number): Float64Array { return this.sums(new Float64Array(n)); }
  /** Doubles as whole numbers over a power of ten, or by byte planes. */
  decimals(n: number): Float64Array {
    const places = this.u();
    if (places === 0) return this.f64(n);
    let power = 1;
    for (let k = 1; k < places; k++) power *= 10;
    const out = this.deltas(n);
    for (let i = 0; i < n; i++) out[i] /= power;
    return out;
  }
  /** Numbers relative to `next`, the lowest unused one, counted backwards; 0 is `next` itself. */
  backwards(n: number, next: number): [Uint32Array, number] {
    const b = this.b;
    const out = new Uint32Array(n);
    let at = this.at;
    for (let i = 0; i < n; i++) {
      let v = b[at++];
      if (v >= 0x80) {
        let c = b[at++];
        v = (v & 0x7f) | ((c & 0x7f) << 7);
        if (c >= 0x80) v |= ((c = b[at++]) & 0x7f) << 14;
        if (c >= 0x80) v |= ((c = b[at++]) & 0x7f) << 21;
        if (c >= 0x80) {
          this.at = at - 4;
          v = this.u();
          at = this.at;
        }
      }
      out[i] = next - v;
      if (v === 0) next++;
    }
    this.at = at;
    return [out, next];
  }
  /** Values by index into distinct ones. */
  palette(n: number): Float64Array {
    const values = this.f64(this.u());
    const out = new Float64Array(n);
    if (values.length === 1) out.fill(values[0]);
    if (values.length > 1) for (let i = 0; i < n; i++) out[i] = values[this.u()];
    return out;
  }
}
