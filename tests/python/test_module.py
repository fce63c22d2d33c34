"""The Python module: the same answers as the command line, arrays without copying, errors with places."""
import glob
import json
import math
import os
import pickle
import subprocess
import threading

import numpy as np
import pytest

import libdeck

PROGRAM = os.environ["DECK_PROGRAM"]
SAMPLES = os.environ["DECK_SAMPLES"]
BOX = os.path.join(SAMPLES, "crash_box_0000.rad")
DECKS = sorted(glob.glob(os.path.join(SAMPLES, "*_0000.rad")))
# The largest decks there are, where all of their includes are.
CORPUS = sorted((p for p in glob.glob(os.path.join(os.environ.get("DECK_CORPUS", ""), "corpus", "**", "*_0000.rad"), recursive=True)
                 if "missing_include" not in p), key=os.path.getsize)[-2:]


def command(*args):
    run = subprocess.run([PROGRAM, *args, "--json", "-"], capture_output=True, cwd=SAMPLES)
    assert run.returncode in (0, 1), run.stderr.decode()
    return json.loads(run.stdout)


def same(module, program, without=("gate", "compared")):  # of the gate on the command line
    for key in without:
        module.pop(key, None), program.pop(key, None)
    assert module == program


@pytest.fixture(scope="module")
def box():
    return libdeck.load(BOX)


@pytest.mark.parametrize("path", DECKS + CORPUS, ids=os.path.basename)
def test_gaps_are_those_of_the_command_line(path):
    same(dict(libdeck.load(path).gaps(all=True)), command("gaps", path, "--all", "--crossings"))


@pytest.mark.parametrize("path", DECKS, ids=os.path.basename)
def test_forces_are_those_of_the_command_line(path):
    same(dict(libdeck.load(path).cycle(all=True)), command("cycle", path, "--all"))


def in_json(value):
    """A number whose square no computation can hold is absent in documents."""
    return None if isinstance(value, float) and not math.isfinite(value * value) else value


@pytest.mark.parametrize("path", DECKS, ids=os.path.basename)
def test_effective_values_are_those_of_the_command_line(path):
    document = command("params", path)
    deck = libdeck.load(path)
    assert deck.params() == document
    for listed, interface in zip(document["interfaces"], deck.interfaces.list):
        assert (listed["id"], listed["type"], listed["title"]) == (interface.id, interface.type, interface.title)
        for name, told in listed["parameters"].items():
            if name in interface.fields:
                mine = interface[name]
                assert (in_json(mine.value), in_json(mine.input), mine.origin) == (told["value"], told["input"], told["origin"]), name


@pytest.mark.parametrize("path", DECKS, ids=os.path.basename)
def test_findings_are_those_of_the_command_line(path, tmp_path):
    # Without a configuration file in sight, as in the module.
    for options, geometry in (([], None), (["--geometry"], True), (["--no-geometry"], False)):
        run = subprocess.run([PROGRAM, "lint", *options, "--format", "json", path], capture_output=True, cwd=tmp_path)
        told = json.loads(run.stdout)["diagnostics"]
        mine = libdeck.load(path).lint(geometry=geometry)
        assert [(d["rule"], d["file"], d["line"], d["column"], d["message"]) for d in told] == \
               [(f.rule, f.file, f.line, f.column, f.message) for f in mine]


def test_arrays_say_what_the_json_says(box):
    gaps = box.gaps(all=True)
    listed = [c for i in gaps["interfaces"] for c in i["contacts"]]
    by_part = {(c.interface, c.role): c for c in gaps.contacts}
    seen = 0
    for i in gaps["interfaces"]:
        for told in i["contacts"]:
            c = by_part[i["id"], told["role"]]
            p = c.penetrations
            assert len(p["penetration"]) == len(told["penetrations"])
            mine = sorted(zip(p["penetration"].tolist(), p["gap"].tolist(), p["distance"].tolist(), p["action"].tolist()))
            assert mine == sorted((t["penetration"], t["gap"], t["distance"], t["action"]) for t in told["penetrations"])
            if c.kind == "node_segment":
                pairs = sorted(zip(p.node.tolist(), map(tuple, p.segment.tolist())))
                assert pairs == sorted((t["node"], tuple(t["segment"])) for t in told["penetrations"])
                assert c.secondary["node"].tolist() == [t["node"] for t in told["secondary"]]
                assert c.main["gap"].tolist() == [t["gap"] for t in told["main"]]
            else:
                pairs = sorted((tuple(a), tuple(b)) for a, b in zip(p.edge.tolist(), p.main_edge.tolist()))
                assert pairs == sorted((tuple(t["edge"]), tuple(t["main_edge"])) for t in told["penetrations"])
            assert len(c.tied_pairs["penetration"]) == len(told.get("tied_pairs", []))
            seen += len(told["penetrations"])
    assert seen == gaps["summary"]["pairs"] == 78 and gaps["summary"]["tied"]["pairs"] == 64 and listed
    assert gaps.verdict == gaps["verdict"] and gaps.verdict["counts"]["tied_pairs"] == 64


def test_nothing_is_copied(box):
    first, again = box.nodes, libdeck.Deck(box._native).nodes
    for name in ("ids", "x", "y", "z"):
        a, b = getattr(first, name), getattr(again, name)
        assert a.ctypes.data == b.ctypes.data and not a.flags.owndata and not a.flags.writeable
    assert box.elements("shell").nodes.ctypes.data == box.elements("shell").nodes.ctypes.data
    contact = box.gaps().contacts[0]
    depth, gap = contact.penetrations["penetration"], contact.penetrations["gap"]
    assert depth.strides == gap.strides and depth.strides[0] > 8
    assert 0 < abs(depth.ctypes.data - gap.ctypes.data) < depth.strides[0]  # members of one row


def test_arrays_outlive_the_deck():
    depth = libdeck.load(BOX).gaps().contacts[0].penetrations["penetration"]
    x = libdeck.load(BOX).nodes.x
    for _ in range(3):
        libdeck.load(BOX).gaps()
    assert depth.max() == pytest.approx(1.02379, abs=1e-5) and x[0] == 40.0


def test_nodes_are_found_by_id(box):
    n = box.nodes
    assert n.ids[n.index(2001)] == 2001
    assert (n.index(n.ids[[7, 3]].reshape(1, 2)) == [[7, 3]]).all()
    with pytest.raises(KeyError):
        n.index(987654321)
    assert n.coordinates.shape == (len(n), 3)


def test_what_if_is_that_of_the_command_line(box):
    same(dict(box.what_if(1, Gapmin=0.1, Inacti=6)), command("gaps", BOX, "--crossings", "--what-if", "1:Gapmin=0.1,Inacti=6"))
    for bad in ({"Inacti": 5.9}, {"Igap": 77}, {"Nonsense": 1}, {"Gapmin": float("nan")}):
        with pytest.raises(ValueError):
            box.what_if(1, **bad)
    with pytest.raises(KeyError):
        box.what_if(99, Gapmin=1.0)


def test_velocities_push(box):
    part = box.parts[0].id
    still, moving = box.cycle(dt=1e-6), box.cycle(dt=1e-6, velocities={part: (0.0, 0.0, -10.0)})
    assert still["nodal_force"] != moving["nodal_force"]
    force = moving.contacts[0].pairs["force"]
    assert force.shape[1] == 3 and np.isfinite(force).all()
    assert moving.mass.sum() > 0
    with pytest.raises(KeyError):
        box.cycle(velocities={424242: (0, 0, 0)})


def test_a_conversion_is_that_of_the_command_line(box, tmp_path):
    edit = box.convert(units="Mg,mm,s", renumber="node+1000")
    written = edit.write(tmp_path / "mine")
    subprocess.run([PROGRAM, "convert", BOX, "--units", "Mg,mm,s", "--renumber", "node+1000", "-o", tmp_path / "theirs"],
                   check=True, capture_output=True)
    for path in written:
        with open(path, "rb") as a, open(tmp_path / "theirs" / os.path.relpath(path, tmp_path / "mine"), "rb") as b:
            assert a.read() == b.read()
    assert edit.deck.nodes.ids[0] == box.nodes.ids[0] + 1000
    assert {"kept", "approximated", "dropped", "undecided"} <= set(edit.losses)
    with pytest.raises(FileExistsError):
        edit.write(tmp_path / "mine")
    assert edit.write(tmp_path / "mine", overwrite=True) == written


def test_a_deck_is_never_written_over(tmp_path):
    path = tmp_path / "box_0000.rad"
    with open(BOX, "rb") as f:
        path.write_bytes(f.read())
    before = path.read_bytes()
    edit = libdeck.load(path).convert(renumber="node+1")
    with pytest.raises(libdeck.DeckError):
        edit.write(tmp_path, overwrite=True)
    assert path.read_bytes() == before


def test_a_repair_leaves_less(box):
    edit = box.fix("reduce-gap")
    assert edit.report["strategy"] == "reduce-gap" and b"/INTER/" in edit.diff()
    assert edit.deck.gaps()["summary"]["pairs"] < box.gaps()["summary"]["pairs"]
    with pytest.raises(ValueError):
        box.fix("magic")


def test_errors_have_places(tmp_path):
    with pytest.raises(libdeck.DeckError):
        libdeck.load(tmp_path / "nothing_0000.rad")
    other = tmp_path / "page_0000.rad"
    other.write_text("<html>\n<body>\n</body>\n</html>\n")
    with pytest.raises(libdeck.DeckError, match="HTML|html|Starter"):
        libdeck.load(other)
    half = tmp_path / "half_0000.rad"
    with open(BOX) as f:
        half.write_text(f.read().replace("/END", "#include gone.inc\n/END"))
    deck = libdeck.load(half)
    with pytest.raises(libdeck.DeckError) as caught:
        deck.gaps()
    assert caught.value.diagnostics[0]["line"] > 0 and "gone.inc" in str(caught.value.diagnostics)
    with pytest.raises(libdeck.DeckError):
        deck.convert(units="Mg,mm,s")
    with pytest.raises(TypeError, match="whole number such as 2018"):
        deck.convert(version="2018")


def test_unknown_names_are_errors(box):
    with pytest.raises(KeyError):
        box.gaps(interfaces=[99])
    with pytest.raises(AttributeError):
        box.interfaces[1].Gapmni
    with pytest.raises(ValueError):
        box.gaps(accuracy="perfect")
    with pytest.raises(KeyError):
        box.elements("shells")
    with pytest.raises(AttributeError, match="cycle"):
        box.gaps().contacts[0].pairs


@pytest.mark.parametrize("bad", [{"dt": float("nan")}, {"dt": float("inf")}, {"dt": -1.0}, {"time": float("nan")},
                                 {"velocities": {1: (float("nan"), 0, 0)}}, {"velocities": {1: (float("inf"), 0, 0)}},
                                 {"velocities": {1: (0, 0)}}, {"velocities": {1: "fast"}}], ids=str)
def test_numbers_that_are_none_are_refused(box, bad):
    with pytest.raises(ValueError):
        box.cycle(**bad)


@pytest.mark.parametrize("bad", [{"min_gap": float("nan")}, {"max_moved": float("inf")}, {"fpenmax": float("nan")},
                                 {"max_displacement": float("nan")}, {"max_displacement": 0.0}], ids=str)
def test_bounds_of_a_repair_that_are_none_are_refused(box, bad):
    with pytest.raises(ValueError):
        box.fix("move-nodes", **bad)


@pytest.mark.parametrize("name", ["Deck", "Scene", "Cycle", "Edit"])
def test_native_objects_are_made_by_the_library_only(name):
    with pytest.raises(TypeError):
        kind = getattr(libdeck._native, name)
        kind.__new__(kind)


def test_an_edit_is_written_through_no_link(box, tmp_path):
    (tmp_path / "home").write_text("precious")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / os.path.basename(BOX)).symlink_to(tmp_path / "home")
    with pytest.raises(libdeck.DeckError, match="symbolic link"):
        box.convert(renumber="node+1").write(tmp_path / "out", overwrite=True)
    assert (tmp_path / "home").read_text() == "precious"


def test_threads_may_share_a_deck(box):
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(box.gaps()["summary"])) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(answers) == 4 and all(a == answers[0] for a in answers)


def test_values_explain_themselves(box):
    value = box.interfaces[1].Gapmin
    assert value.dimension == "length" and value.doc and str(value.span).endswith(":1846:41")
    assert "Gapmin" in dir(box.interfaces[1])
    assert pickle.loads(pickle.dumps(value)) == value


def test_penetrations_make_a_frame(box):
    pytest.importorskip("pandas")
    frame = box.gaps().contacts[0].penetrations.frame()
    assert {"node", "penetration", "normal_0", "segment_3"} <= set(frame.columns)
    assert frame["penetration"].max() > 0


@pytest.mark.parametrize("script", sorted(glob.glob(os.path.join(SAMPLES, "python", "*.py"))), ids=os.path.basename)
def test_sample_scripts_run(script, tmp_path):
    import sys

    run = subprocess.run([sys.executable, script, BOX], capture_output=True, cwd=tmp_path, text=True)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip() and any(name.endswith(".svg") for name in os.listdir(tmp_path))


def test_values_are_set_and_written(tmp_path):
    d = libdeck.load(BOX)
    inter = d.interfaces[1]
    before = d.gaps()["summary"]["pairs"]
    inter.set(Gapmin=0.25, **{"%mesh_size": 0.3})
    assert (inter.Gapmin.value, inter["%mesh_size"].value) == (0.25, 0.3)
    assert d.interfaces[1].Gapmin.value == 0.25 and d.gaps()["summary"]["pairs"] <= before
    inter.set(Inacti=6)
    inter.set(Gapmin=np.float64(0.5), Igap=np.int32(inter.Igap.value))
    assert b"+++ b/" in d.diff() and inter.Inacti.value == 6
    written = d.write(tmp_path / "out")
    again = libdeck.load(written[0]).interfaces[1]
    assert (again.Gapmin.value, again.Inacti.value, again["%mesh_size"].value) == (0.5, 6, 0.3)
    with pytest.raises(FileExistsError):
        d.write(tmp_path / "out")
    assert d.write(tmp_path / "out", overwrite=True) == written
    assert libdeck.load(BOX).interfaces[1].Gapmin.value == 0.5


def test_blocks_and_nodes_are_set_in_place(tmp_path):
    path = tmp_path / os.path.basename(BOX)
    path.write_bytes(open(BOX, "rb").read())
    d = libdeck.load(path)
    d.set("/PROP", d.parts[0].prop_id, Thick=1.75)
    assert b"1.75" in d.diff()
    node = int(d.nodes.ids[0])
    x, y, z = d.nodes.coordinates[0].tolist()
    d.move_node(node, x, y, z + 0.125)
    assert d.nodes.z[d.nodes.index(node)] == z + 0.125
    assert d.save(backup_suffix=".orig") == [str(path)]
    again = libdeck.load(path)
    assert again.nodes.z[again.nodes.index(node)] == z + 0.125
    assert b"1.75" in path.read_bytes()
    assert open(str(path) + ".orig", "rb").read() == open(BOX, "rb").read()
    with pytest.raises(libdeck.DeckError):
        d.save()


def test_an_interface_behind_ties_sets_its_own_card(tmp_path):
    d = libdeck.load(os.path.join(SAMPLES, "welds_0000.rad"))
    d.insert("/INTER/TYPE7/99\nbehind the ties\n")
    d = libdeck.load(d.write(tmp_path)[0])
    d.interfaces[99].set(Stfac=0.5)
    d.interfaces[1].set(dsearch=0.25)
    assert (d.interfaces[99].Stfac.value, d.interfaces[1].dsearch.value) == (0.5, 0.25)


def test_blocks_come_and_go():
    d = libdeck.load(BOX)
    first, old = d.interfaces[1], len(d.interfaces)
    first.set(Tstop=0.5)
    d.insert("/INTER/TYPE7/777\nnew contact\n")
    new = d.interfaces[777]
    new.set(grnd_IDs=1, Gapmin=0.75, Inacti=6)
    assert (new.title, new.Gapmin.value, new.Inacti.value, new.Gapmin.origin) == ("new contact", 0.75, 6, "card")
    d.erase("/INTER", 1)
    assert len(d.interfaces) == old and 1 not in d.interfaces and new.Gapmin.value == 0.75
    new.set(Gapmin=0.5)
    d.set("/INTER/TYPE7", 777, Fric=0.1)
    assert (new.Gapmin.value, new.Fric.value) == (0.5, 0.1)
    with pytest.raises(KeyError):
        first.Gapmin
    patch = d.diff()
    with pytest.raises(KeyError):
        d.erase("/INTER", 1234)
    with pytest.raises(ValueError, match="begin with a keyword"):
        d.insert("no keyword")
    assert d.diff() == patch


def test_the_sample_adds_a_contact_to_many_decks(tmp_path):
    import shutil
    import sys

    script = os.path.join(SAMPLES, "automation", "add_interface.py")
    decks = [tmp_path / f"car{k:02}_0000.rad" for k in range(3)]
    for path in decks:
        shutil.copy(os.path.join(SAMPLES, "too_close_0000.rad"), path)
    command = [sys.executable, script, "-o", str(tmp_path / "out"), "--surf", "1", "--gap", "0.8"]
    run = subprocess.run([*command, "--grnd", "2", *decks], capture_output=True, text=True)
    assert run.returncode == 0 and len(run.stdout.splitlines()) == 3, run.stderr
    for path in decks:
        made = tmp_path / "out" / path.name
        inter = libdeck.load(made).interfaces
        assert list(inter) == [1, 2]
        assert [inter[2][n].value for n in ("Gapmin", "Fric", "Inacti", "Istf")] == [0.8, 0.2, 6, 4]
        before, after = path.read_text().splitlines(), made.read_text().splitlines()
        assert before == after[:len(before) - 1] + after[-1:]
    run = subprocess.run([*command, "--grnd", "12345678901", decks[0]], capture_output=True, text=True)
    assert run.returncode == 1 and "/INTER/TYPE7/2 grnd_IDs" in run.stderr and "Traceback" not in run.stderr


@pytest.mark.parametrize("values, message", [
    ({"Gapmin": float("nan")}, "not-a-number"), ({"Gapmin": float("inf")}, "infinity"),
    ({"Gapmin": np.float64("-inf")}, "infinity"), ({"Igap": 2.5}, "whole number"), ({"Gapmin": "wide"}, "expected a number"),
    ({"Gapmim": 1.0}, "did you mean Gapmin"), ({"Gapmin": -5.0}, "no legal value"), ({"Igap": 7}, "no legal value"), ({"Fric": 0.3, "Gapmin": "&none"}, "parameter")])
def test_what_a_cell_cannot_hold_is_refused_and_nothing_is_set(values, message):
    d = libdeck.load(BOX)
    d.interfaces[1].set(Tstop=0.5)
    patch = d.diff()
    with pytest.raises(ValueError, match=message):
        d.interfaces[1].set(**values)
    assert d.diff() == patch and d.interfaces[1].Tstop.value == 0.5
    with pytest.raises(KeyError):
        d.set("/PROP", 987654, Thick=1.0)
    with pytest.raises(KeyError):
        d.move_node(987654, 0.0, 0.0, 0.0)


def test_the_manual_is_true(tmp_path, monkeypatch):
    import doctest
    import shutil

    shutil.copytree(SAMPLES, tmp_path / "samples")
    monkeypatch.chdir(tmp_path)
    page = os.path.join(os.path.dirname(SAMPLES), "tools", "docs", "python.md")
    failed, tried = doctest.testfile(page, module_relative=False)
    assert tried > 15 and failed == 0


def test_the_stubs_name_what_is_there():
    import ast

    from libdeck import _native

    path = os.path.join(os.path.dirname(libdeck.__file__), "_native.pyi")
    with open(path) as f:
        tree = ast.parse(f.read())
    for item in tree.body:
        if isinstance(item, ast.FunctionDef):
            assert callable(getattr(_native, item.name))
        elif isinstance(item, ast.ClassDef):
            have = {n for n in dir(getattr(_native, item.name)) if not n.startswith("_")} | {"__len__"}
            told = {getattr(b, "name", None) or b.target.id for b in item.body}
            assert told <= have and have - {"__len__"} <= told, item.name


@pytest.mark.parametrize("path", DECKS, ids=os.path.basename)
def test_parts_and_ties_are_those_of_the_command_line(path):
    deck = libdeck.load(path)
    assert deck.parts(all=True) == command("parts", path, "--all")
    told = {t["id"]: t for t in command("gaps", path, "--all")["ties"]}
    assert sorted(t.id for t in deck.ties()) == sorted(told)
    for tie in deck.ties():
        nodes, listed = tie.nodes, told[tie.id]["nodes"]
        assert tie.summary["tied"] == told[tie.id]["summary"]["tied"] and len(nodes["node"]) == len(listed)
        for k, row in enumerate(listed):
            assert (nodes["node"][k], bool(nodes["tied"][k])) == (row["node"], row["tied"])
            assert list(nodes["segment"][k]) == (row["segment"] or [0, 0, 0, 0]) and nodes["why"][k] == row["why"]
            if row["segment"]:
                assert (nodes["s"][k], nodes["distance"][k]) == (row["s"], row["distance"])


def test_show_compare_and_explain_are_those_of_the_command_line(box, tmp_path):
    for what in ("1", "part:1", "node:2001"):
        run = subprocess.run([PROGRAM, "show", BOX, what, "--json", "-"], capture_output=True, cwd=SAMPLES)
        assert box.show(what) == json.loads(run.stdout)
    with pytest.raises(KeyError, match="node"):
        box.show("node:424242")
    other = os.path.join(SAMPLES, "clean_plates_0000.rad")
    close = os.path.join(SAMPLES, "too_close_0000.rad")
    assert libdeck.load(other).compare(libdeck.load(close)) == command("diff", other, close)
    assert box.compare(box)["equal"]
    with pytest.raises(ValueError):
        box.compare(box, match="colour")
    listing = os.path.join(SAMPLES, "too_close_0000.out")
    assert libdeck.load(close).explain(listing) == command("explain", listing)
    assert [m["message"] for m in libdeck.explain_listing(listing)["messages"]] == [343, 1084]
    with pytest.raises(libdeck.DeckError, match="no listing"):
        libdeck.load(close).explain(BOX)
    run = subprocess.run([PROGRAM, "explain", "DK254"], capture_output=True, text=True, env={k: v for k, v in os.environ.items() if k != "COLUMNS"})
    assert libdeck.explain("DK254").split() == run.stdout.split()
    assert "611" in libdeck.explain(611) and "343" in libdeck.explain("initial penetrations")
    with pytest.raises(KeyError, match="nonsense"):
        libdeck.explain("nonsense of all kinds")


def test_a_gate_holds_a_deck_against_an_earlier_one():
    close = libdeck.load(os.path.join(SAMPLES, "too_close_0000.rad"))
    free = close.gate()
    assert free["gate"] is None and free["compared"] is None
    assert not close.gate(max_depth=0.3)["gate"]["passed"] and close.gate(max_depth=0.4)["gate"]["passed"]
    assert [f["rule"] for f in close.gate(max_count=8)["gate"]["findings"]] == ["DK372"]
    assert close.gate(max_dt_loss=1.0)["gate"]["passed"]
    better = close.fix("reduce-gap").deck
    assert better.gate(compare=close)["compared"]["solved"] == 9
    worse = close.gate(compare=better)
    assert not worse["gate"]["passed"] and worse["compared"]["new"] == 9
    assert close.gate(compare=close.gaps())["compared"]["same"] == 9
    with pytest.raises(ValueError):
        close.gate(compare={"no": "document"})


@pytest.mark.parametrize("path", sorted(glob.glob(os.path.join(SAMPLES, "python", "*.ipynb"))), ids=os.path.basename)
def test_notebooks_print_what_they_show(path, tmp_path):
    import notebook

    assert notebook.run(path, tmp_path) == notebook.stored(path)
