#!/usr/bin/env python3
"""A stage of the library includes only stages to its left: base, text, keyword, model, contact, cycle, accuracy; inspect
stands beside cycle and is read by edit and report; edit reads the row and is read by lint and report only; report is read by none
of them. Files that comments name are there.

    python3 tests/tools/check_stages.py"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROW = ["base", "text", "keyword", "model", "contact", "cycle", "accuracy"]
MAY = {stage: set(ROW[:i + 1]) for i, stage in enumerate(ROW)}
MAY["inspect"] = {*ROW[:ROW.index("contact") + 1], "inspect"}
MAY["edit"] = {*ROW, "inspect", "edit"}
MAY["lint"] = {*ROW, "edit", "lint"}
MAY["verdict"] = {*ROW, "verdict"}
MAY["report"] = {*ROW, "inspect", "edit", "lint", "verdict", "report"}
INCLUDE = re.compile(r'^\s*#\s*include\s+"(?:deck/)?([a-z]+)/', re.M)
COMMENT = re.compile(r"(?:^|\s)(//.*|/?\*.*)$", re.M)
FILE_NAME = re.compile(r"(?<![\w./<*-])((?:\w[\w-]*/)*\w[\w-]*\.(?:cpp|hpp))\b")
GENERATED = {"rule_id.hpp"}


def stage_files():
    for top in ("libdeck", "libdeck/include/deck"):
        for stage in MAY:
            for folder, _, names in os.walk(os.path.join(ROOT, top, stage)):
                for name in sorted(names):
                    if name.endswith((".cpp", ".hpp")):
                        yield stage, os.path.join(folder, name)


def source_files():
    for top in ("libdeck", "tools", "tests"):
        for folder, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = sorted(f for f in folders if f not in ("node_modules", "build"))
            for name in sorted(names):
                if name.endswith((".cpp", ".hpp")):
                    yield os.path.join(folder, name)


def unknown_names(paths):
    """(file, name) for every file that a comment of one of `paths` names and that is not there."""
    known = set(GENERATED)
    for path in paths:
        parts = os.path.relpath(path, ROOT).split(os.sep)
        known.update("/".join(parts[i:]) for i in range(len(parts)))
    for path in paths:
        with open(path, encoding="utf-8", errors="replace") as f:
            for comment in COMMENT.findall(f.read()):
                for name in FILE_NAME.findall(comment):
                    if name not in known and os.path.basename(name) not in GENERATED:
                        yield os.path.relpath(path, ROOT), name


def main():
    files = failed = 0
    for path, name in unknown_names(list(source_files())):
        files += 1
        failed += 1
        print("FAILED  a comment of %s names %s, which is not there" % (path, name))
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
