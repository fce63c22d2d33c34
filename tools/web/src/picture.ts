// The picture of the gap report and the text: a place in the report leads to the text, a finding to the picture. In the frame speaks the
// script that speaks for it in the editor (tools/vscode/src/bridge.ts).
import type { FromPage, ToPage } from "../../vscode/src/messages";

export class Picture {
  private frame: HTMLIFrameElement | null = null;
  private ready = false;
  private wanted: ToPage | null = null;
  /** What the report answered last: for tests. */
  shown: string | null = null;

  constructor(private readonly bridge: Promise<string>, open: (file: string, line: number) => void) {
    addEventListener("message", (e: MessageEvent<FromPage>) => {
      if (!this.frame || e.source !== this.frame.contentWindow) return;
      const m = e.data;
      if (m.type === "open") open(m.place.file, m.place.line);
      else if (m.type === "shown") this.shown = m.what;
      else if (m.type === "ready") {
        this.ready = true;
        if (this.wanted) this.ask(this.wanted);
      }
    });
  }

  /** The page with that script. */
  async with(page: string): Promise<string> {
    const end = page.lastIndexOf("</body>");
    return `${page.slice(0, end)}<script>window.acquireVsCodeApi=()=>({postMessage:(m)=>parent.postMessage(m,"*")})</script><script>${await this.bridge}</script>${page.slice(end)}`;
  }
  use(frame: HTMLIFrameElement): void {
    this.frame = frame;
    this.ready = false;
  }

  /** `line`: of a node or its interface's header. */
  show(file: string, line: number): void {
    this.ask({ type: "show", file, line, header: line });
  }
  private ask(m: ToPage): void {
    this.wanted = this.ready ? null : m;
    // The frame has no origin of its own that could be named.
    if (this.ready) this.frame?.contentWindow?.postMessage(m, "*");
  }
}
