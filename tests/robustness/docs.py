#!/usr/bin/env python3
"""Man pages and completion: a page for every verb, every option offered by bash, no warning of mandoc; and the .deb, where the program lies in a complete build."""
import glob
import gzip
import os
import re
import shutil
import subprocess

from common import ROOT, run_steps


def run(command, **more):
    return subprocess.run(command, **({} if "input" in more else {"stdin": subprocess.DEVNULL}), capture_output=True, text=True, timeout=120, **more)


def listed_verbs(c):
    text = c.run("--help").out.decode()
    return re.findall(r"^  ([a-z]+)  ", text[text.index("Subcommands:"):], re.M)


def options_in_help(text):
    """Long and short names as --help lists them."""
    found = []
    for line in text.split("\n"):
        m = re.match(r"^\s+((?:-\w,)?--[\w-]+|-\w)\b", line)
        if m:
            found += m.group(1).split(",")
    return sorted(set(found))


def pages(c, tmp, verbs):
    if not shutil.which("help2man"):
        c.skip("man pages", "needs help2man")
        return
    folder = os.path.join(tmp, "man1")
    r = run([os.path.join(ROOT, "tools/man/pages"), c.program, folder])
    c.check("tools/man/pages writes the pages", r.returncode == 0, r.stderr[:300])
    have = sorted(os.path.basename(p) for p in glob.glob(os.path.join(folder, "*")))
    c.check("a page for every verb and one for deck", have == sorted(["deck.1.gz"] + ["deck-%s.1.gz" % v for v in verbs]), " ".join(have))
    for path in sorted(glob.glob(os.path.join(folder, "*.gz"))):
        name = os.path.basename(path)[:-5]
        with gzip.open(path, "rt") as f:
            text = f.read()
        if shutil.which("mandoc"):
            bad = [x for x in run(["mandoc", "-T", "lint", "-W", "warning"], input=text).stdout.split("\n") if x and "cannot parse date" not in x]
            c.check("mandoc on " + name, not bad, "; ".join(bad[:3]))


def complete_in_bash(program, words):
    """What bash offers for the last of `words`."""
    line = 'PATH=$1:$PATH; source "$2"; shift 2; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _deck; printf "%s\\n" "${COMPREPLY[@]}"'
    r = run(["bash", "--norc", "-c", line, "bash", os.path.dirname(program), os.path.join(ROOT, "tools/man/deck.bash"), *words], cwd=os.path.join(ROOT, "samples"))
    return [x for x in r.stdout.split("\n") if x], r.stderr


def completion(c, verbs):
    offered, err = complete_in_bash(c.program, ["deck", ""])
    c.check("bash: all verbs", sorted(x for x in offered if not x.startswith("-")) == sorted(verbs) and not err, "%s %s" % (offered, err))
    for v in verbs:
        offered, err = complete_in_bash(c.program, ["deck", v, "--"])
        expected = [o for o in options_in_help(c.run(v, "--help").out.decode()) if o.startswith("--")]
        c.check("bash: options of " + v, sorted(set(offered)) == expected and not err, "%s, --help has %s %s" % (offered, expected, err))
    for words, expected in ((["deck", "li"], ["lint"]), (["deck", "lint", "--format", "g"], ["github", "gitlab"]), (["deck", "lint", "--format", "=", "sa"], ["sarif"]),
                            (["deck", "gaps", "crash_box_00"], ["crash_box_0000.rad"])):
        offered, err = complete_in_bash(c.program, words)
        c.check("bash: " + " ".join(words), sorted(offered) == sorted(expected) and not err, "%s %s" % (offered, err))


def package(c, tmp, verbs):
    build = os.path.dirname(os.path.dirname(c.program))
    config = os.path.join(build, "CPackConfig.cmake")
    if not os.path.exists(config) or not os.path.exists(os.path.join(build, "tools", "man1", "deck.1.gz")) or not shutil.which("dpkg-deb") or not shutil.which("cpack"):
        c.skip("package", "needs a complete build and Debian's tools")
        return
    r = run(["cpack", "--config", config, "-G", "DEB", "-B", tmp])
    debs = glob.glob(os.path.join(tmp, "*.deb"))
    if not c.check("cpack writes a .deb", r.returncode == 0 and len(debs) == 1, r.stdout[-300:] + r.stderr[-300:]):
        return
    root = os.path.join(tmp, "root")
    c.check("dpkg-deb unpacks it", run(["dpkg-deb", "-x", debs[0], root]).returncode == 0)
    usr = os.path.join(root, "usr")
    for path in ["bin/deck", "share/man/man1/deck.1.gz", "share/bash-completion/completions/deck",
                 "share/doc/libdeck/copyright"] + ["share/man/man1/deck-%s.1.gz" % v for v in verbs]:
        c.check("package has " + path, os.path.isfile(os.path.join(usr, path)))
    page = os.path.join(usr, "share/man/man1/deck.1.gz")
    if os.path.exists(page):
        with gzip.open(page) as f:
            c.check("the packaged page is a page", b".TH DECK " in f.read())
    c.check("the packaged program works", run([os.path.join(usr, "bin", "deck"), "--version"]).returncode == 0)
    depends = run(["dpkg-deb", "-f", debs[0], "Depends"]).stdout
    c.check("it names what it needs", "libc6" in depends and "libfmt" in depends, depends)
    c.check("it needs no MPI", "mpi" not in depends, depends)


def everything(c, tmp):
    verbs = listed_verbs(c)
    c.check("verbs are listed", len(verbs) >= 10, " ".join(verbs))
    pages(c, tmp, verbs)
    completion(c, verbs)
    if not c.sanitized:
        package(c, tmp, verbs)


if __name__ == "__main__":
    run_steps(everything)
