"""The keyword schemas of schemas/keywords, tables ("for") written out."""
import json
import pathlib

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "schemas" / "keywords"


def filled(value, row):
    """A JSON value with each "{name}" of its texts replaced by the word of the row."""
    if isinstance(value, str):
        for name, word in row.items():
            value = value.replace("{" + name + "}", word)
        return value
    if isinstance(value, list):
        return [filled(item, row) for item in value]
    if isinstance(value, dict):
        return {key: filled(item, row) for key, item in value.items()}
    return value


def written_out(value, key=None):
    """A JSON value with the tables of its lists written out; `key` names the list."""
    if isinstance(value, dict):
        return {name: written_out(item, name) for name, item in value.items()}
    if not isinstance(value, list):
        return value
    items = []
    for item in value:
        if isinstance(item, dict) and "for" in item:
            names, *rows = item["for"]
            for words in rows:
                items += written_out(filled(item[key], dict(zip(names, words))), key)
        else:
            items.append(written_out(item, key))
    return items


def keyword_schemas():
    for file in sorted(FOLDER.glob("*.json")):
        document = json.loads(file.read_text(encoding="utf-8"))
        of_all = document.get("demands", {}) if "schemas" in document else {}
        for schema in written_out(document.get("schemas", [document]), "schemas"):
            demands = {**of_all, **schema.get("demands", {})}
            yield schema | {"demands": {word: stop for word, stop in demands.items() if stop is not None}}
