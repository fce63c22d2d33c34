#!/usr/bin/env python3
"""The C++ files that git tracks are as clang-format writes them (.clang-format; version 14, that of Debian 12). Nothing is changed.

    python3 tests/tools/check_format.py"""
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Count  # noqa: E402


def program():
    for name in ("clang-format-14", "clang-format"):
        path = shutil.which(name)
        if path and re.search(r"version 14\.", subprocess.run([path, "--version"], capture_output=True, text=True).stdout):
            return path
    return None


def main():
    c = Count()
    clang_format = program()
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "*.cpp", "*.hpp"], capture_output=True, text=True)
    if clang_format is None or listed.returncode:
        c.skip("format", "no clang-format of version 14" if clang_format is None else "no git tree here")
        c.finish()
    files = [f for f in listed.stdout.split("\0") if f and os.path.exists(os.path.join(ROOT, f))]
    run = subprocess.run([clang_format, "--dry-run", *files], cwd=ROOT, capture_output=True, text=True)
    wrong = {}
    for name, line in re.findall(r"(?m)^(.+?):(\d+):\d+: warning: code should be clang-formatted", run.stderr):
        wrong.setdefault(name, line)
    for name in files:
        c.check("%s:%s is not as clang-format writes it; run %s -i %s" % (name, wrong.get(name), os.path.basename(clang_format), name), name not in wrong)
    c.check("clang-format ends well", run.returncode == 0 and len(files) > 300, "exit code %d for %d files" % (run.returncode, len(files)))
    c.finish()


if __name__ == "__main__":
    main()
