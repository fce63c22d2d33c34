#!/usr/bin/env python3
"""The gate from end to end: bounds on the command line and in .decklint.toml, what is accepted. gate_verb_test.cpp has
its formats."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, Checks, moved, write  # noqa: E402

DECK = "too_close_0000.rad"  # nine nodes, 0.35 of a gap of 1.25


class Gate:
    def __init__(self, c, folder):
        self.c, self.folder = c, folder
        with open(os.path.join(ROOT, "samples", DECK)) as f:
            self.text = f.read()
        self.deck = os.path.join(folder, DECK)
        write(self.deck, self.text)

    def run(self, *args):
        return self.c.run(*args, cwd=self.folder)

    def expect(self, name, code, *args, rules=()):
        r = self.run(*args)
        said = set(re.findall(r"\[(DK37\d)\]", r.err.decode() + r.out.decode()))
        self.c.check(name, r.code == code and set(rules) <= said, "exit %s, expected %d; said %s; %s" % (r.code, code, said, r.err.decode()[-400:]))
        return r

    def bounds(self):
        e = self.expect
        e("a bound of no penetration at all is one", 1, "gaps", DECK, "--max-count", "0", rules=["DK372"])
        e("--fail-on never leaves the bounds that were asked for", 1, "gaps", DECK, "--fail-on", "never", "--max-depth", "0.1", rules=["DK370"])
        e("--fail-on warning stops at any penetration", 1, "gaps", DECK, "--fail-on", "warning")
        e("--fail-on never stops at none", 0, "gaps", os.path.join(ROOT, "samples", "crash_box_0000.rad"), "--fail-on", "never")
        r = self.run("cycle", DECK, "--json", "-")
        d = json.loads(r.out)["dt"]
        loss = 1 - d["contact"] / d["structure"] if d["contact"] and d["contact"] < d["structure"] else 0
        self.c.check("the sample's contact costs time step", loss > 0, "loss %s" % loss)
        for verb in ("cycle", "gaps"):
            e("%s: a loss of time step above the bound is stopped" % verb, 1, verb, DECK, "--max-dt-loss", loss * 0.999, rules=["DK373"])
            e("%s: a loss of time step below the bound passes" % verb, 0, verb, DECK, "--max-dt-loss", min(1, loss * 1.001))
        e("cycle takes bounds of penetrations, too", 1, "cycle", DECK, "--max-depth", "0.1", rules=["DK370"])

    def undecided(self):
        """What could not be evaluated has not passed, whatever else is asked for."""
        self.run("gaps", DECK, "--json", "old.json")
        group = re.search(r"/GRNOD/PART/(\d+)", self.text).group(1)
        places = "".join("%10d%20d%20d%20d\n" % (0, *xyz) for xyz in ((0, 0, 0), (1, 0, 0), (0, 1, 0)) * 2)
        write(self.deck, self.text.replace("\n/END", "\n/TRANSFORM/POSITION/1\nunknown to deck\n%10s\n%s/END" % (group, places), 1))
        codes = {verb: self.run(verb, DECK, *more).code for verb, *more in (("lint",), ("gaps",), ("cycle",), ("gate", "--compare", "old.json"))}
        self.c.check("every verb ends with 1 where a contact could not be evaluated", set(codes.values()) == {1}, codes)
        r = self.run("gate", DECK, "--max-depth", "1", "--compare", "old.json", "--json", "-")
        found = json.loads(r.out)
        self.c.check("nothing is solved in it", not found["passed"] and found["undecided"] == 1 and found["compared"]["solved"] == 0, str(found)[:400])
        write(self.deck, self.text)

        for verb in ("gaps", "cycle"):
            r = self.run(verb, DECK, "--max-memory", "1b", "--max-depth", "100", "--fail-on", "never", "--json", "-")
            gate = json.loads(r.out)["gate"]
            self.c.check("%s: a contact that could not be evaluated has not passed" % verb,
                         r.code == 1 and not gate["passed"] and gate["undecided"] == 1, "exit %s, %s" % (r.code, gate))

        # Of members that were left out for want of memory nobody knows whether they are none.
        box = os.path.join(ROOT, "samples", "crash_box_0000.rad")
        for args in (("gaps", box), ("cycle", box), ("lint", box)):
            r = self.run(*args, "--max-memory", "1b", "--no-config")
            text = (r.out + r.err).decode()
            self.c.check("%s: a group beyond --max-memory is not called empty" % " ".join(args[::2]),
                         r.code == 1 and "DK332" in text and not re.search(r"is empty|has no (node|edge)|no edges|No initial penetration in [1-9]", text), text[-900:])

        mistakes = os.path.join(ROOT, "samples", "every_mistake_0000.rad")
        for verb in ("gaps", "cycle"):
            self.expect("%s: a contact whose main surface does not exist is not clean" % verb, 1, verb, mistakes, "--interface", "1")
            self.expect("%s: --fail-on never leaves it" % verb, 0, verb, mistakes, "--interface", "1", "--fail-on", "never")

        r = self.run("gaps", mistakes, "--interface", "1", "--json", "-")
        names = [c["obstacle"] for i in json.loads(r.out)["interfaces"] if i["id"] == 1 for c in i["contacts"]]
        self.c.check("the document names why nothing was examined", names == ["empty_main"], names)

    def documents(self):
        r = self.run("gaps", DECK, "--max-depth", "0.1", "--json", "-")
        gate = json.loads(r.out)["gate"]
        self.c.check("JSON tells what was not passed", not gate["passed"] and [f["rule"] for f in gate["findings"]] == ["DK370"] and
                     gate["findings"][0]["entity"] == {"keyword": "/INTER/TYPE7", "id": 1}, str(gate))
        r = self.run("gaps", DECK, "--max-depth", "1", "--json", "-")
        self.c.check("JSON tells what was passed", json.loads(r.out)["gate"] == {"passed": True, "undecided": 0, "findings": []})
        r = self.run("gaps", DECK, "--json", "-")
        self.c.check("without a gate JSON has none", json.loads(r.out)["gate"] is None and json.loads(r.out)["compared"] is None)
        r = self.run("lint", DECK, "--max-depth", "0.1", "--fail-on", "never", "--format", "json", "-o", "junit=out.junit")
        with open(os.path.join(self.folder, "out.junit")) as g:
            self.c.check("lint ends with 1 beyond a bound, and its documents have the finding", r.code == 1 and "DK370" in g.read() and
                         any(d["rule"] == "DK370" for d in json.loads(r.out)["diagnostics"]))

    def usage(self):
        for name, args in (("an unknown word", ("gaps", DECK, "--fail-on", "sometimes")),
                           ("two levels", ("gaps", DECK, "--fail-on", "error,never")),
                           ("new without anything to compare with", ("gaps", DECK, "--fail-on", "new")),
                           ("a negative bound", ("gaps", DECK, "--max-depth", "-1")),
                           ("a ratio in percent, which nothing would exceed", ("gaps", DECK, "--max-ratio", "28")),
                           ("never beside --fail-on-penetration", ("gaps", DECK, "--fail-on-penetration", "--fail-on", "never")),
                           ("two results in one file", ("gaps", DECK, "--csv", "x.out", "--json", "./x.out")),
                           ("two results on standard output", ("params", DECK, "--csv", "-", "--json", "-")),
                           ("bounds for lint with --no-geometry", ("lint", DECK, "--max-depth", "1", "--no-geometry")),
                           ("--geometry beside --no-geometry", ("lint", DECK, "--geometry", "--no-geometry")),
                           ("a file to compare with that is no such document", ("gaps", DECK, "--compare", DECK))):
            r = self.run(*args)
            self.c.check("%s is wrong usage" % name, r.code == 2 and r.err.strip(), "exit %s" % r.code)
        self.c.check("nothing was written then", not os.path.exists(os.path.join(self.folder, "x.out")))
        r = self.run("gaps", DECK, "--csv", os.devnull, "--json", os.devnull)
        self.c.check("a device takes more than one result", r.code == 0, r.err.decode())
        write(os.path.join(self.folder, "bad.toml"), "[gate]\nmax-depth = \"deep\"\n")
        r = self.run("gaps", DECK, "--config", "bad.toml")
        self.c.check("a wrong configuration is refused with its line", r.code == 2 and re.search(rb"bad.toml:\d+", r.err), r.err.decode())

    def configuration(self):
        path = os.path.join(self.folder, ".decklint.toml")
        cases = (("[gate] holds", "[gate]\nmax-depth = 0.1\n", 1), ("an option goes before [gate]", "[gate]\nmax-depth = 0.1\n", 0, "--max-depth", "1"),
                 ("--no-config leaves it out", "[gate]\nmax-depth = 0.1\n", 0, "--no-config"),
                 ("a bound of the interface goes before the general one", "[gate]\nmax-depth = 0.1\n[[gate.interface]]\nmatch = \"1\"\nmax-depth = 0.5\n", 0),
                 ("a bound of another interface does not", "[gate]\nmax-depth = 0.1\n[[gate.interface]]\nmatch = \"2\"\nmax-depth = 0.5\n", 1),
                 ("an interface is known by its title", "[[gate.interface]]\nmatch = \"*on lower\"\nmax-depth = 0.1\n", 1),
                 ("a bound of the parts goes before that of the interface",
                  "[[gate.interface]]\nmatch = \"*\"\nmax-depth = 0.1\n[[gate.part-pair]]\nmatch = [\"lower*\", \"2\"]\nmax-depth = 0.5\n", 0),
                 ("the parts count either way round", "[[gate.part-pair]]\nmatch = [\"upper plate\", \"lower plate\"]\nmax-count = 8\n", 1),
                 ("other parts do not count", "[[gate.part-pair]]\nmatch = [\"upper plate\", \"upper plate\"]\nmax-count = 0\n", 0))
        for name, text, code, *args in cases:
            write(path, text)
            self.expect(name, code, "gaps", DECK, *args)
        os.remove(path)

    def baseline(self):
        """Penetrations that are accepted, by deck, wherever the program is called."""
        bound = ("--fail-on", "warning")
        self.expect("without a baseline any penetration stops", 1, "gaps", DECK, *bound)
        self.expect("writing a baseline accepts what is there", 0, "gaps", DECK, "--write-baseline", "base.json", *bound)
        self.expect("what is in the baseline is accepted", 0, "gaps", DECK, "--baseline", "base.json")
        r = self.c.run("gaps", os.path.join(os.path.basename(self.folder), DECK), "--baseline", os.path.join(self.folder, "base.json"),
                       cwd=os.path.dirname(self.folder))
        self.c.check("a baseline knows its decks from any directory", r.code == 0, r.text[-300:])
        shutil.copyfile(self.deck, os.path.join(self.folder, "other_0000.rad"))
        self.expect("a deck that is not in the baseline has nothing accepted", 1, "gaps", "other_0000.rad", "--baseline", "base.json", rules=["DK374"])
        for args in (("gaps", "--fail-on", "never"), ("cycle",), ("lint",)):
            write(os.path.join(self.folder, ".decklint.toml"), "[gate]\nbaseline = \"base.json\"\n")
            notes = [self.run(*args, deck, *more).err.decode() for deck, more in
                     (("other_0000.rad", ()), (DECK, ()), ("other_0000.rad", ("--quiet",)))]
            self.c.check("%s says that a baseline holds nothing of a deck, and of which it does" % args[0],
                         ["note: " in n for n in notes] == [True, False, False] and
                         "other_0000.rad: note: base.json has no entry for this deck, but of %s" % DECK in notes[0].replace(self.folder + "/", ""), str(notes))
        os.remove(os.path.join(self.folder, ".decklint.toml"))
        self.run("lint", DECK, "--write-baseline", "lint.json", "--quiet")
        notes = [self.run("lint", deck, "--baseline", "lint.json").err.decode() for deck in ("other_0000.rad", DECK)]
        self.c.check("so says lint", "note: lint.json has no entry for this deck" in notes[0] and DECK in notes[0] and not notes[1], str(notes))
        self.expect("several decks have one baseline", 0, "gaps", DECK, "other_0000.rad", "--write-baseline", "both.json")
        self.expect("of which each has its own", 0, "gaps", "other_0000.rad", DECK, "--baseline", "both.json")
        self.expect("a bound counts all the same", 1, "gaps", DECK, "--baseline", "base.json", "--max-depth", "0.1", rules=["DK370"])
        self.expect("a level that is asked for, too", 1, "gaps", DECK, "--baseline", "base.json", *bound)
        self.expect("a baseline and --compare are wrong usage together", 2, "gaps", DECK, "--baseline", "base.json", "--compare", "base.json")
        write(self.deck, moved(self.text, 105, "0.8"))
        self.expect("what is deeper than accepted stops", 1, "gaps", DECK, "--baseline", "base.json", rules=["DK375"])
        write(os.path.join(self.folder, ".decklint.toml"), "[gate]\nbaseline = \"base.json\"\n")
        self.expect("[gate] baseline: the same", 1, "gaps", DECK, rules=["DK375"])
        self.expect("[gate] baseline: lint, too", 1, "lint", DECK, "--fail-on", "never", rules=["DK375"])
        write(self.deck, moved(self.text, 105, "1.0"))
        self.expect("what is less deep passes", 0, "gaps", DECK)
        os.remove(os.path.join(self.folder, ".decklint.toml"))
        write(self.deck, self.text)


# What could be thought to switch a gate off, by name: keys of .decklint.toml, and those that are no such key.
TRIES = {"select": 'select = ["DK0"]\n', "ignore": 'ignore = ["DK3", "DK370"]\n', "fail-on": 'fail-on = "never"\n', "geometry": "geometry = true\n",
         "baseline": 'baseline = "lint-baseline.json"\n', "severity": '[severity]\nDK37 = "info"\nDK370 = "info"\n',
         "per-file-ignores": '[per-file-ignores]\n"*.rad" = ["DK3"]\n', "comment": "", "nearest": ""}


def nothing_disarms_a_gate(c):
    """All combinations of what could be thought to do so, a deck each: every verb says of every deck that it has not passed."""
    with open(os.path.join(ROOT, "samples", DECK)) as f:
        text = f.read()
    with tempfile.TemporaryDirectory(prefix="deck-gate-") as folder:
        decks = {}
        for number in range(1 << len(TRIES)):
            chosen = [name for k, name in enumerate(TRIES) if number >> k & 1]
            path = os.path.join(folder, "d%03d" % number, "deep" if "nearest" in chosen else "")
            deck = os.path.join(path, "car_0000.rad")
            comment = "# decklint: ignore-file[DK370,DK3] reason=known\n" if "comment" in chosen else ""
            write(deck, text.replace("\n", "\n" + comment, 1))
            top = os.path.join(folder, "d%03d" % number)
            write(os.path.join(top, ".decklint.toml"), "".join(TRIES[n] for n in chosen if not TRIES[n].startswith("[")) +
                  "".join(TRIES[n] for n in chosen if TRIES[n].startswith("[")) + "[gate]\nmax-depth = 0.1\n")
            if "baseline" in chosen:
                name = os.path.relpath(deck, top)
                write(os.path.join(top, "lint-baseline.json"), "".join(
                    json.dumps({"deck": name, "rule": rule, "file": name, "entity": "/INTER/TYPE7/1", "field": field, "value": None}, separators=(",", ":")) + "\n"
                    for rule, field in (("DK301", "Inacti"), ("DK370", ""))))
            decks[os.path.relpath(deck, folder)] = ", ".join(chosen) or "nothing"
        failed = set()
        for verb, passed in (("gate", lambda d: d["passed"]), ("gaps", lambda d: d["gate"]["passed"]), ("cycle", lambda d: d["gate"]["passed"]),
                             ("lint", lambda d: not any(f["rule"] == "DK370" and f["severity"] == "error" for f in d["diagnostics"]))):
            r = c.run(verb, ".", "--json", "all.json", "-q", cwd=folder)
            with open(os.path.join(folder, "all.json")) as f:
                documents = json.load(f)["decks"]
            c.check("%s looks at all of them and ends with 1" % verb, r.code == 1 and len(documents) == len(decks), "exit %s, %d" % (r.code, len(documents)))
            failed |= {"%s: %s" % (verb, decks[os.path.normpath(d["deck"]["path"])]) for d in documents if passed(d)}
        some = sorted(decks)[::4]  # a process each
        for verb in ("gaps", "cycle", "lint"):
            c.run("batch", "-o", "results-" + verb, "--verb", verb, "-q", *some, cwd=folder)
            with open(os.path.join(folder, "results-" + verb, "summary.json")) as f:
                lines = json.load(f)["decks"]
            c.check("batch of %s does all of them" % verb, len(lines) == len(some), len(lines))
            failed |= {"batch %s: %s" % (verb, decks[os.path.normpath(d["path"])]) for d in lines if d["exit_code"] != 1}
        c.check("nothing switches a gate off", not failed, "; ".join(sorted(failed)[:20]))


def settings_that_cannot_be_read(c):
    """The gate is never lost because nobody looked."""
    with tempfile.TemporaryDirectory(prefix="deck-gate-") as folder:
        shutil.copy(os.path.join(ROOT, "samples", DECK), folder)
        config = os.path.join(folder, ".decklint.toml")
        for name, make, undo in (("a dangling link", lambda: os.symlink("gone.toml", config), os.remove), ("a folder", lambda: os.mkdir(config), os.rmdir),
                                 ("a pipe", lambda: os.mkfifo(config), os.remove),
                                 ("geometry = false beside [gate]", lambda: write(config, "geometry = false\n[gate]\nmax-depth = 0.1\n"), os.remove)):
            make()
            codes = {verb: c.run(verb, DECK, cwd=folder).code for verb in ("lint", "gaps", "cycle", "gate")}
            c.check("%s: refused by every verb" % name, set(codes.values()) == {2}, codes)
            undo(config)
        write(config, "[gate]\nmax-depth = 0.1\n")
        c.check("--no-geometry in spite of a gate is refused", c.run("lint", DECK, "--no-geometry", cwd=folder).code == 2)


def samples_as_a_repository(c):
    """Whatever the decks are like today, the gate that is made of them lets them pass where all of them can be evaluated."""
    with tempfile.TemporaryDirectory(prefix="deck-gate-") as folder:
        shutil.copytree(os.path.join(ROOT, "samples"), os.path.join(folder, "models"))
        mistakes = os.path.join(folder, "models", "every_mistake_0000.rad")
        with open(mistakes, encoding="utf-8") as f:
            text = f.read()
        with open(mistakes, "w", encoding="utf-8") as f:
            f.write(text.replace(" nan", " 0.0"))  # a contact that cannot be evaluated lets nothing pass
        subprocess.run(["git", "-C", folder, "init", "-q"], check=True)
        r = c.run("gate", "models", "--init", cwd=folder)
        c.check("gate --init takes all samples", r.code == 0 and b"fewer than two commits" in r.out, r.text[-300:])
        r = c.run("gate", "models", cwd=folder)
        c.check("the gate made of the samples lets them pass", r.code == 0 and b"Gate: passed" in r.out, r.text[-900:])
        r = c.run("gate", "models", "--no-config", "--max-count", "0", cwd=folder)
        c.check("a bound without a baseline stops them", r.code == 1, r.text[-300:])


def main():
    c = Checks()
    samples_as_a_repository(c)
    nothing_disarms_a_gate(c)
    settings_that_cannot_be_read(c)
    with tempfile.TemporaryDirectory(prefix="deck-gate-") as folder:
        gate = Gate(c, folder)
        gate.bounds()
        gate.undecided()
        gate.documents()
        gate.usage()
        gate.configuration()
        gate.baseline()
    c.finish()


if __name__ == "__main__":
    main()
