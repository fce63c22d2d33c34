#!/usr/bin/env python3
"""Validates schemas/keywords/*.json, and the examples of tools/docs/schemas.md, against
schemas/keyword.schema.json, as 2020-12 and as draft-7; schemas/messages/*.json against
schemas/messages.schema.json.

Some deliberately wrong documents must be refused as well, so that a lax schema is noticed.
"""
import copy
import glob
import json
import os
import re
import sys

import jsonschema

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count, read  # noqa: E402

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


def violations(validator, document):
    return "; ".join("/%s: %s" % ("/".join(map(str, e.absolute_path)), e.message) for e in validator.iter_errors(document))


def schema(name):
    return json.loads(read(os.path.join(ROOT, "schemas", name)))


def check_keywords(c, validator_class):
    """All documents with one validator."""
    validator_class.check_schema(schema("keyword.schema.json"))
    validator, dialect = validator_class(schema("keyword.schema.json")), validator_class.__name__
    c.check(dialect + ": the good document", validator.is_valid(GOOD))
    for name, document in BAD.items():
        c.check("%s: refuses a document with: %s" % (dialect, name), not validator.is_valid(document))
    files = sorted(glob.glob(os.path.join(ROOT, "schemas", "keywords", "*.json")))
    c.check("there are schemas", files)
    for file in files:
        try:  # the program does not look for them in its own files
            wrong = violations(validator, json.loads(read(file), object_pairs_hook=without_twins))
        except ValueError as error:
            wrong = error
        c.check("%s: %s" % (dialect, os.path.basename(file)), not wrong, wrong)
    examples = re.findall(r"```json\n(.*?)```", read(os.path.join(ROOT, "tools", "docs", "schemas.md")).decode(), re.S)
    c.check("there are examples in tools/docs/schemas.md", examples)
    for number, example in enumerate(examples, 1):
        wrong = violations(validator, json.loads(example))
        c.check("%s: schemas.md, example %d" % (dialect, number), not wrong, wrong)


def check_messages(c):
    """The catalogues of solver messages."""
    validator = jsonschema.Draft202012Validator(schema("messages.schema.json"))
    files = sorted(glob.glob(os.path.join(ROOT, "schemas", "messages", "*.json")))
    c.check("there are messages", files)
    for file in files:
        catalogue = json.loads(read(file))
        wrong = violations(validator, catalogue)
        c.check(os.path.basename(file), not wrong, wrong)
        numbers = [message["number"] for message in catalogue["messages"]]
        twice = sorted({n for n in numbers if numbers.count(n) > 1})
        c.check("%s: every number once" % os.path.basename(file), not twice, twice)


def main():
    c = Count()
    for validator_class in (jsonschema.Draft202012Validator, jsonschema.Draft7Validator):
        check_keywords(c, validator_class)
    check_messages(c)
    c.finish()


if __name__ == "__main__":
    main()
