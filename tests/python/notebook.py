"""Runs the code cells of a notebook one after the other, without Jupyter, and compares what they print with the outputs
that the notebook shows.

    python3 tests/python/notebook.py --write samples/python/listing_to_repair.ipynb     stores what they print
"""
import contextlib
import io
import json
import os
import sys


def run(path, cwd=None):
    """Printed text of every code cell, in their order."""
    with open(path, encoding="utf-8") as f:
        cells = json.load(f)["cells"]
    names, printed, back = {"__name__": "__main__"}, [], os.getcwd()
    os.chdir(cwd or os.path.dirname(os.path.abspath(path)))
    try:
        for number, cell in enumerate(cells):
            if cell["cell_type"] != "code":
                continue
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile("".join(cell["source"]), "%s, cell %d" % (os.path.basename(path), number), "exec"), names)
            printed.append(out.getvalue())
    finally:
        os.chdir(back)
    return printed


def stored(path):
    """What the notebook shows of every code cell."""
    with open(path, encoding="utf-8") as f:
        cells = json.load(f)["cells"]
    return ["".join("".join(o.get("text", [])) for o in cell["outputs"]) for cell in cells if cell["cell_type"] == "code"]


def write(path, printed):
    with open(path, encoding="utf-8") as f:
        notebook = json.load(f)
    count = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        text, count = printed[count], count + 1
        cell["execution_count"] = count
        cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": text.splitlines(True)}] if text else []
    with open(path, "w", encoding="utf-8") as f:
        json.dump(notebook, f, indent=1, ensure_ascii=False)
        f.write("\n")


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] != "--write":
        sys.exit(__doc__)
    write(sys.argv[2], run(sys.argv[2]))
