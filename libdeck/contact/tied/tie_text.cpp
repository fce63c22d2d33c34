// Counts and sentences about ties.
#include "contact/shared/reported.hpp"
#include "deck/contacts.hpp"

#include <fmt/format.h>

namespace deck {
namespace {

/// Reason why a node has no segment.
enum class MissReason { far, beyond_rim, box, nothing };

MissReason miss_of(const Tie& tie, const TiedNode& n) {
  if (n.missed) return MissReason::box;
  if (n.nearest == no_index) return MissReason::nothing;
  const double search = n.search != 0 ? n.search : tie.search_distance;
  return n.nearest_distance < search ? MissReason::beyond_rim : MissReason::far;
}

std::string not_found_text(const Tie& tie, const TiedNode& n) {
  const double search = n.search != 0 ? n.search : tie.search_distance;
  switch (miss_of(tie, n)) {
    case MissReason::box:
      return "A segment is within the search distance, but the solver does not look that far: it "
             "takes another shell's thickness for its search";
    case MissReason::nothing:
      return "The main side has no segment for the node";
    case MissReason::beyond_rim:
      return fmt::format(
          "The nearest segment is {:.6g} away, within {:.6g}, but the node lies farther beyond its "
          "rim than the solver accepts",
          n.nearest_distance, search);
    case MissReason::far:
      break;
  }
  return fmt::format("The nearest segment is {:.6g} away, the solver looks {:.6g} far",
                     n.nearest_distance, search);
}

}  // namespace

TieCounts count_ties(const Tie& tie) {
  TieCounts out;
  out.nodes = tie.nodes.size();
  for (const TiedNode& n : tie.nodes) {
    if (n.tied) {
      ++out.tied;
      if (n.message != 0) ++out.outside;
    } else if (n.removed_by != 0) {
      ++out.elsewhere;
    } else if (n.segment == no_index) {
      ++out.not_found;
    } else {
      ++out.dropped;
    }
  }
  return out;
}

std::string tie_count_text(const Tie& tie) {
  if (!tie.not_evaluated.empty()) return "not evaluated: " + tie.not_evaluated;
  const TieCounts n = count_ties(tie);
  const auto nodes = [](std::size_t k) { return fmt::format("{} node{}", k, k == 1 ? "" : "s"); };
  if (n.lost() > 0)
    return fmt::format("{} of {} {} not tied", n.lost(), nodes(n.nodes),
                       n.lost() == 1 ? "is" : "are");
  return fmt::format("{} {} tied", nodes(n.tied), n.tied == 1 ? "is" : "are");
}

std::string losses_text(const Tie& tie) {
  if (!tie.not_evaluated.empty()) return "not evaluated: " + tie.not_evaluated;
  const TieCounts n = count_ties(tie);
  std::string out;
  const auto add = [&](std::size_t of, const std::string& text) {
    if (of > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", of, text);
  };
  add(n.not_found, tie.ignore == 0 ? "not found: the solver stops" : "not found");
  add(n.dropped, "dropped");
  add(n.elsewhere, "held elsewhere");
  add(n.outside, "tied beyond a rim");
  add(tie.main_and_tied.size(), "main nodes tied: the solver stops");
  return out.empty() ? "-" : out;
}

std::string short_reason(const Tie& tie, const TiedNode& n) {
  if (n.removed_by != 0) return fmt::format("held elsewhere ({})", n.removed_by);
  if (n.tied) return n.message == 0 ? "tied" : fmt::format("tied beyond the rim ({})", n.message);
  const char* why = "far beyond the rim";
  if (n.segment == no_index) {
    static constexpr const char* words[] = {"too far", "beyond the rim", "missed by the solver",
                                            "no segment"};
    why = words[static_cast<std::size_t>(miss_of(tie, n))];
  }
  return n.message == 0 ? std::string(why) : fmt::format("{} ({})", why, n.message);
}

std::string why_text(const Tie& tie, const TiedNode& n) {
  if (!tie.not_evaluated.empty()) return "Not evaluated: " + tie.not_evaluated + ".";
  if (n.removed_by == 1630)
    return "An earlier interface already ties the node to this segment (1630).";
  if (n.removed_by == 1209)
    return "The node is a condensed mid node of a tetrahedron: it follows its edge (1209).";
  if (n.segment == no_index) {
    const std::string why = not_found_text(tie, n);
    if (n.message == 1078) return why + ": the solver stops (1078).";
    return n.message == 0 ? why + "."
                          : fmt::format("{}: the node is not tied ({}).", why, n.message);
  }
  if (!n.tied)
    return fmt::format("The node lies too far beyond the rim of its segment: it is not tied ({}).",
                       n.message);
  if (n.message != 0)
    return fmt::format("Tied, although the node lies beyond the rim of its segment ({}).",
                       n.message);
  return n.penalty ? "Tied by penalty." : "Tied.";
}

}  // namespace deck
