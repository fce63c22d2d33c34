// libdeck._native: gaps and first-cycle forces, as JSON text and as arrays over the scene.
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/shared/reported.hpp"
#include "contact/shared/scene_steps.hpp"
#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/lint.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "native.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"

namespace deck::python {
namespace {

/// Contacts of a deck; the arrays over it keep it, and it keeps the deck.
struct PyScene {
  DeckPointer deck;
  Scene scene;
  SceneView view;
  std::vector<Crossing> crossings;
  Findings joined;  ///< of reading and of all that was found on the way to the contacts
};
using ScenePointer = std::shared_ptr<PyScene>;

/// Verdicts look for what stops the solver in the findings of the deck: while this lives, those of
/// the way to its contacts are among them. Under the deck's mutex.
class Joined {
 public:
  explicit Joined(const PyScene& s) : own_(s.deck->loaded.deck().findings), kept_(own_) {
    own_ = s.joined;
  }
  ~Joined() { own_ = std::move(kept_); }
  Joined(const Joined&) = delete;
  Joined& operator=(const Joined&) = delete;

 private:
  Findings& own_;
  Findings kept_;
};

/// One force evaluation.
struct PyCycle {
  ScenePointer contacts;
  cycle::State state;
  cycle::CycleOptions options;
  cycle::SceneOutcome outcome;
};
using CyclePointer = std::shared_ptr<PyCycle>;

Accuracy accuracy_of(const std::string& name) {
  for (const Accuracy a : {Accuracy::fast, Accuracy::reference, Accuracy::robust, Accuracy::exact})
    if (name == to_string(a)) return a;
  throw py::value_error("accuracy is 'fast', 'reference', 'robust' or 'exact', not '" + name + "'");
}

ScenePointer contacts_of(const DeckPointer& deck, const std::vector<std::int64_t>& only,
                         const std::string& accuracy, const std::vector<std::string>& what_if,
                         bool forces) {
  const LoadedDeck& loaded = deck->loaded;
  SceneOptions options = loaded.scene_options();
  options.only = only;
  options.accuracy = accuracy_of(accuracy);
  options.candidates = !forces;
  options.ties = true;
  const auto known = [&](std::int64_t id) -> const InterBase* {
    for (const InterBase* i : loaded.interfaces().ordered)
      if (i->id == id) return i;
    throw py::key_error(deck->path + " has no interface " + std::to_string(id) + " of " +
                        examined_types(Examined::contacts));
  };
  for (const std::int64_t id : only) known(id);
  for (const std::string& text : what_if) {
    const auto change = parse_what_if(text);
    if (!change) throw py::value_error(change.error().message);
    if (const auto fits = check_what_if(*change, *known(change->interface_id)); !fits)
      throw py::value_error(fits.error().message);
    options.what_if.push_back(*change);
  }
  auto out = std::make_shared<PyScene>();
  out->deck = deck;
  const py::gil_scoped_release free;
  const std::lock_guard one(deck->mutex);
  if (!std::exchange(deck->errors_known, true)) report_solver_errors(deck->loaded);
  Findings findings;
  out->scene = loaded.scene_with(options, findings);
  out->crossings = find_crossings(out->scene, options.threads);
  out->view = make_view(out->scene, &out->crossings);
  out->joined = loaded.findings_with(findings);
  return out;
}

std::array<double, 3> velocity_of(const py::handle& value) {
  try {
    const auto v = value.cast<std::array<double, 3>>();
    if (std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); })) return v;
  } catch (const py::cast_error&) {  // the message of which says nothing about velocities
  }
  throw py::value_error("a velocity is three finite numbers, not " +
                        py::repr(value).cast<std::string>());
}

CyclePointer forces_of(const DeckPointer& deck, const std::vector<std::int64_t>& only,
                       const std::string& accuracy, const std::string& model, double dt,
                       double time, const py::dict& velocities) {
  if (model != "reference" && model != "robust")
    throw py::value_error("model is 'reference' or 'robust', not '" + model + "'");
  must_be(dt >= 0 && std::isfinite(dt), "dt is a finite time, 0 or more");
  must_be(std::isfinite(time), "time is a finite number");
  std::vector<cycle::PartVelocity> given;
  for (const auto& [part, velocity] : velocities) {
    const auto id = part.cast<std::int64_t>();
    if (!deck->loaded.model().part_of_id.contains(id))
      throw py::key_error(deck->path + " has no part " + std::to_string(id));
    given.push_back({id, velocity_of(velocity)});
  }
  auto out = std::make_shared<PyCycle>();
  out->contacts = contacts_of(deck, only, accuracy, {}, true);
  out->options.model = model == "reference" ? cycle::Model::reference : cycle::Model::robust;
  out->options.dt1 = out->options.dt12 = dt;
  out->options.time = time;
  out->options.threads = deck->loaded.options().threads;
  out->options.keep_pairs = true;
  const py::gil_scoped_release free;
  const std::lock_guard one(deck->mutex);
  out->state = cycle::make_state(out->contacts->scene, given);
  out->outcome = cycle::run_cycle(out->contacts->scene, out->state, out->options);
  return out;
}

const Contact& contact_at(const PyScene& s, std::size_t k) { return s.scene.contacts.at(k); }

py::dict edge_arrays(const std::vector<ContactEdge>& edges, const py::object& owner) {
  py::dict out;
  out["edge_index"] = member_view(edges, &ContactEdge::nodes, owner);
  out["stiffness"] = member_view(edges, &ContactEdge::stiffness, owner);
  out["gap"] = member_view(edges, &ContactEdge::gap, owner);
  return out;
}

/// Arrays of one contact by name. Nodes are positions in the arrays of the deck's nodes.
py::dict secondary_arrays(const ScenePointer& s, std::size_t k) {
  const Contact& c = contact_at(*s, k);
  const py::object owner = py::cast(s);
  if (c.kind == ContactKind::edge_edge) return edge_arrays(c.secondary_edges, owner);
  py::dict out;
  out["node_index"] = member_view(c.secondary, &SecondaryNode::node, owner);
  out["stiffness"] = member_view(c.secondary, &SecondaryNode::multiplier, owner);
  out["gap"] = member_view(c.secondary, &SecondaryNode::gap, owner);
  std::vector<double> stiffness = c.nodal_stiffness;
  stiffness.resize(c.secondary.size());  // zeros where Istf does not ask for it
  out["nodal_stiffness"] = py::array_t<double>(stiffness.size(), stiffness.data());
  return out;
}

py::dict main_arrays(const ScenePointer& s, std::size_t k) {
  const Contact& c = contact_at(*s, k);
  const py::object owner = py::cast(s);
  if (c.kind == ContactKind::edge_edge) return edge_arrays(c.main_edges, owner);
  py::dict out;
  out["segment_index"] = member_view(c.main, &MainSegment::nodes, owner);
  out["stiffness"] = member_view(c.main, &MainSegment::stiffness, owner);
  out["gap"] = member_view(c.main, &MainSegment::gap, owner);
  std::vector<double> thickness;
  for (const MainSegment& m : c.main)
    thickness.push_back(detail::contact_thickness(*s->scene.model, m));
  out["thickness"] = py::array_t<double>(thickness.size(), thickness.data());
  return out;
}

/// The pairs of a contact that ties, or those of one that does not; else none.
py::dict pair_arrays(const ScenePointer& s, std::size_t k, bool ties) {
  static const std::vector<PenetrationRow> none;
  const Contact& c = contact_at(*s, k);
  const std::vector<PenetrationRow>& rows = c.is_tied_contact() == ties ? c.penetrations : none;
  const py::object owner = py::cast(s);
  py::dict out;
  out["secondary"] = member_view(rows, &PenetrationRow::secondary, owner);
  out["main"] = member_view(rows, &PenetrationRow::main, owner);
  out["penetration"] = member_view(rows, &PenetrationRow::depth, owner);
  out["gap"] = member_view(rows, &PenetrationRow::gap, owner);
  out["distance"] = member_view(rows, &PenetrationRow::distance, owner);
  out["normal"] = member_view(rows, &PenetrationRow::normal, owner);
  out["on_surface"] = member_view(rows, &PenetrationRow::on_surface, owner);
  out["in_contact"] = member_view(rows, &PenetrationRow::in_contact, owner);
  out["gap0"] = member_view(rows, &PenetrationRow::gap0, owner);
  out["p0"] = member_view(rows, &PenetrationRow::p0, owner);
  py::list action;
  for (const PenetrationRow& row : rows) action.append(to_string(row.action));
  out["action"] = action;
  return out;
}

py::dict penetration_arrays(const ScenePointer& s, std::size_t k) {
  return pair_arrays(s, k, false);
}
py::dict tied_arrays(const ScenePointer& s, std::size_t k) { return pair_arrays(s, k, true); }

py::dict contact_facts(const PyScene& s, std::size_t k) {
  const Contact& c = contact_at(s, k);
  py::dict out;
  out["interface"] = c.inter->id;
  out["type"] = c.inter->type;
  out["kind"] = to_string(c.kind);
  out["role"] = to_string(c.role);
  out["gapmin"] = c.gapmin;
  out["gapmax"] = c.gapmax;
  out["igap"] = c.igap;
  out["inacti"] = c.inacti;
  out["evaluated"] = c.evaluated;
  out["ties"] = c.is_tied_contact();
  out["candidates"] = c.candidates;
  return out;
}

py::dict force_arrays(const CyclePointer& r, std::size_t k) {
  using cycle::PairOutcome;
  const cycle::ContactOutcome& c = r->outcome.contacts.at(k);
  const py::object owner = py::cast(r);
  py::dict out;
  const auto at = [&](std::uint32_t CandidatePair::*member) {
    const auto n = static_cast<py::ssize_t>(c.pairs.size());
    return view_of<std::uint32_t>(c.pairs.empty() ? nullptr : &(c.pairs.front().at.*member), {n},
                                  {static_cast<py::ssize_t>(sizeof(PairOutcome))}, owner);
  };
  out["secondary"] = at(&CandidatePair::secondary);
  out["main"] = at(&CandidatePair::main);
  out["weights"] = member_view(c.pairs, &PairOutcome::weights, owner);
  out["force"] = member_view(c.pairs, &PairOutcome::force, owner);
  out["normal_force"] = member_view(c.pairs, &PairOutcome::normal_force, owner);
  out["penetration"] = member_view(c.pairs, &PairOutcome::penetration, owner);
  out["gap"] = member_view(c.pairs, &PairOutcome::gap, owner);
  out["distance"] = member_view(c.pairs, &PairOutcome::distance, owner);
  out["k0"] = member_view(c.pairs, &PairOutcome::k0, owner);
  out["k_nodal"] = member_view(c.pairs, &PairOutcome::k_nodal, owner);
  return out;
}

/// A text about contacts, with all that was found on the way to them among the deck's findings.
template <class Make>
std::string text_about(const PyScene& s, const Make& make) {
  return alone_with(*s.deck, [&] {
    const Joined joined(s);
    return make(s.deck->loaded.deck());
  });
}

CycleInput input_of(const PyCycle& r) {
  CycleInput input;
  input.path = r.contacts->deck->path;
  input.deck = &r.contacts->deck->loaded.deck();
  input.scene = &r.contacts->scene;
  input.state = &r.state;
  input.outcome = &r.outcome;
  input.options = r.options;
  input.view = &r.contacts->view;
  return input;
}

}  // namespace

void bind_results(py::module_& m) {
  py::class_<PyScene, ScenePointer>(m, "Scene")
      .def("__len__", [](const PyScene& s) { return s.scene.contacts.size(); })
      .def("json",
           [](const PyScene& s, bool all) {
             return text_about(s, [&](const Deck& deck) {
               return gaps_json(s.deck->path, deck, s.scene, s.view, all, &s.crossings);
             });
           })
      .def("facts", &contact_facts)
      .def("secondary", &secondary_arrays)
      .def("main", &main_arrays)
      .def("penetrations", &penetration_arrays)
      .def("tied_pairs", &tied_arrays)
      .def("verdict",
           [](const PyScene& s) {
             return text_about(s, [&](const Deck& deck) {
               return verdict_json(verdict_of(deck, s.scene, s.view));
             });
           })
      .def("coordinates", [](const ScenePointer& s) {
        const py::object owner = py::cast(s);
        const Coordinates& x = s->scene.coordinates;
        return py::make_tuple(view_of(x.x, owner), view_of(x.y, owner), view_of(x.z, owner));
      });
  py::class_<PyCycle, CyclePointer>(m, "Cycle")
      .def("__len__", [](const PyCycle& r) { return r.outcome.contacts.size(); })
      .def("json",
           [](const PyCycle& r, bool all) {
             return text_about(*r.contacts,
                               [&](const Deck&) { return cycle_json(input_of(r), all); });
           })
      .def("facts", [](const PyCycle& r, std::size_t k) { return contact_facts(*r.contacts, k); })
      .def("secondary",
           [](const PyCycle& r, std::size_t k) { return secondary_arrays(r.contacts, k); })
      .def("main", [](const PyCycle& r, std::size_t k) { return main_arrays(r.contacts, k); })
      .def("pairs", &force_arrays)
      .def("mass", [](const CyclePointer& r) { return view_of(r->state.mass, py::cast(r)); })
      .def("verdict", [](const PyCycle& r) {
        return text_about(*r.contacts,
                          [&](const Deck&) { return verdict_json(cycle_verdict(input_of(r))); });
      });
  m.def("gaps", [](const DeckPointer& deck, const std::vector<std::int64_t>& only,
                   const std::string& accuracy, const std::vector<std::string>& what_if) {
    return contacts_of(deck, only, accuracy, what_if, false);
  });
  m.def("cycle", &forces_of);
}

}  // namespace deck::python
