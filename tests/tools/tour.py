#!/usr/bin/env python3
"""A tour through the verbs in a pseudo-terminal: no line of any screen is wider than the terminal, at 80, 120 and 200 columns, over
the samples and, where they are there, decks outside of the project. Two screens with wide tables are compared with those kept in
tests/tools/screens; what other calls print stands in tools/docs, where check_docs.py holds it.

    python3 tests/tools/tour.py DECK            compares
    python3 tests/tools/tour.py DECK --record   writes the screens anew; look at the difference before you commit it

A file has a command behind '$', then its screen. It ends with 'N passed, N failed'."""
import difflib
import fcntl
import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unicodedata

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "robustness"))
from common import ROOT, Checks, moved, write  # noqa: E402

SCREENS = os.path.join(ROOT, "tests", "tools", "screens")
MEASURED = (80, 120, 200)  # columns; a screen is kept at the first
ESCAPES = re.compile(r"\x1b\[[0-9;]*[mK]")

# Commands as they are typed in a directory with samples/ and the decks made below.
KEPT = {
    "gaps": "gaps samples/crash_box_0000.rad --worst 4",
    "cycle": "cycle samples/too_close_0000.rad --velocity 2=0,0,-5 --dt 1e-3 --steps 3",
}
# Measured, not kept: wide characters, long names, many findings of a kind, times. A batch has a directory per width.
OTHERS = [
    "gate samples/too_close_0000.rad samples/clean_plates_0000.rad --max-depth 0.3",
    "lint samples/every_mistake_0000.rad --select DK242,DK201:Istf", "params samples/crash_box_0000.rad --matrix",
    "show samples/crash_box_0000.rad node:804", "diff samples/clean_plates_0000.rad samples/too_close_0000.rad",
    "explain DK203", "fix samples/crash_box_0000.rad",
    "--help", "gaps --help", "lint --help", "convert --help",
    "rules",
    "explain DK1", "explain TYPE7", "explain Gapmin", "explain 611", "explain Gapmim", "explain car_0000.out", "explain /INTER/TYPE19.Gapmin",
    "accuracy samples/crash_box_0000.rad --samples 5 --repeats 1",
    "accuracy --samples 5 --repeats 1",
    "gaps samples/too_close_0000.rad --json old.json --quiet",
    "gaps worse_0000.rad --compare old.json --fail-on new,worse --worst 1",
    "gaps better_0000.rad --compare old.json --fail-on new,worse --worst 1",
    "gaps wide_0000.rad --worst 2", "gaps long_0000.rad --worst 2", "gaps samples/crash_box_0000.rad --worst 2 --crossings -v",
    "cycle samples/crash_box_0000.rad", "cycle samples/two_surfaces_0000.rad -v", "cycle samples/too_close_0000.rad --effects",
    "lint samples/clean_plates_0000.rad samples/too_close_0000.rad samples/absent_0000.rad", "lint alike_0000.rad --select DK201",
    "lint wide_0000.rad", "lint samples/every_mistake_0000.rad --select DK171 --ruler",
    "params samples/tied_layer_0000.rad", "params long_0000.rad --changed",
    "show samples/crash_box_0000.rad 2", "show samples/include_tree_0000.rad part:1",
    "diff samples/too_close_0000.rad %s/too_close_0000.rad" % "/".join(["a_folder_with_a_rather_long_name"] * 3),
    "fix samples/too_close_0000.rad --strategy move-nodes", "fix samples/welds_0000.rad --strategy tie",
    "batch --verb gaps -o batch-{columns} samples/clean_plates_0000.rad samples/too_close_0000.rad",
    "convert samples --version 110 --check",
    "convert samples/two_surfaces_0000.rad -o converted-{columns} --expand-type19",
]
OUTSIDE = [("lint", "--geometry"), ("gaps", "--crossings"), ("gaps", "-v"), ("cycle",), ("cycle", "-v"), ("params", "--matrix")]


def columns_of(text):
    wide = 0
    for c in ESCAPES.sub("", text):
        if unicodedata.category(c) not in ("Mn", "Me", "Cf"):
            wide += 2 if unicodedata.east_asian_width(c) in "WF" else 1
    return wide


def without_progress(text):
    """The line of progress is drawn on one line and wiped; it holds no line end."""
    first, *parts = text.split("\r\x1b[K")
    return first + "".join(p for p in parts if "\n" in p)


def seen(program, command, columns, folder, color=False):
    """(what a terminal of so many columns shows, exit code)"""
    main, sub = pty.openpty()
    fcntl.ioctl(sub, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    env = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR", "DECK_SCHEMAS")}
    env.update(TERM="xterm", LC_ALL="C.UTF-8")
    if not color:
        env["NO_COLOR"] = "1"
    words = [w.replace("{columns}", str(columns)) for w in command]
    process = subprocess.Popen([program, *words], cwd=folder, env=env, stdin=sub, stdout=sub, stderr=sub, start_new_session=True)
    os.close(sub)
    data = b""
    while True:
        try:
            piece = os.read(main, 65536)
        except OSError:  # the other end is closed
            break
        if not piece:
            break
        data += piece
    os.close(main)
    text = without_progress(data.decode("utf-8", "replace").replace("\r\n", "\n"))
    return re.sub(r"\b\d+ of \d+ rules", lambda m: re.sub(r"\d", "#", m.group(0)), text), process.wait()


def make_decks(folder):
    """The samples, and what is made of them: wide characters, long names, many findings of a kind."""
    shutil.copytree(os.path.join(ROOT, "samples"), os.path.join(folder, "samples"))
    with open(os.path.join(ROOT, "samples", "too_close_0000.rad"), encoding="utf-8") as f:
        text = f.read()

    def deck(name, text):
        write(os.path.join(folder, name), text)
    # The plates at z 0 and 0.9: node 101 further in, and further out.
    deck("worse_0000.rad", moved(text, 101, "0.8"))
    deck("better_0000.rad", moved(text, 101, "1.0"))
    deck(os.path.join(*["a_folder_with_a_rather_long_name"] * 3, "too_close_0000.rad"), moved(text, 101, "1.0"))
    lines = text.split("\n")
    header = next(i for i, line in enumerate(lines) if line.startswith("/INTER/TYPE7/1"))
    parts = [i for i, line in enumerate(lines) if re.match(r"/PART/\d", line)]

    def titled(interface, part):
        out = list(lines)
        out[header + 1] = interface
        for i in parts:
            out[i + 1] = part
        return out
    wide = titled("車体前部 と 障壁 の 接触 ünïcödé", "前面パネル 左側")
    # A flag that is none, behind a tab and a wide character in a comment line's place: the card itself stays in columns.
    cells = next(i for i in range(header + 2, len(wide)) if wide[i][:1] not in "#/" and wide[i].strip())
    wide[cells] = wide[cells][:20] + "%10s" % "7" + wide[cells][30:].rstrip() + "\t\t車体" + " and a long remark behind the card" * 4
    deck("wide_0000.rad", "\n".join(wide))
    deck("long_0000.rad", "\n".join(titled("front rail left hand side against the inner barrier face, revision of the second loop",
                                            "a_part_whose_name_was_made_by_a_program_that_knows_no_blanks_at_all_and_goes_on")))
    deck("car_0000.rad", text)
    shutil.copy(os.path.join(ROOT, "samples", "too_close_0000.out"), os.path.join(folder, "car_0000.out"))
    block = [line for line in lines[header:]]
    end = next(i for i in range(1, len(block)) if block[i].startswith("/"))
    alike = list(lines)
    at = header + end
    for k in range(2, 20):
        copy = [("/INTER/TYPE7/%d" % k)] + block[1:end]
        alike[at:at] = copy
    for i, line in enumerate(alike):
        if line.startswith("/INTER/TYPE7/"):
            card = next(j for j in range(i + 2, len(alike)) if alike[j][:1] not in "#/" and alike[j].strip())
            alike[card] = alike[card][:20] + "%10s" % "7" + alike[card][30:]
    deck("alike_0000.rad", "\n".join(alike))


class Tour(Checks):
    def measure(self, name, screen, columns, code=None):
        if code is not None:
            self.check("%s at %d ends orderly" % (name, columns), code in (0, 1, 2, 3), "exit code %s" % code)
        long = [line for line in screen.split("\n") if columns_of(line) > columns]
        self.check("%s at %d columns has no wider line" % (name, columns), not long, "%d lines, such as %r" % (len(long), (long or [""])[0]))

    def screen(self, command, folder):
        """What the command shows at the first width; it is measured at all of them."""
        shown = []
        for columns in MEASURED:
            screen, code = seen(self.program, command.split(), columns, folder)
            self.measure("deck " + command, screen, columns, code)
            self.check("deck %s at %d shows no path of this machine" % (command, columns), folder not in screen and ROOT not in screen)
            shown.append("$ deck %s\n---- exit code %d\n%s" % (command, code, screen))
        screen, _ = seen(self.program, command.split(), MEASURED[0], folder, color=True)
        self.measure("coloured deck " + command, screen, MEASURED[0])
        return shown[0]

    def screens(self, folder):
        for name, command in KEPT.items():
            text, path = self.screen(command, folder), os.path.join(SCREENS, name + ".txt")
            if self.options.record:
                with open(path, "w", encoding="utf-8") as f:
                    f.write(text)
            with open(path, encoding="utf-8") as f:
                kept = f.read()
            difference = "\n".join(list(difflib.unified_diff(kept.split("\n"), text.split("\n"), "kept", "seen", lineterm="", n=1))[:20])
            self.check("the screen of %s is the one that was kept" % name, kept == text, "\n" + difference)
        for command in OTHERS:
            self.screen(command, folder)

    def outside(self):
        """Decks that are not the project's."""
        decks = self.corpus_decks()
        for name, path in decks if self.options.all else decks[:4]:
            for verb in OUTSIDE:
                screen, code = seen(self.program, (verb[0], path, *verb[1:]), 80, None)
                self.measure("deck %s of %s" % (" ".join(verb), name), screen, 80, code)


def main():
    tour = Tour()
    with tempfile.TemporaryDirectory() as folder:
        make_decks(folder)
        tour.screens(folder)
    tour.outside()
    tour.finish()


if __name__ == "__main__":
    main()
