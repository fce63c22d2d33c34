#!/usr/bin/env python3
"""Killed, or out of disk, at every call that touches a file: whatever writes decks or results leaves
each file with its old bytes or its new ones, whole; what is left over is hidden and harmless; and
doing it again ends as if nothing had happened.

fault.c, preloaded, numbers the calls (open, write, fsync, close, rename, link, unlink, mkdir, ...) and
strikes at the N-th, for N = 1, 2, ... until the command ends undisturbed. It kills before the call,
kills in the middle of a write, or lets the call fail with 'no space left' or 'input/output error'."""
import errno
import json
import os
import re
import shutil
import subprocess

from common import ROOT, SAMPLES, differing, put, read, run_steps, tree

TEMPORARY = re.compile(r"^\..+(\.\d+-\d+\.tmp|\.unfinished)$")
KILLS = ("kill", "half")
FAILURES = (str(errno.ENOSPC), str(errno.EIO))


class Striker:
    def __init__(self, c, shim, tmp):
        self.c, self.shim = c, shim
        self.mark = os.path.join(tmp, "mark")

    def run(self, n, action, *args, cwd):
        """(exit code, struck) of `deck ARGS` with the fault at its n-th call."""
        if os.path.exists(self.mark):
            os.remove(self.mark)
        env = dict(os.environ, NO_COLOR="1", LD_PRELOAD=self.shim, DECK_FAULT_AT=str(n), DECK_FAULT_DO=action,
                   DECK_FAULT_MARK=self.mark)
        r = subprocess.run([self.c.program, *args], cwd=cwd, env=env, stdin=subprocess.DEVNULL, capture_output=True,
                           timeout=120, start_new_session=True)
        return r.returncode, os.path.exists(self.mark), (r.stdout + r.stderr).decode("utf-8", "replace")

    def every(self, action, prepare, args, cwd, judge, most=3000):
        """Strikes at 1, 2, ...; `judge(exit code, struck, n)` says what is wrong. Returns the number of calls."""
        for n in range(1, most):
            prepare()
            code, struck, text = self.run(n, action, *args, cwd=cwd)
            why = judge(code, struck)
            if why:
                return n, "%s at call %d: %s (exit code %s; %s)" % (action, n, why, code, text[-200:].strip())
            if not struck:
                return n - 1, ""
        return most, "it never ended"


def whole_or_old(now, old, new, allowed_strays):
    """What is wrong with a directory that should hold, file by file, the old or the new bytes."""
    for name in sorted(set(old) | set(new)):
        if name not in now:
            if name in old:
                return name + " is lost"
        elif now[name] not in (old.get(name), new.get(name)):
            return "%s has %d bytes that are neither old (%d) nor new (%d)" % (
                name, len(now[name]), len(old.get(name, b"")), len(new.get(name, b"")))
    for name in now:
        if name in old or name in new:
            continue
        if not TEMPORARY.match(os.path.basename(name)):
            return "there is a file %s" % name
        if not allowed_strays:
            return "%s was left behind" % name
    return ""


def rewriting(c, s, tmp, name, args, old, repeatable=True):
    """A command that rewrites or makes the files of directory `work` (old contents: `old`). `repeatable`: done
    again after a kill it ends where it would have ended; not so where a part of the result changes its meaning."""
    work = os.path.join(tmp, "work")

    def prepare():
        put(work, old)
    prepare()
    code, struck, text = s.run(0, "none", *args, cwd=work)
    if not c.check(name + ": runs", code in (0, 1) and not struck, text[-300:]):
        return
    new = tree(work)
    if not c.check(name + ": changes something", new != old):
        return
    for action in KILLS:
        def judge(code, struck):
            now = tree(work)
            if not struck:
                return "" if now == new else "undisturbed, but the result differs"
            why = whole_or_old(now, old, new, True)
            if why:
                return why
            done = [k for k in new if now.get(k) == new[k] != old.get(k)]
            if any(k.endswith("_0000.rad") for k in done) and any(now.get(k) != new[k] for k in new if k.endswith(".inc")):
                return "a main file is new before its include"
            if "car_0000.rad" in old and args[0] != "convert" or "--in-place" in args:
                # Who reads the deck next changes nothing; who rewrites it next (here: nothing but what was
                # left) gets all of it old or all of it new.
                given = [a for a in args if a.endswith("_0000.rad")]
                s.run(0, "none", "params", *given, "--no-geometry", "-q", cwd=work)
                if tree(work) != now:
                    return "a verb that only reads changed something"
                s.run(0, "none", "lint", *given, "--no-config", "--select", "DK093", "--fix", "-q", cwd=work)
                now = tree(work)
                decks = [k for k in new if not k.endswith(".orig")]
                if any(now[k] != old[k] for k in decks) and any(now[k] != new[k] for k in decks):
                    return "part of the deck is old and part is new, even for the next reader"
                if any(k.endswith(".unfinished") for k in now):
                    return "the note of what is unfinished stays"
            if not repeatable:
                return ""
            # Again, undisturbed: as if nothing had happened.
            s.run(0, "none", *args, cwd=work)
            again = {k: v for k, v in tree(work).items() if not TEMPORARY.match(os.path.basename(k))}
            return "" if again == new else "a second run does not end where the first should have"
        calls, why = s.every(action, prepare, args, work, judge)
        c.check("%s: killed (%s) at each of %d calls" % (name, action, calls), not why and calls > 5, why or "too few calls")
    for action in FAILURES if c.options.all else FAILURES[:1]:
        unlinks = []

        def judge(code, struck):
            now = tree(work)
            if not struck:
                return "" if now == new else "undisturbed, but the result differs"
            if code not in (0, 1, 2, 3):
                return "unexpected exit code"
            # A failing call is not a kill: nothing may be left, unless what failed is the removal of just that.
            why = whole_or_old(now, old, new, True)
            if why:
                return why
            strays = [k for k in now if k not in old and k not in new]
            unlinks.extend(strays)
            if len(strays) > 1 or len(unlinks) > 8:
                return "left behind: " + ", ".join(strays)
            decks = [k for k in new if not k.endswith(".orig")]
            changed = [k for k in decks if now.get(k) != old.get(k)]
            complete = [k for k in decks if now.get(k) == new[k]]
            # Code 3: a file of the deck could not be read, so only what could be read was dealt with.
            if changed and len(complete) != len(decks) and code != 3:
                return "part of the set is new: " + ", ".join(changed)
            if code == 0 and len(complete) != len(decks):
                return "it claims success"
            return ""
        calls, why = s.every(action, prepare, args, work, judge)
        c.check("%s: %s at each of %d calls" % (name, os.strerror(int(action)), calls), not why and calls > 5, why or "too few calls")


def split_deck(sample, at):
    """A sample as a deck with an include that holds everything from the first `at` on."""
    text = read(os.path.join(ROOT, "samples", sample + "_0000.rad"))
    cut, end = text.index(at), text.rindex(b"/END")
    return {"car_0000.rad": text[:cut] + b"#include part.inc\n" + text[end:], "part.inc": text[cut:end]}


def two_file_deck():
    """Findings that can be fixed in both files."""
    return split_deck("every_mistake", b"/INTER/TYPE7/22")


def two_decks():
    """Two decks that share an include."""
    files = split_deck("crash_box", b"/GRNOD")
    return dict(files, **{"second_0000.rad": files["car_0000.rad"].replace(b"/END", b"# the second deck\n/END")})


def batch(c, s, tmp):
    """deck batch: results whole or absent, and a second run completes them."""
    work, out = os.path.join(tmp, "decks"), os.path.join(tmp, "decks", "out")
    decks = {os.path.basename(p): read(p) for p in SAMPLES if "clean_plates" in p or "tied_layer" in p or "too_close" in p}
    args = ("batch", "-o", "out", "--jobs", "1", "--quiet", *sorted(decks))

    def visible(directory):
        return {k: v for k, v in tree(directory).items() if not k.startswith(".batch")}
    put(work, decks)
    code, _, text = s.run(0, "none", *args, cwd=work)
    if not c.check("batch: runs", code in (0, 1), text[-300:]):
        return
    new = visible(out)
    c.check("batch: a result per deck, the summary and the overview", len(new) == len(decks) + 2, ", ".join(sorted(new)))

    def prepare():
        shutil.rmtree(out, ignore_errors=True)
    for action in ("kill", "half", "all") + (FAILURES if c.options.all else FAILURES[:1]):
        def judge(code, struck):
            now = visible(out) if os.path.isdir(out) else {}
            if not struck:
                return "" if now == new and code in (0, 1) else "undisturbed, but the result differs"
            summary = json.loads(now.pop("summary.json", "{}"))
            page = now.pop("index.html", b"")  # of a run in which a worker was killed: it tells so
            if page and not page.endswith(b"</html>\n"):
                return "index.html is not whole"
            why = whole_or_old(now, {}, new, True)
            if why:
                return why
            # One worker that is gone makes its deck a failed one; the summary says so and is whole.
            if summary and summary != json.loads(new["summary.json"]) and summary["totals"]["failed"] + summary["totals"]["unreadable"] == 0:
                return "the summary is neither complete nor tells of a failed deck"
            for k, v in decks.items():
                if read(os.path.join(work, k)) != v:
                    return k + " was changed"
            code, _, text = s.run(0, "none", *args, cwd=work)
            if code not in (0, 1):
                return "the second run ends with %d: %s" % (code, text[-200:])
            return "" if visible(out) == new else "the second run does not complete it: " + differing(visible(out), new)
        calls, why = s.every(action, prepare, args, work, judge)
        c.check("batch: %s at each of %d calls, completed by a second run" % (action, calls), not why and calls > 30, why or "too few calls")


def strikes(c, tmp):
    shim = c.preload("fault.c", tmp)
    if shim is None:
        return
    s = Striker(c, shim, tmp)
    rewriting(c, s, tmp, "lint --fix", ("lint", "car_0000.rad", "--fix", "-q"), two_file_deck())
    source = os.path.join(tmp, "source")
    put(source, two_file_deck())
    copy = ("convert", os.path.join(source, "car_0000.rad"), "-o", ".", "-q")
    rewriting(c, s, tmp, "convert to an empty directory", copy, {})
    rewriting(c, s, tmp, "convert over older files", (*copy, "--overwrite"), {"car_0000.rad": b"# older\n" * 1000, "part.inc": b"# older part\n"})
    c.check("convert leaves its source alone", tree(source) == two_file_deck())
    units = ("--units", "Mg,mm,s", "--in-place", "-q")
    rewriting(c, s, tmp, "convert --in-place --backup", ("convert", "car_0000.rad", "--backup", *units), split_deck("crash_box", b"/GRNOD"), repeatable=False)
    rewriting(c, s, tmp, "convert two decks --in-place", ("convert", "car_0000.rad", "second_0000.rad", *units), two_decks(), repeatable=False)
    rewriting(c, s, tmp, "fix --in-place", ("fix", "car_0000.rad", "--strategy", "reduce-gap", "--in-place", "-q"),
              {"car_0000.rad": read(os.path.join(ROOT, "samples", "variable_gap_0000.rad"))}, repeatable=False)
    batch(c, s, tmp)


if __name__ == "__main__":
    run_steps(strikes)
