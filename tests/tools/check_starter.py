#!/usr/bin/env python3
"""tools/bench/starter: runs a stand-in for a Starter beside the program and prints one table; without a Starter it says so and
runs nothing."""
import json
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "tests", "robustness"))
from common import ROOT, Checks, write  # noqa: E402

STARTER = os.path.join(ROOT, "tools", "bench", "starter")
# Works for a while, leaves a listing where it is called, and stops at decks whose name says so.
STAND_IN = """#!%s
import os, sys, time
deck = sys.argv[sys.argv.index("-i") + 1]
assert os.path.isfile(deck) and sys.argv[3:] == ["-np", "1", "-nt", "1"]
end = time.process_time() + 0.2
while time.process_time() < end:
    pass
open(os.path.basename(deck)[:-len(".rad")] + ".out", "w").close()
sys.exit(2 if "wrong" in deck else 0)
""" % sys.executable


def bench(c, *args, starter=""):
    env = dict(os.environ, DECK_STARTER=starter)
    return subprocess.run([sys.executable, STARTER, *args, "--deck", c.program, "--repeat", "1"], capture_output=True, text=True,
                          env=env, timeout=300)


def main():
    c = Checks()
    with tempfile.TemporaryDirectory() as tmp:
        decks = os.path.join(tmp, "decks")
        os.makedirs(os.path.join(decks, "below"))
        sample = os.path.join(ROOT, "samples", "too_close_0000.rad")
        for name in ("one_0000.rad", os.path.join("below", "two_0000.rad"), "wrong_0000.rad"):
            shutil.copy(sample, os.path.join(decks, name))
        before = sorted(os.walk(decks))
        stand_in = write(os.path.join(tmp, "stand_in"), STAND_IN)
        os.chmod(stand_in, 0o700)

        r = bench(c, decks)
        c.check("without a Starter it says so", r.returncode == 0 and "nothing was run" in r.stdout and not r.stderr, r.stdout + r.stderr)
        r = bench(c, decks, "--starter", os.path.join(tmp, "none"))
        c.check("a Starter that is not there", r.returncode == 2 and "cannot be run" in r.stderr, r.stdout + r.stderr)
        r = bench(c, os.path.join(tmp, "decks", "nothing"), starter=stand_in)
        c.check("a folder without decks", r.returncode == 2 and "_0000.rad" in r.stderr, r.stdout + r.stderr)

        out = os.path.join(tmp, "table.json")
        r = bench(c, decks, "--json", out, starter=stand_in)
        lines = {line.split()[0]: line for line in r.stdout.splitlines()[1:] if line}
        c.check("a row for every deck", r.returncode == 0 and {"one_0000.rad", "two_0000.rad", "wrong_0000.rad"} <= set(lines),
                r.stdout + r.stderr)
        c.check("the mean of those that have a ratio", "ratios of 2 decks" in r.stdout, r.stdout)
        c.check("no ratio where the Starter stopped", "the Starter ended with 2" in lines.get("wrong_0000.rad", ""), r.stdout)
        with open(out) as f:
            rows = {os.path.basename(row["deck"]): row for row in json.load(f)["rows"]}
        row = rows["two_0000.rad"]
        c.check("seconds of the stand-in", 0.2 <= row["starter"]["cpu"] < 20, str(row))
        c.check("the ratio is that of the seconds", abs(row["ratio_one"] * max(row["one"]["cpu"], 1e-3) - row["starter"]["cpu"]) < 1e-6, str(row))
        c.check("a stopped run has no ratio in JSON", "ratio_one" not in rows["wrong_0000.rad"])
        c.check("nothing is left beside the decks", sorted(os.walk(decks)) == before)
    c.finish()


main()
