// A table that draws visible rows only and sizes columns by content: ids and numbers are never cut, texts shrink, columns without
// room are left out by rank and offered in the chooser.
import { dropDown, h, plainTable, replace } from "../dom";
import { headOf } from "./columns";

export interface Column<T> {
  key: string;
  title: string;
  hint?: string;
  /** Ids and numbers keep their width; texts are cut with dots. */
  kind: "id" | "number" | "text";
  least?: number; // minimum width of a text while other columns can go
  extra?: number; // width of a button or of bold letters beside the text
  /** Highest rank is left out first; without rank never. */
  rank?: number;
  value(row: T): number | string; // for sorting
  text(row: T): string; // in full: for widths, tooltip and exports
  cell?(row: T, room: number): Node | string; // as drawn in `room` pixels, if different
}

const padding = 16;
const leastText = 104;
const mostMeasured = 5000;
const tables: { setSelected(row: null, reveal: boolean): void }[] = [];
/** Deselects the rows of all tables. */
export const unselectRows = (): void => tables.forEach((t) => t.setSelected(null, false));
let pen: CanvasRenderingContext2D | null = null;
let family = "";
const widths = new Map<string, number>(); // to set a font and to measure with it takes far longer

/** Pixels of a text in a cell, or in a heading. */
export function widthOf(text: string, bold: boolean): number {
  const key = `${bold ? "b" : " "}${text}`;
  const known = widths.get(key);
  if (known !== undefined) return known;
  if (widths.size > 20000) widths.clear();
  pen ??= document.createElement("canvas").getContext("2d");
  if (!pen) return 8 * text.length;
  family ||= getComputedStyle(document.body).fontFamily;
  const font = `${bold ? 600 : 400} ${bold ? 12 : 13}px ${family}`;
  if (pen.font !== font) pen.font = font;
  const width = pen.measureText(text).width;
  widths.set(key, width);
  return width;
}

// ---- tooltip with the full text of a cut cell, on hover and keyboard focus ----

const box = h("div", { class: "full-text", role: "tooltip", hidden: true });

/** Shows `text` below `at`; null hides it. */
export function fullText(text: string | null, at?: DOMRect): void {
  box.hidden = text === null || !at;
  if (text === null || !at) return;
  if (!box.isConnected) document.body.append(box);
  box.textContent = text;
  const left = Math.min(Math.max(at.left, 6), window.innerWidth - box.offsetWidth - 6);
  const below = at.bottom + 4 + box.offsetHeight < window.innerHeight;
  box.style.left = `${Math.max(6, left)}px`;
  box.style.top = `${below ? at.bottom + 2 : at.top - box.offsetHeight - 2}px`;
}

/** A unit has a line of its own where there is no room. */
function titleWidth(title: string): number {
  const [name, unit] = title.split(/ (?=\()/);
  return unit ? Math.max(widthOf(name, true), widthOf(`${unit} ↓`, true)) : widthOf(`${name} ↓`, true);
}

export class VirtualTable<T> {
  readonly element: HTMLElement;
  private readonly head = h("div", { class: "vt-head", role: "rowgroup" });
  private readonly body: HTMLElement;
  private readonly spacer: HTMLElement;
  private readonly window = h("div", { class: "vt-window" });
  private readonly id = `vt${tables.push(this)}`;
  private rows: T[] = [];
  private shown: T[] = [];
  private sortKey: string;
  private descending: boolean;
  private selected: T | null = null;
  private drawn = "";
  private headDrawn = "";
  private due = false;
  /** Sizes after the last layout: reading them in between would force another one. */
  private room = { width: 0, height: 0, head: 0, top: 0 };
  private columns: Column<T>[] = [];
  private natural = new Map<string, number>();
  /** Widths set by the user. */
  private readonly dragged = new Map<string, number>();
  /** Columns with one number, or nothing, in every row: hidden unless chosen. */
  private constant = new Set<Column<T>>();
  /** Columns chosen by the user; null: as many as fit. */
  private chosen: string[] | null = null;
  private active = 0; // column of the keyboard focus
  private choosers: (() => void)[] = [];

  constructor(
    private readonly all: Column<T>[],
    private readonly options: {
      label: string;
      name?: string; // class of the element: name-table
      /** Least and largest number of visible rows. */
      rows?: [number, number];
      hideEmpty?: boolean;
      sort: string;
      descending: boolean;
      /** `keys`: the click, for modifier keys. */
      select(row: T | null, keys?: MouseEvent): void;
      /** Marks more rows as selected. */
      chosen?(row: T): boolean;
      open?(row: T): void;
      /** Action of the space bar on the chosen row. */
      toggle?(row: T): void;
      context?(row: T, x: number, y: number): void;
      changed?(): void;
      classOf?(row: T): string;
      same?(a: T, b: T): boolean;
    },
  ) {
    this.sortKey = options.sort;
    this.descending = options.descending;
    this.spacer = h("div", { class: "vt-spacer", role: "rowgroup" }, this.window);
    this.body = h("div", { class: "vt-body", tabindex: 0, role: "grid", "aria-label": options.label }, this.head, this.spacer);
    this.element = h("div", { class: `vt${options.name ? ` ${options.name}-table` : ""}` }, this.body);
    this.body.addEventListener("scroll", () => {
      fullText(null);
      this.room.top = this.body.scrollTop;
      this.draw();
    });
    this.body.addEventListener("keydown", (e) => this.key(e));
    this.body.addEventListener("blur", () => fullText(null));
    this.window.addEventListener("mouseover", (e) => this.tell((e.target as Element).closest<HTMLElement>("[data-key]")));
    this.window.addEventListener("mouseleave", () => fullText(null));
    const rowAt = (e: Event) => {
      const row = (e.target as Element).closest<HTMLElement>("[data-index]");
      return row ? this.shown[Number(row.dataset.index)] : null;
    };
    this.window.addEventListener("click", (e) => {
      const row = rowAt(e);
      if (row === null) return;
      this.choose(row, e);
      const cell = (e.target as Element).closest<HTMLElement>("[data-key]");
      if (cell) this.active = this.columns.findIndex((c) => c.key === cell.dataset.key);
    });
    this.window.addEventListener("dblclick", () => this.selected && options.open?.(this.selected));
    this.body.addEventListener("contextmenu", (e) => {
      const row = rowAt(e) ?? this.selected;
      if (row === null || !options.context) return;
      e.preventDefault();
      const at = this.window.querySelector(".selected")?.getBoundingClientRect();
      options.context(row, e.clientX || (at?.left ?? 0) + 40, e.clientY || (at?.bottom ?? 0));
    });
    new ResizeObserver(() => {
      this.lookAround();
      this.layOut();
      if (this.revealed >= 0) this.reveal(this.revealed);
      this.draw();
    }).observe(this.body);
    this.all = all.map((c) => ({ ...c, title: headOf(c.key, c.title) }));
    this.columns = this.all;
  }

  /** Maximum of visible rows. */
  set most(rows: number) {
    this.options.rows![1] = rows;
    this.setHeight();
    this.lookAround();
    if (this.selected) this.reveal(this.shown.indexOf(this.selected));
  }
  private setHeight(): void {
    const { rows: sight } = this.options;
    if (sight) this.element.style.setProperty("--rows", String(Math.max(sight[0], Math.min(this.rows.length, sight[1]))));
  }
  /** `hold`: rows keep their place, new ones last: an edited row stays under the pointer. */
  setRows(rows: T[], hold = false): void {
    const before = this.shown;
    if (this.options.hideEmpty) this.element.hidden = rows.length === 0;
    this.rows = rows;
    this.setHeight();
    this.measure();
    this.layOut();
    this.sort();
    const same = this.options.same;
    if (!hold || !same) return;
    const place = (row: T) => {
      const at = before.findIndex((r) => same(r, row));
      return at < 0 ? before.length : at;
    };
    const places = new Map(this.shown.map((r) => [r, place(r)]));
    this.shown.sort((a, b) => places.get(a)! - places.get(b)!);
    this.drawSoon();
  }

  /** Rows in display order. */
  get order(): T[] { return this.shown; }

  setSelected(row: T | null, reveal: boolean): void {
    const same = this.options.same ?? ((a, b) => a === b);
    this.selected = row === null ? null : (this.shown.find((r) => r === row || same(r, row)) ?? null);
    if (reveal && this.selected) this.reveal(this.shown.indexOf(this.selected));
    this.drawSoon();
  }

  /** Visible columns as CSV, RFC 4180. */
  csv(): string {
    const quote = (t: string) => (/[",\r\n]/.test(t) ? `"${t.replace(/"/g, '""')}"` : t);
    const line = (cells: string[]) => `${cells.map(quote).join(",")}\r\n`;
    const plain = (c: Column<T>, row: T) => {
      const v = c.value(row);
      return c.kind === "number" && typeof v === "number" ? (Number.isFinite(v) ? String(v) : "") : c.text(row);
    };
    return line(this.columns.map((c) => c.title)) + this.shown.map((row) => line(this.columns.map((c) => plain(c, row)))).join("");
  }

  // ---- columns ------------------------------------------------------------------------------

  /** Columns, row order and widths set by the user; empty if none. */
  get state(): string {
    const sorted = this.sortKey === this.options.sort && this.descending === this.options.descending;
    const widths = [...this.dragged].map(([k, w]) => `${k}*${Math.round(w)}`).join(" ");
    const text = [this.chosen?.join(" ") ?? "", sorted ? "" : `${this.descending ? "-" : ""}${this.sortKey}`, widths].join(";");
    return text === ";;" ? "" : text;
  }
  set state(text: string) {
    const [columns = "", sort = "", widths = ""] = text.split(";");
    const known = (key: string) => this.all.some((c) => c.key === key);
    this.chosen = columns ? columns.split(" ").filter(known) : null;
    if (this.chosen?.length === 0) this.chosen = null;
    const key = sort.replace(/^-/, "");
    this.sortKey = known(key) ? key : this.options.sort;
    this.descending = known(key) ? sort.startsWith("-") : this.options.descending;
    this.dragged.clear();
    for (const item of widths.split(" ")) {
      const [k, w] = item.split("*");
      if (known(k) && Number(w) > 0) this.dragged.set(k, Number(w));
    }
    this.layOut();
    this.sort();
  }

  /** Menu with a checkbox per column. */
  chooser(): HTMLElement {
    const summary = h("summary", { class: "button small" });
    const list = h("div", { class: "menu-list columns" });
    const menu = dropDown({}, summary, list);
    const draw = () => {
      summary.textContent = this.columns.length === this.all.length ? "Columns" : `Columns ${this.columns.length} of ${this.all.length}`;
      if (list.childElementCount === 0) return;
      for (const box of list.querySelectorAll("input")) box.checked = this.columns.some((c) => c.key === box.value);
    };
    menu.addEventListener("toggle", () => {
      if (!menu.open) return;
      replace(list, ...this.all.map((c) => {
        const box = h("input", { type: "checkbox", value: c.key, checked: this.columns.includes(c), onchange: () => {
          const keys = new Set(this.columns.map((x) => x.key));
          box.checked ? keys.add(c.key) : keys.delete(c.key);
          if (keys.size === 0) keys.add(c.key);
          this.chosen = this.all.map((x) => x.key).filter((k) => keys.has(k));
          this.changed();
        } });
        return h("label", { class: "check" }, box, c.title);
      }), h("button", { type: "button", class: "small", onclick: () => {
        this.chosen = null;
        this.dragged.clear();
        this.changed();
      } }, "as many as fit"));
    });
    this.choosers.push(draw);
    draw();
    return menu;
  }

  private changed(): void {
    this.layOut();
    this.draw(true);
    this.options.changed?.();
  }

  /** The first rows, for paper. */
  plain(most: number): HTMLElement {
    return plainTable(this.columns.map((c) => c.title), this.shown.slice(0, most).map((r) => this.columns.map((c) => c.text(r))));
  }

  private measure(): void {
    // Equal words in every row may matter; equal numbers or dashes do not.
    const told = this.rows.length < 3 ? [] : this.all.filter((c) => c.kind === "number" || (c.rank !== undefined && c.text(this.rows[0]) === "–"));
    this.constant = new Set(told.filter((c) => this.rows.every((r) => c.value(r) === c.value(this.rows[0]))));
    const step = Math.max(1, Math.ceil(this.rows.length / mostMeasured));
    for (const c of this.all) {
      // The widest text is among the longest.
      const longest: string[] = [];
      for (let i = 0; i < this.rows.length; i += step) {
        const t = c.text(this.rows[i]);
        if (longest.length < 6) longest.push(t);
        else if (t.length > longest[5].length) longest[5] = t;
        else continue;
        longest.sort((a, b) => b.length - a.length);
      }
      const title = titleWidth(c.title) + 6;
      this.natural.set(c.key, Math.ceil(Math.max(title, ...longest.map((t) => widthOf(t, false) * 1.02 + (c.extra ?? 0))) + padding));
    }
  }

  private layOut(): void {
    const room = this.room.width - 18;
    if (room <= 0 || this.natural.size === 0) return;
    const natural = (c: Column<T>) => this.natural.get(c.key)!;
    const title = (c: Column<T>) => titleWidth(c.title) + 6 + padding;
    let narrow = false;
    const least = (c: Column<T>) => this.dragged.get(c.key) ?? (c.kind === "text" ? Math.max(title(c), Math.min(natural(c), narrow ? leastText : (c.least ?? leastText))) : natural(c));
    let columns = this.all.filter((c) => (this.chosen ? this.chosen.includes(c.key) : !this.constant.has(c)));
    const sum = () => columns.reduce((n, c) => n + least(c), 0);
    while (!this.chosen && sum() > room) {
      const ranked = columns.filter((c) => c.rank !== undefined);
      if (ranked.length === 0 && narrow) break;
      if (ranked.length === 0) {
        narrow = true; // a telephone
        continue;
      }
      const last = ranked.reduce((a, b) => (b.rank! > a.rank! ? b : a));
      columns = columns.filter((c) => c !== last);
    }
    // The rest of the width goes to the texts, each up to its own width, then evenly.
    const width = new Map(columns.map((c) => [c, least(c)]));
    let left = room - sum();
    const texts = columns.filter((c) => c.kind === "text" && !this.dragged.has(c.key));
    for (const wanted of [natural, () => Infinity])
      for (let open = texts.filter((c) => width.get(c)! < wanted(c)); left > 1 && open.length > 0; open = open.filter((c) => width.get(c)! < wanted(c))) {
        const share = left / open.length;
        for (const c of open) {
          const more = Math.min(share, wanted(c) - width.get(c)!);
          width.set(c, width.get(c)! + more);
          left -= more;
        }
      }
    const tracks = columns.map((c) => `${Math.floor(width.get(c)!)}px`).join(" ");
    const same = tracks === this.tracks && columns.every((c, i) => c === this.columns[i]);
    this.tracks = tracks;
    this.widths = width;
    this.columns = columns;
    this.body.style.setProperty("--tracks", tracks);
    this.body.style.setProperty("--least", `${Math.ceil(sum()) + 16}px`);
    this.body.setAttribute("aria-colcount", String(this.all.length));
    this.drawHead();
    if (!same) this.drawSoon();
    for (const f of this.choosers) f();
  }

  private tracks = "";
  private widths = new Map<Column<T>, number>();
  private readonly width = (c: Column<T>): number => Math.floor(this.widths.get(c) ?? Infinity) - padding;

  private grip(c: Column<T>): HTMLElement {
    const grip = h("span", { class: "vt-grip", title: "Drag: width · double click: as wide as its content" });
    const set = (w: number) => {
      this.dragged.set(c.key, Math.max(c.kind === "text" ? 48 : this.natural.get(c.key)!, w));
      this.changed();
    };
    grip.addEventListener("pointerdown", (e) => {
      e.preventDefault();
      const from = e.clientX;
      const was = grip.parentElement!.getBoundingClientRect().width;
      // Each step redraws the head, so listen on the page.
      const move = (m: PointerEvent) => set(was + m.clientX - from);
      window.addEventListener("pointermove", move);
      window.addEventListener("pointerup", () => window.removeEventListener("pointermove", move), { once: true });
    });
    grip.addEventListener("dblclick", () => set(this.natural.get(c.key)!));
    return grip;
  }

  // ---- rows ---------------------------------------------------------------------------------

  private sort(): void {
    const column = this.all.find((c) => c.key === this.sortKey) ?? this.all[0];
    const sign = this.descending ? -1 : 1;
    const values = this.rows.map((row) => column.value(row));
    const before = (a: number, b: number) => (values[a] < values[b] ? -sign : values[a] > values[b] ? sign : a - b);
    // Rows mostly come sorted: deepest first.
    let sorted = true;
    for (let i = 1; sorted && i < values.length; i++) sorted = before(i - 1, i) < 0;
    this.shown = sorted ? this.rows.slice() : Array.from(values, (_, i) => i).sort(before).map((i) => this.rows[i]);
    this.spacer.style.height = `${this.shown.length * this.height}px`;
    this.body.setAttribute("aria-rowcount", String(this.shown.length + 1));
    this.drawHead();
    this.drawSoon();
  }

  private get height(): number { return 30; }

  private drawHead(): void {
    const what = `${this.columns.map((c) => c.key).join(" ")} ${this.sortKey} ${this.descending}`;
    if (what === this.headDrawn) return;
    this.headDrawn = what;
    const focused = this.head.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset.sort : null;
    replace(this.head, h("div", { class: "vt-titles", role: "row", "aria-rowindex": 1 }, ...this.columns.map((c) => {
      const active = c.key === this.sortKey;
      return h("div", { class: `vt-title ${c.kind}${active ? " active" : ""}`, role: "columnheader", "aria-sort": active ? (this.descending ? "descending" : "ascending") : "none" },
        h("button", {
          type: "button", title: c.hint, "data-sort": c.key,
          onclick: () => {
            this.descending = active ? !this.descending : typeof (this.rows[0] && c.value(this.rows[0])) === "number";
            this.sortKey = c.key;
            this.sort();
            this.options.changed?.();
          },
        }, c.title, active && h("span", { "aria-hidden": "true" }, this.descending ? "\u00a0↓" : "\u00a0↑")),
        this.grip(c));
    })));
    if (focused) this.head.querySelector<HTMLElement>(`[data-sort="${focused}"]`)?.focus();
  }

  /** Draws once after all simultaneous changes. */
  private drawSoon(): void {
    if (this.due) return;
    this.due = true;
    queueMicrotask(() => { this.due = false; this.draw(true); });
  }

  private draw(force = false): void {
    const first = Math.max(0, Math.floor(Math.min(this.room.top, this.shown.length * this.height - this.room.height) / this.height) - 4);
    const last = Math.min(this.shown.length, first + Math.ceil(this.room.height / this.height) + 9);
    const range = `${first}-${last}`;
    if (!force && range === this.drawn) return;
    this.drawn = range;
    this.window.style.transform = `translateY(${first * this.height}px)`;
    const items: HTMLElement[] = [];
    for (let i = first; i < last; i++) {
      const row = this.shown[i];
      const on = row === this.selected || this.options.chosen?.(row) === true;
      items.push(
        h("div", {
          class: `vt-row${on ? " selected" : ""} ${this.options.classOf?.(row) ?? ""}`, role: "row", id: `${this.id}-${i}`,
          "data-index": i, "aria-rowindex": i + 2, "aria-selected": on ? "true" : "false",
        }, ...this.columns.map((c) => h("div", { class: c.kind, role: "gridcell", "data-key": c.key }, c.cell ? c.cell(row, this.width(c)) : c.text(row)))),
      );
    }
    replace(this.window, ...items);
    const at = this.selected === null ? -1 : this.shown.indexOf(this.selected);
    if (at >= first && at < last) this.body.setAttribute("aria-activedescendant", `${this.id}-${at}`);
    else this.body.removeAttribute("aria-activedescendant");
  }

  /** Shows the full text of a cut or folded cell. */
  private tell(cell: HTMLElement | null): void {
    const row = cell?.closest<HTMLElement>("[data-index]");
    const column = this.columns.find((c) => c.key === cell?.dataset.key);
    if (!cell || !row || !column) return fullText(null);
    const cut = [cell, ...cell.querySelectorAll("*")].some((e) => e.scrollWidth > e.clientWidth && e.clientWidth > 0);
    const text = column.text(this.shown[Number(row.dataset.index)]);
    fullText(cut || cell.querySelector(".fold") ? text : null, cell.getBoundingClientRect());
  }

  private choose(row: T, keys?: MouseEvent): void {
    this.selected = row;
    this.draw(true);
    this.options.select(row, keys);
  }

  private lookAround(): void {
    const { clientWidth: width, clientHeight: height, scrollTop: top } = this.body;
    this.room = { width, height, head: this.head.offsetHeight, top };
  }

  /** Row last scrolled into view, until the table has its final height in this frame; -1: none. */
  private revealed = -1;
  private reveal(index: number): void {
    if (this.room.height === 0) this.lookAround();
    this.revealed = index;
    setTimeout(() => (this.revealed = -1), 50);
    const top = index * this.height;
    const room = this.room.height - this.room.head;
    const to = top < this.room.top ? top : top + this.height > this.room.top + room ? top + this.height - room : this.room.top;
    if (to !== this.room.top) this.body.scrollTop = this.room.top = to;
  }

  private key(e: KeyboardEvent): void {
    if (e.target !== this.body) return;
    const page = Math.max(1, Math.floor(this.room.height / this.height) - 2);
    const step: Record<string, number> = {
      ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity,
    };
    const side = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (e.key === "Enter" && this.selected) this.options.open?.(this.selected);
    else if (e.key === " " && this.selected && this.options.toggle) this.options.toggle(this.selected);
    else if (e.key in step && this.shown.length > 0) this.move(step[e.key]);
    else if (side) this.active = Math.min(Math.max(this.active + side, 0), this.columns.length - 1);
    else return;
    e.preventDefault();
    const cell = this.window.querySelector<HTMLElement>(`.selected > :nth-child(${this.active + 1})`);
    if (side) cell?.scrollIntoView({ block: "nearest", inline: "nearest" });
    for (const other of this.window.querySelectorAll(".at")) other.classList.remove("at");
    cell?.classList.add("at");
    this.tell(cell);
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
