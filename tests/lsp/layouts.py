"""Decks with a card of every line of an interface, in every input version, from the schemas."""
import json
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VERSIONS = [2026, 2025, 2024, 2023, 2022, 2021, 2020, 2019, 2018, 2017, 140, 130, 120, 110, 100, 90, 51, 44, 42, 41]
FILES = {7: "inter_type7.json", 10: "inter_type10.json", 11: "inter_type11.json", 19: "inter_type19.json"}


def schema(kind):
    with open(os.path.join(ROOT, "schemas", "keywords", FILES[kind]), encoding="utf-8") as f:
        found = json.load(f)
    found = found if isinstance(found, list) else found.get("keywords", [found])
    return next(s for s in found if s["keyword"] == "/INTER/TYPE%d" % kind)


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
        for item in [card, *card["fields"]]:
            for condition in item.get("when", []):
                conditions.setdefault(condition["field"], []).append(condition)
    return {field: max(range(1, 10), key=lambda v: (sum(holds_for(c, v) for c in all_of), -v)) for field, all_of in conditions.items()}


def deck(kind, version):
    """(text, [(line from 0, card, {column: names})])"""
    s = schema(kind)
    cards = [c for c in s["cards"] if holds(c, version, s["from"])]
    flags = wanted(cards)
    lines = ["#RADIOSS STARTER", "/BEGIN", "run", "%10d%10d" % (version, 0)]
    lines += ["%20s%20s%20s" % ("kg", "mm", "ms")] * 2
    lines.append("/INTER/TYPE%d/1" % kind if version >= 51 else "/INTER/TYPE%d/1/title" % kind)
    if version >= 51:
        lines.append("title")
    placed = []
    for card in cards:
        text, columns = [" "] * 100, {}
        for f in card["fields"]:
            if not holds(f, version, s["from"]):
                continue
            first, last = f["cols"]
            for c in range(first, last + 1):
                columns.setdefault(c, set()).add(f["name"])
            if f["name"] in flags:
                value = str(flags[f["name"]])
                text[last - len(value):last] = value
        placed.append((len(lines), card, columns))
        # A full line: the cursor can stand in every column.
        lines.append("".join(text) if columns else "")
    lines += ["/END", ""]
    return "\n".join(lines), placed
