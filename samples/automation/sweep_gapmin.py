#!/usr/bin/env python3
"""Writes a deck with several values of Gapmin and says what each of them does to the penetrations.

    sweep_gapmin.py car_0000.rad --interface 7 -o sweep 0.5 0.8 1.0 1.2"""
import argparse
import json
import os

import decks


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("deck")
    options.add_argument("values", nargs="+", type=float)
    options.add_argument("--interface", type=int, required=True)
    options.add_argument("-o", dest="directory", required=True)
    o = options.parse_args()
    document = decks.read(o.deck)
    chosen = [b for b in decks.blocks(document, "/INTER") if b.get("id") == o.interface]
    if not chosen:
        options.error("%s has no interface %d" % (o.deck, o.interface))
    print("%10s  %12s  %10s  deck" % ("Gapmin", "penetrations", "deepest"))
    for value in o.values:
        decks.fields(chosen[0], "Gapmin")["Gapmin"] = value
        path = decks.write(document, os.path.join(o.directory, "gapmin_%g" % value))
        gaps = json.loads(decks.call("gaps", path, "--interface", str(o.interface), "--json", "-", "--quiet"))
        found = [p["penetration"] for i in gaps["interfaces"] for c in i["contacts"] for p in c["penetrations"]]
        print("%10g  %12d  %10g  %s" % (value, len(found), max(found, default=0), path))


if __name__ == "__main__":
    main()
