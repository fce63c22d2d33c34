// Thread that decodes the model: receives blocks, returns typed arrays by transfer.
import { decode, type Blocks } from "./model";

/** Distinct buffers of all arrays in a value. */
function memory(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (Array.isArray(value)) {
    // Lists of numbers have no buffers.
    if (typeof value[0] === "object") for (const v of value) memory(v, found);
  } else if (value !== null && typeof value === "object") for (const v of Object.values(value)) memory(v, found);
  return found;
}

const post = postMessage as (message: unknown, transfer?: ArrayBuffer[]) => void;
let tell: (coarse: boolean) => void = () => {};
const coarse = new Promise<boolean>((done) => (tell = done));

onmessage = async (event: MessageEvent<Blocks | boolean>) => {
  if (typeof event.data === "boolean") return tell(event.data);
  try {
    const model = await decode(event.data, () => coarse, (done, next) => post({ done, next }));
    post({ model }, [...memory(model)]);
  } catch (e) {
    post({ failed: String(e) });
  }
};
