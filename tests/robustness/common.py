"""What the checks of the command line share: counting, running `deck` under limits, files, finding decks.

A check prints one line when it fails and nothing when it passes; the script ends with
'N passed, N failed' and exits 1 if anything failed."""
import argparse
import glob
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SAMPLES = sorted(glob.glob(os.path.join(ROOT, "samples", "*_0000.rad")))
CRASH = re.compile(rb"AddressSanitizer|LeakSanitizer|ThreadSanitizer|UndefinedBehavior|runtime error:|"
                   rb"deck: internal error|terminate called|Assertion")


def read(path):
    with open(path, "rb") as f:
        return f.read()


def write(path, data):
    """Text or bytes, in a folder that is made for it; returns the path."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as f:
        f.write(data.encode() if isinstance(data, str) else data)
    return path


def tree(directory):
    """{relative path: bytes} of all files below a directory."""
    found = {}
    for folder, _, names in os.walk(directory):
        for name in names:
            full = os.path.join(folder, name)
            found[os.path.relpath(full, directory)] = read(full)
    return found


def put(directory, files):
    """A directory that holds these files and no others."""
    shutil.rmtree(directory, ignore_errors=True)
    os.makedirs(directory)
    for name, data in files.items():
        write(os.path.join(directory, name), data)


def differing(a, b):
    """Names of two trees whose bytes differ."""
    return ", ".join(sorted(k for k in set(a) | set(b) if a.get(k) != b.get(k))[:8])


def moved(text, node, z):
    """A deck with another height of a node."""
    out, n = re.subn(r"(?m)^(%10d.{40})(.{20})$" % node, lambda m: m.group(1) + "%20s" % z, text)
    assert n == 1, "no line of node %d" % node
    return out


def wrong_schemas(directory, name):
    """A folder with a schema of the project by which a change of units writes another Gapmin."""
    schema = json.loads(read(os.path.join(ROOT, "schemas", "keywords", name)))
    for card in schema["cards"]:
        for field in card.get("fields", []):
            if field.get("name") == "Gapmin":
                field["dim"] = [1, 0, 0]
    write(os.path.join(directory, name), json.dumps(schema))
    return directory


def preload_library(source, directory):
    """A file of C beside this one as a library to be preloaded; None where there is no compiler."""
    path = os.path.join(directory, source[:-2] + ".so")
    for compiler in ("cc", "gcc", "clang-14", "clang"):
        if shutil.which(compiler):
            r = subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-fno-builtin", "-o", path, os.path.join(ROOT, "tests", "robustness", source), "-ldl"],
                               capture_output=True, text=True)
            if r.returncode != 0:
                sys.exit(source + ": " + r.stderr[-500:])
            return path
    return None


class Result:
    def __init__(self, code, out, err, seconds):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds

    @property
    def text(self):
        return (self.out + self.err).decode("utf-8", "replace")

    def crash(self):
        """Why this run counts as a crash, or ''."""
        if self.code is None:
            return "no answer in time"
        if self.code == -signal.SIGXCPU:
            return "no answer in time"
        if self.code < 0:
            return "killed by signal %d" % -self.code
        if self.code not in (0, 1, 2, 3):
            return "exit code %d" % self.code
        found = CRASH.search(self.out) or CRASH.search(self.err)
        return found.group(0).decode() if found else ""


class Count:
    """Counts what passed, and says what failed."""

    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def check(self, name, ok, why=""):
        if ok:
            self.passed += 1
        else:
            self.failed += 1
            print("FAILED  %s%s" % (name, ": %s" % (why,) if why else ""), flush=True)
        return ok

    def skip(self, name, why):
        self.skipped += 1
        print("skipped %s: %s" % (name, why), flush=True)

    def finish(self):
        tail = ", %d skipped" % self.skipped if self.skipped else ""
        print("%d passed, %d failed%s" % (self.passed, self.failed, tail))
        sys.exit(1 if self.failed else 0)


class Checks(Count):
    """Of a program, which the command line names."""

    def __init__(self, folders=False):
        """With `folders` the command line may name folders after the program: options.folders."""
        super().__init__()
        parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
        parser.add_argument("deck", nargs="?", default=os.path.join(ROOT, "build", "dev", "tools", "deck"),
                            help="the program to test")
        if folders:
            parser.add_argument("folders", nargs="*", help="look at the decks in them")
        parser.add_argument("--corpus", default=os.environ.get("DECK_CORPUS") or os.path.join(ROOT, os.pardir, "shared"))
        parser.add_argument("--all", action="store_true", help="the slow cases too")
        parser.add_argument("--record", action="store_true", default=bool(os.environ.get("DECK_RECORD")), help="write records anew")
        self.options = parser.parse_args()
        self.program = os.path.abspath(self.options.deck)
        if not os.access(self.program, os.X_OK):
            sys.exit("%s: no such program; build the target 'deck' first" % self.program)
        with open(self.program, "rb") as f:
            self.sanitized = b"__asan_init" in f.read()
        self._verbs = {}

    def has(self, verb):
        if verb not in self._verbs:
            self._verbs[verb] = self.run(verb, "--help").code == 0
        return self._verbs[verb]

    def run(self, *args, timeout=120, stdin=None, cwd=None, env=None, memory_mb=4096, file_bytes=None):
        """Runs the program; address space bounded unless a sanitizer needs it. With `file_bytes` writing beyond that size fails.
        `timeout` is processor time on all processors; by the clock it may take five times as long, since other work on the machine is
        no fault of the program."""
        def limits():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            seconds = int(timeout * (os.cpu_count() or 1))
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
            if file_bytes is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))
            if not self.sanitized:
                resource.setrlimit(resource.RLIMIT_AS, (memory_mb << 20, memory_mb << 20))
        if self.sanitized:
            timeout *= 10
        full = dict(os.environ, NO_COLOR="1", **(env or {}))
        start = time.monotonic()
        process = subprocess.Popen([self.program, *map(str, args)], stdin=subprocess.PIPE if stdin is not None else subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=cwd, env=full, preexec_fn=limits)
        try:
            out, err = process.communicate(stdin, timeout=5 * timeout)
            code = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            code = None
        return Result(code, out, err, time.monotonic() - start)

    def no_crash(self, name, result, codes=(0, 1, 3)):
        """Passes if the run ended orderly with one of `codes`."""
        crash = result.crash()
        if crash:
            return self.check(name, False, crash + "; " + result.text[-300:].strip().replace("\n", " | "))
        return self.check(name, result.code in codes, "exit code %s, expected one of %s; %s" % (
            result.code, list(codes), result.text[-300:].strip().replace("\n", " | ")))

    def preload(self, source, directory):
        """As preload_library; None, said once, where it cannot be used."""
        library = None if self.sanitized else preload_library(source, directory)
        if library is None:
            self.skip(source, "no C compiler, or a sanitizer, which does not go together with it")
        return library

    def all_decks(self):
        """[(stem, path)] of the samples and the decks outside the project that are complete."""
        corpus = self.corpus_decks()
        if not corpus:
            self.skip("corpus", "no decks under %s (set DECK_CORPUS)" % self.options.corpus)
        return [(os.path.basename(p)[:-9], p) for p in SAMPLES] + [d for d in corpus if "missing_include" not in d[1]]

    def corpus_decks(self):
        """[(stem, path)] of the decks outside the project, smallest first; [] where there are none."""
        found = glob.glob(os.path.join(self.options.corpus, "corpus", "**", "*_0000.rad"), recursive=True)
        found += glob.glob(os.path.join(self.options.corpus, "oracle", "params", "*_0000.rad"))
        return [(os.path.basename(p)[:-len("_0000.rad")], p) for p in sorted(found, key=os.path.getsize)]


def run_steps(*steps, checks=Checks):
    """A script: every step gets the checks and a directory of its own."""
    c = checks()
    for step in steps:
        with tempfile.TemporaryDirectory(prefix="deck-", ignore_cleanup_errors=True) as tmp:
            step(c, os.path.realpath(tmp))
    c.finish()
