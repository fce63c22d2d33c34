#!/usr/bin/env python3
"""Adds one contact interface to many decks.

    add_interface.py -o with_contact --grnd 2 --surf 1 --gap 0.8 car01_0000.rad car02_0000.rad ..."""
import argparse
import sys

import libdeck


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("decks", nargs="+")
    options.add_argument("-o", dest="directory", required=True)
    options.add_argument("--grnd", type=int, required=True, help="node group of the secondary side")
    options.add_argument("--surf", type=int, required=True, help="surface of the main side")
    options.add_argument("--gap", type=float, required=True, help="in the working units of the decks")
    options.add_argument("--fric", type=float, default=0.2)
    o = options.parse_args()
    for path in o.decks:
        deck = libdeck.load(path)
        new = max(deck.interfaces, default=0) + 1
        # The lines of the block come with the fields, which 'deck explain TYPE7' names; others are blank.
        deck.insert("/INTER/TYPE7/%d\nadded by add_interface.py\n" % new)
        deck.interfaces[new].set(grnd_IDs=o.grnd, surf_IDm=o.surf, Istf=4, Idel=2, Gapmin=o.gap, Fric=o.fric, Inacti=6)
        deck.write(o.directory, overwrite=True)
        print("%s: /INTER/TYPE7/%d" % (path, new))


if __name__ == "__main__":
    try:
        main()
    except (ValueError, OSError, libdeck.DeckError) as why:
        sys.exit(str(why))
