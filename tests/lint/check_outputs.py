#!/usr/bin/env python3
"""deck lint on a deck with every mistake: a baseline hides all of them, fixes end and are patches, and every format has
what the JSON of the same run has. Schemas and SARIF are checked in tests/robustness/outputs.py.

    python3 tests/lint/check_outputs.py build/dev/tools/deck"""
import json
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, Checks, run_steps  # noqa: E402

MISTAKES = os.path.join(ROOT, "samples", "every_mistake_0000.rad")
CLEAN = os.path.join(ROOT, "samples", "clean_plates_0000.rad")


class Lint(Checks):
    def run(self, *args, cwd=None, stdin=None):
        """As text, unlike the others' run()."""
        env = dict(os.environ, NO_COLOR="1")
        return subprocess.run([self.program, *args], cwd=cwd, input=stdin, capture_output=True, text=True, env=env,
                              stdin=None if stdin is not None else subprocess.DEVNULL, timeout=120)


def lint(c, *args, **kw):
    r = c.run("lint", "--format", "json", *args, **kw)
    try:
        return r, json.loads(r.stdout)
    except ValueError:
        return r, None


def baseline(c, tmp):
    deck = os.path.join(tmp, "base_0000.rad")
    with open(MISTAKES, encoding="utf-8") as f:
        mistakes = f.read()
    with open(deck, "w", encoding="utf-8") as f:
        f.write(mistakes.replace(" nan", " 0.0"))  # a contact that cannot be evaluated fails in spite of a baseline
    file = os.path.join(tmp, "baseline.json")
    c.run("lint", deck, "--write-baseline", file, "--fail-on", "never")
    r, d = lint(c, deck, "--baseline", file)
    c.check("baseline hides every finding", r.returncode == 0 and not d["diagnostics"] and d["summary"]["baselined"] > 50, d["summary"])


def fixes(c, tmp):
    repo = os.path.join(tmp, "fix")
    os.makedirs(repo)
    deck = os.path.join(repo, "x_0000.rad")
    shutil.copy(MISTAKES, deck)
    before = open(deck, "rb").read()
    patch = c.run("lint", "x_0000.rad", "--diff", cwd=repo).stdout
    c.check("--diff writes nothing", open(deck, "rb").read() == before)
    _, d = lint(c, "x_0000.rad", cwd=repo)
    safe = sum(1 for x in d["diagnostics"] if x["fix"] and x["fix"]["safe"])
    c.check("there are safe fixes to test", safe > 2, safe)
    r = c.run("lint", "x_0000.rad", "--fix", cwd=repo)
    fixed = open(deck, "rb").read()
    c.check("--fix changes the file and still reports the rest", fixed != before and r.returncode == 1)
    _, d = lint(c, "x_0000.rad", cwd=repo)
    left = [x["rule"] for x in d["diagnostics"] if x["fix"] and x["fix"]["safe"]]
    c.check("no safe fix is left after --fix", not left, left)
    if shutil.which("git") is None:
        c.skip("git apply", "git is not installed")
        return
    open(deck, "wb").write(before)
    g = subprocess.run(["git", "apply", "-"], cwd=repo, input=patch, capture_output=True, text=True)
    c.check("the patch, by git, does what --fix does", g.returncode == 0 and open(deck, "rb").read() == fixed, g.stderr)
    r = c.run("lint", "-", "--fix", stdin=before.decode("utf-8", "replace"))
    c.check("--fix refuses standard input", r.returncode == 2, r.stderr)


def outputs(c, tmp):
    paths = {k: os.path.join(tmp, "all." + k) for k in ("json", "sarif", "junit", "github", "gitlab", "human")}
    r = c.run("lint", MISTAKES, CLEAN, *[a for k, v in paths.items() for a in ("-o", k + "=" + v)])
    c.check("six formats at once", r.returncode == 1 and all(os.path.getsize(p) > 0 for p in paths.values()), r.stderr)
    documents = json.load(open(paths["json"]))["decks"]
    findings = [x for d in documents for x in d["diagnostics"]]
    sarif = json.load(open(paths["sarif"]))["runs"][0]
    rules = [x["id"] for x in sarif["tool"]["driver"]["rules"]]
    table = json.loads(c.run("rules", "--json", "-").stdout)["rules"]
    c.check("SARIF holds every rule", rules == [x["id"] for x in table], len(rules))
    c.check("SARIF has the findings of the JSON", [x["ruleId"] for x in sarif["results"]] == [x["rule"] for x in findings])
    for result, x in zip(sarif["results"], findings):
        place = result["locations"][0]["physicalLocation"]
        region = place.get("region", {"startLine": 1, "startColumn": 1})
        if (region["startLine"], rules[result["ruleIndex"]]) != (x["line"], x["rule"]):
            c.check("SARIF place of " + x["rule"], False, region)
            break
    else:
        c.check("SARIF places", True)
    c.check("SARIF paths are relative when the deck's is",
            json.loads(c.run("lint", "samples/every_mistake_0000.rad", "--format", "sarif", cwd=ROOT).stdout)
            ["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
            == "samples/every_mistake_0000.rad")
    commands = open(paths["github"]).read().splitlines()
    order = ["::error", "::warning", "::notice"]
    ranks = [order.index(re.match(r"::\w+", x).group(0)) for x in commands]
    c.check("GitHub commands, worst first", len([x for x in commands if ",title=not examined::" not in x]) == len(findings) and ranks == sorted(ranks))
    gitlab = json.load(open(paths["gitlab"]))
    c.check("GitLab fingerprints are unique", len({x["fingerprint"] for x in gitlab}) == len(gitlab) == len(findings))
    lines = {}
    for x in findings:
        text = lines.setdefault(x["file"], open(x["file"], "rb").read().split(b"\n"))
        width = len(text[x["line"] - 1]) + 1
        if not 1 <= x["column"] <= x["end_column"] <= width + 1:
            c.check("columns of %s %s:%d" % (x["rule"], x["file"], x["line"]), False, (x["column"], x["end_column"], width))
    c.check("findings are ordered", all([(x["line"], x["column"]) for x in d["diagnostics"]]
                                        == sorted((x["line"], x["column"]) for x in d["diagnostics"]) for d in documents))


if __name__ == "__main__":
    run_steps(baseline, fixes, outputs, checks=Lint)
