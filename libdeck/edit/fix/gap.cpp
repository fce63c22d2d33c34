// Strategy reduce-gap: finds the largest gap without a penetration, with few digits.
// Repeat until no pair penetrates (at most `most_rounds` times): evaluate the contacts; each
// penetrating pair lowers the field that sets its gap (Gapmin, the scale or the cap) to its
// distance, rounded down. Scale and cap are tried separately; the one that keeps more of the gap is
// written.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/shared/words.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"

namespace deck {
namespace {

using namespace detail;

/// Every round lowers a bound to an existing distance. More rounds mean that pairs keep changing
/// (curvilinear removal with smaller gaps).
constexpr int most_rounds = 40;

/// A field to lower: its cell, present value, new value.
struct GapField {
  std::string name;
  std::optional<FieldPlace> place;
  std::string missing;  ///< reason why there is no cell
  /// TYPE24 and TYPE25: cells of sides whose present value is larger.
  struct Side {
    FieldPlace place;
    double present = 0;
  };
  std::vector<Side> sides;
  double present = 0;  ///< working units
  std::optional<RoundedText> text;
  double value = 0;  ///< working units, as the text reads

  /// Lowers to at most `bound`; false if no text fits.
  bool lower(double bound, int digits) {
    if (!place) return false;
    const std::optional<double> below = text ? std::optional<double>(text->value) : std::nullopt;
    // The product with the unit factor may round up: step down until it does not.
    auto next = round_down(bound / place->factor, digits, place->width(), below);
    for (int i = 0; next && next->value * place->factor > bound && i < 8; ++i)
      next = round_down(bound / place->factor, digits, place->width(), next->value);
    if (!next || next->value * place->factor > bound) return false;
    text = next;
    value = next->value * place->factor;
    return true;
  }
};

/// Field that lowers the gap from thickness.
enum class LoweredField { none, scale, cap };

class GapReduction {
 public:
  GapReduction(const LoadedDeck& context, const ReduceGapOptions& options, const InterBase& inter)
      : context_(&context), options_(&options), inter_(&inter) {
    gapmin_ = gap_field(traits_of(inter).gap);
    scale_ = gap_field(rules_.scale);
    cap_ = gap_field(rules_.caps[0]);
    igap_ = visit_interface(inter, [](const auto& i) {
      if constexpr (
          requires { i.Fscalegap; } || requires { i.line_IDs; })
        return i.Igap.value == 1000 ? 0 : static_cast<int>(i.Igap.value);
      else
        return 0;
    });
    visit_interface(inter, [&](const auto& i) {
      if constexpr (requires { i.Fscalegap; }) {
        scale_.present = igap_ >= 2 && i.Fscalegap.value != 0 ? i.Fscalegap.value : 1;
        edge_scale_ = 1;
      }
      if constexpr (requires { i.Edge_scale_gap; })
        if (i.Edge_scale_gap.value != 0) edge_scale_ = i.Edge_scale_gap.value;
      if constexpr (requires { i.Gap_max_s; }) add_sides({i.Gap_max_s.value, i.Gap_max_m.value});
      if constexpr (requires { i.Gap_scale; }) {
        scale_.present = i.Gap_scale.value;
        if (i.Igap.value != 5 && i.Gap_scale.value > 0) return;
        scale_.place.reset();
        scale_.missing = i.Igap.value == 5 ? "the thicknesses of Igap 5 have scales of their own"
                                           : "Gap_scale is negative";
      }
    });
  }

  /// Finds values without penetrations. False: `why` has the reason.
  bool solve(const Scene& before) {
    for (const Contact& c : before.contacts) {
      if (c.inter->id != inter_->id || c.dropped) continue;
      const double own = c.gapmin / (c.role == ContactRole::edges ? edge_scale_ : 1);
      smallest_gapmin_ = smallest_gapmin_ > 0 ? std::min(smallest_gapmin_, own) : own;
      if (is_type24_or_25(c.type))
        find_largest(c);
      else if (c.kind == ContactKind::node_segment && c.gap_rule.rule != GapRule::constant)
        largest_gap_ = std::max(largest_gap_, c.max_gap);
    }
    gapmin_.present = smallest_gapmin_;
    cap_.present = largest_gap_;
    const GapReduction fresh = *this;
    GapReduction best = fresh;
    bool found = false;
    for (const LoweredField lever : {LoweredField::scale, LoweredField::cap}) {
      GapReduction attempt = fresh;
      attempt.lever_ = lever;
      const bool ok = attempt.search();
      if (!ok) {
        if (!found) why = attempt.why;
        continue;
      }
      if (!found || attempt.least_share() > best.least_share()) best = attempt;
      found = true;
      if (!attempt.scale_.text && !attempt.cap_.text) break;  // no field is needed
    }
    if (!found) return false;
    *this = best;
    if (least_share() >= options_->least_share) return true;
    why = "the gap would shrink to " + percent(least_share()) + " of what it is, less than the " +
          percent(options_->least_share) + " allowed (--min-gap): move the nodes instead";
    return false;
  }

  void write(PenetrationFix& fix, CellWriter& edits) const {
    FixedInterface& entry = interface_entry(fix, *inter_);
    for (const GapField* k : {&gapmin_, &scale_, &cap_}) {
      if (!k->text) continue;
      if (k->sides.empty()) write(*k->place, *k, edits, entry);
      for (const GapField::Side& side : k->sides)
        if (side.present > k->value) write(side.place, *k, edits, entry);
    }
    if (!needs_igap_2()) return;
    const auto place = find_field(context_->deck(), *inter_->block, "Igap");
    place->write(edits, "2");
    entry.changes.push_back({"Igap", std::string(place->text), "2", 1, 2});
  }

  std::string why;

 private:
  static void write(const FieldPlace& place, const GapField& gap_field, CellWriter& edits,
                    FixedInterface& entry) {
    place.write(edits, gap_field.text->text);
    entry.changes.push_back({std::string(place.field), std::string(place.text),
                             gap_field.text->text, gap_field.present, gap_field.value});
  }

  /// Caps of both sides as one field.
  void add_sides(const std::array<double, 2>& present) {
    for (std::size_t i = 0; i < present.size(); ++i) {
      const GapField one = gap_field(rules_.caps[i]);
      if (!one.place) {
        cap_ = one;
        return;
      }
      cap_.sides.push_back({*one.place, present[i]});
    }
    cap_.name = std::string(rules_.caps[0]) + " and " + std::string(rules_.caps[1]);
  }

  /// Largest gaps of both sides of a TYPE24 or TYPE25, which the caps would cut.
  void find_largest(const Contact& c) {
    for (const SecondaryNode& n : c.secondary) largest_gap_ = std::max(largest_gap_, n.gap);
    for (const MainSegment& m : c.main) largest_gap_ = std::max(largest_gap_, m.gap);
  }

  GapField gap_field(std::string_view name) const {
    GapField k;
    k.name = name;
    if (name.empty()) {
      k.missing = "TYPE" + std::to_string(inter_->type) + " has no such field";
      return k;
    }
    auto place = find_field(context_->deck(), *inter_->block, name);
    if (place)
      k.place = *place;
    else
      k.missing = place.error().message;
    return k;
  }

  static std::string percent(double share) {
    return fmt::format("{:.6g} %", std::floor(share * 1000) / 10);
  }

  bool needs_igap_2() const {
    return rules_.with_igap_2 && igap_ == 1 && (scale_.text || cap_.text);
  }

  /// Smallest ratio of new to present value of the changed fields.
  double least_share() const {
    double share = 1;
    for (const GapField* k : {&gapmin_, &scale_, &cap_})
      if (k->text && k->present > 0) share = std::min(share, k->value / k->present);
    return share;
  }

  std::vector<WhatIf> what_if() const {
    WhatIf w;
    w.interface_id = inter_->id;
    if (gapmin_.text) w.Gapmin = gapmin_.value;
    if (scale_.text) w.Fscalegap = scale_.value;
    if (cap_.text) w.Gapmax = cap_.value;
    // Gapmax is inactive with Igap 1 but acts with Igap 2; so does Fscalegap on the card.
    if (needs_igap_2()) {
      w.Igap = 2;
      visit_interface(*inter_, [&](const auto& i) {
        if constexpr (requires { i.Fscalegap; }) {
          if (!scale_.text) w.Fscalegap = written(i.Fscalegap, 1);
          if (!cap_.text) w.Gapmax = written(i.Gapmax, 1e30);
        }
      });
    }
    return {w};
  }

  static double written(const EffectiveReal& field, double if_zero) {
    return field.has_input && field.input != 0 ? field.input : if_zero;
  }

  bool search() {
    for (int round = 0; round < most_rounds; ++round) {
      const Scene scene = fix_scene(*context_, *options_, false, what_if(), {inter_->id});
      double gapmin = -1, scale = -1, cap = -1;
      bool any = false;
      for (const Contact& c : scene.contacts) {
        for (const PenetrationRow& row : c.penetrations) {
          if (!is_penetration(row)) continue;
          any = true;
          if (!(free_gap(c, row) > 0)) {
            why = row.distance > 0
                      ? "a node is behind the face of a solid, which no gap leaves free: move it"
                      : "a pair is at distance 0, which no gap leaves free: move the nodes";
            return false;
          }
          if (!bounds(c, row, gapmin, scale, cap)) return false;
        }
      }
      if (!any) return true;
      // A new Gapmin replaces the defaults of all contacts of the card: no default may grow.
      if (gapmin > 0 && !gapmin_.lower(std::min(gapmin, smallest_gapmin_), options_->digits))
        return no_cell(gapmin_);
      if (scale > 0 && !scale_.lower(scale, options_->digits)) return no_cell(scale_);
      if (cap > 0 && !cap_.lower(cap, options_->digits)) return no_cell(cap_);
    }
    why = "no gap was found in " + std::to_string(most_rounds) + " rounds";
    return false;
  }

  bool no_cell(const GapField& k) {
    why = k.place ? "no value of " + k.name + " fits its cell" : k.missing;
    return false;
  }

  static void tighten(double& bound, double value) {
    bound = bound > 0 ? std::min(bound, value) : value;
  }

  /// TYPE24 and TYPE25: both sides are scaled, or each is cut.
  void side_bounds(const Contact& c, const PenetrationRow& row, double& scale, double& cap) const {
    const double wanted = free_gap(c, row);
    if (lever_ == LoweredField::scale) {
      tighten(scale, c.gap_scale * (wanted / row.gap));
      return;
    }
    const bool nodes = c.kind == ContactKind::node_segment;
    const double s = nodes ? c.secondary[row.secondary].gap : c.secondary_edges[row.secondary].gap;
    const double m = row.gap - s;  // at the node: gaps of corners differ
    // If the thicker side can give enough, the thinner one keeps its gap.
    const double smaller = std::min(s, m);
    tighten(cap, 2 * smaller < wanted ? wanted - smaller : wanted / 2);
  }

  /// Lowers the bounds until this pair is free.
  bool bounds(const Contact& c, const PenetrationRow& row, double& gapmin, double& scale,
              double& cap) {
    if (is_type24_or_25(c.type)) {
      side_bounds(c, row, scale, cap);
      return true;
    }
    const double edge = c.role == ContactRole::edges ? edge_scale_ : 1;
    const bool constant = c.gap_rule.rule == GapRule::constant;
    if (constant || c.gapmin > row.distance) tighten(gapmin, row.distance / edge);
    if (constant) return true;
    const bool nodes = c.kind == ContactKind::node_segment;
    const double sum = nodes ? c.secondary[row.secondary].gap + c.main[row.main].gap
                             : c.secondary_edges[row.secondary].gap + c.main_edges[row.main].gap;
    const double limit =
        c.igap != 3 ? sum : c.secondary_length[row.secondary] + c.main_length[row.main];
    if (std::min({sum, limit, c.gap_rule.gapmax}) <= row.distance) return true;
    if (!nodes) {
      why =
          "the gap of edges with Igap 1 or 3 is their thickness, which no field lowers: move the "
          "nodes, or use Igap 0 with a Gapmin";
      return false;
    }
    if (lever_ == LoweredField::cap)
      tighten(cap, row.distance);
    else
      tighten(scale, c.gap_scale * (row.distance / sum));
    return true;
  }

  const LoadedDeck* context_;
  const ReduceGapOptions* options_;
  const InterBase* inter_;
  TypeRules rules_ = rules_of(inter_->type);
  GapField gapmin_, scale_, cap_;
  int igap_ = 0;
  double edge_scale_ = 1, smallest_gapmin_ = 0, largest_gap_ = 0;
  LoweredField lever_ = LoweredField::none;
};

}  // namespace

Result<PenetrationFix> reduce_gaps(const LoadedDeck& context, const ReduceGapOptions& options) {
  PenetrationFix fix;
  fix.strategy = "reduce-gap";
  const Scene before = fix_scene(context, options, false);
  if (auto why = unevaluated(before, options)) return *why;
  const auto counts = count_interfaces(before, options);
  CellWriter edits(context.deck().sources);
  std::map<std::int64_t, std::size_t> cards;
  for (const InterBase* inter : context.interfaces().ordered) ++cards[inter->id];
  std::size_t done = 0;
  for (const InterBase* inter : context.interfaces().ordered) {
    const auto it = counts.find(inter->id);
    if (it == counts.end()) continue;
    std::size_t& same = cards[inter->id];
    if (same > 1) {
      add_refusal(fix, inter->id,
                  count(same, "interface has", "interfaces have") +
                      " this id: the solver stops; give each its own",
                  {}, it->second.deepest);
      same = 0;  // noted; a search for each would evaluate all of them
    }
    if (same == 0) continue;
    if (options.progress) options.progress("gaps", done++, counts.size());
    GapReduction reduction(context, options, *inter);
    if (reduction.solve(before))
      reduction.write(fix, edits);
    else
      add_refusal(fix, inter->id, reduction.why, "deck fix DECK", it->second.deepest);
  }
  fix.rewrite.edits = edits.release_edits();
  const auto again = AfterRewrite::read(context, fix.rewrite, options, false, before);
  if (!again) return again.error();
  const Scene& after = again->scene();
  set_interfaces(fix, context.interfaces(), options, before, after);
  fix.complete = true;
  for (const FixedInterface& i : fix.interfaces) fix.complete &= i.after.pairs == 0;
  note_unevaluated(fix, after, options);
  verify_harmless(fix, context.interfaces(), options, before, after);
  return fix;
}

}  // namespace deck
