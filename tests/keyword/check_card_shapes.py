#!/usr/bin/env python3
"""Holds the shape of every card in schemas/keywords (lines, columns, types, by input version) against card_shapes.txt.

  check_card_shapes.py           compares; exit code 1 with the lines that differ
  check_card_shapes.py --write   renews card_shapes.txt; the diff shows what a change of schemas does to cards

A schema that loses a line or moves a cell reads decks wrongly without a test that knows the card. Notation of the file: a line of
keywords, then their lines in order, each behind the versions that have it ("51-90", "51-" to the newest). Cells are type and width
(i integer, r real, t text, f one-column flag, # id; #node: of what), "_" and a width is a gap. "?" the line or the cell has a condition,
"~" the line may be missing, "*" it repeats to the end, "*N" as field N says, "*list" its cells do, "+" it repeats together with its
neighbours. Keywords with the same lines stand together. "older unread": before its first version no line of it is read.
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOLDEN = pathlib.Path(__file__).with_name("card_shapes.txt")
TYPES = {"int": "i", "real": "r", "text": "t", "flag": "f", "id": "#"}


def cells_of(card, version):
    """The cells of a line in one version, by column."""
    out, at = [], 1
    fields = [f for f in card.get("fields", []) if within(f, version)]
    for f in sorted(fields, key=lambda f: f["cols"]):
        first, last = f["cols"]
        if first > at:
            out.append("_%d" % (first - at))
        kind = TYPES[f["type"]] + (f["ref"] if f["type"] == "id" else "")
        alternative = "@%d:" % first if first < at else ""
        out.append("%s%s%s%d%s" % (alternative, kind, ":" if kind[1:] else "", last - first + 1, "?" if f.get("when") else ""))
        at = max(at, last + 1)
    packed = []
    for cell in out:
        if packed and packed[-1][0] == cell:
            packed[-1][1] += 1
        else:
            packed.append([cell, 1])
    return " ".join(cell if n == 1 else "%dx %s" % (n, cell) for cell, n in packed) or "-"


def within(item, version):
    first, last = item.get("versions") or (0, None)
    return first <= version <= (last or 9999)


def marks_of(card):
    repeat = card.get("repeat")
    text = "?" if card.get("when") else ""
    text += "~" if card.get("optional") else ""
    if repeat == "group":
        text += "+"
    elif repeat:
        text += "*"
    if repeat in ("ids", "words"):
        text += "list"
    if "count" in card:
        text += str(card["count"])
    return text


def lines_of(schema, versions):
    """One text a run of versions in which a line is the same, in the order of the lines."""
    out = []
    for card in schema["cards"]:
        runs = []
        for version in versions:
            shape = None
            if within(card, version):
                shape = cells_of(card, version)
            if not runs or runs[-1][2] != shape:
                runs.append([version, version, shape])
            runs[-1][1] = version
        for first, last, shape in runs:
            if shape is not None:
                span = "" if first == versions[0] and last == versions[-1] else "%d-%s " % (first, "" if last == versions[-1] else last)
                out.append("  %s%s%s" % (span, shape, " " + marks_of(card) if marks_of(card) else ""))
    return out


def shapes():
    grammar = json.loads((ROOT / "schemas/keyword.schema.json").read_text(encoding="utf-8"))
    versions = [v for v in grammar["$defs"]["version"]["enum"] if v >= 51]
    groups = {}
    for file in sorted((ROOT / "schemas/keywords").glob("*.json")):
        document = json.loads(file.read_text(encoding="utf-8"))
        for schema in document.get("schemas", [document]):
            if not schema.get("cards"):
                continue
            lines = lines_of(schema, versions)
            head = " (from %d%s)" % (schema["from"], ", older unread" if "older" in schema else "") if schema.get("from", 0) > 51 else ""
            groups.setdefault((head, tuple(lines)), []).append(schema["keyword"])
    text = []
    for (head, lines), keywords in sorted(groups.items(), key=lambda item: sorted(item[1])[0]):
        text.append(" ".join(sorted(keywords)) + head)
        text += lines
    return text


def main():
    now = shapes()
    if sys.argv[1:] == ["--write"]:
        GOLDEN.write_text("\n".join(now) + "\n", encoding="utf-8")
        print("%d lines written" % len(now))
        return 0
    golden = GOLDEN.read_text(encoding="utf-8").splitlines()
    import difflib
    different = [d for d in difflib.unified_diff(golden, now, "card_shapes.txt", "schemas/keywords", lineterm="", n=3)]
    for line in different:
        print(line)
    if different:
        print("FAILED  the cards of schemas/keywords are not those of card_shapes.txt; "
              "if that is meant, run tests/keyword/check_card_shapes.py --write")
    print("%d passed, %d failed" % (not different, bool(different)))
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
