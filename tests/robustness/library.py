#!/usr/bin/env python3
"""deck batch with verbs that write: a library of decks that share includes is rewritten as one. Every group of
decks that share files is written whole or not at all, every result is verified, the bytes are those of deck
convert and do not depend on kills, jobs or shards, and what is gone or changed since is noticed. With --all the
library has 1000 decks and is killed twenty times."""
import json
import os
import random
import shutil
import signal
import subprocess
import time

from common import ROOT, differing, put, read, run_steps, tree, write, wrong_schemas
from kill import FAILURES, Striker, whole_or_old
from together import pieces


def grid(first, height, side):
    """A plate of side x side nodes: /NODE rows, and the ids of its shells' corners."""
    rows, shells = "", ""
    for i in range(side):
        for j in range(side):
            rows += "%10d%20.4f%20.4f%20.4f\n" % (first + i * side + j, 5.0 * i, 5.0 * j, height)
    for i in range(side - 1):
        for j in range(side - 1):
            a = first + i * side + j
            shells += "%10d%10d%10d%10d%10d\n" % (a, a, a + 1, a + side + 1, a + side)
    return rows, shells


def library(directory, families, each, side=4):
    """families x each decks; the decks of a family share a mesh and a contact, all differ in a comment and a value."""
    head, _, groups, contact = pieces()
    at = head.index("/MAT")  # in an include of its own: its numbers depend on all units
    head, material = head[:at], head[at:]
    files = {}
    for f in range(families):
        low, low_shells = grid(1, 0.0, side)
        high, high_shells = grid(10001, 1.0 + 0.01 * f, side)
        common = "family%03d/common/" % f
        files[common + "mesh.inc"] = "/NODE\n" + low + high + "/SHELL/1\n" + low_shells + "/SHELL/2\n" + high_shells
        files[common + "inter.inc"] = contact
        files[common + "mat.inc"] = material
        for d in range(each):
            name = "family%03d/deck%02d/car%02d_0000.rad" % (f, d, d)
            own = "# deck %d of family %d\n" % (d, f)
            files[name] = head + own + "#include ../common/mat.inc\n#include ../common/mesh.inc\n" + groups + "#include ../common/inter.inc\n/END\n"
    put(directory, files)


def results(directory):
    return {k: v for k, v in tree(directory).items() if ".batch" not in k.split(os.sep)}


def decks_of(directory):
    """What of a tree is decks: no summaries."""
    return {k: v for k, v in results(directory).items() if k not in ("summary.json", "index.html", "losses.json")}


def summary(directory, name="summary.json"):
    return json.loads(read(os.path.join(directory, name)))["decks"]


def entries(directory):
    return {os.path.basename(d["deck"]): d for d in reversed(summary(directory))}


def as_by_hand(c, tmp):
    """The batch writes what deck convert writes of the whole directory."""
    lib = os.path.join(tmp, "lib")
    library(lib, 3, 2)
    for verb in (["convert", "--units", "kg,m,s"], ["convert", "--version", "2018"], ["convert", "--renumber", "node+1000"],
                 ["convert", "--resolve-defaults"], ["convert", "--flatten"], ["convert", "--extract-contacts", "1"],
                 ["fix", "--strategy", "inacti"]):
        out, hand = os.path.join(tmp, "out"), os.path.join(tmp, "hand")
        for path in (out, hand):
            shutil.rmtree(path, ignore_errors=True)
        r = c.run("batch", "-o", out, lib, "--verb", " ".join(verb))
        h = c.run(verb[0], lib, *verb[1:], "-o", hand, "-q")
        c.check("%s: as by hand" % " ".join(verb), r.code == h.code and results(hand) and
                results(hand) == {k: v for k, v in decks_of(out).items() if k.endswith((".rad", ".inc"))},
                "%s, %s; %s" % (r.code, h.code, r.text[-300:]))


def divided(c, tmp):
    """Shards keep decks that share files together, and merge into the same bytes."""
    lib, one, out = (os.path.join(tmp, n) for n in ("dlib", "one", "parts"))
    library(lib, 5, 3)
    verb = ("--verb", "convert --units kg,m,s")
    c.run("batch", "-o", one, lib, *verb)
    for i in (1, 2, 3):
        r = c.run("batch", "-o", out, lib, *verb, "--shard", "%d/3" % i)
        part = [d["deck"].split(os.sep + "family")[1][:3] for d in summary(out, "summary-%d-of-3.json" % i)]
        c.check("shard %d: whole families" % i, r.code == 0 and all(part.count(f) == 3 for f in part), str(part))
    r = c.run("batch", "-o", out, "--merge")
    merged = {k: v for k, v in results(out).items() if "-of-3" not in k}
    c.check("shards merge into the bytes of one process", r.code == 0 and merged == results(one), differing(merged, results(one)))
    other = os.path.join(tmp, "other")
    c.run("batch", "-o", other, lib, *verb, "--jobs", "3", "--threads", "3")
    c.check("three jobs: same bytes", results(other) == results(one), differing(results(other), results(one)))
    manifest = write(os.path.join(tmp, "list.txt"), os.path.join(lib, "family00[01]", "*", "*_0000.rad") + "\n")
    r = c.run("batch", "-o", os.path.join(tmp, "pattern"), "--manifest", manifest, *verb)
    c.check("a pattern in a manifest", b"6 decks: 6 clean" in r.out, r.text[-200:])


def together_or_not(c, tmp):
    """One deck that cannot be converted holds back those that share files with it, and no other."""
    lib, out = os.path.join(tmp, "tlib"), os.path.join(tmp, "tout")
    library(lib, 2, 3)
    bad = os.path.join(lib, "family000", "deck01", "car01_0000.rad")
    good = read(bad)

    def converted(text, units="kg,m,s"):
        write(bad, text)
        return c.run("batch", "-o", out, lib, "--verb", "convert --units " + units)
    r = converted(good.replace(b"/END", b"/UNHEARD/OF/1\nx\n       1.0       2.0\n/END"))
    states = [d["status"] for d in summary(out)]
    c.check("one refused, two skipped, the other family written", r.code == 1 and states == ["skipped", "failed", "skipped"] + 3 * ["clean"], str(states))
    c.check("nothing of that family", not any(k.startswith("family000") for k in results(out)), str(list(results(out))))
    open_ = json.loads(read(os.path.join(out, "losses.json")))["undecided"]
    c.check("the loss report names the place", len(open_) == 1 and open_[0]["file"].endswith("car01_0000.rad"), str(open_))
    # Two unit systems over one include.
    other = good.replace(b"                  kg                  mm                  ms\n" * 2, b"                  Mg                  mm                   s\n" * 2)
    c.check("the sample has the units that this changes", other != good)
    r = converted(other, "kg,m,ms")
    entry = entries(out)["car01_0000.rad"]
    c.check("an include in two unit systems: both decks are named, with their units", r.code == 2 and entry["status"] == "failed" and
            all(word in json.dumps(entry) for word in ("car00_0000.rad", "car01_0000.rad", "Mg, mm, s", "kg, mm, ms")), str(entry))
    r = converted(good)
    c.check("mended: converted", r.code == 0 and any(k.startswith("family000") for k in results(out)), r.text[-200:])
    # Refused after it was written: its files are still the batch's own, and are replaced when it is mended.
    written = os.path.join(out, "family000", "deck01", "car01_0000.rad")
    refused, r = converted(other), converted(good.replace(b"/END", b"/TITLE\nnewer\n/END"))
    c.check("refused and mended again: replaced", refused.code == 2 and r.code == 0 and b"newer" in read(written), "%s; %s" % (refused.code, r.text[-200:]))
    # A file that somebody edited is not the batch's own any more.
    by_hand = read(written) + b"# edited\n"
    write(written, by_hand)
    r = converted(good)
    c.check("a result that somebody edited is not replaced", r.code == 2 and "--overwrite" in r.text and read(written) == by_hand, r.text[-300:])
    os.remove(written)
    shutil.rmtree(os.path.join(lib, "family001"))
    r = converted(good)
    c.check("decks that are gone leave the summary; no deck is deleted", r.code == 0 and len(entries(out)) == 3 and any(
        k.startswith("family001") for k in results(out)), str(list(results(out))))


def in_place(c, tmp):
    """In place: done once whatever happens, with numbered backups, and other decks are looked after."""
    lib, out = os.path.join(tmp, "plib"), os.path.join(tmp, "pout")
    library(lib, 1, 3)
    before = tree(lib)
    verb = ("--verb", "convert --renumber node+1000 --in-place --backup")
    deck = os.path.join(lib, "family000", "deck00", "car00_0000.rad")
    r = c.run("batch", "-o", out, deck, "--verb", "convert --renumber node+1000 --in-place --root " + lib)
    c.check("a deck whose includes others need is refused", r.code == 2 and "car01_0000.rad" in json.dumps(entries(out)) and tree(lib) == before, r.text[-200:])
    shutil.rmtree(out)
    r = c.run("batch", "-o", out, lib, *verb)
    once = tree(lib)
    c.check("in place", r.code == 0 and once != before, r.text[-200:])
    c.check("backups hold what was there", all(once[k + ".orig"] == before[k] for k in before if once[k] != before[k]))
    r = c.run("batch", "-o", out, lib, *verb)
    c.check("again: nothing is done twice", r.code == 0 and b"3 were finished before" in r.out and tree(lib) == once, r.text[-200:])
    write(deck, read(deck) + b"# edited\n")
    edited = tree(lib)
    r = c.run("batch", "-o", out, lib, *verb)
    c.check("edited since: said, not converted twice", r.code == 2 and b"--force" in r.err and tree(lib) == edited, r.text[-200:])
    r = c.run("batch", "-o", out, lib, *verb, "--force")
    c.check("--force converts again and numbers the backups", r.code == 0 and any(k.endswith(".orig.2") for k in tree(lib)), r.text[-200:])
    # Decks that are not in the list any more are no results of earlier, though they lie where results go.
    beside, names = os.path.join(tmp, "beside"), ("too_close_0000.rad", "crash_box_0000.rad")
    put(beside, {name: read(os.path.join(ROOT, "samples", name)) for name in names})
    for verb in ("convert --renumber node+1000 --in-place", "fix --strategy inacti --in-place"):
        c.run("batch", "-o", ".", *names, "--verb", verb, "--force", cwd=beside)
        c.run("batch", "-o", ".", names[0], "--verb", verb, "--force", cwd=beside)
        c.check("%s: a deck that is not named any more stays" % verb, os.path.exists(os.path.join(beside, names[1])))
    # Who shares a file that cannot be read is not known.
    broken = os.path.join(tmp, "broken")
    library(broken, 1, 2)
    shared = os.path.join(broken, "family000", "common", "mat.inc")
    os.remove(shared)
    write(shared + ".gz", b"\x1f\x8b cut off")
    before = tree(broken)
    p = c.run("batch", "-o", os.path.join(tmp, "bout"), broken, "--verb", "convert --renumber node+1000 --in-place")
    c.check("in place, a file that cannot be read: said, nothing is written", p.code == 2 and b"mat.inc.gz" in p.err and b"nothing was written" in p.err and
            tree(broken) == before, p.text[-300:])
    # What a conversion had no effect on may be edited.
    other, plain = os.path.join(tmp, "other"), os.path.join(tmp, "plain", "car_0000.rad")
    write(plain, read(os.path.join(ROOT, "samples", "too_close_0000.rad")))
    for turn in range(2):
        p = c.run("batch", "-o", other, plain, "--verb", "convert --in-place")
        c.check("nothing to convert in place, turn %d" % turn, p.code == 0 and b"finished before" not in p.out, p.text[-200:])
        write(plain, read(plain) + b"# edited\n")


def unverified(c, tmp):
    """A conversion that does something else (here by a wrong schema) is not written, and the difference is named."""
    lib, out = (os.path.join(tmp, n) for n in ("vlib", "vout"))
    library(lib, 2, 1)
    schemas = wrong_schemas(os.path.join(tmp, "schemas"), "inter_type7.json")
    r = c.run("batch", "-o", out, lib, "--schemas", schemas, "--verb", "convert --units kg,m,s")
    text = json.dumps(entries(out)) if r.code in (0, 1) else ""
    c.check("what does not verify is not written and named", r.code == 1 and not decks_of(out) and "not the same model" in text, "%s; %s" % (r.code, r.text[-300:] + text[:500]))
    r = c.run("batch", "-o", out, lib, "--schemas", schemas, "--verb", "convert --units kg,m,s --no-verify")
    c.check("--no-verify writes it", r.code == 0 and len(decks_of(out)) == 8, r.text[-300:])


def killed(c, tmp):
    """Killed at random, resumed: the bytes of an undisturbed run."""
    families, each, kills = (250, 4, 20) if c.options.all else (12, 3, 6)
    for name, target, verb in (("below another directory", "out", "convert --units kg,m,s"), ("in place", ".", "convert --renumber node+1000 --in-place")):
        strikes(c, os.path.join(tmp, target), families, each, kills, ["batch", "-o", "out", ".", "--verb", verb, "--jobs", "2"], target, name)


def strikes(c, tmp, families, each, kills, command, target, name):
    r = random.Random(7)
    calm, lib = os.path.join(tmp, "calm"), os.path.join(tmp, "klib")
    library(calm, families, each)
    library(lib, families, each)
    start = time.monotonic()
    first = c.run(*command, cwd=calm, timeout=900)
    took = time.monotonic() - start
    if not c.check("%s: undisturbed" % name, first.code == 0, first.text[-300:]):
        return
    struck = 0
    for _ in range(kills):
        process = subprocess.Popen([c.program, *command], cwd=lib, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(r.uniform(0.005, max(0.02, took * 0.6)))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            struck += 1
        process.wait()
    last = c.run(*command, cwd=lib, timeout=900)
    now, expected = (results(os.path.join(d, target)) for d in (lib, calm))
    c.check("%s: killed %d times and resumed: the same bytes" % (name, struck), last.code == 0 and now == expected and struck >= kills // 3,
            "%s; struck %d; %s" % (last.text[-200:], struck, differing(now, expected)))
    again = c.run(*command, cwd=lib, timeout=900)
    c.check("%s: then nothing is left to do" % name, b"%d were finished before" % (families * each) in again.out, again.text[-200:])
    print("%s: %d decks in %.2f s, killed %d times" % (name, families * each, took, struck))


def full_disk(c, tmp):
    """A disk that is full, or breaks, at any call: what is there is whole, it is said, and the next run completes it."""
    r, strikes, shim = random.Random(9), 40 if c.options.all else 8, c.preload("fault.c", tmp)
    for verb, target in (("convert --units kg,m,s", "out"), ("fix --strategy inacti", "out"), ("convert --renumber node+1000 --in-place", ".")):
        command = ["batch", "-o", "out", ".", "--verb", verb, "--jobs", "1"]
        lib = os.path.join(tmp, "full")

        def prepare():
            shutil.rmtree(lib, ignore_errors=True)
            library(lib, 2, 2, side=12)
        prepare()
        before = tree(lib)
        first = c.run(*command, cwd=lib)
        expected = results(os.path.join(lib, target))
        decks = {k: v for k, v in expected.items() if k.endswith((".rad", ".inc"))}
        if not c.check("%s: runs" % verb, first.code in (0, 1) and decks and (target == "out" or decks != before), first.text[-300:]):
            continue

        def afterwards(name, code, text):
            now = {k: v for k, v in tree(lib).items() if k.endswith((".rad", ".inc"))}
            old, new = dict(before), {os.path.normpath(os.path.join(target, k)): v for k, v in decks.items()}
            why = whole_or_old(now, old, dict(old, **new), False)
            last = c.run(*command, cwd=lib)
            done = results(os.path.join(lib, target))
            c.check(name, not why and last.code == first.code and done == expected, "%s; exit code %s, then %s; %s; %s; %s" % (
                why, code, last.code, differing(done, expected), text[-200:].strip(), last.text[-200:].strip()))
        # No file can become larger than this: the mesh does not fit, the decks do.
        prepare()
        small = c.run(*command, cwd=lib, file_bytes=max(len(v) for v in before.values()) // 2)
        c.check("%s, a file does not fit: it is said which" % verb, small.code >= 2 and "mesh.inc" in small.text, "%s; %s" % (small.code, small.text[-400:]))
        afterwards("%s, a file does not fit: the next run completes it" % verb, small.code, small.text)
        if shim is None:
            continue
        s, struck = Striker(c, shim, tmp), 0
        for number in sorted(r.sample(range(1, 160), strikes)):
            prepare()
            action = r.choice(FAILURES)
            code, hit, text = s.run(number, action, *command, cwd=lib)
            struck += hit
            afterwards("%s, error %s at call %d" % (verb, action, number), code, text)
        c.check("%s: the errors met calls that touch files (%d)" % (verb, struck), struck >= strikes // 3)


def read_once(c, tmp):
    """An include that can be read when a deck is, but not when its result is: nothing is written, by whatever conversion."""
    shim = c.preload("fault.c", tmp)
    if shim is None:
        return
    lib, out = (os.path.join(tmp, n) for n in ("olib", "oout"))
    library(lib, 1, 1)
    deck, before = os.path.join(lib, "family000", "deck00", "car00_0000.rad"), tree(lib)
    for conversion in (("--version", "2018"), ("--units", "kg,m,s"), ("--renumber", "part+10"), ("--resolve-defaults",)):
        whole = c.run("convert", deck, *conversion, "-o", out)
        changed = {os.path.basename(k) for k, v in tree(out).items() if v not in before.values()}
        shutil.rmtree(out)
        # What a step changes is in memory; the others are read again.
        for name in sorted({"mat.inc", "mesh.inc", "inter.inc"} - changed):
            r = c.run("convert", deck, *conversion, "-o", out, env={"LD_PRELOAD": shim, "DECK_FAULT_OPEN": "once:" + name})
            c.check("%s: %s can be read once only: nothing is written, and it is said" % (conversion[0], name), whole.code == 0 and r.code == 3 and
                    not os.path.exists(out) and "could be read before, but not again" in r.text and name in r.text, "%s, %s; %s" % (whole.code, r.code, r.text[-400:]))
            shutil.rmtree(out, ignore_errors=True)
    c.check("the decks are as they were", tree(lib) == before)


if __name__ == "__main__":
    run_steps(as_by_hand, divided, together_or_not, in_place, unverified, read_once, full_disk, killed)
