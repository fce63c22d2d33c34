// A deck all the way: read, model, interfaces, contacts, ties, penetrations, crossings, forces, and
// their JSON. Positions and numbers must be sound, the documents valid, one thread and three must
// give the same bytes, and what is in a TYPE24 or TYPE25 contact is what exact arithmetic says.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/report.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/params_report.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

void check_scene(const Scene& scene) {
  const std::size_t nodes = scene.model->nodes.size();
  for (const Contact& c : scene.contacts) {
    const bool edges = c.kind == ContactKind::edge_edge;
    for (const SecondaryNode& n : c.secondary) require(n.node < nodes, "a secondary node exists");
    for (const MainSegment& m : c.main)
      for (const NodeIndex n : m.nodes) require(n < nodes, "a node of a segment exists");
    for (const PenetrationRow& p : c.penetrations) {
      require(p.secondary < (edges ? c.secondary_edges.size() : c.secondary.size()) &&
                  p.main < (edges ? c.main_edges.size() : c.main.size()),
              "a penetration is between sides of its contact");
      require(std::isfinite(p.depth) && std::isfinite(p.gap) && std::isfinite(p.distance),
              "a penetration is a number");
      require(p.distance >= 0, "a distance is not negative");
    }
  }
}

void check_ties(const Scene& scene) {
  for (const Tie& tie : scene.ties) {
    if (!tie.not_evaluated.empty()) continue;
    for (const TiedNode& n : tie.nodes) {
      require(n.node < scene.model->nodes.size(), "a tied node exists");
      require(!n.tied || n.segment != no_index, "a tied node has a segment");
      if (n.segment == no_index || tie.inter->Isearch.value == 1) continue;
      require(n.segment < tie.main.size(), "the segment is one of the main side");
      const auto& c = tie.main[n.segment];
      require(std::find(c.begin(), c.end(), n.node) == c.end(), "no node is tied to its segment");
      if (tie.ignore < 4 && std::isfinite(n.search))
        require(n.distance < n.search, "a node is within its search distance");
    }
  }
}

/// The nodes, pairs of edges, and edges through faces, in contact. Where several segments are
/// equally near any may be named.
std::vector<std::array<std::uint32_t, 4>> in_contact(const Scene& scene) {
  std::vector<std::array<std::uint32_t, 4>> out;
  for (std::uint32_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    if (!is_type24_or_25(c.type)) continue;
    for (const PenetrationRow& r : c.penetrations)
      if (r.in_contact)
        out.push_back({i, r.secondary, c.kind == ContactKind::edge_edge ? r.main : 0, 0});
    for (const EdgeThroughSegment& e : c.edges_through_segments)
      out.push_back({i, e.edge, e.main, static_cast<std::uint32_t>(e.side)});
  }
  return out;
}

/// Everything that the verbs would print about the deck as JSON.
std::string answers(const std::string& text, int threads) {
  const auto whole = fuzz::read_text(text, threads);
  if (!whole) return "";
  fuzz::check_spans(whole->deck, whole->deck.findings);
  std::string out;
  // Reading the documents costs as much as all the rest: every eighth input.
  const bool read_back = fuzz::hash_of(text) / 32 % 8 == 0;
  const auto add = [&](std::string document) {
    if (read_back) require(nlohmann::json::accept(document), "a document is valid JSON", document);
    out += document;
  };
  add(params_json({whole->loaded}));
  SceneOptions options;
  options.threads = threads;
  options.nodal_stiffness = true;
  options.ties = true;
  const Scene scene = build_scene(whole->model, whole->interfaces, whole->findings, options);
  check_scene(scene);
  check_ties(scene);
  if (read_back && whole->interfaces.type24.size() + whole->interfaces.type25.size() > 0) {
    options.accuracy = Accuracy::exact;
    Findings said;
    require(in_contact(build_scene(whole->model, whole->interfaces, said, options)) ==
                in_contact(scene),
            "what is in contact is exact");
  }
  fuzz::check_spans(whole->deck, whole->findings);
  const SceneView view = make_view(scene);
  const auto crossings = find_crossings(scene, threads);
  add(gaps_json("fuzz", whole->deck, scene, view, true, &crossings));
  out += gaps_text(whole->deck, scene, view);
  const cycle::State state = cycle::make_state(scene);
  cycle::CycleOptions cycle_options;
  cycle_options.threads = threads;
  cycle_options.keep_pairs = true;
  cycle_options.dt1 = cycle_options.dt12 = fuzz::hash_of(text) % 2 == 0 ? 0.0 : 1e-3;
  const cycle::SceneOutcome outcome = cycle::run_cycle(scene, state, cycle_options);
  CycleInput input;
  input.path = "fuzz";
  input.deck = &whole->deck;
  input.scene = &scene;
  input.state = &state;
  input.outcome = &outcome;
  input.options = cycle_options;
  add(cycle_json(input, true));
  for (const Finding& d : whole->findings.all()) out += d.message + "\n";
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 16384) return 0;
  const std::string text = fuzz::text_of(data, size);
  const std::string serial = answers(text, 1);
  // Starting threads costs more than a small deck: every sixteenth input.
  if (!serial.empty() && fuzz::hash_of(text) / 2 % 16 == 0)
    require(answers(text, 3) == serial, "three threads give the answer of one");
  return 0;
}
