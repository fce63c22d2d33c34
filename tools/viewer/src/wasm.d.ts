// A WebAssembly module as build.mjs bundles it: packed by zlib.
declare module "*.wasm" {
  const packed: Uint8Array;
  export default packed;
}
