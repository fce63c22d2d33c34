#!/usr/bin/env python3
"""Validates schemas/keywords/*.json, and the examples of tools/docs/schemas.md, against
schemas/keyword.schema.json, as 2020-12 and as draft-7; schemas/messages/*.json against
schemas/messages.schema.json.

Prints every violation with file and JSON path, then "N passed, 0 failed"; exit code 1 on failure.
Some deliberately wrong documents must be refused as well, so that a lax schema is noticed.
"""
import copy
import json
import pathlib
import re
import sys

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOOD = {"keyword": "/A", "doc": "d", "cards": [{"name": "c", "fields": [
    {"name": "f", "cols": [1, 10], "type": "id", "ref": "node"}]}]}
FIELD = ("cards", 0, "fields", 0)


def changed(path, value):
    """GOOD with one entry replaced, or removed when value is None."""
    document = copy.deepcopy(GOOD)
    place = document
    for key in path[:-1]:
        place = place[key]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return document


BAD = {
    "unknown key": changed(("colour",), "red"),
    "no keyword": changed(("keyword",), None),
    "keyword without slash": changed(("keyword",), "A"),
    "unknown kind": changed(("kind",), "interface"),
    "no columns": changed(FIELD + ("cols",), None),
    "column 101": changed(FIELD + ("cols",), [1, 101]),
    "unknown type": changed(FIELD + ("type",), "integer"),
    "id without target": changed(FIELD + ("ref",), None),
    "dimension of an id": changed(FIELD + ("dim",), [0, 1, 0]),
    "version that does not exist": changed(("from",), 111),
    "condition that tests nothing": changed(("cards", 0, "when"), [{"field": "f"}]),
    "axes of a node": changed(FIELD + ("axes",), [{}, {}, {"colour": 1}]),
    "a single axis": changed(FIELD + ("axes",), [{}]),
    "a factor that is an id": changed(FIELD + ("over",), {"field": "f"}),
    "a reference value that is an id": changed(FIELD + ("unit_for",), ["f"]),
    "no words": changed(("cards", 0, "when"), [{"field": "f", "words": []}]),
    "empty family": {"schemas": []},
}


def without_twins(pairs):
    """An object of JSON; a key that occurs twice is an error."""
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key occurs twice in the object with " + ", ".join(sorted(found)))
    return found


def check(validator_class, schema):
    """Returns (passed, failed) of all documents with one validator."""
    validator_class.check_schema(schema)
    validator = validator_class(schema)
    dialect = validator_class.__name__
    passed = failed = 0
    if not validator.is_valid(GOOD):
        print(f"{dialect}: the good document is refused")
        failed += 1
    for name, document in BAD.items():
        if validator.is_valid(document):
            print(f"{dialect}: accepts a document with: {name}")
            failed += 1
        else:
            passed += 1
    files = sorted((ROOT / "schemas/keywords").glob("*.json"))
    if not files:
        print("no schema files found")
        failed += 1
    for file in files:
        try:  # the program does not look for them in its own files
            document = json.loads(file.read_text(encoding="utf-8"), object_pairs_hook=without_twins)
        except ValueError as error:
            print(f"{file.name}: {error}")
            failed += 1
            continue
        errors = list(validator.iter_errors(document))
        for error in errors:
            where = "/".join(str(part) for part in error.absolute_path)
            print(f"{dialect}: {file.name}: /{where}: {error.message}")
        failed += bool(errors)
        passed += not errors
    examples = re.findall(r"```json\n(.*?)```", (ROOT / "tools/docs/schemas.md").read_text(encoding="utf-8"), re.S)
    for number, example in enumerate(examples, 1):
        errors = list(validator.iter_errors(json.loads(example)))
        for error in errors:
            print(f"{dialect}: schemas.md, example {number}: {error.message}")
        failed += bool(errors)
        passed += not errors
    if not examples:
        print("no example in tools/docs/schemas.md")
        failed += 1
    return passed, failed


def report(kind, found):
    """(passed, failed) of {file: [what is wrong with it]}, printed."""
    for file, wrong in found.items():
        for line in wrong:
            print(f"{file.name}: {line}")
    if not found:
        print(f"no {kind} found")
    failed = sum(1 for wrong in found.values() if wrong)
    return len(found) - failed, failed or int(not found)


def violations(schema, document):
    validator = jsonschema.Draft202012Validator(json.loads((ROOT / "schemas" / schema).read_text(encoding="utf-8")))
    return [f"/{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in validator.iter_errors(document)]


def check_messages():
    """Returns (passed, failed) of the catalogues of solver messages."""
    found = {}
    for file in sorted((ROOT / "schemas/messages").glob("*.json")):
        catalogue = json.loads(file.read_text(encoding="utf-8"))
        numbers = [message["number"] for message in catalogue["messages"]]
        found[file] = violations("messages.schema.json", catalogue)
        found[file] += [f"{n} is there twice" for n in sorted({n for n in numbers if numbers.count(n) > 1})]
    return report("messages", found)


def main():
    schema = json.loads((ROOT / "schemas/keyword.schema.json").read_text(encoding="utf-8"))
    counts = [check(cls, schema) for cls in (jsonschema.Draft202012Validator,
                                             jsonschema.Draft7Validator)] + [check_messages()]
    passed, failed = (sum(column) for column in zip(*counts))
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
