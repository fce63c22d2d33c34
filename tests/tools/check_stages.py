#!/usr/bin/env python3
"""A stage of the library includes only stages to its left: base, text, keyword, model, contact, cycle, accuracy; front
reads them up to cycle; inspect stands beside cycle and is read by edit and report; edit reads the row and is read by lint and
report only; report is read by none of them. Of another stage a file reads public headers and those of its folder shared/. Everybody comes in through front: who builds a model, a scene or a first cycle without
it is listed here with the reason. Files that comments name are there.

    python3 tests/tools/check_stages.py"""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count  # noqa: E402

ROW = ["base", "text", "keyword", "model", "contact", "cycle", "accuracy"]
MAY = {stage: set(ROW[:i + 1]) for i, stage in enumerate(ROW)}
# The public headers and their stages.
PUBLIC = {"deck": "all", "point3": "base", "text": "text", "rule_id": "text", "keyword": "keyword", "model": "model",
          "interface_fields": "model", "contacts": "contact", "cycle": "cycle", "loaded_deck": "front", "edit": "edit",
          "lint": "lint", "verdict": "verdict", "report": "report"}
MAY["front"] = {*ROW[:ROW.index("cycle") + 1], "front"}
MAY["inspect"] = {*ROW[:ROW.index("contact") + 1], "front", "inspect", "verdict"}
MAY["edit"] = {*ROW, "front", "inspect", "edit"}
MAY["lint"] = {*ROW, "front", "edit", "lint"}
MAY["verdict"] = {*ROW, "front", "verdict"}
MAY["report"] = {*ROW, "front", "inspect", "edit", "lint", "verdict", "report"}
MAY["all"] = set(MAY["report"])
PRIVATE = re.compile(r'^\s*#\s*include\s+"(([a-z_]+)/(?!shared/)[^"]+)"', re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s+"(?:deck/([a-z_0-9]+)\.hpp|([a-z_]+)/)', re.M)
COMMENT = re.compile(r"(?:^|\s)(//.*|/?\*.*)$", re.M)
FILE_NAME = re.compile(r"(?<![\w./<*-])((?:\w[\w-]*/)*\w[\w-]*\.(?:cpp|hpp))\b")
GENERATED = {"rule_id.hpp", "interface_fields.hpp"}

BUILDS = re.compile(r"\b(build_model|read_interfaces|build_scene|run_cycle)\(")
BUILDERS = ("libdeck/front/", "libdeck/model/", "libdeck/contact/", "libdeck/cycle/", "libdeck/include/deck/")
FOR_THEMSELVES = {
    "libdeck/edit/fix/fix_scene.cpp": "contacts of a model whose nodes are being moved",
    "libdeck/edit/fix/movable.cpp": "a model whose nodes are moved",
    "libdeck/lint/checks/geometry/run.cpp": "the first cycle of the scene of a quick look",
    "tools/python/src/results.cpp": "a first cycle with velocities, times and a model of forces of its own",
}


def stage_files():
    public = os.path.join(ROOT, "libdeck/include/deck")
    for name in sorted(os.listdir(public)):
        yield PUBLIC[name.removesuffix(".hpp")], os.path.join(public, name)
    for stage in MAY:
        for folder, _, names in os.walk(os.path.join(ROOT, "libdeck", stage)):
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


def builders():
    """Files that build what front has, but for those that front is made of."""
    for top in ("libdeck", "tools"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in sorted(names):
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                if not name.endswith((".cpp", ".hpp")) or path.startswith((*BUILDERS, "tools/bench/")):
                    continue
                with open(os.path.join(ROOT, path), encoding="utf-8") as f:
                    code = re.sub(r"//.*", "", f.read())
                if BUILDS.search(code):
                    yield path


def main():
    c = Count()
    for path, name in unknown_names(list(source_files())):
        c.check("a comment of %s names %s" % (path, name), False, "which is not there")
    for stage, path in stage_files():
        with open(path, encoding="utf-8") as f:
            text = f.read()
        read = {PUBLIC.get(header, folder) for header, folder in INCLUDE.findall(text)}
        wrong = [name for name, of in PRIVATE.findall(text) if of in MAY and of != stage]  # private headers of other stages
        wrong += sorted(s for s in read if s in MAY and s not in MAY[stage])
        c.check("%s, of stage %s, includes %s" % (os.path.relpath(path, ROOT), stage, ", ".join(wrong)), not wrong)
    found = set(builders())
    for path in sorted(found | set(FOR_THEMSELVES)):
        c.check("%s builds a model, a scene or a first cycle: it belongs to LoadedDeck (deck/loaded_deck.hpp)" % path, path in FOR_THEMSELVES)
        c.check("%s is listed here and builds nothing for itself any more" % path, path in found)
    c.check("enough files were found", c.passed > 300, c.passed)
    c.finish()


if __name__ == "__main__":
    main()
