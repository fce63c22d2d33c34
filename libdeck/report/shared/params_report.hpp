// The effective values of all interfaces, for people and for programs: what the card says, what the
// solver uses, and where that came from.
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
  /// Values of Origin::geometry are unknown where the interface is not resolved.
  const LoadedDeck& loaded;
  /// Says what the parts of a TYPE19 have where they differ from the interface; may be missing.
  const Scene* scene = nullptr;
};

struct ParamsTextOptions {
  bool color = false;
  /// Only fields that are on the card and not the default.
  bool changed_only = false;
  bool filled_in_only = false;     ///< only fields whose value does not stand on the card
  std::vector<std::int64_t> only;  ///< interface ids; empty: all
  std::size_t width = 0;           ///< columns of a line; 0: any
  bool one_table = false;          ///< of the matrix: only the columns that have room
};

/// One table per interface.
std::string params_text(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One row per interface, one column per field that has a value of interest in some of them; values
/// that do not stand on the card are in parentheses. Folded to the width.
std::string params_matrix(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One line per interface and field, RFC 4180.
std::string params_csv(const ParamsInput& input, const ParamsTextOptions& options = {});
/// One line per interface with every field as a column, RFC 4180.
std::string params_matrix_csv(const ParamsInput& input, const ParamsTextOptions& options = {});
/// The document of `deck params --json` (schemas/output/params.schema.json).
std::string params_json(const ParamsInput& input, const std::vector<std::int64_t>& only = {});

/// Fields of one interface as a table of field, card, value, origin and place.
TextTable params_table(const ParamsInput& input, const InterBase& inter,
                       const ParamsTextOptions& options = {});
/// A field of an interface: what the card says, what the solver uses, and where that is from.
struct ParameterRow {
  std::optional<Scalar> input, value;
  Origin origin = Origin::built_in;
  IfAny<Named<double>> by_role;
  std::optional<SourcePlace> source;
};
Record<ParameterRow> record_of(const ParameterRow*);
/// All fields of one interface. `input` and `inter` must outlive the result.
Named<ParameterRow> parameters_of(const ParamsInput& input, const InterBase& inter);
/// Value of a field for people: "0.5"; where the geometry decides, of every part of a TYPE19.
template <class T>
std::string effective_text(const ParamsInput& input, const InterBase& inter, std::string_view name,
                           const Effective<T>& field);

}  // namespace deck
