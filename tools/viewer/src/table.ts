// A table that draws only the rows in sight: hundreds of thousands of rows scroll like twenty.
// Sorting by column, selection with the keyboard, roles for screen readers.
import { h, replace } from "./dom";

export interface Column<T> {
  key: string;
  title: string;
  hint?: string;
  width: string; // a track of a CSS grid
  right?: boolean;
  value(row: T): number | string; // for sorting
  cell(row: T): Node | string;
}

export class VirtualTable<T> {
  readonly element: HTMLElement;
  private readonly head: HTMLElement;
  private readonly titles: HTMLElement;
  private readonly body: HTMLElement;
  private readonly spacer: HTMLElement;
  private readonly window: HTMLElement;
  private rows: T[] = [];
  private shown: T[] = [];
  private sortKey: string;
  private descending: boolean;
  private selected: T | null = null;
  private drawn = "";

  constructor(
    private columns: Column<T>[],
    private readonly options: {
      label: string;
      sort: string;
      descending: boolean;
      rowHeight?: number;
      select(row: T | null): void;
      open?(row: T): void;
      classOf?(row: T): string;
      same?(a: T, b: T): boolean;
    },
  ) {
    this.sortKey = options.sort;
    this.descending = options.descending;
    this.titles = h("div", { class: "vt-titles", role: "row" });
    this.head = h("div", { class: "vt-head" }, this.titles);
    this.window = h("div", { class: "vt-window" });
    this.spacer = h("div", { class: "vt-spacer" }, this.window);
    this.body = h("div", { class: "vt-body", tabindex: 0, role: "rowgroup", "aria-label": options.label }, this.spacer);
    this.element = h("div", { class: "vt", role: "grid", "aria-label": options.label }, this.head, this.body);
    this.body.addEventListener("scroll", () => {
      this.head.scrollLeft = this.body.scrollLeft;
      this.draw();
    });
    this.body.addEventListener("keydown", (e) => this.key(e));
    this.window.addEventListener("click", (e) => {
      const row = (e.target as Element).closest<HTMLElement>("[data-index]");
      if (row) this.choose(this.shown[Number(row.dataset.index)]);
    });
    this.window.addEventListener("dblclick", () => this.selected && options.open?.(this.selected));
    new ResizeObserver(() => this.draw()).observe(this.body);
    this.drawHead();
  }

  setColumns(columns: Column<T>[]): void {
    this.columns = columns;
    this.drawHead();
    this.sort();
  }

  setRows(rows: T[]): void {
    this.rows = rows;
    this.sort();
  }

  /** Rows in the order shown. */
  get order(): T[] {
    return this.shown;
  }

  setSelected(row: T | null, reveal: boolean): void {
    const same = this.options.same ?? ((a, b) => a === b);
    this.selected = row === null ? null : (this.shown.find((r) => r === row || same(r, row)) ?? null);
    if (reveal && this.selected) this.reveal(this.shown.indexOf(this.selected));
    this.draw(true);
  }

  focus(): void {
    this.body.focus();
  }

  private get height(): number {
    return this.options.rowHeight ?? 30;
  }

  private sort(): void {
    const column = this.columns.find((c) => c.key === this.sortKey) ?? this.columns[0];
    const sign = this.descending ? -1 : 1;
    const keyed = this.rows.map((row, i) => ({ row, i, v: column.value(row) }));
    keyed.sort((a, b) => (a.v < b.v ? -sign : a.v > b.v ? sign : a.i - b.i));
    this.shown = keyed.map((k) => k.row);
    this.spacer.style.height = `${this.shown.length * this.height}px`;
    this.element.setAttribute("aria-rowcount", String(this.shown.length));
    this.draw(true);
  }

  private drawHead(): void {
    this.element.style.setProperty("--tracks", this.columns.map((c) => c.width).join(" "));
    replace(
      this.titles,
      ...this.columns.map((c) => {
        const active = c.key === this.sortKey;
        return h(
          "button",
          {
            type: "button",
            role: "columnheader",
            class: `vt-title${c.right ? " right" : ""}${active ? " active" : ""}`,
            title: c.hint,
            "aria-sort": active ? (this.descending ? "descending" : "ascending") : "none",
            onclick: () => {
              this.descending = active ? !this.descending : typeof (this.rows[0] && c.value(this.rows[0])) === "number";
              this.sortKey = c.key;
              this.drawHead();
              this.sort();
            },
          },
          c.title,
          active && h("span", { class: "vt-arrow", "aria-hidden": "true" }, this.descending ? "↓" : "↑"),
        );
      }),
    );
  }

  private draw(force = false): void {
    const first = Math.max(0, Math.floor(this.body.scrollTop / this.height) - 4);
    const last = Math.min(this.shown.length, first + Math.ceil(this.body.clientHeight / this.height) + 9);
    const range = `${first}-${last}`;
    if (!force && range === this.drawn) return;
    this.drawn = range;
    this.window.style.transform = `translateY(${first * this.height}px)`;
    const items: HTMLElement[] = [];
    for (let i = first; i < last; i++) {
      const row = this.shown[i];
      const on = row === this.selected;
      items.push(
        h(
          "div",
          {
            class: `vt-row${on ? " selected" : ""} ${this.options.classOf?.(row) ?? ""}`,
            role: "row",
            "data-index": i,
            "aria-rowindex": i + 1,
            "aria-selected": on ? "true" : "false",
          },
          ...this.columns.map((c) => {
            const content = c.cell(row);
            return h("div", { class: c.right ? "right" : "", role: "gridcell", title: typeof content === "string" ? content : null }, content);
          }),
        ),
      );
    }
    replace(this.window, ...items);
  }

  private choose(row: T): void {
    this.selected = row;
    this.draw(true);
    this.options.select(row);
  }

  private reveal(index: number): void {
    const top = index * this.height;
    if (top < this.body.scrollTop) this.body.scrollTop = top;
    else if (top + this.height > this.body.scrollTop + this.body.clientHeight)
      this.body.scrollTop = top + this.height - this.body.clientHeight;
  }

  private key(e: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.body.clientHeight / this.height) - 1);
    const step: Record<string, number> = {
      ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity,
    };
    if (e.key === "Enter" && this.selected) {
      this.options.open?.(this.selected);
      e.preventDefault();
    } else if (e.key in step && this.shown.length > 0) {
      this.move(step[e.key]);
      e.preventDefault();
    }
  }

  /** Moves the selection. */
  move(by: number): void {
    if (this.shown.length === 0) return;
    const from = this.selected ? this.shown.indexOf(this.selected) : by > 0 ? -1 : this.shown.length;
    const to = Math.min(Math.max(from + by, 0), this.shown.length - 1);
    this.reveal(to);
    this.choose(this.shown[to]);
  }
}
