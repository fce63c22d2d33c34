#!/usr/bin/env python3
"""Every allocation and every call about files fails once: whatever a verb was doing, it ends with an exit code
of its own (never a signal), says what is wrong, and leaves no file that is neither as it was nor as it should be.

fault.c, preloaded, numbers what the program asks for and refuses the N-th. By default the first ones of every
verb and a sample of the others, with --all all of them (of very many allocations every k-th, see `places`)."""
import errno
import json
import os
import random
import select
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor

from common import ROOT, put, read, run_steps, tree
from kill import TEMPORARY

FIRST, SAMPLED, MOST = 20, 20, 6000  # by default the first and so many others; with --all at most so many


def sample(name):
    return read(os.path.join(ROOT, "samples", name))


def verbs():
    """(name, arguments, files) of a small run of every verb."""
    clean, bad = {"car_0000.rad": sample("too_close_0000.rad")}, {"car_0000.rad": sample("variable_gap_0000.rad")}
    tree_of = {"car_0000.rad": sample("include_tree_0000.rad"), "include_tree/mesh.inc": sample("include_tree/mesh.inc"),
               "include_tree/sheets.inc": sample("include_tree/sheets.inc")}
    fixable = {"car_0000.rad": b"".join(sample("too_close_0000.rad").rpartition(b"/END")[:1]) +
               b"/INTER/TYPE7/77\nx\n" + b" " * 60 + b"         1\n/END\n"}
    yield "lint", ("lint", "car_0000.rad", "-o", "sarif=a.sarif", "-o", "junit=a.xml"), tree_of
    yield "lint --geometry", ("lint", "car_0000.rad", "--geometry"), clean
    yield "lint --fix", ("lint", "car_0000.rad", "--fix"), fixable
    yield "params", ("params", "car_0000.rad", "--json", "a.json"), clean
    yield "gaps", ("gaps", "car_0000.rad", "--json", "a.json", "--csv", "a.csv", "--vtk", "v", "--html", "a.html"), bad
    yield "cycle", ("cycle", "car_0000.rad", "--all", "--json", "a.json"), bad
    yield "convert --to json", ("convert", "car_0000.rad", "--to", "json", "-o", "out"), tree_of
    yield "convert --flatten", ("convert", "car_0000.rad", "--flatten", "-o", "out"), tree_of
    yield "convert --units --in-place", ("convert", "car_0000.rad", "--units", "Mg,mm,s", "--in-place"), clean
    yield "convert --version", ("convert", "car_0000.rad", "--version", "2026", "-o", "out"), clean
    yield "fix", ("fix", "car_0000.rad", "--strategy", "reduce-gap", "--in-place"), bad
    yield "accuracy", ("accuracy", "--samples", "2"), {}
    yield "explain", ("explain", "/INTER/TYPE7.Inacti"), {}
    yield "rules", ("rules",), {}
    yield "batch", ("batch", "car_0000.rad", "-o", "out", "--jobs", "1"), clean
    yield "lsp", ("lsp",), tree_of


def frame(number, method, params):
    """A message of the protocol; a request unless nobody answers it."""
    message = {"jsonrpc": "2.0", "method": method}
    if params is not None:
        message["params"] = params
    if method not in ("initialized", "exit") and "/did" not in method:
        message["id"] = number
    text = json.dumps(message).encode()
    return b"Content-Length: %d\r\n\r\n" % len(text) + text


def session(folder):
    """What an editor sends to the language server: a deck is opened, edited and asked about; and how it takes its leave."""
    path = os.path.join(folder, "car_0000.rad")
    uri, place = "file://" + path, {"line": 12, "character": 3}
    document = {"textDocument": {"uri": uri}, "position": place}
    everything = {"range": {"start": {"line": 0, "character": 0}, "end": {"line": 400, "character": 0}}}
    said = [("initialize", {"capabilities": {}, "initializationOptions": {"delay": 0, "holdBack": 0}}), ("initialized", {}),
            ("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "radioss", "version": 1,
                                                       "text": read(path).decode("utf-8", "replace")}}),
            ("textDocument/didChange", {"textDocument": {"uri": uri, "version": 2}, "contentChanges": [
                {"range": {"start": place, "end": place}, "text": "7"}]})]
    said += [("textDocument/" + m, {**document, **everything, "context": {"diagnostics": []}}) for m in (
        "hover", "completion", "definition", "documentSymbol", "foldingRange", "codeAction", "codeLens")]
    return b"".join(frame(n, *m) for n, m in enumerate(said)), frame(90, "shutdown", None) + frame(91, "exit", None)


def talk(command, work, env):
    """A session: (exit code, everything that was said). It ends when findings have come, or soon after if none come."""
    p = subprocess.Popen(command, cwd=work, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    first, last = session(work)
    heard, end = b"", time.monotonic() + 2
    try:
        p.stdin.write(first)
        p.stdin.flush()
        while b"publishDiagnostics" not in heard and (left := end - time.monotonic()) > 0:
            if select.select([p.stdout], [], [], left)[0]:
                piece = os.read(p.stdout.fileno(), 1 << 16)
                if not piece:
                    break
                heard += piece
    except BrokenPipeError:
        last = b""
    try:
        out, err = p.communicate(last, timeout=60)
    except subprocess.TimeoutExpired:
        p.kill()
        p.communicate()
        raise
    return p.returncode, heard + out + err


def whole(name, data):
    """True for a document that does not end in the middle."""
    if name.endswith((".json", ".sarif")):
        try:
            json.loads(data)
        except ValueError:
            return False
    return data.endswith(b"\n")


def own_notes(name):
    """Where `deck batch` keeps what it has done: times differ from run to run."""
    return ".batch" in name.split(os.sep)


class Shortage:
    def __init__(self, c, shim, tmp):
        self.c, self.shim, self.tmp = c, shim, tmp

    def run(self, args, work, of, at):
        """(exit code, what was printed, number of things asked for or None)."""
        count = work + ".count"
        if os.path.exists(count):
            os.remove(count)
        env = dict(os.environ, NO_COLOR="1", LD_PRELOAD=self.shim, DECK_FAULT_OF=of, DECK_FAULT_AT=str(at), DECK_FAULT_DO=str(errno.EIO), DECK_FAULT_COUNT=count)
        try:
            command = [self.c.program, *args] + (["--threads", "2"] if args[0] not in ("explain", "rules", "batch", "accuracy") else [])
            if args[0] == "lsp":
                code, said = talk(command, work, env)
            else:
                r = subprocess.run(command, cwd=work, env=env, stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
                code, said = r.returncode, r.stdout + r.stderr
            text = said.decode("utf-8", "replace")
        except subprocess.TimeoutExpired:
            code, text = None, ""
        asked = int(read(count)) if os.path.exists(count) else None
        return code, text, asked

    def places(self, total):
        if self.c.options.all:
            step = max(1, total // MOST)
            return sorted(set(range(1, min(total, 300) + 1)) | set(range(1, total + 1, step)))
        chosen = set(range(1, min(total, FIRST) + 1))
        if total > FIRST:
            chosen |= set(random.Random(total).sample(range(FIRST + 1, total + 1), min(SAMPLED, total - FIRST)))
        return sorted(chosen)

    def judge(self, code, text, usual, old, now, new):
        """What is wrong with the end of a run in which one thing was refused."""
        if code is None:
            return "it hangs"
        if not 0 <= code <= 4:
            return "exit code %d" % code
        if "terminate called" in text or "internal error" in text and code != 4:
            return "an exception came through"
        if code not in (0, 1) and not text.strip():
            return "exit code %d without a word" % code
        for name in sorted(set(old) | {k for k in new if not own_notes(k)}):
            if name not in now:
                if name in old:
                    return name + " is lost"
                if code == usual:
                    return "%s is missing, but the exit code is as usual" % name
            elif now[name] not in (old.get(name), new.get(name)) and not (name not in old and whole(name, now[name])):
                # A report about what could not be read says something else, but it is a whole report.
                return "%s is neither old nor new nor whole" % name
        strays = [k for k in now if k not in old and k not in new and not own_notes(k)]
        # What failed may have been the removal of just that file.
        if [k for k in strays if not TEMPORARY.match(os.path.basename(k))] or len(strays) > 1:
            return "left behind: " + ", ".join(strays)
        return ""

    def verb(self, name, args, old, of):
        slug = "".join(ch if ch.isalnum() else "-" for ch in name + of)
        base = os.path.join(self.tmp, slug)
        put(base, old)
        usual, text, total = self.run(args, base, of, 0)
        if not self.c.check("%s: runs" % name, usual in (0, 1) and total is not None, text[-300:]):
            return
        new = tree(base)

        def one(at):
            work = "%s.%d" % (base, at % 2)  # two workers, never the same number at a time
            put(work, old)
            code, out, _ = self.run(args, work, of, at)
            why = self.judge(code, out, usual, old, tree(work), new)
            return why and "%s at %d of %d: %s (%s)" % (of, at, total, why, out[-160:].strip().replace("\n", " | "))
        places = self.places(total)
        with ThreadPoolExecutor(2) as pool:
            halves = pool.map(lambda parity: [one(n) for n in places if n % 2 == parity], (0, 1))
            faults = [w for half in halves for w in half if w]
        self.c.check("%s: %d of %d refusals of %s" % (name, len(places), total, of), not faults,
                     "%d faults; first: %s" % (len(faults), "; ".join(faults[:3])))


def shortages(c, tmp):
    shim = c.preload("fault.c", tmp)
    if shim is None:
        return
    s = Shortage(c, shim, tmp)
    for of in ("memory", "calls"):
        for name, args, files in verbs():
            s.verb(name, args, files, of)


if __name__ == "__main__":
    run_steps(shortages)
