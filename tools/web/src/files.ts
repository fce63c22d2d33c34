// Files as they come from a drop or a dialog, folders with all they hold.
export interface Given {
  name: string;
  bytes: Uint8Array;
}

async function bytesOf(file: File): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch (e) {
    throw new Error(`${file.name} cannot be read: ${e instanceof Error ? e.message : String(e)}`);
  }
}

async function walk(entry: FileSystemEntry, out: Given[]): Promise<void> {
  if (entry.isFile) {
    const file = await new Promise<File>((ok, no) => (entry as FileSystemFileEntry).file(ok, no));
    out.push({ name: entry.fullPath.replace(/^\//, ""), bytes: await bytesOf(file) });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader gives a part of a folder at a time.
    const some = await new Promise<FileSystemEntry[]>((ok, no) => reader.readEntries(ok, no));
    if (some.length === 0) return;
    for (const e of some) await walk(e, out);
  }
}

export async function dropped(data: DataTransfer): Promise<Given[]> {
  const out: Given[] = [];
  // All entries first: the list is empty after the first wait.
  const entries = [...data.items].map((i) => i.webkitGetAsEntry?.() ?? null);
  const files = [...data.files];
  if (entries.some((e) => e?.isDirectory)) {
    for (const e of entries) if (e) await walk(e, out);
    return out;
  }
  for (const f of files) out.push({ name: f.name, bytes: await bytesOf(f) });
  return out;
}

export async function chosen(list: FileList): Promise<Given[]> {
  return Promise.all([...list].map(async (f) => ({ name: f.webkitRelativePath || f.name, bytes: await bytesOf(f) })));
}

export function save(name: string, content: string | Uint8Array, type: string): void {
  const url = URL.createObjectURL(new Blob([content as BlobPart], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
