// Differ: state of a comparison of two decks (diff.cpp): translation of ids and list of changes.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "inspect/match.hpp"
#include "inspect/shared/diff.hpp"
#include "keyword/shared/decode_parts.hpp"

namespace deck::detail {

class Differ {
 public:
  Differ(const DiffSide& a, const DiffSide& b, MatchBy match, double tolerance);

  DeckDiff run();

 private:
  static constexpr Dimension length_dimension{0, 1, 0, 0};

  /// Adds a change at the headers of both.
  Change& add(ChangeKind kind, const DeckItem& a, const DeckItem* b, std::string field);
  void added_and_removed();
  /// True for a function of one deck whose uses have an equal curve by another function in the
  /// other deck.
  bool only_a_copy(const DiffSide& side, const DeckItem& item) const;

  // one entity

  void item(const DeckItem& a, const DeckItem& b);
  // contacts

  struct FieldValue {
    std::string name;
    DiffValue input, effective;
    bool has_input = false;
    std::string why;
    Span span;
    Dimension dimension, effective_dimension;  ///< by the written and by the effective flags
    std::string ref;
    bool counts = false;  ///< its default is a number that other units change
  };

  std::vector<FieldValue> fields_of(const DiffSide& side, const InterBase& inter) const;
  /// Converts a value of the second deck to working units of the first.
  DiffValue in_first_units(DiffValue v, const Dimension& d) const;
  /// Scale for comparing values of a dimension: lengths are compared relative to the model.
  double size_of(const Dimension& d) const;
  bool same_value(const DiffValue& x, const DiffValue& y, std::string_view ref, double size,
                  bool rounded);
  bool same_id(std::string_view kind, std::int64_t x, std::int64_t y) const;
  void contact(const DeckItem& a, const DeckItem& b, const InterBase& ia, const InterBase& ib);

  // cells

  struct CellValue {
    DiffValue value;
    std::string ref;
    Span span;
    bool rounded = false;
    double size = 0;                ///< scale for comparing the number
    std::optional<double> product;  ///< number times the cell that multiplies it
    const Field* field = nullptr;
  };

  struct Contents {
    std::map<CellKey, CellValue> cells;
    std::vector<CellKey> order;
    std::map<std::string, std::vector<std::pair<std::int64_t, std::string>>> lists;  // id, kind
    std::vector<std::pair<std::string, Span>> words;  ///< of lines without schema
  };

  /// Scales on missing lines are 1 too.
  void absent_ones(const DiffSide& side, const DecodedBlock& d, const ImpliedOnes& ones,
                   bool rounded, Contents& out) const;
  Contents contents_of(const DiffSide& side, const Block& block) const;
  /// True if the solver uses this value for a blank cell.
  static bool is_default(const CellValue& v);
  bool same_cell(const CellValue& x, const CellValue& y);
  void cells(const DeckItem& a, const DeckItem& b);
  bool same_word(const std::string& x, const std::string& y);
  void id_lists(const DeckItem& a, const DeckItem& b, const std::string& name, const Contents& ca,
                const Contents& cb);

  // members

  using Tuple = std::vector<NodeIndex>;  ///< nodes of a member, as indices of the second deck

  NodeIndex to_b(NodeIndex n) const;
  struct Member {
    Tuple nodes;
    std::int64_t id = 0;  ///< id of the node or element, for messages
    friend bool operator<(const Member& x, const Member& y) { return x.nodes < y.nodes; }
  };

  template <class Items, class F>
  std::vector<Member> by_nodes(const DiffSide& side, const Items& list, F&& in_order) const;
  std::vector<Member> segments(const DiffSide& side, const std::vector<Segment>& list) const;
  std::vector<Member> edges(const DiffSide& side, const std::vector<Edge>& list) const;
  std::vector<Member> nodes(const DiffSide& side, const std::vector<NodeIndex>& list) const;
  std::vector<Member> items(const DiffSide& side, ElementKind kind,
                            const std::vector<std::uint32_t>& list) const;
  std::vector<Member> parts(const DiffSide& side, const std::vector<std::uint32_t>& list) const;

  /// Members of a group by name of the list.
  std::vector<std::pair<std::string, std::vector<Member>>> lists_of(const DiffSide& side,
                                                                    const DeckItem& item,
                                                                    std::string_view kind) const;
  void members(const DeckItem& a, const DeckItem& b, std::string_view kind);

  // nodes and elements

  Change& loose(ChangeKind kind, std::string group, std::string keyword, std::int64_t id);
  void nodes();
  /// Compares lengths of both decks, each in its own units.
  bool same_length(double x, double y);

  struct Tolerance {
    double length = 0;  ///< in working units of the first deck
    Span place;
  };

  /// Merging distances of /CNODE.
  std::vector<Tolerance> tolerances_of(const DiffSide& side) const;
  void tolerances();

  struct PartElements {
    std::vector<std::int64_t> lost, gained, altered;
    std::int64_t before = 0, after = 0;
  };

  /// Compares elements by part (of the first deck if it has the part).
  void elements();
  bool same_element(const Elements& fa, std::uint32_t e, const Elements& fb, std::uint32_t f);
  bool same_mid_nodes(const Elements& fa, std::uint32_t e, const Elements& fb,
                      std::uint32_t f) const;

  using RowCells = std::vector<ElementCell>;

  static const RowCells& cells_of(const ElementCells& all, ElementKind kind, std::uint32_t e);
  /// Angles and directions have no dimension.
  bool same_cells(const RowCells& x, const RowCells& y);

  // penetrations

  struct Depth {
    std::int64_t interface_id = 0;
    std::array<std::int64_t, 2> secondary{};
    double depth = 0, gap = 0;
  };
  using PenetrationKey = std::tuple<std::int64_t, std::string, std::array<std::int64_t, 2>>;

  std::map<PenetrationKey, Depth> deepest(const DiffSide& side) const;
  void penetrations();
  /// Notes that a renumbered deck cannot be compared by ids.
  void hint();
  void note_number_differences();

  /// Lines of moved nodes are found by reading again.
  static constexpr std::size_t most_places = 1000;

  const DiffSide& a_;
  const DiffSide& b_;
  const UnitSystem& units_a_;
  const UnitSystem& units_b_;
  bool other_units_;
  double length_;
  double extent_;  ///< of both models, in working units of the first deck
  EqualNumbers equal_;
  Counterparts pairs_;
  FunctionUses functions_;
  std::size_t ignored_ = 0;  ///< differing values that are not used
  std::size_t placed_ = 0;
  DeckDiff out_;
};

}  // namespace deck::detail
