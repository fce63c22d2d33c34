#!/usr/bin/env python3
"""Holds `deck params` and `deck gaps` of every deck in oracle/tied against what the reference Starter did with its /INTER/TYPE2.

  check_ties.py [DECK] [NAME...]     'N passed, N failed' at the end; skips where the records are absent (DECK_CORPUS)

Compared to 1e-9: every value of the card; per node whether it is tied, the message that lists it, its segment and the place there,
distance, search distance, penalty; ties that another interface has already (1630); main nodes that are tied (556). A record with a
`variant` is of the deck in the corpus with these fields overwritten: that is done here."""
import glob
import gzip
import json
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count  # noqa: E402

CORPUS = os.environ.get("DECK_CORPUS") or os.path.join(ROOT, "..", "shared")
NOTHING = {"Spotflag": 5, "Ignore": 1000, "Idel2": 1000}  # stored as 0


def near(a, b, scale=0.0):
    return abs(a - b) <= 1e-9 * max(abs(a), abs(b), scale, 1e-30)


def weights(nodes, s, t, by_weight):
    values = (s, t, 1 - s - t, 0.0) if by_weight else ((1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4, (1 + s) * (1 + t) / 4, (1 - s) * (1 + t) / 4)
    out = {}
    for n, w in zip(nodes, values):
        out[n] = out.get(n, 0.0) + w
    return out


def overwritten(text, variant):
    """The deck with the fields that `variant` names on every TYPE2 card."""
    new = {}
    for name, (first, last) in {"Ignore": (20, 30), "Spotflag": (30, 40), "dsearch": (80, 100)}.items():
        m = re.search(name + r" ([-\d.e+]+)", variant)
        if m:
            new[first, last] = m.group(1)
    lines, out, left = text.split("\n"), [], 0
    for line in lines:
        if line.startswith("/"):
            left = 2 if line.startswith("/INTER/TYPE2/") else 0  # title and card
        elif left and not line.startswith("#"):
            left -= 1
            if left == 0:
                line = line.ljust(100)
                for (first, last), value in new.items():
                    line = line[:first] + value.rjust(last - first) + line[last:]
                if new.get((30, 40)) in ("25", "26", "27", "28"):
                    line += "\n"
        out.append(line)
    return "\n".join(out)


def deck_of(folder, record, scratch):
    name = os.path.basename(folder)
    plain = re.sub(r"_v\d+$", "", name) if record.get("variant") else name
    for found in glob.glob(os.path.join(CORPUS, "corpus", "**", plain + "_0000.rad"), recursive=True):
        if not record.get("variant"):
            return found
        path = os.path.join(scratch, name + "_0000.rad")
        with open(path, "w", encoding="latin-1") as f:
            f.write(overwritten(open(found, encoding="latin-1").read(), record["variant"]))
        return path
    return sorted(glob.glob(os.path.join(folder, "*_0000.rad*")))[0]


def run(deck, *arguments):
    include = os.path.join(CORPUS, "corpus", "EuroSID_II")
    done = subprocess.run([deck, *arguments, "--include-path", include, "--quiet", "--json", "-"], capture_output=True)
    return json.loads(done.stdout)


def wrong_card(ref, params):
    for name, value in ref["card"].items():
        have = params.get(name)
        if have is None:
            return "%s is missing" % name
        have = 0 if have["value"] == NOTHING.get(name) else have["value"]
        if value is not None and not near(have, value):
            return "%s is %s instead of %s" % (name, have, value)
    return ""


def wrong_node(row, got, by_weight, final):
    if got is None:
        return "missing"
    if final and "tied" in row and bool(row["tied"]) != got["tied"]:
        return "tied: %s" % got["tied"]
    if row.get("message", 0) != (got["message"] or 0):
        return "message %s instead of %s" % (got["message"], row.get("message", 0))
    if final and "penalty" in row and bool(row["penalty"]) != got["penalty"]:
        return "penalty: %s" % got["penalty"]
    theirs, mine = [row.get("n%d" % k, 0) for k in (1, 2, 3, 4)], got["segment"]
    if not theirs[0]:
        return "a segment: %s" % mine if mine else ""
    if set(mine or []) != set(theirs):
        return "segment %s instead of %s" % (mine, theirs)
    triangle = by_weight and len(set(theirs)) == 3
    a, b = weights(theirs, row["s"], row["t"], triangle), weights(mine, got["s"], got["t"], triangle)
    if any(not near(a[n], b[n], 1.0) for n in a):
        return "place (%s, %s) instead of (%s, %s)" % (got["s"], got["t"], row["s"], row["t"])
    if "distance" in row and not near(row["distance"], got["distance"], row["search"]):
        return "distance %s instead of %s" % (got["distance"], row["distance"])
    if row.get("search") and not near(row["search"], got["search"]):
        return "search distance %s instead of %s" % (got["search"], row["search"])
    return ""


def wrong_interface(ref, tie, params, final):
    if tie is None:
        return "not there"
    wrong = wrong_card(ref, params)
    if wrong:
        return wrong
    nodes = {n["node"]: n for n in tie["nodes"]}
    rows = [dict(zip(ref["columns"], row)) for row in ref["nodes"]]
    if set(nodes) != {r["node"] for r in rows}:
        return "%d nodes instead of %d" % (len(nodes), len(rows))
    for row in rows:
        wrong = wrong_node({k: v for k, v in row.items() if v is not None}, nodes[row["node"]], ref["card"].get("Spotflag") == 27, final)
        if wrong:
            return "node %d: %s" % (row["node"], wrong)
    if final and sorted(ref.get("error_556_nodes") or []) != sorted(tie["main_and_tied"]):
        return "main nodes that are tied: %s instead of %s" % (tie["main_and_tied"], ref.get("error_556_nodes"))
    return ""


def main():
    arguments = sys.argv[1:]
    deck = arguments[0] if arguments else os.path.join(ROOT, "build", "dev", "tools", "deck", "deck")
    folders = sorted(glob.glob(os.path.join(CORPUS, "oracle", "tied", "*", "")))
    if not folders:
        print("0 passed, 0 failed: no records under " + CORPUS)
        return
    c = Count()
    for folder in folders:
        folder = folder.rstrip(os.sep)
        name = os.path.basename(folder)
        if arguments[1:] and name not in arguments[1:]:
            continue
        record = json.load(gzip.open(os.path.join(folder, name + ".json.gz")))
        with tempfile.TemporaryDirectory() as scratch:
            path = deck_of(folder, record, scratch)
            ties = {t["id"]: t for t in run(deck, "gaps", path, "--all")["ties"]}
            params = {p["id"]: p["parameters"] for p in run(deck, "params", path)["interfaces"]}
        for ref in record["interfaces"]:
            wrong = wrong_interface(ref, ties.get(ref["id"]), params.get(ref["id"]), record["final"])
            c.check("%s, TYPE2 %d" % (name, ref["id"]), not wrong, wrong)
    c.finish()


if __name__ == "__main__":
    main()
