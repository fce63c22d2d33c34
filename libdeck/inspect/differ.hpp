// Differ: compares two decks entity by entity, after every id of the first was translated. Its
// steps share the translation of ids and the list of changes: entities and penetrations (diff.cpp),
// values on cards (diff_values.cpp), members of groups (diff_members.cpp), the mesh
// (diff_mesh.cpp).
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

  /// At the headers of both.
  Change& add(ChangeKind kind, const DeckItem& a, const DeckItem* b, std::string field);
  void added_and_removed();
  /// A function that only one deck has, for uses that the other gives the same curve by another.
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
    Dimension dimension, effective_dimension;  ///< by the flags as written, and as they count
    std::string ref;
    bool counts = false;  ///< its default is a number that other units change
  };

  std::vector<FieldValue> fields_of(const DiffSide& side, const InterBase& inter) const;
  /// A value of the second deck in the working units of the first.
  DiffValue in_first_units(DiffValue v, const Dimension& d) const;
  /// What values of a dimension are measured against: lengths against the model.
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
    double size = 0;                ///< what the number is measured against
    std::optional<double> product;  ///< with what the solver multiplies it by
    const Field* field = nullptr;
  };

  struct Contents {
    std::map<CellKey, CellValue> cells;
    std::vector<CellKey> order;
    std::map<std::string, std::vector<std::pair<std::int64_t, std::string>>> lists;  // id, kind
    std::vector<std::pair<std::string, Span>> words;  ///< of lines that no schema describes
  };

  /// Scales whose line is missing are 1 as well.
  void absent_ones(const DiffSide& side, const DecodedBlock& d, const ImpliedOnes& ones,
                   bool rounded, Contents& out) const;
  Contents contents_of(const DiffSide& side, const Block& block) const;
  /// What the solver uses where nothing is written.
  static bool is_default(const CellValue& v);
  bool same_cell(const CellValue& x, const CellValue& y);
  void cells(const DeckItem& a, const DeckItem& b);
  bool same_word(const std::string& x, const std::string& y);
  void id_lists(const DeckItem& a, const DeckItem& b, const std::string& name, const Contents& ca,
                const Contents& cb);

  // members

  using Tuple = std::vector<NodeIndex>;  ///< nodes of a member, in the second deck's indices

  NodeIndex to_b(NodeIndex n) const;
  struct Member {
    Tuple nodes;
    std::int64_t id = 0;  ///< for people: of the node or of the element behind it
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

  /// What the group comes to, by name of the list.
  std::vector<std::pair<std::string, std::vector<Member>>> lists_of(const DiffSide& side,
                                                                    const DeckItem& item,
                                                                    std::string_view kind) const;
  void members(const DeckItem& a, const DeckItem& b, std::string_view kind);

  // nodes and elements

  Change& loose(ChangeKind kind, std::string group, std::string keyword, std::int64_t id);
  void nodes();
  /// A length of either deck, each in its own units.
  bool same_length(double x, double y);

  struct Tolerance {
    double length = 0;  ///< in working units of the first deck
    Span place;
  };

  /// Within these distances /CNODE merges its nodes with others.
  std::vector<Tolerance> tolerances_of(const DiffSide& side) const;
  void tolerances();

  struct PartElements {
    std::vector<std::int64_t> lost, gained, altered;
    std::int64_t before = 0, after = 0;
  };

  /// Elements by the part that has them, in the first deck where it is there.
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
  /// A deck that was renumbered is compared in vain by ids.
  void hint();
  void note_number_differences();

  /// Lines of moved nodes: found by reading again.
  static constexpr std::size_t most_places = 1000;

  const DiffSide& a_;
  const DiffSide& b_;
  const UnitSystem& units_a_;
  const UnitSystem& units_b_;
  bool other_units_;
  double length_;
  double extent_;  ///< of both models, in working units of the first
  EqualNumbers equal_;
  Counterparts pairs_;
  FunctionUses functions_;
  std::size_t ignored_ = 0;  ///< values that differ and are not used
  std::size_t placed_ = 0;
  DeckDiff out_;
};

}  // namespace deck::detail
