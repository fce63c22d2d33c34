#!/usr/bin/env python3
"""schemas/output holds what `deck schema VERB` prints; all are JSON schemas, and what they refer to is there. Members of
documents are named in the tables that schemas and documents are made of, nowhere else.

  check_schemas.py [DECK]     DECK_RECORD=1 writes the files anew"""
import glob
import json
import os
import re
import sys

import jsonschema

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Checks  # noqa: E402

FOLDER = os.path.join(ROOT, "schemas", "output")
# Members are named in tables of columns alone. These write some by hand: formats of others, the streamed deck, lists
# of documents, and what several documents begin with.
BY_HAND = {"libdeck/report/ci.cpp", "libdeck/report/json/deck_json.cpp", "libdeck/report/record.cpp",
           "libdeck/report/findings.cpp", "libdeck/report/gate.cpp", "libdeck/report/json/shared_records.cpp",
           "tools/cli/common.cpp"}


def references(value):
    """Every "$ref" of a schema."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key == "$ref":
                yield item
            else:
                yield from references(item)
    elif isinstance(value, list):
        for item in value:
            yield from references(item)


def written_by_hand():
    """Files of the reports and of the program that write a member with its name outside of a table."""
    for top in ("libdeck", "tools/cli"):
        for path in glob.glob(os.path.join(ROOT, top, "**", "*.[ch]pp"), recursive=True):
            with open(path, encoding="utf-8") as f:
                if re.search(r"\.(?:field|key)\(\"", f.read()):
                    yield os.path.relpath(path, ROOT)


def main():
    c = Checks(__doc__)
    found = set(written_by_hand())
    c.check("members of documents are named in tables of columns", found == BY_HAND, ", ".join(sorted(found ^ BY_HAND)))
    files = sorted(glob.glob(os.path.join(FOLDER, "*.schema.json")))
    schemas = {}
    for path in files:
        name = os.path.basename(path).split(".")[0]
        if name in ("batch", "deck"):  # written by hand: their documents are no tables
            with open(path, encoding="utf-8") as f:
                schemas[os.path.basename(path)] = json.load(f)
            continue
        printed = c.run("schema", name)
        if c.options.record and printed.code == 0:
            with open(path, "w", encoding="utf-8") as f:
                f.write(printed.out.decode())
        with open(path, encoding="utf-8") as f:
            text = f.read()
        c.check("deck schema %s prints %s" % (name, os.path.relpath(path, ROOT)), printed.out.decode() == text)
        schemas[os.path.basename(path)] = json.loads(text)
    for name, schema in schemas.items():
        try:
            jsonschema.Draft202012Validator.check_schema(schema)
            missing = []
        except jsonschema.SchemaError as error:
            missing = [error.message]
        for reference in references(schema):
            file, _, pointer = reference.partition("#/")
            place = schemas.get(file or name, {})
            for key in pointer.split("/"):
                place = place.get(key, {})
            if not place:
                missing.append(reference)
        c.check("%s is a schema and complete" % name, not missing, ", ".join(missing[:5]))
    unknown = c.run("schema", "nothing")
    c.check("an unknown verb ends with 2 and the list", unknown.code == 2 and "gaps" in unknown.text, unknown.text)
    return c.finish()


if __name__ == "__main__":
    sys.exit(main())
