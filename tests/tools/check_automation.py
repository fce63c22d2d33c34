#!/usr/bin/env python3
"""The scripts of samples/automation do what samples/README.md says, on decks of samples/.

    python3 tests/tools/check_automation.py build/dev/tools/deck"""
import csv
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, Checks  # noqa: E402

SAMPLES = os.path.join(ROOT, "samples")


class Scripts(Checks):
    def script(self, name, *arguments):
        env = dict(os.environ, DECK=self.program, NO_COLOR="1")
        return subprocess.run([sys.executable, os.path.join(SAMPLES, "automation", name), *arguments], env=env, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=300)

    def document(self, verb, path, *more):
        run = subprocess.run([self.program, verb, path, "--json", "-", "--quiet", *more], capture_output=True, text=True)
        return json.loads(run.stdout)


def add_interface(c, tmp):
    decks = []
    for k in range(20):
        decks.append(os.path.join(tmp, "car%02d_0000.rad" % k))
        shutil.copy(os.path.join(SAMPLES, "too_close_0000.rad"), decks[-1])
    out = os.path.join(tmp, "with_contact")
    r = c.script("add_interface.py", "-o", out, "--grnd", "2", "--surf", "1", "--gap", "0.8", *decks)
    c.check("add_interface ends with 0", r.returncode == 0, r.stderr)
    c.check("it names 20 decks", len(r.stdout.splitlines()) == 20, r.stdout)
    for path in decks:
        made = os.path.join(out, os.path.basename(path))
        if not os.path.exists(made):
            c.check("it writes " + made, False)
            continue
        interfaces = c.document("params", made)["interfaces"]
        values = interfaces[-1]["parameters"]
        c.check("the interface is there", [i["id"] for i in interfaces] == [1, 2], interfaces)
        c.check("with its values", [values[n]["value"] for n in ("Gapmin", "Fric", "Inacti", "Istf")] == [0.8, 0.2, 6, 4], values)
        with open(path) as old, open(made) as new:
            before, after = old.read().splitlines(), new.read().splitlines()
        c.check("and nothing else is changed", before == after[:len(before) - 1] + after[-1:], after)
    r = c.script("add_interface.py", "-o", out, "--grnd", "12345678901", "--surf", "1", "--gap", "0.8", decks[0])
    c.check("an id that does not fit is an error with its place",
            r.returncode != 0 and '/INTER/TYPE7/2, card "sides and flags", grnd_IDs' in r.stderr, r.stderr)


def sweep(c, tmp):
    deck = os.path.join(SAMPLES, "too_close_0000.rad")
    r = c.script("sweep_gapmin.py", deck, "--interface", "1", "-o", os.path.join(tmp, "sweep"), "0.8", "1.0", "1.2")
    c.check("sweep_gapmin ends with 0", r.returncode == 0, r.stderr)
    rows = [line.split() for line in r.stdout.splitlines()[1:]]
    c.check("a row for each value", [row[0] for row in rows] == ["0.8", "1", "1.2"], r.stdout)
    # The plates are 0.9 apart.
    c.check("what each does", [(int(row[1]) > 0, round(float(row[2]), 9)) for row in rows] == [(False, 0), (True, 0.1), (True, 0.3)],
            r.stdout)
    for row in rows:
        with open(deck) as old, open(row[3]) as new:
            changed = [(a, b) for a, b in zip(old, new) if a != b]
        c.check("one line of the deck differs", len(changed) == 1 and float(changed[0][1].split()[2]) == float(row[0]), changed)
    r = c.script("sweep_gapmin.py", deck, "--interface", "9", "-o", os.path.join(tmp, "none"), "0.8")
    c.check("an interface that is not there is an error", r.returncode == 2 and "no interface 9" in r.stderr, r.stderr)


def friction(c):
    decks = [os.path.join(SAMPLES, n + "_0000.rad") for n in ("too_close", "inacti_variants", "include_tree", "tied_layer")]
    r = c.script("collect_friction.py", *decks)
    c.check("collect_friction ends with 0", r.returncode == 0, r.stderr)
    rows = list(csv.DictReader(io.StringIO(r.stdout)))
    expected = []
    for path in decks:
        for i in c.document("params", path)["interfaces"]:
            if "Fric" in i["parameters"]:
                value = i["parameters"]["Fric"]
                expected.append((path, "/INTER/TYPE%d/%d" % (i["type"], i["id"]), float(value["value"]), value["origin"]))
    found = [(row["deck"], row["interface"], float(row["used"]), row["origin"]) for row in rows]
    c.check("every friction coefficient, as deck params has it", sorted(found) == sorted(expected) and len(found) > 8, found)
    c.check("each with its line", all(row["line"] for row in rows if row["origin"] == "card"), rows)


def main():
    c = Scripts()
    tmp = tempfile.mkdtemp(prefix="deck-automation-")
    try:
        add_interface(c, tmp)
        sweep(c, tmp)
        friction(c)
    finally:
        shutil.rmtree(tmp, ignore_errors=True)
    with open(os.path.join(SAMPLES, "README.md")) as f:
        readme = f.read()
    for name in sorted(os.listdir(os.path.join(SAMPLES, "automation"))):
        if name.endswith(".py"):
            c.check("samples/README.md names " + name, name in readme)
    c.finish()


if __name__ == "__main__":
    main()
