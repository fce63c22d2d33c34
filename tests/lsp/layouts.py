"""Decks with a card of every line of an interface or of its /DEFAULT/INTER, in every input version, from the schemas."""
import json
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VERSIONS = [2026, 2025, 2024, 2023, 2022, 2021, 2020, 2019, 2018, 2017, 140, 130, 120, 110, 100, 90, 51]
FILES = {"/INTER/TYPE7": "inter_type7.json", "/INTER/TYPE10": "inter_type10.json", "/INTER/TYPE11": "inter_type11.json",
         "/INTER/TYPE19": "inter_type19.json", "/DEFAULT/INTER/TYPE7": "default_inter.json",
         "/DEFAULT/INTER/TYPE11": "default_inter.json", "/DEFAULT/INTER/TYPE19": "default_inter.json"}


def schema(keyword):
    with open(os.path.join(ROOT, "schemas", "keywords", FILES[keyword]), encoding="utf-8") as f:
        found = json.load(f)
    return next(s for s in found.get("schemas", [found]) if s["keyword"] == keyword)


def fields(card):
    """The cells of a line; a blank line has none."""
    return card.get("fields", [])


def holds(item, version, oldest):
    """Whether a cell or card is there. What the oldest layout has is there in older decks too."""
    first, last = (item.get("versions") or [None, None])
    first, last = first or 0, last or 9999
    if first <= oldest <= last:
        first = 0
    return first <= version <= last


def holds_for(condition, value):
    return (value in condition["in"] if condition.get("in") else True) and value not in condition.get("not_in", []) \
        and condition.get("min", value) <= value <= condition.get("max", value)


def wanted(cards):
    """Values of flags for which the most optional lines and cells are there."""
    conditions = {}
    for card in cards:
        for item in [card, *fields(card)]:
            for condition in item.get("when", []):
                conditions.setdefault(condition["field"], []).append(condition)
    return {field: max(range(1, 10), key=lambda v: (sum(holds_for(c, v) for c in all_of), -v)) for field, all_of in conditions.items()}


def deck(keyword, version):
    """(text, [(line from 0, card, {column: names})]); a card that must be blank has no names in any column."""
    s = schema(keyword)
    oldest = s.get("from", 51)
    cards = [c for c in s["cards"] if holds(c, version, oldest)]
    flags = wanted(cards)
    lines = ["#RADIOSS STARTER", "/BEGIN", "run", "%10d%10d" % (version, 0)]
    lines += ["%20s%20s%20s" % ("kg", "mm", "ms")] * 2
    header = keyword + ("/1" if s.get("id", True) else "")
    if s.get("title", True):
        lines += [header, "title"]
    else:
        lines.append(header)
    placed = []
    for card in cards:
        text, columns = [" "] * 100, {}
        for f in fields(card):
            if not holds(f, version, oldest):
                continue
            first, last = f["cols"]
            for c in range(first, last + 1):
                columns.setdefault(c, set()).add(f["name"])
            if f["name"] in flags:
                value = str(flags[f["name"]])
                text[last - len(value):last] = value
        placed.append((len(lines), card, columns))
        # A full line: the cursor can stand in every column.
        lines.append("".join(text) if columns or card.get("blank") else "")
    lines += ["/END", ""]
    return "\n".join(lines), placed
