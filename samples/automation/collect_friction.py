#!/usr/bin/env python3
"""All friction coefficients of many decks as one table: what the card says, what the solver uses, and
where that comes from.

    collect_friction.py car01_0000.rad car02_0000.rad ... > friction.csv"""
import csv
import json
import os
import subprocess
import sys


def interfaces(path):
    """The interfaces of a deck and of what it includes, out of deck convert --to json."""
    deck = os.environ.get("DECK", "deck")
    run = subprocess.run([deck, "convert", path, "--to", "json", "-o", "-", "--quiet"], stdout=subprocess.PIPE)
    if run.returncode not in (0, 1):
        sys.exit(run.returncode)
    for file in json.loads(run.stdout)["files"]:
        for item in file.get("items", []):
            if item["kind"] == "block" and item["keyword"].startswith("/INTER/"):
                yield item


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["deck", "interface", "title", "on the card", "used", "origin", "file", "line"])
    for path in sys.argv[1:]:
        for block in interfaces(path):
            friction = block.get("effective", {}).get("Fric")
            if friction is None:
                continue
            title = next((line["title"] for line in block["lines"] if isinstance(line, dict) and "title" in line), "")
            source = friction["source"] or {"file": "", "line": ""}
            table.writerow([path, "%s/%d" % (block["keyword"], block.get("id", 0)), title, friction["input"],
                            friction["value"], friction["origin"], source["file"], source["line"]])


if __name__ == "__main__":
    main()
