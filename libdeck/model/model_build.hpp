// What the parts of build_model share: the deck being read, the model being filled, and short ways
// to decode a block with submodel offsets, unit conversion and findings.
#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "base/shared/vec.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// What a finding of the model stage says beyond the page of its rule.
struct FindingDraft {
  RuleId rule{};
  Span span{};
  std::string message{};
  std::string keyword{};
  std::int64_t id = 0;
  Overrides overrides{};
};
Finding finding_from(FindingDraft f);
void report(Findings& findings, FindingDraft f);
/// "/SURF/PART 3": a block as findings call it, by the id in its header.
std::string name_of(const Block& block);
/// A finding about a block, at its header.
FindingDraft finding_about(const Block& block, RuleId rule, std::string message,
                           Overrides overrides = {});

/// Header fields of a block up to its id, without the leading slash: "/SURF/PART/EXT/3" gives
/// {"SURF", "PART", "EXT"}; the meaningless field ADDD is dropped.
std::vector<std::string_view> header_fields(const Block& block);
inline bool header_starts(const Block& block, std::string_view prefix) {
  return is_below(block.header, prefix);
}

/// Cells of a block in working units.
class BlockCells {
 public:
  BlockCells(const Deck& deck, const Block& block) : deck_(deck), d_(decode(deck, block)) {}
  double real(std::string_view name) const { return working_value(deck_, d_, name); }
  double real_or(std::string_view name, double otherwise) const {
    const double v = real(name);
    return v != 0.0 ? v : otherwise;
  }
  int integer(std::string_view name) const { return static_cast<int>(d_.integer(name)); }
  std::int64_t id(std::string_view name, std::string_view kind) const {
    return deck_.shifted_id(*d_.block, kind, d_.integer(name));
  }
  bool has(std::string_view name) const { return d_.find(name) != nullptr; }
  /// Calls f(value) for every cell of that name.
  template <class F>
  void each(std::string_view name, F f) const {
    for (const DecodedCard& card : d_.cards)
      for (const Cell& c : card.cells)
        if (c.field->name == name) f(c, working_value(deck_, d_, c));
  }
  double largest(std::initializer_list<std::string_view> names) const {
    double most = 0;
    for (const std::string_view n : names) most = std::max(most, real(n));
    return most;
  }

 private:
  const Deck& deck_;
  DecodedBlock d_;
};

/// Whether a law or type is one of some.
inline bool one_of(int number, std::initializer_list<int> numbers) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Axes of the skew of a block, from places of nodes; nullopt: not known.
std::optional<std::array<Vec, 3>> skew_axes(const Model& model, const Block& skew,
                                            const std::function<Vec(NodeIndex)>& place);

/// Sum of mu_i alpha_i, i = 1 ... 10: twice the ground shear modulus of an Ogden material.
double ogden_sum(const BlockCells& c);

struct BuildContext {
  const Deck& deck;
  Findings& findings;
  Model& model;
  int threads = 1;

  /// The block's own id with its submodel's offset for `kind`.
  std::int64_t own_id(const Block& block, std::string_view kind) const {
    return deck.shifted_id(block, kind, block.id.value);
  }
  /// Reference in field `name`; its kind decides the offset.
  std::int64_t reference(const DecodedBlock& d, std::string_view name,
                         std::string_view kind) const {
    return deck.shifted_id(*d.block, kind, d.integer(name));
  }
  /// Real field in working units, 0 if absent.
  double value(const DecodedBlock& d, std::string_view name) const {
    return working_value(deck, d, name);
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

/// The id of a submodel with the offset of those above it.
inline std::int64_t submodel_id(const Deck& deck, const Submodel& s) {
  return s.id + (s.parent < 0 ? 0 : deck.submodels[static_cast<std::size_t>(s.parent)].submodels);
}

/// The number that digits write; -1: there are none, more than four, or something else.
int number_of_digits(std::string_view digits);

/// Adds `index` to `map` under `id`; the first object of an id wins, the second is a finding.
void register_id(BuildContext& context, std::map<std::int64_t, std::uint32_t>& map, std::int64_t id,
                 std::uint32_t index, const Block& block, Span first);
/// The same of an object that is added to a list.
template <class T>
void add_object(BuildContext& context, std::vector<T>& list,
                std::map<std::int64_t, std::uint32_t>& map, const Block& block, T object) {
  const auto known = map.find(object.id);
  register_id(context, map, object.id, static_cast<std::uint32_t>(list.size()), block,
              known == map.end() ? Span{} : list[known->second].span);
  list.push_back(std::move(object));
}

}  // namespace deck::detail
