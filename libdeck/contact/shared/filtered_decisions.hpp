// One pair judged as the chosen accuracy asks: is it in contact, does the solver think so too, and
// with which figures. Counts where the two disagree.
#pragma once

#include <array>

#include "contact/shared/filtered.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

/// What is known about one pair. `row` has its figures if either answer is yes.
struct PairVerdict {
  bool in_contact = false;   ///< by the chosen accuracy
  bool solver_acts = false;  ///< the arithmetic whose consequences the scene follows says so
  bool differs = false;      ///< the two are not the same, or not the same on "exactly on it"
  PenetrationRow row;
  /// A penetration, of the pair or of the solver's arithmetic only.
  bool is_row() const { return in_contact || solver_acts; }
  DecisionDifference difference;  ///< valid if `differs`; action and positions are the caller's
};

class PairJudge {
 public:
  PairJudge(Accuracy accuracy, DecisionReport& report) : accuracy_(accuracy), report_(report) {
    report_.mode = accuracy;
  }
  ~PairJudge();
  PairJudge(const PairJudge&) = delete;
  PairJudge& operator=(const PairJudge&) = delete;

  /// Conventions of closest_on_segment; `gap` the pair gap.
  PairVerdict judge(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                    bool triangle, double gap);
  /// Conventions of closest_between_edges; `x` both nodes of the secondary, then of the main edge.
  PairVerdict judge(const std::array<Point3<double>, 4>& x, double gap);

  /// Keeps a difference for the report; only the first of them are listed.
  void note(const DecisionDifference& difference);

 private:
  template <class Exact>
  PairVerdict combine(const PenetrationRow& solver, bool touching, double gap, bool closer,
                      const Exact& exact_row);

  Accuracy accuracy_;
  DecisionReport& report_;
  FilterCounters counters_;
};

/// Adds the decisions about one contact to those of all; `place`: its own among them.
void add_decisions(const DecisionReport& in, std::size_t place, DecisionReport& all);

}  // namespace deck::detail
