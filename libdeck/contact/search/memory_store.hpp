// What a SearchMemory holds, and the inputs it is found by. Private to the library.
#pragma once
#include <array>
#include <memory>

#include "base/bits.hpp"
#include "base/known_inputs.hpp"
#include "contact/distance/filtered_decisions.hpp"
#include "deck/contact/search_memory.hpp"

namespace deck {
namespace detail {

/// Candidates of a contact: what the solver's search gives, and what only an exact distance finds.
struct Candidates {
  std::vector<CandidatePair> pairs;  // both, sorted
  std::vector<CandidatePair> extra;  // the second kind: not counted as candidates
  bool complete = true;

  bool is_counted(const CandidatePair& pair) const {
    return !std::binary_search(extra.begin(), extra.end(), pair);
  }
};

/// The verdicts of some pairs in a row: those with a penetration or a difference.
struct JudgedPairs {
  std::vector<PairVerdict> verdicts;
  DecisionReport report;
};

/// The candidates of a contact with all verdicts, as far as they follow from places, sides and
/// gaps: before anything is acted upon.
struct JudgedContact {
  Candidates found;
  JudgedPairs judged;
  std::size_t bytes() const {
    return sizeof(JudgedContact) +
           (found.pairs.size() + found.extra.size()) * sizeof(CandidatePair) +
           judged.verdicts.size() * sizeof(PairVerdict);
  }
};

/// The input of a search in one piece after the other, with a head that holds what is no array and
/// the lengths of the arrays: one word each, so that no padding is compared. `more` is what else
/// decides about the result.
template <std::size_t More>
class SearchBytes {
 public:
  SearchBytes(const NodeSegmentInput& in, const SearchOptions& options,
              const std::array<std::uint64_t, More>& more)
      : SearchBytes(0, options, more,
                    {InputBytes(), std::as_bytes(in.nodes.x), std::as_bytes(in.nodes.y),
                     std::as_bytes(in.nodes.z), std::as_bytes(in.secondary),
                     std::as_bytes(in.secondary_gap), std::as_bytes(in.secondary_length),
                     std::as_bytes(in.secondary_stiffness), std::as_bytes(in.segments),
                     std::as_bytes(in.segment_gap), std::as_bytes(in.segment_length),
                     std::as_bytes(in.segment_stiffness)}) {}
  SearchBytes(const EdgeEdgeInput& in, const SearchOptions& options,
              const std::array<std::uint64_t, More>& more)
      : SearchBytes(1, options, more,
                    {InputBytes(), std::as_bytes(in.nodes.x), std::as_bytes(in.nodes.y),
                     std::as_bytes(in.nodes.z), std::as_bytes(in.secondary),
                     std::as_bytes(in.secondary_gap), std::as_bytes(in.secondary_length),
                     std::as_bytes(in.secondary_stiffness), std::as_bytes(in.main),
                     std::as_bytes(in.main_gap), std::as_bytes(in.main_length),
                     std::as_bytes(in.main_stiffness)}) {}
  SearchBytes(const SearchBytes&) = delete;
  SearchBytes& operator=(const SearchBytes&) = delete;

  operator std::span<const InputBytes>() const { return pieces_; }

 private:
  static constexpr std::size_t arrays = 11;

  SearchBytes(std::uint64_t kind, const SearchOptions& o,
              const std::array<std::uint64_t, More>& more,
              const std::array<InputBytes, arrays + 1>& pieces)
      : pieces_(pieces) {
    std::size_t at = 0;
    head_[at++] = kind << 32 | static_cast<std::uint64_t>(o.form);
    head_[at++] = static_cast<std::uint64_t>(o.gap.rule);
    for (const double v : {o.gap.gapmin, o.gap.gapmax, o.drad, o.margin})
      head_[at++] = bit_cast<std::uint64_t>(v);
    for (const std::uint64_t word : more) head_[at++] = word;
    for (std::size_t k = 1; k <= arrays; ++k) head_[at++] = pieces_[k].size();
    pieces_[0] = std::as_bytes(std::span(head_));
  }

  std::array<std::uint64_t, 6 + More + arrays> head_{};
  std::array<InputBytes, arrays + 1> pieces_;
};

}  // namespace detail

struct SearchMemory::Store {
  explicit Store(std::size_t bytes) : searches(bytes), contacts(bytes) {}
  KnownInputs<std::vector<CandidatePair>> searches;
  KnownInputs<std::shared_ptr<const detail::JudgedContact>> contacts;
  std::size_t hits = 0, misses = 0;
};

}  // namespace deck
