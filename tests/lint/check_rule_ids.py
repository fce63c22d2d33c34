#!/usr/bin/env python3
"""Every rule that the sources name has a page in schemas/rules.

    python3 tests/lint/check_rule_ids.py"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
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
    lost = sorted(set(named) - pages)
    for rule in lost:
        print("FAILED  %s names %s, which has no page" % (named[rule], rule))
    if len(named) < 200:
        lost.append("few")
        print("FAILED  only %d rules are named in the sources" % len(named))
    print("%d passed, %d failed" % (len(named), len(lost)))
    sys.exit(1 if lost else 0)


if __name__ == "__main__":
    main()
