// libdeck._native: a deck, its arrays and the effective values of its interfaces.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "deck/lint.hpp"
#include "deck/rule_id.hpp"
#include "deck/text.hpp"
#include "keyword/shared/recognise.hpp"
#include "lint/shared/geometry.hpp"
#include "native.hpp"
#include "report/shared/findings.hpp"
#include "report/shared/params_report.hpp"
#include "text/shared/columns.hpp"

namespace deck::python {

py::object python_place(const Deck& deck, const Span& span) {
  if (!span.valid()) return py::none();
  const Source& source = deck.sources[span.file];
  const Position from = source.position(span.offset);
  const Position to = source.position(span.offset + span.length);
  py::dict out;
  out["file"] = source.path();
  out["line"] = from.line;
  out["column"] = from.column;
  out["end_column"] = to.line == from.line ? to.column : from.column;
  return out;
}

py::dict make_finding(const Deck& deck, const Finding& d) {
  py::dict out;
  out["rule"] = std::string(id_text(d.rule));
  out["field"] = d.field;
  out["severity"] = to_string(d.severity);
  const py::object place = python_place(deck, d.span);
  for (const char* key : {"file", "line", "column", "end_column"})
    out[key] = place.is_none() ? py::object(py::none()) : py::object(place[key]);
  out["message"] = d.message;
  out["help"] = d.help;
  return out;
}

void raise_error(const std::string& message, const Deck* deck,
                 const std::vector<Finding>* findings) {
  py::list list;
  if (deck != nullptr && findings != nullptr)
    for (const Finding& d : *findings)
      if (d.severity == Severity::error) list.append(make_finding(*deck, d));
  const py::object error = py::module_::import("libdeck._errors").attr("DeckError");
  PyErr_SetObject(error.ptr(), error(message, list).ptr());
  throw py::error_already_set();
}

namespace {

/// "mass length^-2", empty for numbers.
std::string dimension_of(const Field* field) {
  if (field == nullptr || !field->dimension_known || field->dimension.dimensionless()) return "";
  const auto part = [](const char* name, int power) {
    return power == 0   ? std::string()
           : power == 1 ? fmt::format(" {}", name)
                        : fmt::format(" {}^{}", name, power);
  };
  const Dimension& d = field->dimension;
  std::string text = part("mass", d.mass) + part("length", d.length) + part("time", d.time) +
                     part("temperature", d.temperature);
  return text.empty() ? text : text.substr(1);
}

/// What the card says; a cell without a finite number as it is written.
template <class T>
py::object input_of(const Deck& deck, const Effective<T>& e) {
  if (!e.has_input) return py::none();
  if constexpr (std::is_same_v<T, double>)
    if (!std::isfinite(e.input))
      return py::str(std::string(detail::trim(deck.sources.text(e.span))));
  return py::cast(e.input);
}

/// Every field of an interface: (name, value, input or None, origin, place, dimension, meaning).
py::list interface_fields(const PyDeck& d, std::size_t at) {
  const Deck& deck = d.loaded.deck();
  const InterBase& inter = *d.loaded.interfaces().all.at(at);
  const Schema* const schema = inter.block != nullptr ? inter.block->schema : nullptr;
  py::list out;
  visit_any_interface(inter, [&](const auto& typed) {
    typed.for_each([&](std::string_view name, const auto& e) {
      const Field* const field = schema != nullptr ? schema->find_field(name) : nullptr;
      out.append(py::make_tuple(std::string(name), e.value, input_of(deck, e), to_string(e.origin),
                                python_place(deck, e.span), dimension_of(field),
                                field != nullptr ? field->doc : std::string()));
    });
  });
  return out;
}

DeckPointer load_deck(const std::string& path, int threads,
                      const std::vector<std::string>& include_paths, std::uint64_t max_memory) {
  LoadOptions options;
  options.threads = threads;
  options.read.include_paths = include_paths;
  if (max_memory != 0)
    options.read.limits.pair_bytes = options.read.limits.selection_bytes = max_memory;
  auto loaded = [&] {
    const py::gil_scoped_release free;
    return load(path, options);
  }();
  if (!loaded) raise_error(loaded.error().message);
  if (const std::string other = no_starter_deck(loaded->deck()); !other.empty())
    raise_error(path + ": " + other, &loaded->deck(), &loaded->deck().findings.all());
  if (const std::string old = unread_version(loaded->deck()); !old.empty())
    raise_error(old, &loaded->deck(), &loaded->deck().findings.all());
  const py::gil_scoped_release free;
  return std::make_shared<PyDeck>(path, std::move(*loaded));
}

/// `geometry`: nothing, a quick look (as `deck lint` without an option) or all.
std::string lint_text(PyDeck& d, std::optional<bool> geometry,
                      const std::vector<std::string>& select,
                      const std::vector<std::string>& ignore) {
  const py::gil_scoped_release free;
  const std::lock_guard one(d.mutex);
  const LoadedDeck& l = d.loaded;
  std::vector<ExtraCheck> extra;
  if (geometry.value_or(true))
    extra.push_back([&](const LintContext& context, Reporter& reporter) {
      return check_geometry(context, reporter,
                            {geometry ? std::nullopt : std::optional(QuickLook{})});
    });
  LintOptions options;
  options.select = select;
  options.ignore = ignore;
  const LintResult result = run_lint(l, options, extra);
  return lint_json({{d.path, &l.deck(), &result, "", &l.interfaces()}});
}

/// The arrays of one family of elements, by name.
py::dict element_arrays(const DeckPointer& d, const std::string& name) {
  const Model& m = d->loaded.model();
  const std::pair<const char*, const Elements*> all[] = {
      {"shell", &m.shell4}, {"sh3n", &m.shell3}, {"solid", &m.solid8}, {"quad", &m.quad},
      {"tria", &m.tria},    {"truss", &m.truss}, {"beam", &m.beam},    {"spring", &m.spring}};
  for (const auto& [known, family] : all) {
    if (name != known) continue;
    const py::object owner = py::cast(d);
    py::dict out;
    out["ids"] = view_of(family->id, owner);
    const auto width = static_cast<py::ssize_t>(family->width);
    out["nodes"] =
        view_of(family->nodes.data(), {static_cast<py::ssize_t>(family->size()), width},
                {width * static_cast<py::ssize_t>(sizeof(NodeIndex)), sizeof(NodeIndex)}, owner);
    out["part"] = view_of(family->part, owner);
    return out;
  }
  throw py::key_error(name);
}

py::list parts_of(const PyDeck& d) {
  py::list out;
  for (const Part& p : d.loaded.model().parts) {
    py::dict part;
    part["id"] = p.id;
    part["title"] = py::bytes(p.title);
    part["prop_id"] = p.prop_id;
    part["mat_id"] = p.mat_id;
    part["thickness"] = p.thickness;
    part["span"] = python_place(d.loaded.deck(), p.span);
    out.append(part);
  }
  return out;
}

}  // namespace
}  // namespace deck::python

PYBIND11_MODULE(_native, m) {
  using namespace deck;
  using namespace deck::python;
  m.doc() = "Native part of libdeck; use the module libdeck.";
  m.attr("version") = std::string(library_version());
  py::class_<PyDeck, DeckPointer>(m, "Deck")
      .def_readonly("path", &PyDeck::path)
      .def_property_readonly("version", [](const PyDeck& d) { return d.loaded.deck().version; })
      .def_property_readonly("files",
                             [](const PyDeck& d) {
                               std::vector<std::string> out;
                               for (std::uint32_t i = 0; i < d.files; ++i)
                                 out.emplace_back(d.loaded.deck().sources[i].path());
                               return out;
                             })
      .def_property_readonly("incomplete", [](const PyDeck& d) { return d.loaded.incomplete(); })
      .def("nodes",
           [](const DeckPointer& d) {
             const Nodes& n = d->loaded.model().nodes;
             const py::object owner = py::cast(d);
             return py::make_tuple(view_of(n.id, owner), view_of(n.x, owner), view_of(n.y, owner),
                                   view_of(n.z, owner));
           })
      .def("node_index",
           [](const PyDeck& d, std::int64_t id) -> std::optional<std::uint32_t> {
             const NodeIndex n = d.loaded.model().find_node(id);
             if (n == no_index) return std::nullopt;
             return n;
           })
      .def("family", &element_arrays)
      .def("parts", &parts_of)
      .def("interfaces",
           [](const PyDeck& d) {
             py::list out;
             for (const InterBase* i : d.loaded.interfaces().all)
               out.append(py::make_tuple(i->id, i->type, py::bytes(i->title),
                                         python_place(d.loaded.deck(), i->span)));
             return out;
           })
      .def("fields", &interface_fields)
      .def("findings",
           [](PyDeck& d) {
             const Findings found = alone_with(d, [&] { return d.loaded.findings(Stage::cells); });
             py::list out;
             for (const Finding& f : found.all()) out.append(make_finding(d.loaded.deck(), f));
             return out;
           })
      .def("lint_json", &lint_text)
      .def("params_json", [](PyDeck& d) {
        return alone_with(d, [&] { return params_json({d.loaded, &d.loaded.mesh_values()}); });
      });
  m.def("load", &load_deck);
  bind_results(m);
  bind_edits(m);
  bind_changes(m);
  bind_answers(m);
  // An object that Python makes by itself would lead nowhere.
  const py::cpp_function none([](const py::args&, const py::kwargs&) {
    throw py::type_error("only libdeck makes these objects");
  });
  for (const char* name : {"Deck", "Scene", "Cycle", "Edit", "Changes", "Tie"})
    m.attr(name).attr("__new__") = none;
}
