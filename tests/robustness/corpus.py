#!/usr/bin/env python3
"""Every deck at hand (samples, and the corpus where it is present) through lint, params, convert:
no crash, unchanged bytes. tests/golden holds the effective values against those that the reference solver printed."""
import os
import shutil

from common import SAMPLES, read, run_steps, tree


def decks(c, tmp):
    for stem, path in [(os.path.basename(p)[:-9], p) for p in SAMPLES] + c.corpus_decks():
        lacking = "missing_include" in path
        codes = (3,) if lacking else (0, 1)
        r = c.run("lint", path)
        if c.no_crash("lint " + stem, r, codes) and lacking:
            for name in (b"Hybrid_III_50TH_0000.rad", b"example_h350_sled_belt_0000.inc", b":21:", b":22:"):
                c.check("lint %s names %s" % (stem, name.decode()), name in r.out + r.err)
        c.no_crash("params " + stem, c.run("params", path, "--json", os.path.join(tmp, "params.json")), codes)
        if not lacking:
            c.no_crash("gaps " + stem, c.run("gaps", path, "--quiet", timeout=600), (0, 1))
        out = os.path.join(tmp, stem)
        c.no_crash("convert " + stem, c.run("convert", path, "--to", "rad", "-o", out), codes)
        # An incomplete tree may be refused, but then nothing of it is written.
        if lacking and not os.path.exists(out):
            continue
        for name, data in tree(out).items():
            c.check("convert %s keeps the bytes of %s" % (stem, name), data == read(os.path.join(os.path.dirname(path), name)))
        # What is not there would be missed.
        c.no_crash("params of the copy of " + stem, c.run("params", os.path.join(out, os.path.basename(path)), "--no-geometry", "-q"), codes)
        shutil.rmtree(out, ignore_errors=True)


if __name__ == "__main__":
    run_steps(decks)
