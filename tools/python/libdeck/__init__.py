"""Contact interfaces of Radioss Starter decks: effective values, gaps, penetrations, first-cycle forces.

    import libdeck
    d = libdeck.load("car_0000.rad")
    d.interfaces[3].Gapmin.value          # what the solver uses, in the deck's working units
    d.interfaces[3].Gapmin.origin         # "card", "default-block", "built-in" or "derived"
    for c in d.gaps().contacts:
        print(c.interface, c.role, c.penetrations["penetration"].max(initial=0.0))

Arrays are NumPy arrays over the memory of the library, which is not copied: what they belong to lives as long as
they do. All lengths, forces and times are in the deck's working units.
"""
# Over 600 lines: half of them are the documentation of what users see in one module.
from __future__ import annotations

import json as _json
from collections.abc import Mapping as _Mapping
from dataclasses import dataclass, field
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Union

import numpy as _np

from . import _native
from ._errors import DeckError

__all__ = ["load", "explain", "explain_listing", "Deck", "DeckError", "Edit", "Finding", "Forces", "Gaps", "Contact",
           "Interface", "Interfaces", "Nodes", "Elements", "Part", "Parts", "Place", "Tie", "Value"]
__version__: str = _native.version


@dataclass(frozen=True)
class Place:
    """A place in a file: 1-based line and columns, as an editor shows them (columns count bytes)."""
    file: str
    line: int
    column: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True)
class Value:
    """One field of an interface."""
    name: str
    value: Union[int, float, str]
    """The value that the solver uses."""
    input: Union[int, float, str, None]
    """The value on the card, as text where it is no finite number; None for a blank cell, or if this input version has no
    such cell."""
    origin: str
    """"card", "default-block", "built-in" or "derived" (follows from other values or from the mesh)."""
    span: Optional[Place]
    """The columns on the card; None if nothing is written."""
    dimension: str
    """For example "mass length^-2"; empty for flags, ids and ratios."""
    doc: str
    """Description of the field, one line."""


@dataclass(frozen=True)
class Finding:
    """One finding of lint, with the keys of ``deck lint --format json``."""
    rule: str
    severity: str
    file: Optional[str]
    line: Optional[int]
    column: Optional[int]
    message: str
    help: str = ""
    end_column: Optional[int] = None
    entity: Optional[Dict[str, Any]] = None
    reference: Optional[Dict[str, Any]] = None
    fix: Optional[Dict[str, Any]] = None
    field: str = ""
    """Which field, of a rule that says the same of several (DK201)."""

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.severity} {self.rule}: {self.message}"


@dataclass(frozen=True)
class Nodes:
    """All nodes. ``ids`` is int64, ``x``, ``y``, ``z`` are float64 (working units), all without copying."""
    ids: _np.ndarray
    x: _np.ndarray
    y: _np.ndarray
    z: _np.ndarray
    _deck: Any = field(repr=False, default=None)

    def __len__(self) -> int:
        return len(self.ids)

    def index(self, node_id: Any) -> Any:
        """Position of a node id in the arrays, or an array of those of an array of ids; KeyError if one does not exist."""
        if not _np.isscalar(node_id):
            ids = _np.asarray(node_id)
            return _np.array([self.index(i) for i in ids.ravel()], dtype=_np.int64).reshape(ids.shape)
        at = self._deck.node_index(int(node_id))
        if at is None:
            raise KeyError(f"no node {node_id}")
        return at

    @property
    def coordinates(self) -> _np.ndarray:
        """A copy as one array of shape (n, 3)."""
        return _np.column_stack((self.x, self.y, self.z))


@dataclass(frozen=True)
class Elements:
    """One family of elements, without copying. ``nodes`` (n, k) are positions in the arrays of ``Deck.nodes``
    (4294967295: missing), ``part`` positions in ``Deck.parts``."""
    ids: _np.ndarray
    nodes: _np.ndarray
    part: _np.ndarray

    def __len__(self) -> int:
        return len(self.ids)


@dataclass(frozen=True)
class Part:
    id: int
    title: str
    prop_id: int
    mat_id: int
    thickness: float
    """Contact thickness, 0 if there is none; working units."""
    span: Optional[Place]


class Parts(List[Part]):
    """The parts in deck order. Called, what their elements add up to: ``d.parts()["total"]["mass"]``."""

    def __init__(self, deck: "Deck", rows: Iterable[Part]) -> None:
        super().__init__(rows)
        self._deck = deck

    def __call__(self, all: bool = False) -> Dict[str, Any]:
        """The document of ``deck parts --json``: elements, mass, centre, inertia and smallest element time step of every
        part, the interfaces that see it and its rigid body, kinematic conditions, and what was not computed.

        Masses, lengths and times are in the deck's working units; a step is None where there is none. ``all``: also the
        step of every element, and step, mass and stiffness of every node. DeckError where the include tree is not
        complete.
        """
        self._deck._complete()
        return _json.loads(_native.parts(self._deck._native, all))


class Tie:
    """An /INTER/TYPE2 as the solver ties it at start-up.

    ``nodes`` has one row per secondary node: ``node`` (id), ``tied``, ``segment`` (ids, n x 4; zeros: none was found),
    ``s`` and ``t`` (place on the segment, -1 to 1), ``distance`` and ``search`` (lengths, working units), ``message``
    (of the solver; 0: none), ``penalty``, ``why`` (a sentence). ``node_index`` are positions in the arrays of the nodes.
    """

    def __init__(self, native: Any) -> None:
        facts = native.facts()
        self._native = native
        self.id: int = facts["id"]
        self.title: str = _text(facts["title"])
        self.search_distance: Optional[float] = facts["search_distance"]
        """Within it nodes look for a segment, working units; None: every pair has its own."""
        self.not_evaluated: str = facts["not_evaluated"]
        """Why nothing was looked for; empty: it was."""
        self.summary: Dict[str, int] = facts["summary"]
        """How many ``nodes`` there are, are ``tied``, ``not_found``, ``dropped``, held ``elsewhere``, ``outside``."""

    @property
    def nodes(self) -> "Arrays":
        return Arrays(self._native.arrays(), {})

    def __repr__(self) -> str:
        nodes = self.summary["nodes"]
        return f"<Tie /INTER/TYPE2/{self.id} {self.title!r}: {self.summary['tied']} of {nodes} {'node' if nodes == 1 else 'nodes'} tied>"


class Interface:
    """A contact interface. Its fields are attributes: ``i.Gapmin.value``; names that are not Python names are
    items: ``i["%mesh_size"]``."""

    def __init__(self, deck: "Deck", at: int, row: Sequence[Any], nth: int) -> None:
        self.id: int = row[0]
        self.type: int = row[1]
        self.title: str = _text(row[2])
        self._deck, self._at, self._nth = deck, at, nth
        self._span: Optional[Place] = _place(row[3])
        self._fields: Dict[str, Value] = {}
        self._of: Any = deck._native

    def _read(self) -> None:
        native = self._deck._native
        if self._of is not native:  # lines and blocks may have come and gone
            same = [(k, r) for k, r in enumerate(native.interfaces()) if (r[0], r[1]) == (self.id, self.type)]
            if self._nth >= len(same):
                raise KeyError(f"/INTER/TYPE{self.type}/{self.id} was erased")
            self._at, row = same[self._nth]
            self._span, self._fields, self._of = _place(row[3]), {}, native
        if not self._fields:
            self._fields = {r[0]: Value(r[0], r[1], r[2], r[3], _place(r[4]), r[5], r[6])
                            for r in native.fields(self._at)}

    @property
    def span(self) -> Optional[Place]:
        """The header of the card."""
        self._read()
        return self._span

    @property
    def fields(self) -> Dict[str, Value]:
        """All fields by the manual's names, in the manual's order."""
        self._read()
        return self._fields

    def set(self, **values: Union[int, float, str]) -> None:
        """Sets fields: ``i.set(Gapmin=0.8, Igap=2)``, ``i.set(**{"%mesh_size": 0.3})``. Numbers are in the deck's working
        units; a text is put into the cell as it is, in the units of the card (``"&gap"``; ``""`` blanks it).

        The deck has the new values at once; the files change with ``Deck.save`` or ``Deck.write``. ValueError with the
        place and what was expected; then no value of the call is set.
        """
        if any(step[0] in ("insert", "erase") for step in self._deck._steps):  # places are not those of the files
            self._deck.set("/INTER", self.id, **values)
        else:
            self._deck._change([("set_interface", self._at, name, _cell(name, v)) for name, v in values.items()])

    def __getitem__(self, name: str) -> Value:
        return self.fields[name]

    def __getattr__(self, name: str) -> Value:
        if not name.startswith("_"):
            found = self.fields.get(name) or self.fields.get("%" + name)
            if found is not None:
                return found
        raise AttributeError(f"/INTER/TYPE{self.__dict__.get('type')} has no field {name}")

    def __dir__(self) -> List[str]:
        return sorted(set(super().__dir__()) | {n.lstrip("%") for n in self.fields})

    def __repr__(self) -> str:
        return f"<Interface /INTER/TYPE{self.type}/{self.id} {self.title!r}>"


class Interfaces(_Mapping):
    """Interfaces by id, in deck order. If several have one id, ``[id]`` is the first; ``list`` has all."""

    def __init__(self, deck: "Deck") -> None:
        rows = deck._native.interfaces()
        self.list: List[Interface] = []
        self._by_id: Dict[int, Interface] = {}
        times: Dict[Any, int] = {}
        for k, row in enumerate(rows):
            nth = times[row[0], row[1]] = times.get((row[0], row[1]), -1) + 1
            self.list.append(Interface(deck, k, row, nth))
            self._by_id.setdefault(row[0], self.list[-1])

    def __getitem__(self, interface_id: int) -> Interface:
        return self._by_id[interface_id]

    def __iter__(self) -> Iterator[int]:
        return iter(self._by_id)

    def __len__(self) -> int:
        return len(self._by_id)


class Arrays(_Mapping):
    """Named arrays of equal length. Not copied but ids, ``thickness`` and ``nodal_stiffness``: made at each access."""

    def __init__(self, arrays: Dict[str, Any], made: Dict[str, Any]) -> None:
        self._arrays, self._made = arrays, made

    def __getitem__(self, name: str) -> _np.ndarray:
        if name not in self._arrays:
            self._arrays[name] = _np.asarray(self._made[name]())
        value = self._arrays[name]
        if not isinstance(value, _np.ndarray):
            value = self._arrays[name] = _np.asarray(value)
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys([*self._made, *self._arrays]))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def __getattr__(self, name: str) -> _np.ndarray:
        if name.startswith("_") or name not in set(self):
            raise AttributeError(name)
        return self[name]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self]

    def frame(self) -> Any:
        """A pandas DataFrame; arrays with two axes become columns with numbers (``normal_0``)."""
        import pandas

        columns: Dict[str, Any] = {}
        for name in self:
            a = self[name]
            if a.ndim == 1:
                columns[name] = a
            else:
                columns.update({f"{name}_{k}": a[:, k] for k in range(a.shape[1])})
        return pandas.DataFrame(columns)


class Contact:
    """One elementary contact: nodes against segments, or edges against edges. A TYPE19 gives up to three.

    ``secondary``, ``main``, ``penetrations``, ``tied_pairs`` and, of ``Forces``, ``pairs`` are arrays by name. Names are those of the
    JSON (ids: ``node``, ``segment``, ``edge``, ``main_edge``); ``..._index`` are positions in the arrays of the nodes.
    """

    def __init__(self, deck: "Deck", native: Any, at: int) -> None:
        self._deck, self._native, self._at = deck, native, at
        self.__dict__.update(native.facts(at))

    def _ids(self, index: _np.ndarray) -> _np.ndarray:
        return self._deck.nodes.ids[index]

    def _side(self, arrays: Dict[str, Any], names: Dict[str, str]) -> Arrays:
        made = {name: (lambda n=index: self._ids(arrays[n])) for name, index in names.items() if index in arrays}
        return Arrays(arrays, made)

    @property
    def secondary(self) -> Arrays:
        """``node`` (or ``edge``), ``stiffness``, ``gap``, ``nodal_stiffness``."""
        return self._side(self._native.secondary(self._at), {"node": "node_index", "edge": "edge_index"})

    @property
    def main(self) -> Arrays:
        """``nodes`` (or ``edge``), ``stiffness``, ``gap``, ``thickness`` of every main segment (edge)."""
        return self._side(self._native.main(self._at), {"nodes": "segment_index", "edge": "edge_index"})

    def _named(self, arrays: Dict[str, Any]) -> Arrays:
        s, m = self._native.secondary(self._at), self._native.main(self._at)
        at, on = arrays["secondary"], arrays["main"]
        if self.kind == "edge_edge":
            made = {"edge": lambda: self._ids(s["edge_index"][at]), "main_edge": lambda: self._ids(m["edge_index"][on])}
        else:
            made = {"node": lambda: self._ids(s["node_index"][at]),
                    "segment": lambda: self._ids(m["segment_index"][on])}
        return Arrays(arrays, made)

    @property
    def penetrations(self) -> Arrays:
        """``node``, ``segment`` (or ``edge``, ``main_edge``), ``penetration``, ``gap``, ``distance``, ``normal``,
        ``on_surface``, ``in_contact``, ``action``, ``gap0``, ``p0``; ``secondary`` and ``main`` are positions in the lists
        of the sides. All are lengths, of edges as of nodes. Without ties."""
        return self._named(self._native.penetrations(self._at))

    @property
    def tied_pairs(self) -> Arrays:
        """What a TYPE10 ties, with the same names: the solver lists these pairs, but they are no penetrations."""
        return self._named(self._native.tied_pairs(self._at))

    @property
    def pairs(self) -> Arrays:
        """Of ``Deck.cycle()``: ``node``, ``segment``, ``force`` (on the main side), ``normal_force`` (negative pushes
        apart), ``weights``, ``penetration``, ``gap``, ``distance``, ``k0``, ``k_nodal``."""
        if not hasattr(self._native, "pairs"):
            raise AttributeError("pairs: forces are in Deck.cycle(), not in Deck.gaps()")
        return self._named(self._native.pairs(self._at))

    def __repr__(self) -> str:
        return f"<Contact of interface {self.interface}: {self.kind}, {self.role}>"


class _Results(_Mapping):
    """Results with the keys of the JSON of the command line, and arrays."""

    def __init__(self, deck: "Deck", native: Any, all: bool) -> None:
        self.deck, self._native, self._all = deck, native, all
        self._json: Optional[Dict[str, Any]] = None
        self.contacts: List[Contact] = [Contact(deck, native, k) for k in range(len(native))]

    @property
    def verdict(self) -> Dict[str, Any]:
        """What is said of the deck: ``level``, ``text``, ``sentences`` and ``counts``, as in every document."""
        return _json.loads(self._native.verdict())

    @property
    def json(self) -> Dict[str, Any]:
        """The document of the command line, as Python objects."""
        if self._json is None:
            self._json = _json.loads(self._native.json(self._all))
        return self._json

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self.json)

    def __len__(self) -> int:
        return len(self.json)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.deck.path}: {self.verdict['text']}>"


class Gaps(_Results):
    """Gaps, stiffnesses and initial penetrations: the keys of ``deck gaps --json``, and arrays in ``contacts``."""

    @property
    def coordinates(self) -> _np.ndarray:
        """Coordinates after Inacti 3 has moved nodes, (n, 3), a copy."""
        return _np.column_stack(self._native.coordinates())


class Forces(_Results):
    """Forces of the first cycle: the keys of ``deck cycle --json``, and arrays in ``contacts[k].pairs``."""

    @property
    def mass(self) -> _np.ndarray:
        """Lumped mass of every node, working units, without copying."""
        return self._native.mass()


class Edit:
    """A converted or repaired deck in memory. Nothing is on disk until ``write``."""

    def __init__(self, native: Any) -> None:
        self._native = native

    @property
    def deck(self) -> "Deck":
        """The deck with the changes."""
        return Deck(self._native.deck)

    @property
    def files(self) -> Dict[str, bytes]:
        """New contents by path, of files that change."""
        return self._native.files

    @property
    def notes(self) -> List[str]:
        return self._native.notes

    @property
    def losses(self) -> Dict[str, Any]:
        """The loss report: lists ``kept``, ``approximated``, ``dropped``, ``undecided``."""
        return _json.loads(self._native.losses_json())

    @property
    def report(self) -> Optional[Dict[str, Any]]:
        """Of ``fix``: the document of ``deck fix --json``; None for conversions."""
        return _json.loads(self._native.report_json) if self._native.report_json else None

    def diff(self) -> bytes:
        """A patch for ``git apply``."""
        return self._native.diff()

    def write(self, directory: Any, overwrite: bool = False) -> List[str]:
        """Writes the whole include tree below a directory, all files or none, and returns their paths.

        FileExistsError where a file is there and ``overwrite`` is False; files of the deck itself are never replaced.
        """
        return self._native.write(str(directory), overwrite)


class Deck:
    """A deck with everything it includes. ``load`` makes one."""

    def __init__(self, native: Any) -> None:
        self._original = self._now = native
        self._changes: Any = None
        self._steps: List[Any] = []
        self._interfaces: Optional[Interfaces] = None
        self._nodes: Optional[Nodes] = None

    @property
    def _native(self) -> Any:
        """The deck with all that was set, read again where that was not done yet."""
        if self._now is None:
            self._now = self._changes.deck()
        return self._now

    def _change(self, steps: List[Any]) -> None:
        """Takes all steps or none."""
        changes = self._changes or _native.change(self._original)
        try:
            for method, *values in steps:
                getattr(changes, method)(*values)
        except Exception:
            self._changes = _native.change(self._original) if self._steps else None
            for method, *values in self._steps:
                getattr(self._changes, method)(*values)
            raise
        self._changes, self._steps = changes, self._steps + steps
        self._now = self._nodes = None
        if any(step[0] in ("insert", "erase") for step in steps):
            self._interfaces = None

    def set(self, keyword: str, id: int, occurrence: int = 0, **values: Union[int, float, str]) -> None:
        """Sets fields of any block: ``d.set("/PROP/SHELL", 2, Thick=1.5)``. ``occurrence``: which cell of that name, from
        0, where a line repeats. KeyError if there is no such block; else as ``Interface.set``."""
        self._change([("set_block", keyword, int(id), name, _cell(name, v), int(occurrence))
                      for name, v in values.items()])

    def move_node(self, node_id: int, x: float, y: float, z: float) -> None:
        """Puts a node elsewhere, in working units. ValueError where its line does not say where it is (/TRANSFORM)."""
        self.nodes.index(node_id)
        self._change([("move_node", int(node_id), _cell("x", float(x)), _cell("y", float(y)), _cell("z", float(z)))])

    def insert(self, blocks: Union[str, bytes]) -> None:
        """Adds blocks at the end of the main file: ``d.insert("/INTER/TYPE7/9\\nnew contact\\n")``, then
        ``d.interfaces[9].set(Gapmin=0.8)``. A block may end before all of its lines: setting a field adds its line.
        ValueError where the text does not begin with a keyword."""
        self._change([("insert", blocks)])

    def erase(self, keyword: str, id: int) -> None:
        """Removes a block with its lines: ``d.erase("/INTER/TYPE7", 9)``; comments after its last line stay. KeyError if there
        is no such block; ValueError where some of its lines are in an included file."""
        self._change([("erase", keyword, int(id))])

    @property
    def notes(self) -> List[str]:
        """Values that were set and lost digits in their cells."""
        return self._changes.notes() if self._changes else []

    def diff(self) -> bytes:
        """What was set, as a patch that ``git apply`` takes."""
        return (self._changes or _native.change(self._original)).diff()

    def write(self, directory: Any, overwrite: bool = False) -> List[str]:
        """Writes the whole include tree with what was set below a directory, all files or none; returns their paths.

        FileExistsError where a file is there and ``overwrite`` is False; files of the deck itself are never replaced.
        """
        return (self._changes or _native.change(self._original)).write(str(directory), overwrite)

    def save(self, backup_suffix: str = "") -> List[str]:
        """Replaces the files that change, all of them or none; returns their paths. DeckError where a file is not what was
        read any more, or another deck of its folder includes it. ``backup_suffix``: keeps the old files (".orig").

        To set more afterwards, load the deck again.
        """
        return (self._changes or _native.change(self._original)).save(backup_suffix)

    @property
    def path(self) -> str:
        return self._native.path

    @property
    def version(self) -> int:
        """Input version."""
        return self._native.version

    @property
    def files(self) -> List[str]:
        """The main file and all includes, as they were opened."""
        return self._native.files

    @property
    def nodes(self) -> Nodes:
        if self._nodes is None:
            self._nodes = Nodes(*self._native.nodes(), self._native)
        return self._nodes

    def elements(self, family: str) -> Elements:
        """``"shell"``, ``"sh3n"``, ``"solid"``, ``"quad"``, ``"tria"``, ``"truss"``, ``"beam"`` or ``"spring"``."""
        return Elements(**self._native.family(family))

    @property
    def parts(self) -> Parts:
        """In deck order; called, with masses and time steps: ``d.parts()``."""
        return Parts(self, (Part(p["id"], _text(p["title"]), p["prop_id"], p["mat_id"], p["thickness"], _place(p["span"]))
                            for p in self._native.parts()))

    @property
    def interfaces(self) -> Interfaces:
        if self._interfaces is None:
            self._interfaces = Interfaces(self)
        return self._interfaces

    @property
    def findings(self) -> List[Finding]:
        """Findings of reading the deck; ``lint`` has many more."""
        return [Finding(**f) for f in self._native.findings()]

    def _complete(self) -> None:
        if self._native.incomplete:
            raise DeckError(f"{self.path}: the include tree is not complete; no verdict about an incomplete model",
                            [f for f in self._native.findings() if f["severity"] == "error"])

    def params(self) -> Dict[str, Any]:
        """The document of ``deck params --json``."""
        return _json.loads(self._native.params_json())

    def lint(self, geometry: Optional[bool] = None, select: Iterable[str] = (), ignore: Iterable[str] = ()) -> List[Finding]:
        """All findings, sorted by file, line, column and rule; ``geometry=False`` without those of rules DK3 and DK4.
        By default interfaces with very many pairs are left out, as ``deck lint`` does; ``geometry=True`` looks at all.

        No configuration file is read."""
        document = _json.loads(self._native.lint_json(geometry, list(select), list(ignore)))
        known = Finding.__dataclass_fields__
        return [Finding(**{k: v for k, v in f.items() if k in known}) for f in document["diagnostics"]]

    def gaps(self, interfaces: Iterable[int] = (), accuracy: str = "robust", all: bool = False) -> Gaps:
        """Gaps and initial penetrations, of some interfaces or (empty) of all.

        ``all``: the JSON has every secondary node and main segment; the arrays always have. KeyError for an id that
        the deck does not have, DeckError where the include tree is not complete.
        """
        self._complete()
        return Gaps(self, _native.gaps(self._native, [int(i) for i in interfaces], accuracy, []), all)

    def ties(self) -> List[Tie]:
        """Which node of every /INTER/TYPE2 the solver ties to which segment, which it does not tie, and why.

        DeckError where the include tree is not complete."""
        self._complete()
        return [Tie(native) for native in _native.ties(self._native)]

    def show(self, what: str) -> Dict[str, Any]:
        """The document of ``deck show --json`` for ``"3"`` (an interface), ``"/PROP/SHELL/2"``, ``"part:4"`` or
        ``"node:57"``: its card by field, effective values in working units, what it refers to and what uses it. KeyError
        where the deck has no such thing."""
        return _json.loads(_native.show(self._native, str(what)))

    def compare(self, other: "Deck", match: str = "id", tolerance: float = 1e-12) -> Dict[str, Any]:
        """What ``other``, the newer deck, means differently: the document of ``deck diff --json``, with ``equal`` and
        ``changes``.

        ``match``: counterparts by ``"id"``, ``"title"`` or ``"position"``. ``tolerance``: share of a number (of lengths:
        of the model's size) within which two are equal. DeckError where an include tree is not complete.
        """
        self._complete()
        other._complete()
        return _json.loads(_native.diff(self._native, other._native, match, float(tolerance)))

    def gate(self, *, compare: Union["Deck", Gaps, Dict[str, Any], None] = None, max_depth: Optional[float] = None,
             max_ratio: Optional[float] = None, max_count: Optional[int] = None, max_untied: Optional[int] = None,
             max_dt_loss: Optional[float] = None) -> Dict[str, Any]:
        """Holds the contacts against bounds, and against an earlier deck or its ``gaps()``: the members ``gate``
        (``passed``, ``findings``) and ``compared`` (``new``, ``worse``, ``better``, ``same``, ``solved``, ``rows``) of
        ``deck gaps --json``; None where neither was asked for.

        ``max_depth``: a length, working units; ``max_ratio`` of the gap and ``max_dt_loss`` of the time step: shares, 0
        to 1; ``max_count``: penetrating nodes and edges; ``max_untied``: nodes of /INTER/TYPE2. With ``compare`` new and
        worse penetrations do not pass. No configuration file is read. DeckError where the include tree is not complete.
        """
        self._complete()
        if isinstance(compare, Deck):
            compare = compare.gaps()
        earlier = None if compare is None else _json.dumps(compare.json if isinstance(compare, Gaps) else compare)
        return _json.loads(_native.gate(self._native, max_depth, max_ratio, max_dt_loss, max_count, max_untied, earlier))

    def explain(self, listing: Any) -> Dict[str, Any]:
        """A listing of the Starter (``car_0000.out``, also ``.gz``) beside this deck: the document of
        ``deck explain --json``, with ``messages`` (number, count, meaning, place, findings of lint), ``contacts``
        (penetrations pair by pair, lengths in working units), ``steps`` and ``agrees``. DeckError where it is no listing
        or the include tree is not complete."""
        self._complete()
        import os

        return _json.loads(_native.explain_beside(self._native, os.fspath(listing)))

    def what_if(self, interface: int, all: bool = False, **values: Union[int, float]) -> Gaps:
        """``gaps`` with other values for one interface, without changing the deck: ``d.what_if(3, Gapmin=1.5)``.

        Fields: Gapmin Fscalegap (Gap_scale) Gapmax Fpenmax mesh_size Igap Inacti Irem_gap. ValueError for what the field cannot
        hold.
        """
        self._complete()
        if not values:
            raise TypeError("what_if needs a field, for example Gapmin=1.5")
        change = ",".join(f"{'%mesh_size' if k == 'mesh_size' else k}={v!r}" for k, v in values.items())
        return Gaps(self, _native.gaps(self._native, [], "robust", [f"{int(interface)}:{change}"]), all)

    def cycle(self, interfaces: Iterable[int] = (), dt: float = 0.0, time: float = 0.0, model: str = "robust",
              velocities: Optional[Dict[int, Sequence[float]]] = None, accuracy: str = "robust",
              all: bool = False) -> Forces:
        """Contact forces of the first cycle. ``velocities``: part id to velocity (3 numbers, working units)."""
        self._complete()
        native = _native.cycle(self._native, [int(i) for i in interfaces], accuracy, model, float(dt), float(time),
                               dict(velocities or {}))
        return Forces(self, native, all)

    def convert(self, *, extract: Iterable[int] = (), flatten: bool = False, expand_type19: bool = False,
                resolve_defaults: bool = False, version: int = 0, allow_loss: bool = False, units: str = "",
                keep_working_units: bool = False, renumber: Union[str, Iterable[str]] = (), partial: bool = False,
                verify: bool = True) -> Edit:
        """The conversions of ``deck convert`` in its order. DeckError with the places where one is refused.

        ``verify``: effective values, gaps, forces, masses and time steps of the result are compared with the
        original's.
        """
        if not hasattr(version, "__index__"):
            raise TypeError(f"version is a whole number such as 2018, not {version!r}")
        rules = [renumber] if isinstance(renumber, str) else list(renumber)
        return Edit(_native.convert(self._native, [int(i) for i in extract], flatten, expand_type19, resolve_defaults,
                                    version, allow_loss, units, keep_working_units, [r for r in rules if r], partial,
                                    verify))

    def fix(self, strategy: str, interfaces: Iterable[int] = (), min_gap: float = 0.5, inacti: int = 6,
            fpenmax: Optional[float] = None, max_moved: float = 0.1, max_displacement: Optional[float] = None,
            lock: Iterable[int] = (), ties: bool = False) -> Edit:
        """Repairs initial penetrations: ``"reduce-gap"``, ``"inacti"``, ``"fpenmax"``, ``"move-nodes"`` or ``"move-part"``
        (one whole part, the way that frees the most).

        ``min_gap`` and ``max_moved``: shares, 0 to 1, of the gap and of the nodes of a part; ``max_displacement``: a
        length, working units; ``lock``: ids of parts that stay. ValueError for what a strategy does not take.

        Ties (TYPE10) are left alone unless ``ties`` is set.
        """
        return Edit(_native.fix(self._native, strategy, [int(i) for i in interfaces], min_gap, inacti, fpenmax,
                                max_moved, max_displacement, [int(i) for i in lock], ties))

    def __repr__(self) -> str:
        return f"<Deck {self.path}: {len(self.nodes)} nodes, {len(self.interfaces.list)} interfaces>"


def load(path: Any, *, threads: int = 0, include_paths: Iterable[str] = (), max_memory: int = 0) -> Deck:
    """Reads a deck with everything it includes, its model and the effective values of its interfaces.

    ``threads``: 0 takes all processors; results do not depend on it. ``max_memory``: bytes for the pairs of one contact
    and for the members of all groups, 0 the default (2 and 4 GB). DeckError if the main file cannot be read or is no
    Starter deck; everything else that is wrong with the deck is in ``findings``.
    """
    import os

    count = threads or len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else threads or os.cpu_count() or 1
    return Deck(_native.load(os.fspath(path), count, [os.fspath(p) for p in include_paths], max_memory))


def explain(topic: Union[str, int]) -> str:
    """The page of ``deck explain``: of a rule (``"DK254"``) or a family of them (``"DK2"``), a keyword (``"TYPE7"``), a
    field (``"TYPE7.Gapmin"``) or a message of the solver (``611``, ``"ERROR 611"``, ``"initial penetrations"``).

    KeyError, with what was perhaps meant, where nothing is known.
    """
    return _native.explain(str(topic))


def explain_listing(path: Any) -> Dict[str, Any]:
    """The messages of a listing of the Starter, without its deck: ``messages`` of the document of ``deck explain --json``.
    ``Deck.explain`` reads it beside its deck. DeckError where it is no listing."""
    import os

    return _json.loads(_native.explain_listing(os.fspath(path)))


def _cell(name: str, value: Any) -> Union[int, float, str]:
    """A value that a cell can be set to."""
    if isinstance(value, str):
        return value
    if isinstance(value, (int, _np.integer)):
        return int(value)
    number = float(value)
    if not _np.isfinite(number):
        raise ValueError(f"{name}: infinity and not-a-number are no input")
    return number


def _place(value: Optional[Dict[str, Any]]) -> Optional[Place]:
    return None if value is None else Place(**value)


def _text(raw: bytes) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("latin-1")
