"""Histogram of the initial penetrations of a deck, as a share of the gap: one bar chart per interface that has any.

    python3 histogram.py car_0000.rad        writes penetrations.svg
"""
import sys

import numpy as np

import libdeck

deck = libdeck.load(sys.argv[1])
shares = {}
for contact in deck.gaps().contacts:
    p = contact.penetrations
    if len(p["penetration"]):
        shares.setdefault(contact.interface, []).append(p["penetration"] / p["gap"])

edges = np.linspace(0, 1, 11)
rows = {i: np.histogram(np.concatenate(s), edges)[0] for i, s in sorted(shares.items())}
print("share of gap " + "".join(f"{e * 100:5.0f}%" for e in edges[1:]))
for i, counts in rows.items():
    print(f"interface {i:<3d}" + "".join(f"{n:6d}" for n in counts))

width, height, bar = 720, 90, 60
with open("penetrations.svg", "w") as out:
    out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height * max(1, len(rows))}" font-family="sans-serif" font-size="11">\n')
    for k, (i, counts) in enumerate(rows.items()):
        y = (k + 1) * height - 22
        out.write(f'<text x="4" y="{y}">{i} {deck.interfaces[i].title[:14]}</text>\n')
        for b, n in enumerate(counts):
            h = 56 * n / max(1, counts.max())
            x = 100 + b * bar
            out.write(f'<rect x="{x}" y="{y - h:.1f}" width="{bar - 6}" height="{h:.1f}" fill="#c2410c"/>'
                      f'<text x="{x}" y="{y + 14}">{edges[b] * 100:.0f}-{edges[b + 1] * 100:.0f} %: {n}</text>\n')
    out.write("</svg>\n")
