#!/usr/bin/env python3
"""Same answers from every build: compiles the geometry and force kernels with g++ and clang, -O0 and
-O3, with and without the wider instruction sets, and compares digests of what they answer on the hard
cases. With --program (repeatable) also compares what whole programs print about the sample decks,
with one thread and with two, byte for byte.

  tests/robustness/builds.py
  tests/robustness/builds.py --samples 10000 --levels O0,O2,O3
  tests/robustness/builds.py --program build/dev/tools/deck --program build/clang/tools/deck"""
import argparse
import concurrent.futures
import glob
import os
import re
import shutil
import subprocess
import tempfile

from common import ROOT, SAMPLES, Count

LIB = os.path.join(ROOT, "libdeck")
WIDE = {"kernels_avx2": ["-mavx2"],
        "kernels_avx512": ["-mavx512f", "-mavx512dq", "-mavx512vl", "-mprefer-vector-width=512"]}


def sources():
    """What the digest program is made of: kernels, no reading of decks."""
    out = [os.path.join(ROOT, "tests", "hardcases", "digest.cpp"), os.path.join(LIB, "base", "parallel.cpp")]
    for pattern in ("contact/distance/*.cpp", "contact/search/*.cpp", "accuracy/families.cpp", "accuracy/measure.cpp", "cycle/kernel/kernels_*.cpp",
                    "cycle/kernel/packet.cpp"):
        out += sorted(glob.glob(os.path.join(LIB, pattern)))
    for name in ("evaluate", "plan", "friction", "heat", "tie", "curvature"):
        out.append(os.path.join(LIB, "cycle", name + ".cpp"))
    return out


def build(compiler, level, extra, directory, jobs):
    """The digest program of one configuration, or its error."""
    common = ["ccache"] if shutil.which("ccache") else []
    common += [compiler, "-std=c++20", "-" + level, "-ffp-contract=off", "-fno-math-errno", "-w", "-I",
               os.path.join(LIB, "include"), "-I", LIB, "-I", os.path.join(ROOT, "tests")] + extra

    def one(source):
        stem = os.path.splitext(os.path.basename(source))[0]
        target = os.path.join(directory, stem + ".o")
        special = WIDE.get(stem, ["-frounding-math"] if stem.endswith("_cgal") else [])
        run = subprocess.run(common + special + ["-c", source, "-o", target],
                             capture_output=True, text=True)
        return target, run

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        made = list(pool.map(one, sources()))
    for target, run in made:
        if run.returncode != 0:
            return None, "%s: %s" % (os.path.basename(target), run.stderr.strip().split("\n")[0])
    program = os.path.join(directory, "digest")
    link = subprocess.run([compiler] + [m[0] for m in made] + ["-o", program, "-lgmpxx", "-lgmp", "-lmpfr", "-lpthread"],
                          capture_output=True, text=True)
    if link.returncode != 0:
        found = [l for l in link.stderr.split("\n") if "undefined" in l] or [link.stderr.strip()]
        return None, found[0]
    return program, ""


def digests(options):
    """Configuration -> lines of its digest program."""
    out = {}
    flags = {"": []}
    if options.native:
        flags[" -march=haswell"] = ["-march=haswell"]
    for compiler in options.compilers.split(","):
        if shutil.which(compiler) is None:
            print("skipped %s: not installed" % compiler)
            continue
        for level in options.levels.split(","):
            for text, extra in flags.items():
                name = "%s -%s%s" % (compiler, level, text)
                with tempfile.TemporaryDirectory() as directory:
                    program, why = build(compiler, level, extra, directory, options.jobs)
                    if program is None:
                        out[name] = "does not build: " + why
                        print("failed  " + name, flush=True)
                        continue
                    run = subprocess.run([program, str(options.samples)], capture_output=True, text=True)
                    out[name] = run.stdout if run.returncode == 0 else "ends with %d" % run.returncode
                print("done    " + name, flush=True)
    return out


def outputs(program, deck, threads, directory):
    """What a program says about a deck, without what names the deck or the time."""
    text = []
    for verb in (["gaps", "--all"], ["cycle", "--all"]):
        target = os.path.join(directory, "out.json")
        run = subprocess.run([program] + verb + ["--quiet", "--threads", str(threads), "--json", target, deck],
                             capture_output=True)
        with open(target, encoding="utf-8") as f:
            text.append("%d %s" % (run.returncode, re.sub(r'"version": "[^"]*"', "", f.read())))
        os.unlink(target)
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compilers", default="g++,clang++")
    parser.add_argument("--levels", default="O0,O3")
    parser.add_argument("--samples", type=int, default=500, help="per family of hard cases")
    parser.add_argument("--native", action="store_true", help="also with -march=haswell (FMA, AVX2)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--program", action="append", default=[], help="a deck program to compare with the others")
    parser.add_argument("--decks", nargs="*", default=SAMPLES)
    options = parser.parse_args()
    c = Count()
    found = digests(options)
    first = next(iter(found), None)
    for name, text in found.items():
        lines, wanted = text.splitlines(), found[first].splitlines()
        differ = [a for a, b in zip(lines, wanted) if a != b]
        c.check(name, len(lines) == len(wanted) > 3 and not differ,
                text if len(lines) < 4 else "not as %s: %s" % (first, "; ".join(differ)))
    if first is not None:
        print(found[first])
        search = [l for l in found[first].splitlines() if l.startswith("pair search")]
        c.check("one thread and two", len(search) == 2 and search[0] == search[1])
    with tempfile.TemporaryDirectory() as directory:
        for deck in options.decks if options.program else []:
            texts = {(p, t): outputs(p, deck, t, directory) for p in options.program for t in (1, 2)}
            wanted = texts[(options.program[0], 1)]
            for (program, threads), text in texts.items():
                c.check("%s, %s, %d threads" % (os.path.basename(deck), program, threads), text == wanted)
    c.finish()


main()
