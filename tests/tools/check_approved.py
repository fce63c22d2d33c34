#!/usr/bin/python3
"""What a verb says of a sample is as kept in tests/approved/VERB/DECK.json: numbers to nine digits, of a list the first two rows
and how many there are, a place in a file as file:line:column. samples/crash_box.html is the page of `deck gaps --html`, byte by byte.
DECK_RECORD=1 writes the records anew: read the difference."""
import csv
import io
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, Checks, read, write  # noqa: E402

PAGE = os.path.join(ROOT, "samples", "crash_box.html")
FOLDER = os.path.join(ROOT, "tests", "approved")
VERBS = {  # what is asked of which deck
    "params": ("include_tree", "--matrix", "--csv", "-"),
    "gaps": ("include_tree", "--all", "--json", "-"),
    "cycle": ("include_tree", "--all", "--json", "-"),
    "parts": ("include_tree", "--all", "--json", "-"),
    "lint": ("airbag_fold", "--geometry", "--json", "-"),
    "fix": ("crash_box", "--json", "-"),
    "show": ("tied_layer", "1", "--json", "-"),
}
MOST_LINES = 500
WIDTH = 140
LEFT_OUT = ("schema", "tool", "seconds")  # names and versions, measured times


def short(v):
    if isinstance(v, dict):
        if set(v) in ({"file", "line", "column"}, {"file", "line", "column", "end_column"}):
            return "%s:%s:%s" % (v["file"], v["line"], v["column"]) + ("-%s" % v["end_column"] if "end_column" in v else "")
        return {key: short(x) for key, x in v.items() if key not in LEFT_OUT}
    if isinstance(v, list):
        if all(isinstance(x, (int, float)) for x in v):  # round-off of a vector is none of its figures
            least = 1e-9 * max(map(abs, v), default=0)
            v = [x if abs(x) > least else type(x)(0) for x in v]
        if len(v) > 2 and isinstance(v[0], (dict, list)):
            return [short(x) for x in v[:2]] + ["… %d" % len(v)]
        return [short(x) for x in v]
    return float("%.9g" % v) if isinstance(v, float) else v


def lay(v, before="", indent=0, after=""):
    """The lines of a document: what fits on a line is on one line."""
    margin, whole = " " * indent, json.dumps(v, ensure_ascii=False)
    if len(margin + before + whole + after) <= WIDTH or not isinstance(v, (dict, list)):
        return [margin + before + whole + after]
    open_, close = "{}" if isinstance(v, dict) else "[]"
    items = list(v.items()) if isinstance(v, dict) else [(None, x) for x in v]
    lines, line = [margin + before + open_], ""
    for i, (key, value) in enumerate(items):
        name = "" if key is None else json.dumps(key) + ": "
        comma = "," if i + 1 < len(items) else ""
        text = name + json.dumps(value, ensure_ascii=False) + comma
        if line and len(line) + 1 + len(text) > WIDTH:
            lines, line = lines + [line], ""
        if indent + 1 + len(text) > WIDTH and isinstance(value, (dict, list)):
            lines, line = lines + ([line] if line else []) + lay(value, name, indent + 1, comma), ""
        else:
            line = (line + " " if line else margin + " ") + text
    return lines + ([line] if line else []) + [margin + close + after]


def cell(text):
    return "%.9g" % float(text) if "." in text and text.replace(".", "").isdigit() else text


def document(verb, text):
    if verb == "params":
        head, *rows = csv.reader(io.StringIO(text))
        return [dict(zip(head, map(cell, row))) for row in rows]
    found = short(json.loads(text))
    if verb != "parts":
        del found["deck"]  # the same of every verb
    if verb in ("cycle", "lint", "fix"):
        del found["verdict"]["sentences"]  # of gaps they are kept
    if verb == "cycle":
        del found["accuracy"]
    return found


def check_page(c):
    r = c.run("gaps", os.path.join("samples", "crash_box_0000.rad"), "--quiet", "--html", "-", cwd=ROOT)
    if b"has no viewer" in r.err:
        return c.skip(PAGE, "this build has no viewer")
    found = r.out.replace(b"\n", b"\r")  # a browser reads CR as LF; a difference of this generated file is one line
    if c.options.record:
        write(PAGE, found)
    c.check(PAGE + " is what the program writes; DECK_RECORD=1 writes it anew", read(PAGE) == found)
    c.check(PAGE + " has at most 1 MB", len(found) <= 1 << 20, str(len(found)))


def main():
    c = Checks()
    check_page(c)
    lines = 0
    for verb, (deck, *arguments) in VERBS.items():
        r = c.run(verb, os.path.join("samples", deck + "_0000.rad"), *arguments, cwd=ROOT)
        path = os.path.join(FOLDER, verb, deck + ".json")
        found = "\n".join(lay({"exit": r.code, verb: document(verb, r.out.decode())})) + "\n"
        lines += found.count("\n")
        if c.options.record:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as f:
                f.write(found)
        with open(path, encoding="utf-8") as f:
            kept = f.read()
        at = next((i for i, (a, b) in enumerate(zip(kept.split("\n"), found.split("\n"))) if a != b), 0)
        c.check("tests/approved/%s/%s.json:%d" % (verb, deck, at + 1), kept == found, "now %s" % found.split("\n")[at])
    c.check("tests/approved has at most %d lines" % MOST_LINES, lines <= MOST_LINES, str(lines))
    c.finish()


if __name__ == "__main__":
    main()
