#!/usr/bin/env python3
"""What the tools write: every JSON document valid against its schema, SARIF valid against 2.1.0, the
same bytes for any number of threads and any locale."""
import base64
import glob
import json
import os
import re
import shutil
import subprocess
import xml.dom.minidom
import zlib

import jsonschema
from common import ROOT, SAMPLES, read, run_steps, write

SCHEMAS = os.path.join(ROOT, "schemas", "output")


def validators(schema):
    """One for its own draft and one for draft 7: the schemas keep to what both have in common."""
    resolver = jsonschema.RefResolver("file://" + SCHEMAS + "/", schema)
    return [kind(schema, resolver=resolver) for kind in (jsonschema.validators.validator_for(schema), jsonschema.Draft7Validator)]


def strict(text):
    """JSON as the standard has it: no NaN, no Infinity."""
    def refuse(word):
        raise ValueError(word + " is not JSON")
    return json.loads(text, parse_constant=refuse)


def validators_of(c, verb):
    """Of the schema as it is, and of its draft-7 subset, which is what is promised."""
    found = glob.glob(os.path.join(ROOT, "schemas", "output", verb + ".schema.json"))
    if not c.check("schema of %s is there" % verb, found):
        return []
    schema = json.loads(read(found[0]))
    kind = jsonschema.validators.validator_for(schema)
    try:
        kind.check_schema(schema)
    except jsonschema.SchemaError as e:
        c.check("schema of %s is a schema" % verb, False, e.message)
    return validators(schema)


def check_document(c, name, text, validators):
    try:
        document = strict(text)
    except ValueError as e:
        return c.check(name + " is JSON", False, str(e))
    for v in validators:
        errors = sorted(v.iter_errors(document), key=lambda e: list(map(str, e.path)))
        c.check("%s against its schema (%s)" % (name, type(v).__name__), not errors,
                "; ".join("%s: %s" % ("/".join(map(str, e.path)), e.message[:150]) for e in errors[:3]))


VERBS_WITH_JSON = (("params",), ("parts",), ("parts", "--all"), ("gaps",), ("gaps", "--all", "--crossings"), ("cycle",), ("cycle", "--all"),
                   ("cycle", "--costs"), ("fix", "--strategy", "move-nodes"))


def sarif_tool():
    """Path of the SARIF validator, installed once below the build folder by npm; None without it."""
    folder = os.path.join(ROOT, "build", "sarif-tool")
    program = os.path.join(folder, "node_modules", "@microsoft", "sarif-multitool-linux", "Sarif.Multitool")
    if not os.path.exists(program) and shutil.which("npm"):
        write(os.path.join(folder, "package.json"), '{"name": "sarif-tool", "private": true}\n')
        subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--silent", "@microsoft/sarif-multitool@5.7.0"],
                       cwd=folder, capture_output=True, timeout=300, stdin=subprocess.DEVNULL)
    if not os.path.exists(program):
        return None
    os.chmod(program, 0o755)
    return program


def check_sarif(c, files):
    tool = sarif_tool()
    if tool is None:
        c.skip("SARIF against the 2.1.0 schema", "npm could not install @microsoft/sarif-multitool")
        return
    def errors_in(paths):
        # With the rules of GitHub's code scanning.
        r = subprocess.run([tool, "validate", *paths, "--rule-kind", "Sarif;Ghas"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        return [x for x in r.stdout.split("\n") if ": error " in x], r.stdout + r.stderr
    # The judge must be able to say no.
    bad = os.path.join(os.path.dirname(files[0]), "bad.sarif")
    write(bad, '{"version":"2.1.0","$schema":"https://json.schemastore.org/sarif-2.1.0.json",'
               '"runs":[{"tool":{"driver":{"name":"x","bogus":1}},"results":[]}]}')
    errors, out = errors_in([bad])
    if not c.check("the SARIF validator refuses a wrong file", bool(errors), out[-300:]):
        return
    errors, out = errors_in(files)  # one call: starting it takes longer than a file
    c.check("every SARIF is looked at", "%d files scanned" % len(files) in out, out[-300:])
    for f in files:
        mine = [e for e in errors if e.startswith(f + "(")]
        c.check("SARIF of " + os.path.basename(f), not mine, "; ".join(mine[:3]))
    c.check("SARIF errors all belong to a file", all(e.startswith(tuple(f + "(" for f in files)) for e in errors), "; ".join(errors[:3]))


# JUnit as Jenkins' schema has it (junit-10.xsd): element -> its attributes and its children.
JUNIT = {"testsuites": ({"name", "time", "tests", "failures", "disabled", "errors"}, {"testsuite"}),
         "testsuite": ({"name", "tests", "failures", "errors", "time", "disabled", "skipped", "timestamp", "hostname", "id", "package", "file"},
                       {"properties", "testsuite", "testcase", "system-out", "system-err"}),
         "testcase": ({"name", "assertions", "time", "classname", "status", "class", "file", "line"}, {"skipped", "error", "failure", "system-out", "system-err"}),
         "skipped": ({"type", "message"}, set()), "error": ({"type", "message"}, set()), "failure": ({"type", "message"}, set()),
         "system-out": (set(), set())}


def junit_errors(text):
    """What is wrong with a JUnit document, counts included."""
    out = []

    def look(e):
        if e.tagName not in JUNIT:
            return out.append("<%s> is no element" % e.tagName)
        attributes, children = JUNIT[e.tagName]
        out.extend("%s has no attribute %s" % (e.tagName, a) for a in e.attributes.keys() if a not in attributes)
        if e.tagName in ("testsuite", "testcase") and not e.getAttribute("name"):
            out.append("%s without a name" % e.tagName)
        for child in e.childNodes:
            if child.nodeType == child.ELEMENT_NODE:
                if child.tagName not in children:
                    out.append("%s in %s" % (child.tagName, e.tagName))
                look(child)
    root = xml.dom.minidom.parseString(text).documentElement
    look(root)
    for suite in root.getElementsByTagName("testsuite"):
        for attribute, tag in (("tests", "testcase"), ("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            n = len(suite.getElementsByTagName(tag))
            if suite.getAttribute(attribute) not in (str(n), "" if n == 0 else "-"):
                out.append("%s=%s of %d" % (attribute, suite.getAttribute(attribute), n))
        names = [(t.getAttribute("classname"), t.getAttribute("name")) for t in suite.getElementsByTagName("testcase")]
        out.extend("two cases %s" % (n,) for n in set(names) if names.count(n) > 1)
    return out


def lint_formats(c, tmp):
    c.check("the JUnit check refuses a wrong file", junit_errors('<testsuites><testsuite name="a" tests="2" failures="0" errors="0">'
            '<testcase name="x"/><case/></testsuite></testsuites>') == ["case in testsuite", "<case> is no element", "tests=2 of 1"])
    sarifs = []
    validators = validators_of(c, "lint")
    for path in SAMPLES:
        stem = os.path.basename(path)[:-9]
        out = {k: os.path.join(tmp, stem + "." + k) for k in ("json", "sarif", "junit")}
        r = c.run("lint", path, *[a for k, v in out.items() for a in ("-o", k + "=" + v)])
        if not c.no_crash("lint -o of " + stem, r, (0, 1, 3)):
            continue
        check_document(c, "lint json of " + stem, read(out["json"]), validators)
        sarifs.append(out["sarif"])
        try:
            errors = junit_errors(read(out["junit"]))
            c.check("junit of " + stem, not errors, "; ".join(errors[:3]))
        except Exception as e:  # any parser error
            c.check("junit of " + stem, False, str(e))
        for fmt in ("human", "json", "sarif", "github", "junit", "gitlab"):
            one = c.run("lint", path, "--format", fmt)
            c.check("--format %s keeps the exit code of %s" % (fmt, stem), one.code == r.code, "%s, was %s" % (one.code, r.code))
            if fmt == "gitlab":
                check_document(c, "gitlab report of " + stem, one.out, [])
    if sarifs:
        check_sarif(c, sarifs)


def edit_documents(c, tmp):
    """The deck as JSON, the loss report, the report of a fix and of a gate."""
    report = os.path.join(tmp, "report.json")
    calls = (("deck", (0,), ("convert", "--to", "json")),
             ("losses", (0, 1), ("convert", "--units", "kg,m,s", "--partial", "--diff", "--report", report)),
             ("fix", (0, 1), ("fix", "--strategy", "reduce-gap", "--json", "-")),
             ("fix", (0, 1), ("fix", "--json", "-")),
             ("gate", (0, 1), ("gate", "--max-depth", "0.3", "--json", "-")))
    validators = {schema: validators_of(c, schema) for schema, _, _ in calls}
    for path in SAMPLES:
        for schema, codes, (verb, *options) in calls:
            name = "%s of %s" % (" ".join([verb] + options[:3]), os.path.basename(path)[:-9])
            r = c.run(verb, path, *options)
            if c.no_crash(name, r, codes):
                document = read(report) if schema == "losses" else r.out
                check_document(c, name, document, validators[schema])
                if schema == "gate":
                    c.check("exit code of " + name, r.code == (0 if strict(document)["passed"] else 1), r.code)


def looks(c, tmp):
    """What `show` and `diff` say, and that a deck written anew with other ids is the same deck."""
    shows, diffs = (validators_of(c, name) for name in ("show", "diff"))
    for path in SAMPLES:
        stem = os.path.basename(path)[:-9]
        for what in ("1", "part:1", "mat:1", "node:2", "shell:1", "node:999999999"):
            name = "show %s of %s" % (what, stem)
            r = c.run("show", path, what, "--json", "-")
            if c.no_crash(name, r, (0, 2)) and r.code == 0:
                check_document(c, name, r.out, shows)
        r = c.run("diff", SAMPLES[0], path, "--json", "-")
        if c.no_crash("diff with " + stem, r, (0, 1)):
            check_document(c, "diff with " + stem, r.out, diffs)
            c.check("exit code of diff with " + stem, r.code == (0 if strict(r.out)["equal"] else 1), r.code)
        c.check("%s equals itself" % stem, c.run("diff", path, path, "--quiet").code == 0)
        copy = os.path.join(tmp, stem)
        if c.run("convert", path, "--renumber", "all=1001", "-o", copy).code == 0:
            r = c.run("diff", path, os.path.join(copy, os.path.basename(path)), "--match", "position")
            c.check("%s renumbered is the same deck" % stem, r.code == 0, r.out.decode()[:300])
        if c.run("convert", path, "--units", "Mg,mm,s", "-o", copy + "-units").code == 0:
            r = c.run("diff", path, os.path.join(copy + "-units", os.path.basename(path)))
            c.check("%s in other units is the same deck" % stem, r.code == 0, r.out.decode()[:300])


def same_bytes(c, tmp):
    runs = [(*words, "--json", "-") for words in VERBS_WITH_JSON if "--costs" not in words]  # times differ
    for words in runs + [("lint", "--format", "json"), ("lint", "--format", "human")]:
        first = None
        for threads, locale in ((1, "C"), (2, "C.UTF-8"), (7, "de_DE.UTF-8")):
            r = c.run(*words, *SAMPLES, "--threads", threads, env={"LC_ALL": locale})
            first = r if first is None else first
            c.check("%s: same bytes with %d threads" % (" ".join(words), threads), r.out == first.out and r.code == first.code)


BLOCKS = {"deck-meta": "meta", "deck-earlier": "earlier", "deck-ties": "tie_lines", "deck-crossed": "crossings", "deck-moved": "moved",
          "deck-cycle": "first_cycle", "deck-repair": "repair"}


def pages(c, tmp):
    """The JSON blocks of a page against their definitions in its schema."""
    schema = json.loads(read(os.path.join(SCHEMAS, "page.schema.json")))
    sample = {os.path.basename(path)[:-9]: path for path in SAMPLES}
    earlier = os.path.join(tmp, "earlier.json")
    c.run("gaps", sample["crash_box"], "--quiet", "--json", earlier)
    seen = set()
    for words in (("gaps", sample["every_mistake"]), ("gaps", sample["welds"]), ("gaps", sample["crash_box"], "--crossings", "--compare", earlier),
                  ("fix", sample["too_close"], "--strategy", "move-nodes")):
        file = os.path.join(tmp, "page.html")
        r = c.run(*words, "--quiet", "--html", file)
        if "has no viewer" in r.text:
            return
        for kind, block, text in re.findall(r'<script type="([^"]*)" id="([^"]*)">(.*?)</script>', read(file).decode(), re.S):
            if block not in BLOCKS:
                continue
            seen.add(block)
            value = json.loads(text if kind.endswith("json") else zlib.decompress(base64.b64decode(text)))
            form = {"$ref": "#/$defs/" + BLOCKS[block]}
            if isinstance(value, list):
                form = {"type": "array", "items": form}
            check_document(c, "%s of %s" % (block, " ".join(words[:1] + words[2:])), json.dumps(value), validators({"$defs": schema["$defs"], "allOf": [form]}))
    c.check("pages have all blocks of JSON", seen == set(BLOCKS), str(set(BLOCKS) - seen))


def documents(c, tmp):
    for words in VERBS_WITH_JSON:
        validators = validators_of(c, words[0])
        for path in SAMPLES:
            name = " ".join(words + (os.path.basename(path)[:-9],))
            r = c.run(*words, path, "--json", "-")
            if c.no_crash(name, r, (0, 1)):
                check_document(c, name, r.out, validators)
    r = c.run("rules", "--json", "-")
    if c.no_crash("rules --json", r, (0,)):
        check_document(c, "rules", r.out, validators_of(c, "rules"))


if __name__ == "__main__":
    run_steps(documents, pages, edit_documents, looks, lint_formats, same_bytes)
