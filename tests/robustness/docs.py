#!/usr/bin/env python3
"""Man pages and shell completion: a page for every verb, every option in it and in the scripts, no
warning of the tools that read them; and the .deb, where the program lies in a complete build."""
import glob
import gzip
import os
import re
import shutil
import subprocess
import tempfile

from common import ROOT, Checks


def run(command, **more):
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, **more)


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
    folder = os.path.join(tmp, "man1")
    r = c.run("man", "--directory", folder)
    c.check("deck man writes the pages", r.code == 0, r.text)
    have = sorted(os.path.basename(p) for p in glob.glob(os.path.join(folder, "*")))
    c.check("a page for every verb and one for deck", have == sorted(["deck.1"] + ["deck-%s.1" % v for v in verbs]), " ".join(have))
    for path in sorted(glob.glob(os.path.join(folder, "*.1"))):
        name = os.path.basename(path)
        with open(path) as f:
            text = f.read()
        if shutil.which("mandoc"):
            bad = [x for x in run(["mandoc", "-T", "lint", "-W", "warning", path]).stdout.split("\n") if x and "missing date" not in x]
            c.check("mandoc on " + name, not bad, "; ".join(bad[:3]))
        if shutil.which("man") and shutil.which("groff"):
            r = run(["man", "--warnings", "-E", "UTF-8", "-l", path], env=dict(os.environ, LC_ALL="C.UTF-8", MANWIDTH="100", MANPAGER="cat"))
            c.check("man --warnings on " + name, r.returncode == 0 and not r.stderr.strip() and "SYNOPSIS" in r.stdout, r.stderr[:300])
        plain = text.replace("\\-", "-")
        if name == "deck.1":
            lacking = [v for v in verbs if "deck-" + v not in plain]
        else:
            help_text = c.run(name[5:-2], "--help").out.decode()
            lacking = [o for o in options_in_help(help_text) if "\\fB" + o + "\\fR" not in plain]
            c.check("%s: --help lists options" % name, len(options_in_help(help_text)) >= 2)
        c.check(name + " is complete", not lacking, " ".join(lacking))
    c.check("one page on standard output", c.run("man", verbs[0]).out == open(os.path.join(folder, "deck-%s.1" % verbs[0]), "rb").read())
    c.check("no page of an unknown verb", c.run("man", "nothing").code == 2)


def complete_in_bash(script, words):
    """What bash offers for the last of `words`."""
    program = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _deck; printf "%s\\n" "${COMPREPLY[@]}"'
    r = run(["bash", "--norc", "-c", program, "bash", script, *words], cwd=os.path.join(ROOT, "samples"))
    return [x for x in r.stdout.split("\n") if x], r.stderr


def completion(c, tmp, verbs):
    scripts = {}
    for shell in ("bash", "zsh"):
        r = c.run("completion", shell)
        c.check("completion for " + shell, r.code == 0 and len(r.out) > 1000, r.text[:200])
        scripts[shell] = os.path.join(tmp, "deck." + shell)
        with open(scripts[shell], "wb") as f:
            f.write(r.out)
        if shutil.which(shell):
            checked = run([shell, "-n", scripts[shell]])
            c.check(shell + " reads the script", checked.returncode == 0 and not checked.stderr, checked.stderr[:200])
        else:
            c.skip(shell + " reads the script", "not installed")
    c.check("no other shell", c.run("completion", "tcsh").code == 2)
    options = {v: options_in_help(c.run(v, "--help").out.decode()) for v in verbs}
    offered, err = complete_in_bash(scripts["bash"], ["deck", ""])
    c.check("bash: all verbs", sorted(x for x in offered if not x.startswith("-")) == sorted(verbs) and not err, "%s %s" % (offered, err))
    for v in verbs:
        offered, err = complete_in_bash(scripts["bash"], ["deck", v, "-"])
        c.check("bash: options of " + v, sorted(offered) == options[v] and not err, "%s, --help has %s %s" % (offered, options[v], err))
    for words, expected in ((["deck", "li"], ["lint"]), (["deck", "lint", "--form"], ["--format"]), (["deck", "lint", "--format", "g"], ["github", "gitlab"]),
                            (["deck", "lint", "--format", "=", "sa"], ["sarif"]), (["deck", "lint", "--format", "="], ["human", "concise", "json", "sarif", "github", "junit", "gitlab"]),
                            (["deck", "gaps", "cr"], ["crash_box_0000.rad", "crossing_edges_0000.rad"]), (["deck", "gaps", "incl"], ["include_tree_0000.rad", "include_tree"]),
                            (["deck", "gaps", "--csv", "gener"], ["generate.py"]), (["deck", "gaps", "--vtk", "inc"], ["include_tree"]),
                            (["deck", "gaps", "--worst", ""], [])):
        offered, err = complete_in_bash(scripts["bash"], words)
        c.check("bash: " + " ".join(words), sorted(offered) == sorted(expected) and not err, "%s %s" % (offered, err))
    if shutil.which("zsh"):
        r = run(["zsh", "-f", "-c", "autoload -U compinit && compinit -u -d $2 && source $1 && print $_comps[deck]", "zsh", scripts["zsh"], os.path.join(tmp, "dump")],
                env=dict(os.environ, HOME=tmp))
        c.check("zsh: registers for deck", r.stdout.strip() == "_deck" and not r.stderr, r.stdout + r.stderr)
        with open(scripts["zsh"]) as f:
            text = f.read()
        for v in verbs:
            part = re.search(r"^    %s\)\n(.*?);;$" % v, text, re.M | re.S)
            lacking = [o for o in options[v] if not part or not re.search(r"[')*]%s[=\[]" % re.escape(o), part.group(1))]
            c.check("zsh: options of " + v, not lacking, " ".join(lacking))
        zsh_offers(c, tmp, scripts["zsh"], verbs)


def zsh_offers(c, tmp, script, verbs):
    """Presses the key in a zsh on a pseudo terminal."""
    driver = r'''
zmodload zsh/zpty
zpty z zsh -f -i
zpty -w z "PS1= PROMPT= ; autoload -U compinit; compinit -u -d $2; source $1; zstyle ':completion:*' list-prompt ''; LISTMAX=0; stty cols 200; print ready''marker"
zpty -r z out "*readymarker*"
zpty -w -n z "deck $3"$'\t'
sleep 0.7
zpty -w -n z $'\C-d'
sleep 0.7
while zpty -r -t z line; do print -r -- "$line"; done
zpty -d z
'''
    for typed, expected in (("lint --form", ["--format"]), ("", verbs), ("lint --format ", ["github", "junit"])):
        r = run(["zsh", "-f", "-c", driver, "zsh", script, os.path.join(tmp, "dump2"), typed], env=dict(os.environ, HOME=tmp, TERM="dumb"))
        lacking = [e for e in expected if e not in r.stdout]
        c.check("zsh: deck " + typed, not lacking, "%s not offered; %r" % (" ".join(lacking), r.stdout[-300:]))


def hidden(c, verbs):
    c.check("man and completion are not in the list of verbs", "man" not in verbs and "completion" not in verbs, " ".join(verbs))
    for v in ("man", "completion"):
        c.check("but they have help: " + v, c.run(v, "--help").code == 0)


def package(c, tmp, verbs):
    build = os.path.dirname(os.path.dirname(c.program))
    config = os.path.join(build, "CPackConfig.cmake")
    if not os.path.exists(config) or not os.path.exists(os.path.join(build, "tools", "docs", "deck.bash")) or not shutil.which("dpkg-deb") or not shutil.which("cpack"):
        c.skip("package", "needs a complete build and Debian's tools")
        return
    r = run(["cpack", "--config", config, "-G", "DEB", "-B", tmp])
    debs = glob.glob(os.path.join(tmp, "*.deb"))
    if not c.check("cpack writes a .deb", r.returncode == 0 and len(debs) == 1, r.stdout[-300:] + r.stderr[-300:]):
        return
    root = os.path.join(tmp, "root")
    c.check("dpkg-deb unpacks it", run(["dpkg-deb", "-x", debs[0], root]).returncode == 0)
    usr = os.path.join(root, "usr")
    for path in ["bin/deck", "share/man/man1/deck.1.gz", "share/bash-completion/completions/deck", "share/zsh/vendor-completions/_deck",
                 "share/doc/libdeck/copyright"] + ["share/man/man1/deck-%s.1.gz" % v for v in verbs]:
        c.check("package has " + path, os.path.isfile(os.path.join(usr, path)))
    page = os.path.join(usr, "share/man/man1/deck.1.gz")
    if os.path.exists(page):
        with gzip.open(page) as f:
            c.check("the packaged page is a page", f.read().startswith(b".TH DECK 1"))
    c.check("the packaged program works", run([os.path.join(usr, "bin", "deck"), "--version"]).returncode == 0)
    depends = run(["dpkg-deb", "-f", debs[0], "Depends"]).stdout
    c.check("it names what it needs", "libc6" in depends and "libfmt" in depends, depends)
    c.check("it needs no MPI", "mpi" not in depends, depends)


def main():
    c = Checks()
    tmp = tempfile.mkdtemp(prefix="deck-docs-")
    try:
        verbs = listed_verbs(c)
        c.check("verbs are listed", len(verbs) >= 10, " ".join(verbs))
        hidden(c, verbs)
        pages(c, tmp, verbs)
        completion(c, tmp, verbs)
        if not c.sanitized:
            package(c, tmp, verbs)
    finally:
        shutil.rmtree(tmp, ignore_errors=True)
    c.finish()


if __name__ == "__main__":
    main()
