// Actions of Inacti and Fpenmax on initial penetrations, in the solver's order.
#include "contact/rules/actions.hpp"

#include <algorithm>
#include <cmath>

namespace deck {

namespace {

/// Names of an action: in documents; in text for one pair and for several.
struct ActionName {
  const char *code, *one, *many;
};
constexpr ActionName action_names[penetration_actions] = {
    {"none", "nothing", "nothing"},
    {"node-stiffness-zero", "node switched off", "nodes switched off"},
    {"segment-stiffness-zero", "segment switched off", "segments switched off"},
    {"node-moved", "node moved", "nodes moved"},
    {"gap-reduced", "gap reduced", "gaps reduced"},
    {"edge-stiffness-zero", "edge switched off", "edges switched off"},
    {"ignored", "ignored", "ignored"},
    {"offset-stored", "stored as an offset", "stored as offsets"},
    {"initial-force", "initial force", "initial forces"},
    {"removed-tied", "held by a tie", "held by ties"},
    {"error-611", "stops: error 611", "stop: error 611"},
    {"error-612", "stops: error 612", "stop: error 612"}};

}  // namespace

const char* action_words(PenetrationAction action, std::size_t pairs) {
  const ActionName& name = action_names[static_cast<std::size_t>(action)];
  return pairs == 1 ? name.one : name.many;
}

const char* to_string(PenetrationAction action) {
  return action_names[static_cast<std::size_t>(action)].code;
}

namespace detail {
namespace {

constexpr std::size_t group_size = 128;
constexpr double inflation = 1e-8;  // keeps a repaired pair just outside the gap

/// Penetration that Inacti 5 and 6 store.
double stored(int inacti, double pene, double gap) {
  return inacti == 5 ? pene : pene + 0.05 * (gap - pene);
}

}  // namespace

bool CandidateGroup::begins_another() {
  if (count_++ < group_size) return false;
  count_ = 1;
  return true;
}

Vec CandidateGroup::start_of(const MovableNodes& x, std::uint32_t node) {
  // Candidates are sorted by secondary node: nearly always the last one.
  for (auto it = seen_.rbegin(); it != seen_.rend(); ++it)
    if (it->first == node) return it->second;
  seen_.emplace_back(node, x.at(node));
  return seen_.back().second;
}

void act_on_node(int inacti, double fpenmax, PenetrationRow& row, const MovableNodes& x,
                 std::uint32_t node, CandidateGroup& group) {
  const double pene = row.on_surface ? row.depth : row.depth * (1 + inflation);
  if (fpenmax != 0 && pene > fpenmax * row.gap) {
    row.action = PenetrationAction::node_stiffness_zero;
    return;
  }
  switch (inacti) {
    case 1:
      row.action = PenetrationAction::node_stiffness_zero;
      break;
    case 2:
      row.action = PenetrationAction::segment_stiffness_zero;
      break;
    case 3: {
      row.action = PenetrationAction::node_moved;
      const Vec start = group.start_of(x, node);
      const Vec moved = x.at(node) - start;
      if (pene > norm(moved)) {
        row.moved_by = {pene * row.normal[0], pene * row.normal[1], pene * row.normal[2]};
        x.put(node, start + Vec{row.moved_by[0], row.moved_by[1], row.moved_by[2]});
      }
      break;
    }
    case 5:
    case 6:
      row.action = PenetrationAction::gap_reduced;
      row.p0 = stored(inacti, pene, row.gap);
      row.gap0 = row.gap - row.p0;
      row.has_gap0 = true;
      break;
    default:
      break;
  }
}

void act_on_type24_25(int type, int inacti, PenetrationRow& row) {
  constexpr double tiny = 1e-8;
  row.action = inacti == 0   ? PenetrationAction::ignored
               : inacti == 5 ? PenetrationAction::offset_stored
                             : PenetrationAction::initial_force;
  const bool all = inacti == 5 || (type == 24 && inacti == -1);
  row.p0 = all || (inacti == 0 && row.depth <= tiny) ? row.depth : 0;
}

int on_surface_error(int type, int itied, double fpenmax, int inacti) {
  if (fpenmax != 0 || inacti == 1 || inacti == 2) return 0;
  if (type == 10 && itied != 0) return 0;
  return inacti == 0 ? 612 : 611;
}

void act_on_edges(int inacti, PenetrationRow& row, double& secondary_store, double& main_store) {
  // Only Inacti 6 uses the penetration unchanged.
  const double pene = inacti == 6 ? row.depth : row.depth * (1 + inflation);
  switch (inacti) {
    case 1:
    case 2:
      row.action = PenetrationAction::edge_stiffness_zero;
      break;
    case 5:
    case 6: {
      if (pene >= 0.995 * row.gap) {
        row.action = PenetrationAction::edge_stiffness_zero;
        break;
      }
      row.action = PenetrationAction::gap_reduced;
      const double p = stored(inacti, pene, row.gap);
      secondary_store = std::max(secondary_store, 0.5 * p);
      main_store = std::max(main_store, 0.5 * p);
      break;
    }
    default:
      break;
  }
}

void complete_edge_row(PenetrationRow& row, double secondary_store, double main_store) {
  if (row.action != PenetrationAction::gap_reduced) return;
  row.p0 = secondary_store + main_store;
  row.gap0 = row.gap - row.p0;
  row.has_gap0 = true;
}

}  // namespace detail
}  // namespace deck
