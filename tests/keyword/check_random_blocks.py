#!/usr/bin/env python3
"""A random valid block of every keyword whose layout is known: what the schema says is what the
program reads, converts to other units and back, and renumbers and back.

The blocks are made from schemas/keywords alone, by an interpreter of the schema language that is
written a second time here. A deck holds one block of each keyword; ids lead to blocks of the deck."""
import json
import os
import random
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Checks  # noqa: E402
from schema_files import keyword_schemas  # noqa: E402

VERSIONS = (2612, 2021, 110)
EVERY_VERSION = (90, 100, 110, 120, 130, 140) + tuple(range(2017, 2027)) + (2612,)  # with --all
SHIFT = 5_000_000
NODES = 40
UNITS = {"Mg": 3, "kg": 0, "g": -3, "m": 0, "mm": -3, "cm": -2, "s": 0, "ms": -3}  # powers of ten of kg, m, s
# What stands at fixed places of a deck, or names no ids and values of its own.
LEFT_OUT_KINDS = {"engine", "unit", "submodel", "parameter", "transform", "set", "default_inter", "node"}
LEFT_OUT = ("/BEGIN", "/END", "/TITLE", "//", "/UNIT", "/CNODE", "/ENCRYPTED", "/INTER/TYPE19", "/INTER/SUB")


def schemas():
    for schema in keyword_schemas():
        for card in schema.get("cards", []):
            card.setdefault("fields", [])  # of a blank line
        yield schema


def described(schema, version):
    if not schema.get("cards") or schema.get("bulk") or schema.get("kind") in LEFT_OUT_KINDS:
        return False
    if schema.get("opaque_tail") and not schema.get("full_layout"):
        return False
    if schema.get("from", 0) > version or schema["keyword"].startswith(LEFT_OUT):
        return False
    if schema["keyword"].endswith(("/GENE", "/GEN_INCR")):  # pairs and triples: not in the schema
        return False
    # A list of clauses (surfaces, groups of groups) without a card of this version says nothing.
    return any(within(c, version) for c in schema["cards"])


def within(item, version):
    first, last = item.get("versions") or (None, None)
    return (first or 0) <= version <= (last or 9999)


class Again(Exception):
    """The draw contradicts itself; draw again."""


class Block:
    """One random block: its lines and what each of them says."""

    def __init__(self, schema, version, entity, ids, draw):
        self.schema, self.version, self.id, self.ids, self.draw = schema, version, entity, ids, draw
        self.lines, self.said = [], []
        self.fields_said = []  # (field, value) in reading order, with the number of their line

    def make(self):
        counted = [c for card in self.schema["cards"] for c in conditions(card) if c.get("lines")]
        wanted = sorted({n for c in counted for n in c.get("in", []) + c.get("not_in", [])})
        self.data_lines = self.draw.choice(wanted + [-1])  # -1: another number
        cards, i = self.schema["cards"], 0
        open_end = False
        while i < len(cards) and not open_end:
            card = cards[i]
            i += 1
            if card.get("repeat") == "group":
                group = [card]
                while i < len(cards) and cards[i].get("repeat") == "group" and cards[i].get("count") == card.get("count"):
                    group.append(cards[i])
                    i += 1
                open_end = self.rounds(group)
            elif self.holds(card, 0):
                open_end = self.card(card)
        if len(self.lines) in wanted and self.data_lines != len(self.lines) or self.data_lines not in (-1, len(self.lines)):
            raise Again
        return self

    def value(self, name, start):
        """Of a field as a condition sees it: the round first, then the cards before the round."""
        for n, field, value in reversed(self.fields_said):
            if n >= start and field == name:
                return value
        for n, field, value in self.fields_said:
            if field == name:
                return value
        return 0

    def test(self, condition, start):
        value = self.data_lines if condition.get("lines") else self.value(condition["field"], start)
        if isinstance(value, str) or "words" in condition:
            return str(value).upper() in [w.upper() for w in condition.get("words", [])]
        return (("in" not in condition or value in condition["in"]) and value not in condition.get("not_in", []) and
                condition.get("min", value) <= value <= condition.get("max", value))

    def fields(self, card):
        return [f for f in card["fields"] if within(f, self.version)]

    def holds(self, card, start):
        if not within(card, self.version) or not all(self.test(c, start) for c in card.get("when", [])):
            return False
        cells = self.fields(card)
        return not cells or any(all(self.test(c, start) for c in f.get("when", [])) or
                                any(c.get("field") in [g["name"] for g in cells] for c in f.get("when", []))
                                for f in cells)

    def count(self, card):
        count = card.get("count")
        return count if isinstance(count, int) else self.value(count, 0) if count else None

    def card(self, card):
        """True if the card takes all lines to the end of the block."""
        repeat = card.get("repeat")
        if repeat == "rows":
            return self.rounds([card])
        if repeat == "words":
            self.list_line(card, self.draw.randint(1, 4))
            return False
        if repeat == "ids":
            count = self.count(card)
            if count is None:
                for _ in range(self.draw.randint(1, 2)):
                    self.list_line(card, self.draw.randint(1, 5))
                return True
            per_line = card.get("per_line", 1)
            for done in range(0, count, per_line):
                self.list_line(card, min(per_line, count - done))
            return False
        self.line(card, len(self.lines))
        return False

    def rounds(self, group):
        if not any(within(c, self.version) for c in group):
            return False
        count = self.count(group[0])
        for _ in range(self.draw.randint(1, 3) if count is None else count):
            start = len(self.lines)
            for card in group:
                if self.holds(card, start):
                    self.line(card, start)
            if len(self.lines) == start:
                return False
        return count is None

    def list_line(self, card, cells):
        field, text, values = card["fields"][-1], "", []
        for lead in card["fields"][:-1]:
            value, shown = self.cell(lead)
            text = put(text, lead["cols"], shown)
            self.fields_said.append((len(self.lines), lead["name"], value))
        width = field["cols"][1] - field["cols"][0] + 1
        cells = min(cells, (100 - field["cols"][0] + 1) // width)
        for k in range(cells):
            value, shown = self.cell(field, filled=True)
            text = put(text, (field["cols"][0] + k * width, field["cols"][1] + k * width), shown)
            values.append(value)
        self.lines.append(text)
        self.said.append({"card": card, field["name"]: values})

    def line(self, card, start):
        text, said = "", {"card": card}
        cells = self.fields(card)
        names = {f["name"] for f in cells}
        number = len(self.lines)

        def holds(f):
            own = {n: v for k, n, v in self.fields_said if k == number}
            for c in f.get("when", []):
                seen = dict(c)
                value = own.get(c.get("field"), None if c.get("field") not in names else 0)
                if value is None:
                    if not self.test(seen, start):
                        return False
                elif not (("in" not in c or value in c["in"]) and value not in c.get("not_in", []) and
                          c.get("min", value) <= value <= c.get("max", value)):
                    return False
            return True

        for conditional in (False, True):
            for f in cells:
                if bool(f.get("when")) != conditional or (conditional and not holds(f)):
                    continue
                value, shown = self.cell(f)
                text = put(text, f["cols"], shown)
                said[f["name"]] = value
                self.fields_said.append((number, f["name"], value if value is not None else 0))
        if len(said) == 1 and any(f.get("when") for f in cells):
            return  # no cell is read: there is no such line
        self.lines.append(text)
        self.said.append(said)

    def cell(self, field, filled=False):
        """(value, text) of a cell."""
        draw, width = self.draw, field["cols"][1] - field["cols"][0] + 1
        kind = field["type"]
        if kind == "real" and not field.get("dim_unknown"):
            low, high = field.get("min", 0.0), field.get("max")
            digits = draw.choice((1, 2, 3))
            if high is not None and high < 1e6:
                value = low + (high - low) * draw.choice((0.25, 0.5, 0.75))
            else:
                value = round(max(low, 0) + draw.uniform(1, 99), digits)
            text = "%.*f" % (digits, value) if high is None or high >= 1e6 else repr(value)
            if draw.random() < 0.2 and width >= 16:
                text = "%.6E" % float(text)
            text = text[:width]
            return float(text), text
        if kind == "int":
            legal = field.get("values")
            asked = self.asked(field["name"])
            if legal is None and asked and draw.random() < 0.7:
                legal = asked  # what conditions tell apart
            if legal is None:
                low, high = int(field.get("min", 0)), int(field.get("max", max(field.get("min", 0) + 3, 3)))
                legal = range(max(low, 0), max(low, 0, min(high, 4)) + 1)
            value = draw.choice(list(legal) + ([] if filled else [0]))
            return value, str(value)
        if kind == "flag":
            value = draw.randint(0, 1)
            return value, str(value)
        if field.get("dim_unknown"):
            return 0, "0"  # what it means is not known: no conversion takes it
        if kind == "id":
            known = self.ids.get(field["ref"], [])
            if field["ref"] == "funct" and known:
                value = known.pop()  # each use its own: no function has to be copied
            elif known and (filled or draw.random() < 0.8):
                value = draw.choice(known)
            else:
                value = 0
            return value, str(value)
        words = field.get("words") or [w for c in self.text_tests(field["name"]) for w in c["words"]]
        word = draw.choice(words)[:width] if words else "ABC"[:width]
        return word, word

    def asked(self, name):
        """Small numbers that conditions on the field tell from others."""
        tests = [c for card in self.schema["cards"] for c in conditions(card) if c.get("field") == name]
        return sorted({n for c in tests for n in c.get("in", []) + c.get("not_in", []) + [c.get("min", 0)] if 0 <= n < 100})

    def text_tests(self, name):
        found = []
        for card in self.schema["cards"]:
            for f in card["fields"]:
                for d in f.get("dim_when", []):
                    found += [c for c in d["when"] if c.get("field") == name and "words" in c]
            found += [c for c in conditions(card) if c.get("field") == name and "words" in c]
        return found


def conditions(card):
    return card.get("when", []) + [c for f in card["fields"] for c in f.get("when", [])]


def put(text, cols, shown):
    return text.ljust(cols[0] - 1)[:cols[0] - 1] + shown.rjust(cols[1] - cols[0] + 1) + text[cols[1]:]


def random_deck(version, seed):
    """The text of a deck and its blocks."""
    draw = random.Random(seed)
    chosen = [s for s in schemas() if described(s, version)]
    ids, entities = {}, []
    for n, schema in enumerate(chosen):
        entity = 1000 + n
        entities.append(entity)
        if schema.get("id", True) and schema.get("kind", "other") != "other":
            ids.setdefault(schema["kind"], []).append(entity)
    ids["node"] = list(range(1, NODES + 1))
    functions = list(range(100_000, 104_000))
    ids["funct"] = list(functions)
    head = ["#RADIOSS STARTER", "/BEGIN", "random blocks", "%10d%10d" % (version, 0)]
    head += 2 * ["%20s%20s%20s" % ("kg", "mm", "ms")]
    head += ["/NODE"] + ["%10d%20.1f%20.1f%20.1f" % (i, i, i * i, 7 * i) for i in range(1, NODES + 1)]
    blocks, body = [], []
    for schema, entity in zip(chosen, entities):
        for _ in range(200):
            functions_left = list(ids["funct"])
            try:
                block = Block(schema, version, entity, ids, draw).make()
                break
            except Again:
                ids["funct"] = functions_left
        else:
            sys.exit("%s: no block with the number of lines that its conditions ask for" % schema["keyword"])
        blocks.append(block)
        body.append(schema["keyword"] + ("/%d" % entity if schema.get("id", True) else ""))
        if schema.get("title", True):
            body.append("block of %s" % schema["keyword"][1:])
        body += block.lines
    used = sorted(set(functions) - set(ids["funct"]))
    for f in used:
        body += ["/FUNCT/%d" % f, "f", "%20s%20s" % ("0.0", "1.5"), "%20s%20s" % ("2.0", "3.0")]
    return "\n".join(head + body + ["/END", ""]), blocks


def read(c, path):
    """{header: [fields of each line]} of a deck, by `convert --to json`."""
    target = path + ".json"
    r = c.run("convert", path, "--to", "json", "-o", target, "--quiet", "--overwrite")
    if r.code not in (0, 1):
        return {}
    with open(target, encoding="utf-8") as f:
        document = json.load(f)
    found = {}
    for item in (i for file in document["files"] for i in file["items"]):
        if isinstance(item, dict) and item.get("kind") == "block":
            lines = [line["fields"] for line in item["lines"] if isinstance(line, dict) and line.get("fields")]
            for row in item.get("rows", []):
                names, values = item["fields"], row[1:]
                lines.append({n: v for n, v in zip(names[:-1], values)})
                lines[-1][names[-1]] = values[len(names) - 1] if len(values) == len(names) else values[len(names) - 1:]
            found[item["header"].strip()] = lines
    return found


def converted(c, path, folder, *options):
    shutil.rmtree(folder, ignore_errors=True)
    r = c.run("convert", path, "-o", folder, "--quiet", *options)
    target = os.path.join(folder, os.path.basename(path))
    if not c.check("%s %s is done" % (os.path.basename(path), " ".join(options)), r.code == 0, r.text[-1500:]):
        return None
    return target


def compare(c, what, expected, found):
    """Both are lists of lines; each line a dict of fields."""
    for n, (a, b) in enumerate(zip(expected, found)):
        for name, value in a.items():
            if not same(value, b.get(name)):
                return c.check(what, False, "line %d, %s: %r expected, %r found" % (n + 1, name, value, b.get(name)))
    return c.check(what, len(expected) == len(found), "%d lines expected, %d found" % (len(expected), len(found)))


def same(a, b):
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, list) and len(a) == 1:
        return same(a[0], b)
    if isinstance(a, float) and isinstance(b, (int, float)):
        return abs(a - b) <= 1e-15 * abs(a)
    return a == b or (a in (0, "", None) and b in (0, "", None))


def factor(field, power, keyword):
    """How a value of the field changes with the units; None: that depends on more than its `dim`."""
    if any(k in field for k in ("dim_when", "over", "solver_dim", "dim_unknown")):
        return None
    # Factors of the function of a spring keep their numbers where K counts in contacts; its points change.
    if keyword.startswith("/PROP/SPR") and re.fullmatch("[BE][1-3]?", field["name"]):
        return None
    dim = field.get("dim", [0, 0, 0])
    return 10.0 ** -sum(dim[k] * power[k] for k in range(3))


def check_version(c, version, seed, tmp):
    text, blocks = random_deck(version, seed)
    path = os.path.join(tmp, "random_0000.rad")
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)
    name = "version %d, seed %d: " % (version, seed)
    original = read(c, path)

    def header(block, shift=0):
        own = block.schema.get("id", True)
        changes = shift and block.schema.get("kind", "other") != "other"
        return block.schema["keyword"] + ("/%d" % (block.id + (shift if changes else 0)) if own else "")

    def said(block):
        cells = [{k: v for k, v in line.items() if k != "card"} for line in block.said]
        return [line for line in cells if line]  # blank lines hold nothing

    for block in blocks:
        compare(c, name + header(block) + " is read as written", said(block), original.get(header(block), []))
    there = converted(c, path, os.path.join(tmp, "there"), "--units", "Mg,cm,s")
    if there:
        power = [UNITS["Mg"] - UNITS["kg"], UNITS["cm"] - UNITS["mm"], UNITS["s"] - UNITS["ms"]]
        middle = read(c, there)
        for block in blocks:
            check_factors(c, name + header(block), block, original.get(header(block), []),
                          middle.get(header(block), []), power)
        back = converted(c, there, os.path.join(tmp, "back"), "--units", "kg,mm,ms")
        final = read(c, back) if back else {}
        for block in blocks if back else []:
            compare(c, name + header(block) + " comes back from other units", original.get(header(block), []),
                    final.get(header(block), []))
    there = converted(c, path, os.path.join(tmp, "there"), "--renumber", "all+%d" % SHIFT)
    if there:
        middle = read(c, there)
        back = converted(c, there, os.path.join(tmp, "back"), "--renumber", "all-%d" % SHIFT)
        for block in blocks:
            moved = [{f["name"]: line.get(f["name"]) for f in line["card"]["fields"] if f["type"] == "id"}
                     for line in block.said]
            new = next((middle[h] for h in (header(block, SHIFT), header(block)) if h in middle), [])
            for n, (line, now) in enumerate(zip((m for m, line in zip(moved, block.said) if len(line) > 1), new)):
                for field, old in line.items():
                    if old:
                        shifted = [v and v + SHIFT for v in old] if isinstance(old, list) else old + SHIFT
                        c.check("%s%s line %d: %s follows" % (name, header(block), n + 1, field),
                                same(shifted, now.get(field)), "%r becomes %r" % (old, now.get(field)))
        if back:
            with open(back, encoding="utf-8") as f:
                c.check(name + "ids come back", f.read() == text)


def check_factors(c, what, block, before, after, power):
    for line, a, b in zip((line for line in block.said if len(line) > 1), before, after):
        for field in line["card"]["fields"]:
            old, new = a.get(field["name"]), b.get(field["name"])
            by = factor(field, power, block.schema["keyword"]) if field["type"] == "real" else None
            if by is None or not isinstance(old, float) or not within(field, block.version) or not old:
                continue
            if not (isinstance(new, (int, float)) and abs(new - old * by) <= 1e-14 * abs(new)):
                c.check(what + " converts", False, "%s: %r becomes %r, factor %g" % (field["name"], old, new, by))
                return
    c.check(what + " converts", True)


def main():
    c = Checks()
    with tempfile.TemporaryDirectory() as tmp:
        for version in EVERY_VERSION if c.options.all else VERSIONS:
            for seed in range(1, 6 if c.options.all else 2):
                check_version(c, version, seed, tmp)
    return c.finish()


if __name__ == "__main__":
    sys.exit(main())
