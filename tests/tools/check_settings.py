#!/usr/bin/env python3
"""Settings and changed files: what --init writes holds every key and is legal, the page of the configuration has every key,
--show-config says what holds and where from, and --changed, which the pre-commit hook runs, finds the decks of an include."""
import gzip
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "tests", "robustness"))
from common import ROOT, run_steps, write  # noqa: E402

SAMPLE = os.path.join(ROOT, "samples", "too_close_0000.rad")


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as f:
        return f.read()


def keys_of(template):
    """{table: [key]} of what --init writes."""
    out, table = {}, ""
    for line in template.split("\n"):
        if m := re.fullmatch(r"# \[+([a-z.-]+)\]+", line):
            table = m.group(1)
        elif m := re.fullmatch(r"# (\S+) = .*", line):
            out.setdefault(table, []).append(m.group(1))
    return out


def init(c, tmp):
    r = c.run("lint", "--init", cwd=tmp)
    path = os.path.join(tmp, ".decklint.toml")
    if not c.check("--init writes .decklint.toml", r.code == 0 and os.path.exists(path), r.text):
        return
    template = read(path)
    r = c.run("lint", "--init", cwd=tmp)
    c.check("--init never writes over a file", r.code == 2 and "already" in r.text and read(path) == template, r.text)
    os.makedirs(os.path.join(tmp, "below"))
    r = c.run("lint", "--init", "below", cwd=tmp)
    c.check("--init takes a directory", r.code == 0 and read(tmp, "below", ".decklint.toml") == template, r.text)
    r = c.run("lint", "--init", "nowhere", cwd=tmp)
    c.check("--init of a directory that is not there is wrong usage", r.code == 2 and "nowhere" in r.text, r.text)
    r = c.run("lint", SAMPLE, "--config", path)
    c.check("what --init writes changes nothing", r.code == c.run("lint", SAMPLE, "--no-config").code, r.text)
    keys = keys_of(template)
    write(os.path.join(tmp, "all.toml"), re.sub(r"(?m)^# (?=[\[\w\"])", "", template.split("where they come from.\n")[1]))
    write(os.path.join(tmp, "rules", "X101.md"), "---\nid: X101\nname: a-rule\ntitle: \"t\"\nseverity: info\nwhen: 1\nat: Istf\nmessage: \"m\"\n---\n")
    r = c.run("lint", "--show-config", "--config", "all.toml", cwd=tmp)
    c.check("every example of --init is legal", r.code == 0, r.text[-300:])
    for table, names in keys.items():
        for name in names:
            shown = table if "." in table else (table + "." if table else "") + name
            c.check("--show-config names the line of %s" % shown, re.search(r"(?m)^  %s\S*  .*all\.toml:\d+$" % re.escape(shown), r.text), r.text)
    page = read(ROOT, "tools", "docs", "configuration.md")
    top = page.split("## Keys")[1].split("\n## ")[0]
    gate = page.split("## The gate")[1].split("\n## ")[0]
    for table, names in keys.items():
        if table in ("severity", "per-file-ignores"):
            names, section = ["[%s]" % table], top
        else:
            section = top if table == "" else gate
        for name in names:
            form = r"(?m)^\| `%s` \|" if table in ("", "gate", "severity", "per-file-ignores") else "`%s`"
            c.check("configuration.md has %s of [%s]" % (name, table), re.search(form % re.escape(name), section))
    rows = re.findall(r"(?m)^\| `([\w.-]+)` \|", gate)
    c.check("configuration.md has no other key of [gate]", sorted(rows) == sorted(keys["gate"]), str(rows))


def origin(c, tmp):
    write(os.path.join(tmp, ".decklint.toml"), "ignore = [\"DK916\"]\nfail-on = \"warning\"\n\n[gate]\nmax-depth = 0.5\n")
    os.makedirs(os.path.join(tmp, "models"))
    deck = os.path.join(tmp, "models", "a_0000.rad")
    shutil.copy(SAMPLE, deck)
    text = c.run("lint", deck, "--show-config", "--ignore", "DK295", "--max-depth", "0.2", "--fail-on", "new").text
    path = os.path.join(tmp, ".decklint.toml")
    for row in (r"select +all rules +default", r'ignore +\["DK916", "DK295"\] +%s:1 and --ignore' % re.escape(path),
                r'fail-on +"warning" +%s:2' % re.escape(path), r"gate\.max-depth +0\.2 +--max-depth", r"gate\.max-ratio +no bound +default",
                r'gate\.fail-on +\["new"\] +--fail-on', r"severity +none +default"):
        c.check("--show-config: " + row, re.search(r"(?m)^  %s$" % row, text), text)
    r = c.run("lint", deck, "--show-config", "--no-config")
    c.check("--show-config says that there is none", r.code == 0 and "no .decklint.toml" in r.text, r.text)


def changed(c, tmp):
    """A library in which two of three decks include a file, over another one and packed."""
    text = read(SAMPLE).replace("/END\n", "")
    git = lambda *a: subprocess.run(["git", "-C", tmp, *a], check=True, capture_output=True)
    git("init", "-q")
    write(os.path.join(tmp, "a", "a_0000.rad"), text + "#include ../common/outer.inc\n/END\n")
    os.makedirs(os.path.join(tmp, "b"))
    with gzip.open(os.path.join(tmp, "b", "b_0000.rad.gz"), "wt") as f:
        f.write(text + "#include ../common/mesh.txt\n/END\n")
    write(os.path.join(tmp, "c", "c_0000.rad"), text + "/END\n")
    write(os.path.join(tmp, "common", "outer.inc"), "#include mesh.txt\n")
    write(os.path.join(tmp, "common", "mesh.txt"), "/TITLE\nfine\n")
    write(os.path.join(tmp, "c", "c_0001.rad"), "/RUN/c/1\n1.0\n")
    write(os.path.join(tmp, "notes.txt"), "not part of any deck\n")

    def decks(*files, cwd=tmp):
        r = c.run("lint", "--changed", *files, "--format", "json", cwd=cwd)
        return r.code, sorted(set(re.findall(r'"deck": *\{\s*"path": *"([^"]+)"', r.out.decode()))), r.text
    for name, files, expected in (("an include of two decks", ["common/mesh.txt"], ["a/a_0000.rad", "b/b_0000.rad.gz"]),
                                  ("an include of one", ["common/outer.inc"], ["a/a_0000.rad"]),
                                  ("a deck", ["c/c_0000.rad"], ["c/c_0000.rad"]),
                                  ("an Engine file", ["c/c_0001.rad"], ["c/c_0000.rad"]),
                                  ("a deck and its include", ["a/a_0000.rad", "common/outer.inc"], ["a/a_0000.rad"]),
                                  ("a file of no deck and one that is gone", ["notes.txt", "gone.inc"], [])):
        code, found, output = decks(*files)
        c.check("--changed: " + name, found == expected and code in (0, 1), "%s, exit %s: %s" % (found, code, output[-300:]))
    c.check("--changed: nothing to lint is clean and says so", decks("notes.txt")[0] == 0 and "nothing to lint" in decks("notes.txt")[2])
    code, found, output = decks("mesh.txt", cwd=os.path.join(tmp, "common"))
    c.check("--changed: from another directory", found == ["../a/a_0000.rad", "../b/b_0000.rad.gz"] or len(found) == 2, str(found))
    write(os.path.join(tmp, "common", "mesh.txt"), "/INTER/TYPE7/77\nbroken\n         9         9\n")
    hook = read(ROOT, ".pre-commit-hooks.yaml")
    entry = re.search(r"(?m)^  entry: deck (.*)$", hook).group(1).split()
    r = c.run(*entry, "common/mesh.txt", cwd=tmp)
    c.check("the hook stops a commit that breaks an include, and prints the finding with its place",
            r.code == 1 and "common/mesh.txt:" in r.out.decode() and "error[DK" in r.out.decode(), r.text[-400:])
    c.check("the hook looks at files of every name", "files:" not in hook and "require_serial: true" in hook)


if __name__ == "__main__":
    run_steps(init, origin, changed)
