#!/usr/bin/env python3
"""collect_friction.py of samples/automation does what samples/README.md says, on decks of samples/.

    python3 tests/tools/check_automation.py build/dev/tools/deck"""
import csv
import io
import json
import os
import subprocess
import sys

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
    friction(c)
    c.finish()


if __name__ == "__main__":
    main()
