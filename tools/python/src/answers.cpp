// libdeck._native: documents of the verbs that answer questions (parts, show, diff, gate, explain),
// and the ties of a deck as arrays.
#include <memory>
#include <mutex>
#include <utility>

#include "contact/shared/reported.hpp"
#include "deck/contacts.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "inspect/shared/diff.hpp"
#include "inspect/shared/listing.hpp"
#include "inspect/shared/show.hpp"
#include "lint/shared/gate.hpp"
#include "lint/shared/topics.hpp"
#include "native.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/params_report.hpp"
#include "report/shared/parts.hpp"

namespace deck::python {
namespace {

/// A tie by itself: what the deck holds of it may be made anew.
struct PyTie {
  DeckPointer deck;
  Tie tie;
};
using TiePointer = std::shared_ptr<PyTie>;

std::vector<TiePointer> ties_of(const DeckPointer& deck) {
  return alone_with(*deck, [&] {
    std::vector<TiePointer> out;
    for (const Tie& tie : deck->loaded.ties()) out.push_back(std::make_shared<PyTie>(deck, tie));
    return out;
  });
}

py::dict facts_of(const PyTie& t) {
  const TieCounts count = count_ties(t.tie);
  py::dict summary;
  summary["nodes"] = count.nodes;
  summary["tied"] = count.tied;
  summary["not_found"] = count.not_found;
  summary["dropped"] = count.dropped;
  summary["elsewhere"] = count.elsewhere;
  summary["outside"] = count.outside;
  py::dict out;
  out["id"] = t.tie.inter->id;
  out["title"] = py::bytes(t.tie.inter->title);
  out["search_distance"] =
      t.tie.search_distance != 0 ? py::cast(t.tie.search_distance) : py::object(py::none());
  out["not_evaluated"] = t.tie.not_evaluated;
  out["summary"] = summary;
  return out;
}

/// Arrays by name; ids and texts are made, the rest lies in the library.
py::dict arrays_of(const TiePointer& t) {
  const std::vector<TiedNode>& nodes = t->tie.nodes;
  const Model& model = t->deck->loaded.model();
  const py::object owner = py::cast(t);
  std::vector<std::int64_t> ids;
  py::array_t<std::int64_t> segment({static_cast<py::ssize_t>(nodes.size()), py::ssize_t{4}});
  auto corner = segment.mutable_unchecked<2>();
  py::list why;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TiedNode& n = nodes[i];
    ids.push_back(model.node_id(n.node));
    why.append(why_text(t->tie, n));
    for (std::size_t k = 0; k < 4; ++k)
      corner(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) =
          n.segment == no_index ? 0 : model.node_id(t->tie.main[n.segment][k]);
  }
  py::dict out;
  out["node"] = py::array_t<std::int64_t>(static_cast<py::ssize_t>(ids.size()), ids.data());
  out["segment"] = segment;
  out["node_index"] = member_view(nodes, &TiedNode::node, owner);
  out["tied"] = member_view(nodes, &TiedNode::tied, owner);
  out["penalty"] = member_view(nodes, &TiedNode::penalty, owner);
  out["s"] = member_view(nodes, &TiedNode::s, owner);
  out["t"] = member_view(nodes, &TiedNode::t, owner);
  out["distance"] = member_view(nodes, &TiedNode::distance, owner);
  out["search"] = member_view(nodes, &TiedNode::search, owner);
  out["message"] = member_view(nodes, &TiedNode::message, owner);
  out["why"] = why;
  return out;
}

std::string parts_text_of(PyDeck& d, bool all) {
  return alone_with(d, [&] { return parts_json(d.loaded, all); });
}

std::string show_text_of(PyDeck& d, const std::string& what) {
  auto text = alone_with(d, [&]() -> Result<std::string> {
    const LoadedDeck& loaded = d.loaded;
    const auto entity = find_entity(loaded.deck(), loaded.model(), what);
    if (!entity) return entity.error();
    const EntityView view =
        view_entity(loaded.deck(), loaded.model(), loaded.interfaces(), *entity);
    ParamsInput params{loaded};
    if (view.inter != nullptr) params.scene = &loaded.mesh_values();
    return show_json(params, view);
  });
  if (!text) throw py::key_error(d.path + ": " + text.error().message);
  return *text;
}

/// A side of a comparison.
struct Side {
  explicit Side(const LoadedDeck& of) : loaded(of), view(make_view(of.scene())) {
    loaded.mesh_values();
    VerdictInput in;
    loaded.findings();
    in.deck = &loaded.deck();
    in.interfaces = &loaded.interfaces();
    in.contacts = contact_facts(loaded.scene(), view);
    verdict = make_verdict(in);
  }
  DiffSide described() const { return {loaded, &view, &verdict}; }

  const LoadedDeck& loaded;
  SceneView view;
  Verdict verdict;
};

std::string diff_text_of(PyDeck& a, PyDeck& b, const std::string& match, double tolerance) {
  if (match != "id" && match != "title" && match != "position")
    throw py::value_error("match is 'id', 'title' or 'position', not '" + match + "'");
  const py::gil_scoped_release free;
  std::unique_lock first(a.mutex, std::defer_lock), second(b.mutex, std::defer_lock);
  if (&a == &b)
    first.lock();
  else
    std::lock(first, second);
  const Side old(a.loaded), now(b.loaded);
  const DiffSide sa = old.described(), sb = now.described();
  return diff_json(sa, sb,
                   diff_decks(sa, sb,
                              match == "title"      ? MatchBy::title
                              : match == "position" ? MatchBy::position
                                                    : MatchBy::id,
                              tolerance));
}

/// The members "gate" and "compared" of `deck gaps --json`.
std::string gate_text_of(PyDeck& d, std::optional<double> depth, std::optional<double> ratio,
                         std::optional<double> dt_loss, std::optional<std::uint64_t> count,
                         std::optional<std::uint64_t> untied,
                         const std::optional<std::string>& earlier_text) {
  Gate gate;
  gate.general = {depth, ratio, dt_loss, count, untied};
  std::optional<GapBaseline> earlier;
  if (earlier_text) {
    auto read = read_earlier_gaps("compare", *earlier_text, d.path);
    if (!read) throw py::value_error(read.error().message);
    earlier = std::move(*read);
    gate.on_fresh = gate.on_worse = true;
  }
  const py::gil_scoped_release free;
  const std::lock_guard one(d.mutex);
  const Scene& scene = d.loaded.scene();
  const SceneView view = make_view(scene);
  const cycle::SceneOutcome* const forces =
      gate.needs_forces() ? &d.loaded.cycle().outcome : nullptr;
  const GateReport report = gate_report(gate, scene, view, forces, earlier ? &*earlier : nullptr);
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_gate(json, d.loaded.deck(), scene, view, report);
  json.end_object();
  return out;
}

Listing listing_at(const std::string& path) {
  auto listing = [&] {
    const py::gil_scoped_release free;
    return read_listing(path, {});
  }();
  if (!listing) raise_error(listing.error().message);
  return std::move(*listing);
}

std::string explain_beside(PyDeck& d, const std::string& path) {
  const Listing listing = listing_at(path);
  const py::gil_scoped_release free;
  const std::lock_guard one(d.mutex);
  const SceneOptions kept = d.loaded.scene_options();
  std::string out = listing_json(listing, compare_listing(listing, d.loaded), &d.loaded);
  d.loaded.set_scene_options(kept);
  return out;
}

std::string explain_alone(const std::string& path) {
  const Listing listing = listing_at(path);
  return listing_json(listing, explain_listing(listing), nullptr);
}

std::string page_of(const std::string& topic) {
  const SchemaSet& schemas = SchemaSet::built_in();
  std::string page = explain_topic(topic, schemas);
  if (!page.empty()) return page;
  std::string near;
  for (const std::string& name : similar_topics(topic, schemas))
    near += (near.empty() ? "; did you mean " : ", ") + name;
  throw py::key_error("nothing is known about '" + topic + "'" + near);
}

}  // namespace

void bind_answers(py::module_& m) {
  py::class_<PyTie, TiePointer>(m, "Tie").def("facts", &facts_of).def("arrays", &arrays_of);
  m.def("ties", &ties_of);
  m.def("parts", &parts_text_of);
  m.def("show", &show_text_of);
  m.def("diff", &diff_text_of);
  m.def("gate", &gate_text_of);
  m.def("explain", &page_of);
  m.def("explain_listing", &explain_alone);
  m.def("explain_beside", &explain_beside);
}

}  // namespace deck::python
