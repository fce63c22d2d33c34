// Makes the TextMate grammar of Radioss decks out of the keyword schemas, so that keywords, columns
// and field names have one home. Pure: schemas in, grammar out (build.mjs reads and writes the files).
//
// What a grammar can know: the keyword, the title line, the names in the comment above a card, and the
// cells of cards that every newer deck has in this place. Where the next card depends on what an earlier
// one says, cells are coloured by what stands in them.

/** The schemas of a file, with the tables ("for") of its lists written out: their items once for each row. */
export function schemasOf(document) {
  const filled = (json, row) =>
    JSON.parse(JSON.stringify(json), (_, v) => (typeof v === "string" ? row.reduce((text, [name, word]) => text.replaceAll(`{${name}}`, word), v) : v));
  const written = (json, key) => {
    if (typeof json !== "object" || json === null) return json;
    if (!Array.isArray(json)) return Object.fromEntries(Object.entries(json).map(([name, value]) => [name, written(value, name)]));
    return json.flatMap((item) => {
      if (!item?.for) return [written(item, key)];
      const [names, ...rows] = item.for;
      return rows.flatMap((words) => written(filled(item[key], names.map((name, k) => [name, words[k]])), key));
    });
  };
  return written(document.schemas ?? [document], "schemas");
}

/** Scopes of cells by the type of the field; themes have colours for what comes before '.radioss'. */
export const cellScopes = {
  id: "variable.other.id.radioss",
  int: "constant.language.integer.radioss",
  flag: "constant.language.flag.radioss",
  real: "constant.numeric.real.radioss",
  text: "string.unquoted.radioss",
};
const dataLine = "^(?![#$/])"; // a blank line is a card of blanks
const escape = (text) => text.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&");
const newest = (thing) => !thing.versions || thing.versions[1] === null || thing.versions[1] === undefined;
const parameters = [{ name: "variable.parameter.radioss", match: "-?&\\w+" }];
const cell = (scope) => ({ name: scope, patterns: parameters });

/** What `fields` say of a line, as a regular expression over the whole line with one group a cell. */
function cells(fields) {
  const captures = {};
  let expression = "";
  let column = 0;
  let group = 0;
  for (const f of [...fields].sort((a, b) => a.cols[0] - b.cols[0])) {
    const [first, last] = f.cols;
    if (first <= column) continue; // an alternative for the same columns
    if (first > column + 1) expression += `.{0,${first - column - 1}}`;
    expression += `(.{0,${last - first + 1}})`;
    captures[++group] = cell(cellScopes[f.type]);
    column = last;
  }
  return { expression: `${dataLine}${expression}(.*)\\n?`, captures: { ...captures, [group + 1]: { patterns: [{ include: "#values" }] } } };
}

/** A list of cells of one width to the end of each line. */
function list(field) {
  const width = field.cols[1] - field.cols[0] + 1;
  const many = Math.max(1, Math.floor(100 / width));
  const captures = {};
  for (let i = 1; i <= many; ++i) captures[i] = cell(cellScopes[field.type]);
  return { match: `${dataLine}${`(.{0,${width}})`.repeat(many)}.*\\n?`, captures };
}

/** Rules for the data lines of `cards`, one nested in the other, so that each knows what came before; `comments` are tried first. */
function lines(cards, comments) {
  const [card, ...rest] = cards;
  const generic = [...comments, { include: "#values" }];
  if (card?.blank) return [...comments, { begin: `${dataLine}.*\\n?`, end: "(?=^/)", patterns: lines(rest, comments) }];
  if (!card || card.when || !card.fields) return generic;
  const fields = card.fields.filter(newest);
  if (fields.length === 0 || fields.some((f) => f.when)) return generic;
  if (card.repeat && card.count !== undefined) return generic;
  if (card.repeat === "ids" && fields.length === 1) return [...comments, list(fields[0])];
  const { expression, captures } = cells(fields);
  if (card.repeat === "rows") return [...comments, { match: expression, captures }];
  if (card.repeat) return generic;
  return [...comments, { begin: expression, beginCaptures: captures, end: "(?=^/)", patterns: lines(rest, comments) }];
}

/**
 * The rule for comment lines that name the fields of `schema` above its cards; null: it has none. The names
 * look like the rest of the comment in themes that do not ask for them.
 */
function heading(schema) {
  const names = [...new Set((schema.cards ?? []).flatMap((c) => (c.fields ?? []).map((f) => f.name)))].sort((a, b) => b.length - a.length);
  if (names.length === 0) return null;
  return {
    name: "comment.line.heading.radioss",
    begin: "^#(?!include\\b|enddata\\b)",
    end: "$",
    patterns: [{ name: "meta.field-name.radioss", match: `(?<![^\\s#|-])(?:${names.map(escape).join("|")})(?![^\\s|-])` }],
  };
}

/** Rules for all lines below a header; `comments` are rules for comment lines. */
function body(schema, comments) {
  const data = lines((schema.cards ?? []).filter(newest), comments);
  if (schema.title === false) return data;
  const title = { 1: { name: "string.unquoted.title.radioss" } };
  return [...comments, { begin: `${dataLine}(.*)\\n?`, beginCaptures: title, end: "(?=^/)", patterns: data }];
}

/** `schemas`: all keyword schemas; returns a grammar as vscode-textmate and VS Code read it. */
export function grammar(schemas) {
  const repository = {
    comment: {
      patterns: [
        { name: "meta.preprocessor.include.radioss", match: "^(#include)\\b\\s*(.*)$", captures: { 1: { name: "keyword.control.directive.radioss" }, 2: { name: "string.unquoted.path.radioss" } } },
        { name: "keyword.control.directive.radioss", match: "^#enddata\\b.*$" },
        { name: "comment.line.radioss", match: "^[#$].*$" },
      ],
    },
    values: {
      patterns: [
        { include: "#comment" },
        ...parameters,
        { name: "constant.numeric.radioss", match: "(?<![\\w.])[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eEdD][-+]?\\d+)?(?!\\w)" },
        { name: "string.unquoted.radioss", match: "[A-Za-z_][^\\s/]*" },
      ],
    },
    header: {
      patterns: [
        { name: "comment.line.radioss", match: "(?<=\\s)#.*$" },
        { name: "constant.numeric.id.radioss", match: "(?<=/)\\d+(?=[\\s/]|$)" },
        { name: "entity.name.section.radioss", match: "(?<=/)[^/\\s#]+" },
      ],
    },
  };
  const names = new Map();
  /** Keywords of equal layout share their rules. */
  const shared = (kind, rule) => {
    const text = JSON.stringify(rule);
    if (!names.has(text)) {
      names.set(text, `${kind}-${names.size + 1}`);
      repository[names.get(text)] = rule;
    }
    return { include: `#${names.get(text)}` };
  };
  const blocks = [];
  for (const schema of schemas) {
    const fields = heading(schema);
    const comments = [...(fields ? [shared("heading", fields)] : []), { include: "#comment" }];
    const rules = shared("block", { patterns: body(schema, comments) });
    for (const keyword of [schema.keyword, ...(schema.aliases ?? [])]) blocks.push({ keyword, rules });
  }
  // The longest keyword wins, by whole fields.
  blocks.sort((a, b) => b.keyword.length - a.keyword.length || (a.keyword < b.keyword ? -1 : 1));
  const block = (begin, captures, patterns) => ({ name: "meta.block.radioss", begin, beginCaptures: captures, end: "(?=^/)", patterns });
  const rest = { 2: { patterns: [{ include: "#header" }] } };
  return {
    $schema: "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
    name: "Radioss",
    scopeName: "source.radioss",
    patterns: [
      { include: "#comment" },
      ...blocks.map((b) => block(`^(${escape(b.keyword)})(?=[/\\s]|$)(.*)$`, { 1: { name: "keyword.control.radioss" }, ...rest }, [b.rules])),
      block("^(/[^/\\s]*)(.*)$", { 1: { name: "keyword.other.unknown.radioss" }, ...rest }, [{ include: "#values" }]),
    ],
    repository,
  };
}
