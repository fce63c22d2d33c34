"""How many nodes penetrate, and how deep, for a range of Gapmin: which gap does the mesh allow?

    python3 sweep_gapmin.py car_0000.rad [INTERFACE]        writes sweep.svg
"""
import sys

import numpy as np

import libdeck

deck = libdeck.load(sys.argv[1])
ids = [i.id for i in deck.interfaces.list if "Gapmin" in i.fields]
interface = deck.interfaces[int(sys.argv[2]) if len(sys.argv) > 2 else ids[0]]
present = interface.Gapmin.value
print(f"interface {interface.id} {interface.title!r}: Gapmin {present} ({interface.Gapmin.origin})")

rows = []
for gap in present * np.linspace(0.1, 1.5, 15):
    gaps = deck.what_if(interface.id, Gapmin=float(gap))
    mine = [c["totals"] for i in gaps["interfaces"] if i["id"] == interface.id for c in i["contacts"]]
    nodes = sum(t["nodes"] + t["edges"] for t in mine)
    deepest = max((t["max_depth"] for t in mine), default=0.0)
    rows.append((gap, nodes, deepest))
    print(f"Gapmin {gap:10.4g}   penetrating {nodes:5d}   deepest {deepest:.4g}")

x = np.array([r[0] for r in rows]) / rows[-1][0] * 600 + 60
y = 200 - np.array([r[1] for r in rows]) / max(1, max(r[1] for r in rows)) * 160
points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
with open("sweep.svg", "w") as out:
    out.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 240" font-family="sans-serif" font-size="12">\n'
              f'<polyline points="{points}" fill="none" stroke="#1d4ed8" stroke-width="2"/>\n'
              f'<text x="60" y="225">Gapmin 0 to {rows[-1][0]:.4g}</text>'
              f'<text x="60" y="20">penetrating nodes and edges, up to {max(r[1] for r in rows)}</text>\n</svg>\n')
