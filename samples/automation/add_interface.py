#!/usr/bin/env python3
"""Adds one contact interface to many decks.

    add_interface.py -o with_contact --grnd 2 --surf 1 --gap 0.8 car01_0000.rad car02_0000.rad ..."""
import argparse

import decks


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("decks", nargs="+")
    options.add_argument("-o", dest="directory", required=True)
    options.add_argument("--grnd", type=int, required=True, help="node group of the secondary side")
    options.add_argument("--surf", type=int, required=True, help="surface of the main side")
    options.add_argument("--gap", type=float, required=True)
    options.add_argument("--fric", type=float, default=0.2)
    o = options.parse_args()
    for path in o.decks:
        document = decks.read(path)
        interface = max([b.get("id", 0) for b in decks.blocks(document, "/INTER")], default=0) + 1
        items = document["files"][0]["items"]
        end = next((i for i, item in enumerate(items) if item["kind"] == "text" and "/END" in item["lines"]), len(items))
        # Cards in the order of 'deck explain /INTER/TYPE7'; a field that is not named is blank.
        items.insert(end, {"kind": "block", "keyword": "/INTER/TYPE7", "id": interface, "lines": [
            {"title": "added by add_interface.py"},
            {"card": "sides and flags", "fields": {"grnd_IDs": o.grnd, "surf_IDm": o.surf, "Istf": 4, "Idel": 2}},
            {"card": "gap"},
            {"card": "stiffness bounds, mesh size, removal"},
            {"card": "stiffness, friction, gap, times", "fields": {"Fric": o.fric, "Gapmin": o.gap}},
            {"card": "release flags, damping, sorting", "fields": {"Inacti": 6}},
            {"card": "friction"}]})
        print("%s: /INTER/TYPE7/%d" % (decks.write(document, o.directory), interface))


if __name__ == "__main__":
    main()
