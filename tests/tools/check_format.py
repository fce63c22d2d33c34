#!/usr/bin/env python3
"""The C++ files that git tracks are as clang-format writes them (.clang-format; version 14, that of Debian 12). Nothing is changed.

    python3 tests/tools/check_format.py"""
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def program():
    for name in ("clang-format-14", "clang-format"):
        path = shutil.which(name)
        if path and re.search(r"version 14\.", subprocess.run([path, "--version"], capture_output=True, text=True).stdout):
            return path
    return None


def main():
    clang_format = program()
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "*.cpp", "*.hpp"], capture_output=True, text=True)
    if clang_format is None or listed.returncode:
        print("skipped format: %s" % ("no clang-format of version 14" if clang_format is None else "no git tree here"))
        print("0 passed, 0 failed, 1 skipped")
        return
    files = [f for f in listed.stdout.split("\0") if f and os.path.exists(os.path.join(ROOT, f))]
    run = subprocess.run([clang_format, "--dry-run", *files], cwd=ROOT, capture_output=True, text=True)
    wrong = {}
    for line in run.stderr.splitlines():
        found = re.match(r"(.+?):(\d+):\d+: warning: code should be clang-formatted", line)
        if found:
            wrong.setdefault(found.group(1), found.group(2))
    failed = 0
    for name in sorted(wrong):
        failed += 1
        print("FAILED  %s:%s is not as clang-format writes it; run %s -i %s" % (name, wrong[name], os.path.basename(clang_format), name))
    if run.returncode or len(files) < 300:
        failed += 1
        print("FAILED  clang-format ended with %d for %d files" % (run.returncode, len(files)))
    print("%d passed, %d failed" % (len(files) - len(wrong), failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
