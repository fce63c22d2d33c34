#!/usr/bin/env python3
"""Pages of rules claim about the reference solver only what is known, and are written in sentences.

A page whose section "What the reference solver does" makes a claim says in `known_from` what shows it; without a source the
section begins "Not known" (deck's advice follows) or "Nothing" (the rule is about deck alone). Where the notes on the solver and
its recorded runs are beside the project (DECK_CORPUS), the sections and messages that pages name are looked for there.

    python3 tests/lint/check_rule_pages.py [--table]"""
import collections
import glob
import gzip
import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count  # noqa: E402

CORPUS = os.environ.get("DECK_CORPUS") or os.path.join(ROOT, "..", "shared")
SOLVER = "What the reference solver does"
TEXTS = ["What is wrong", "Why it matters", SOLVER, "How to fix", "When to ignore"]
NO_CLAIM = ("Not known", "Nothing")


def page(path):
    head, body = open(path, encoding="utf-8").read().split("\n---\n", 1)
    keys = dict(line.split(": ", 1) for line in head.split("\n")[1:] if ": " in line)
    rows = [line.strip("| ").split("|") for line in body.splitlines() if line.startswith("| ")]
    body = re.sub(r"^\|.*\n", "", body, flags=re.M)
    sections = {m.group(1): " ".join(m.group(2).split())
                for m in re.finditer(r"^- \*\*(.*?)\.\*\*\s(.*?)(?=\n- \*\*|\s*\Z)", body, re.S | re.M)}
    for row in rows[1:]:
        sections.update({"%s, column %d" % (row[0].strip(), n): cell.strip() for n, cell in enumerate(row[1:], 2) if cell.strip()})
    return keys, sections


def sources(keys):
    return [s.strip() for s in keys.get("known_from", "").split(";") if s.strip()]


def wrong_words(keys, sections):
    """What is wrong with a page by itself."""
    claim = sections.get(SOLVER, "")
    if not sources(keys) and not claim.startswith(NO_CLAIM):
        yield "claims '%s' without a source (known_from)" % claim[:60]
    for name, text in sections.items():
        if name not in TEXTS and ", column" not in name:
            continue
        name_first = re.match(r"deck\b|[a-z]+_|%|dtmin", text)  # the program, or a field
        if text[0].islower() and not name_first:
            yield "'%s' does not begin with a capital: %s" % (name, text[:40])
        if not text.endswith((".", "!", "?")):
            yield "'%s' does not end with a full stop: %s" % (name, text[-40:])
    if sections.get("When to ignore", "").startswith("Never."):
        yield "'When to ignore' is left out where the answer is 'never'"


def recorded_messages(corpus):
    """severity and number of every message that a recorded run or listing holds; None: no records there."""
    out = set()
    for path in glob.glob(os.path.join(corpus, "oracle", "verdicts*", "verdicts.json.gz")):
        for run in json.load(gzip.open(path))["mutants"]:
            out |= {("error", int(n)) for n in run["errors"]} | {("warning", int(n)) for n in run["warnings"]}
    for path in glob.glob(os.path.join(corpus, "oracle", "published", "messages.json")):
        text = open(path).read()
        out |= {(s, int(n)) for s, n in re.findall(r'"(error|warning)",\s*(\d+)', text, re.I)}
        out |= {(s.lower(), int(n)) for s, n in re.findall(r'"(ERROR|WARNING|Error|Warning)",\s*(\d+)', text)}
    return out or None


def missing_source(source, corpus, messages):
    """Why a source cannot be found beside the project; empty: it is there, or nobody can say."""
    kind, rest = source.split(" ", 1)
    if kind in ("run", "listing") and messages is not None:
        m = re.fullmatch(r"(error|warning) (\d+)", rest)
        if m and (m.group(1), int(m.group(2))) not in messages:
            return "no record of this message"
    if kind == "specification" and os.path.isdir(os.path.join(corpus, "spec")):
        name, section = rest.split(" ", 1)
        path = os.path.join(corpus, "spec", name + ".md")
        if not os.path.exists(path):
            return "no such specification"
        if not re.search(r"^#*\s*(\*\*)?%s(?![\w.]*\d)[\s.*]" % re.escape(section), open(path).read(), re.M):
            return "no section " + section
    return ""


def main():
    c, kinds = Count(), collections.Counter()
    messages = recorded_messages(CORPUS)
    for path in sorted(glob.glob(os.path.join(ROOT, "schemas", "rules", "*.md"))):
        keys, sections = page(path)
        found = list(wrong_words(keys, sections))
        for source in sources(keys):
            why = missing_source(source, CORPUS, messages)
            if why:
                found.append("'%s': %s" % (source, why))
        c.check(os.path.basename(path), not found, "; ".join(found))
        of = [s.split(" ", 1)[0] for s in sources(keys)]
        kinds.update(set(of) or {"no claim" if sections[SOLVER].startswith(NO_CLAIM) else "no source"})
    if "--table" in sys.argv:
        for kind, count in kinds.most_common():
            print("%-14s %4d pages" % (kind, count))
    c.finish()


if __name__ == "__main__":
    main()
