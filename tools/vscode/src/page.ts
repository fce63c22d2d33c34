// The report's page as the editor shows it: the same bytes with one more script. Knows nothing of the editor.

/** Puts `script` at the end of the page's body. */
export function withScript(html: string, script: string): string {
  if (/<\/script|<!--/i.test(script)) throw new Error("the script holds a tag that would end its element");
  const end = html.lastIndexOf("</body>");
  if (end < 0) throw new Error("this is no page");
  return `${html.slice(0, end)}<script>${script}</script>\n${html.slice(end)}`;
}

/** Line of the keyword that a line belongs to, both counted from 1; 0: there is none above. */
export function headerAbove(lineAt: (line: number) => string, line: number): number {
  for (let at = line; at > 0; --at) if (lineAt(at).startsWith("/")) return at;
  return 0;
}
