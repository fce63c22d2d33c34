// Ties: the input is a list of blocks behind a sheet of shells and a few nodes. Whatever cards,
// segments and nodes it brings: a tied node has a segment that is not its own and lies within its
// search distance, a lost one has a reason, threads change nothing, and a larger dsearch ties what
// it was said to tie and nothing else.
#include <algorithm>
#include <cmath>

#include "deck/contact/ties.hpp"
#include "deck/deck.hpp"
#include "deck/edit/fix.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

constexpr std::string_view model_text = R"(/PART/1
sheet
         1         1         0
/NODE
         1                 0.0                 0.0                 0.0
         2                10.0                 0.0                 0.0
         3                10.0                10.0                 0.0
         4                 0.0                10.0                 0.0
         5                20.0                 0.0                 0.0
         6                20.0                10.0                 0.0
        11                 5.0                 5.0                 1.0
        12                15.0                 2.0                 2.0
        13                22.0                 5.0                 0.5
        14                10.0                16.0                 1.0
/SHELL/1
         1         1         2         3         4
/SH3N/1
         2         2         5         3
         3         5         6         3
/SURF/PART/1
sheet
         1
/GRNOD/NODE/1
free
        11        12        13        14
)";

std::string describe(const std::vector<Tie>& ties, const Model& model) {
  std::string out;
  for (const Tie& tie : ties) {
    out += std::to_string(tie.inter->id) + tie.not_evaluated + "\n";
    for (const TiedNode& n : tie.nodes)
      out += std::to_string(model.node_id(n.node)) + " " + std::to_string(n.segment) + " " +
             std::to_string(n.distance) + " " + short_reason(tie, n) + why_text(tie, n) + "\n";
  }
  return out;
}

void check(const Tie& tie, const Model& model) {
  for (std::size_t i = 0; i < tie.nodes.size(); ++i) {
    const TiedNode& n = tie.nodes[i];
    require(n.node < model.nodes.size(), "a secondary node exists");
    if (!tie.not_evaluated.empty()) continue;
    require(!n.tied || n.segment != no_index, "a tied node has a segment");
    if (n.segment == no_index) continue;
    require(n.segment < tie.main.size(), "the segment is one of the main side");
    const auto& c = tie.main[n.segment];
    if (tie.inter->Isearch.value == 1) continue;
    require(std::find(c.begin(), c.end(), n.node) == c.end(), "no node is tied to its own segment");
    if (tie.ignore < 4) require(n.distance < n.search, "a node is within its search distance");
    if (tie.ignore >= 1 && tie.ignore <= 3)
      require(std::fabs(n.s) < 1.5 && std::fabs(n.t) < 1.5, "a node is not far beyond the rim");
  }
  const TieCounts counts = count_ties(tie);
  require(counts.tied + counts.not_found + counts.dropped + counts.elsewhere == counts.nodes,
          "every node is counted once");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto whole = fuzz::read_blocks(2025, model_text, data, size);
  if (!whole) return 0;
  SceneOptions options;
  options.penetrations = options.candidates = false;
  options.ties = true;
  Diagnostics found;
  const Scene one = whole->loaded.scene_with(options, found);
  for (const Tie& tie : one.ties) check(tie, whole->model);
  options.threads = 3;
  const Scene three = whole->loaded.scene_with(options, found);
  require(describe(one.ties, whole->model) == describe(three.ties, whole->model),
          "threads change nothing");
  const auto fix = tie_nodes(whole->loaded, {});
  require(fix.ok() || fix.error().code != Error::Code::internal, "the fix is what was planned",
          fix.ok() ? "" : fix.error().message);
  return 0;
}
