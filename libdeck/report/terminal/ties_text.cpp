// Tables of ties and of their untied nodes on the terminal.
#include "report/terminal/ties_text.hpp"

#include <algorithm>

#include "contact/shared/element_names.hpp"
#include "deck/contact/ties.hpp"
#include "deck/contact/view.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "report/terminal/words.hpp"

namespace deck::detail {
namespace {

std::string segment_text(const Model& model, const Tie& tie, std::uint32_t segment) {
  if (segment == no_index) return "-";
  const auto& c = tie.main[segment];
  std::string out;
  for (std::size_t k = 0; k < (c[2] == c[3] ? 3U : 4U); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : " ", model.node_id(c[k]));
  return out;
}

/// A node that is not tied.
struct Untied {
  const InterBase* inter = nullptr;
  NodeIndex node = no_index;
  std::string segment, distance, search, why;
};

Untied untied_of(const Model& model, const Tie& tie, const TiedNode& n) {
  const bool found = n.segment != no_index;
  const std::uint32_t segment = found ? n.segment : n.nearest;
  const double distance = found ? n.distance : n.nearest_distance;
  const double search = n.search != 0 ? n.search : tie.search_distance;
  return {tie.inter,
          n.node,
          segment_text(model, tie, segment),
          segment == no_index ? "-" : fmt::format("{:.6g}", distance),
          search == 0 ? "-" : fmt::format("{:.6g}", search),
          short_reason(tie, n)};
}

/// The first `most` of all ties; `all`: how many there are.
std::vector<Untied> untied_of(const Scene& scene, std::size_t most, std::size_t& all) {
  std::vector<Untied> out;
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes)
      if (tie.not_evaluated.empty() && n.lost() && ++all <= most)
        out.push_back(untied_of(*scene.model, tie, n));
  for (const Contact& c : scene.contacts)
    for (const std::uint32_t i : untied_secondary(c))
      if (++all <= most)
        out.push_back({c.inter, c.secondary[i].node, "-", "-", fmt::format("{:.6g}", c.gapmin),
                       "no segment"});
  return out;
}

}  // namespace

std::string tie_table(const Scene& scene, const GapsTextOptions& options) {
  TextTable table = make_table({">id", "type", "title", ">nodes", ">tied", ">not tied",
                                ">search distance", ">farthest", "what happens"});
  std::vector<std::int64_t> clean;
  for (const Tie& tie : scene.ties) {
    const TieCounts n = count_ties(tie);
    const std::string happens = losses_text(tie);
    if (!options.verbose && happens == "-" && n.nodes > 0) {
      clean.push_back(tie.inter->id);
      continue;
    }
    double farthest = 0;
    for (const TiedNode& node : tie.nodes)
      if (node.tied) farthest = std::max(farthest, node.distance);
    table.row({fmt::format("{}", tie.inter->id), "TYPE2", tie.inter->title,
               fmt::format("{}", n.nodes), fmt::format("{}", n.tied), fmt::format("{}", n.lost()),
               tie.search_distance != 0 ? fmt::format("{:.6g}", tie.search_distance) : "by pair",
               n.tied > 0 ? fmt::format("{:.6g}", farthest) : "-", happens});
  }
  std::string out;
  if (table.size() > 0) out = table.fitted(options.width, options.color, 2);
  return out + folded_ids(clean, "tie that holds", "ties that hold");
}

std::string untied_text(const Deck& deck, const Scene& scene, const GapsTextOptions& options) {
  const Model& model = *scene.model;
  std::size_t all = 0;
  const std::vector<Untied> rows = untied_of(scene, options.worst, all);
  TextTable table = make_table({">interface", ">node", ">part", "nearest segment", ">distance",
                                ">search distance", "why", "=defined at"});
  std::vector<NodeIndex> nodes;
  for (const Untied& row : rows) nodes.push_back(row.node);
  const std::vector<Span> spans = node_spans(model, nodes);
  Connectivity connectivity(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Untied& row = rows[i];
    const std::int64_t part = element_at(model, connectivity, row.node).part;
    table.row({fmt::format("{}", row.inter->id), fmt::format("{}", model.node_id(row.node)),
               part == 0 ? "-" : fmt::format("{}", part), row.segment, row.distance, row.search,
               row.why, deck.sources.where(spans[i])});
  }
  std::string out = rows.empty() ? std::string() : table.fitted(options.width, options.color, 2, 1);
  if (rows.size() < all)
    out += fmt::format("  … and {} more (--worst N, --json)\n", all - rows.size());
  return out;
}

}  // namespace deck::detail
