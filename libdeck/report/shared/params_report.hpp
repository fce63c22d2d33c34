// Effective values of all interfaces as text, CSV and JSON: value on the card, effective value,
// origin.
#pragma once
#include <string>
#include <string_view>

#include "deck/loaded_deck.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"

namespace deck {

template <>
inline constexpr std::size_t word_count<Origin> = 4;

struct ParamsInput {
  /// Origin::geometry values are unknown until the interface is resolved.
  const LoadedDeck& loaded;
  /// Gives values of a TYPE19's parts that differ from the interface; may be missing.
  const Scene* scene = nullptr;
};

struct ParamsTextOptions {
  bool color = false;
  /// Only fields on the card with a non-default value.
  bool changed_only = false;
  bool filled_in_only = false;     ///< only fields without value on the card
  std::vector<std::int64_t> only;  ///< interface ids; empty: all
  std::size_t width = 0;           ///< columns of a line; 0: any
  bool one_table = false;          ///< of the matrix: only columns that fit
};

/// One table per interface.
std::string params_text(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One row per interface, one column per field with a notable value in some of them; values not on
/// the card are in parentheses. Folded to the width.
std::string params_matrix(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One line per interface and field, RFC 4180.
std::string params_csv(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One line per interface with every field as a column, RFC 4180.
std::string params_matrix_csv(const ParamsInput& input, const ParamsTextOptions& options = {});
/// The document of `deck params --json` (schemas/output/params.schema.json).
std::string params_json(const ParamsInput& input, const std::vector<std::int64_t>& only = {});

/// Fields of one interface: table of field, card, value, origin and place.
TextTable params_table(const ParamsInput& input, const InterBase& inter,
                       const ParamsTextOptions& options = {});
/// A field of an interface: value on the card, effective value, origin.
struct ParameterRow {
  std::optional<Scalar> input, value;
  Origin origin = Origin::built_in;
  IfAny<Named<double>> by_role;
  std::optional<SourcePlace> source;
};
Record<ParameterRow> record_of(const ParameterRow*);
/// All fields of one interface. `input` and `inter` must outlive the result.
Named<ParameterRow> parameters_of(const ParamsInput& input, const InterBase& inter);
/// Value of a field as text: "0.5"; mesh-dependent values for every part of a TYPE19.
template <class T>
std::string effective_text(const ParamsInput& input, const InterBase& inter, std::string_view name,
                           const Effective<T>& field);

}  // namespace deck
