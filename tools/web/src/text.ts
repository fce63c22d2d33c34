// A file as text: only the lines in sight are in the page. One line may be marked, with carets below
// its columns.
import { h, replace } from "../../viewer/src/dom";
import { bytesOf } from "./tree";

const ROW = 20;
/** Browsers draw no taller elements; longer files are shown around the line that is asked for. */
const MOST = 1_500_000;

export interface Mark {
  line: number;
  column: number;
  endColumn: number;
}

/** Bytes of a line as a reader sees them. */
export function shown(latin: string): string {
  return new TextDecoder().decode(bytesOf(latin)).replace(/\t/g, "→").replace(/[\u0000-\u001f\u007f\u202a-\u202e\u2066-\u2069]/g, "�");
}

export class TextView {
  readonly element = h("div", { class: "text-view", tabindex: "0", role: "region", "aria-label": "Text of the file" });
  private readonly spacer = h("div", { class: "text-spacer" });
  private readonly window = h("div", { class: "text-window" });
  private text = "";
  private starts: number[] = [0];
  private first = 0;
  private mark: Mark | null = null;

  constructor() {
    this.spacer.append(this.window);
    this.element.append(this.spacer);
    this.element.addEventListener("scroll", () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.element);
  }

  get lines(): number {
    return this.starts.length;
  }
  line(number: number): string {
    const from = this.starts[number - 1];
    if (from === undefined) return "";
    const to = this.starts[number] ?? this.text.length + 1;
    return this.text.slice(from, to - 1).replace(/[\r\n]+$/, "");
  }

  /** `starts`: where the lines of the text begin. */
  show(text: string, starts: number[], mark: Mark | null): void {
    this.text = text;
    this.starts = starts;
    this.mark = mark;
    const wanted = mark ? mark.line - 1 : 0;
    this.first = this.starts.length <= MOST ? 0 : Math.max(0, Math.min(wanted - MOST / 2, this.starts.length - MOST));
    this.spacer.style.height = `${Math.min(this.starts.length - this.first, MOST) * ROW + ROW}px`;
    this.element.style.setProperty("--digits", String(String(this.starts.length).length));
    const top = (wanted - this.first) * ROW;
    const height = this.element.clientHeight;
    if (mark && (top < this.element.scrollTop + ROW || top > this.element.scrollTop + height - 3 * ROW)) this.element.scrollTop = Math.max(0, top - height / 3);
    this.draw();
  }

  private draw(): void {
    const from = Math.max(0, Math.floor(this.element.scrollTop / ROW) - 5);
    const to = Math.min(this.starts.length - this.first, from + Math.ceil(this.element.clientHeight / ROW) + 10);
    this.window.style.transform = `translateY(${from * ROW}px)`;
    const rows: Node[] = [];
    for (let i = from; i < to; ++i) {
      const number = this.first + i + 1;
      const line = this.line(number).slice(0, 4000);
      const marked = this.mark?.line === number;
      const row = h("div", { class: `text-line${marked ? " marked" : ""}${line.startsWith("#") ? " quiet" : line.startsWith("/") ? " keyword" : ""}` }, h("span", { class: "number" }, number));
      if (marked && this.mark) {
        const a = Math.min(this.mark.column - 1, line.length);
        const b = Math.max(a, Math.min(this.mark.endColumn - 1, line.length));
        row.append(shown(line.slice(0, a)), h("mark", null, shown(line.slice(a, b)) || " "), shown(line.slice(b)));
      } else row.append(shown(line));
      rows.push(row);
    }
    replace(this.window, ...rows);
  }
}
