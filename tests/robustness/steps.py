#!/usr/bin/env python3
"""Conversions in one call: every pair of `deck convert` on small decks of several unit systems, every three on one.

Every step is verified against the deck before it, so that none refuses what the other steps have changed, and none lets
pass what it has changed itself."""
import itertools
import os
import shutil

from common import ROOT, run_steps, tree, wrong_schemas

# In the order in which they are done.
STEPS = {
    "--extract-contacts": None,  # by deck
    "--flatten": [],
    "--expand-type19": [],
    "--resolve-defaults": [],
    "--version": ["2018"],
    "--units": None,
    "--renumber": ["node+1000,inter+20"],
}
DECKS = (  # sample, units that it is put into first, interface to extract, units to convert to
    ("two_surfaces", None, "1", "kg,m,s"),
    ("two_surfaces", "kg,m,s", "1", "g,mm,ms"),
    ("include_tree", None, "1", "Mg,mm,s"),
    ("hot_contact", None, "1", "kg,mm,ms"),
)


def words(steps, interface, units):
    own = {"--extract-contacts": [interface], "--units": [units]}
    return [w for s in steps for w in [s] + own.get(s, STEPS[s])]


def all_steps(c, tmp):
    for name, own, interface, units in DECKS:
        deck = os.path.join(ROOT, "samples", name + "_0000.rad")
        if own:
            c.no_crash("%s in %s" % (name, own), c.run("convert", deck, "--units", own, "-o", os.path.join(tmp, "own")), (0,))
            deck = os.path.join(tmp, "own", name + "_0000.rad")
        for steps in itertools.chain(*(itertools.combinations(STEPS, n) for n in ((1, 2, 3) if own else (1, 2)))):
            asked = words(steps, interface, units)
            what = "%s%s %s" % (name, " in " + own if own else "", " ".join(asked))
            results = []
            for more in ([], ["--no-verify"]):
                out = os.path.join(tmp, "out")
                shutil.rmtree(out, ignore_errors=True)
                c.no_crash(" ".join([what] + more), c.run("convert", deck, *asked, *more, "-o", out, "-q"), (0,))
                results.append(tree(out))
            c.check(what + ": verification changes nothing", results[0] == results[1])


def wrong_result(c, tmp):
    """A step that does harm is named by itself, after other steps and before them."""
    schemas, deck = wrong_schemas(os.path.join(tmp, "schemas"), "inter_type19.json"), os.path.join(ROOT, "samples", "two_surfaces_0000.rad")
    for n in (0, 1, 2):
        for others in itertools.combinations([s for s in STEPS if s not in ("--units", "--extract-contacts", "--expand-type19")], n):
            asked = words(["--units", *others], "1", "kg,m,s")
            for how in (["-o", os.path.join(tmp, "wrong")], ["--check"]):
                r = c.run("convert", deck, "--schemas", schemas, *asked, *how)
                c.check("wrong units %s %s: refused, and named" % (" ".join(others), how[0]), r.code == 1 and "--units" in r.text and
                        "Gapmin" in r.text and not os.path.exists(os.path.join(tmp, "wrong")), "%s %s" % (r.code, r.text[-300:]))


if __name__ == "__main__":
    run_steps(all_steps, wrong_result)
