#!/usr/bin/env python3
"""deck batch: the results are those of the verbs, the bytes do not depend on how the work was divided
(jobs, shards, GNU parallel, Snakemake), a batch that was stopped goes on where it was, and one bad deck costs
nothing but itself."""
import glob
import gzip
import json
import os
import shutil
import signal
import subprocess
import time

from common import ROOT, SAMPLES, differing, put, read, run_steps, tree, write
from outputs import check_document, validators_of

CLEAN = read(os.path.join(ROOT, "samples", "clean_plates_0000.rad"))


def visible(directory):
    """Everything but the notes that batch keeps for itself."""
    found = tree(directory) if os.path.isdir(directory) else {}
    return {k: v for k, v in found.items() if not k.startswith(".batch")}


def summary(directory, name="summary.json"):
    return json.loads(read(os.path.join(directory, name)))


def small_decks(directory, number):
    """`number` copies of a small deck, each a little different."""
    return [write(os.path.join(directory, "d%04d_0000.rad" % i), CLEAN + b"# deck %d\n" % i) for i in range(number)]


def results_of_verbs(c, tmp):
    for verb in ("gaps", "params", "cycle", "lint", "gaps --all --crossings", "lint --select DK1,DK2 --no-config"):
        out = os.path.join(tmp, "verbs")
        shutil.rmtree(out, ignore_errors=True)
        r = c.run("batch", "-o", out, "--verb", verb, *SAMPLES)
        if not c.no_crash("batch of " + verb, r, (0, 1)):
            continue
        worst, bad = 0, []
        for path, entry in zip(SAMPLES, summary(out)["decks"]):
            direct = c.run(*verb.split(), path, "--json", "-")
            worst = max(worst, direct.code)
            result = read(os.path.join(out, os.path.basename(path)[:-4] + ".json"))
            if direct.out != result or entry["exit_code"] != direct.code or entry["deck"] != path:
                bad.append(os.path.basename(path))
        c.check("%s: every result is what the verb writes" % verb, not bad, ", ".join(bad))
        c.check("%s: exit code is the worst of the decks" % verb, r.code == worst, "%s, expected %s" % (r.code, worst))
        check_document(c, "summary of " + verb, read(os.path.join(out, "summary.json")), validators_of(c, "batch"))
    lint = {os.path.basename(d["deck"]): d["counts"] for d in summary(out)["decks"]}
    c.check("counts of lint", lint["every_mistake_0000.rad"].get("errors", 0) > 20, str(lint["every_mistake_0000.rad"]))


def divided(c, tmp):
    """The same bytes however the work is divided."""
    decks = list(SAMPLES) + small_decks(os.path.join(tmp, "some"), 9)
    manifest = write(os.path.join(tmp, "decks.txt"), "# all decks\r\n\r\n" + "".join("  %s \r\n" % d for d in decks) + "# the end")
    one = os.path.join(tmp, "one")
    r = c.run("batch", "-o", one, "--jobs", "1", *decks)
    if not c.no_crash("one process", r, (0, 1)):
        return
    expected = visible(one)
    c.check("a result per deck, the summary and the overview", len(expected) == len(decks) + 2)

    def same(name, directory):
        now = {k: v for k, v in visible(directory).items() if not k.startswith("summary-")}
        c.check(name + ": same bytes as one process", now == expected, differing(now, expected))

    def fresh(name):
        shutil.rmtree(os.path.join(tmp, name), ignore_errors=True)
        return os.path.join(tmp, name)
    for jobs, threads in ((2, 0), (5, 1), (3, 3)):
        out = fresh("jobs")
        c.run("batch", "-o", out, "--jobs", jobs, "--threads", threads, *decks)
        same("--jobs %d --threads %d" % (jobs, threads), out)
    out = fresh("manifest")
    c.run("batch", "-o", out, "--manifest", manifest)
    same("--manifest", out)
    out = fresh("stdin")
    c.run("batch", "-o", out, "--manifest", "-", stdin=read(manifest))
    same("--manifest -", out)
    for count in (2, 3, 7):
        out = fresh("shards")
        early = c.run("batch", "-o", out, "--merge")
        c.check("merging nothing is wrong usage", early.code == 2)
        for i in range(1, count + 1):
            r = c.run("batch", "-o", out, "--manifest", manifest, "--shard", "%d/%d" % (i, count))
            c.check("shard %d/%d says so" % (i, count), summary(out, "summary-%d-of-%d.json" % (i, count))["shard"]["index"] == i)
            if i < count:
                c.check("merging before shard %d/%d is refused" % (i + 1, count), c.run("batch", "-o", out, "--merge").code == 2)
        merged = c.run("batch", "-o", out, "--merge")
        c.check("merged exit code is the worst", merged.code == 1, str(merged.code))
        same("%d shards" % count, out)
    # Another number of shards goes on with what is there.
    r = c.run("batch", "-o", out, "--manifest", manifest)
    c.check("a whole run after shards redoes nothing", ("%d were finished before" % len(decks)).encode() in r.out, r.text[-200:])
    same("a whole run after shards", out)
    at_work(c, fresh("at-work"), decks[:2])
    parallel(c, fresh("parallel"), manifest, same)
    snakemake(c, tmp, fresh("snakemake-results"), decks, same)


def launched(c, command, env=None, timeout=300):
    full = dict(os.environ, NO_COLOR="1", PATH=os.path.dirname(c.program) + os.pathsep + os.environ["PATH"], **(env or {}))
    return subprocess.run(command, env=full, stdin=subprocess.DEVNULL, capture_output=True, timeout=timeout)


def at_work(c, out, decks):
    """A file that another shard is about to put in place is left alone; a whole run takes it for one that was left behind."""
    ended = subprocess.Popen(["true"])
    ended.wait()
    temporary = os.path.join(out, ".batch", ".other_0000.record.%d-1.tmp" % ended.pid)
    for name, args, stays in (("a shard leaves the temporary files of others", ("--shard", "1/2"), True), ("a whole run clears up", (), False)):
        write(temporary, "lint")
        c.run("batch", "-o", out, *args, *decks)
        c.check(name, os.path.exists(temporary) == stays)


def snakemake(c, tmp, out, decks, same):
    """samples/Snakefile: one job a deck."""
    if not shutil.which("snakemake"):
        c.skip("snakemake", "it is not installed (snakemake)")
        return
    folder = os.path.join(tmp, "snakemake")
    manifest = write(os.path.join(folder, "decks.txt"), "".join(d + "\n" for d in decks))
    r = launched(c, ["snakemake", "--snakefile", os.path.join(ROOT, "samples", "Snakefile"), "--directory", folder, "--cores", "2",
                     "--config", "manifest=" + manifest, "results=" + out])
    c.check("snakemake ends well", r.returncode == 0, "%d; %s" % (r.returncode, r.stderr[-600:]))
    same("snakemake", out)


def parallel(c, out, manifest, same):
    if shutil.which("parallel"):
        line = 'seq 4 | parallel deck batch -o "$1" --manifest "$2" --jobs 1 --quiet --shard {}/4; deck batch -o "$1" --merge'
        name = "GNU parallel"
    else:
        line = 'seq 4 | xargs -P 4 -I % deck batch -o "$1" --manifest "$2" --jobs 1 --quiet --shard %/4; deck batch -o "$1" --merge'
        name = "xargs -P"
    launched(c, ["sh", "-c", line, "sh", out, manifest])
    same(name, out)


def names(c, tmp):
    """Result names are unique and follow from the list alone."""
    work = os.path.join(tmp, "names")
    put(work, dict.fromkeys(("left/car_0000.rad", "right/car_0000.rad", "a/left/car_0000.rad", "summary.rad", "one_0000.rad", "one_0000.inp",
                             "sub/x_0000.rad"), CLEAN))
    r = c.run("batch", "-o", "out", "left/car_0000.rad", "right/car_0000.rad", "a/left/car_0000.rad", "summary.rad", "one_0000.rad",
              "one_0000.inp", "sub", "./left/../left/car_0000.rad", cwd=work)
    if c.no_crash("decks of the same name", r, (0, 1)):
        got = [d["result"] for d in summary(os.path.join(work, "out"))["decks"]]
        c.check("result names", got == ["names--left--car_0000.json", "right--car_0000.json", "a--left--car_0000.json", "names--summary.json",
                                        "one_0000.json", "one_0000--2.json", "x_0000.json"], str(got))
        c.check("the same deck twice is one", len(got) == 7, str(len(got)))


def bad_decks(c, tmp):
    """Unreadable, crashing and hanging decks fail alone."""
    work = os.path.join(tmp, "bad")
    good = small_decks(work, 4)
    lacking = write(os.path.join(work, "lacking_0000.rad"), CLEAN.replace(b"/END", b"#include nowhere.inc\n/END"))
    decks = good[:2] + [lacking, os.path.join(work, "absent_0000.rad")] + good[2:]
    out = os.path.join(tmp, "bad-out")
    r = c.run("batch", "-o", out, *decks)
    s = summary(out)
    codes = [d["exit_code"] for d in s["decks"]]
    c.check("unreadable decks: codes", r.code == 3 and codes == [0, 0, 3, 3, 0, 0], str(codes))
    c.check("unreadable decks: reasons", "nowhere.inc" in (s["decks"][2]["error"] or "") and "absent" in (s["decks"][3]["error"] or ""),
            str([d["error"] for d in s["decks"]]))
    c.check("no deck, no result", s["decks"][3]["result"] is None and "absent_0000.json" not in visible(out))
    shim = c.preload("fault.c", tmp)
    if shim is None:
        return
    first = {}
    for jobs in (1, 2):
        out = os.path.join(tmp, "crash-out-%d" % jobs)
        write(os.path.join(out, "d0001_0000.json"), "a result of earlier\n")
        start = time.monotonic()
        r = c.run("batch", "-o", out, "--jobs", jobs, "--timeout", "1", *good, env={"LD_PRELOAD": shim, "DECK_FAULT_OPEN": "abort:d0001,hang:d0002"})
        took = time.monotonic() - start
        s = summary(out)
        c.check("crash and hang (%d jobs): only those two fail" % jobs, r.code == 4 and [d["exit_code"] for d in s["decks"]] == [0, 4, 4, 0],
                "%s; %s" % (r.code, r.text[-300:]))
        c.check("crash and hang (%d jobs): reasons" % jobs, "signal 6" in s["decks"][1]["error"] and s["decks"][2]["error"] == "no answer in 1 s",
                str([d["error"] for d in s["decks"]]))
        c.check("crash and hang (%d jobs): in time" % jobs, took < 20, "%.1f s" % took)
        c.check("crash (%d jobs): no result of earlier is left" % jobs, "d0001_0000.json" not in visible(out))
        first = first or visible(out)
        c.check("crash and hang (%d jobs): same bytes" % jobs, visible(out) == first)
    r = c.run("batch", "-o", out, *good)
    c.check("what failed is tried again", r.code == 0 and b"2 were finished before" in r.out and summary(out)["totals"]["clean"] == 4, r.text[-200:])


def records(out):
    """How many decks are done: each has its record."""
    return len(glob.glob(os.path.join(out, ".batch", "*.record")))


def finished(r):
    """How many decks the run took over."""
    text = r.out.decode()
    return int(text.split(" were finished before")[0].split()[-1]) if "finished before" in text else 0


def going_on(c, tmp):
    """What is done again, and what is not."""
    work = os.path.join(tmp, "on")
    decks = small_decks(work, 6)
    part = write(os.path.join(work, "part.inc"), "# nothing\n")
    write(decks[5], CLEAN.replace(b"/END", b"#include part.inc\n/END"))
    out = os.path.join(work, "out")
    args = ("batch", "-o", out, *decks)
    c.run(*args)

    def after(name, change, taken_over, extra=()):
        change()
        r = c.run(*args, *extra)
        c.check("%s: %d of 6 are taken over" % (name, taken_over), r.code == 0 and finished(r) == taken_over, r.text[-200:])
        return r

    def edit(path, old, new):
        write(path, read(path).replace(old, new))

    def result(n):
        return os.path.join(out, "d%04d_0000.json" % n)
    after("nothing changed", lambda: None, 6)
    after("a deck touched", lambda: os.utime(decks[0], (1e9, 1e9)), 6)
    after("a deck changed", lambda: edit(decks[1], b"# deck", b"# dock"), 5)
    after("an include changed", lambda: edit(part, b"nothing", b"something"), 5)
    after("a result deleted", lambda: os.remove(result(2)), 5)
    after("a result cut off", lambda: os.truncate(result(3), 100), 5)
    after("a result changed", lambda: edit(result(3), b"deck", b"dekc"), 5)
    after("--force", lambda: None, 0, ("--force",))
    anew = os.path.join(work, "anew")
    c.run("batch", "-o", anew, *decks)
    c.check("the same bytes as done anew", visible(out) == visible(anew), differing(visible(out), visible(anew)))
    after("other options", lambda: None, 0, ("--verb", "gaps --all"))
    after("the same options", lambda: None, 6, ("--verb", "gaps --all"))
    before = visible(out)
    r = c.run(*args, "--verb", "lint")
    c.check("another verb into the same directory is refused and changes nothing", r.code == 2 and b"gaps" in r.err and visible(out) == before, r.text[-200:])
    after("another verb with --force", lambda: None, 0, ("--verb", "lint", "--force"))
    os.rename(decks[5], decks[5] + ".away")
    r = c.run(*args[:-1], "--verb", "lint")
    c.check("the result of a deck that is gone goes", r.code == 0 and sorted(visible(out)) == sorted(
        [os.path.basename(d)[:-4] + ".json" for d in decks[:5]] + ["summary.json", "index.html"]), str(sorted(visible(out))))
    os.rename(decks[5] + ".away", decks[5])
    after("a deck that came back", lambda: None, 5, ("--verb", "lint"))
    config = os.path.join(work, ".decklint.toml")
    after("a configuration that was not there", lambda: write(config, 'ignore = ["DK904"]\n'), 0, ("--verb", "lint"))
    after("the same configuration", lambda: None, 6, ("--verb", "lint"))
    after("another configuration", lambda: write(config, 'ignore = ["DK905"]\n'), 0, ("--verb", "lint"))
    packed = write(os.path.join(work, "packed_0000.rad.gz"), gzip.compress(CLEAN))
    r = [c.run("batch", "-o", os.path.join(work, "packed"), packed) for _ in range(2)][1]
    c.check("a packed deck is taken over", r.code == 0 and finished(r) == 1, r.text[-200:])
    record = os.path.join(out, ".batch", "d0002_0000.record")
    after("a record cut off", lambda: os.truncate(record, os.path.getsize(record) - 40), 5, ("--verb", "lint"))


def includes(c, tmp):
    """Files of other decks are no decks, when a directory or a pattern finds them."""
    work = os.path.join(tmp, "includes")
    at = CLEAN.index(b"/NODE")
    files = {"car_0000.rad": CLEAN[:at] + b"#include mesh_0000.rad\n", "mesh_0000.rad": CLEAN[at:], "whole_0000.rad": CLEAN,
             "lost_0000.rad": b"/NODE\n         1                 0.0                 0.0                 0.0\n", "blank_0000.rad": b"",
             "binary_0000.rad": bytes(range(256)) * 20, "engine_0000.rad": b"# engine\n/RUN/x/1\n1.0\n/TFILE\n0.1\n",
             "old_0000.rad": CLEAN.replace(b"#RADIOSS STARTER", b"# no head")}
    put(os.path.join(work, "lib"), files)

    def run(name, *given):
        out = os.path.join(work, "out-" + name)
        r = c.run("batch", "-o", out, *given, cwd=work)
        s = summary(out)
        return r, {os.path.basename(d["deck"]).split("_")[0]: d["status"] for d in s["decks"]}, [x for x in r.err.decode().split("\n") if "is not run by itself" in x]
    unread = {"blank": "unreadable", "binary": "unreadable", "engine": "unreadable", "lost": "unreadable"}
    wanted = dict(unread, car="clean", whole="clean", old="clean")
    for name, given in (("directory", ["lib"]), ("pattern", ["lib/*.rad"])):
        r, decks, found = run(name, *given)
        c.check("a %s: an include is named, not run" % name, decks == wanted and r.code == 3 and found == [
            "deck: note: lib/mesh_0000.rad is included by lib/car_0000.rad and is not run by itself"], "%s %s" % (decks, found))
    _, decks, found = run("named", *sorted("lib/" + n for n in files))
    c.check("files named one by one are run, all of them", decks == dict(wanted, mesh="unreadable") and not found, "%s %s" % (decks, found))
    # Decks that include each other stay decks: reading them says so.
    for a, b in (("a", b"b"), ("b", b"a")):
        write(os.path.join(work, "lib", "x%s_0000.rad" % a), CLEAN.replace(b"/END", b"#include x%s_0000.rad\n/END" % b))
    _, decks, found = run("circle", "lib/x*")
    c.check("decks that include each other are run", sorted(decks) == ["xa", "xb"] and not found, "%s %s" % (decks, found))
    for i in (1, 2):
        c.run("batch", "-o", "shards", "lib", "--shard", "%d/2" % i, cwd=work)
    c.run("batch", "-o", "shards", "--merge", cwd=work)
    c.run("batch", "-o", "whole", "lib", cwd=work)
    c.check("shards know the includes as well", visible(os.path.join(work, "whole")) == {k: v for k, v in visible(os.path.join(work, "shards")).items() if "-of-" not in k})


def processes():
    """{pid: pid of its parent} of those that have not ended."""
    found = {}
    for stat in glob.glob("/proc/[0-9]*/stat"):
        try:
            fields = read(stat).rsplit(b")", 1)[1].split()
        except OSError:
            continue
        if fields[0] != b"Z":
            found[int(stat.split("/")[2])] = int(fields[1])
    return found


def many(c, tmp):
    """300 small decks, killed and resumed."""
    decks = small_decks(os.path.join(tmp, "many"), 300)
    manifest = write(os.path.join(tmp, "many.txt"), "\n".join(decks))
    out = os.path.join(tmp, "many-out")
    c.run("batch", "-o", out, "--jobs", "1", "--manifest", manifest, timeout=300)
    expected = visible(out)
    again = c.run("batch", "-o", out, "--manifest", manifest)
    c.check("all are taken over", finished(again) == len(decks), again.text[-200:])
    for how in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
        shutil.rmtree(out, ignore_errors=True)
        p = subprocess.Popen([c.program, "batch", "-o", out, "--jobs", "2", "--manifest", manifest], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, start_new_session=True)
        while p.poll() is None and records(out) < 40:
            time.sleep(0.002)
        workers = [child for child, parent in processes().items() if parent == p.pid]
        p.send_signal(how)
        _, err = p.communicate(timeout=60)
        name = signal.Signals(how).name
        done = records(out)
        c.check("%s in the middle" % name, p.returncode == -how and 40 <= done < len(decks), "exit code %s, %d done" % (p.returncode, done))
        if how != signal.SIGKILL:
            c.check("%s: it says how to go on" % name, b"run the same command to continue" in err, err.decode()[-200:])
        time.sleep(0.3)
        c.check("%s: no worker is left" % name, not set(workers) & set(processes()), str(workers))
        now = visible(out)
        odd = [k for k, v in now.items() if expected.get(k) != v and not (k.startswith(".") and k.endswith(".tmp"))]
        c.check("%s: what is there is whole" % name, not odd and "summary.json" not in now, ", ".join(odd[:5]))
        untouched = {k: os.stat(os.path.join(out, k)).st_ino for k in now if not k.startswith(".")}
        r = c.run("batch", "-o", out, "--jobs", "2", "--manifest", manifest)
        c.check("%s: finished decks are not done again" % name, 39 <= finished(r) >= done - 1, "%d done, %d taken over" % (done, finished(r)))
        redone = sum(1 for k, i in untouched.items() if os.stat(os.path.join(out, k)).st_ino != i)
        c.check("%s: their files are not written again" % name, redone <= len(untouched) - finished(r), "%d of %d" % (redone, len(untouched)))
        c.check("%s: resumed, the same bytes" % name, visible(out) == expected, differing(visible(out), expected))


def two_at_once(c, tmp):
    shim = c.preload("fault.c", tmp)
    if shim is None:
        return
    decks = small_decks(os.path.join(tmp, "twice"), 2)
    out = os.path.join(tmp, "twice-out")
    env = dict(os.environ, LD_PRELOAD=shim, DECK_FAULT_OPEN="hang:d0001")
    p = subprocess.Popen([c.program, "batch", "-o", out, "--quiet", *decks], stdin=subprocess.DEVNULL, env=env)
    until = time.monotonic() + 30
    while time.monotonic() < until and not records(out):
        time.sleep(0.01)
    r = c.run("batch", "-o", out, *decks)
    c.check("a second batch in the same directory is refused", r.code == 2 and b"another deck batch" in r.err, r.text)
    p.kill()
    p.wait()
    r = c.run("batch", "-o", out, *decks)
    c.check("and taken once the first is gone", r.code == 0 and finished(r) == 1, r.text)


if __name__ == "__main__":
    run_steps(results_of_verbs, divided, names, bad_decks, going_on, includes, two_at_once, many)
