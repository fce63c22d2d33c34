// TYPE24 and TYPE25: the input is a list of blocks behind two sheets, one of them bent onto itself,
// a brick with a coat and a bar. Whatever cards, segments and nodes it brings: a penetration has a
// place in the lists, a depth and an action that fits Inacti; threads change nothing; what is in
// contact is what exact arithmetic says; and a fix ends with a deck that is no worse, or says why
// not.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/deck.hpp"
#include "deck/edit/fix.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

constexpr std::string_view model_text = R"(/PROP/SOLID/2
block


/PART/1
sheet
         1         1         0
/PART/2
other sheet
         1         1         0
/PART/3
block
         2         1         0
/NODE
         1                 0.0                 0.0                 0.0
         2                10.0                 0.0                 0.0
         3                10.0                10.0                 0.0
         4                 0.0                10.0                 0.0
         5                20.0                 0.0                 0.0
         6                20.0                10.0                 0.0
         7                20.0                 0.0                 0.6
         8                20.0                10.0                 0.6
         9                11.0                 0.0                 0.6
        10                11.0                10.0                 0.6
        11                 5.0                 5.0                 0.7
        12                 9.0                 5.0                 0.4
        13                 5.0                 9.0                -0.3
        21                 2.0                 2.0                -5.2
        22                 8.0                 2.0                -5.2
        23                 8.0                 8.0                -5.2
        24                 2.0                 8.0                -5.2
        25                 2.0                 2.0                -0.2
        26                 8.0                 2.0                -0.2
        27                 8.0                 8.0                -0.2
        28                 2.0                 8.0                -0.2
/SHELL/1
         1         1         2         3         4
         2         5         7         8         6
         3         9        10         8         7
/SH3N/1
         4         2         5         3
         5         5         6         3
/SH3N/2
         6        11        12        13
/BRICK/3
         7        21        22        23        24        25        26        27        28
/SHELL/2
         8        25        26        27        28
/SURF/PART/EXT/1
sheet
         1
/SURF/PART/EXT/2
rest
         2         3
/GRNOD/NODE/1
free
        11        12        13        25
)";

std::string describe(const Scene& scene) {
  std::string out;
  for (const Contact& c : scene.contacts) {
    out += std::to_string(c.inter->id) + to_string(c.kind) + std::to_string(c.evaluated) +
           std::to_string(c.candidates) + "\n";
    for (const PenetrationRow& r : c.penetrations)
      out += std::to_string(r.secondary) + " " + std::to_string(r.main) + " " +
             std::to_string(r.depth) + " " + std::to_string(r.gap) + to_string(r.action) + "\n";
  }
  return out;
}

void check(const Contact& c) {
  if (!is_modern(c.type)) return;
  const bool nodes = c.kind == ContactKind::node_segment;
  require(c.main.size() == c.segment_kinds.size(), "every segment has a kind");
  for (const PenetrationRow& r : c.penetrations) {
    require(r.secondary < (nodes ? c.secondary.size() : c.secondary_edges.size()) &&
                r.main < (nodes ? c.main.size() : c.main_edges.size()),
            "a penetration is of the lists");
    require(std::isfinite(r.depth) && r.depth != 0, "a penetration has a depth");
    const bool stored =
        r.action == PenetrationAction::offset_stored || r.action == PenetrationAction::removed_tied;
    // Exact arithmetic may find what the solver does not act on.
    const bool exact_only = r.action == PenetrationAction::none && r.in_contact;
    require(exact_only || (c.inacti == 0   ? r.action == PenetrationAction::ignored
                           : c.inacti == 5 ? stored
                                           : r.action == PenetrationAction::initial_force),
            "the action is that of Inacti");
    if (!nodes) continue;
    const auto& corners = c.main[r.main].nodes;
    require(
        std::find(corners.begin(), corners.end(), c.secondary[r.secondary].node) == corners.end(),
        "no node penetrates its own segment");
  }
}

/// The nodes, pairs of edges, and edges through faces, in contact. Where several segments are
/// equally near any may be named.
std::vector<std::array<std::uint32_t, 4>> in_contact(const Scene& scene) {
  std::vector<std::array<std::uint32_t, 4>> out;
  for (std::uint32_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    if (!is_modern(c.type)) continue;
    for (const PenetrationRow& r : c.penetrations)
      if (r.in_contact)
        out.push_back({i, r.secondary, c.kind == ContactKind::edge_edge ? r.main : 0, 0});
    for (const EdgeThroughSegment& e : c.edges_through_segments)
      out.push_back({i, e.edge, e.main, static_cast<std::uint32_t>(e.side)});
  }
  return out;
}

/// What a fix must not end with; an error says why there is none.
void check_fix(const Result<PenetrationFix>& fix, const LoadedDeck& loaded) {
  if (!fix.ok()) {
    require(fix.error().code != Error::Code::internal, "a fix ends", fix.error().message);
    return;
  }
  for (const FixedInterface& i : fix->interfaces) {
    require(fix->strategy != "reduce-gap" || i.after.pairs <= i.before.pairs,
            "a smaller gap makes no penetrations");
    for (const FieldChange& c : i.changes)
      require(!c.field.empty() && !c.new_text.empty(), "a change names its field and text");
  }
  require(apply_rewrite(loaded.deck().sources, fix->rewrite).ok(), "the fix can be written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto whole = fuzz::read_blocks(2026, model_text, data, size);
  if (!whole) return 0;
  SceneOptions options;
  Diagnostics found;
  const Scene one = whole->loaded.scene_with(options, found);
  for (const Contact& c : one.contacts) check(c);
  options.threads = 3;
  const Scene three = whole->loaded.scene_with(options, found);
  require(describe(one) == describe(three), "threads change nothing");
  options.accuracy = Accuracy::exact;
  require(in_contact(one) == in_contact(whole->loaded.scene_with(options, found)),
          "what is in contact is exact");
  if (whole->interfaces.type24.size() + whole->interfaces.type25.size() == 0) return 0;
  ReduceGapOptions gap;
  gap.least_share = 0;
  check_fix(reduce_gaps(whole->loaded, gap), whole->loaded);
  check_fix(set_inacti(whole->loaded, {}), whole->loaded);
  return 0;
}
