#!/usr/bin/env python3
"""A stage of the library includes only stages to its left: base, text, keyword, model, contact, cycle, accuracy; edit reads
those and is read by lint and report only; report is read by none of them.

    python3 tests/tools/check_stages.py"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROW = ["base", "text", "keyword", "model", "contact", "cycle", "accuracy"]
MAY = {stage: set(ROW[:i + 1]) for i, stage in enumerate(ROW)}
MAY["edit"] = {*ROW, "edit"}
MAY["lint"] = {*ROW, "edit", "lint"}
MAY["report"] = {*ROW, "edit", "lint", "report"}
INCLUDE = re.compile(r'^\s*#\s*include\s+"(?:deck/)?([a-z]+)/', re.M)


def stage_files():
    for top in ("libdeck", "libdeck/include/deck"):
        for stage in MAY:
            for folder, _, names in os.walk(os.path.join(ROOT, top, stage)):
                for name in sorted(names):
                    if name.endswith((".cpp", ".hpp")):
                        yield stage, os.path.join(folder, name)


def main():
    files = failed = 0
    for stage, path in stage_files():
        files += 1
        with open(path, encoding="utf-8") as f:
            wrong = sorted({s for s in INCLUDE.findall(f.read()) if s in MAY and s not in MAY[stage]})
        if wrong:
            failed += 1
            print("FAILED  %s, of stage %s, includes %s" % (os.path.relpath(path, ROOT), stage, ", ".join(wrong)))
    if files < 300:
        failed += 1
        print("FAILED  only %d files were found" % files)
    print("%d passed, %d failed" % (files - failed, failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
