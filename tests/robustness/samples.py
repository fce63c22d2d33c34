#!/usr/bin/env python3
"""The sample decks are what samples/generate.py writes, and the README beside them names each one."""
import os
import shutil
import subprocess
import sys
import tempfile

from common import ROOT, SAMPLES


def main():
    failed = 0
    r = subprocess.run([sys.executable, os.path.join(ROOT, "samples", "generate.py"), "--check"], capture_output=True, text=True)
    if r.returncode:
        failed += 1
        print("FAILED  samples/generate.py --check: " + r.stdout + r.stderr)
    # Whoever asks what the script does, or mistypes, gets no file.
    with tempfile.TemporaryDirectory() as away:
        shutil.copy(os.path.join(ROOT, "samples", "generate.py"), away)
        for option, code in (("--help", 0), ("--chekc", 2)):
            r = subprocess.run([sys.executable, os.path.join(away, "generate.py"), option], capture_output=True, text=True)
            if r.returncode != code or os.listdir(away) != ["generate.py"]:
                failed += 1
                print("FAILED  samples/generate.py %s ends with %d and writes nothing" % (option, code))
    with open(os.path.join(ROOT, "samples", "README.md")) as f:
        readme = f.read()
    for path in SAMPLES:
        if os.path.basename(path)[:-9] not in readme:
            failed += 1
            print("FAILED  samples/README.md does not name " + os.path.basename(path))
    print("%d passed, %d failed" % (3 + len(SAMPLES) - failed, failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
