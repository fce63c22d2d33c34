#!/usr/bin/env python3
"""Every deck at hand through every conversion of `deck convert`: what comes out is the same model.

The views of `deck params` and `deck gaps --all` before and after are compared without the places
they name. A conversion may be refused (exit code 1), but then it writes nothing and says where; one
that writes with exit code 1 lists what it left undecided."""
import concurrent.futures
import json
import os
import re
import tempfile
import zlib

from common import Checks

PLACES = {"source", "file", "line", "column", "path", "places", "place", "deck", "tool", "schema", "span", "defined_at",
          "input", "origin", "gapmin_origin", "accuracy"}
VERSIONS = (2018, 2022, 2026)
EVERY_VERSION = (110, 120, 130, 140) + tuple(range(2017, 2027))  # with --all


def bare(value):
    """A document without what depends on where things stand in the files."""
    if isinstance(value, dict):
        return {k: bare(v) for k, v in value.items() if k not in PLACES}
    if isinstance(value, list):
        return [bare(v) for v in value]
    return value


class Deck:
    def __init__(self, c, stem, path, tmp):
        self.c, self.stem, self.path, self.tmp = c, stem, path, tmp
        self.own = {}  # what the verbs say of the deck itself: asked once

    def some_of(self, options):
        """All with --all, else one, by the deck's name."""
        return options if self.c.options.all else options[zlib.crc32(self.stem.encode()) % len(options):][:1]

    def view(self, verb, path, *more):
        if path != self.path:
            return self.ask(verb, path, *more)
        if (verb, more) not in self.own:
            self.own[verb, more] = self.ask(verb, path, *more)
        return self.own[verb, more]

    def ask(self, verb, path, *more):
        target = os.path.join(self.tmp, "view.json")
        r = self.c.run(verb, path, "--quiet", "--json", target, *more, timeout=300)
        if r.code not in (0, 1):
            return "%s: exit code %s: %s" % (verb, r.code, r.text[-200:])
        with open(target, encoding="utf-8") as f:
            document = bare(json.load(f))
        os.remove(target)
        return document

    def convert(self, path, *options):
        """Path of the converted deck, or None if that was refused."""
        out = tempfile.mkdtemp(dir=self.tmp)
        target = os.path.join(out, "d")
        r = self.c.run("convert", path, "-o", target, *options, timeout=300)
        name = "convert %s %s" % (self.stem, " ".join(options))
        if not self.c.no_crash(name, r, (0, 1)):
            return None
        open_questions = re.search(rb"undecided ([1-9]\d*)\s*$", r.err)
        if r.code == 1 and not (open_questions and os.path.exists(target)):
            self.c.check(name + ": a refusal writes nothing", not os.path.exists(target))
            self.c.check(name + ": a refusal says where or what", b"error:" in r.err, r.text[-200:])
            return None
        for root, _, files in os.walk(target):
            for f in files:
                if f == os.path.basename(self.path):
                    return os.path.join(root, f)
        self.c.check(name + " writes the deck", False, str(os.listdir(target)))
        return None

    def same(self, what, verb, other, *more):
        before, after = self.view(verb, self.path, *more), self.view(verb, other, *more)
        self.c.check("%s: %s: the same %s" % (self.stem, what, verb), before == after, first_difference(before, after))


def first_difference(a, b, at=""):
    if type(a) is not type(b):
        return "%s: %r against %r" % (at, a, b)
    if isinstance(a, dict):
        for k in sorted(set(a) | set(b)):
            if a.get(k) != b.get(k):
                return first_difference(a.get(k), b.get(k), at + "/" + k)
    if isinstance(a, list):
        if len(a) != len(b):
            return "%s: %d against %d entries" % (at, len(a), len(b))
        for i, (x, y) in enumerate(zip(a, b)):
            if x != y:
                return first_difference(x, y, "%s/%d" % (at, i))
    return "%s: %r against %r" % (at, a, b)


def geometry(deck, what, other):
    """Contacts with all their segments, and the effective values."""
    deck.same(what, "params", other)
    deck.same(what, "gaps", other, "--all")


def conversions(deck, tmp):
    flat = deck.convert(deck.path, "--flatten")
    if flat:
        geometry(deck, "--flatten", flat)
    resolved = deck.convert(deck.path, "--resolve-defaults")
    if resolved:
        deck.same("--resolve-defaults", "params", resolved)
        again = deck.convert(resolved, "--resolve-defaults")
        deck.c.check("%s: --resolve-defaults twice changes nothing" % deck.stem,
                     again is not None and open(again, "rb").read() == open(resolved, "rb").read())
    apart = deck.convert(deck.path, "--expand-type19")
    if apart:
        deck.c.check("%s: --expand-type19: as many penetrations" % deck.stem,
                     penetrations(deck.view("gaps", deck.path, "--all")) == penetrations(deck.view("gaps", apart, "--all")))
    original = deck.c.run("params", deck.path, "--json", "-", "--quiet")
    version = json.loads(original.out)["deck"]["version"] if original.code in (0, 1) else None
    for to in EVERY_VERSION if deck.c.options.all else deck.some_of(VERSIONS):
        there = deck.convert(deck.path, "--version", str(to)) if version and version != to else None
        if there:
            deck.same("--version %d" % to, "params", there)
            # Older versions than these are read, not written.
            back = deck.convert(there, "--version", str(version)) if version >= EVERY_VERSION[0] else None
            if back:
                geometry(deck, "--version %d and back" % to, back)
    units(deck)
    extraction(deck)


def penetrations(document):
    """Every penetration of a deck with its depth and gap, whichever interface it belongs to."""
    if isinstance(document, str):
        return document
    found = []
    for interface in document["interfaces"]:
        for contact in interface["contacts"]:
            for p in contact["penetrations"]:
                found.append(json.dumps([p.get("node"), p.get("segment"), p.get("edge"), p.get("main_edge"),
                                         p["penetration"], p["gap"], p["action"]]))
    return sorted(found)


def units(deck):
    head = json.loads(deck.c.run("params", deck.path, "--json", "-", "--quiet").out)["deck"].get("units") or {}
    system = head.get("input")
    if not system:
        return
    own = "%s,%s,%s" % (system["mass"], system["length"], system["time"])
    for target in deck.some_of(("Mg,mm,s", "kg,m,s", "g,mm,ms")):
        there = deck.convert(deck.path, "--units", target, "--partial") if target != own else None
        back = deck.convert(there, "--units", own, "--partial") if there else None
        if back:
            geometry(deck, "--units %s and back" % target, back)


def extraction(deck):
    whole = deck.view("gaps", deck.path, "--all")
    values = deck.view("params", deck.path)
    if isinstance(whole, str) or isinstance(values, str):
        return
    ids = [i["id"] for i in values["interfaces"] if i["type"] in (7, 10, 11, 19)]  # of contacts with forces
    for one in ids[:3] + ids[3:][-1:] if deck.c.options.all else ids[-1:]:
        small = deck.convert(deck.path, "--extract-contacts", str(one))
        if not small:
            continue
        for verb, document, more in (("params", values, ()), ("gaps", whole, ("--all",))):
            part = deck.view(verb, small, *more)
            if isinstance(part, str):
                deck.c.check("%s: extracted %s" % (deck.stem, one), False, part)
                continue
            expected = [i for i in document["interfaces"] if i["id"] == one]
            deck.c.check("%s: --extract-contacts %s: the same %s" % (deck.stem, one, verb),
                         part["interfaces"] == expected, first_difference(expected, part["interfaces"]))


def one(job):
    """One deck through everything; returns the counts."""
    stem, path = job
    c = Checks()
    with tempfile.TemporaryDirectory(prefix="deck-conversions-") as work:
        conversions(Deck(c, stem, path, work), work)
    return c.passed, c.failed


def main():
    c = Checks()
    decks = c.all_decks()
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        for passed, failed in pool.map(one, reversed(decks)):  # the largest first
            c.passed += passed
            c.failed += failed
    c.finish()


if __name__ == "__main__":
    main()
