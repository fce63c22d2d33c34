// The grammar on the samples, by the engine that VS Code uses. What a cell is, is known from the headings
// of the samples, which stand above their columns, and from the type of the field with that name.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { cellScopes, schemasOf } from "../../tools/vscode/grammar.mjs";
import { tokens } from "./engine.mjs";

const { ROOT } = process.env;
const samples = ["samples", "samples/include_tree"].flatMap((d) => readdirSync(join(ROOT, d)).filter((f) => /\.(rad|inc)$/.test(f)).map((f) => join(ROOT, d, f)));
const schemas = readdirSync(join(ROOT, "schemas/keywords")).flatMap((f) => schemasOf(JSON.parse(readFileSync(join(ROOT, "schemas/keywords", f), "utf8"))));
const known = new Map(schemas.flatMap((s) => [s.keyword, ...(s.aliases ?? [])].map((k) => [k, s])));
function schemaOf(header) {
  const fields = header.split(/\s/)[0].split("/");
  for (let n = fields.length; n > 1; --n) if (known.has(fields.slice(0, n).join("/"))) return known.get(fields.slice(0, n).join("/"));
  return null;
}

test("every keyword of the samples is one, the misspelt ones are not", () => {
  const unknown = [];
  let headers = 0;
  for (const file of samples)
    for (const { line, tokens: t } of tokens(readFileSync(file, "utf8"))) {
      if (!line.startsWith("/")) continue;
      ++headers;
      if (t[0].scope === "keyword.other.unknown.radioss") unknown.push(line);
      else {
        assert.equal(t[0].scope, "keyword.control.radioss", line);
        const schema = schemaOf(line);
        assert.ok([schema.keyword, ...(schema.aliases ?? [])].includes(line.slice(0, t[0].end)), `${line}: ${line.slice(0, t[0].end)}`);
      }
    }
  assert.deepEqual(unknown, ["/INTER/TYP7/70", "/inter/type7/71"]);
  assert.ok(headers > 300, String(headers));
});

test("every comment line is a comment from its first to its last character", () => {
  let comments = 0;
  for (const file of samples)
    for (const { line, tokens: t } of tokens(readFileSync(file, "utf8"))) {
      if (!/^[#$]/.test(line) || line.startsWith("#include")) continue;
      ++comments;
      for (const token of t) assert.ok(token.scopes.some((s) => s.startsWith("comment.line")), line);
    }
  assert.ok(comments > 300, String(comments));
});

test("every cell below a heading is cut at the heading's columns and has the scope of its field's type", () => {
  let exact = 0;
  const loose = new Set();
  for (const file of samples) {
    const lines = tokens(readFileSync(file, "utf8"));
    if (file.includes("every_mistake")) continue; // lines are missing there
    let schema = null;
    let names = [];
    for (const { line, tokens: t } of lines) {
      if (line.startsWith("/")) {
        schema = schemaOf(line);
        names = [];
      } else if (line.startsWith("#")) names = [...line.matchAll(/[^\s#]+/g)].map((m) => ({ name: m[0], end: m.index + m[0].length }));
      else if (schema?.cards)
        for (const { name, end } of names) {
          const types = new Set(schema.cards.flatMap((c) => c.fields ?? []).filter((f) => f.name === name && f.cols[1] === end).map((f) => f.type));
          if (types.size !== 1 || !line.slice(end - 1, end).trim()) continue;
          const token = t.find((x) => x.start < end && end <= x.end);
          if (token.scope === "constant.numeric.radioss" || token.scope === "string.unquoted.radioss" && !types.has("text")) {
            loose.add(schema.keyword);
            continue;
          }
          const [type] = types;
          assert.ok([cellScopes[type], "variable.parameter.radioss"].includes(token.scope), `${file}: ${schema.keyword} ${name}: ${token.scope} in '${line}'`);
          assert.equal(token.end, end, `${file}: ${schema.keyword} ${name} in '${line}'`);
          ++exact;
        }
    }
  }
  assert.ok(exact > 3000, `${exact} cells`);
  // Only cards behind one that is there on a condition are coloured by what stands in them.
  for (const keyword of loose) assert.ok(known.get(keyword).cards.some((c) => c.when || c.count !== undefined || c.repeat || (c.fields ?? []).some((f) => f.when)), keyword);
  assert.ok(!loose.has("/NODE") && !loose.has("/SHELL") && !loose.has("/PART"));
});

test("cells that touch are parted", () => {
  const [, , , row] = tokens("/NODE\n# c\n# c\n1234567890-1.2345678901234e+00-1.2345678901234e+00-1.2345678901234e+00\n");
  assert.deepEqual(row.tokens.map((t) => [t.start, t.end]), [[0, 10], [10, 30], [30, 50], [50, 70]]);
});

test("field names are told apart in headings, and nowhere else", () => {
  const lines = tokens("/INTER/TYPE7/1\ntitle with Gapmin\n#  Gapmin  Nothing\n       1\n/NODE\n# Gapmin\n");
  const names = lines.map((l) => l.tokens.filter((t) => t.scope === "meta.field-name.radioss").map((t) => l.line.slice(t.start, t.end)));
  assert.deepEqual(names.flat(), ["Gapmin"]);
  assert.equal(lines[1].tokens[0].scope, "string.unquoted.title.radioss");
});

test("includes, parameters, comments behind a keyword and blank cards are read", () => {
  const l = tokens("/NODE # all of them\n#include parts/a b.inc\n         1        &x0       1.0\n/INTER/TYPE7/&id/2\n\n\n         7\n");
  assert.equal(l[0].tokens.at(-1).scope, "comment.line.radioss");
  assert.deepEqual(l[1].tokens.map((t) => t.scope), ["keyword.control.directive.radioss", "string.unquoted.path.radioss"]);
  assert.ok(l[2].tokens.some((t) => t.scope === "variable.parameter.radioss" && l[2].line.slice(t.start, t.end) === "&x0"));
  assert.equal(l[3].tokens[0].scope, "keyword.control.radioss");
  // Blank title, blank first card: the 7 stands on the second.
  assert.equal(l[6].tokens[0].scope, cellScopes.real);
});

test("a line ends what it begins: no card reaches into the next block", () => {
  for (const schema of schemas) {
    const l = tokens(`${schema.keyword}/1\n1\n2\n3\n/NODE\n         1       1.0\n`);
    assert.deepEqual(l[5].tokens.map((t) => t.scope), [cellScopes.int, cellScopes.real], schema.keyword);
  }
});
