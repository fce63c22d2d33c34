// Comparison of results bit by bit.

/** First difference of two values compared bit for bit (0 and -0 print alike in JSON: as numbers). */
export function difference(a, b, path) {
  if (typeof a === "number" && typeof b === "number") return a === b ? null : `${path}: ${a} is not ${b}`;
  if (a === null || b === null || typeof a !== "object" || typeof b !== "object")
    return a === b ? null : `${path}: ${JSON.stringify(a)} is not ${JSON.stringify(b)}`;
  const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
  for (const k of keys) {
    const d = difference(a[k], b[k], `${path}.${k}`);
    if (d) return d;
  }
  return null;
}
