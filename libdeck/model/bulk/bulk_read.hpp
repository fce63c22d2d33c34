// Reads a chunk: clean lines by columns, others by decode_line(). A line is clean if every cell is
// a plain number and nothing is outside of cells. Findings are only counted; messages are formed
// later in deck order, if wanted.
//
// Most lines have the form of the line before: UsualLine keeps the number of ids (ten columns) and
// reals (twenty columns), so a line of that length is read without a loop over its cells. O(bytes).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/bulk/bulk.hpp"
#include "text/shared/number_scan.hpp"

namespace deck::detail {

/// Rules of a bulk line: first those of any data line.
enum BulkRule : std::uint8_t {
  blank_line = static_cast<std::uint8_t>(LineRule::none),
  bad_id,
  sh3n_columns,
  incomplete,
  unknown_node,
  bulk_rules,
};
RuleId bulk_rule_id(std::size_t rule);

/// A line that is not clean.
struct Problem {
  std::uint64_t offset = 0;   ///< of the line
  std::int64_t item = 0;      ///< id of the item, as written
  std::uint32_t segment = 0;  ///< index in the chunk
  std::uint8_t card = 0;
  std::uint8_t required = 0;  ///< number of leading nodes that must exist
  bool decoded = false;       ///< read by decode_line(); the findings of its cells are not counted
  std::array<std::uint8_t, bulk_rules> counts{};
};

/// Values of one line, by cell.
struct Cells {
  std::int64_t integer[max_cells];
  double real[max_cells];
};

/// The lines of one item.
struct BulkItem {
  Cells line[max_cards];
  std::string_view text[max_cards];
  Problem problem[max_cards];
  bool has_problem[max_cards] = {};
  std::uint8_t required = 0;  ///< number of leading nodes that must exist

  std::int64_t integer(CellAt at) const { return at.present ? line[at.card].integer[at.cell] : 0; }
  double real(CellAt at) const { return at.present ? line[at.card].real[at.cell] : 0.0; }
  /// The problem record of a line, created on first use.
  Problem& problem_of(std::size_t card) {
    if (!has_problem[card]) problem[card] = {};
    has_problem[card] = true;
    return problem[card];
  }
  void count(std::size_t card, std::uint8_t rule) {
    problem_of(card);
    auto& n = problem[card].counts[rule];
    if (n < 255) ++n;
  }
  /// A blank line is a line of zeros.
  void count_bad_id() { count(0, text[0].empty() ? blank_line : bad_id); }
};

/// Bit i: cell i is unclean; highest bit: text outside of cells.
using Unclean = std::uint32_t;
inline constexpr Unclean outside_cells = Unclean{1} << 31;

/// Reads the cells of a line without trailing blanks. Unclean cells need inspect_line().
inline Unclean read_cells(const CardPlan& plan, const char* line, std::uint32_t size, Cells& out) {
  Unclean unclean = 0;
  const CellPlan* const cells = plan.cells.data();
  const std::size_t count = plan.cells.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CellPlan cell = cells[i];
    if (cell.first >= size) {
      out.integer[i] = 0;
      out.real[i] = 0;
      continue;
    }
    const char* const first = line + cell.first;
    const char* const last = line + std::min(cell.last, size);
    if (cell.real) {
      if (last - first >= 16 && scan_plain_real(first, last, out.real[i])) continue;
      const RealCell r = scan_real<Blanks::spaces>(first, last);
      out.real[i] = r.value;
      // Subnormal numbers have their own finding.
      const bool tiny = r.value != 0 && std::fabs(r.value) < std::numeric_limits<double>::min();
      unclean |= static_cast<Unclean>(r.status > NumberStatus::blank || tiny) << i;
      continue;
    }
    std::uint64_t plain;
    if (last - first >= 8 && scan_plain_integer(first, last, plain)) {
      out.integer[i] = static_cast<std::int64_t>(plain);
      continue;
    }
    const IntegerCell n = scan_integer<Blanks::spaces>(first, last);
    out.integer[i] = saturated(n.value);
    unclean |= static_cast<Unclean>(narrowed(n) > NumberStatus::blank) << i;
  }
  bool clean = true;
  for (const auto& [first, last] : plan.gaps)
    for (std::uint32_t c = first; c < std::min(last, size); ++c) clean = clean && line[c] == ' ';
  for (std::uint32_t c = plan.last; c < size; ++c) clean = clean && line[c] == ' ';
  return clean ? unclean : unclean | outside_cells;
}

/// Form of clean lines with the length of the previous one: ids of ten columns, then reals of
/// twenty up to the end; or another form.
struct UsualLine {
  std::uint32_t size = 0;  ///< 0: none
  std::uint32_t ids = 0, reals = 0;
  enum { not_looked_at, even, uneven } layout = not_looked_at;

  void learn_cells(const CardPlan& plan);
};

/// Reads a line of the usual form; later cells keep their values. False: use read_cells().
inline bool read_even_line(const UsualLine& usual, const char* p, Cells& out) {
  std::uint64_t unlike = 0;
  for (std::uint32_t i = 0; i < usual.ids; ++i, p += 10) {
    std::uint64_t id;
    unlike |= unlike_id(p, id);
    out.integer[i] = static_cast<std::int64_t>(id);
  }
  if (unlike != 0) return false;
  for (std::uint32_t i = 0; i < usual.reals; ++i, p += 20)
    if (!scan_plain_twenty(p, out.real[usual.ids + i])) return false;
  return true;
}

/// Reads the unclean cells of a line and finds its problems as decode_line() does; calls it for
/// lines with commas or parameters.
void inspect_line(const Deck& deck, const BlockPlan& plan, std::size_t card, std::uint32_t file,
                  Unclean unclean, BulkItem& item);

/// Reports a problem line, using decode_line() for its cells.
void report_problem(const Deck& deck, const BlockPlan& plan, std::uint32_t file,
                    const Problem& problem, const Nodes* nodes, Findings& findings);

/// Node number (0: N1) of a cell; -1: not a node.
int node_of_cell(const ItemPlan& plan, std::size_t card, std::size_t cell);

bool sh3n_left_columns(std::string_view line);
/// True if a number in columns 81-90 of a /SH3N line is probably (the start of) the thickness:
/// manuals start it in column 81, the solver reads 91-100.
inline bool sh3n_thickness_left(std::string_view line) {
  return line.size() > 80 && sh3n_left_columns(line);
}

/// Calls sink.item(plan, segment, item) for all items; problem lines go to sink.problems in order.
template <class Sink>
void read_chunk(const Deck& deck, const std::vector<BlockPlan>& plans, const Chunk& chunk,
                Sink& sink) {
  BulkItem item;
  std::size_t card = 0;
  std::array<UsualLine, max_cards> usual_lines{};
  const ItemPlan* usual_plan = nullptr;
  for (std::uint32_t s = 0; s < chunk.segments.size(); ++s) {
    const TextSegment& segment = chunk.segments[s];
    const BlockPlan& plan = plans[segment.plan];
    const std::vector<CardPlan>& cards = plan.item->cards;
    if (usual_plan != plan.item.get()) usual_lines = {};
    usual_plan = plan.item.get();
    const char* const data = deck.sources[segment.file].bytes().data();
    const char* p = data + segment.begin;
    const char* const end = data + segment.end;
    const auto flush = [&](std::size_t lines) {
      for (std::size_t c = 0; c < lines; ++c) {
        if (!item.has_problem[c]) continue;
        Problem& problem = item.problem[c];
        problem.offset = static_cast<std::uint64_t>(item.text[c].data() - data);
        problem.segment = s;
        problem.card = static_cast<std::uint8_t>(c);
        problem.required = item.required;
        problem.item = item.integer(plan.item->id);
        sink.problems.push_back(problem);
        item.has_problem[c] = false;
      }
    };
    while (p < end) {
      const char* const start = p;
      const bool comment = *start == '#' || *start == '$';
      // Most lines are as long as the line before. If all bytes up to that length are clean, no
      // line end is among them.
      UsualLine& usual = usual_lines[card];
      const auto as_usual = [&](std::uint32_t size) {
        if (comment || size == 0 || end - start <= static_cast<std::ptrdiff_t>(size) ||
            start[size] != '\n')
          return false;
        if (usual.layout == UsualLine::not_looked_at) usual.learn_cells(cards[card]);
        if (usual.layout == UsualLine::even && read_even_line(usual, start, item.line[card]))
          return true;
        return !is_blank(start[size - 1]) &&
               read_cells(cards[card], start, size, item.line[card]) == 0;
      };
      if (const std::uint32_t size = usual.size; as_usual(size)) {
        item.text[card] = {start, size};
        p = start + size + 1;
      } else {
        const void* const nl = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
        const char* stop = nl == nullptr ? end : static_cast<const char*>(nl);
        p = stop + 1;
        if (comment) continue;
        while (stop != start && is_blank(stop[-1])) --stop;
        const auto length =
            static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(stop - start, 1 << 30));
        item.text[card] = {start, length};
        usual = {};
        const Unclean unclean = read_cells(cards[card], start, length, item.line[card]);
        if (unclean != 0)
          inspect_line(deck, plan, card, segment.file, unclean, item);
        else
          usual.size = length;
      }
      if (++card < cards.size()) continue;
      card = 0;
      sink.item(plan, s, item);
      flush(cards.size());
    }
    if (segment.block_ends && card != 0) {
      item.count(card - 1, incomplete);
      flush(card);
      card = 0;
    }
  }
}

}  // namespace deck::detail
