#!/usr/bin/env python3
"""Random libraries of decks that share includes, random conversions and fixes of several decks in one call:
what comes out is what each deck, converted alone in its own copy, comes to be, or the call is refused and
changes nothing. In place and into another directory."""
import os
import random
import shutil
import subprocess

from common import ROOT, differing, put, read, run_steps, tree

UNITS = (("Mg", "mm", "s"), ("kg", "cm", "ms"), ("kg", "m", "s"))


def pieces():
    """Parts of a sample that decks can share: what stands before the nodes, the nodes, the groups, the contact."""
    text = read(os.path.join(ROOT, "samples", "too_close_0000.rad")).decode()
    n, s, i, e = (text.index(k) for k in ("/NODE", "/SURF", "/INTER", "/END"))
    return text[:n], text[n:s], text[s:i], text[i:e]


def header_in(header, units):
    """The first lines of a deck with other unit codes (other numbers mean other lengths, which is no matter here)."""
    lines = header.split("\n")
    at = lines.index("/BEGIN")
    row = "".join(code.rjust(20) for code in units)
    lines[at + 3] = lines[at + 4] = row
    return "\n".join(lines)


class Library:
    """Decks in folders of their own and includes in `common` (or beside a deck, or deeper)."""

    def __init__(self, r):
        head, nodes, groups, contact = pieces()
        self.files, self.trees = {}, {}
        if r.random() < 0.3:
            contact = "# decklint: ignore[DK221] reason=unused in all\n" + contact
        if r.random() < 0.6:
            groups += "/GRNOD/NODE/77\nx\n\t      101\n"
        variants = {"common/mesh.inc": nodes, "common/sub/inter.inc": contact, "common/groups.inc": groups}
        units, same = r.choice(UNITS), r.random() < 0.4
        for name in "abc"[:r.randint(2, 3)]:
            main, used = header_in(head, units if same else r.choice(UNITS)), []
            if r.random() < 0.4:
                main += "/NODE\n       %d                 0.0                 0.0               100.0\n" % r.randint(900, 999)
            for target, text in variants.items():
                if r.random() < 0.75:
                    main += "#include ../%s\n" % target
                    used.append(target)
                else:
                    main += text
            if r.random() < 0.4:
                main += "# decklint: ignore[DK221] reason=unused in %s\n/TITLE\nx\n" % name
            own = "%s/%s_0000.rad" % (name, name)
            self.files[own] = main + "/END\n"
            self.trees[own] = [own] + used
            for target in used:
                self.files[target] = variants[target]

    def decks(self):
        return sorted(self.trees)


def random_call(r):
    """A verb with options, without decks and place."""
    conversions = (("--units", ",".join(r.choice(UNITS))), ("--version", r.choice(("2018", "2024", "2026"))),
                   ("--renumber", r.choice(("node+1000", "part+10", "node=1", "surf+5"))), ("--resolve-defaults",), ("--flatten",))
    kind = r.random()
    if kind < 0.6:
        chosen = r.sample(conversions, r.randint(1, 2))
        return ["convert"] + [word for option in chosen for word in option]
    if kind < 0.8:
        return ["fix", "--strategy", r.choice(("move-nodes", "reduce-gap", "inacti"))]
    return ["lint", "--no-config", r.choice(("--fix", "--unsafe-fixes"))]


def lines_gone(before, after):
    return set(before.splitlines()) - set(after.splitlines())


def judge(library, call, before, now, alone, code, place):
    """What is wrong; `alone` is what each deck made of its own copy, or None where it refused."""
    if code not in (0, 1, 2, 3):
        return "exit code %s" % code
    if now == before:
        return ""  # refused, or nothing to do; counted apart
    if code >= 2:
        return "refused with exit code %d, but something was written" % code
    for deck in library.decks():
        if alone[deck] is None:
            return "%s alone is refused, but something was written" % deck
        names = library.trees[deck] if place == "in place" else sorted(alone[deck])
        for name in names:
            if now.get(name) == alone[deck].get(name):
                continue
            if call[0] != "lint" or name not in now:
                return "%s of %s is not what it becomes alone" % (name, deck)
            # A fix that not all decks want is left out; one that was made all of them want.
            if not lines_gone(before[name], now[name]) <= lines_gone(before[name], alone[deck][name]):
                return "%s: a fix that %s does not want" % (name, deck)
    return ""


def ran(c, library, call, place, tmp, given, *more):
    """(the run, what was there before where it is written to, what is there now)"""
    work, where = os.path.join(tmp, "work"), ["--in-place"] if place == "in place" else ["-o", "../out"]
    shutil.rmtree(tmp, ignore_errors=True)
    put(work, library.files)
    before = tree(work)
    run = c.run(*call, *([] if call[0] == "lint" else where), *more, *given, "-q", cwd=work)
    if place == "in place":
        return run, before, tree(work)
    c.check("-o leaves the sources as they are", tree(work) == before, " ".join(call))
    return run, {}, tree(os.path.join(tmp, "out"))


def case(c, r, number, tmp, counts):
    library, call = Library(r), random_call(r)
    for place in ("in place",) if call[0] == "lint" else ("in place", "out"):
        alone = {}
        for deck in library.decks():
            # Alone, nobody looks for the other decks.
            root = ["--root", os.path.dirname(deck)] if place == "in place" else []
            one, _, after = ran(c, library, call, place, tmp, [deck], *root)
            # fix ends with 1 where penetrations remain, lint where findings do: they have written all the same.
            alone[deck] = None if one.code > 1 or (one.code == 1 and call[0] == "convert") else after
        run, before, now = ran(c, library, call, place, tmp, library.decks())
        why = judge(library, call, before, now, alone, run.code, place)
        c.check("%d: %s of %s, %s" % (number, " ".join(call), " ".join(library.decks()), place), not why, "%s; %s" % (why, run.text[-300:].strip()))
        what = call[0], "nothing" if now == before else "done", run.code
        counts[what] = counts.get(what, 0) + 1


def whole_directory(c, r, number, tmp, counts):
    """The same decks named by their directory."""
    library, call = Library(r), random_call(r)
    place = r.choice(("in place", "out")) if call[0] != "lint" else "in place"
    expected, _, wanted = ran(c, library, call, place, tmp, library.decks())
    got, _, now = ran(c, library, call, place, tmp, ["."])
    # Below a directory decks keep their place, also where nothing but their place joins them.
    same = now == wanted or (place == "out" and sorted(now.values()) == sorted(wanted.values()))
    c.check("%d: %s of %s, %s, by their directory" % (number, " ".join(call), " ".join(library.decks()), place), got.code == expected.code and same,
            "%s, expected %s; %s; %s" % (got.code, expected.code, differing(now, wanted), got.text[-300:].strip()))
    counts[expected.code <= 1] = counts.get(expected.code <= 1, 0) + 1


def first_node(text):
    """Smallest id of the first /NODE block."""
    block = text[text.index("/NODE") + 5:].split("\n/")[0]
    return min(int(line[:10]) for line in block.split("\n")[1:] if line and line[0] not in "#$")


def at_the_same_time(c, tmp):
    """Several programs rewrite one deck at the same time: each has its effect, or says that it has none."""
    work = os.path.join(tmp, "work")
    head, nodes, groups, contact = pieces()
    put(work, {"car_0000.rad": head + "#include mesh.inc\n" + groups + contact + "/END\n", "mesh.inc": nodes})
    first = first_node(nodes)
    command = [c.program, "convert", "car_0000.rad", "--renumber", "node+1", "--in-place", "-q"]
    done = refused = 0
    for _ in range(8):
        running = [subprocess.Popen(command, cwd=work, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) for _ in range(4)]
        for process in running:
            text = process.communicate(timeout=120)[1].decode()
            done += process.returncode == 0
            refused += process.returncode == 2 and "changed" in text
            c.check("at the same time: done or refused", process.returncode in (0, 2), text[-200:])
    with open(os.path.join(work, "mesh.inc")) as f:
        now = first_node(f.read())
    c.check("at the same time: %d done, %d refused, as many shifts as were done" % (done, refused),
            now == first + done and done >= 8 and done + refused == 32, "first node %d, was %d" % (now, first))
    c.check("at the same time: nothing is left behind", sorted(tree(work)) == ["car_0000.rad", "mesh.inc"], str(sorted(tree(work))))


def into_one_folder(c, tmp):
    """Two programs write one deck into one folder, each in other units: the deck that lies there is of one of them, and
    who has not written says so."""
    head, nodes, groups, contact = pieces()
    put(tmp, {"car_0000.rad": head + "#include mesh.inc\n" + groups + contact + "/END\n", "mesh.inc": nodes})
    calls = [[c.program, "convert", "car_0000.rad", "--units", units, "--no-verify", "-q", "-o"] for units in ("kg,m,s", "Mg,mm,s")]
    alone = []
    for k, call in enumerate(calls):
        subprocess.run(call + ["alone%d" % k], cwd=tmp, check=True)
        alone.append(tree(os.path.join(tmp, "alone%d" % k)))
    refused = 0
    for _ in range(60):
        shutil.rmtree(os.path.join(tmp, "out"), ignore_errors=True)
        running = [subprocess.Popen(call + ["out"], cwd=tmp, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) for call in calls]
        texts = [process.communicate(timeout=120)[1] for process in running]
        codes = [process.returncode for process in running]
        now = tree(os.path.join(tmp, "out"))
        c.check("one folder: one deck, whole", now in alone, "codes %s" % codes)
        c.check("one folder: who is refused says so", codes == [0, 0] or (sorted(codes) == [0, 2] and now == alone[codes.index(0)] and
                b"at the same time" in texts[codes.index(2)]), "%s %s" % (codes, texts))
        refused += 2 in codes
    c.check("one folder: some calls met (%d)" % refused, refused > 0)


def other_folders(c, work):
    """A shared file that lies in another folder than the deck, by a link or by its path: the decks beside it are found."""
    head, nodes, groups, contact = pieces()
    for name, line in (("link", "#include mesh.inc\n"), ("path", "#include ../mesh.inc\n")):
        put(work, {"own/car_0000.rad": head + line + groups + contact + "/END\n", "mesh.inc": nodes,
                   "other_0000.rad": head + "#include mesh.inc\n" + groups + contact + "/END\n"})
        if name == "link":
            os.symlink("../mesh.inc", os.path.join(work, "own", "mesh.inc"))
        before = tree(work)
        call = [c.program, "convert", "own/car_0000.rad", "--renumber", "node+1", "--in-place", "-q"]
        run = subprocess.run(call, cwd=work, capture_output=True)
        c.check("%s: another deck includes the file, nothing is written" % name,
                run.returncode == 2 and b"other_0000.rad" in run.stderr and tree(work) == before, "%d %s" % (run.returncode, run.stderr[-300:]))
        run = subprocess.run(call + ["other_0000.rad"], cwd=work, capture_output=True)
        c.check("%s: with both decks it changes" % name, run.returncode == 0 and tree(work)["mesh.inc"] != before["mesh.inc"], "%s" % run.stderr[-300:])


def random_libraries(c, tmp):
    r, counts = random.Random(20), {}
    for number in range(400 if c.options.all else 60):
        case(c, r, number, os.path.join(tmp, "case"), counts)
    for verb in ("convert", "fix", "lint"):
        done = sum(n for (v, what, _), n in counts.items() if v == verb and what == "done")
        c.check("%s: something was written in some cases (%d)" % (verb, done), done > 3, str(counts))
    refused = sum(n for (v, what, code), n in counts.items() if code == 2)
    c.check("some calls were refused because decks disagree (%d)" % refused, refused > 3, str(counts))


def random_directories(c, tmp):
    r, counts = random.Random(21), {}
    for number in range(300 if c.options.all else 25):
        whole_directory(c, r, number, os.path.join(tmp, "case"), counts)
    c.check("decks were written in some cases", counts.get(True, 0) > 3, str(counts))


if __name__ == "__main__":
    run_steps(random_libraries, random_directories, at_the_same_time, into_one_folder, other_folders)
