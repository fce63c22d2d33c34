#!/usr/bin/env python3
"""Input that is wrong in every way: the program must answer with an orderly exit code and a message,
in bounded time and memory, and never crash."""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile

from common import ROOT, SAMPLES, read, run_steps, write

BEGIN = (b"#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
         b"                  kg                  mm                  ms\n"
         b"                  kg                  mm                  ms\n")
FINDINGS, UNREADABLE = (1,), (3,)
ORDERLY = (0, 1, 3)


def cases():
    """Beside what verdicts.py has of files that are no decks: (name, files, exit codes, texts the answer must contain); the deck is d_0000.rad."""
    yield "only comments", {"d_0000.rad": b"#RADIOSS STARTER\n# nothing\n"}, (1, 3), ["d_0000.rad"]
    yield "program file", {"d_0000.rad": open(sys.executable, "rb").read(200000)}, (1, 3), ["d_0000.rad"]
    yield "all NUL", {"d_0000.rad": b"\0" * 100000}, (1, 3), ["d_0000.rad"]
    yield "NUL bytes inside", {"d_0000.rad": BEGIN + b"/NODE\n         1\0        0.0\n/END\n"}, (1, 3), ["d_0000.rad"]
    yield "missing include", {"d_0000.rad": BEGIN + b"#include sub/none.inc\n/END\n"}, UNREADABLE, \
        ["d_0000.rad:7", "none.inc"]
    yield "include of a directory", {"d_0000.rad": BEGIN + b"#include sub\n", "sub/x": b""}, UNREADABLE, ["d_0000.rad:7"]
    yield "include of a FIFO", {"d_0000.rad": BEGIN + b"#include pipe\n/END\n", "pipe": None}, UNREADABLE, \
        ["d_0000.rad:7", "pipe"]
    yield "include of itself", {"d_0000.rad": BEGIN + b"#include d_0000.rad\n"}, (1, 3), ["d_0000.rad:7"]
    yield "include cycle", {"d_0000.rad": BEGIN + b"#include a\n", "a": b"#include b\n", "b": b"# x\n#include a\n"}, \
        (1, 3), ["b:2"]
    yield "include of /dev/zero", {"d_0000.rad": BEGIN + b"#include /dev/zero\n"}, UNREADABLE, ["/dev/zero"]
    yield "include without a name", {"d_0000.rad": BEGIN + b"#include ''\n"}, (1, 3), ["d_0000.rad:7"]
    deep = {"d_0000.rad": BEGIN + b"#include i0\n/END\n"}
    deep.update({"i%d" % k: b"#include i%d\n" % (k + 1) for k in range(10000)})
    yield "10000 nested includes", deep, (1, 3), ["include"]
    bomb = {"d_0000.rad": BEGIN + b"#include b0\n"}
    bomb.update({"b%d" % k: b"#include b%d\n" % (k + 1) * 10 for k in range(12)})
    bomb["b12"] = b"/NODE\n"
    yield "includes that multiply (10^12)", bomb, (1, 3), ["include"]
    wide = {"d_0000.rad": BEGIN + b"#include same\n" * 5000, "same": b"# nothing\n"}
    yield "one file included 5000 times", wide, ORDERLY, []
    for n in (3, 30, 60, 200):
        yield "cut after %d bytes" % n, {"d_0000.rad": BEGIN[:n]}, ORDERLY, []
    yield "CRLF", {"d_0000.rad": BEGIN.replace(b"\n", b"\r\n") + b"/END\r\n"}, ORDERLY, []
    yield "no final newline", {"d_0000.rad": BEGIN + b"/NODE\n         1"}, ORDERLY, []
    yield "line of 20 MB", {"d_0000.rad": BEGIN + b"/NODE\n" + b" " * 20_000_000 + b"1\n/END\n"}, ORDERLY, []
    yield "header of 5 MB", {"d_0000.rad": BEGIN + b"/SURF/PART" + b"/1" * 2_500_000 + b"\n"}, ORDERLY, []
    yield "a million headers", {"d_0000.rad": BEGIN + b"/X\n" * 1_000_000}, ORDERLY, []
    yield "200000 broken nodes", {"d_0000.rad": BEGIN + b"/NODE\n" + b"       x-1    abc  1e  --5\n" * 200_000}, FINDINGS, \
        ["d_0000.rad"]
    yield "blocks without a line", {"d_0000.rad": BEGIN + b"/NODE\n/NODE\n/SHELL/1\n/BRICK/1\n/SURF/SEG/1\n/FUNCT/1\n/SET/GENERAL/1\n"
                                    b"/INTER/TYPE7/1\n/INTER/TYPE11/2\n/PART/1\n/MAT/ELAST/1\n/END\n"}, ORDERLY, []
    yield "huge ids and numbers", {"d_0000.rad": BEGIN + b"/NODE\n99999999999999999999" + b"1e999999".rjust(20) + b"\n"
                                   b"/SURF/PART/99999999999999999999\nt\n-9223372036854775808\n"}, ORDERLY, []
    yield "parameter in terms of itself", {"d_0000.rad": BEGIN + b"/PARAMETER/GLOBAL/REAL_EXPR/1\nt\na         &b+1\n"
                                           b"/PARAMETER/GLOBAL/REAL_EXPR/2\nt\nb         &a+1\n/NODE\n         1"
                                           + b"&a".rjust(20) + b"\n"}, FINDINGS, ["d_0000.rad"]
    yield "expression of 100000 brackets", {"d_0000.rad": BEGIN + b"/PARAMETER/GLOBAL/REAL_EXPR/1\nt\na         "
                                            + b"(" * 100000 + b"\n"}, ORDERLY, []
    chain = b"".join(b"/PARAMETER/GLOBAL/REAL_EXPR/%d\nt\np%-9d&p%d+&p%d\n" % (k, k, k + 1, k + 1) for k in range(1, 5000))
    yield "chain of 5000 parameters, doubling", {"d_0000.rad": BEGIN + chain}, ORDERLY, []
    ring = b"/SURF/SURF/1\na\n         2\n/SURF/SURF/2\nb\n         1\n/GRNOD/GRNOD/1\na\n         1\n"
    ring += b"/SUBSET/1\na\n         2\n/SUBSET/2\nb\n         1\n/BOX/BOX/1\na\n         1\n"
    ring += b"/SET/GENERAL/7\na\nSET                8\n/SET/GENERAL/8\nb\nSET                7\n"
    ring += b"/GRNOD/SUBSET/9\nx\n         1\n/GRNOD/BOX/10\nx\n         1\n/LINE/LINE/1\na\n         1\n"
    inter = b"/INTER/TYPE7/1\nx\n         1         1\n\n\n\n\n\n/INTER/TYPE7/2\nx\n         7         8\n\n\n\n\n\n"
    inter += b"/INTER/TYPE11/3\nx\n         1         1\n\n\n\n\n/INTER/TYPE7/4\nx\n         9         2\n\n\n\n\n\n"
    inter += b"/INTER/TYPE7/5\nx\n        10         2\n\n\n\n\n\n"
    yield "sets, surfaces, boxes that contain one another", {"d_0000.rad": BEGIN + ring + inter}, FINDINGS, []
    line = b"".join(b"/SURF/SURF/%d\nt\n%10d\n" % (k, k + 1) for k in range(1, 20000))
    yield "surfaces of surfaces, 20000 deep", {"d_0000.rad": BEGIN + line + inter}, ORDERLY, []
    double = b"".join(b"/SURF/SURF/%d\nt\n%10d%10d\n" % (k, k + 1, k + 1) for k in range(1, 60))
    double += b"/NODE\n" + b"".join(b"%10d%20d%20d%20d\n" % (k, k % 2, k // 2, 0) for k in range(4))
    double += b"/SHELL/1\n         1         0         1         3         2\n/SURF/PART/60\nt\n         1\n"
    yield "a surface listed 2^59 times over", {"d_0000.rad": BEGIN + double + inter}, ORDERLY, []
    yield "10000 open submodels", {"d_0000.rad": BEGIN + b"//SUBMODEL/1\nt\n 999999999 999999999\n" * 10000}, ORDERLY, []
    yield "10000 closed submodels too many", {"d_0000.rad": BEGIN + b"//ENDSUB\n" * 10000}, ORDERLY, []
    yield "generated ids over the whole range", {"d_0000.rad": BEGIN + b"/GRNOD/GENE/1\nt\n         12147483647\n"
                                                 b"/GRNOD/GEN_INCR/2\nt\n         12147483647         0\n"
                                                 b"/SET/GENERAL/3\nt\nNODE_G             12147483647         1\n" + inter}, ORDERLY, []
    nan = (b"/NODE\n" + b"".join(b"%10d%20s%20s%20s\n" % (k, v, b"1e308", b"-1e308")
                                 for k, v in enumerate((b"nan", b"inf", b"-inf", b"1e308"), 1))
           + b"/SHELL/1\n         1         1         2         3         4\n/SURF/PART/1\nt\n         1\n" + inter)
    yield "coordinates that are no numbers", {"d_0000.rad": BEGIN + nan}, ORDERLY, []
    huge = (b"/NODE\n" + b"".join(b"%10d%20s%20s%20s\n" % (k, x, y, b"0") for k, (x, y) in enumerate(
        ((b"0", b"0"), (b"1e300", b"0"), (b"1e300", b"1e-300"), (b"0", b"1e300")), 1))
            + b"/SHELL/1\n         1         1         2         3         4\n/SURF/PART/1\nt\n         1\n" + inter)
    yield "a shell of size 1e300", {"d_0000.rad": BEGIN + huge}, ORDERLY, []


def put(folder, files):
    for name, data in files.items():
        if data is None:
            os.mkfifo(os.path.join(folder, name))
        else:
            write(os.path.join(folder, name), data)


def mutations(text, count):
    """Decks with a few damaged bytes or lines, always the same ones."""
    rng = random.Random(20240607)
    lines = text.split(b"\n")
    for k in range(count):
        kind = k % 5
        if kind == 0:
            data = bytearray(text)
            for _ in range(rng.randint(1, 20)):
                data[rng.randrange(len(data))] = rng.randrange(256)
            yield bytes(data)
        elif kind == 1:
            yield text[:rng.randrange(len(text))]
        elif kind == 2 or kind == 3:
            copy = list(lines)
            for _ in range(rng.randint(1, 4)):
                i, j = rng.randrange(6, len(copy)), rng.randrange(6, len(copy))
                if kind == 2:
                    del copy[i]
                else:
                    copy[i], copy[j] = copy[j], copy[i]
            yield b"\n".join(copy)
        else:
            copy = list(lines)
            i = rng.randrange(len(copy))
            copy[i] = copy[i].replace(rng.choice((b"1", b"0", b"2", b" ")), rng.choice((b"-", b"9999999999", b"1e400", b"\t", b",")))
            yield b"\n".join(copy)


def usage(c, folder):
    """Schemas of a user that are not there, or broken, are wrong usage."""
    write(os.path.join(folder, "schemas", "a.json"), "{\"keyword\": 7, ")
    for name in ("none", "schemas"):
        r = c.run("params", SAMPLES[0], "--schemas", os.path.join(folder, name))
        c.no_crash("usage: --schemas " + name, r, (2,)) and c.check("usage: --schemas %s says why" % name, name in r.text, r.text)


def unwritable(c, folder):
    """Standard output that cannot be written is said once."""
    good = SAMPLES[0]
    for args in (("params", good, "--json", "-"), ("rules",), ("convert", good, "--to", "json"), ("gaps", good, "--csv", "-"), ("--version",)):
        for closed in (False, True):  # a full disk; a reader that went away, where SIGPIPE is ignored and where it is not
            out = os.open("/dev/full", os.O_WRONLY)
            if closed:
                os.close(out)
                reader, out = os.pipe()
                os.close(reader)
            for ignored in (True, False) if closed else (True,):
                p = subprocess.run([c.program, *args], stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, restore_signals=False,
                                   preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN if ignored else signal.SIG_DFL))
                said = p.stderr.count(b"deck: error: cannot write standard output")
                expected = (2, 0) if closed else (2, 1)
                c.check("deck %s: standard output that cannot be written ends every verb alike (closed %s, SIGPIPE ignored %s)" %
                        (" ".join(map(os.path.basename, args)), closed, ignored), (p.returncode, said) == expected and p.stderr.count(b"\n") == said,
                        "%s %s" % (p.returncode, p.stderr))
            os.close(out)


VERBS = ("lint", "params", "gaps", "cycle")


def decks(c, folder):
    for name, files, codes, texts in cases():
        here, out = os.path.join(folder, "case"), os.path.join(folder, "out")
        for path in (here, out):
            shutil.rmtree(path, ignore_errors=True)
        os.mkdir(here)
        put(here, files)
        deck = os.path.join(here, "d_0000.rad")
        for verb in VERBS:
            r = c.run(verb, deck, timeout=60)
            # Only lint turns findings into exit code 1; the others answer as far as they can.
            allowed = codes if verb == "lint" else ORDERLY if codes != UNREADABLE else codes
            if c.no_crash("%s: %s" % (verb, name), r, allowed) and verb == "lint":
                for text in texts:
                    c.check("lint: %s names %s" % (name, text), text in r.text, r.text[:300].replace("\n", " | "))
        if None not in files.values():
            r = c.run("convert", deck, "--to", "rad", "-o", out, timeout=60)
            c.no_crash("convert: " + name, r, (0, 1, 2, 3))
            if r.code in (0, 1):
                c.check("convert: %s keeps every byte" % name, read(os.path.join(out, "d_0000.rad")) == files["d_0000.rad"])


def no_files(c, folder):
    """A main file that is none."""
    fifo = os.path.join(folder, "fifo_0000.rad")
    os.mkfifo(fifo)
    for path in (os.path.join(folder, "none_0000.rad"), folder, "/dev/null/x", fifo):
        for verb in VERBS:
            r = c.run(verb, path, timeout=20)
            c.no_crash("%s: %s" % (verb, path), r, UNREADABLE)
            c.check("%s: %s is named" % (verb, path), path in r.text)


def damaged(c, folder):
    count = 2000 if c.options.all else 100
    for name in ("every_mistake", "variable_gap", "solid_and_skin"):
        for k, data in enumerate(mutations(read(os.path.join(ROOT, "samples", name + "_0000.rad")), count)):
            path = write(os.path.join(folder, "m_0000.rad"), data)
            r = c.run("lint" if k % 4 else VERBS[k // 4 % len(VERBS)], path, timeout=20)
            if not c.no_crash("%s with damage %d" % (name, k), r):
                keep = os.path.join(tempfile.gettempdir(), "deck-damaged-%s-%d_0000.rad" % (name, k))
                shutil.copy(path, keep)
                print("        kept as " + keep)


def one_gigabyte(c, folder):
    if not c.options.all:
        return
    path = os.path.join(folder, "big_0000.rad")
    with open(path, "wb") as f:
        f.write(BEGIN + b"/NODE\n")
        for _ in range(1024):
            f.write(b"1" * (1 << 20))
        f.write(b"\n/END\n")
    for verb in VERBS[:2]:
        r = c.run(verb, path, timeout=120)
        c.no_crash(verb + ": line of 1 GB", r, ORDERLY)
        print("%s of a 1 GB line: %.2f s" % (verb, r.seconds))


if __name__ == "__main__":
    run_steps(decks, no_files, usage, unwritable, damaged, one_gigabyte)
