// Times the pair loop of each contact with and without each effect. Before timing, a loop must give
// the same bits as the generic kernel with equal effects; after timing, the bits of its first run.
#include "accuracy/shared/effect_cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "accuracy/shared/accuracy.hpp"
#include "base/shared/words.hpp"
#include "cycle/shared/contact_run.hpp"

namespace deck {
namespace {

using cycle::KernelPlan;
using cycle::PacketResult;
using cycle::PacketView;

void no_friction(cycle::ContactCard& c) {
  c.fric = 0.0;
  c.ifric = 0;
  c.fric_id = c.fric_orthotropic = false;
  c.fct_idf.reset();
}
void no_heat_left(cycle::ContactCard& c) {
  const bool conducts = c.kthe != 0.0 || c.fct_idk, radiates = c.frad != 0.0 && c.drad > 0.0;
  if (!conducts && !radiates && c.fheats == 0.0 && c.fheatm == 0.0) c.ithe = 0;
}

/// Removes an effect from a card; the words say how.
struct EffectSwitch {
  const char* name;
  const char* off;
  void (*remove)(cycle::ContactCard&);
  const char* on;
  void (*add)(cycle::ContactCard&);
  bool edges = true;  ///< also for edge contacts
};

/// Effects inside the pair loop. An added effect has the given values; only its time counts.
const EffectSwitch switches[] = {
    {"gap-reduction", "Inacti = 0", [](cycle::ContactCard& c) { c.inacti = 0; }, "Inacti = 6",
     [](cycle::ContactCard& c) { c.inacti = 6; }},
    {"fixed-stiffness", "Istf = 0", [](cycle::ContactCard& c) { c.istf = 0; }, "Istf = 1",
     [](cycle::ContactCard& c) { c.istf = 1; }, false},
    {"normal-damping", "VISs = 0", [](cycle::ContactCard& c) { c.viss = 0.0; }, "VISs = 0.05",
     [](cycle::ContactCard& c) { c.viss = 0.05; }},
    {"friction-viscous", "no friction", no_friction, "Fric = 0.2, Iform = 1",
     [](cycle::ContactCard& c) {
       c.fric = 0.2;
       c.iform = 1;
     }},
    {"friction-incremental", "no friction", no_friction, "Fric = 0.2, Iform = 2",
     [](cycle::ContactCard& c) {
       c.fric = 0.2;
       c.iform = 2;
     }},
    {"friction-law", "Ifric = 0", [](cycle::ContactCard& c) { c.ifric = 0; },
     "Fric = 0.2, Ifric = 2",
     [](cycle::ContactCard& c) {
       if (c.fric == 0.0) c.fric = 0.2;
       c.ifric = 2;
       c.c = {1e-6, -1e-3, 1e-6, -1e-3, 1e-2, -1e-2};
     },
     false},
    {"friction-temperature", "fct_IDF = 0", [](cycle::ContactCard& c) { c.fct_idf.reset(); },
     "Ithe = 1, a function fct_IDF",
     [](cycle::ContactCard& c) {
       c.ithe = 1;
       c.fct_idf = cycle::Curve{{0.0, 1000.0}, {1.0, 2.0}};
     },
     false},
    {"friction-filter", "Ifiltr = 0", [](cycle::ContactCard& c) { c.ifiltr = 0; },
     "Fric = 0.2, Ifiltr = 1, Xfreq = 0.3",
     [](cycle::ContactCard& c) {
       if (c.fric == 0.0) c.fric = 0.2;
       c.ifiltr = 1;
       c.xfreq = 0.3;
     },
     false},
    {"orthotropic-friction", "no directions",
     [](cycle::ContactCard& c) { c.fric_orthotropic = false; }, nullptr, nullptr, false},
    {"part-pair-friction", "fric_ID = 0",
     [](cycle::ContactCard& c) {
       c.fric_id = c.fric_orthotropic = false;
       if (c.fric == 0.0) c.fric = 0.2;
     },
     nullptr, nullptr},
    {"heat-conduction", "Kthe = 0",
     [](cycle::ContactCard& c) {
       c.kthe = 0.0;
       c.fct_idk.reset();
       no_heat_left(c);
     },
     "Ithe = 1, Kthe = 1",
     [](cycle::ContactCard& c) {
       c.ithe = c.ithe_form = 1;
       c.kthe = 1.0;
     }},
    {"radiation", "Frad = 0",
     [](cycle::ContactCard& c) {
       c.frad = c.drad = 0.0;
       no_heat_left(c);
     },
     "Ithe = 1, Frad = 1e-8, Drad = Gapmin",
     [](cycle::ContactCard& c) {
       c.ithe = c.ithe_form = 1;
       c.frad = 1e-8;
       c.drad = std::max(c.gapmin, 1e-300);
     }},
    {"friction-heat", "Fheats = Fheatm = 0",
     [](cycle::ContactCard& c) {
       c.fheats = c.fheatm = 0.0;
       no_heat_left(c);
     },
     "Ithe = 1, Fric = 0.2, Fheats = 0.5",
     [](cycle::ContactCard& c) {
       c.ithe = c.ithe_form = 1;
       if (c.fric == 0.0) c.fric = 0.2;
       c.fheats = 0.5;
     },
     false},
    {"curvature", "Icurv = 0", [](cycle::ContactCard& c) { c.icurv = 0; }, "Icurv = 3",
     [](cycle::ContactCard& c) { c.icurv = 3; }, false},
    {"adaptivity-criteria", "Iadm = 0", [](cycle::ContactCard& c) { c.iadm = 0; }, "Iadm = 2",
     [](cycle::ContactCard& c) { c.iadm = 2; }, false},
    {"time-step-deletion", "dtmin = 0", [](cycle::ContactCard& c) { c.dtmin = 0.0; },
     "dtmin = 1e-300",
     [](cycle::ContactCard& c) {
       c.dtmin = 1e-300;
       c.itied = 0;
     }},
    {"tie-on-time-step", "ITIED = 0", [](cycle::ContactCard& c) { c.itied = 0; },
     "ITIED = 1, dtmin = 1e-300",
     [](cycle::ContactCard& c) {
       c.itied = 1;
       c.dtmin = 1e-300;
     },
     false},
    {"boundary-release", "IBC = 000", [](cycle::ContactCard& c) { c.ibc = 0; }, "IBC = 111",
     [](cycle::ContactCard& c) { c.ibc = 7; }, false},
};

bool asks_for(const cycle::ContactCard& card, std::string_view name) {
  const std::vector<cycle::EffectState> account = cycle::effect_plan(card);
  return std::any_of(account.begin(), account.end(),
                     [&](const cycle::EffectState& e) { return e.on && e.name == name; });
}

/// Reason why an effect cannot be removed from the pair loop: always on, or outside it.
std::string outside_the_loop(const std::string& name) {
  if (name == "elastic-normal" || name == "contact-time-step" || name == "tie")
    return "the loop itself";
  if (name == "stiffness-combination" || name == "variable-gap" ||
      name == "initial-penetration-action" || name == "penetration-limit")
    return "acts in the search, not in the loop over pairs";
  return "acts outside the loop over pairs";
}

const EffectSwitch* switch_of(const std::string& effect) {
  const auto* s = std::find_if(std::begin(switches), std::end(switches),
                               [&](const EffectSwitch& w) { return effect == w.name; });
  return s == std::end(switches) ? nullptr : s;
}

/// Reason why the card cannot have an effect that it lacks; empty if it can.
std::string why_not_given(const cycle::ContactCard& card, const EffectSwitch& s) {
  const std::string_view name = s.name;
  if (card.kind == cycle::ContactKind::tied ||
      (card.kind == cycle::ContactKind::edge_edge && !s.edges))
    return "contacts of this type do not have this effect";
  if (s.add == nullptr) return "needs a /FRICTION, which the deck does not name here";
  if ((name == "friction-viscous" || name == "friction-incremental") &&
      (asks_for(card, "friction-viscous") || asks_for(card, "friction-incremental")))
    return "the other friction formulation is used";
  if (name == "time-step-deletion" && card.itied != 0) return "ITIED ties instead";
  return {};
}

/// A card that differs in some effects, with their values as text.
struct CardVariant {
  cycle::ContactCard card;
  std::string says;
};

/// The card without the effect if it has it, else with it; or the reason why there is none. `e`:
/// the effect in the account of this card (cycle::effect_plan).
std::optional<CardVariant> other_card(const cycle::ContactCard& card, const cycle::EffectState& e,
                                      std::string& why_not) {
  const EffectSwitch* s = switch_of(e.name);
  why_not = s == nullptr ? outside_the_loop(e.name) : e.on ? "" : why_not_given(card, *s);
  if (!why_not.empty()) return std::nullopt;
  CardVariant out{card, e.on ? s->off : s->on};
  (e.on ? s->remove : s->add)(out.card);
  return out;
}

/// The card with every effect that it can have at once. Of deletion and tie, which exclude each
/// other, the tie costs more.
CardVariant with_all_effects(const cycle::ContactCard& card) {
  CardVariant out{card, {}};
  for (const cycle::EffectState& e : cycle::effect_plan(card)) {
    if (e.on || e.name == "time-step-deletion" || e.name == "friction-temperature" ||
        e.name == "fixed-stiffness" || e.name == "friction-incremental")
      continue;
    std::string why_not;
    const std::optional<CardVariant> other = other_card(card, e, why_not);
    if (!other) continue;
    // On the changed card: effects accumulate.
    switch_of(e.name)->add(out.card);
    out.says += (out.says.empty() ? "" : "; ") + other->says;
  }
  return out;
}

/// Packet of one contact with the arrays for any loop.
class ContactPacket {
 public:
  ContactPacket(const Scene& scene, const Contact& contact, const cycle::ContactCard& card,
                const cycle::State& state, const cycle::CycleOptions& options, double margin,
                std::size_t most) {
    cycle::ContactCard wide = card;
    if (card.kind != cycle::ContactKind::tied && card.ithe == 0) {
      wide.ithe = 1;
      wide.drad = 0.0;  // finds no further pairs
    }
    if (wide.iadm == 0) wide.iadm = 2;
    pairs_ = cycle::make_pairs(scene, contact, wide, options.model, options.threads,
                               {nullptr, margin, {}});
    if (wide.ithe > 0) cycle::add_conductivity(scene, contact, state.temperature, pairs_);
    inputs_.k0 = pairs_.k0;
    inputs_.p0 = pairs_.p0;
    inputs_.zero.assign(pairs_.size(), 0.0);
    const Coordinates& x = scene.coordinates;
    cycle::NodalState nodes;
    nodes.position = {x.x.data(), x.y.data(), x.z.data()};
    const auto data = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
    for (std::size_t c = 0; c < 3; ++c) nodes.velocity[c] = data(state.velocity[c]);
    nodes.mass = state.mass.data();
    nodes.temperature = data(state.temperature);
    using F = cycle::Field;
    buffer_.gather(nodes, pairs_.nodes,
                   F::position | F::velocity | F::mass_secondary | F::mass_main | F::temperature);
    view_ = buffer_.view();
    cycle::detail::attach(view_, pairs_, inputs_);
    view_.dt1 = options.dt1;
    view_.dt12 = options.dt12;
    view_.size = std::min(pairs_.size(), most);
  }
  ContactPacket(const ContactPacket&) = delete;
  ContactPacket& operator=(const ContactPacket&) = delete;
  const PacketView& view() const { return view_; }
  std::size_t pairs() const { return pairs_.size(); }
  bool complete() const { return pairs_.complete; }

 private:
  cycle::ContactPairs pairs_;
  cycle::detail::PairInputs inputs_;
  cycle::PacketBuffer buffer_;
  PacketView view_;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
bool same_answers(const PacketResult& a, const PacketResult& b) {
  bool same = same_bits(a.normal_force, b.normal_force) && same_bits(a.k_nodal, b.k_nodal) &&
              same_bits(a.penetration, b.penetration) && a.status == b.status;
  for (std::size_t c = 0; c < 3; ++c) same = same && same_bits(a.force[c], b.force[c]);
  for (std::size_t k = 0; k < 4; ++k) same = same && same_bits(a.weights[k], b.weights[k]);
  for (std::size_t k = 0; k < 5; ++k) same = same && same_bits(a.heat[k], b.heat[k]);
  return same;
}

/// Largest difference of a pair force, relative to the largest pair force; 0 without forces.
double change_of(const PacketResult& a, const PacketResult& b) {
  double most = 0.0, off = 0.0;
  for (std::size_t i = 0; i < a.size; ++i) {
    double f[3] = {0.0, 0.0, 0.0};
    for (std::size_t c = 0; c < 3; ++c) {
      f[0] += a.force[c][i] * a.force[c][i];
      f[1] += b.force[c][i] * b.force[c][i];
      f[2] += (a.force[c][i] - b.force[c][i]) * (a.force[c][i] - b.force[c][i]);
    }
    most = std::max({most, f[0], f[1]});
    off = std::max(off, f[2]);
  }
  return most > 0.0 ? std::sqrt(off / most) : 0.0;
}

class TimedLoop {
 public:
  TimedLoop(const cycle::ContactCard& card, const cycle::CycleOptions& options, bool flags,
            const PacketView& view)
      : view_(view) {
    cycle::PlanOptions how = options.plan;
    how.force_generic = flags;
    plan_ = cycle::make_plan(card, options.model, how);
  }
  bool can_run() const {
    return plan_.table != nullptr && cycle::missing_fields(plan_, view_) == cycle::Field::none;
  }
  void run() { cycle::evaluate(plan_, view_, result_); }
  /// Mean processor time of a pass in nanoseconds.
  double time(int times) {
    const double start = accuracy::thread_nanoseconds();
    for (int k = 0; k < times; ++k) run();
    return (accuracy::thread_nanoseconds() - start) / times;
  }
  const PacketResult& result() const { return result_; }

 private:
  KernelPlan plan_;
  const PacketView& view_;
  PacketResult result_;
};

double quantile(std::vector<double> v, double q) {
  std::sort(v.begin(), v.end());
  const double at = q * static_cast<double>(v.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const double next = v[std::min(i + 1, v.size() - 1)];
  return v[i] + (at - static_cast<double>(i)) * (next - v[i]);
}

/// Number of passes that takes long enough for the clock, which may be coarse (browsers).
int passes_for(TimedLoop& loop, double least_ns) {
  int times = 1;
  while (times < (1 << 20) && loop.time(times) * times < least_ns) times *= 2;
  return times;
}

/// Times of two loops, taken in turn.
struct LoopTimes {
  std::vector<double> a, b;
};
LoopTimes race(TimedLoop& a, TimedLoop& b, const EffectCostOptions& how) {
  const int times = std::min(passes_for(a, how.least_ns), passes_for(b, how.least_ns));
  LoopTimes r;
  for (int k = 0; k < std::max(1, how.repeats); ++k) {
    const bool first = k % 2 == 0;
    if (first) r.a.push_back(a.time(times));
    r.b.push_back(b.time(times));
    if (!first) r.a.push_back(a.time(times));
  }
  return r;
}

/// A loop that gives equal bits in both kernels; nothing if it does not, or if the packet lacks its
/// input.
std::optional<TimedLoop> proven(const cycle::ContactCard& card, const cycle::CycleOptions& options,
                                const PacketView& view, std::string& why_not) {
  TimedLoop composed(card, options, false, view), flags(card, options, true, view);
  if (!composed.can_run() || !flags.can_run()) {
    why_not = "needs data that the deck does not have";
    return std::nullopt;
  }
  composed.run();
  flags.run();
  if (!same_answers(composed.result(), flags.result())) {
    why_not = "the loop and the loop with flags do not give the same result";
    return std::nullopt;
  }
  return composed;
}

class Measure {
 public:
  Measure(const cycle::CycleOptions& options, const EffectCostOptions& how, const PacketView& view)
      : options_(options),
        how_(how),
        view_(view),
        per_pair_(1.0 / static_cast<double>(view.size)) {}

  void run(const cycle::ContactCard& card, ContactCost& out) {
    std::optional<TimedLoop> base = proven(card, options_, view_, out.problem);
    if (!base) return;
    const PacketResult first = base->result();
    TimedLoop flags(card, options_, true, view_);
    const LoopTimes own = race(*base, flags, how_);
    out.loop_ns = quantile(own.a, 0.5) * per_pair_;
    out.flags_ns = quantile(own.b, 0.5) * per_pair_;
    CardVariant all = with_all_effects(card);
    std::string why_not;
    if (std::optional<TimedLoop> loop = proven(all.card, options_, view_, why_not)) {
      out.all_ns = quantile(race(*base, *loop, how_).b, 0.5) * per_pair_;
      out.all = std::move(all.says);
    }
    for (const cycle::EffectState& e : cycle::effect_plan(card)) {
      out.effects.push_back({e.name, e.on, {}, {}});
      effect(card, e, *base, out.effects.back());
    }
    if (!same_answers(first, base->result()))
      out.problem = "the loop does not repeat its own result";
  }

 private:
  void effect(const cycle::ContactCard& card, const cycle::EffectState& e, TimedLoop& base,
              EffectCost& out) {
    const std::optional<CardVariant> other = other_card(card, e, out.why_not);
    if (!other) return;
    std::optional<TimedLoop> loop = proven(other->card, options_, view_, out.why_not);
    if (!loop) return;
    out.other = other->says;
    out.change = change_of(base.result(), loop->result());
    const LoopTimes r = race(base, *loop, how_);
    std::vector<double> added;
    for (std::size_t k = 0; k < r.a.size(); ++k)
      added.push_back((e.on ? r.a[k] - r.b[k] : r.b[k] - r.a[k]) * per_pair_);
    out.ns = quantile(added, 0.5);
    out.low = quantile(added, 0.25);
    out.high = quantile(added, 0.75);
  }

  const cycle::CycleOptions& options_;
  const EffectCostOptions& how_;
  const PacketView& view_;
  double per_pair_;
};

/// Effects that are removed together.
const std::pair<const char*, std::vector<const char*>> groups[] = {
    {"friction", {"friction-viscous", "friction-incremental"}},
    {"heat", {"heat-conduction", "radiation", "friction-heat"}},
};

/// Reason why a contact cannot be timed; empty if it can.
std::string why_untimed(const cycle::ContactOutcome& o) {
  if (o.contact->dropped || !o.contact->evaluated || !o.complete) return "not evaluated";
  return o.active ? "" : "not active at this time";
}

}  // namespace

bool remove_effect(const std::string& name, cycle::ContactCard& card) {
  bool taken = false;
  for (const auto& [group, members] : groups)
    if (name == group)
      for (const char* member : members) taken = remove_effect(member, card) || taken;
  for (const EffectSwitch& s : switches) {
    if (name != s.name || !asks_for(card, s.name)) continue;
    // Use the timed loop's own friction; an evaluation keeps the card's.
    const double fric = card.fric;
    s.remove(card);
    card.fric = std::min(card.fric, fric);
    taken = true;
  }
  return taken;
}

std::vector<std::string> removable_effects() {
  std::vector<std::string> names;
  for (const auto& [group, members] : groups) names.emplace_back(group);
  for (const EffectSwitch& s : switches) names.emplace_back(s.name);
  return names;
}

std::vector<ContactCost> measure_effects(const Scene& scene, const cycle::State& state,
                                         const cycle::SceneOutcome& outcome,
                                         const cycle::CycleOptions& options,
                                         const EffectCostOptions& how) {
  std::vector<ContactCost> out(scene.contacts.size());
  const auto key = [&](std::size_t i) {
    std::string effects = how.every ? std::to_string(i) : std::string();
    for (const cycle::EffectState& e : outcome.contacts[i].effects)
      if (e.on) effects += " " + e.name;
    return std::pair(outcome.contacts[i].card.kind, std::move(effects));
  };
  std::map<std::pair<cycle::ContactKind, std::string>, std::size_t> timed;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].problem = why_untimed(outcome.contacts[i]);
    if (!out[i].problem.empty()) continue;
    std::size_t& most = timed.try_emplace(key(i), i).first->second;
    if (outcome.contacts[i].pairs_in_reach > outcome.contacts[most].pairs_in_reach) most = i;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Contact& contact = scene.contacts[i];
    ContactCost& cost = out[i];
    if (!cost.problem.empty()) continue;
    if (const std::size_t other = timed.at(key(i)); other != i) {
      out[other].alike += outcome.contacts[i].pairs_in_reach;
      cost.problem = "equal effects are timed once, on interface " +
                     std::to_string(scene.contacts[other].inter->id);
      continue;
    }
    const cycle::ContactCard& card = outcome.contacts[i].card;
    // In gaps; a deck with little initial contact still has neighbours.
    for (const double further : {0.0, 1.0, 4.0}) {
      cost.margin = further * contact.max_gap;
      const ContactPacket packet(scene, contact, card, state, options, cost.margin, how.most_pairs);
      cost.pairs = packet.pairs();
      cost.measured = packet.view().size;
      cost.problem = !packet.complete() ? "too many pairs"
                     : cost.pairs < how.least_pairs
                         ? "too few to time: " + count(cost.pairs, "pair", "pairs") +
                               " within five times the gap"
                         : "";
      if (cost.problem.empty()) Measure(options, how, packet.view()).run(card, cost);
      if (cost.pairs >= how.least_pairs || !packet.complete()) break;
    }
  }
  return out;
}

}  // namespace deck
