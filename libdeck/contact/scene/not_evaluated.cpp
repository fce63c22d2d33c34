// Finds groups with omitted members, smoothed sides, nodes of unread transforms and thicknesses.
#include <algorithm>
#include <cmath>
#include <set>

#include "contact/scene/complete_contacts.hpp"
#include "deck/rule_id.hpp"
#include "keyword/shared/place.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

/// True for transforms with an affine map; deck leaves nodes of all others in place.
bool is_evaluated(const DecodedBlock& d) {
  constexpr std::string_view types[] = {"/TRANSFORM/TRA", "/TRANSFORM/ROT", "/TRANSFORM/SYM",
                                        "/TRANSFORM/SCA", "/TRANSFORM/MATRIX"};
  const std::string_view header = d.block->header;
  if (std::none_of(std::begin(types), std::end(types),
                   [&](std::string_view t) { return is_below(header, t); }))
    return false;
  const bool by_nodes = d.integer("node_ID1") > 0 && d.integer("node_ID2") > 0;
  return !is_below(header, types[0]) || by_nodes || d.integer("skew_ID") == 0;
}

}  // namespace

std::string unusable_cell(const Deck& deck, const InterBase& inter) {
  std::string out;
  for_each_field(inter, [&]<class T>(std::string_view name, const Effective<T>& e) {
    if constexpr (std::is_same_v<T, double>)
      if (out.empty() && e.has_input && !std::isfinite(e.input))
        out = std::string(name) + " is '" + std::string(trim(deck.sources.text(e.span))) +
              "', which is not a finite number in working units";
  });
  return out;
}

NotEvaluated::NotEvaluated(const Model& model, Selections& selections)
    : model_(model), selections_(selections), unsized_(unread_at_nodes(model, false)) {
  const Deck& deck = *model_.deck;
  for (const Block& block : deck.blocks) {
    if (!is_below(block.header, "/TRANSFORM")) continue;
    const DecodedBlock d = decode(deck, block);
    if (is_evaluated(d)) continue;
    if (unplaced_.empty()) unplaced_.assign(model_.nodes.size(), false);
    if (d.integer("SUBMODEL") != 0) {
      for (const BulkBlock& range : model_.node_blocks)
        if (range.block->submodel >= 0)
          std::fill_n(unplaced_.begin() + range.first, range.count, true);
      continue;
    }
    const std::int64_t group = d.integer("GR_NODE") + deck.offset_of(block, "grnod");
    if (const NodeSet* nodes = selections_.node_group(group))
      for (const NodeIndex n : nodes->nodes) unplaced_[n] = true;
  }
}

void NotEvaluated::find_partial() {
  const std::vector<Finding>& all = selections_.findings().all();
  if (looked_at_ == all.size()) return;
  std::optional<BlockIndex> index;
  for (; looked_at_ < all.size(); ++looked_at_) {
    const Finding& d = all[looked_at_];
    if (d.rule != RuleId::DK164) continue;
    if (!index) index.emplace(*model_.deck);
    const std::int64_t b = index->find(d.span.file, d.span.offset);
    if (b >= 0) partial_.emplace(&model_.deck->blocks[static_cast<std::size_t>(b)], d.message);
  }
}

std::string NotEvaluated::partial_group(const Block& inter) {
  find_partial();
  if (partial_.empty()) return {};
  if (!definitions_) definitions_.emplace(*model_.deck);
  constexpr std::string_view groups[] = {"grnod",  "surf",   "line",   "set",
                                         "grshel", "grsh3n", "grbric", "grquad",
                                         "grtria", "grtrus", "grbeam", "grspri"};
  std::set<const Block*> seen{&inter};
  std::vector<const Block*> open{&inter};
  while (!open.empty()) {
    const Block& block = *open.back();
    open.pop_back();
    if (const auto it = partial_.find(&block); it != partial_.end()) return it->second;
    for (const Reference& r : references_of(*model_.deck, block)) {
      if (std::find(std::begin(groups), std::end(groups), r.kind) == std::end(groups)) continue;
      const Block* next = definitions_->find(r.kind, r.id);
      if (next != nullptr && seen.insert(next).second) open.push_back(next);
    }
  }
  return {};
}

std::string NotEvaluated::reason_in_nodes(const Contact& contact) const {
  // Gaps of these types are formed of thicknesses, those of the others may be.
  const bool sized = contact.igap != 0 || contact.gapmin_origin != GapminOrigin::card ||
                     is_type24_or_25(contact.type);
  if (unplaced_.empty() && (!sized || unsized_.empty())) return {};
  NodeIndex found = no_index;
  std::string why;
  const auto look = [&](NodeIndex n) {
    if (n != no_index && !unplaced_.empty() && unplaced_[n]) found = n;
    if (const auto it = unsized_.find(n); sized && it != unsized_.end()) why = it->second;
  };
  for_each_node(contact, look);
  if (found == no_index) return why.empty() ? why : "the gap is not known: " + why;
  return "node " + std::to_string(model_.nodes.id[found]) +
         " is moved by a /TRANSFORM that deck does not evaluate";
}

std::string NotEvaluated::reason_in_card(const Contact& contact) {
  const Block* block = contact.inter->block;
  if (block == nullptr) return {};
  if (contact.inter->type == 7 && block->version >= 2026 &&
      decode(*model_.deck, *block).integer("Ists") != 0)
    return "with Ists its secondary side is a smoothed surface, which deck does not evaluate";
  return partial_group(*block);
}

}  // namespace deck::detail
