#!/usr/bin/env python3
"""Writes the sample decks beside this file. Run it after changing a deck here; the decks are kept in
the repository so you need not run it to use them. Over 600 lines: one function a deck.

    python3 samples/generate.py            write all decks
    python3 samples/generate.py --check    exit 1 if a deck on disk differs from what would be written
    python3 samples/generate.py --sheets N FILE [--apart MM]
                                           write a deck of 2 N^2 shells to FILE ('-': standard output), for
                                           measuring; nothing of it is kept in the repository

Every line is built from (column, width, name, value) cells and preceded by a comment line naming the
columns, the way pre-processors write decks. every_mistake_0000.rad is written by hand and is not
touched."""
import argparse
import math
import os
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))


def number(value, width):
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    text = repr(round(value, 9) if abs(value) > 1e-3 else value)
    return text if len(text) < width else "%.*g" % (width - 7, value)


def cells(*spec):
    """Comment line and data line from (first column, last column, name, value); None leaves a blank."""
    head, line = "#", ""
    for first, last, name, value in spec:
        width = last - first + 1
        head += name[: max(width - 1, 3)].rjust(last - len(head)) if last > len(head) else ""
        if value is not None:
            line += number(value, width).rjust(last - len(line))
    return head + "\n" + line.rstrip() + "\n"


def ints(first, *pairs):
    return [(first + 10 * i, first + 10 * i + 9, n, v) for i, (n, v) in enumerate(pairs) if n]


def reals(first, *pairs):
    return [(first + 20 * i, first + 20 * i + 19, n, v) for i, (n, v) in enumerate(pairs) if n]


class Deck:
    def __init__(self, name, title, version=2022, units=("kg", "mm", "ms"), work=None):
        self.name, self.text = name, ""
        self.raw("#RADIOSS STARTER\n/BEGIN\n%s\n" % title)
        self.raw("%10d%10d\n" % (version, 0))
        for u in (units, work or units):
            self.raw("".join("%20s" % x for x in u) + "\n")

    def raw(self, text):
        self.text += text

    def note(self, text):
        for line in textwrap.wrap(" ".join(text.split()), 96):
            self.raw("# " + line + "\n")

    def block(self, header, title, *cards):
        self.raw(header + "\n" + (title + "\n" if title is not None else "") + "".join(cards))

    def elastic(self, mid, name, density=7.8e-6, young=210.0, nu=0.3):
        self.block("/MAT/ELAST/%d" % mid, name, cells((1, 20, "RHO_I", density)),
                   cells(*reals(1, ("E", young), ("nu", nu))))

    def shell_prop(self, pid, name, thick):
        self.block("/PROP/SHELL/%d" % pid, name,
                   cells(*ints(1, ("Ishell", 24), ("Ismstr", 0), ("Ish3n", 0), ("Idrill", 0))),
                   cells(*reals(1, ("hm", 0.0), ("hf", 0.0), ("hr", 0.0), ("dm", 0.0), ("dn", 0.0))),
                   cells((1, 10, "N", 5), (21, 40, "Thick", thick), (41, 60, "Ashear", 0.0),
                         (71, 80, "Ithick", 0), (81, 90, "Iplas", 0)))

    def solid_prop(self, pid, name):
        self.block("/PROP/SOLID/%d" % pid, name,
                   cells((1, 10, "Isolid", 24), (11, 20, "Ismstr", 0), (31, 40, "Icpre", 0),
                         (41, 50, "Itetra10", 0), (51, 60, "Inpts", 0), (61, 70, "Itetra4", 0),
                         (71, 80, "Iframe", 0), (81, 100, "dn", 0.0)),
                   cells(*reals(1, ("qa", 0.0), ("qb", 0.0), ("h", 0.0), ("lambda", 0.0), ("mu", 0.0))),
                   cells((1, 20, "dt_min", 0.0)))

    def part(self, pid, name, prop, mat, subset=0, thick=None):
        self.block("/PART/%d" % pid, name,
                   cells((1, 10, "prop_ID", prop), (11, 20, "mat_ID", mat), (21, 30, "subset_ID", subset),
                         (31, 50, "Thick", thick)))

    def nodes(self, rows, header="/NODE"):
        self.raw(header + "\n#  node_ID                   X                   Y                   Z\n")
        for n, (x, y, z) in rows:
            self.raw("%10d" % n + "".join(number(float(c), 20).rjust(20) for c in (x, y, z)) + "\n")

    def elements(self, kind, part, rows):
        self.raw("/%s/%d\n" % (kind, part))
        self.raw("# elem_ID" + "".join(("node%d" % (i + 1)).rjust(10)
                                       for i in range(len(rows[0]) - 1)) + "\n")
        for r in rows:
            self.raw("".join("%10d" % v for v in r) + "\n")

    def ids(self, header, title, values):
        self.raw(header + "\n" + title + "\n")
        for i in range(0, len(values), 10):
            self.raw("".join("%10s" % v for v in values[i:i + 10]) + "\n")

    def type2(self, iid, title, grnd, surf, Ignore=None, Spotflag=None, Level=None, Isearch=None, Idel2=None, dsearch=None):
        self.block("/INTER/TYPE2/%d" % iid, title,
                   cells(*ints(1, ("grnd_IDs", grnd), ("surf_IDm", surf), ("Ignore", Ignore), ("Spotflag", Spotflag),
                               ("Level", Level), ("Isearch", Isearch), ("Idel2", Idel2)), (81, 100, "dsearch", dsearch)),
                   *([cells(*reals(1, ("Stfac", 1.0), ("Visc", 0.05)), (61, 70, "Istf", 2))] if Spotflag in (25, 26, 27, 28) else []))

    def type7(self, iid, title, grnd, surf, Istf=None, Ithe=None, Igap=None, Ibag=None, Idel=None, Icurv=None, Iadm=None,
              Fscalegap=None, Gapmax=None, Fpenmax=None, ITIED=None, Stmin=None, Stmax=None, mesh=None,
              dtmin=None, Irem_gap=None, Irem_i2=None, Stfac=None, Fric=None, Gapmin=None, Tstart=None,
              Tstop=None, ibc="000", Inacti=None, VISs=None, VISF=None, Bumult=None, Ifric=None, Ifiltr=None,
              Xfreq=None, Iform=None, sens=None, fctF=None, AscaleF=None, fric=None, C=None, C6=None,
              thermal=None, unit=None):
        cards = [
            cells((1, 10, "grnd_IDs", grnd), (11, 20, "surf_IDm", surf), (21, 30, "Istf", Istf),
                  (31, 40, "Ithe", Ithe), (41, 50, "Igap", Igap), (61, 70, "Ibag", Ibag),
                  (71, 80, "Idel", Idel), (81, 90, "Icurv", Icurv), (91, 100, "Iadm", Iadm)),
            cells((1, 20, "Fscalegap", Fscalegap), (21, 40, "Gapmax", Gapmax), (41, 60, "Fpenmax", Fpenmax),
                  (81, 90, "ITIED", ITIED)),
            cells(*reals(1, ("Stmin", Stmin), ("Stmax", Stmax), ("%mesh_size", mesh), ("dtmin", dtmin)),
                  (81, 90, "Irem_gap", Irem_gap), (91, 100, "Irem_i2", Irem_i2)),
            cells(*reals(1, ("Stfac", Stfac), ("Fric", Fric), ("Gapmin", Gapmin), ("Tstart", Tstart), ("Tstop", Tstop))),
            cells((8, 10, "IBC", ibc), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs),
                  (61, 80, "VISF", VISF), (81, 100, "Bumult", Bumult)),
            cells((1, 10, "Ifric", Ifric), (11, 20, "Ifiltr", Ifiltr), (21, 40, "Xfreq", Xfreq),
                  (41, 50, "Iform", Iform), (51, 60, "sens_ID", sens), (61, 70, "fct_IDF", fctF),
                  (71, 90, "AscaleF", AscaleF), (91, 100, "fric_ID", fric))]
        if C:
            cards.append(cells(*reals(1, *[("C%d" % (i + 1), c) for i, c in enumerate(C)])))
        if C6 is not None:
            cards.append(cells((1, 20, "C6", C6)))
        if thermal:
            k, f, tint, form, asc, frad, drad, fs, fm = thermal
            cards.append(cells((1, 20, "Kthe", k), (21, 30, "fct_IDK", f), (41, 60, "Tint", tint),
                               (61, 70, "Ithe_form", form), (71, 90, "AscaleK", asc)))
            cards.append(cells(*reals(1, ("Frad", frad), ("Drad", drad), ("Fheats", fs), ("Fheatm", fm))))
        self.block("/INTER/TYPE7/%d" % iid + ("/%d" % unit if unit else ""), title, *cards)

    def type10(self, iid, title, grnd, surf, Idel=None, Stfac=None, Gap=None, Tstart=None, Tstop=None,
               ITIED=None, Inacti=None, VISs=None, Bumult=None):
        self.block("/INTER/TYPE10/%d" % iid, title,
                   cells((1, 10, "grnd_IDs", grnd), (11, 20, "surf_IDm", surf), (71, 80, "Idel", Idel)),
                   cells((1, 20, "Stfac", Stfac), (41, 60, "Gap", Gap), (61, 80, "Tstart", Tstart), (81, 100, "Tstop", Tstop)),
                   cells((21, 30, "ITIED", ITIED), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs), (81, 100, "Bumult", Bumult)))

    def type11(self, iid, title, lines, linem, Istf=None, Ithe=None, Igap=None, Irem_gap=None, Idel=None,
               Stmin=None, Stmax=None, mesh=None, dtmin=None, Iform=None, sens=None, Stfac=None, Fric=None,
               Gapmin=None, Tstart=None, Tstop=None, ibc="000", Inacti=None, VISs=None, VISF=None,
               Bumult=None, fric=None):
        self.block("/INTER/TYPE11/%d" % iid, title,
                   cells((1, 10, "line_IDs", lines), (11, 20, "line_IDm", linem), (21, 30, "Istf", Istf),
                         (31, 40, "Ithe", Ithe), (41, 50, "Igap", Igap), (61, 70, "Irem_gap", Irem_gap), (71, 80, "Idel", Idel)),
                   cells(*reals(1, ("Stmin", Stmin), ("Stmax", Stmax), ("%mesh_size", mesh), ("dtmin", dtmin)),
                         (81, 90, "Iform", Iform), (91, 100, "sens_ID", sens)),
                   cells(*reals(1, ("Stfac", Stfac), ("Fric", Fric), ("Gapmin", Gapmin), ("Tstart", Tstart), ("Tstop", Tstop))),
                   cells((8, 10, "IBC", ibc), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs),
                         (61, 80, "VISF", VISF), (81, 100, "Bumult", Bumult)),
                   cells((91, 100, "fric_ID", fric)) if fric else
                   "#" + "fric_ID".rjust(99) + "\n" + "0".rjust(100) + "\n")

    def type19(self, iid, title, surfs, surfm, Istf=None, Ithe=None, Igap=None, Iedge=None, Ibag=None, Idel=None, Icurv=None,
               Fscalegap=None, Gapmax=None, Stmin=None, Stmax=None, mesh=None, dtmin=None, Irem_gap=None,
               Irem_i2=None, Stfac=None, Fric=None, Gapmin=None, Tstart=None, Tstop=None, ibc="000",
               Inacti=None, VISs=None, VISF=None, Bumult=None, Ifric=None, Ifiltr=None, Xfreq=None,
               Iform=None, sens=None, fric=None):
        self.block("/INTER/TYPE19/%d" % iid, title,
                   cells(*ints(1, ("surf_IDs", surfs), ("surf_IDm", surfm), ("Istf", Istf), ("Ithe", Ithe),
                               ("Igap", Igap), ("Iedge", Iedge), ("Ibag", Ibag), ("Idel", Idel), ("Icurv", Icurv))),
                   cells(*reals(1, ("Fscalegap", Fscalegap), ("Gapmax", Gapmax))),
                   cells(*reals(1, ("Stmin", Stmin), ("Stmax", Stmax), ("%mesh_size", mesh), ("dtmin", dtmin)),
                         (81, 90, "Irem_gap", Irem_gap), (91, 100, "Irem_i2", Irem_i2)),
                   cells(*reals(1, ("Stfac", Stfac), ("Fric", Fric), ("Gapmin", Gapmin), ("Tstart", Tstart), ("Tstop", Tstop))),
                   cells((8, 10, "IBC", ibc), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs),
                         (61, 80, "VISF", VISF), (81, 100, "Bumult", Bumult)),
                   cells((1, 10, "Ifric", Ifric), (11, 20, "Ifiltr", Ifiltr), (21, 40, "Xfreq", Xfreq),
                         (41, 50, "Iform", Iform), (51, 60, "sens_ID", sens), (91, 100, "fric_ID", fric)))

    def type24(self, iid, title, surf1, surf2, Istf=None, Irem_i2=None, Idel=None, Iedge=None, Edge_angle=None,
               Gap_max_s=None, Gap_max_m=None, Stmin=None, Stmax=None, Igap0=None, Ipen0=None, Ipen_max=None, Stfac=None,
               Fric=None, ibc="000", Inacti=None, VISs=None):
        self.block("/INTER/TYPE24/%d" % iid, title,
                   cells((1, 10, "surf_ID1", surf1), (11, 20, "surf_ID2", surf2), (21, 30, "Istf", Istf),
                         (51, 60, "Irem_i2", Irem_i2), (71, 80, "Idel", Idel)),
                   cells((1, 10, "grnd_IDs", 0), (31, 40, "Iedge", Iedge), (41, 60, "Edge_angle", Edge_angle),
                         (61, 80, "Gap_max_s", Gap_max_s), (81, 100, "Gap_max_m", Gap_max_m)),
                   cells(*reals(1, ("Stmin", Stmin), ("Stmax", Stmax)), (41, 50, "Igap0", Igap0), (51, 60, "Ipen0", Ipen0),
                         (61, 80, "Ipen_max", Ipen_max)),
                   cells(*reals(1, ("Stfac", Stfac), ("Fric", Fric))),
                   cells((8, 10, "IBC", ibc), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs)),
                   cells((1, 10, "Ifric", 0), (11, 20, "Ifiltr", 0), (21, 40, "Xfreq", 0.0)))

    def type25(self, iid, title, surf1, surf2, Istf=None, Igap=None, Irem_i2=None, Idel=None, Iedge=None, Gap_scale=None,
               mesh=None, Gap_max_s=None, Gap_max_m=None, Stmin=None, Stmax=None, Igap0=None, Ishape=None, Edge_angle=None,
               Stfac=None, Fric=None, ibc="000", Inacti=None, VISs=None):
        self.block("/INTER/TYPE25/%d" % iid, title,
                   cells((1, 10, "surf_ID1", surf1), (11, 20, "surf_ID2", surf2), (21, 30, "Istf", Istf), (41, 50, "Igap", Igap),
                         (51, 60, "Irem_i2", Irem_i2), (71, 80, "Idel", Idel), (81, 90, "Iedge", Iedge)),
                   cells((1, 10, "grnd_IDs", 0), (21, 40, "Gap_scale", Gap_scale), (41, 60, "%mesh_size", mesh),
                         (61, 80, "Gap_max_s", Gap_max_s), (81, 100, "Gap_max_m", Gap_max_m)),
                   cells(*reals(1, ("Stmin", Stmin), ("Stmax", Stmax)), (41, 50, "Igap0", Igap0), (51, 60, "Ishape", Ishape),
                         (61, 80, "Edge_angle", Edge_angle)),
                   cells(*reals(1, ("Stfac", Stfac), ("Fric", Fric))),
                   cells((8, 10, "IBC", ibc), (31, 40, "Inacti", Inacti), (41, 60, "VISs", VISs)),
                   cells((1, 10, "Ifric", 0), (11, 20, "Ifiltr", 0), (21, 40, "Xfreq", 0.0)))

    def end(self):
        self.raw("/END\n")
        return {self.name + "_0000.rad": self.text}


def plate(n0, e0, nx, ny, dx, dy, place):
    """Nodes and quads of an nx by ny plate; place(u, v) gives the point."""
    nodes = [(n0 + j * (nx + 1) + i, place(i * dx, j * dy)) for j in range(ny + 1) for i in range(nx + 1)]
    quads = []
    for j in range(ny):
        for i in range(nx):
            a = n0 + j * (nx + 1) + i
            quads.append((e0 + j * nx + i, a, a + 1, a + nx + 2, a + nx + 1))
    return nodes, quads


def two_plates(deck, distance, thick=(1.5, 1.0), lower=(2, 2), upper=(2, 2), node_group=True):
    """Part 1: a plate at z = 0. Part 2: a smaller plate above it. Surface 1 and a group or surface 2."""
    deck.elastic(1, "steel")
    deck.shell_prop(1, "lower sheet", thick[0])
    deck.shell_prop(2, "upper sheet", thick[1])
    deck.part(1, "lower plate", 1, 1)
    deck.part(2, "upper plate", 2, 1)
    low, lowq = plate(1, 1, *lower, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    up, upq = plate(101, 101, *upper, 8.0, 8.0, lambda u, v: (u + 2.0, v + 2.0, distance))
    deck.nodes(low + up)
    deck.elements("SHELL", 1, lowq)
    deck.elements("SHELL", 2, upq)
    deck.ids("/SURF/PART/1", "lower plate", [1])
    if not node_group:
        deck.ids("/SURF/PART/2", "upper plate", [2])
    else:
        deck.ids("/GRNOD/PART/2", "nodes of the upper plate", [2])


def clean_plates():
    d = Deck("clean_plates", "two plates, nothing to report")
    d.note("""The upper plate hangs 2 mm above the lower one and the contact gap is 1.25 mm = (1.5 + 1.0) / 2.
              Nothing touches, every flag says what it means, lint has nothing to say.""")
    two_plates(d, 2.0)
    d.type7(1, "upper on lower", 2, 1, Istf=4, Igap=1000, Idel=2, Stmin=1.0, Stmax=1e3, Irem_gap=1, Irem_i2=3,
            Stfac=1.0, Fric=0.2, Gapmin=1.25, Inacti=1000, VISs=0.05, Bumult=0.2, Iform=2)
    return d.end()


def too_close():
    d = Deck("too_close", "two plates closer than the contact gap")
    d.note("""The plates are 0.9 mm apart, the gap is 1.25 mm: all nine upper nodes start 0.35 mm inside the gap.
              Inacti is 0, so the solver leaves them there and pushes with full force in the first cycle.""")
    two_plates(d, 0.9)
    d.type7(1, "upper on lower", 2, 1, Istf=4, Igap=1000, Idel=2, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.2,
            Gapmin=1.25, Inacti=0, VISs=0.05, Bumult=0.2, Iform=2)
    return d.end()


def inacti_variants():
    d = Deck("inacti_variants", "one penetration, seven ways to treat it")
    d.note("""Seven pairs of plates side by side, the same 0.4 mm penetration in each (gap 1.0, distance 0.6).
              The interfaces differ in Inacti only; the last one adds Fpenmax.""")
    d.elastic(1, "steel")
    d.shell_prop(1, "sheet", 1.0)
    cases = [(0, None), (1, None), (2, None), (3, None), (5, None), (6, None), (6, 0.3)]
    nodes, elements = [], []
    for k in range(len(cases)):
        x0 = 40.0 * k
        low, lq = plate(1000 * k + 1001, 1000 * k + 1, 2, 2, 10.0, 10.0, lambda u, v: (x0 + u, v, 0.0))
        up, uq = plate(1000 * k + 1101, 1000 * k + 101, 1, 1, 10.0, 10.0, lambda u, v: (x0 + u + 5.0, v + 5.0, 0.6))
        nodes += low + up
        elements.append((lq, uq))
    for k, (inacti, _) in enumerate(cases):
        d.part(10 * k + 1, "lower %d" % (k + 1), 1, 1)
        d.part(10 * k + 2, "upper %d" % (k + 1), 1, 1)
    d.nodes(nodes)
    for k, (lq, uq) in enumerate(elements):
        d.elements("SHELL", 10 * k + 1, lq)
        d.elements("SHELL", 10 * k + 2, uq)
    for k, (inacti, fpen) in enumerate(cases):
        d.ids("/SURF/PART/%d" % (10 * k + 1), "lower %d" % (k + 1), [10 * k + 1])
        d.ids("/GRNOD/PART/%d" % (10 * k + 2), "upper %d" % (k + 1), [10 * k + 2])
    for k, (inacti, fpen) in enumerate(cases):
        d.type7(k + 1, "Inacti %d" % inacti + (", Fpenmax %g" % fpen if fpen else ""), 10 * k + 2, 10 * k + 1,
                Istf=4, Igap=1000, Fpenmax=fpen, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.0, Gapmin=1.0,
                Inacti=inacti, VISs=0.05, Bumult=0.2, Iform=1)
    return d.end()


def crossing_edges():
    d = Deck("crossing_edges", "edges that cross, which no node-to-segment contact sees")
    d.note("""The lower edge of an upright plate crosses the two free edges of a flat strip, 0.7 mm above it,
              between the nodes: 0.3 mm inside the gap of 1.0. A rod crosses them 1.2 mm below, 0.4 mm inside its gap
              of 1.6. No node is near a segment: interface 2 (TYPE7) finds nothing, interface 1 (TYPE11) does.""")
    d.elastic(1, "steel")
    d.shell_prop(1, "flat sheet", 1.2)
    d.shell_prop(2, "upright sheet", 0.8)
    d.block("/PROP/BEAM/3", "rod", cells((11, 20, "Ismstr", 0)), cells(*reals(1, ("dm", 0.0), ("df", 0.0))),
            cells(*reals(1, ("Area", 4.0), ("Iyy", 1.333), ("Izz", 1.333), ("Ixx", 2.25))),
            cells((4, 6, "wDOF1", "000"), (8, 10, "w2", "000")))
    d.part(1, "flat plate", 1, 1)
    d.part(2, "upright plate", 2, 1)
    d.part(3, "rod", 3, 1)
    flat, fq = plate(1, 1, 1, 2, 10.0, 20.0, lambda u, v: (10.0 + u, v, 0.0))
    up, uq = plate(101, 101, 1, 1, 30.0, 20.0, lambda u, v: (30.0 - u, 9.0, 0.7 + v))
    rod = [(201, (-2.0, 31.0, -1.2)), (202, (32.0, 29.0, -1.2)), (203, (15.0, 30.0, -50.0))]
    d.nodes(flat + up + rod)
    d.elements("SHELL", 1, fq)
    d.elements("SHELL", 2, uq)
    d.elements("BEAM", 3, [(301, 201, 202, 203)])
    d.ids("/SURF/PART/1", "flat plate", [1])
    d.ids("/SURF/PART/2", "upright plate", [2])
    d.ids("/LINE/EDGE/1", "free edges of the flat plate", [1])
    d.ids("/LINE/EDGE/2", "free edges of the upright plate", [2])
    d.ids("/LINE/PART/3", "rod", [3])
    d.ids("/LINE/LINE/4", "upright plate and rod", [2, 3])
    d.type11(1, "edges against edges", 4, 1, Istf=5, Igap=1, Irem_gap=1, Stfac=1.0, Fric=0.1, Gapmin=0.1,
             Inacti=5, VISs=0.05, Bumult=0.2, Iform=2)
    d.ids("/GRNOD/PART/2", "upright plate and rod", [2, 3])
    d.type7(2, "nodes on the flat strip", 2, 1, Istf=4, Igap=1, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.1, Gapmin=0.1,
            Inacti=5, VISs=0.05, Bumult=0.2, Iform=2)
    return d.end()


def two_surfaces():
    d = Deck("two_surfaces", "TYPE19: two surfaces, three contacts")
    d.note("""One TYPE19 card stands for a TYPE7 with the upper nodes, a TYPE7 with the lower nodes and a TYPE11
              with the edges of both. The plates overlap by 0.3 mm, so all three find something.""")
    two_plates(d, 0.95, lower=(4, 3), upper=(3, 3), node_group=False)
    d.type19(1, "upper and lower", 2, 1, Istf=4, Igap=1, Idel=2, Stmin=1.0, Stmax=1e3, Irem_gap=1, Irem_i2=3,
             Stfac=1.0, Fric=0.1, Gapmin=0.5, Inacti=6, VISs=0.05, Bumult=0.2, Iform=2)
    return d.end()


def tied_layer():
    d = Deck("tied_layer", "TYPE10: a layer of adhesive")
    d.note("""A strip tied to a panel by TYPE10. Interface 1 states its gap. Interface 2 leaves it blank: the solver
              takes the mean main thickness (1.75 mm here), not the smallest one as manuals say.""")
    d.elastic(1, "steel")
    for pid, t in ((1, 1.0), (2, 2.5), (3, 0.8)):
        d.shell_prop(pid, "sheet %g" % t, t)
    d.part(1, "panel, thin half", 1, 1)
    d.part(2, "panel, thick half", 2, 1)
    d.part(3, "strip", 3, 1)
    panel, q = plate(1, 1, 4, 2, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    strip, s = plate(101, 101, 3, 1, 10.0, 6.0, lambda u, v: (u + 4.0, v + 7.0, 0.9))
    d.nodes(panel + strip)
    d.elements("SHELL", 1, [e for i, e in enumerate(q) if i % 4 < 2])
    d.elements("SHELL", 2, [e for i, e in enumerate(q) if i % 4 >= 2])
    d.elements("SHELL", 3, s)
    d.ids("/SURF/PART/1", "panel", [1, 2])
    d.ids("/GRNOD/PART/1", "strip", [3])
    d.type10(1, "tied for good, gap given", 1, 1, Idel=2, Stfac=0.2, Gap=1.5, ITIED=1, VISs=0.05, Bumult=0.2)
    d.type10(2, "rebound allowed, gap by default", 1, 1, Idel=2, Stfac=0.2, ITIED=0, VISs=0.05, Bumult=0.2)
    return d.end()


def welds():
    d = Deck("welds", "TYPE2: a tie for every way to lose a node")
    d.note("""Brackets, studs and a block on one panel. Interface 1 holds. Interface 2 loses two nodes that are raised and two
              beyond the rim (1157). Interface 3 has no dsearch and Ignore 3: it looks no farther than the sheets are thick (1071).
              Interface 4 drops a stud although Ignore is 1000 (1158). Interface 6 repeats ties of interface 5 (1630).
              Interface 7 ties one node from beyond the rim (1079) and one from 7 mm away in line with a mesh line, without
              a word. Interface 8 leaves out condensed mid nodes (1209). Interface 9 has a node too far with Ignore 1000:
              the solver stops (1078).""")
    d.elastic(1, "steel")
    d.shell_prop(1, "panel", 1.6)
    d.shell_prop(2, "bracket", 1.0)
    d.block("/PROP/SOLID/3", "block",
            cells((1, 10, "Isolid", 0), (41, 50, "Itetra10", 2)), cells((1, 20, "qa", 0.0)), cells((1, 20, "dt_min", 0.0)))
    for pid, name, prop in ((1, "panel", 1), (2, "bracket that holds", 2), (3, "bracket that loses nodes", 2), (4, "clip", 2), (5, "block", 3)):
        d.part(pid, name, prop, 1)
    panel, p = plate(1, 1, 6, 4, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    good, g = plate(101, 101, 2, 1, 8.0, 6.0, lambda u, v: (u + 3.0, v + 2.0, 1.3))
    poor, q = plate(201, 201, 4, 1, 10.0, 6.0, lambda u, v: (u + 27.0, v + 2.0, 3.2 if u == 20.0 else 1.3))
    clip, c = plate(301, 301, 1, 1, 6.0, 6.0, lambda u, v: (u + 3.0, v + 22.0, 1.3 + 0.2 * u))
    corners = [(20.0, 22.0, 1.0), (24.0, 22.0, 1.0), (20.0, 26.0, 1.0), (20.0, 22.0, 5.0)]
    middle = [tuple(0.5 * (a + b) for a, b in zip(corners[i], corners[j])) for i, j in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
    block = [(401 + i, x) for i, x in enumerate(corners + middle)]
    studs = [(501, (72.0, 25.0, 1.0)), (502, (61.0, 25.0, 1.0)), (503, (50.0, 47.0, 0.5)), (504, (35.0, 35.0, 6.0))]
    d.nodes(panel + good + poor + clip + block + studs)
    for pid, quads in ((1, p), (2, g), (3, q), (4, c)):
        d.elements("SHELL", pid, quads)
    d.raw("/TETRA10/5\n       401\n" + "".join("%10d" % n for n, _ in block) + "\n")
    d.ids("/SURF/PART/1", "panel", [1])
    for pid, name in ((2, "bracket that holds"), (3, "bracket that loses nodes"), (4, "clip")):
        d.ids("/GRNOD/PART/%d" % pid, name, [pid])
    d.ids("/GRNOD/NODE/5", "foot of the block", [401, 402, 403, 405, 406, 407])
    d.ids("/GRNOD/NODE/6", "stud beside the panel", [501])
    d.ids("/GRNOD/NODE/7", "studs at the rim", [502, 503])
    d.ids("/GRNOD/NODE/8", "stud above the panel", [504])
    d.type2(1, "holds", 2, 1, Ignore=1, Spotflag=5, dsearch=2.0)
    d.type2(2, "raised or beyond the rim", 3, 1, Ignore=1, Spotflag=5, dsearch=2.0)
    d.type2(3, "no farther than the sheets are thick", 4, 1, Ignore=3, Spotflag=5)
    d.type2(4, "dropped in spite of Ignore", 6, 1, Ignore=1000, Spotflag=28, dsearch=30.0)
    d.type2(5, "first", 2, 1, Ignore=1, Spotflag=27, dsearch=2.0)
    d.type2(6, "the same again", 2, 1, Ignore=1, Spotflag=27, dsearch=2.0)
    d.type2(7, "tied from afar", 7, 1, Ignore=1, Spotflag=5)
    d.type2(8, "mid nodes", 5, 1, Ignore=1, Spotflag=5, dsearch=2.0)
    d.type2(9, "too far", 8, 1, Ignore=1000, Spotflag=5, dsearch=4.0)
    return d.end()


def variable_gap():
    d = Deck("variable_gap", "variable gaps and /DEFAULT/INTER")
    d.note("""A folded strip in self contact. /DEFAULT/INTER/TYPE7 sets Istf 4, Igap 3 and Inacti 6, so a 0 on a card
              is not nothing. Its blank lines count: without them the solver reads none of the values.
              Interface 1 inherits all three. Interface 2 says Igap 2 itself and scales the gap. Interface 3 writes
              1000 where it really means: no.""")
    d.elastic(1, "steel")
    d.shell_prop(1, "sheet", 1.6)
    d.shell_prop(2, "doubler", 2.4)
    d.part(1, "fold", 1, 1)
    d.part(2, "doubler", 2, 1, thick=2.0)
    path = [(0.0, 0.0), (6.0, 0.0), (12.0, 0.0), (18.0, 0.0), (20.5, 1.2), (21.0, 1.9), (18.2, 2.4), (12.0, 2.4), (6.0, 2.0), (0.0, 1.5)]
    nodes, quads = [], []
    for i, (x, z) in enumerate(path):
        for j in range(4):
            nodes.append((10 * i + j + 1, (x, 5.0 * j, z)))
    for i in range(len(path) - 1):
        for j in range(3):
            a = 10 * i + j + 1
            quads.append((10 * i + j + 1, a, a + 10, a + 11, a + 1))
    d.nodes(nodes + [(201, (2.0, 1.0, -2.1)), (202, (9.0, 1.0, -2.1)), (203, (9.0, 9.0, -2.1)), (204, (2.0, 9.0, -2.1))])
    d.elements("SHELL", 1, quads)
    d.elements("SHELL", 2, [(201, 201, 202, 203, 204)])
    d.ids("/SURF/PART/1", "fold", [1])
    d.ids("/GRNOD/PART/1", "fold", [1])
    d.ids("/GRNOD/PART/2", "doubler", [2])
    blank = "# blank line\n\n"
    d.raw("/DEFAULT/INTER/TYPE7\n" + blank)
    d.raw(cells((21, 30, "Istf", 4), (41, 50, "Igap", 3), (61, 70, "Ibag", 0), (71, 80, "Idel", 2)) + blank)
    d.raw(cells((81, 90, "Irem_gap", 2), (91, 100, "Irem_i2", 0)) + blank)
    d.raw(cells((31, 40, "Inacti", 6)))
    d.raw(cells((41, 50, "Iform", 2)))
    d.type7(1, "self contact, all from /DEFAULT", 1, 1, Istf=0, Igap=0, Idel=0, mesh=0.4, Irem_gap=0, Irem_i2=0,
            Stfac=1.0, Fric=0.1, Gapmin=0.1, Inacti=0, Iform=0)
    d.type7(2, "doubler, gap scaled by 0.8", 2, 1, Igap=2, Fscalegap=0.8, Gapmax=1.5, Stfac=1.0, Fric=0.1,
            Gapmin=0.1)
    d.type7(3, "doubler, explicitly constant gap, no action", 2, 1, Istf=1000, Igap=1000, Irem_gap=1, Stfac=1.0,
            Fric=0.1, Gapmin=1.2, Inacti=1000)
    return d.end()


def include_tree():
    d = Deck("include_tree", "one deck in three files")
    d.note("""The mesh lies in include_tree/mesh.inc, which includes include_tree/sheets.inc (relative to itself).
              Findings are reported in the file where they are.""")
    d.raw("#include include_tree/mesh.inc\n")
    d.ids("/SURF/PART/1", "lower plate", [1])
    d.ids("/GRNOD/PART/2", "nodes of the upper plate", [2])
    d.type7(1, "upper on lower", 2, 1, Istf=4, Igap=1, Idel=2, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.2, Gapmin=0.5,
            Inacti=5, VISs=0.05, Bumult=0.2, Iform=2)
    out = d.end()
    sheets = Deck("x", "x")
    sheets.text = ""
    sheets.elastic(1, "steel")
    sheets.shell_prop(1, "sheet", 1.2)
    mesh = Deck("x", "x")
    mesh.text = "# mesh of include_tree_0000.rad\n#include sheets.inc\n"
    mesh.part(1, "lower plate", 1, 1)
    mesh.part(2, "upper plate", 1, 1)
    low, lq = plate(1, 1, 2, 2, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    up, uq = plate(101, 101, 2, 2, 8.0, 8.0, lambda u, v: (u + 2.0, v + 2.0, 1.0 + 0.05 * u))
    mesh.nodes(low + up)
    mesh.elements("SHELL", 1, lq)
    mesh.elements("SHELL", 2, uq)
    out["include_tree/mesh.inc"] = mesh.text
    out["include_tree/sheets.inc"] = "# materials and properties\n" + sheets.text
    return out


def units_and_parameters():
    d = Deck("units_and_parameters", "input in kg, m, s; working units kg, mm, ms", version=2024,
             units=("kg", "m", "s"), work=("kg", "mm", "ms"))
    d.note("""Lengths are typed in metres and used in millimetres. Two numbers are parameters: the gap &gap and the group
              &upper. The second block of the mesh lies in a submodel whose ids are shifted by 1000, and the gap of
              interface 2 is typed in its own unit system (unit id 7: inches).""")
    d.raw("/PARAMETER/GLOBAL/REAL/1\ncontact gap in metres\n#    Name               Value\ngap" + "1.2E-3".rjust(27) + "\n")
    d.raw("/PARAMETER/GLOBAL/REAL_EXPR/2\nhalf of it\n#    Name  Expression\nhalf      &gap/2\n")
    d.raw("/PARAMETER/GLOBAL/INTEGER/3\ngroup of the upper plate\n#    Name     Value\nupper" + "1002".rjust(15) + "\n")
    d.raw("/UNIT/7\ninches\n#               MASS              LENGTH                TIME\n")
    d.raw("%20s%20s%20s\n" % ("kg", "0.0254", "s"))
    d.elastic(1, "steel", 7850.0, 2.1e11)
    d.shell_prop(1, "sheet", 0.0012)
    d.part(1, "lower plate", 1, 1)
    low, lq = plate(1, 1, 2, 2, 0.01, 0.01, lambda u, v: (u, v, 0.0))
    d.nodes(low)
    d.elements("SHELL", 1, lq)
    d.ids("/SURF/PART/1", "lower plate", [1])
    d.raw("//SUBMODEL/1\nupper plate, ids shifted by 1000\n")
    d.raw(cells(*ints(1, ("off_def", 1000), ("off_nod", 1000), ("off_ele", 1000), ("off_part", 1000), ("off_mat", 1000),
                      ("off_type", 1000), ("off_sub", 1000))))
    d.elastic(1, "steel of the submodel", 7850.0, 2.1e11)
    d.shell_prop(1, "sheet of the submodel", 0.001)
    d.part(2, "upper plate", 1, 1)
    up, uq = plate(101, 101, 2, 2, 0.008, 0.008, lambda u, v: (u + 0.002, v + 0.002, 0.001))
    d.nodes(up)
    d.elements("SHELL", 2, uq)
    d.ids("/GRNOD/PART/2", "nodes of the upper plate", [2])
    d.raw("//ENDSUB\n")
    common = dict(Istf=4, Igap=1000, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.1, Inacti=6, VISs=0.05, Bumult=0.2, Iform=2)
    d.type7(1, "gap from a parameter", "&upper", 1, Gapmin="&gap", **common)
    d.type7(2, "gap typed in inches", 1002, 1, Gapmin=0.05, unit=7, **common)
    d.type7(3, "half the gap, by expression", 1002, 1, Gapmin="&half", **common)
    return d.end()


def solid_and_skin():
    d = Deck("solid_and_skin", "solids, and shells on their skin")
    d.note("""A block of eight bricks with shells on a quarter of its top, a tetrahedron above it.
              Surface 1 is the outside of the bricks as a group of solids (no thickness, solid stiffness). The solver loses the
              face under the shell there, and with it the contact: the tip of the tetrahedron, 0.45 mm above that face, is inside
              the default gap of interface 1 (a tenth of the shortest side: 0.5 mm), and no penetration is found (DK063).
              Surface 2 names the parts of the bricks and of the skin; there the shell replaces the brick face.""")
    d.elastic(1, "steel")
    d.elastic(2, "rubber", 1.1e-6, 0.005, 0.45)
    d.solid_prop(1, "solid")
    d.shell_prop(2, "skin", 0.2)
    d.part(1, "block", 1, 1)
    d.part(2, "skin", 2, 1)
    d.part(3, "foot", 1, 2)

    def nid(i, j, k):
        return 1 + i + 3 * j + 9 * k
    nodes = [(nid(i, j, k), (5.0 * i, 5.0 * j, 5.0 * k)) for k in range(3) for j in range(3) for i in range(3)]
    bricks = []
    for k in range(2):
        for j in range(2):
            for i in range(2):
                bottom = [nid(i, j, k), nid(i + 1, j, k), nid(i + 1, j + 1, k), nid(i, j + 1, k)]
                bricks.append((1 + i + 2 * j + 4 * k, *bottom, *[n + 9 for n in bottom]))
    foot = [(101, (6.5, 6.2, 10.45)), (102, (9.0, 4.0, 16.0)), (103, (8.0, 9.5, 16.0)), (104, (3.5, 6.0, 16.0))]
    d.nodes(nodes + foot)
    d.elements("BRICK", 1, bricks)
    d.elements("SHELL", 2, [(101, nid(1, 1, 2), nid(2, 1, 2), nid(2, 2, 2), nid(1, 2, 2))])
    d.elements("TETRA4", 3, [(201, 101, 103, 102, 104)])
    d.ids("/GRBRIC/PART/1", "bricks", [1])
    d.ids("/SURF/GRBRIC/EXT/1", "outside of the bricks", [1])
    d.ids("/SURF/PART/EXT/2", "outside of the bricks and skin", [1, 2])
    d.ids("/GRNOD/PART/3", "foot", [3])
    d.type7(1, "foot on the bricks", 3, 1, Istf=5, Igap=1000, Stfac=1.0, Inacti=1000, VISs=0.05, Bumult=0.2, Iform=1)
    d.type7(2, "foot on bricks and skin", 3, 2, Istf=5, Igap=1, Stfac=1.0, Gapmin=0.05, Inacti=6, VISs=0.05, Bumult=0.2, Iform=1)
    return d.end()


def airbag_fold():
    d = Deck("airbag_fold", "TYPE25: a folded sheet on itself, and a tether on its border")
    d.note("""A sheet 0.5 mm thick is folded over: its two layers lie 0.35 mm apart, so both start 0.15 mm inside the gap. A tether
              stands on the upper layer: the free edge of its shells crosses the free border of the sheet 0.4 mm above it, and the
              gap of the two is 0.45. Interface 1 takes everything (edges as well) and stores offsets. Interface 2 has Igap 2: what
              lies near along the mesh, at the bend, is left out. Interface 3 has Inacti -1: the layers push from the start.""")
    d.elastic(1, "fabric", 8.5e-7, 0.3, 0.3)
    d.shell_prop(1, "sheet", 0.5)
    d.shell_prop(2, "tether", 0.4)
    d.part(1, "sheet", 1, 1)
    d.part(2, "tether", 2, 1)
    path = [(6.0 * i, 0.0) for i in range(6)] + [(33.0, 0.175)] + [(30.0 - 6.0 * i, 0.35) for i in range(6)]
    nodes, quads = plate(101, 101, 12, 4, 1.0, 6.0, lambda u, v: (path[round(u)][0], v, path[round(u)][1]))
    strip, walls = plate(1, 1, 2, 1, 6.0, 6.0, lambda u, v: (15.0, 20.0 + u, 0.75 + v))
    d.nodes(strip + nodes)
    d.elements("SHELL", 1, quads)
    d.elements("SHELL", 2, walls)
    d.ids("/SURF/PART/1", "sheet and tether", [1, 2])
    d.ids("/SURF/PART/2", "sheet", [1])
    d.type25(1, "everything, stored as offset", 1, 0, Igap=1, Iedge=1, Inacti=5, Edge_angle=135.0, Stfac=1.0, Fric=0.2)
    d.type25(2, "near along the mesh left out", 2, 0, Igap=2, Inacti=5, Stfac=1.0, Fric=0.2)
    d.type25(3, "force from the start", 2, 0, Igap=2, Inacti=-1, Stfac=1.0, Fric=0.2)
    return d.end()


def coated_block():
    d = Deck("coated_block", "TYPE25 and TYPE24: a coated block under a plate")
    d.note("""A block of eight bricks with coating shells 0.5 mm thick on its top, and a plate 1 mm thick 0.6 mm above it. The coating
              gives the block a gap: 0.25 and 0.5 make 0.75, so both start 0.15 mm inside. Interface 1 is a TYPE25 that stores
              offsets, interface 2 the same with caps of the gaps (Gap_max_s, Gap_max_m 0.25): nothing is inside. Interface 3 is a
              TYPE24 between the same surfaces.""")
    d.elastic(1, "steel")
    d.elastic(2, "rubber", 1.1e-6, 0.005, 0.45)
    d.solid_prop(1, "solid")
    d.shell_prop(2, "coating", 0.5)
    d.shell_prop(3, "plate", 1.0)
    d.part(1, "block", 1, 2)
    d.part(2, "coating", 2, 2)
    d.part(3, "plate", 3, 1)

    def nid(i, j, k):
        return 1 + i + 3 * j + 9 * k
    nodes = [(nid(i, j, k), (5.0 * i, 5.0 * j, 5.0 * k)) for k in range(3) for j in range(3) for i in range(3)]
    bricks, coats = [], []
    for k in range(2):
        for j in range(2):
            for i in range(2):
                bottom = [nid(i, j, k), nid(i + 1, j, k), nid(i + 1, j + 1, k), nid(i, j + 1, k)]
                bricks.append((1 + i + 2 * j + 4 * k, *bottom, *[n + 9 for n in bottom]))
                if k == 1:
                    coats.append((101 + i + 2 * j, *[n + 9 for n in bottom]))
    top, quads = plate(201, 201, 4, 4, 4.0, 4.0, lambda u, v: (u - 3.0, v - 3.0, 10.6))
    d.nodes(nodes + top)
    d.elements("BRICK", 1, bricks)
    d.elements("SHELL", 2, coats)
    d.elements("SHELL", 3, quads)
    d.ids("/SURF/PART/EXT/1", "block with its coating", [1, 2])
    d.ids("/SURF/PART/2", "plate", [3])
    d.type25(1, "block and plate", 1, 2, Igap=1, Inacti=5, Stfac=1.0)
    d.type25(2, "the same with capped gaps", 1, 2, Igap=1, Gap_max_s=0.25, Gap_max_m=0.25, Inacti=5, Stfac=1.0)
    d.type24(3, "the same as TYPE24", 1, 2, Inacti=5, Stfac=1.0)
    return d.end()


def hot_contact():
    d = Deck("hot_contact", "heat across a contact", units=("Mg", "mm", "s"))
    d.note("""Interface 1: conduction and radiation between two plates, 20 and 300 degrees, thermal materials on both.
              The two extra lines exist because Ithe = 1. Half of the frictional heat goes to each side.""")
    d.elastic(1, "steel", 7.85e-9, 210000.0)
    d.raw("/HEAT/MAT/1\n" + cells(*reals(1, ("T0", 293.15), ("RHO0_CP", 3.6), ("AS", 50.0), ("BS", 0.0)), (81, 90, "Iform", 1)))
    d.raw(cells(*reals(1, ("T1", 0.0), ("AL", 0.0), ("BL", 0.0))))
    d.elastic(2, "hot steel", 7.85e-9, 190000.0)
    d.raw("/HEAT/MAT/2\n" + cells(*reals(1, ("T0", 573.15), ("RHO0_CP", 3.6), ("AS", 45.0), ("BS", 0.0)), (81, 90, "Iform", 1)))
    d.raw(cells(*reals(1, ("T1", 0.0), ("AL", 0.0), ("BL", 0.0))))
    d.shell_prop(1, "sheet", 1.5)
    d.part(1, "cold plate", 1, 1)
    d.part(2, "hot plate", 1, 2)
    low, lq = plate(1, 1, 3, 3, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    up, uq = plate(101, 101, 2, 2, 10.0, 10.0, lambda u, v: (u + 5.0, v + 5.0, 1.45))
    d.nodes(low + up)
    d.elements("SHELL", 1, lq)
    d.elements("SHELL", 2, uq)
    d.ids("/SURF/PART/1", "cold plate", [1])
    d.ids("/GRNOD/PART/2", "hot plate", [2])
    d.type7(1, "hot on cold", 2, 1, Istf=4, Ithe=1, Igap=1000, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.1, Gapmin=1.5,
            Inacti=6, VISs=0.05, Bumult=0.2, Iform=2,
            thermal=(0.5, None, None, 1, None, 5.67e-11, 3.0, 0.5, 0.5))
    return d.end()


def sets_and_friction():
    d = Deck("sets_and_friction", "sets as contact sides, friction by part pairs", version=2024)
    d.note("""The sides of the interfaces are sets: set 11 deletes an element from a part, set 12 picks a range of
              shells. The friction of part 1 against part 3 differs from the rest.""")
    d.elastic(1, "steel")
    d.shell_prop(1, "sheet", 1.0)
    for pid, name in ((1, "panel left"), (2, "panel right"), (3, "slider")):
        d.part(pid, name, 1, 1)
    a, aq = plate(1, 1, 3, 3, 10.0, 10.0, lambda u, v: (u, v, 0.0))
    b, bq = plate(101, 101, 3, 3, 10.0, 10.0, lambda u, v: (u + 30.0, v, 0.0))
    s, sq = plate(201, 201, 4, 1, 10.0, 8.0, lambda u, v: (u + 8.0, v + 12.0, 1.2))
    d.nodes(a + b + s)
    d.elements("SHELL", 1, aq)
    d.elements("SHELL", 2, bq)
    d.elements("SHELL", 3, sq)
    d.raw("/SET/GENERAL/11\nboth panels without one corner\nPART               1         2\nSHELL_D            1\n")
    d.raw("/SET/GENERAL/12\nslider\nSHELL_G          201       204         1\n")
    d.block("/FRICTION/5", "steel on steel",
            cells((1, 10, "Ifric", 0), (11, 20, "Ifiltr", 0), (21, 40, "Xfreq", 0.0), (41, 50, "Iform", 2)),
            cells(*reals(1, *[("C%d" % i, 0.0) for i in range(1, 6)])),
            cells(*reals(1, ("C6", 0.0), ("Fric", 0.15), ("VISF", 1.0))),
            cells((1, 10, "grpart_ID1", 0), (11, 20, "grpart_ID2", 0), (21, 30, "part_ID1", 1), (31, 40, "part_ID2", 3), (51, 60, "Idir", 0)),
            cells(*reals(1, *[("C%d" % i, 0.0) for i in range(1, 6)])),
            cells(*reals(1, ("C6", 0.0), ("Fric", 0.3), ("VISF", 1.0))))
    d.type19(1, "slider on panels", 12, 11, Istf=4, Igap=1, Irem_gap=1, Irem_i2=3, Stfac=1.0, Gapmin=0.5,
             Inacti=6, VISs=0.05, Bumult=0.2, fric=5)
    return d.end()


def crash_box():
    d = Deck("crash_box", "a crash box against a barrier, with mistakes in its geometry")
    d.note("""A beaded tube with an inner web, on a base plate, 0.8 mm in front of a slightly bulged barrier.
              Built to show something: the rim stands up to 1.0 mm inside the gap of the barrier, the web is
              3 mm from the walls but the inward beads reach it (four web nodes lie exactly on the wall), and
              the tube is tied to its base.""")
    d.elastic(1, "steel")
    for pid, name, t in ((1, "tube 2.0", 2.0), (2, "web 1.2", 1.2), (3, "barrier 3.0", 3.0), (4, "base 4.0", 4.0)):
        d.shell_prop(pid, name, t)
    for pid, name in ((1, "tube"), (2, "web"), (3, "barrier"), (4, "base plate")):
        d.part(pid, name, pid, 1)
    rings, around, length, half, radius = 20, 28, 160.0, 40.0, 10.0
    flat = 2 * (half - radius)
    perimeter = 4 * flat + 2 * math.pi * radius

    def wall(s, bead):
        """Point of the rounded square at arc length s, moved outwards by bead."""
        quarter = perimeter / 4
        side, rest = int(s // quarter) % 4, s % quarter
        if rest <= flat:
            p, n = (half, rest - flat / 2), (1.0, 0.0)
        else:
            a = (rest - flat) / radius
            n = (math.cos(a), math.sin(a))
            p = (flat / 2 + radius * n[0], flat / 2 + radius * n[1])
        for _ in range(side):
            p, n = (-p[1], p[0]), (-n[1], n[0])
        return p[0] + bead * n[0], p[1] + bead * n[1]

    nodes, tube = [], []
    for k in range(rings + 1):
        z = length * k / rings
        for i in range(around):
            s = perimeter * i / around
            bead = 0.0
            for centre, sign in ((120.0, -1.0), (96.0, 1.0), (72.0, -1.0)):
                if abs(z - centre) < 12.0:
                    turn = 1.0 if (i // 7) % 2 == 0 else -1.0
                    bead += sign * turn * 3.0 * math.cos(math.pi * (z - centre) / 24.0) ** 2
            x, y = wall(s, bead)
            nodes.append((1 + 100 * k + i, (round(x, 6), round(y, 6), round(z, 6))))
    for k in range(rings):
        for i in range(around):
            a, b = 1 + 100 * k + i, 1 + 100 * k + (i + 1) % around
            tube.append((1 + 100 * k + i, a, b, b + 100, a + 100))
    web, webq = plate(10001, 10001, 8, 16, 0.0, 9.5, lambda u, v: (0.0, 0.0, 0.0))
    web = [(n, (-37.0 + 9.25 * ((n - 10001) % 9), 4.0, round(4.8 + 9.6 * ((n - 10001) // 9), 6))) for n, _ in web]
    barrier, barq = plate(20001, 20001, 10, 10, 14.0, 14.0, lambda u, v: (
        u - 70.0, v - 70.0, round(length + 0.8 + 2.0 * ((u - 70.0) ** 2 + (v - 70.0) ** 2) / 70.0 ** 2, 6)))
    base, baseq = plate(30001, 30001, 6, 6, 20.0, 20.0, lambda u, v: (u - 60.0, v - 60.0, -2.4))
    d.nodes(nodes + web + barrier + base)
    d.elements("SHELL", 1, tube)
    d.elements("SHELL", 2, webq)
    d.elements("SHELL", 3, barq)
    d.elements("SHELL", 4, baseq)
    for pid, name in ((1, "tube"), (2, "web"), (3, "barrier"), (4, "base plate")):
        d.ids("/SURF/PART/%d" % pid, name, [pid])
        d.ids("/GRNOD/PART/%d" % pid, name, [pid])
    d.ids("/GRNOD/GENE/11", "rear rim of the tube", [1, around])
    d.type7(1, "tube rim on barrier", 1, 3, Istf=4, Igap=1, Idel=2, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.2, Gapmin=0.5,
            Inacti=0, VISs=0.05, Bumult=0.2, Iform=2)
    d.type19(2, "web against tube", 2, 1, Istf=4, Igap=1, Idel=2, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.2, Gapmin=0.5,
             Inacti=6, VISs=0.05, Bumult=0.2, Iform=2)
    d.type7(3, "tube against itself", 1, 1, Istf=4, Igap=3, Idel=2, mesh=0.4, Irem_gap=2, Irem_i2=3, Stfac=1.0, Fric=0.2,
            Gapmin=0.5, Inacti=6, VISs=0.05, Bumult=0.2, Iform=2)
    d.type10(4, "tube on base plate", 11, 4, Idel=2, Stfac=0.2, Gap=3.0, ITIED=1, VISs=0.05, Bumult=0.2)
    return d.end()


def too_close_listing():
    """What a Starter says of too_close: its message, and the pairs as it lists them where /IOFLAG asks for them."""
    pairs = []  # a node above the middle is over the segments on both sides of it
    over = ((0,), (0, 1), (1,))
    for row in range(3):
        for column in range(3):
            for j in over[row]:
                for i in over[column]:
                    a = 1 + 3 * j + i
                    pairs.append((101 + 3 * row + column, a, a + 1, a + 4, a + 3))
    lines = ["* INPUT READING PROCESS", "    IPRI  : PRINTOUT FLAG . . . . . . . .         1", ""]
    for prop in (1, 2):
        lines += ["WARNING ID :   1084", "** WARNING: SHELLS OF AN ELASTIC MATERIAL ARE INTEGRATED GLOBALLY", "DESCRIPTION :  ",
                  "   -- PROPERTY ID: %d" % prop, ""]
    lines += [" INTERFACE NUMBER. . . . . . . . . . . . . .         1", " INTERFACE TYPE. . . . . . . . . . . . . . .     7", ""]
    lines += ["  POSSIBLE IMPACT NUMBER:%12d  (<=           2 *NSN)" % len(pairs), "", "    IMPACT CANDIDATES",
              "   SECONDARY        MAIN SEGMENT NODES", "   NODE"]
    lines += ["".join("%10d" % n for n in pair) for pair in pairs]
    lines += ["", "WARNING ID :    343", "** WARNING: INITIAL PENETRATIONS IN INTERFACE", "DESCRIPTION :  ",
              "   -- INTERFACE ID: 1", "   -- INTERFACE TYPE: upper on lower",
              "   THERE ARE %d INITIAL PENETRATIONS" % len(pairs), "   ( CONCERNING 9 NODES )", "", "",
              "              0 ERROR(S)", "              3 WARNING(S)", ""]
    return {"too_close_0000.out": "\n".join(lines)}


ALL = (clean_plates, too_close, inacti_variants, crossing_edges, two_surfaces, tied_layer, welds, variable_gap, include_tree,
       units_and_parameters, solid_and_skin, airbag_fold, coated_block, hot_contact, sets_and_friction, crash_box,
       too_close_listing)


def sheets(n, out, apart):
    """Two wavy sheets of n by n shells each, one above the other, with a gap of 1.0. 1.2 mm apart on average
    crests of the lower one reach into the gap, 0.5 mm apart nearly all upper nodes are in it. TYPE7, upper nodes on lower segments. About 122
    bytes a shell; written piece by piece, because a model may be larger than the memory."""
    d = Deck("sheets", "two wavy sheets of %d by %d shells" % (n, n))
    d.elastic(1, "steel")
    d.shell_prop(1, "sheet", 1.0)
    d.part(1, "lower sheet", 1, 1)
    d.part(2, "upper sheet", 1, 1)
    out.write(d.text)
    row, edge = n + 1, 5.0
    across = [math.sin(2 * math.pi * i / 40) for i in range(row)]
    other = [math.cos(2 * math.pi * i / 56) for i in range(row)]
    out.write("/NODE\n#  node_ID                   X                   Y                   Z\n")
    for sheet in range(2):
        wave, shift, low = (across, 0.0, 0.0) if sheet == 0 else (other, 0.37 * edge, apart)
        x = ["%20.6f" % (edge * i + shift) for i in range(row)]
        for j in range(row):
            first, y, t = 1 + (sheet * row + j) * row, "%20.6f" % (edge * j + shift), across[j]
            out.write("".join("%10d%s%s%20.9f\n" % (first + i, x[i], y, low + 0.25 * (wave[i] + t))
                              for i in range(row)))
    for sheet in range(2):
        out.write("/SHELL/%d\n# elem_ID     node1     node2     node3     node4\n" % (sheet + 1))
        for j in range(n):
            e, a = 1 + (sheet * n + j) * n, 1 + (sheet * row + j) * row
            out.write("".join("%10d%10d%10d%10d%10d\n" % (e + i, a + i, a + i + 1, a + i + row + 1, a + i + row)
                              for i in range(n)))
    d.text = ""
    d.ids("/SURF/PART/1", "lower sheet", [1])
    d.ids("/GRNOD/PART/2", "nodes of the upper sheet", [2])
    d.type7(1, "upper on lower", 2, 1, Istf=4, Igap=1, Idel=2, Irem_gap=1, Irem_i2=3, Stfac=1.0, Fric=0.2, Gapmin=1.0,
            Inacti=6, VISs=0.05, Bumult=0.2, Iform=2)
    out.write(d.end()[d.name + "_0000.rad"])


def main():
    parser = argparse.ArgumentParser(description="Writes the sample decks beside this script.")
    parser.add_argument("--check", action="store_true", help="write nothing; end with 1 where a file differs")
    parser.add_argument("--sheets", nargs=2, metavar=("N", "FILE"), help="two wavy sheets of N by N shells into FILE ('-': standard output) instead")
    parser.add_argument("--apart", type=float, default=1.2, metavar="MM", help="of these sheets, on average (default: 1.2)")
    options = parser.parse_args()
    if options.sheets:
        count, path = options.sheets
        if not count.isdigit() or int(count) < 1:
            parser.error("--sheets: N is the number of shells along each edge, not " + count)
        if path == "-":
            sheets(int(count), sys.stdout, options.apart)
            return 0
        with open(path, "w", newline="\n") as f:
            sheets(int(count), f, options.apart)
        return 0
    different = 0
    for build in ALL:
        for name, text in build().items():
            path = os.path.join(HERE, name)
            if options.check:
                same = os.path.exists(path) and open(path, newline="").read() == text
                different += not same
                if not same:
                    print("differs: " + name)
                continue
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", newline="\n") as f:
                f.write(text)
            print("wrote %s (%d lines)" % (name, text.count("\n")))
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
