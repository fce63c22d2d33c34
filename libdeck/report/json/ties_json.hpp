// Ties of /INTER/TYPE2 in documents.
#pragma once
#include "deck/contact/ties.hpp"
#include "report/record.hpp"

namespace deck {

Record<RepeatedTies> record_of(const RepeatedTies*);
Record<TieCounts> record_of(const TieCounts*);
/// With `all` every secondary node, else those that are not tied or that the solver lists.
struct TieRow {
  const Model& model;
  bool all = false;
  const Tie* tie;
};
Record<TieRow> record_of(const TieRow*);

}  // namespace deck
