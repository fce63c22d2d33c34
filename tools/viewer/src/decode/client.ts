// Requests the model from a thread; imported first, so that decoding begins before the page is built. The source of the thread is
// in the page, which is one file.
import { blockText } from "../data";
import { decode, type Blocks, type Model } from "./model";
import source from "./worker.ts?text";

type Say = (done: number, next: string) => void;

/** A thread that decodes the page's blocks; asks if the machine draws slowly. */
class Thread {
  private readonly address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  private readonly worker: Worker;
  private say: Say = () => {};
  private readonly model: Promise<Model>;

  constructor(blocks: Blocks) {
    this.worker = new Worker(this.address);
    this.model = new Promise((done, failed) => {
      this.worker.onerror = (e) => failed(new Error(e.message));
      this.worker.onmessage = (e: MessageEvent<{ done: number; next: string } | { model: Model } | { failed: string }>) => {
        if ("done" in e.data) return this.say(e.data.done, e.data.next);
        if ("failed" in e.data) return failed(new Error(e.data.failed));
        done(e.data.model);
      };
    });
    // Callers handle the error.
    this.model.catch(() => {}).finally(() => { this.worker.terminate(); URL.revokeObjectURL(this.address); });
    this.worker.postMessage(blocks);
  }

  finish(coarse: boolean, say: Say): Promise<Model> {
    this.say = say;
    this.worker.postMessage(coarse);
    return this.model;
  }
}

const blocks = (): Blocks => ({ meta: blockText("deck-meta")!, mesh: blockText("deck-mesh")!, shared: blockText("deck-shared")!, contacts: blockText("deck-contacts")! });

/** null if the browser allows no thread. */
function begin(): Thread | null {
  try {
    return new Thread(blocks());
  } catch {
    return null;
  }
}
const begun = begin();

/** The model, and if a thread made it; without threads it is decoded here. */
export async function loadModel(coarse: boolean, say: Say): Promise<Model & { beside: boolean }> {
  try {
    if (begun) return { ...(await begun.finish(coarse, say)), beside: true };
  } catch {
    // Handled below as well.
  }
  return { ...(await decode(blocks(), () => coarse, say)), beside: false };
}
