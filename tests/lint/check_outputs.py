#!/usr/bin/env python3
"""deck lint as its users call it: exit codes, settings, suppressions, baseline, fixes and patches.
Schemas and SARIF are checked in tests/robustness/outputs.py; here every SARIF is compared with the
JSON of the same run.

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


def card(**fields):
    """A TYPE7 of version 2022 with the given cells; the deck around it needs no model."""
    cells = {"grnd": (0, 1, 10), "surf": (0, 11, 20), "Istf": (0, 21, 30), "Stfac": (3, 1, 20), "Fric": (3, 21, 40),
             "fric_ID": (5, 91, 100)}
    lines = [""] * 6
    for name, value in dict({"surf": "1"}, **fields).items():
        row, first, last = cells[name]
        lines[row] = lines[row].ljust(first - 1) + value.rjust(last - first + 1)
    units = "                  kg                  mm                  ms\n"
    return ("#RADIOSS STARTER\n/BEGIN\ntest\n      2022         0\n" + units * 2 + "/SURF/SEG/1\nsurface\n"
            "         1         1         2         3         4\n/NODE\n"
            + "".join("%10d%20.1f%20.1f%20.1f\n" % n for n in ((1, 0, 0, 0), (2, 9, 0, 0), (3, 9, 9, 0), (4, 0, 9, 0)))
            + "/INTER/TYPE7/1\ntest\n" + "\n".join(lines) + "\n/END\n")


def exit_codes(c, tmp):
    c.check("clean deck: 0", c.run("lint", CLEAN).returncode == 0)
    c.check("errors: 1", c.run("lint", MISTAKES).returncode == 1)
    c.check("--fail-on never: 0", c.run("lint", MISTAKES, "--fail-on", "never").returncode == 0)
    warning = os.path.join(tmp, "warning_0000.rad")
    open(warning, "w").write(card(Fric="20.0"))
    c.check("warnings: 0", c.run("lint", warning, "--select", "DK2").returncode == 0)
    c.check("warnings with --fail-on warning: 1",
            c.run("lint", warning, "--select", "DK2", "--fail-on", "warning").returncode == 1)
    c.check("unknown rule: 2", c.run("lint", CLEAN, "--select", "DK777").returncode == 2)
    c.check("unknown format: 2", c.run("lint", CLEAN, "--format", "yaml").returncode == 2)
    c.check("-o without file: 2", c.run("lint", CLEAN, "-o", "sarif").returncode == 2)
    c.check("missing baseline: 2", c.run("lint", CLEAN, "--baseline", os.path.join(tmp, "no")).returncode == 2)
    c.check("missing deck: 3", c.run("lint", os.path.join(tmp, "no_0000.rad")).returncode == 3)
    gone = os.path.join(tmp, "gone_0000.rad")
    open(gone, "w").write(card().replace("/END\n", "#include nowhere.inc\n/END\n"))
    r = c.run("lint", gone)
    c.check("missing include: 3, with its name", r.returncode == 3 and "nowhere.inc" in r.stdout, r.stdout[-300:])


def configuration(c, tmp):
    folder = os.path.join(tmp, "project", "decks")
    os.makedirs(folder)
    deck = os.path.join(folder, "x_0000.rad")
    open(deck, "w").write(card(fric_ID="77"))
    c.check("without configuration: 1", c.run("lint", deck).returncode == 1)
    settings = os.path.join(tmp, "project", ".decklint.toml")
    open(settings, "w").write('ignore = ["DK177"]\n')
    _, d = lint(c, deck)
    c.check("configuration above the deck", all(x["rule"] != "DK177" for x in d["diagnostics"]))
    r = c.run("lint", deck, "--no-config")
    c.check("--no-config", r.returncode == 1)
    open(settings, "w").write('[severity]\nDK177 = "info"\n')
    c.check("severity from the configuration", c.run("lint", deck, "--no-geometry").returncode == 0)
    open(settings, "w").write('ignore = "DK177"\n')
    r = c.run("lint", deck)
    c.check("wrong configuration: 2, with file and line", r.returncode == 2 and ".decklint.toml:1" in r.stderr, r.stderr)


def baseline(c, tmp):
    deck = os.path.join(tmp, "base_0000.rad")
    with open(MISTAKES, encoding="utf-8") as f:
        mistakes = f.read()
    with open(deck, "w", encoding="utf-8") as f:
        f.write(mistakes.replace(" nan", " 0.0"))  # a contact that cannot be evaluated fails in spite of a baseline
    file = os.path.join(tmp, "baseline.json")
    c.run("lint", deck, "--write-baseline", file, "--fail-on", "never")
    r, d = lint(c, deck, "--baseline", file)
    c.check("baseline hides every finding", r.returncode == 0 and not d["diagnostics"] and d["summary"]["baselined"] > 50,
            d["summary"])
    text = open(deck).read()
    open(deck, "w").write(text.replace("/MAT/ELAST/1", "# one line more\n/MAT/ELAST/1", 1))
    r, d = lint(c, deck, "--baseline", file)
    c.check("baseline survives moved lines", r.returncode == 0 and not d["diagnostics"])
    open(deck, "w").write(text.replace("\n/END\n", "\n/INTER/TYPE4/9999\nnew\n/END\n", 1))
    r, d = lint(c, deck, "--baseline", file)
    c.check("a new finding shows", r.returncode == 1 and any(x["rule"] == "DK044" for x in d["diagnostics"]))


def fixes(c, tmp):
    repo = os.path.join(tmp, "fix")
    os.makedirs(repo)
    deck = os.path.join(repo, "x_0000.rad")
    shutil.copy(MISTAKES, deck)
    before = open(deck, "rb").read()
    r = c.run("lint", "x_0000.rad", "--diff", cwd=repo)
    c.check("--diff writes nothing", open(deck, "rb").read() == before)
    c.check("--diff prints a patch", r.stdout.startswith("--- a/x_0000.rad\n+++ b/x_0000.rad\n@@ "), r.stdout[:200])
    patch = r.stdout
    _, d = lint(c, "x_0000.rad", cwd=repo)
    safe = sum(1 for x in d["diagnostics"] if x["fix"] and x["fix"]["safe"])
    c.check("there are safe fixes to test", safe > 2, safe)
    r = c.run("lint", "x_0000.rad", "--fix", cwd=repo)
    fixed = open(deck, "rb").read()
    c.check("--fix changes the file and still reports the rest", fixed != before and r.returncode == 1)
    _, d = lint(c, "x_0000.rad", cwd=repo)
    left = [x["rule"] for x in d["diagnostics"] if x["fix"] and x["fix"]["safe"]]
    c.check("no safe fix is left after --fix", not left, left)
    c.check("a second --fix changes nothing",
            c.run("lint", "x_0000.rad", "--fix", cwd=repo).returncode == 1 and open(deck, "rb").read() == fixed)
    c.check("no temporary file is left", os.listdir(repo) == ["x_0000.rad"], os.listdir(repo))
    if shutil.which("git") is None:
        c.skip("git apply", "git is not installed")
        return
    open(deck, "wb").write(before)
    g = subprocess.run(["git", "apply", "-"], cwd=repo, input=patch, capture_output=True, text=True)
    c.check("the patch applies with git", g.returncode == 0, g.stderr)
    c.check("the patch does what --fix does", open(deck, "rb").read() == fixed)
    before = open(deck, "rb").read()
    patch = c.run("lint", "x_0000.rad", "--unsafe-fixes", "--diff", cwd=repo).stdout
    g = subprocess.run(["git", "apply", "-"], cwd=repo, input=patch, capture_output=True, text=True)
    c.check("the unsafe patch applies with git", g.returncode == 0 and open(deck, "rb").read() != before, g.stderr)
    r = c.run("lint", "-", "--fix", stdin=card(Fric="20.0").replace("/END\n", ""))
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
    run_steps(exit_codes, configuration, baseline, fixes, outputs, checks=Lint)
