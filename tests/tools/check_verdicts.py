#!/usr/bin/env python3
"""One verdict: gaps, lint, cycle, batch, fix, the page and Python say the same of every sample: the same level where the same
was looked at, and the same counts. With folders: of every deck in them instead.

    check_verdicts.py build/dev/tools/deck [FOLDER ...]"""
import glob
import json
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, SAMPLES, Checks  # noqa: E402

COUNTS = ["pairs", "nodes", "edges", "solver_errors", "tied_pairs", "tied_nodes", "untied_nodes", "crossed_elements"]
OF_LINT = {"warnings": "clean", "remarks": "clean"}  # what gaps does not look at


def page_of(c, deck, folder, verb):
    html = os.path.join(folder, verb + ".html")
    if c.run(verb, deck, "--html", html, "-q").code not in (0, 1):
        return None
    with open(html, encoding="utf-8") as f:
        text = f.read()
    meta = re.search(r'<script type="application/json" id="deck-meta">(.*?)</script>', text, re.S).group(1)
    return json.loads(meta)["verdict"]


def python_of(deck):
    """Nothing where the module is not there."""
    try:
        import libdeck
    except ImportError:
        return {}
    loaded = libdeck.load(deck)
    return {"Python gaps": loaded.gaps().verdict, "Python cycle": loaded.cycle().verdict}


def verdicts_of(c, deck, folder):
    said = {}
    for verb in ("gaps", "cycle"):
        said[verb] = json.loads(c.run(verb, deck, "--json", "-", "-q").out)["verdict"]
        out = os.path.join(folder, "batch-" + verb)
        c.run("batch", "-o", out, "--verb", verb, deck, "-q")
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as f:
            said["batch " + verb] = json.load(f)["decks"][0]["verdict"]
        page = page_of(c, deck, folder, verb)
        if page:
            said["page of " + verb] = page
    said["lint"] = json.loads(c.run("lint", deck, "--geometry", "--format", "json").out)["verdict"]
    said.update(python_of(deck))
    return said


def compare(c, deck, folder):
    name = os.path.basename(deck)
    said = verdicts_of(c, deck, folder)
    gaps = said["gaps"]
    for who, verdict in said.items():
        c.check("%s: %s has the counts of gaps" % (name, who), all(verdict["counts"].get(k) == gaps["counts"].get(k) for k in COUNTS),
                "%s, gaps %s" % (verdict["counts"], gaps["counts"]))
        c.check("%s: the text of %s is its sentences" % (name, who), verdict["text"] == " ".join(s["text"] for s in verdict["sentences"]), verdict["text"])
        level = verdict["level"]
        if who == "lint":  # which finds more errors of the deck, and speaks of decks without contacts
            if verdict["counts"]["errors"] > 0 and gaps["counts"]["errors"] == 0 and gaps["level"] != "stops":
                continue
            level = OF_LINT.get(level, level)
            if gaps["counts"]["interfaces"] == 0:
                continue
        c.check("%s: %s has the level of gaps" % (name, who), level == gaps["level"], "%s, gaps %s" % (level, gaps["level"]))
    for verb in ("gaps", "cycle"):
        text = c.run(verb, deck).out.decode()
        c.check("%s: the terminal ends with the verdict of %s" % (name, verb), text.endswith(said[verb]["text"] + "\n") and text.count(said[verb]["text"]) == 1,
                text[-300:])
        code = c.run(verb, deck, "-q").code
        c.check("%s: the exit code of %s follows" % (name, verb), code == int(said[verb]["level"] == "stops"), "%s, %s" % (code, said[verb]["level"]))
    fix = c.run("fix", deck, "--strategy", "reduce-gap", "--json", "-", "-q")
    if fix.code in (0, 1) and fix.out:
        interfaces = json.loads(fix.out)["interfaces"]
        before = sum(i["before"]["pairs"] for i in interfaces)
        c.check("%s: fix has the verdict of gaps" % name, json.loads(fix.out)["verdict"] == gaps, "%s, gaps %s" % (json.loads(fix.out)["verdict"], gaps))
        refused = gaps["counts"].get("not_evaluated", 0) > 0  # then it fixes nothing, and counts no pairs
        c.check("%s: fix begins with the pairs of gaps" % name, refused or before == gaps["counts"].get("pairs", 0), "%s, gaps %s" % (before, gaps["counts"]))


NO_NUMBER = re.compile(r"\b(?:inf|nan)\b|e\+30[0-9]", re.I)
QUOTED = re.compile(r"^ *\d* *\|.*$|'[^']*'|\"input\": \"[^\"]*\"", re.M)  # lines of the deck, and cells as they are written


def no_such_number(c, deck, folder):
    """A gap beyond all bounds is 'unbounded' in words and absent in JSON and CSV."""
    csv = os.path.join(folder, "pairs.csv")
    for args in (["gaps", "-v"], ["gaps", "--all", "--json", "-"], ["gaps", "--csv", csv], ["cycle", "-v"], ["cycle", "--json", "-"],
                 ["lint", "--geometry"], ["params", "-v"], ["params", "--json", "-"]):
        out = c.run(args[0], deck, *args[1:]).out.decode()
        if csv in args:
            with open(csv, encoding="utf-8") as f:
                out = f.read()
        found = NO_NUMBER.search(QUOTED.sub("", out))
        c.check("%s: %s prints no nan, inf or e+308" % (os.path.basename(deck), " ".join(args[:3])), found is None,
                found and out[max(0, found.start() - 80):found.end() + 20])


def main():
    c = Checks(folders=True)
    decks = sorted(d for folder in c.options.folders for d in glob.glob(os.path.join(folder, "**", "*_0000.rad"), recursive=True))
    if c.options.folders and not decks:
        sys.exit("no *_0000.rad in " + ", ".join(c.options.folders))
    for deck in decks or SAMPLES:
        with tempfile.TemporaryDirectory() as folder:
            compare(c, deck, folder)
            no_such_number(c, deck, folder)
    c.finish()


if __name__ == "__main__":
    main()
