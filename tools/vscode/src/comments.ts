// Lines as comments and back: a '#' in the first column, wherever the text begins. Knows nothing of the editor.

/** All lines become comments, or, if all are, what they were before. Blank lines are cards, and take part. */
export function toggled(lines: string[]): string[] {
  return lines.every((l) => l.startsWith("#")) ? lines.map((l) => l.slice(1)) : lines.map((l) => `#${l}`);
}
