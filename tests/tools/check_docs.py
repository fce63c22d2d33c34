#!/usr/bin/env python3
"""Compares the pages a person reads with the program: README.md, samples/README.md, tools/docs/*.md, .github/*.md.

* A line `$ deck ...` in a fenced block is executed, in a directory with a copy of samples/, and must end with exit code 0
  or 1. The lines up to the next `$` are what it prints (standard output, then error); with none
  shown, nothing is compared. A shell comment after the command is left out.
  In what is shown, a line `...` stands for any lines, `...` at the end of a line for the rest of that line, and `<n>`
  for a number that depends on the machine or the release.
  Blocks of one page share the directory, so that one may go on with the files of another.
* ```toml blocks are read by `deck lint --config`, ```yaml and ```json blocks are parsed, ```cpp and ```cmake blocks stand
  line by line in tests/consumer, which is built and run.
* Every option after `deck VERB` in a block or in `code` exists.
* Relative links lead to files, anchors to headings; a path in `code` below a folder of the project exists.
* samples/README.md names every sample.
* README.md has at most 110 lines and 900 words, every verb of `deck --help` in its table, every package of tools/setup.
* tools/docs/building.md has every option of CMake. check_settings.py holds tools/docs/configuration.md against the program."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    yaml = None

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "robustness"))
from common import ROOT, SAMPLES, Checks  # noqa: E402

MOST_README_LINES, MOST_README_WORDS = 110, 900
FOLDERS = ("libdeck/", "schemas/", "tools/", "tests/", "samples/", ".github/", ".ci/")


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as f:
        return f.read()


def pages():
    names = ["README.md", "samples/README.md"]
    for pattern in ("tools/docs/*.md", ".github/*.md"):
        names += sorted(os.path.relpath(p, ROOT) for p in glob.glob(os.path.join(ROOT, pattern)))
    return names


class Page:
    """A page in its parts: fenced blocks [(first line, language, lines)] and the prose between them."""

    def __init__(self, name):
        self.name = name
        self.blocks, prose, fence = [], [], None
        for number, line in enumerate(read(name).split("\n"), 1):
            mark = re.match(r"\s*```(\w*)", line)
            if mark and fence is None:
                fence = (number + 1, mark.group(1), [])
                self.blocks.append(fence)
            elif mark:
                fence = None
            elif fence is not None:
                fence[2].append(line)
            else:
                prose.append((number, line))
        self.closed = fence is None
        self.prose = prose

    def anchors(self):
        """Names of the headings, as forges make them."""
        found = set()
        for _, line in self.prose:
            if line.startswith("#"):
                text = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower()).replace(" ", "-")
                name, count = text, 1
                while name in found:
                    name, count = "%s-%d" % (text, count), count + 1
                found.add(name)
        return found

    def code(self):
        """(line, text) of everything written as code."""
        for number, line in self.prose:
            for text in re.findall(r"`([^`]+)`", line):
                yield number, text
        for first, _, lines in self.blocks:
            for i, line in enumerate(lines):
                yield first + i, line


def line_pattern(line):
    rest, tail = line.rstrip(), ""
    if rest.endswith("...") and rest != "...":
        rest, tail = rest[:-3], ".*"
    return re.compile("".join("[-+]?[0-9][0-9.]*(?:e[-+]?[0-9]+)?" if p == "<n>" else re.escape(p) for p in re.split(r"(<n>)", rest)) + tail + r"\Z")


def differs(shown, printed):
    """'' or where the two part: the first shown line that finds no place."""
    while shown and not shown[-1].strip():
        shown = shown[:-1]
    printed = [x.rstrip() for x in printed]
    while printed and not printed[-1]:
        printed.pop()
    # Places in `printed` that the shown lines so far can have reached.
    reached = {0}
    for line in shown:
        if line.strip() == "...":
            reached = set(range(min(reached), len(printed) + 1))
            continue
        pattern = line_pattern(line)
        after = {at + 1 for at in reached if at < len(printed) and pattern.match(printed[at])}
        if not after:
            at = min(reached)
            return "shown %r, printed %r" % (line, printed[at] if at < len(printed) else "(the end)")
        reached = after
    return "" if len(printed) in reached else "printed beyond what is shown: %r" % printed[max(reached)]


def commands(page):
    """(line, command, shown lines)"""
    for first, _, lines in page.blocks:
        current = None
        for i, line in enumerate(lines):
            if line.startswith("$ "):
                if current:
                    yield current
                current = (first + i, line[2:], []) if line.startswith("$ deck") else None
            elif current:
                current[2].append(line)
        if current:
            yield current


def write_rules(folder):
    """The page of a rule that tools/docs/ci.md shows, in folder/rules."""
    lines = next(lines for _, language, lines in Page("tools/docs/ci.md").blocks if language == "markdown")
    os.makedirs(os.path.join(folder, "rules"))
    with open(os.path.join(folder, "rules", "X101.md"), "w", encoding="utf-8") as f:
        f.write("\n".join(lines) + "\n")


def run_commands(c, page):
    with tempfile.TemporaryDirectory(prefix="deck-pages-") as tmp:
        os.makedirs(os.path.join(tmp, "bin"))
        os.symlink(c.program, os.path.join(tmp, "bin", "deck"))
        work = os.path.join(tmp, "work")
        os.makedirs(work)
        shutil.copytree(os.path.join(ROOT, "samples"), os.path.join(work, "samples"))
        write_rules(work)
        env = dict(os.environ, PATH=os.path.join(tmp, "bin") + ":" + os.environ["PATH"], NO_COLOR="1")
        for number, command, shown in commands(page):
            name = "%s:%d: %s" % (page.name, number, command)
            try:
                r = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=work, env=env, stdin=subprocess.DEVNULL, capture_output=True,
                                   timeout=600 if c.sanitized else 120)
            except subprocess.TimeoutExpired:
                c.check(name, False, "no answer in time")
                continue
            out, err = (b.decode("utf-8", "replace") for b in (r.stdout, r.stderr))
            c.check(name + " runs", r.returncode in (0, 1), "exit code %d: %s" % (r.returncode, (out + err)[-300:]))
            if any(x.strip() for x in shown):
                why = differs(shown, (out + err).split("\n"))
                c.check(name + " prints what is shown", not why or not differs(shown, (err + out).split("\n")), why)


def check_options(c, page, options):
    """Every `deck VERB ... --option` names an option of that verb."""
    for number, text in page.code():
        for part in re.split(r"[|;&]|\$\(", re.sub(r"\s#\s.*", "", text)):
            at = re.search(r"(?:^|[\s'\"/$])deck\s+([a-z]+)\b(.*)", part)
            if not at:
                continue
            verb = at.group(1)
            if verb not in options:
                continue
            rest = re.sub(r"'[^']*'", "''", at.group(2))
            unknown = [o for o in re.findall(r"(?<![\w-])--?[a-z][\w-]*", rest) if o.split("=")[0] not in options[verb] and o != "-n"]
            c.check("%s:%d: options of deck %s exist" % (page.name, number, verb), not unknown, " ".join(unknown))


def check_links(c, page, all_pages):
    for number, line in page.prose:
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "``", line)):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            where = os.path.normpath(os.path.join(os.path.dirname(page.name), path)) if path else page.name
            if not c.check("%s:%d: link to %s" % (page.name, number, target), os.path.exists(os.path.join(ROOT, where)), "no such file"):
                continue
            if anchor:
                other = all_pages.get(where)
                c.check("%s:%d: anchor %s" % (page.name, number, target), other is not None and anchor in other.anchors(), "no such heading")


def check_paths(c, page):
    """Files of the project that are named in code."""
    for number, line in page.prose:
        for text in re.findall(r"`([^`]+)`", line):
            for word in text.split():
                if not word.startswith(FOLDERS) or re.search(r"[*{<$=]", word):
                    continue
                path = re.sub(r"(:\d+)+$", "", word.rstrip(",;"))
                c.check("%s:%d: %s" % (page.name, number, path), os.path.exists(os.path.join(ROOT, path)), "no such file")


def check_blocks(c, page):
    consumer = {"cpp": read("tests", "consumer", "main.cpp"), "cmake": read("tests", "consumer", "CMakeLists.txt")}
    for first, language, lines in page.blocks:
        name, text = "%s:%d: %s block" % (page.name, first, language), "\n".join(lines) + "\n"
        if language == "toml":
            with tempfile.TemporaryDirectory(prefix="deck-pages-") as tmp:
                write_rules(tmp)
                path = os.path.join(tmp, "decklint.toml")
                with open(path, "w", encoding="utf-8") as f:
                    f.write(text)
                r = c.run("lint", "--show-config", "--config", path)
            c.check(name + " is accepted", r.code == 0, r.text[-300:])
        elif language in ("yaml", "yml", "json") and (yaml or language == "json"):
            why = ""
            try:
                (json.loads if language == "json" else yaml.safe_load)(text)
            except Exception as e:  # each parser has its own
                why = str(e)
            c.check(name + " can be parsed", not why, why)
        elif language in consumer and page.name == "tools/docs/library.md":
            have = [x.strip() for x in consumer[language].split("\n")]
            lacking = [x for x in lines if x.strip() and x.strip() not in have]
            c.check(name + " stands in tests/consumer", not lacking, "; ".join(lacking))


def check_manual(c):
    """The examples of the manual in deck.hpp, its lines with three blanks, are code of tests/consumer."""
    manual = re.findall(r"(?m)^//   (.*)$", read("libdeck", "include", "deck", "deck.hpp"))
    have = [x.strip() for x in read("tests", "consumer", "main.cpp").split("\n")]
    lacking = [x for x in manual if x.strip() not in have]
    c.check("examples of deck.hpp stand in tests/consumer", len(manual) > 20 and not lacking, "; ".join(lacking))


def check_workflows(c):
    if yaml is None:
        c.skip("workflows", "no python3-yaml")
        return
    files = sorted(glob.glob(os.path.join(ROOT, ".github", "workflows", "*.yml")))
    c.check("there is a workflow", len(files) > 0)
    ran = ""
    for path in files:
        with open(path, encoding="utf-8") as f:
            flow = yaml.safe_load(f)
        for name, job in flow["jobs"].items():
            steps = job["steps"]
            c.check("%s: %s: steps do something" % (os.path.basename(path), name), all(("run" in s) != ("uses" in s) for s in steps))
            ran += "".join(s.get("run", "") + "\n" for s in steps)
    c.check("the workflow runs .ci/run", ".ci/run" in ran, ran)


def check_readme(c, verbs):
    text = read("README.md")
    lines, words = text.count("\n"), len(text.split())
    c.check("README.md is short", lines <= MOST_README_LINES and words <= MOST_README_WORDS, "%d lines, %d words" % (lines, words))
    rows = re.findall(r"(?m)^\| (?:\[)?`deck ([a-z]+)`", text)
    c.check("README.md: one line a verb, for every verb", sorted(rows) == sorted(verbs), "README %s, program %s" % (sorted(rows), sorted(verbs)))
    setup = read("tools", "setup")
    packages = " ".join(re.findall(r"(?m)^(?:build|test|bench|doc|package)=\(([^)]*)\)", setup)).split()
    c.check("tools/setup lists packages", len(packages) > 10, " ".join(packages))
    lacking = [p for p in packages if "`%s`" % p not in text + read("tools", "docs", "building.md")]
    c.check("every package of tools/setup is explained", not lacking, " ".join(lacking))


def check_samples(c):
    text = read("samples", "README.md")
    scripts = glob.glob(os.path.join(ROOT, "samples", "automation", "*.py"))
    for name in [os.path.basename(p)[:-9] for p in SAMPLES] + [os.path.basename(p) for p in scripts]:
        c.check("samples/README.md names " + name, name in text)


def check_building(c):
    text = read("tools", "docs", "building.md")
    options = re.findall(r"(?m)^\s*option\((LIBDECK_\w+)", read("CMakeLists.txt"))
    presets = [p["name"] for p in json.loads(read("CMakePresets.json"))["configurePresets"] if not p.get("hidden")]
    for what, names in ("option", options), ("preset", presets):
        lacking = [n for n in names if "`%s`" % n not in text]
        c.check("tools/docs/building.md has every " + what, len(names) > 3 and not lacking, " ".join(lacking))


def main():
    c = Checks()
    text = c.run("--help").out.decode()
    verbs = re.findall(r"^  ([a-z]+)  ", text[text.index("Subcommands:"):text.index("Examples:")], re.M)
    options = {}
    for verb in verbs:
        out = c.run(verb, "--help").out.decode()
        options[verb] = {o for m in re.finditer(r"(?m)^\s+((?:-\w,)?--[\w-]+|-\w)\b", out) for o in m.group(1).split(",")} | {"-h", "--help"}
    all_pages = {name: Page(name) for name in pages()}
    for page in all_pages.values():
        c.check(page.name + ": every fence is closed", page.closed)
        check_options(c, page, options)
        check_links(c, page, all_pages)
        check_paths(c, page)
        check_blocks(c, page)
        run_commands(c, page)
    check_readme(c, verbs)
    check_samples(c)
    check_building(c)
    check_manual(c)
    check_workflows(c)
    c.finish()


if __name__ == "__main__":
    main()
