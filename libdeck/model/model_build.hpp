// Shared by build_model's functions: deck, model, decoding with offsets, units and findings.
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

/// Differences of a finding from the page of its rule.
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
/// "/SURF/PART 3": name of a block in findings.
std::string name_of(const Block& block);
/// A finding at the header of a block.
FindingDraft finding_about(const Block& block, RuleId rule, std::string message,
                           Overrides overrides = {});

/// Header fields before the id: "/SURF/PART/EXT/3" gives {"SURF", "PART", "EXT"}; drops the field
/// ADDD, which has no effect.
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
  /// Calls f(cell, value) for every cell of that name.
  template <class F>
  void for_each(std::string_view name, F f) const {
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

/// True if a law or type is in the list.
inline bool one_of(int number, std::initializer_list<int> numbers) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Axes of the skew of a block from nodal coordinates; nullopt: unknown.
std::optional<std::array<Vec, 3>> skew_axes(const Model& model, const Block& skew,
                                            const std::function<Vec(NodeIndex)>& place);

/// Sum of mu_i alpha_i, i = 1 ... 10: twice the ground shear modulus of an Ogden material.
double ogden_sum(const BlockCells& c);

struct BuildContext {
  const Deck& deck;
  Findings& findings;
  Model& model;
  int threads = 1;

  /// The block's own id plus the submodel offset of `kind`.
  std::int64_t own_id(const Block& block, std::string_view kind) const {
    return deck.shifted_id(block, kind, block.id.value);
  }
  /// Id in field `name` plus the offset of its kind.
  std::int64_t reference(const DecodedBlock& d, std::string_view name,
                         std::string_view kind) const {
    return deck.shifted_id(*d.block, kind, d.integer(name));
  }
  /// Real field in working units, 0 if absent.
  double value(const DecodedBlock& d, std::string_view name) const {
    return working_value(deck, d, name);
  }
};

// One function per kind of entity; each reads its blocks.
void read_parts(BuildContext& context);
void read_properties(BuildContext& context);
void read_materials(BuildContext& context);
/// Curves, sensors, skews, frictions, rigid bodies, submodels, subsets.
void read_other_entities(BuildContext& context);
/// Flags of the whole run: /ANALY, /INTTHICK/V5, /RANDOM, monitored volumes, ALE.
void read_run_options(BuildContext& context);
/// Sets property and material of every part; reports missing ones.
void link_parts(BuildContext& context);
/// Checks elements against parts: shell thickness, collapsed quadrangles.
void check_elements(BuildContext& context);
/// /CNODE: merges connection nodes with other nodes, also in elements.
void merge_connection_nodes(BuildContext& context);
void redirect_elements(BuildContext& context);
/// /TRANSFORM with SUBMODEL: directly after the nodes.
void apply_submodel_transforms(BuildContext& context);
/// Other /TRANSFORM: after all groups and sets, in deck order.
void apply_group_transforms(BuildContext& context);

/// Reports nodes whose final coordinates are unusable for distances.
void check_coordinates(BuildContext& context);

/// /RANDOM: the solver's noise on coordinates, for seed 0.
void apply_random_noise(BuildContext& context);

/// The id of a submodel plus the offsets of its ancestors.
inline std::int64_t submodel_id(const Deck& deck, const Submodel& s) {
  return s.id + (s.parent < 0 ? 0 : deck.submodels[static_cast<std::size_t>(s.parent)].submodels);
}

/// Number of up to four digits; -1: other text.
int number_of_digits(std::string_view digits);

/// Adds `index` to `map`. The first object of an id wins; a second one is a finding.
void register_id(BuildContext& context, std::map<std::int64_t, std::uint32_t>& map, std::int64_t id,
                 std::uint32_t index, const Block& block, Span first);
/// For an object that is appended to a list.
template <class T>
void add_object(BuildContext& context, std::vector<T>& list,
                std::map<std::int64_t, std::uint32_t>& map, const Block& block, T object) {
  const auto known = map.find(object.id);
  register_id(context, map, object.id, static_cast<std::uint32_t>(list.size()), block,
              known == map.end() ? Span{} : list[known->second].span);
  list.push_back(std::move(object));
}

}  // namespace deck::detail
