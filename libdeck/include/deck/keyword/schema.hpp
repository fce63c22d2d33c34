// Schema: what a keyword's cards look like — columns, types, dimensions, legal values, defaults and
// conditions per input version. The single source of truth is schemas/keywords/*.json.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck {

/// Exponents of mass, length, time and temperature. Half-integers do not occur.
struct Dimension {
  std::int8_t mass = 0, length = 0, time = 0, temperature = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
  bool dimensionless() const { return *this == Dimension{}; }
};

enum class FieldType : std::uint8_t {
  integer,  ///< whole number
  real,     ///< number, converted with its dimension
  text,     ///< raw columns, trailing blanks removed
  flag,     ///< one column, only the digit 1 counts
  id,       ///< integer that refers to another entity (see Field::ref)
};

/// A test on a field of the same block that was read on an earlier card or, for the condition of a
/// cell, on the same line.
struct Condition {
  /// Instead of a field: the number of data lines of the block, its title excluded.
  static constexpr std::string_view data_lines = "(data lines)";

  std::string field;
  std::vector<std::string> words;        ///< of a text cell: its text is one of these, in any case
  std::vector<std::int64_t> in;          ///< the value is one of these (empty: not tested)
  std::vector<std::int64_t> not_in;      ///< and none of these
  std::optional<std::int64_t> min, max;  ///< and within these bounds
  bool holds(std::int64_t value) const;
};

/// What else decides about the default of a field.
enum class DefaultVaries : std::uint8_t {
  no,
  deck,    ///< a card such as /DEFAULT/INTER/TYPE7 comes before the built-in number
  model,   ///< the kind of analysis or the size of the model, and perhaps such a card
  fields,  ///< other fields of the same card
};

/// What scales one axis of a function or table.
struct Axis {
  /// Real cells of the block whose product with the points counts. 0 or blank is 1 in the units of
  /// the block. Empty: nothing scales the points of this axis.
  std::vector<std::string> scales;
  Dimension dimension;  ///< of the points of an axis without scale
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
};

/// One fixed-column cell. Columns are 1-based and inclusive.
struct Field {
  std::string name;         ///< the manual's name, e.g. "Fscalegap"
  int first = 0, last = 0;  ///< columns
  FieldType type = FieldType::integer;
  std::string ref;  ///< for ids: kind of the target ("grnod", "surf", "node", ...)
  /// For ids: the solver stops with this message (0: number not known) where the target does not
  /// exist, has no member, or is not named at all. Without a value that is legal or not known.
  std::optional<int> missing, empty, required;
  int from = 0, until = 9999;        ///< input versions that have this cell
  std::vector<Condition> when;       ///< all must hold; a line all of whose cells fail is none
  std::vector<std::int64_t> values;  ///< legal values (empty: any)
  std::optional<double> min, max;    ///< legal range, inclusive
  bool min_open = false, max_open = false;  ///< the bound itself is not legal
  std::string default_text;  ///< the effective value of 0/blank, in words or a number
  /// The number that 0/blank stands for, where there is one; with default_varies the usual one.
  std::optional<double> default_value;
  DefaultVaries default_varies = DefaultVaries::no;
  Dimension dimension;
  bool dimension_known = true;  ///< false: unit conversion must refuse this field
  /// Dimension that depends on an integer field, first match wins.
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
  /// Dimension with which the solver itself brings the cell from the units of its block to working
  /// units, where that is not its physical one.
  std::optional<Dimension> solver_dimension;
  std::vector<Condition> solver_when;  ///< and these hold
  /// For ids of functions and tables: every axis, the ordinate last. Empty: not known.
  std::vector<Axis> axes;
  /// 0 or blank is 1 in the units of the block if one of these cells is not 0.
  std::vector<std::string> unit_for;
  /// The solver multiplies the number by the number in this cell (blank: 1), if `over_when` holds.
  std::string over;
  std::vector<Condition> over_when;
  bool ignored = false;     ///< the reference solver reads it and does nothing with it
  std::string doc;          ///< one line
  std::string from_manual;  ///< where manual and reference solver differ, one line
  /// What it is for and what the solver really does, for `explain`: paragraphs, and lines that
  /// begin with '|' and stand as they are (figures, without the '|').
  std::vector<std::string> help;
  std::string help_of;  ///< keyword whose field of the same name has the rest of the help
  /// For ids: the solver passes over the whole block where this one is 0, or where no block of the
  /// kind has a target.
  bool acts_on = false;
  std::vector<std::string> words;  ///< legal texts of a text cell (empty: any)
  /// The solver stops with this message (0: number not known) at a cell that is not legal: a flag
  /// other than 0 and 1, a text that is none of `words`.
  std::optional<int> wrong;
  bool in_version(int version) const { return version >= from && version <= until; }
};

enum class Repeat : std::uint8_t {
  once,
  rows,   ///< this card repeats to the end of the block
  ids,    ///< id list: cells of the last field's width to the end of every line
  group,  ///< this and the following cards marked `group` with the same count repeat together
};

/// One line of a block.
struct CardSchema {
  std::string name;             ///< what the card holds ("ids and flags", "friction")
  int from = 0, until = 9999;   ///< input versions that have this card
  std::vector<Condition> when;  ///< all must hold; empty: always present
  Repeat repeat = Repeat::once;
  /// How often a repeated card or group comes, or how many cells a list has: an integer field or a
  /// number. Empty: to the end of the block.
  std::string count;
  int per_line = 0;       ///< lists with a count: cells of a line
  bool words = false;     ///< lists: as many lines as do not begin with a number
  bool optional = false;  ///< may be missing at the end of the block without a complaint
  std::vector<Field> fields;
  std::string doc;
  bool in_version(int version) const { return version >= from && version <= until; }
  /// The line holds nothing, but a line of the block is taken for it.
  bool blank() const { return fields.empty(); }
};

struct Schema {
  std::string keyword;               ///< canonical, e.g. "/INTER/TYPE7"
  std::vector<std::string> aliases;  ///< e.g. "/PROP/TYPE1" for "/PROP/SHELL"
  std::string kind;       ///< entity kind whose ids it defines ("inter", "surf", ...); may be empty
  bool has_id = true;     ///< header carries an id
  bool has_title = true;  ///< a title line follows the header
  bool has_unit = true;   ///< header may carry a unit id after the id
  bool bulk = false;      ///< read by the fast path straight into arrays
  /// Described in part: lines after the described cards, and columns between the described cells,
  /// are legal and not interpreted.
  bool opaque_tail = false;
  /// With opaque_tail: every line and cell that the solver reads is described after all, for every
  /// version. Cells can be moved; what some of them mean is not interpreted.
  bool full_layout = false;
  int from = 0;  ///< first input version that knows the keyword
  std::string doc;
  std::vector<CardSchema> cards;
  std::string source;  ///< file name the schema came from
  /// Keywords with the same text here share their ids: the solver stops (error 79) where one is
  /// used twice. Empty: ids may repeat, or other tables take care of them.
  std::string unique;
  /// The solver stops with this message where the header names a unit system that does not exist;
  /// 0: it goes on. Without a value: see stops_without_unit().
  std::optional<int> unknown_unit;

  const Field* find_field(std::string_view name) const;
  /// Message with which the solver stops at a unit system that does not exist; 0: it goes on. If
  /// the schema does not say so, cells with a dimension decide. nullopt: not known.
  std::optional<int> stops_without_unit() const;
  /// True if no line and no column of the block has a meaning that the cards do not tell.
  bool layout_known() const { return !opaque_tail || full_layout; }
};

/// All known schemas and the longest-prefix lookup of header lines.
class SchemaSet {
 public:
  /// The schemas compiled into the library. Never fails in a correct build (tested).
  static const SchemaSet& built_in();
  /// Adds or replaces schemas from one JSON text. Error: where and what is wrong.
  Result<void> add_json(std::string_view name, std::string_view text);
  /// Adds every *.json of a directory, in name order.
  Result<void> add_directory(const std::string& dir);

  /// Schema whose keyword or alias is the longest prefix (by header fields) of `header`
  /// ("/SURF/PART/EXT/12"); nullptr if none.
  const Schema* match(std::string_view header) const;
  const Schema* find(std::string_view keyword) const;  ///< exact keyword or alias
  /// Every schema once, ordered by keyword.
  std::vector<const Schema*> all() const;

 private:
  struct Entry;  ///< one schema; the built-in ones are parsed when they are first asked for
  std::map<std::string, std::shared_ptr<const Entry>, std::less<>> by_name_;
};

}  // namespace deck
