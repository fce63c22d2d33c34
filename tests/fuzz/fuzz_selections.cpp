// Groups, surfaces, lines, boxes and sets: the input is a list of their blocks behind a small model
// of every kind of element. What they give lies in the model, ids are unique, and the order in
// which they are asked for does not matter.
#include <algorithm>

#include "deck/model/selection.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

constexpr std::string_view model_text = R"(/PART/1
shells
         1         1         3
/PART/2
solids
         2         1         3
/PART/3
lines
         3         1         0
/SUBSET/3
both
         1         2
/SUBSET/4
all
         3
/PROP/SOLID/2
block
/PROP/TRUSS/3
rod
                 2.0
/NODE
         1                 0.0                 0.0                 0.0
         2                10.0                 0.0                 0.0
         3                10.0                10.0                 0.0
         4                 0.0                10.0                 0.0
         5                20.0                 0.0                 0.0
         6                20.0                10.0                 0.0
        11                 0.0                 0.0                 5.0
        12                10.0                 0.0                 5.0
        13                10.0                10.0                 5.0
        14                 0.0                10.0                 5.0
        21                 0.0                 0.0                15.0
        22                10.0                 0.0                15.0
        23                10.0                10.0                15.0
        24                 0.0                10.0                15.0
/SHELL/1
         1         1         2         3         4
         2         2         5         6         3
/SH3N/1
         7         5         6         3
/BRICK/2
         3        11        12        13        14        21        22        23        24
/TETRA4/2
         8        11        12        13        21
/TRUSS/3
         4         1        11
         5         2        12
/SKEW/FIX/1
turned
                 1.0                 2.0                 3.0
                 0.0                 1.0                 0.0
                 0.0                 0.0                 1.0
)";

/// What a selection of each kind is, as text.
std::string describe(const Model& model, Selections& s, const char* kind, std::int64_t id) {
  std::string out = std::string(kind) + " " + std::to_string(id) + ":";
  const auto node = [&](NodeIndex n) {
    require(n < model.nodes.size(), "a selected node exists", out);
    out += " " + std::to_string(n);
  };
  const std::string_view k = kind;
  if (k == "grnod") {
    if (const NodeSet* g = s.node_group(id))
      for (const NodeIndex n : g->nodes) node(n);
  } else if (k == "surf") {
    if (const Surface* g = s.surface(id))
      for (const Segment& e : g->segments)
        for (const NodeIndex n : e.nodes) node(n);
  } else if (k == "line") {
    if (const LineSet* g = s.line(id))
      for (const Edge& e : g->edges)
        for (const NodeIndex n : e.nodes) node(n);
  } else if (k == "set") {
    if (const SetGeneral* g = s.set(id)) {
      for (const NodeIndex n : g->nodes) node(n);
      for (const Segment& e : g->segments)
        for (const NodeIndex n : e.nodes) node(n);
      for (const Edge& e : g->edges)
        for (const NodeIndex n : e.nodes) node(n);
      for (const std::uint32_t p : g->parts) {
        require(p < model.parts.size(), "a selected part exists", out);
        out += " p" + std::to_string(p);
      }
    }
  } else if (k == "grpart") {
    if (const auto* g = s.part_group(id)) {
      require(std::is_sorted(g->begin(), g->end()), "parts are in order", out);
      for (const std::uint32_t p : *g) {
        require(p < model.parts.size(), "a selected part exists", out);
        out += " " + std::to_string(p);
      }
    }
  } else if (const auto* g = s.element_group(kind, id)) {
    for (const std::uint32_t e : *g) out += " " + std::to_string(e);
  }
  return out + "\n";
}

constexpr const char* kinds[] = {"grnod",  "surf",   "line",   "set",    "grpart",
                                 "grshel", "grsh3n", "grbric", "grquad", "grtria",
                                 "grtrus", "grbeam", "grspri"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto whole = fuzz::read_blocks(2022, model_text, data, size);
  if (!whole) return 0;
  const Model& model = whole->model;
  std::vector<std::pair<const char*, std::int64_t>> all;
  Selections forward(model, SchemaSet::built_in()), backward(model, SchemaSet::built_in());
  for (const char* kind : kinds)
    for (const std::int64_t id : forward.ids(kind)) all.emplace_back(kind, id);
  std::vector<std::string> first, second;
  for (const auto& [kind, id] : all) first.push_back(describe(model, forward, kind, id));
  for (auto i = all.rbegin(); i != all.rend(); ++i)
    second.push_back(describe(model, backward, i->first, i->second));
  std::reverse(second.begin(), second.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    require(first[i] == second[i], "a selection does not depend on what was asked before",
            first[i] + second[i]);
  forward.resolve_all();
  fuzz::check_spans(whole->deck, forward.diagnostics());
  for (std::size_t i = 0; i < all.size(); ++i)
    require(describe(model, forward, all[i].first, all[i].second) == first[i],
            "asking again gives the same");
  return 0;
}
