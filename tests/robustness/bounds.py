#!/usr/bin/env python3
"""Whatever a stranger's deck asks for, the answer comes in seconds, within the memory there is, and
with an exit code from 0 to 4: sets of sets, gaps beyond the mesh, numbers without bounds, settings that
explode, and every verb under address spaces of many sizes."""
import os

from common import run_steps, write
from hostile import BEGIN

ORDERLY = (0, 1, 2, 3)


def node(k, x, y, z):
    return b"%10d%20s%20s%20s\n" % (k, *(str(v).encode() for v in (x, y, z)))


def sheet(first, n, size, z, part):
    """A sheet of n x n shells."""
    out = b"/NODE\n" + b"".join(node(first + i * (n + 1) + j, i * size, j * size, z)
                                for i in range(n + 1) for j in range(n + 1))
    corners = (first + i * (n + 1) + j for i in range(n) for j in range(n))
    return out + b"/SHELL/%d\n" % part + b"".join(b"%10d%10d%10d%10d%10d\n" % (a, a, a + 1, a + n + 2, a + n + 1) for a in corners)


PARTS = (b"/MAT/ELAST/1\nsteel\n             7.8E-06\n               210.0                 0.3\n"
         b"/PROP/SHELL/1\nplate\n         0         0\n\n         3                           1.0\n"
         b"/PART/1\nlower\n         1         1         0\n/PART/2\nupper\n         1         1         0\n"
         b"/SURF/PART/1\nlower\n         1\n/GRNOD/PART/2\nupper\n         2\n/SURF/PART/2\nboth\n         1         2\n")


def type7(number, secondary, main, gapmin, igap=0, icurv=0, irem=0):
    def reals(*values):
        return b"".join(b"%20s" % str(v).encode() for v in values)
    sides = b"%10d%10d%10d%10d%10d%10s%10d%10d%10d%10d\n" % (secondary, main, 0, 0, igap, b"", 0, 0, icurv, 0)
    bounds = reals(0, 0, 0, 0) + b"%10d%10d\n" % (irem, 0)
    flags = b"%10s%20s%10d" % (b"000", b"", 0) + reals(0, 0, 0) + b"\n"
    return (b"/INTER/TYPE7/%d\ncontact\n" % number + sides + reals(0, 0, 0) + b"\n" + bounds + reals(0, 0, gapmin, 0, 0) + b"\n"
            + flags + b"%10d%10d%20d%10d\n" % (0, 0, 0, 0))


def set_of(number, *clauses):
    return b"/SET/GENERAL/%d\nset\n" % number + b"".join(clauses)


def clause(name, *ids):
    return name.ljust(10) + b"".join(b"%10d" % i for i in ids) + b"\n"


def cases():
    """(name, files, options of lint, texts that lint names); the deck is d_0000.rad."""
    small = BEGIN + PARTS + sheet(1, 4, 10.0, 0.0, 1) + sheet(1001, 4, 10.0, 0.4, 2)
    doubling = b"".join(set_of(k, clause(b"SET", k - 1, k + 999), clause(b"SHELL", 1)) + set_of(k + 1000, clause(b"SET", k - 1))
                        for k in range(11, 211))
    doubling += set_of(10, clause(b"PART", 1)) + set_of(1010, clause(b"PART", 2))
    yield "sets that list one another 2^200 ways", small + doubling + type7(1, 210, 1, 1.0), (), []
    chain = b"".join(set_of(k, clause(b"SET", k + 1), clause(b"NODE", k % 25 + 1)) for k in range(1, 20000))
    yield "a chain of 20000 sets", small + chain + type7(1, 1, 1, 1.0), (), []
    back = b"".join(set_of(k, clause(b"SET", k - 1), clause(b"NODE", k % 25 + 1)) for k in range(11, 10000))
    yield "a chain of 10000 sets, first to last", small + set_of(10, clause(b"NODE", 1)) + back + type7(1, 9999, 1, 1.0), (), []
    surf = b"".join(b"/SURF/SURF/%d\ns\n%10d%10d\n/SURF/SURF/%d\ns\n%10d\n" % (k, k + 1, k + 1001, k + 1000, k + 1)
                    for k in range(10, 70))
    surf += b"/SURF/PART/70\ns\n         1\n"
    yield "surfaces that list one another 2^60 ways", small + surf + type7(1, 2, 10, 1.0), (), []
    group = b"".join(b"/GRSHEL/GRSHEL/%d\ns\n%10d%10d\n/GRSHEL/GRSHEL/%d\ns\n%10d\n" % (k, k + 1, k + 1001, k + 1000, k + 1)
                     for k in range(10, 70))
    yield "groups that list one another 2^60 ways", small + group + b"/GRSHEL/PART/70\ns\n         1\n", (), []
    deep = b"".join(b"/SUBSET/%d\ns\n%10d\n" % (k, k + 1) for k in range(1, 200000))
    yield "subsets 200000 deep", small + deep + b"/GRNOD/SUBSET/7\nall\n         1\n" + type7(1, 7, 1, 1.0), (), []
    for value in ("1e150", "1.4e154", "1e300", "1.7e308", "-1.7e308"):
        far = small + b"/NODE\n" + node(5000, value, 0, 0) + node(5001, 0, value, value)
        far += b"/SHELL/1\n      5000      5000      5001         3         4\n/GRNOD/NODE/5\nfar\n      5000      5001         7\n"
        contacts = type7(1, 5, 1, 1.0) + type7(2, 2, 2, 1.0, igap=3, irem=2)
        yield "a coordinate of %s" % value, far + contacts, (), ["node 5000"]
    lost = small + b"/UNIT/7\nkm\n                  kg                  km                  ms\n/NODE/7\n" + node(5000, "1e305", 0, 0)
    lost += b"/SHELL/1\n      5000      5000         1         2         3\n"
    yield "a coordinate that becomes infinite", lost + type7(1, 2, 1, 1.0), ("--geometry",), ["DK333", "DK380"]
    for icurv in (4, 5, 99, -1, 2147483647, 4294967299):
        yield "Icurv %d" % icurv, small + type7(1, 2, 1, 1.0, icurv=icurv), (), []
    wide = BEGIN + PARTS + sheet(1, 32, 1.0, 0.0, 1) + sheet(10001, 340, 0.1, 0.4, 2)
    yield "1024 segments, 116000 nodes, Gapmin 1000", wide + type7(1, 2, 1, 1000.0), ("--geometry",), ["DK390", "/INTER/TYPE7 1"]
    offsets = b"".join(b"//SUBMODEL/%d\nsub\n2147483647%10d\n" % (k, 2147483647) for k in range(1, 200)) + b"//ENDSUB\n" * 199
    yield "offsets of submodels that add up beyond 32 bits", small + offsets, (), ["DK335"]
    again = small + b"/GRNOD/NODE/5\nfew\n         1         2         3\n"
    yield "48000 conditions on one group", again + b"".join(b"/BCS/%d\nb\n   111 111         0         5\n" % k for k in range(1, 48001)), (), []
    yield "24000 sub-interfaces", again + type7(1, 2, 1, 1.0) + b"".join(b"/INTER/SUB/%d\ns\n         1         2         1\n" % k
                                                                     for k in range(2, 24002)), (), []
    on_it = b"/SHELL/1\n" + b"".join(b"%10d%10d%10d%10d%10d\n" % (k, 1, 2, 7, 6) for k in range(10000, 58000))
    yield "48000 shells on one another", small + on_it + type7(1, 2, 1, 1.0), ("--geometry",), []
    for value in ("NaN", "inf", "-inf"):
        yield "a Gapmin of %s" % value, small + type7(1, 2, 1, value), ("--geometry",), ["DK380"]
    yield "ids beyond 64 bits", small + b"/GRNOD/NODE/%s\nwide\n9999999999\n" % (b"9" * 60), (), ["DK335"]


def settings(c, folder):
    """.decklint.toml beside a deck, as a stranger would write it."""
    deck = write(os.path.join(folder, "a" * 100 + "_0000.rad"), BEGIN + PARTS)
    write(os.path.join(folder, "brackets"), "[" * 1000000)
    config = os.path.join(folder, ".decklint.toml")
    stars = '[per-file-ignores]\n"%s" = ["DK0"]\n' % ("*a" * 60 + "b")
    for name, text, codes in (
            ("a key of 200000 parts", "a" + ".a" * 200000 + " = 1\n", (2,)),
            ("a table of 200000 parts", "[a" + ".a" * 200000 + "]\n", (2,)),
            ("100000 brackets", "select = " + "[" * 100000 + "\n", (2,)),
            ("100000 braces", "select = " + "{a=" * 100000 + "\n", (2,)),
            ("a pattern of 60 stars", stars, (0, 1)),
            ("a pattern of 60 double stars", stars.replace("*a", "**a"), (0, 1)),
            ("2 MB", "#" * (2 << 20) + "\n", (2,)),
            ("/dev/zero as a baseline", 'baseline = "/dev/zero"\n', (2,)),
            ("/dev/tty as a baseline", 'baseline = "/dev/tty"\n', (2,)),
            ("a baseline of brackets", 'baseline = "brackets"\n', (2,))):
        write(config, text)
        c.no_crash("settings: " + name, c.run("lint", deck, timeout=20), codes)


def memory(c, folder):
    """Every verb under address spaces of many sizes: an answer or exit code 4 (or 3), never a signal."""
    if c.sanitized:
        return c.skip("memory limits", "a sanitizer needs the whole address space")
    big = write(os.path.join(folder, "big_0000.rad"), BEGIN + PARTS + sheet(1, 150, 1.0, 0.0, 1) + sheet(100001, 150, 1.0, 0.4, 2)
                + type7(1, 2, 1, 1.0, irem=1) + type7(2, 2, 2, 3.0, irem=2))
    needs = os.path.join(folder, "out")
    verbs = [("lint", "--geometry"), ("params",), ("gaps", "--json", needs + ".json", "--all"), ("cycle", "--all", "--json", needs + ".json"),
             ("convert", "--to", "json", "-o", needs), ("fix", "--strategy", "inacti", "--diff"), ("gaps", "--html", needs + ".html"),
             ("batch", "--verb", "gaps", "-o", needs)]
    failed = 0
    sizes = (24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 256, 384, 512)
    for verb, *options in verbs:
        # Where the program is loaded and its own tables just fit or do not, every size is another case.
        just = tuple(range(18, 32)) if verb == "lint" else ()
        for threads in ("1", "4") if c.options.all else ("4",):
            for megabytes in just + (sizes if c.options.all else sizes[1::3]):
                r = c.run(verb, big, *options, "--threads", threads, timeout=120, memory_mb=megabytes)
                name = "%s --threads %s in %d MB" % (verb, threads, megabytes)
                # 127: the system could not even load the program.
                c.check(name, r.code in (0, 1, 2, 3, 4, 127), "exit code %s: %s" % (r.code, r.text[-200:].replace("\n", " | ")))
                if r.code == 4:
                    failed += 1
                    c.check(name + ": says why", b"memory" in r.err or b"deck:" in r.err, r.text[-200:])
    c.check("some limits were too small, so that this tests something", failed > 10, "%d runs ran out of memory" % failed)


def decks(c, folder):
    verbs = (("lint", "--geometry"), ("params",), ("parts",), ("gaps",), ("cycle",), ("fix", "--strategy", "move-nodes"),
             ("fix", "--strategy", "reduce-gap"), *[("accuracy", "--samples", "3", "--repeats", "1")] * c.options.all)
    for name, text, options, texts in cases():
        deck = write(os.path.join(folder, "d_0000.rad"), text)
        for verb in verbs:
            r = c.run(*verb, deck, timeout=60)
            if c.no_crash("%s: %s" % (verb[0], name), r, ORDERLY) and verb[0] == "lint":
                for wanted in texts:
                    c.check("lint: %s names %s" % (name, wanted), wanted in r.text, r.text[-600:].replace("\n", " | "))


if __name__ == "__main__":
    run_steps(decks, settings, memory)
