"""Decks as Python objects: deck convert --to json and back. What all scripts here share."""
import json
import os
import subprocess
import sys
import tempfile

DECK = os.environ.get("DECK", "deck")


def call(*arguments):
    """Runs deck and returns what it prints; ends with its message and exit code where it refuses."""
    run = subprocess.run([DECK, *arguments], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        sys.stderr.write(run.stderr)
        sys.exit(run.returncode)
    return run.stdout


def read(path):
    """The deck as the document that schemas/output/deck.schema.json describes."""
    return json.loads(call("convert", path, "--to", "json", "-o", "-", "--quiet"))


def write(document, directory):
    """Writes the deck and its includes below a directory. A card that is out of place, a misspelt
    member or a number that does not fit is an error with its block, card and field."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(document, file)
        file.flush()
        call("convert", file.name, "--from", "json", "-o", directory, "--overwrite", "--quiet")
    return os.path.join(directory, document["files"][0]["path"])


def blocks(document, keyword):
    """All blocks of a keyword, in all files: /INTER is every interface."""
    for file in document["files"]:
        for item in file.get("items", []):
            name = item.get("keyword", "")
            if item["kind"] == "block" and (name == keyword or name.startswith(keyword + "/")):
                yield item


def fields(block, name):
    """The fields of the card of a block that has this one."""
    for line in block["lines"]:
        if isinstance(line, dict) and name in line.get("fields", {}):
            return line["fields"]
    sys.exit("%s/%s has no field %s" % (block["keyword"], block.get("id"), name))
