#!/usr/bin/env python3
"""Every rule that the sources name has a page in schemas/rules.

    python3 tests/lint/check_rule_ids.py"""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count  # noqa: E402
NAMED = re.compile(r"RuleId::(DK\d{3})\b")


def main():
    pages = {name[:-3] for name in os.listdir(os.path.join(ROOT, "schemas/rules"))}
    named = {}
    for top in ("libdeck", "tools", "tests"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in names:
                if name.endswith((".cpp", ".hpp")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as f:
                        for rule in NAMED.findall(f.read()):
                            named.setdefault(rule, os.path.relpath(path, ROOT))
    c = Count()
    for rule, path in named.items():
        c.check("%s names %s, which has no page" % (path, rule), rule in pages)
    c.check("enough rules are named in the sources", len(named) >= 200, len(named))
    c.finish()


if __name__ == "__main__":
    main()
