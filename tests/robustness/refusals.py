#!/usr/bin/env python3
"""How many decks at hand a conversion refuses: --version 2026, --units, --renumber node+1 and part+1.

A keyword that no schema describes is a reason to refuse, and so is a value that cannot be converted. A
keyword with complete cards that is refused for want of a description is a failure; so is --partial or
--allow-loss that leaves something undecided and ends with exit code 0."""
import json
import os
import re
import tempfile

from common import ROOT, SAMPLES, Checks

CONVERSIONS = (("--version", "2026"), ("--units", "g,cm,ms"), ("--units", "Mg,mm,s"),
               ("--renumber", "node+1"), ("--renumber", "part+1"))
# Of a change of units also what a formula of the solver has of its own: steps of beams.
ACCEPT = {"--version": ["--allow-loss"], "--units": ["--partial", "--allow-loss"], "--renumber": ["--partial"]}


def described():
    """Keywords, aliases included, whose schema describes every line and the unit of every cell."""
    known = set()
    folder = os.path.join(ROOT, "schemas", "keywords")
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), encoding="utf-8") as f:
            document = json.load(f)
        for s in document.get("schemas", [document]):
            fields = [f for card in s.get("cards", []) for f in card.get("fields", [])]
            open_units = any(f.get("dim_unknown") or (f.get("ref") in ("funct", "table") and not f.get("axes")) for f in fields)
            if (not s.get("opaque_tail") or s.get("full_layout")) and not open_units:
                known.update([s["keyword"]] + s.get("aliases", []))
    return known


def keyword_of(refusal):
    """"/INTER/TYPE7" of "…: /INTER/TYPE7/3 Gap: why"; "" where no block is named."""
    found = re.search(r":\d+:\d+: (/[^\s:]+)", refusal)
    return re.sub(r"(/\d+)+$", "", found.group(1)) if found else ""


# What a refusal says where a schema is to blame, not the deck.
BY_SCHEMA = re.compile(r"not known|described|has columns|in working units, which change")


def undecided(report):
    with open(report, encoding="utf-8") as f:
        return json.load(f)["undecided"]


def one(c, known, stem, path, tmp, conversion):
    """True if the deck was refused."""
    report = os.path.join(tmp, "report.json")
    name = "%s of %s" % (" ".join(conversion), stem)
    r = c.run("convert", path, "-o", os.path.join(tmp, "out"), *conversion, "--report", report, timeout=300)
    if not c.no_crash(name, r, (0, 1)) or r.code == 0:
        return False
    for entry in undecided(report):
        c.check("%s: %s:%s: %s is described, so its schema is no reason to refuse" % (
            name, entry["file"], entry["line"], entry["keyword"]),
            entry["keyword"] not in known or not BY_SCHEMA.search(entry.get("note", "")), entry.get("note", ""))
    again = c.run("convert", path, "-o", os.path.join(tmp, "part"), *conversion, *ACCEPT[conversion[0]],
                  "--report", report, timeout=300)
    if c.no_crash(name + ", accepted", again, (0, 1)):
        c.check(name + ": what is undecided ends with exit code 1, also where it is accepted",
                again.code == (1 if undecided(report) else 0), "exit code %s" % again.code)
    return True


def undecided_by_choice(c):
    """A deck of a keyword that nobody describes: refused, and written with exit code 1 where that is accepted."""
    for conversion in CONVERSIONS:
        with tempfile.TemporaryDirectory(prefix="deck-refusals-") as tmp:
            with open(SAMPLES[0], "rb") as f:
                text = f.read()
            path = os.path.join(tmp, "open_0000.rad")
            with open(path, "wb") as f:
                f.write(text.replace(b"\n/END", b"\n/FXBODY/7\nbody\n         1         2\n                 3.5\n/END"))
            name = " ".join(conversion)
            refused = c.run("convert", path, "-o", os.path.join(tmp, "a"), *conversion)
            c.check(name + " refuses what nobody describes", refused.code == 1 and not os.path.exists(os.path.join(tmp, "a")), refused.text)
            written = c.run("convert", path, "-o", os.path.join(tmp, "b"), *conversion, *ACCEPT[conversion[0]])
            c.check(name + " writes it where that is accepted", os.path.exists(os.path.join(tmp, "b", "open_0000.rad")), written.text)
            c.check(name + " ends with exit code 1 then", written.code == 1, "exit code %s" % written.code)


def main():
    c = Checks()
    undecided_by_choice(c)
    known = described()
    decks = [(os.path.basename(p)[:-9], p) for p in SAMPLES] + c.corpus_decks()
    if len(decks) == len(SAMPLES):
        c.skip("corpus", "no decks under %s (set DECK_CORPUS)" % c.options.corpus)
    decks = [(stem, path) for stem, path in decks if "missing_include" not in path]
    for conversion in CONVERSIONS:
        refused = []
        for stem, path in decks:
            with tempfile.TemporaryDirectory(prefix="deck-refusals-") as tmp:
                if one(c, known, stem, path, tmp, conversion):
                    refused.append(stem)
        print("%s: %d of %d decks are refused%s" % (" ".join(conversion), len(refused), len(decks),
                                                  ": " + ", ".join(refused) if refused else ""))
    c.finish()


if __name__ == "__main__":
    main()
