// What the parts of build_model share: the deck being read, the model being filled, and short ways
// to decode a block with submodel offsets, unit conversion and findings.
#pragma once
#include <string>
#include <string_view>

#include "deck/model/model.hpp"
#include "deck/text/rule.hpp"

namespace deck::detail {

/// What a finding of the model stage says beyond the page of its rule.
struct Finding {
  RuleId rule{};
  Span span{};
  std::string message{};
  std::string keyword{};
  std::int64_t id = 0;
  Case particular{};
};
Diagnostic make_diagnostic(Finding f);
void report(Diagnostics& diagnostics, Finding f);

/// Header fields of a block up to its id, without the leading slash: "/SURF/PART/EXT/3" gives
/// {"SURF", "PART", "EXT"}; the meaningless field ADDD is dropped.
std::vector<std::string_view> header_fields(const Block& block);
inline bool header_starts(const Block& block, std::string_view prefix) {
  return block.header.starts_with(prefix) &&
         (block.header.size() == prefix.size() || block.header[prefix.size()] == '/');
}

struct BuildContext {
  const Deck& deck;
  Diagnostics& diagnostics;
  Model& model;
  int threads = 1;

  /// The block's own id with its submodel's offset for `kind`.
  std::int64_t own_id(const Block& block, std::string_view kind) const {
    return shift(block, kind, block.id.value);
  }
  /// A reference to another entity: ids above 0 are shifted, 0 and below stay.
  std::int64_t shift(const Block& block, std::string_view kind, std::int64_t id) const {
    return id > 0 ? id + deck.offset_of(block, kind) : id;
  }
  /// Reference in field `name`; its kind decides the offset.
  std::int64_t reference(const DecodedBlock& d, std::string_view name,
                         std::string_view kind) const {
    return shift(*d.block, kind, d.integer(name));
  }
  /// Real field in working units, 0 if absent.
  double value(const DecodedBlock& d, std::string_view name) const {
    const Cell* cell = d.find(name);
    return cell ? working_value(deck, d, *cell) : 0;
  }
};

// One function per kind of entity; each fills its part of the model from the blocks of the deck.
void read_parts(BuildContext& context);
void read_properties(BuildContext& context);
void read_materials(BuildContext& context);
/// Curves, sensors, skews, frictions, rigid bodies, submodels, subsets.
void read_other_entities(BuildContext& context);
/// Flags of the whole run: /ANALY, /INTTHICK/V5, /RANDOM, monitored volumes, ALE.
void read_run_options(BuildContext& context);
/// Property and material of every part; findings about what is missing.
void link_parts(BuildContext& context);
/// Elements against parts, shell thicknesses, collapsed quadrangles; grouped per part.
void check_elements(BuildContext& context);
/// /CNODE: which connection nodes are other nodes, and then the elements that name them.
void merge_connection_nodes(BuildContext& context);
void redirect_elements(BuildContext& context);
/// /TRANSFORM with a SUBMODEL field: right after the nodes.
void apply_submodel_transforms(BuildContext& context);
/// The other /TRANSFORM: after all groups and sets, in the order of the deck.
void apply_group_transforms(BuildContext& context);

/// Nodes whose coordinates, as they are at last, no distance can be computed with.
void check_coordinates(BuildContext& context);

/// /RANDOM: the solver's noise on all coordinates, reproduced for seed 0.
void apply_random_noise(BuildContext& context);

/// Adds `index` to `map` under `id`; the first object of an id wins, the second is a finding.
void register_id(BuildContext& context, std::map<std::int64_t, std::uint32_t>& map, std::int64_t id,
                 std::uint32_t index, const Block& block, Span first);

}  // namespace deck::detail
