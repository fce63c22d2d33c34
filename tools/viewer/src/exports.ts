// Exports of the page: node lists, a node group for the deck, a table, changed cards, a picture.
import { cardText, changedCard } from "./card";
import { h, shortest } from "./dom";
import type { Hit, Report } from "./report";

export function save(name: string, content: string): void {
  const url = URL.createObjectURL(new Blob([content], { type: "text/plain" }));
  saveDataUrl(name, url);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const saveDataUrl = (name: string, url: string): void => h("a", { href: url, download: name }).click();

export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Pages opened from a file may lack the clipboard API; execCommand works there.
    const area = h("textarea", { style: "position:fixed;opacity:0" }, text);
    document.body.append(area);
    area.select();
    const ok = document.execCommand("copy");
    area.remove();
    return ok;
  }
}

/** Distinct secondary node ids of rows, ascending. */
export function nodeIds(hits: Hit[]): number[] {
  const ids = new Set<number>();
  for (const x of hits) for (const n of x.nodes) if (n > 0) ids.add(n);
  return [...ids].sort((a, b) => a - b);
}

export function plainNodes(hits: Hit[]): string { return nodeIds(hits).join("\n") + "\n"; }

function idBlock(lines: string[], hits: Hit[], begin: string, perLine: number): string {
  const ids = nodeIds(hits);
  for (let i = 0; i < ids.length; i += perLine) lines.push(begin + ids.slice(i, i + perLine).map((n) => String(n).padStart(10)).join(""));
  return lines.join("\n") + "\n";
}

export function grnodBlock(hits: Hit[], id: number, title: string): string {
  return idBlock([`/GRNOD/NODE/${id}`, title.slice(0, 100)], hits, "", 10);
}

export function setBlock(hits: Hit[], id: number, title: string): string {
  return idBlock([`/SET/GENERAL/${id}`, title.slice(0, 100)], hits, "NODE      ", 9);
}

/** HyperMesh commands that mark the nodes and save them as a set. */
export function tclMarks(hits: Hit[], title: string): string {
  const ids = nodeIds(hits);
  const lines = ["*clearmark nodes 1"];
  for (let i = 0; i < ids.length; i += 50) lines.push(`*${i === 0 ? "createmark" : "appendmark"} nodes 1 ${ids.slice(i, i + 50).join(" ")}`);
  return [...lines, `*entitysetcreate "${title}" nodes 1`, "*numbersmark nodes 1 1"].join("\n") + "\n";
}

/** The table of `deck gaps --csv`. */
export function csv(report: Report, hits: Hit[]): string {
  const head =
    "interface,type,role,kind,secondary_1,secondary_2,main_1,main_2,main_3,main_4,depth,gap," +
    "distance,ratio,normal_x,normal_y,normal_z,on_surface,in_contact,action,gap0,p0,x,y,z," +
    "secondary_element,secondary_part,main_element,main_part,file,line";
  const quote = (t: string) => (/[",\r\n]/.test(t) ? `"${t.replace(/"/g, '""')}"` : t);
  const id = (v: number | undefined) => (v ? String(v) : "");
  const lines = hits.map((x) => {
    const r = x.row;
    const c = report.meta.contacts[x.contact];
    const inter = report.meta.interfaces[c.interface];
    const main = report.mainNodes(r).map((n) => report.nodeId(n));
    if (!report.isEdge(r) && main.length === 3) main.push(main[2]);
    const place = report.place(r);
    return [
      inter.id, inter.type, c.role, c.kind, x.nodes[0], id(x.nodes[1]),
      id(main[0]), id(main[1]), id(main[2]), id(main[3]), r.depth, r.gap, r.distance, x.ratio,
      ...(r.normal ?? ["", "", ""]), r.onSurface ? 1 : 0, report.isRoundOff(r) ? 0 : 1, r.action, r.gap0 ?? "", r.p0 ?? "", ...(report.point(r) ?? ["", "", ""]),
      id(report.elementId(r, "secondary")), id(report.partId(x.secondaryPart)),
      id(report.elementId(r, "main")), id(report.partId(x.mainPart)),
      place ? quote(place.file) : "", place ? place.line : "",
    ].join(",");
  });
  return [head, ...lines].join("\r\n") + "\r\n";
}

/** All cards with changed values, one below the other. */
export function allChangedCards(report: Report): string {
  return report.meta.interfaces
    .map((inter, i) => (report.changed(i) ? cardText(changedCard(inter, report.overrides[i])) : ""))
    .join("");
}

/** Command of this page, or of another verb, with the settings under test. */
export function deckCommand(report: Report, verb: string = report.meta.page): string {
  const parts = report.meta.interfaces.flatMap((inter, i) => {
    const fields = Object.entries(report.overrides[i]).map(([k, v]) => `${k}=${k.startsWith("I") ? v : shortest(v)}`);
    return fields.length > 0 ? [`--what-if ${inter.id}:${fields.join(",")}`] : [];
  });
  return [pathCommand(report, verb), ...parts].join(" ");
}
function pathCommand({ meta: { deck: { path } } }: Report, verb: string): string {
  return `deck ${verb} ${/[^\w./-]/.test(path) ? `'${path.replace(/'/g, `'\\''`)}'` : path}`;
}

/** Moves nodes out of each other's gap; some parts stay, or move alone, by their positions. */
export function fixCommand(report: Report, locks: Map<number, "lock" | "only">): string {
  const of = (how: string) => [...locks].filter(([, v]) => v === how).map(([p]) => ` ${report.partId(p)}`).join("");
  return `${pathCommand(report, "fix")} --strategy move-nodes${["lock", "only"].map((how) => (of(how) ? ` --${how}${of(how)}` : "")).join("")}`;
}

/** False if the browser refuses images in the clipboard. */
export async function copyImage(canvas: HTMLCanvasElement): Promise<boolean> {
  const png = new Promise<Blob>((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error("no picture")))));
  try {
    await navigator.clipboard.write([new ClipboardItem({ "image/png": png })]);
    return true;
  } catch {
    return false;
  }
}
