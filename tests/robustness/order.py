#!/usr/bin/env python3
"""The order in which a deck is written is of no consequence: blocks and rows of every sample shuffled, and blocks moved into includes
in the order of their ids, give the same `deck gaps`. Where the order of files counts, interfaces are taken file by file."""
import json
import os
import random
import re
import tempfile

from common import SAMPLES, run_steps

BULK = ("/NODE", "/SHELL/", "/SH3N/", "/BRICK/", "/TETRA4/", "/PENTA6/", "/TRUSS/", "/BEAM/", "/SPRING/")
FIRST = ("/BEGIN", "/UNIT", "/PARAMETER", "/IOFLAG", "/ANALY", "/TITLE")  # and what keeps the order of the text
SEVERAL = ("/TRANSFORM", "/INIVEL", "/SET/COLLECT")


def blocks_of(path):
    """[lines], each from its header on; what stands before the first is one of its own. Includes are put in."""
    out = [[]]
    for line in open(path):
        if line.startswith("#include"):
            for block in blocks_of(os.path.join(os.path.dirname(path), line.split()[1])):
                out.append(block)
        elif line.startswith("/") and not line.startswith("//"):
            out.append([line])
        else:
            out[-1].append(line)
    return [b for b in out if b]


def category(block):
    return block[0].split("/")[1].strip() if block[0].startswith("/") else ""


def block_id(block):
    found = re.search(r"/(\d+)\s*$", block[0]) or re.search(r"/(\d+)/\d+\s*$", block[0])
    return int(found.group(1)) if found else 0


def parts_of(path):
    """Head, movable blocks, end of a deck; blocks of equal id keep their order, so they are moved as one."""
    head, rest, seen = [], [], {}
    for block in blocks_of(path):
        key = category(block), block_id(block)
        if block[0].startswith("/END"):
            break
        if not block[0].startswith("/") or block[0].startswith(FIRST + SEVERAL):
            head.append(block)
        elif key in seen:
            seen[key] += block
        else:
            seen[key] = list(block)
            rest.append(seen[key])
    return head, rest


def shuffled_rows(block, rng):
    """Rows of a block of nodes or elements in another order; those with cells of their own behind the nodes stay (DK141)."""
    rows = [line for line in block[1:] if line.strip() and not line.startswith(("#", "$", "/"))]
    if not block[0].startswith(BULK) or len(rows) != len(block) - 1:
        return block
    if block[0].startswith(("/SHELL", "/SH3N")) and any(row[60:].strip() for row in rows):
        return block
    rng.shuffle(rows)
    return block[:1] + rows


def answer(checks, path, ids={}):
    """Interfaces and ties of `deck gaps`, without places in files. `ids`: of interfaces, what to call them."""
    r = checks.run("gaps", "--no-config", "--all", "--json", "-", path)
    if not r.out.startswith(b"{"):
        return r.text

    def plain(x):
        if isinstance(x, dict):
            return {k: plain(v) for k, v in x.items() if k not in ("source", "span", "text", "sentences")}
        return [plain(v) for v in x] if isinstance(x, list) else x

    document = json.loads(r.out)
    return [[i.get("type"), ids.get(i["id"], i["id"]), plain({k: v for k, v in i.items() if k not in ("id", "repeated", "title")})]
            for i in document["interfaces"] + document["ties"]]


def text(blocks):
    return "".join(line for block in blocks for line in block)


def shuffled(checks, _):
    for path in SAMPLES:
        name = os.path.basename(path)
        if name == "every_mistake_0000.rad" or "//SUBMODEL" in open(path).read():  # its blocks belong together
            continue
        rng = random.Random(name)
        head, rest = parts_of(path)
        with tempfile.TemporaryDirectory() as folder:
            def deck(file, *blocks, to=folder):
                with open(os.path.join(to, file), "w") as out:
                    out.write("".join(text(b) if isinstance(b, list) else b for b in blocks))
                return os.path.join(to, file)

            whole = answer(checks, deck("x_0000.rad", head, rest, "/END\n"))
            mixed = [shuffled_rows(b, rng) for b in rest]
            rng.shuffle(mixed)
            checks.check(name + " shuffled", answer(checks, deck("x_0000.rad", head, mixed, "/END\n")) == whole)
            # Blocks of each category by id: the smallest stay, the others go into a file and one that it opens.
            ranked = sorted(rest, key=lambda b: (category(b), block_id(b)))
            count = {c: sum(category(b) == c for b in rest) for c in map(category, rest)}
            files, seen = [[], [], []], {}
            for b in ranked:
                at = seen[category(b)] = seen.get(category(b), 0) + 1
                files[3 * (at - 1) // count[category(b)]].append(b)
            deck("b.inc", files[2])
            deck("a.inc", "#include b.inc\n", files[1])
            checks.check(name + " over files", answer(checks, deck("x_0000.rad", head, "#include a.inc\n", files[0], "/END\n")) == whole)
            # Interfaces of an include come behind those of the main file: as with ids in that order.
            inter = sorted((b for b in rest if category(b) == "INTER"), key=block_id)
            others = [b for b in rest if category(b) != "INTER"]
            if len(inter) < 2:
                continue
            half = len(inter) // 2
            deck("a.inc", inter[:half])
            split = answer(checks, deck("x_0000.rad", head, "#include a.inc\n", inter[half:], others, "/END\n"))
            ids = {1000 + i: block_id(b) for i, b in enumerate(inter[half:] + inter[:half])}
            renamed = [[re.sub(r"/\d+(\s*)$", "/%d\\1" % n, b[0])] + b[1:] for n, b in zip(ids, inter[half:] + inter[:half])]
            one = deck("x_0000.rad", head, renamed, others, "/END\n")
            checks.check(name + " by files", split == answer(checks, one, ids))


if __name__ == "__main__":
    run_steps(shuffled)
