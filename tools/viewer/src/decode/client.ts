// Asks a thread for the model. The thread's source lies in the page, which is one file.
import { blockText } from "../data";
import { decode, type Blocks, type Model } from "./model";
import source from "./worker.ts?text";

const inThread = (blocks: Blocks, say: (done: number, next: string) => void): Promise<Model> =>
  new Promise((done, failed) => {
    const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    const worker = new Worker(address);
    const end = () => {
      worker.terminate();
      URL.revokeObjectURL(address);
    };
    worker.onerror = (e) => {
      end();
      failed(new Error(e.message));
    };
    worker.onmessage = (e: MessageEvent<{ done: number; next: string } | { model: Model } | { failed: string }>) => {
      if ("done" in e.data) return say(e.data.done, e.data.next);
      end();
      if ("model" in e.data) done(e.data.model);
      else failed(new Error(e.data.failed));
    };
    worker.postMessage(blocks);
  });

/** The model, and whether a thread made it: where the browser gives the page none, it is decoded here. */
export async function loadModel(coarse: boolean, say: (done: number, next: string) => void): Promise<Model & { beside: boolean }> {
  const blocks = { meta: blockText("deck-meta")!, mesh: blockText("deck-mesh")!, contacts: blockText("deck-contacts")!, coarse };
  try {
    return { ...(await inThread(blocks, say)), beside: true };
  } catch {
    return { ...(await decode(blocks, say)), beside: false };
  }
}
