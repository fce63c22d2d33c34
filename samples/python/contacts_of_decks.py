"""All contacts of some decks in one table: what the solver will use, and what penetrates.

    python3 contacts_of_decks.py a_0000.rad b_0000.rad ...        writes contacts.csv and contacts.svg
"""
import csv
import os
import sys

import libdeck

FIELDS = ["Istf", "Igap", "Gapmin", "Inacti", "Stfac", "Fric", "Idel"]
rows = []
for path in sys.argv[1:]:
    try:
        deck = libdeck.load(path)
        gaps = deck.gaps()
    except libdeck.DeckError as error:
        print(f"{path}: {error}", file=sys.stderr)
        continue
    totals = {i["id"]: [c["totals"] for c in i["contacts"]] for i in gaps["interfaces"]}
    for i in deck.interfaces.list:
        values = [i[f].value if f in i.fields else "" for f in FIELDS]
        mine = totals.get(i.id, [])
        rows.append([os.path.basename(path), i.id, f"TYPE{i.type}", i.title, *values,
                     sum(t["pairs"] for t in mine), max((t["max_depth"] for t in mine), default=0.0)])

heads = ["deck", "id", "type", "title", *FIELDS, "penetrating pairs", "deepest"]
with open("contacts.csv", "w", newline="") as out:
    csv.writer(out).writerows([heads, *rows])
for row in [heads, *rows]:
    print("  ".join(f"{v:.4g}" if isinstance(v, float) else str(v) for v in row))
worst = max([r[-1] for r in rows], default=0.0) or 1.0
with open("contacts.svg", "w") as out:
    out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 {24 * max(1, len(rows))}" font-family="sans-serif" font-size="12">\n')
    for k, row in enumerate(rows):
        out.write(f'<text x="4" y="{24 * k + 16}">{row[0]} {row[2]}/{row[1]}</text>'
                  f'<rect x="300" y="{24 * k + 4}" width="{380 * row[-1] / worst:.1f}" height="14" fill="#c2410c"/>\n')
    out.write("</svg>\n")
