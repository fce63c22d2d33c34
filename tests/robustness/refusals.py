#!/usr/bin/env python3
"""How many decks at hand a conversion refuses: --version 2026, --units, --renumber node+1 and part+1.

A keyword that no schema describes is a reason to refuse, and so is a value that cannot be converted. A
keyword with complete cards that is refused for want of a description is a failure; so is --partial or
--allow-loss that leaves something undecided and ends with exit code 0."""
import json
import os
import re
import sys
import tempfile

from common import ROOT, SAMPLES, read, run_steps, write

sys.path.insert(0, os.path.join(ROOT, "tests", "keyword"))
from schema_files import keyword_schemas  # noqa: E402

CONVERSIONS = (("--version", "2026"), ("--units", "g,cm,ms"), ("--units", "Mg,mm,s"),
               ("--renumber", "node+1"), ("--renumber", "part+1"))
# Of a change of units also what a formula of the solver has of its own: steps of beams.
ACCEPT = {"--version": ["--allow-loss"], "--units": ["--partial", "--allow-loss"], "--renumber": ["--partial"]}


def described():
    """Keywords, aliases included, whose schema describes every line and the unit of every cell."""
    known = set()
    for s in keyword_schemas():
        fields = [f for card in s.get("cards", []) for f in card.get("fields", [])]
        open_units = any(f.get("dim_unknown") or (f.get("ref") in ("funct", "table") and not f.get("axes")) for f in fields)
        if (not s.get("opaque_tail") or s.get("full_layout")) and not open_units:
            known.update([s["keyword"]] + s.get("aliases", []))
    return known


# What a refusal says where a schema is to blame, not the deck.
BY_SCHEMA = re.compile(r"not known|described|has columns|in working units, which change")


def undecided(report):
    return json.loads(read(report))["undecided"]


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


def undecided_by_choice(c, tmp):
    """A deck of a keyword that nobody describes: refused, and written with exit code 1 where that is accepted."""
    text = read(SAMPLES[0]).replace(b"\n/END", b"\n/FXBODY/7\nbody\n         1         2\n                 3.5\n/END")
    path = write(os.path.join(tmp, "open_0000.rad"), text)
    for n, conversion in enumerate(CONVERSIONS):
        name, out = " ".join(conversion), os.path.join(tmp, "out%d" % n)
        refused = c.run("convert", path, "-o", out, *conversion)
        c.check(name + " refuses what nobody describes", refused.code == 1 and not os.path.exists(out), refused.text)
        written = c.run("convert", path, "-o", out, *conversion, *ACCEPT[conversion[0]])
        c.check(name + " writes it where that is accepted, with exit code 1",
                written.code == 1 and os.path.exists(os.path.join(out, "open_0000.rad")), "%s %s" % (written.code, written.text))


def refusals(c, tmp):
    known, decks = described(), c.all_decks()
    for conversion in CONVERSIONS:
        refused = []
        for stem, path in decks:
            with tempfile.TemporaryDirectory(dir=tmp) as work:
                if one(c, known, stem, path, work, conversion):
                    refused.append(stem)
        print("%s: %d of %d decks are refused%s" % (" ".join(conversion), len(refused), len(decks), ": " + ", ".join(refused) if refused else ""))


if __name__ == "__main__":
    run_steps(undecided_by_choice, refusals)
