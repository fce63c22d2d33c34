#!/usr/bin/env python3
"""What a verdict may say: nothing about what is no Starter deck, nothing clean about what was not
examined, counts that are those of the rows; and what titles and file names may do to a terminal, a log
or a parser: nothing."""
import gzip
import json
import os
import random
import re
import shutil
import xml.dom.minidom

from common import SAMPLES, read, run_steps, write

SAMPLE = {os.path.basename(p)[:-len("_0000.rad")]: p for p in SAMPLES}


def verbs(deck, tmp):
    """(verb, arguments) for every verb that reads a deck."""
    out = os.path.join(tmp, "out")
    for verb, *rest in (("lint",), ("lint", "--geometry"), ("params",), ("gaps",), ("cycle",), ("accuracy",),
                        ("convert", "-o", out), ("convert", "--version", "2022", "--diff"), ("convert", "--to", "json"),
                        ("fix", "--strategy", "move-nodes")):
        yield (verb, deck, *rest)


def batch_of(c, tmp, path, *options):
    """The run, the entry of the one deck, the totals."""
    out = os.path.join(tmp, "batch")
    r = c.run("batch", "-o", out, *options, path)
    document = json.loads(read(os.path.join(out, "summary.json")))
    shutil.rmtree(out)
    return r, document["decks"][0], document["totals"]


# ---- what is no Starter deck ---------------------------------------------------------------------

def no_decks():
    """One of each way to be none; recognise_test.cpp has more kinds of files."""
    deck = read(SAMPLE["too_close"])
    rng = random.Random(4)
    yield "empty", b"", "empty"
    yield "blank", b"  \n\n", "empty"
    yield "packed and cut off", gzip.compress(deck)[:-100], "incomplete"
    yield "packed and damaged", gzip.compress(deck)[:200] + b"damage" + gzip.compress(deck)[206:], "damaged"
    yield "packed twice", gzip.compress(gzip.compress(deck)), "packed twice"
    yield "a bomb", gzip.compress(bytes(100 << 20)), "limit"
    yield "LS-DYNA", b"$ a comment\n*KEYWORD\n*NODE\n       1             0.0             0.0             0.0\n*END\n", "LS-DYNA"
    yield "Engine", b"/RUN/car/1/\n 10.\n/TFILE/4\n 0.1\n/PRINT/-100\n", "Engine"
    yield "random bytes", bytes(rng.randrange(256) for _ in range(4000)), ""
    yield "random bytes with line ends", b"\n".join(bytes(rng.randrange(1, 256) for _ in range(60)) for _ in range(80)), ""
    yield "UTF-16", deck.decode().encode("utf-16"), "UTF-16"
    yield "include file", b"/NODE\n         1                 0.0                 0.0                 0.0\n", "include"


def not_a_deck(c, tmp):
    for name, data, word in no_decks():
        path = write(os.path.join(tmp, "x_0000.rad"), data)
        for args in verbs(path, tmp):
            r = c.run(*args)
            title = "%s: deck %s" % (name, " ".join(a for a in args if not a.startswith(tmp)))
            if c.check(title + " ends with 3", r.code == 3, "%s; %s" % (r.code, r.text[-200:])):
                c.check(title + " says what it is", word in r.text and "x_0000.rad" in r.text, r.text[-300:])
            c.check(title + " gives no verdict", "No initial penetration" not in r.text and "0 errors" not in r.text, r.text[-200:])
        r, entry, _ = batch_of(c, tmp, path)
        c.check(name + ": batch", r.code == 3 and entry["status"] == "unreadable" and word in entry["error"], str(entry))
    directory = os.path.join(tmp, "dir_0000.rad")
    os.makedirs(directory)
    for args in verbs(directory, tmp):
        r = c.run(*args)
        c.check("directory: deck %s" % args[0], r.code == 3 and "directory" in r.text, "%s; %s" % (r.code, r.text[-200:]))


def incomplete(c, tmp):
    path = write(os.path.join(tmp, "lacking_0000.rad"), read(SAMPLE["clean_plates"]).replace(b"/END", b"#include nowhere.inc\n/END"))
    for args in (("gaps",), ("cycle",), ("lint", "--geometry"), ("params",)):
        r = c.run(args[0], path, *args[1:])
        c.check("missing include: deck %s ends with 3" % args[0], r.code == 3, "%s; %s" % (r.code, r.text[-200:]))
        c.check("missing include: deck %s gives no verdict" % args[0], "No verdict" in r.text and "nowhere.inc" in r.text
                and "No initial penetration" not in r.text and "No contact force" not in r.text, r.text[-300:])
    document = json.loads(c.run("gaps", path, "--json", "-").out)
    c.check("missing include: the verdict of the JSON", document["verdict"]["text"].startswith("No verdict"), document["verdict"])


# ---- what was not examined -----------------------------------------------------------------------

def before_and_contact():
    data = read(SAMPLE["too_close"])
    at = data.index(b"/INTER/")
    return data[:at], data[at:].replace(b"/END\n", b"")


def not_examined(c, tmp):
    base, contact = before_and_contact()
    others = b"".join(b"/INTER/TYPE23/%d\nother\n         1         2\n" % i for i in (4, 5, 6))
    decks = {"others": base + others + b"/END\n", "mixed": base + contact + others + b"/INTER/TYPE18/9\nother\n/END\n", "none": base + b"/END\n"}
    says = {"others": "3 interfaces of TYPE23 (ids 4, 5, 6)", "mixed": "1 interface of TYPE18 (id 9), 3 interfaces of TYPE23 (ids 4, 5, 6)",
            "none": "no contact interface"}
    expected = {"others": [("/INTER/TYPE23", 3, [4, 5, 6])], "mixed": [("/INTER/TYPE18", 1, [9]), ("/INTER/TYPE23", 3, [4, 5, 6])], "none": []}
    for name, data in decks.items():
        path = write(os.path.join(tmp, name + "_0000.rad"), data)
        for verb in ("gaps", "cycle", "params", "lint"):
            r = c.run(verb, path)
            c.check("%s: the text of %s names them" % (name, verb), says[name] in r.text, r.text[-300:])
            if name != "mixed" and verb != "lint":
                c.check("%s: the text of %s begins with that" % (name, verb), r.out.decode().startswith("Nothing examined"), r.text[:200])
            document = json.loads(c.run(verb, path, "--json", "-", "--quiet").out)
            got = [(n["keyword"], n["count"], n["ids"]) for n in document["not_examined"]]
            c.check("%s: the JSON of %s" % (name, verb), got == expected[name] and document["examined"] == (name == "mixed"), str(got))
            strict = c.run(verb, path, "--require-examined", "--quiet").code
            plain = c.run(verb, path, "--quiet").code
            c.check("%s: %s --require-examined" % (name, verb), strict == (plain if name == "mixed" else max(plain, 1)), "%s, %s" % (strict, plain))
            if verb != "lint":
                c.check("%s: %s without it" % (name, verb), plain == 0, str(plain))
        for verb in ("gaps", "cycle", "params", "lint"):
            for strict in (False, True):
                r, entry, totals = batch_of(c, tmp, path, "--verb", verb, *(["--require-examined"] if strict else []))
                title = "%s: batch %s%s" % (name, verb, " --require-examined" if strict else "")
                if name == "mixed" or verb == "lint":
                    c.check(title + ": not what was examined", (entry["status"] == "not-examined") == (name == "others" and r.code <= 1 and not entry["counts"].get("errors")
                            and not entry["counts"].get("warnings")), str(entry)[:200])
                else:
                    c.check(title, entry["status"] == "not-examined" and totals["not_examined"] == 1 and totals["clean"] == 0
                            and r.code == int(strict), "%s %s" % (r.code, str(entry)[:200]))


# ---- counts --------------------------------------------------------------------------------------

def recount(document):
    """The summary from the rows alone."""
    nodes, edges, on, stops, pairs, on_pairs = set(), set(), set(), set(), 0, 0
    for inter in document["interfaces"]:
        for contact in inter["contacts"]:
            # The edges of a TYPE24 or TYPE25 have lists and totals beside.
            of_edges = [p for key in ("edge_penetrations", "edge_solid_penetrations", "point_penetrations") for p in contact.get(key) or [] if p.get("counted", True)]
            for rows, totals in ((contact["penetrations"], contact["totals"]), (of_edges, contact.get("edge_totals"))):
                mine, mine_edges = set(), set()
                for p in rows:
                    pairs += 1
                    if "node" in p:
                        mine.add(p["node"])
                        if p["on_surface"]:
                            on.add(p["node"])
                            on_pairs += 1
                    else:
                        mine_edges.add(tuple(sorted(p["edge"])))
                if totals:
                    yield (totals["nodes"], totals["edges"], totals["pairs"]), (len(mine), len(mine_edges), len(rows))
                nodes |= mine
                edges |= mine_edges
    s = document["summary"]
    yield (s["nodes"], s["edges"], s["pairs"], s["on_segment"]["nodes"], s["on_segment"]["pairs"]), (len(nodes), len(edges), pairs, len(on), on_pairs)


def counts(c, tmp):
    paths = list(SAMPLES) + [p for _, p in c.corpus_decks() if "EuroSID" in p][:1]
    for path in paths:
        name = os.path.basename(path)
        if "every_mistake" in name:
            continue
        r = c.run("gaps", path, "--json", "-", "--quiet", "--crossings", timeout=300)
        if not c.check(name + ": gaps", r.code in (0, 1), r.text[-200:]):
            continue
        document = json.loads(r.out)
        c.check(name + ": counts are those of the rows", all(a == b for a, b in recount(document)), str(list(recount(document))))
        s = document["summary"]
        listed = [x for i in document["interfaces"] for k in i["contacts"] for x in k.get("crossings", [])]
        keys = {(tuple(x["edge"]), tuple(sorted(x["segment"]))) for x in listed}
        c.check(name + ": a crossing is listed once", len(keys) == len(listed) == s["crossed_elements"], "%d %d %s" % (len(keys), len(listed), s["crossed_elements"]))
    s = json.loads(c.run("gaps", SAMPLE["crash_box"], "--json", "-", "--quiet").out)["summary"]
    c.check("crash_box: ties are counted by themselves", s["tied"] == {"nodes": 28, "pairs": 64} and s["pairs"] == 78, str(s))
    c.check("crash_box: 4 nodes on segments, in 6 pairs", s["on_segment"] == {"nodes": 4, "edges": 0, "pairs": 6} and s["solver_errors"] == 4, str(s))


# ---- text from outside ---------------------------------------------------------------------------

ODD = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069\ufeff\ufdd0-\ufdef\ufffe\uffff]")
COMMAND = re.compile(r"^\s*::|##\[|##vso\[", re.M)


def scan(c, title, data, commands=True):
    """No control character, nothing but UTF-8, no command of a CI runner."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as e:
        return c.check(title + " is UTF-8", False, "%s: %r" % (e, data[max(0, e.start - 30):e.start + 10]))
    found = ODD.search(text)
    c.check(title + " holds no control character", not found, found and repr(text[max(0, found.start() - 60):found.start() + 20]))
    if commands:
        found = COMMAND.search(text)
        c.check(title + " holds no command", not found, found and repr(text[max(0, found.start() - 40):found.start() + 60]))


def scan_xml(c, title, document):
    scan(c, title + ": XML", document)
    try:
        xml.dom.minidom.parseString(document)
    except Exception as e:  # any parser error
        c.check(title + ": well-formed XML", False, str(e))


def outputs_of(c, path, tmp, title, cwd=None):
    """Every verb and every format over one deck; what is printed and written is scanned."""
    page, html = (os.path.join(tmp, n) for n in ("a.html", "g.html"))
    runs = [("lint", path), ("lint", path, "--color", "never", "--per-rule", "0", "--geometry"), ("params", path), ("gaps", path, "--crossings"), ("cycle", path, "--effects"),
            ("fix", path, "--strategy", "reduce-gap"), ("fix", path, "--strategy", "move-nodes"), ("accuracy", path, "--samples", "1", "--repeats", "1", "--html", page),
            ("params", path, "--json", "-"), ("gaps", path, "--json", "-", "--all"), ("gaps", path, "--csv", "-"), ("cycle", path, "--json", "-"), ("lint", path, "--format", "json"),
            ("lint", path, "--format", "sarif"), ("lint", path, "--format", "gitlab"), ("convert", path, "--to", "json"), ("convert", path, "--units", "kg,m,s", "-o", os.path.join(tmp, "converted")),
            ("lint", path, "--baseline", path + "x"), ("lint", path, "--config", path + "x"), ("gaps", path, "--compare", path + "x", "--html", os.path.join(tmp, "x.html")),
            ("batch", path, "-o", os.path.join(tmp, "batch"))]
    for args in runs:
        r = c.run(*args, cwd=cwd)
        name = "%s: deck %s" % (title, " ".join(a for a in args if a != path and not a.startswith(tmp)))
        if not c.no_crash(name, r, (0, 1, 2, 3)):
            continue
        scan(c, name, r.out.replace(b"\r\n", b"\n") if "--csv" in args else r.out)
        scan(c, name + " (stderr)", r.err)
        if "json" in args or "sarif" in args or "gitlab" in args or "--json" in args:
            if r.code in (0, 1):
                c.check(name + " is JSON", json.loads(r.out) is not None)
    r = c.run("lint", path, "--format", "github", cwd=cwd)
    scan(c, title + ": workflow commands", r.out, commands=False)
    c.check(title + ": each line is one of our commands", all(re.match(rb"::(error|warning|notice) (file|title)=", x) for x in r.out.splitlines()), r.text[:300])
    scan_xml(c, title, c.run("lint", path, "--format", "junit", cwd=cwd).out)
    c.run("gaps", path, "--quiet", "--html", html, cwd=cwd)
    for f in (page, html):
        if os.path.exists(f):
            data = read(f)
            if f == html:
                data = data[:data.index(b"<style>")] + data[data.index(b"<main"):data.index(b"</main>")]
            scan(c, title + ": " + os.path.basename(f), data, commands=f != html)
            os.remove(f)
    shutil.rmtree(os.path.join(tmp, "batch"), ignore_errors=True)
    shutil.rmtree(os.path.join(tmp, "converted"), ignore_errors=True)


def all_pairs():
    """All pairs of bytes that can stand within a line, in titles of 90 bytes."""
    pairs = b"".join(bytes((a, b)) for a in range(256) for b in range(256) if a not in (0, 10, 13) and b not in (0, 10, 13))
    return [b"t" + pairs[i:i + 90] + b"t" for i in range(0, len(pairs), 90)]


def titles(c, tmp):
    data, (head, contact) = read(SAMPLE["too_close"]), before_and_contact()
    many = head
    for i, title in enumerate(all_pairs(), 1):
        many += contact.replace(b"/INTER/TYPE7/1\n", b"/INTER/TYPE7/%d\n" % i).replace(b"upper on lower", title)
    path = write(os.path.join(tmp, "pairs_0000.rad"), many + b"/END\n")
    for args in (("params", path, "--no-geometry"), ("params", path, "--no-geometry", "--json", "-"), ("lint", path, "--per-rule", "0"), ("lint", path, "--format", "gitlab")):
        r = c.run(*args, timeout=300)
        if c.no_crash("all pairs of bytes: deck %s" % " ".join(args[:1] + args[2:]), r, (0, 1, 3)):
            scan(c, "all pairs of bytes: deck %s" % " ".join(args[:1] + args[2:]), r.out)
    scan_xml(c, "all pairs of bytes", c.run("lint", path, "--format", "junit", timeout=300).out)
    evil = [b"\x1b]0;owned\x07\x1b[2J", b"\xed\xa0\x80\xc0\xaf\xef\xbf\xbf\xef\xb7\x90\xf4\x90\x80\x80", "\u202enimda \u2066x\u2069\u009b31m".encode(),
            b"::error::x ##[error]y ##vso[z]", b"]]>&amp;<script>alert(1)</script>", b"\r::error file=a::b", b"tr\xe4ger\x85\x9b2J"]
    rng = random.Random(11)
    evil += [bytes(rng.choice([n for n in range(256) if n != 10]) for _ in range(60)) for _ in range(3)]
    for i, title in enumerate(evil):
        # Titles of interface, parts and run; the same as a cell, a keyword and a name of a file.
        text = data.replace(b"upper on lower", title).replace(b"upper plate", title).replace(b"lower plate", title).replace(b"two plates closer than the contact gap", title)
        text = text.replace(b"/INTER/", b"/NONSENSE" + title[:20].replace(b"\n", b"") + b"/7\nx\n/INTER/", 1)
        text = text.replace(b"       000", b"       000 " + title[:8], 1)
        outputs_of(c, write(os.path.join(tmp, "title_0000.rad"), text), tmp, "title %d" % i)
    text = data.replace(b"/END", b"#include " + evil[0] + b".inc\n/END")
    r = c.run("lint", write(os.path.join(tmp, "lacking_0000.rad"), text))
    scan(c, "name of an include", r.out + r.err)


def file_names(c, tmp):
    names = [b"a\x1b[31mred_0000.rad", b"b\n::error::x_0000.rad", b"::error file=x::y_0000.rad", b"c\xff\xfe\xed\xa0\x80_0000.rad", "d\u202e\u0085_0000.rad".encode(),
             b"e<&\">'_0000.rad", b"f\r::warning::z_0000.rad", b"g##[error]_0000.rad"]
    folder = os.path.join(tmp, "names")
    for i, name in enumerate(names):
        os.makedirs(folder)
        path = write(os.path.join(os.fsencode(folder), name), read(SAMPLE["too_close"]).replace(b"       000", b"       00x", 1))
        outputs_of(c, os.fsdecode(name), tmp, "file name %d" % i, cwd=folder)
        for args in (("lint", os.fsdecode(name) + "absent"), ("gaps", os.fsdecode(name) + "absent"), (os.fsdecode(name),), ("gaps", "--" + os.fsdecode(name)),
                     ("explain", os.fsdecode(name)), ("batch", "-o", "out", "--manifest", os.fsdecode(name) + "absent"), ("convert", os.fsdecode(name), "-o", "o", "--version", "2020")):
            r = c.run(*args, cwd=folder)
            scan(c, "file name %d: %s" % (i, args[0] if args[0].isalpha() else "as verb"), r.out + r.err)
        os.unlink(path)
        shutil.rmtree(folder)
    os.makedirs(folder)
    write(os.path.join(folder, "a_0000.rad"), read(SAMPLE["too_close"]))
    for text in (b'"\\u001b]0;x\\u0007" = 1\n', b'[severity]\n"DK1\\u001b[2J" = "error"\n', b'select = ["\\u202e\\u0007"]\n', b"x = \x1b\n", b'[lint]\n"a\\n::error::b" = 2\n'):
        write(os.path.join(folder, ".decklint.toml"), text)
        r = c.run("lint", "a_0000.rad", cwd=folder)
        scan(c, "configuration %r" % text, r.out + r.err)


if __name__ == "__main__":
    run_steps(not_a_deck, incomplete, not_examined, counts, titles, file_names)
