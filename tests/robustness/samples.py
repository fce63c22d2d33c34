#!/usr/bin/env python3
"""samples/README.md names each sample deck."""
import os
import sys

from common import ROOT, SAMPLES


def main():
    failed = 0
    with open(os.path.join(ROOT, "samples", "README.md")) as f:
        readme = f.read()
    for path in SAMPLES:
        if os.path.basename(path)[:-9] not in readme:
            failed += 1
            print("FAILED  samples/README.md does not name " + os.path.basename(path))
    print("%d passed, %d failed" % (len(SAMPLES) - failed, failed))
    sys.exit(1 if failed or not SAMPLES else 0)


if __name__ == "__main__":
    main()
