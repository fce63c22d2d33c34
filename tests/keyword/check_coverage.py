#!/usr/bin/env python3
"""How much of real decks the schemas describe: keywords in full, in part, by name only; and the share of
the data lines of the decks at hand that belong to a card of a schema.

  coverage.py [DECK] [--corpus DIR] [--all]     --all lists every deck and every keyword that is not read in full

Checks that no keyword of these decks is described less than it was: the bounds stand below."""
import collections
import glob
import json
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, SAMPLES, Checks  # noqa: E402
from schema_files import keyword_schemas  # noqa: E402

LEAST_SHARE = 0.999  # of data lines; the samples hold unknown keywords on purpose
LEAST_FULL = 370  # keywords


def keywords():
    """{how well: [keywords]}"""
    found = collections.defaultdict(list)
    for s in keyword_schemas():
        full = not s.get("opaque_tail") or s.get("full_layout")
        how = "in full" if full else "in part" if s.get("cards") else "by name"
        found[how] += [s["keyword"]] + s.get("aliases", [])
    return found


def lines(document, in_full):
    """(keyword, is described) of every data line. A line that no schema describes is text."""
    for item in (i for f in document["files"] for i in f["items"]):
        if not isinstance(item, dict) or item.get("kind") != "block":
            continue
        keyword = item["keyword"] or item["header"]
        for _ in item.get("rows", []):
            yield keyword, True
        for line in item.get("lines", []):
            if isinstance(line, dict):
                yield keyword, keyword in in_full or "title" in line
            elif line.strip() and line[0] not in "#$":
                yield keyword, False


def main():
    c = Checks()
    found = keywords()
    print("keywords, other spellings included: " + ", ".join("%d described %s" % (len(found[k]), k) for k in ("in full", "in part", "by name")))
    c.check("at least %d keywords are described in full" % LEAST_FULL, len(found["in full"]) >= LEAST_FULL)
    corpus = sorted(glob.glob(os.path.join(c.options.corpus, "corpus", "**", "*_0000.rad"), recursive=True))
    if not corpus:
        c.skip("lines of real decks", "no decks under " + c.options.corpus)
    open_lines, total = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as tmp:
        for deck in corpus + SAMPLES:
            target = os.path.join(tmp, "deck.json")
            r = c.run("convert", deck, "--to", "json", "-o", target, "--quiet", "--overwrite")
            if r.code not in (0, 1):
                continue
            with open(target, encoding="utf-8") as f:
                described = list(lines(json.load(f), set(found["in full"])))
            total += len(described)
            of_deck = collections.Counter(k for k, typed in described if not typed)
            open_lines += of_deck
            if c.options.all:
                print("%s: %d of %d lines not described %s" % (os.path.relpath(deck, ROOT), sum(of_deck.values()),
                                                               len(described), dict(of_deck)))
    share = 1 - sum(open_lines.values()) / max(total, 1)
    print("lines: %.4f %% of %d described" % (100 * share, total))
    if corpus:  # one of the few samples is made of mistakes
        c.check("%g %% of the lines are described" % (100 * LEAST_SHARE), share >= LEAST_SHARE, str(open_lines.most_common(10)))
    return c.finish()


if __name__ == "__main__":
    sys.exit(main())
