#!/usr/bin/env python3
"""Runs every statement of the manual pages in tests/golden/statements/*.toml and renders them as
tools/docs/manual.md.

  check_statements.py [DECK]           runs all statements; 'N passed, N failed' at the end
  check_statements.py [DECK] --write   renders tools/docs/manual.md anew
  check_statements.py [DECK] --only X  runs the statements with X in their name and shows the answers

A statement is a table of a TOML file (see README.md there), statement.NAME:
  types    interface types it is run for, "7 19"
  field    field or comment    verdict agrees (or left out), differs or advice
  manual, solver, program      one sentence each, own words; solver is left out where it does the same
  runs     what shows it: {deck, card, extra, cmd, want, absent, json, exit, types, version}"""
import concurrent.futures
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib

for folder in ("robustness", "keyword"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, folder))
from common import ROOT, Count  # noqa: E402
from schema_files import keyword_schemas  # noqa: E402

FOLDER = os.path.join(ROOT, "tests", "golden", "statements")
PAGE = os.path.join(ROOT, "tools", "docs", "manual.md")
VERDICTS = {"agrees": "as the manual says", "differs": "**differs**", "advice": "advice"}
VERSION = 2022


def schemas():
    """keyword -> schema, as the program has them built in."""
    found = {}
    for one in keyword_schemas():
        for name in [one["keyword"], *one.get("aliases", [])]:
            found[name] = one
        for card in one.get("cards", []):
            card.setdefault("fields", [])  # of a blank line
    return found


SCHEMAS = schemas()


def in_version(thing, version):
    low, high = thing.get("versions") or [None, None]
    return (low is None or low <= version) and (high is None or version <= high)


def holds(condition, values):
    try:
        value = int(values.get(condition.get("field"), 0))
    except ValueError:
        value = 0
    return (("in" not in condition or value in condition["in"]) and ("not_in" not in condition or value not in condition["not_in"])
            and ("min" not in condition or value >= condition["min"]) and ("max" not in condition or value <= condition["max"]))


def card(line, version):
    """The block of '@/KEYWORD/1 Field=Value ...'; interfaces get sides 2 (secondary) and 1 (main)."""
    head, *cells = line[1:].split()
    values = dict(cell.split("=", 1) for cell in cells)
    parts = head.split("/")
    schema = next((SCHEMAS["/".join(parts[:n])] for n in range(len(parts), 1, -1) if "/".join(parts[:n]) in SCHEMAS), None)
    if schema is None:
        raise ValueError("no schema for " + head)
    names = {f["name"] for c in schema["cards"] for f in c["fields"] if in_version(c, version) and in_version(f, version)}
    if schema.get("kind") == "inter":
        for field, value in (("grnd_IDs", "2"), ("surf_IDs", "2"), ("surf_IDm", "1"), ("line_IDs", "2"), ("line_IDm", "1"), ("Stfac", "1.0")):
            if field in names:
                values.setdefault(field, value)
    if "Gap" in names and "Gapmin" in values and "Gapmin" not in names:
        values["Gap"] = values.pop("Gapmin")  # the name that TYPE10 has for it
    unknown = set(values) - names
    if unknown:
        raise ValueError("%s has no field %s" % (head, ", ".join(sorted(unknown))))
    out = [head] + (["a title"] if schema.get("title", True) else [])
    pending = []
    for c in schema["cards"]:
        if not in_version(c, version) or not all(holds(w, values) for w in c.get("when", [])):
            continue
        text, given = "", False
        for f in c["fields"]:
            if f["name"] not in values or not in_version(f, version):
                continue
            first, last = f["cols"]
            text = text.ljust(last - len(values[f["name"]]))[:last] + values[f["name"]]
            given = True
        if c.get("repeat") and not given:
            continue
        pending.append(text)
        if given or not c.get("optional"):
            out += pending
            pending = []
    return "\n".join(out) + "\n"


def expand(text, version):
    return "".join(card(line, version) if line.startswith("@/") else line + "\n" for line in text.removesuffix("\n").split("\n")) if text else ""


def load():
    """(statements in order of the files, decks by name)"""
    statements, decks = [], {}
    for path in sorted(glob.glob(os.path.join(FOLDER, "*.toml"))):
        with open(path, "rb") as f:
            data = tomllib.load(f)
        decks.update(data.get("deck", {}))
        for name, s in data.get("statement", {}).items():
            statements.append({"verdict": "agrees", **s, "name": name, "chapter": data["chapter"]})
    return statements, decks


def problems(statements, decks):
    """What is wrong with the table itself."""
    seen = set()
    for s in statements:
        name = s["name"]
        unknown = set(s) - {"name", "types", "field", "verdict", "manual", "solver", "program", "runs", "chapter"}
        lacking = {"types", "field", "manual", "program", "runs"} - set(s)
        if unknown or lacking:
            yield "%s: unknown %s, lacking %s" % (name, sorted(unknown), sorted(lacking))
            continue
        if name in seen:
            yield "%s is there twice" % name
        seen.add(name)
        if s["verdict"] not in VERDICTS:
            yield "%s: no verdict %s" % (name, s["verdict"])
        if s["verdict"] == "differs" and "solver" not in s:
            yield "%s differs, but does not say what the solver does" % name
        for r in s["runs"]:
            odd = set(r) - {"deck", "card", "extra", "cmd", "want", "absent", "exit", "types", "version", "json"}
            if odd or "cmd" not in r or not (r.get("want") or r.get("absent") or r.get("json") or "exit" in r) or r.get("deck", "plates") not in decks:
                yield "%s: a run that cannot be read or asks for nothing: %s" % (name, r)


def both_models(runs):
    """A command with {model} is run with both models of cycle, which have to agree."""
    for run in runs:
        if "{model}" in run["cmd"]:
            yield dict(run, cmd=run["cmd"].replace(" {model}", ""))
            yield dict(run, cmd=run["cmd"].replace("{model}", "--model reference"))
        else:
            yield run


def cases(s, decks):
    """(type, run, text of the deck or None) of a statement."""
    for run in both_models(s["runs"]):
        for type_ in str(run.get("types", s["types"])).split():
            version = run.get("version", VERSION)
            fill = lambda t: t.replace("{T}", type_)
            if run["cmd"].split()[0] in ("explain", "rules"):
                yield type_, run, None
                continue
            text = "#RADIOSS STARTER\n/BEGIN\nstatement\n%10d         0\n" % version
            text += 2 * "                  kg                  mm                  ms\n"
            text += decks[run.get("deck", "plates")] if "{base}" not in decks[run.get("deck", "plates")] else \
                decks[run.get("deck", "plates")].replace("{base}", decks["plates"])
            text += fill(run.get("extra", ""))
            if "card" in run:
                text = text.removesuffix("\n") + "\n@/INTER/TYPE%s/1 %s\n" % (type_, fill(run["card"]))
            yield type_, run, expand(text, version) + "/END\n"


def value_at(data, path):
    """What stands at 'a.0.b', 'list.key=7.b'; 'primary.', 'reversed.' and 'edges.' are parts of the first interface."""
    first, _, rest = path.partition(".")
    if first in ("primary", "reversed", "edges"):
        path = "interfaces.0.contacts.role=%s.%s" % (first, rest)
    for key in path.split("."):
        if isinstance(data, list) and "=" in key:
            name, _, wanted = key.partition("=")
            data = next((x for x in data if str(x.get(name)) == wanted), None)
        elif isinstance(data, list):
            data = data[int(key)] if int(key) < len(data) else None
        elif isinstance(data, dict):
            data = data.get(key)
        else:
            return None
    return data


def same(value, wanted):
    if isinstance(wanted, (int, float)) and not isinstance(wanted, bool) and isinstance(value, (int, float)):
        return abs(value - wanted) <= 1e-4 * abs(wanted)
    return value == wanted


def ask(program, folder, index, type_, run, text):
    """Runs one case: '' if the answer is what is wanted, else what is not; and the answer."""
    path = os.path.join(folder, "case%04d_0000.rad" % index)
    words = run["cmd"].replace("{T}", type_).split()
    if text is not None:
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        words.insert(1, path)
    if run.get("json"):
        words += ["--all", "--json", "-"]
    if words[0] == "lint":
        words.append("--no-config")
    done = subprocess.run([program, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120,
                          env=dict(os.environ, NO_COLOR="1"))
    answer = done.stdout + done.stderr
    flat = re.sub(r"\s+", " ", answer)
    wrong = []
    if done.returncode < 0 or done.returncode > 3:
        wrong.append("exit code %d" % done.returncode)
    if "exit" in run and done.returncode != run["exit"]:
        wrong.append("exit code %d, not %d" % (done.returncode, run["exit"]))
    wrong += ["not there: " + w for w in run.get("want", []) if not re.search(w.replace("{T}", type_), flat)]
    wrong += ["there: " + w for w in run.get("absent", []) if re.search(w.replace("{T}", type_), flat)]
    if run.get("json"):
        try:
            data = json.loads(done.stdout)
        except ValueError:
            data = {}
        for at, wanted in run["json"].items():
            if not same(value_at(data, at), wanted):
                wrong.append("%s is %s, not %s" % (at, value_at(data, at), wanted))
    return "; ".join(wrong), answer


def shown(s, run):
    """The command as the page prints it, with the fields of the card that it is run on."""
    kinds = str(run.get("types", s["types"])).split()
    words = "deck " + run["cmd"].replace("{T}", kinds[0])
    return "`%s` on `%s`" % (words, run["card"]) if run.get("card") else "`%s`" % words


def render(statements):
    cell = lambda t: t.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")
    out = ["<!-- Rendered by tests/golden/check_statements.py --write from tests/golden/statements/*.toml; every line is run by tools/test. -->",
           "# The manual, the solver, and this program", "",
           "What the manual pages of /INTER/TYPE7, TYPE10, TYPE11 and TYPE19 say, what the solver does, and what this program tells you."
           " %d statements, each shown by the commands in its last column on small decks: %d as the manual says, %d where the solver differs, %d advice." % (
               len(statements), sum(s["verdict"] == "agrees" for s in statements), sum(s["verdict"] == "differs" for s in statements),
               sum(s["verdict"] == "advice" for s in statements)), ""]
    chapter = None
    for s in statements:
        if s["chapter"] != chapter:
            chapter = s["chapter"]
            out += ["", "## " + chapter, "", "| field | types | the manual says | the solver does | this program tells you |", "|---|---|---|---|---|"]
        commands = list(dict.fromkeys(shown(s, r) for r in both_models(s["runs"])))
        solver = s.get("solver", "the same")
        if s["verdict"] == "differs":
            solver = "**" + solver + "**"
        out.append("| %s | %s | %s | %s | %s<br>%s |" % (cell(s["field"]), ", ".join(str(s["types"]).split()), cell(s["manual"]), cell(solver),
                                                     cell(s["program"]), ", ".join(cell(c) for c in commands)))
    return "\n".join(out) + "\n"


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    only = None
    if "--only" in sys.argv:
        only = sys.argv[sys.argv.index("--only") + 1]
        arguments.remove(only)
    program = os.path.abspath(arguments[0] if arguments else os.path.join(ROOT, "build", "dev", "tools", "deck"))
    if not os.access(program, os.X_OK):
        sys.exit("%s: no such program; build the target 'deck' first" % program)
    statements, decks = load()
    c = Count()
    for text in problems(statements, decks):
        c.check(text, False)
    if c.failed:
        c.finish()
    if "--write" in sys.argv:
        with open(PAGE, "w", encoding="utf-8") as f:
            f.write(render(statements))
        print("wrote " + PAGE)
        return
    with tempfile.TemporaryDirectory(prefix="deck-statements-") as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = []
        for s in statements:
            if only and only not in s["name"]:
                continue
            jobs += [(s, t, r, text) for t, r, text in cases(s, decks)]
        answers = list(pool.map(lambda j: ask(program, folder, j[0], j[1][1], j[1][2], j[1][3]), enumerate(jobs)))
    for (s, type_, run, text), (wrong, answer) in zip(jobs, answers):
        if only:
            print("--- %s TYPE%s: deck %s   %s\n%s%s" % (s["name"], type_, run["cmd"], run.get("card", ""), answer, "=> " + wrong + "\n" if wrong else ""))
        c.check("%s TYPE%s, deck %s (%s)" % (s["name"], type_, run["cmd"], run.get("card", "")), not wrong, wrong[:400])
    if not only:
        with open(PAGE, encoding="utf-8") as f:
            c.check("tools/docs/manual.md is what the statements say", f.read() == render(statements), "run tests/golden/check_statements.py --write")
    c.finish()


if __name__ == "__main__":
    main()
