#!/usr/bin/env python3
"""schemas/output holds what `deck schema VERB` prints; all are JSON schemas, and what they refer to is there. Members of
documents are named in the tables that schemas and documents are made of, nowhere else. Of how many keywords it is not
known whether the solver asks for something is printed, and is never more than recorded here.

  check_schemas.py [DECK]     DECK_RECORD=1 writes the files anew"""
import glob
import json
import os
import re
import sys

import jsonschema

for sibling in ("robustness", "keyword"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, sibling))
from common import ROOT, Checks  # noqa: E402
from schema_files import keyword_schemas  # noqa: E402

FOLDER = os.path.join(ROOT, "schemas", "output")
# Members are named in tables of columns alone. These write some by hand: formats of others, the streamed deck, lists
# of documents, and what several documents begin with.
BY_HAND = {"libdeck/report/ci.cpp", "libdeck/report/json/deck_json.cpp", "libdeck/report/record.cpp",
           "libdeck/report/findings.cpp", "libdeck/report/gate.cpp", "libdeck/report/json/shared_records.cpp",
           "tools/cli/common.cpp"}


NOT_KNOWN = {"unit": 223, "id": 220, "data": 607, "entry": 458, "missing": 556, "node": 508, "empty": 314, "required": 587,
             "wrong": 312, "variable": 0, "size": 335}
GROUPS = ("grnod", "surf", "line", "grpart")
OWN_TABLE = ("part", "prop", "mat", "set", "box", "inter", "friction") + GROUPS


def answer(schema, demand):
    """Whether the solver asks blocks of the keyword for it; None: not known. What a keyword cannot have it is not asked for."""
    demands, kind = schema["demands"], schema.get("kind", "")
    if demand in demands or (demand == "node" and "missing" in demands):
        return demands.get(demand, demands.get("missing")) is not False
    cards = schema.get("cards", [])
    fields = [field for card in cards for field in card.get("fields", [])]
    complete = "cards" in schema and (not schema.get("opaque_tail") or schema.get("full_layout", False))
    ids = [field for field in fields if field["type"] == "id"]

    def of(about, key, kinds=False):
        if about and all(key in field or (kinds and field["ref"] in demands) for field in about):
            return any(key in field or demands[field["ref"]] is not False for field in about)
        return False if complete and not about else None

    if demand == "unit":
        real = any("dim_when" in f or f.get("dim_unknown") or any(f.get("dim", [0])[:3]) for f in fields)
        return True if schema.get("bulk") or real else False if complete or not schema.get("unit", True) else None
    if demand == "id":
        known = "unique" in schema or kind in OWN_TABLE or kind.startswith("gr")
        return True if known else None if schema.get("id", True) else False
    if demand == "entry":
        return False if complete and not any("repeat" in card for card in cards) else None
    if demand == "wrong":
        return of([field for field in fields if field["type"] == "flag" or "words" in field], "wrong")
    if demand == "variable":
        return any("words" in field for field in fields) if schema["keyword"].startswith("/TH/") else False
    if demand == "size":
        return False if complete and sum(field.get("ref") == "node" for field in ids) < 2 and not any(
            field.get("dim", [0, 0])[1] for field in fields) else None
    about = {"node": [f for f in ids if f["ref"] == "node"], "missing": [f for f in ids if f["ref"] != "node"],
             "empty": [f for f in ids if f["ref"] in GROUPS or f["ref"].startswith("gr")]}.get(demand, ids)
    return of(about, "missing" if demand == "node" else demand, demand in ("node", "missing"))


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
    known = list(keyword_schemas())
    for demand, recorded in NOT_KNOWN.items():
        count = sum(answer(schema, demand) is None for schema in known)
        print("%s: not known of %d of %d keywords" % (demand, count, len(known)))
        c.check("%s is known of as many keywords as before" % demand, count <= recorded, "%d > %d" % (count, recorded))
    unknown = c.run("schema", "nothing")
    c.check("an unknown verb ends with 2 and the list", unknown.code == 2 and "gaps" in unknown.text, unknown.text)
    return c.finish()


if __name__ == "__main__":
    sys.exit(main())
