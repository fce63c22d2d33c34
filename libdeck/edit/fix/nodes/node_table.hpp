// Values of some nodes of a model, found by counting. Private to the stage.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "base/shared/vec.hpp"
#include "deck/model/model.hpp"

namespace deck::detail {

template <class T>
class NodeTable {
 public:
  bool contains(NodeIndex n) const { return n < place_.size() && place_[n] != no_index; }
  const T& at(NodeIndex n) const { return values_[place_.at(n)]; }
  /// Made if it is not there yet.
  T& operator[](NodeIndex n) { return emplace(n, T{}).first; }
  /// The value, and whether it is new.
  std::pair<T&, bool> emplace(NodeIndex n, T value) {
    if (n >= place_.size()) place_.resize(std::size_t{n} + 1 + n / 2, no_index);
    const bool fresh = place_[n] == no_index;
    if (fresh) {
      place_[n] = static_cast<std::uint32_t>(values_.size());
      values_.push_back(std::move(value));
    }
    return {values_[place_[n]], fresh};
  }

 private:
  std::vector<std::uint32_t> place_;  ///< by node; no_index: it has none
  std::vector<T> values_;
};

/// Some nodes of a model.
class NodeMarks {
 public:
  bool contains(NodeIndex n) const { return n < marked_.size() && marked_[n]; }
  bool empty() const { return count_ == 0; }
  void insert(NodeIndex n) {
    if (n >= marked_.size()) marked_.resize(std::size_t{n} + 1 + n / 2, false);
    count_ += !marked_[n];
    marked_[n] = true;
  }
  /// False: it was not there.
  bool erase(NodeIndex n) {
    if (!contains(n)) return false;
    marked_[n] = false;
    --count_;
    return true;
  }
  /// Ascending.
  std::vector<NodeIndex> all() const {
    std::vector<NodeIndex> out;
    out.reserve(count_);
    for (std::size_t n = 0; n < marked_.size(); ++n)
      if (marked_[n]) out.push_back(static_cast<NodeIndex>(n));
    return out;
  }

 private:
  std::vector<bool> marked_;
  std::size_t count_ = 0;
};

/// Moves of nodes, each once, ascending.
using NodeMoves = std::vector<std::pair<NodeIndex, Vec>>;

}  // namespace deck::detail
