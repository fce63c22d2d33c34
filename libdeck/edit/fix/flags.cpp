// Strategies inacti and fpenmax: write the flag and report the solver's behaviour with it.
#include <algorithm>
#include <map>
#include <tuple>

#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"
#include "deck/contacts.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"

namespace deck {
namespace {

using namespace detail;

constexpr double inflation = 1 + 1e-8;  // the solver compares the depth times this with Fpenmax

const std::string next_inacti = "deck fix DECK --strategy inacti";

/// Next step against a stop at nodes on a segment: remove them from the interface.
std::string next_without_nodes(int type) {
  return rules_of(type).fpenmax ? "deck fix DECK --strategy fpenmax" : next_inacti + " --inacti 1";
}

/// Remaining pairs of an interface: those that the solver ignores, and those at which it stops.
std::string left_over(const PenetrationFix& fix, std::int64_t interface_id) {
  std::uint64_t idle = 0, stops = 0;
  for (const FixAction& a : fix.actions) {
    if (a.interface_id != interface_id) continue;
    stops += a.stops;
    idle +=
        !a.stops && (a.after == PenetrationAction::none || a.after == PenetrationAction::ignored);
  }
  std::string text;
  if (idle > 0)
    text = "the solver still does nothing about " + count(idle, "pair", "pairs") + ": Inacti is 0";
  if (stops > 0)
    text +=
        (text.empty() ? "the solver" : "; it") + std::string(" stops at ") +
        count(stops, "pair", "pairs") +
        " whose nodes lie exactly on a segment (error 611/612): move the nodes, or take them out "
        "of the interface for the whole run";
  return text;
}

/// Reads the deck again and sets the outcome of each penetration.
Result<void> evaluate(PenetrationFix& fix, const LoadedDeck& context, const FixOptions& options,
                      const Scene& before) {
  const auto again = AfterRewrite::read(context, fix.rewrite, options, true, before);
  if (!again) return again.error();
  const Scene& after = again->scene();
  set_interfaces(fix, context.interfaces(), options, before, after);

  using Key = std::tuple<std::int64_t, int, std::vector<std::int64_t>, std::vector<std::int64_t>>;
  const auto key = [](const Model& model, const Contact& c, const PenetrationRow& r) {
    return Key{c.inter->id, static_cast<int>(c.role), node_ids(model, c, r, false),
               node_ids(model, c, r, true)};
  };
  std::map<Key, PenetrationAction> earlier;
  for (const Contact& c : before.contacts)
    for (const PenetrationRow& r : c.penetrations)
      if (is_wanted(options, c) && is_penetration(r))
        earlier[key(context.model(), c, r)] = r.action;
  for (const Contact& c : after.contacts) {
    if (!is_wanted(options, c)) continue;
    for (const PenetrationRow& r : c.penetrations) {
      if (!is_penetration(r)) continue;
      FixAction action;
      action.interface_id = c.inter->id;
      action.secondary = node_ids(*after.model, c, r, false);
      action.main = node_ids(*after.model, c, r, true);
      action.depth = r.depth;
      action.gap = r.gap;
      const auto it = earlier.find(key(*after.model, c, r));
      if (it != earlier.end()) action.before = it->second;
      action.after = r.action;
      action.stops = stops_solver(r.action);
      if (r.has_gap0) action.gap0 = r.gap0;
      fix.actions.push_back(std::move(action));
    }
  }
  std::stable_sort(
      fix.actions.begin(), fix.actions.end(), [](const FixAction& a, const FixAction& b) {
        return std::tuple(a.interface_id, -a.depth) < std::tuple(b.interface_id, -b.depth);
      });
  fix.complete = true;
  for (const FixedInterface& i : fix.interfaces) {
    if (i.after.untreated == 0) continue;
    fix.complete = false;
    const bool said = std::any_of(fix.refused.begin(), fix.refused.end(),
                                  [&](const FixRefusal& r) { return r.interface_id == i.id; });
    if (said) continue;
    const bool stops = std::any_of(fix.actions.begin(), fix.actions.end(), [&](const FixAction& a) {
      return a.interface_id == i.id && a.stops;
    });
    add_refusal(fix, i.id, left_over(fix, i.id), stops ? next_without_nodes(i.type) : next_inacti,
                i.before.deepest);
  }
  note_unevaluated(fix, after, options);
  std::stable_sort(
      fix.refused.begin(), fix.refused.end(),
      [](const FixRefusal& a, const FixRefusal& b) { return a.interface_id < b.interface_id; });
  verify_harmless(fix, context.interfaces(), options, before, after);
  return {};
}

/// Number of pairs at which the solver stops with these values, by interface.
std::map<std::int64_t, std::uint64_t> stops_with(const LoadedDeck& context,
                                                 const FixOptions& options, const Scene& before,
                                                 const std::vector<WhatIf>& planned) {
  std::map<std::int64_t, std::uint64_t> out;
  // Nodes on a segment do not depend on Inacti, except Inacti 3, which moves them.
  if (std::none_of(before.contacts.begin(), before.contacts.end(), [](const Contact& c) {
        return c.inacti == 3 || std::any_of(c.penetrations.begin(), c.penetrations.end(),
                                            [](const PenetrationRow& r) { return r.on_surface; });
      }))
    return out;
  const Scene scene = fix_scene(context, options, true, planned);
  for (const Contact& c : scene.contacts)
    for (const PenetrationRow& r : c.penetrations)
      if (stops_solver(r.action)) ++out[c.inter->id];
  return out;
}

void add_change(PenetrationFix& fix, const InterBase& inter, CellWriter& edits,
                const FieldPlace& place, std::string text, double old_value, double new_value) {
  place.write(edits, text);
  interface_entry(fix, inter)
      .changes.push_back({std::string(place.field), std::string(place.text), std::move(text),
                          old_value, new_value});
}

// ---- Inacti -----------------------------------------------------------------------------------

int inacti_in_effect(const InterBase& inter) {
  return visit_interface(inter, [](const auto& i) {
    return i.Inacti.value == 1000 ? 0 : static_cast<int>(i.Inacti.value);
  });
}

}  // namespace

Result<PenetrationFix> set_inacti(const LoadedDeck& context, const InactiOptions& options) {
  constexpr int known[] = {-1, 0, 1, 2, 3, 5, 6, 1000};
  if (options.inacti &&
      std::find(std::begin(known), std::end(known), *options.inacti) == std::end(known))
    return Error{Error::Code::config,
                 "Inacti can be -1, 0, 1, 2, 3, 5, 6 or 1000; not " +
                     std::to_string(*options.inacti) +
                     (*options.inacti == 4 ? " (executed, but not documented)" : "")};
  PenetrationFix fix;
  fix.strategy = "inacti";
  const Scene before = fix_scene(context, options, true);
  if (auto why = unevaluated(before, options)) return *why;
  const auto counts = count_interfaces(before, options);
  const auto effective_for = [&](const InterBase& inter) {
    const int value = options.inacti.value_or(rules_of(inter.type).usual_inacti);
    return value == 1000 ? 0 : value;
  };

  std::vector<WhatIf> planned;
  std::vector<const InterBase*> chosen;
  for (const InterBase* inter : context.interfaces().ordered) {
    if (!counts.contains(inter->id)) continue;
    const int effective = effective_for(*inter);
    if (const std::string why = why_not_inacti(inter->type, effective); !why.empty()) {
      add_refusal(fix, inter->id, why);
      continue;
    }
    if (inacti_in_effect(*inter) == effective) continue;
    chosen.push_back(inter);
    WhatIf w;
    w.interface_id = inter->id;
    w.Inacti = effective;
    planned.push_back(w);
  }
  const auto stops = stops_with(context, options, before, planned);
  CellWriter edits(context.deck().sources);
  for (const InterBase* inter : chosen) {
    const int effective = effective_for(*inter);
    if (const auto it = stops.find(inter->id); it != stops.end()) {
      add_refusal(fix, inter->id,
                  count(it->second, "pair", "pairs") +
                      " at distance 0, at which the solver stops with Inacti " +
                      std::to_string(effective) + " (error " + (effective == 0 ? "612" : "611") +
                      "): move these nodes, or take them out of the interface for the whole run",
                  next_without_nodes(inter->type));
      continue;
    }
    const auto place = find_field(context.deck(), *inter->block, "Inacti");
    if (!place) {
      add_refusal(fix, inter->id, place.error().message);
      continue;
    }
    // 0 on the card takes /DEFAULT/INTER of the type; 1000 is a 0 that does not.
    const DefaultInter* defaults = context.interfaces().defaults_of(inter->type);
    const bool has_default = defaults != nullptr && defaults->find("Inacti") != nullptr;
    const int written = effective != 0 ? effective : has_default ? 1000 : 0;
    add_change(fix, *inter, edits, *place, std::to_string(written), inacti_in_effect(*inter),
               effective);
  }
  fix.rewrite.edits = edits.release_edits();
  if (auto done = evaluate(fix, context, options, before); !done) return done.error();
  return fix;
}

// ---- Fpenmax ----------------------------------------------------------------------------------

Result<PenetrationFix> set_fpenmax(const LoadedDeck& context, const FpenmaxOptions& options) {
  if (options.ratio && !(*options.ratio > 0 && *options.ratio <= 1))
    return Error{Error::Code::config,
                 "Fpenmax is a share of the gap: more than 0 and at most 1 (1 drops no node)"};
  PenetrationFix fix;
  fix.strategy = "fpenmax";
  const Scene before = fix_scene(context, options, true);
  if (auto why = unevaluated(before, options)) return *why;
  CellWriter edits(context.deck().sources);
  for (const Contact& contact : before.contacts) {
    if (contact.penetrations.empty() || !is_wanted(options, contact)) continue;
    const InterBase& inter = *contact.inter;
    if (!rules_of(inter.type).fpenmax) {
      if (contact.role == ContactRole::primary || contact.kind == ContactKind::edge_edge)
        if (fix.refused.empty() || fix.refused.back().interface_id != inter.id)
          add_refusal(fix, inter.id, "TYPE" + std::to_string(inter.type) + " has no Fpenmax",
                      inter.type == 10 ? "" : next_inacti);
      continue;
    }
    double deepest = 0;  // share of the gap, without pairs at distance 0
    std::uint64_t on_surface = 0;
    for (const PenetrationRow& row : contact.penetrations) {
      if (row.on_surface)
        ++on_surface;
      else
        deepest = std::max(deepest, row.depth * inflation / row.gap);
    }
    const auto& card = static_cast<const InterType7&>(inter);
    double wanted = 0;
    if (options.ratio) {
      wanted = *options.ratio;
    } else if (on_surface == 0 || on_surface_error(contact) == 0) {
      continue;  // the solver does not stop
    } else if (deepest >= 1) {
      add_refusal(fix, inter.id,
                  "a pair is so close to distance 0 that no Fpenmax drops only the pairs at 0",
                  "deck fix DECK --strategy fpenmax --fpenmax 99%");
      continue;
    } else {
      wanted = deepest > 0 ? deepest : 0.9;
    }
    if (card.Fpenmax.value != 0 && card.Fpenmax.value == wanted) continue;
    const auto place = find_field(context.deck(), *inter.block, "Fpenmax");
    if (!place) {
      add_refusal(fix, inter.id, place.error().message);
      continue;
    }
    std::optional<RoundedText> text;
    if (options.ratio) {
      if (const auto exact = format_real(wanted, place->width()))
        text = RoundedText{exact->text, read_real(exact->text).value};
    } else {
      for (const int digits : {3, 17}) {
        text = round_up(wanted, digits, place->width());
        if (text && text->value < 1) break;
        text.reset();
      }
    }
    if (!text) {
      add_refusal(fix, inter.id, "the value does not fit the cell of Fpenmax");
      continue;
    }
    if (card.Fpenmax.has_input && card.Fpenmax.value == text->value) continue;
    add_change(fix, inter, edits, *place, text->text, card.Fpenmax.value, text->value);
  }
  fix.rewrite.edits = edits.release_edits();
  if (auto done = evaluate(fix, context, options, before); !done) return done.error();
  return fix;
}

}  // namespace deck
