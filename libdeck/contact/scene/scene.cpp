// Turns the interfaces of a model into elementary contacts, in the solver's order.
#include "deck/contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <type_traits>

#include "base/shared/parallel.hpp"
#include "base/shared/side_by_side.hpp"
#include "contact/rules/gaps.hpp"
#include "contact/scene/complete_contacts.hpp"
#include "contact/shared/filtered.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/shared/sides.hpp"
#include "contact/shared/tie_steps.hpp"
#include "contact/type24_25/type24_25.hpp"
#include "deck/text.hpp"

namespace deck {
namespace {

using detail::SceneContext;

int flag(const EffectiveInt& f) { return f.value == 1000 ? 0 : static_cast<int>(f.value); }

/// Value on the card, even if other fields overrule it.
template <class T>
T written(const Effective<T>& e) {
  return e.has_input ? e.input : T{};
}

/// Fields of a card for a contact, before the rules of its kind apply.
struct Card : detail::CardSettings {
  const InterBase* inter = nullptr;
  int istf = 0, itied = 0;
  double stfac = 1, stmin = 0, stmax = 1e30;
};

Card card_of(const InterBase& inter) {
  Card c{detail::card_settings(inter)};
  c.inter = &inter;
  visit_interface(inter, [&](const auto& i) {
    c.stfac = i.Stfac.value;
    if constexpr (requires { i.Istf; }) {
      c.istf = flag(i.Istf);
      c.stmin = i.Stmin.value;
      c.stmax = i.Stmax.value;
    }
    if constexpr (requires { i.ITIED; }) c.itied = static_cast<int>(i.ITIED.value);
  });
  return c;
}

Contact make_contact(const Card& card, int type, ContactRole role) {
  Contact c;
  c.inter = card.inter;
  c.type = type;
  c.kind = type == 11 ? ContactKind::edge_edge : ContactKind::node_segment;
  c.role = role;
  c.istf = card.istf;
  c.igap = card.igap;
  c.inacti = card.inacti;
  c.irem_gap = card.irem_gap;
  c.itied = card.itied;
  c.factor = card.istf == 1 ? -card.stfac : card.stfac;
  c.stmin = card.stmin;
  c.stmax = card.stmax;
  c.fpenmax = card.fpenmax;
  c.gap_scale = gap_scale_of(card, type == 11);
  c.gapmax = gapmax_of(card, type == 11);
  c.mesh_fraction = card.mesh_fraction;
  if (type == 11) {
    // Constant stiffness means Istf 1 for edges.
    if (card.stfac < 0) {
      c.istf = 1;
      c.factor = card.stfac;
    }
    if (c.istf == 0) c.istf = 5;
  }
  return c;
}

class Builder {
 public:
  Builder(SceneContext& context, Selections& selections)
      : c_(context),
        selections_(selections),
        threads_(effective_threads(context.options.threads)),
        not_evaluated_(context.model, selections) {}

  void build() {
    for (const InterBase* base : c_.scene.interfaces->ordered) {
      if (!wanted(*base)) continue;
      ++total_;
      if (base->type != 19) continue;
      const auto& i = static_cast<const InterType19&>(*base);
      total_ += sides(i).first == sides(i).second ? 1 : 2;
    }
    c_.scene.contacts.reserve(total_);  // places stay valid while contacts are added
    pending_.reserve(total_);
    work_.run([this] { select(); });
    for (detail::PendingContact& pending : pending_) conclude(pending);
    // The solver handles these types after all others and after ties.
    for (const InterBase* base : c_.scene.interfaces->ordered) {
      if (!wanted(*base) || (base->type != 24 && base->type != 25)) continue;
      detail::type24_25::build_contacts(c_, selections_, *base, [this](Contact& contact) {
        report_empty_sides(contact, selections_.complete());
        report(contact,
               detail::check_evaluation(c_, not_evaluated_, not_evaluated_.reason_in_card(contact),
                                        selections_.complete(), contact));
        return contact.evaluated;
      });
      step();
    }
    // Only the selections know why contacts were not evaluated.
    if (!selections_.complete())
      for (const Finding& d : selections_.findings().all())
        if (d.rule == RuleId::DK332) c_.findings.report(d);
  }

 private:
  /// Makes the contacts of all types but TYPE24 and TYPE25, up to their members.
  void select() {
    std::vector<const InterType19*> later;
    for (const InterBase* base : c_.scene.interfaces->ordered) {
      if (!wanted(*base)) continue;
      switch (base->type) {
        case 7:
          type7(static_cast<const InterType7&>(*base));
          break;
        case 10:
          type10(static_cast<const InterType10&>(*base));
          break;
        case 11:
          type11(static_cast<const InterType11&>(*base));
          break;
        case 19:
          type19_nodes(static_cast<const InterType19&>(*base), ContactRole::primary);
          later.push_back(static_cast<const InterType19*>(base));
          break;
        case 24:
        case 25:
          break;
        default:
          step();
          break;
      }
    }
    // Further parts of a TYPE19 come after all interfaces of the user.
    for (const InterType19* i : later) {
      if (const auto [s, m] = sides(*i); s != m) type19_nodes(*i, ContactRole::reversed);
      type19_edges(*i);
    }
  }

  bool wanted(const InterBase& i) const {
    const auto& only = c_.options.only;
    return only.empty() || std::find(only.begin(), only.end(), i.id) != only.end();
  }

  template <class Inter>
  Card card_for(const Inter& i) const {
    Card card = card_of(i);
    for (const WhatIf& w : c_.options.what_if)
      if (w.interface_id == i.id) detail::apply(w, i.type, card);
    return card;
  }

  void type7(const InterType7& i) {
    const Card card = card_for(i);
    Contact contact = make_contact(card, 7, ContactRole::primary);
    const auto surface = selections_.outline(i.surf_IDm.value);
    if (i.grnd_IDs.value != 0) {
      if (const NodeSet* group = selections_.node_group(i.grnd_IDs.value))
        set_secondary(contact, group->nodes);
    } else if (surface) {
      set_secondary(contact, selections_.nodes_of(surface->segments));
    }
    add(std::move(contact), card, {.surface = surface});
  }

  void type10(const InterType10& i) {
    const Card card = card_for(i);
    Contact contact = make_contact(card, 10, ContactRole::primary);
    if (const NodeSet* group = selections_.node_group(i.grnd_IDs.value))
      set_secondary(contact, group->nodes);
    add(std::move(contact), card, {.surface = selections_.outline(i.surf_IDm.value)});
  }

  void type11(const InterType11& i) {
    const Card card = card_for(i);
    Contact contact = make_contact(card, 11, ContactRole::primary);
    const std::int64_t main = i.line_IDm.value == 0 ? i.line_IDs.value : i.line_IDm.value;
    const auto edges_of_line = [&](std::int64_t id) {
      const LineSet* line = selections_.line(id);
      return detail::EdgeSource{line == nullptr ? nullptr : &line->edges};
    };
    add(std::move(contact), card,
        {.secondary = edges_of_line(i.line_IDs.value), .main = edges_of_line(main)});
  }

  void type19_nodes(const InterType19& i, ContactRole role) {
    Card card = card_for(i);
    detail::adapt_to_type19_nodes(card);
    Contact contact = make_contact(card, 7, role);
    const auto [s, m] = sides(i);
    const std::int64_t from = role == ContactRole::primary ? s : m;
    const std::int64_t to = role == ContactRole::primary ? m : s;
    set_secondary(contact, nodes_of_surface(from));
    // The segments of a set are formed together with its nodes and edges, needed later.
    if (!selections_.is_plain("surf", to)) selections_.set(to);
    add(std::move(contact), card, {.surface = selections_.outline(to)});
  }

  void type19_edges(const InterType19& i) {
    Card card = card_for(i);
    detail::adapt_to_type19_edges(card, i.Edge_scale_gap.value);
    Contact contact = make_contact(card, 11, ContactRole::edges);
    const auto [s, m] = sides(i);
    const bool free_only = i.Iedge.value == 1;
    add(std::move(contact), card,
        {.secondary = edges_of_surface(s, free_only), .main = edges_of_surface(m, free_only)});
  }

  static std::pair<std::int64_t, std::int64_t> sides(const InterType19& i) {
    std::int64_t s = i.surf_IDs.value, m = i.surf_IDm.value;
    if (s == 0) s = m;
    if (m == 0) m = s;
    return {s, m};
  }

  std::vector<NodeIndex> nodes_of_surface(std::int64_t id) {
    if (!selections_.is_plain("surf", id))
      if (const SetGeneral* set = selections_.set(id)) return set->nodes;
    const auto surface = selections_.outline(id);
    return surface ? selections_.nodes_of(surface->segments) : std::vector<NodeIndex>{};
  }

  detail::EdgeSource edges_of_surface(std::int64_t id, bool free_only) {
    if (!selections_.is_plain("surf", id))
      if (const SetGeneral* set = selections_.set(id)) return {&set->edges};
    return {nullptr, selections_.outline(id), free_only};
  }

  void set_secondary(Contact& contact, const std::vector<NodeIndex>& nodes) const {
    contact.secondary.reserve(nodes.size());
    for (const NodeIndex n : nodes) {
      if (n == no_index) continue;
      SecondaryNode s;
      s.node = n;
      contact.secondary.push_back(s);
    }
  }

  /// Adds a contact with known members, to be completed beside the selection of later ones. Where
  /// nodes move all are completed in turn: earlier contacts do not see nodes that Inacti 3 moves.
  void add(Contact contact, const Card& card, detail::PendingContact pending) {
    const bool moves_nodes = contact.inacti == 3;
    if (moves_nodes) c_.all_placed = false;
    pending.place = c_.scene.contacts.size();
    pending.gapmin = card.gapmin;
    pending.drad = card.drad;
    pending.thermal = card.thermal;
    pending.complete = selections_.complete();
    if (c_.options.penetrations) pending.card_reason = not_evaluated_.reason_in_card(contact);
    const std::size_t size = detail::size_of(pending, contact);
    c_.scene.contacts.push_back(std::move(contact));
    pending_.push_back(std::move(pending));
    work_.add(&pending_.back(), size);
    if (moves_nodes)
      for (std::atomic<double>& v : c_.tables->volume) v = 0;
  }

  void complete(detail::PendingContact& pending, std::size_t worker, int threads) {
    detail::complete_contact(c_, not_evaluated_, pending, in_turn_ ? threads_ : threads);
    const std::size_t so_far = ++completed_;
    if (worker == 0) show_progress(so_far);
  }
  /// Reports the findings of a contact, in their order.
  void conclude(detail::PendingContact& pending) {
    const Contact& contact = c_.scene.contacts[pending.place];
    if (c_.options.penetrations && !contact.dropped) {
      report_empty_sides(contact, pending.complete);
      report(contact, pending.failure);
    }
    c_.findings.merge(std::move(pending.found));
    detail::add_decisions(pending.decisions, pending.place, c_.scene.decisions);
    step();
  }

  void step() {
    ++done_;
    show_progress(0);
  }
  /// `ahead`: contacts complete but not committed. Progress never decreases.
  void show_progress(std::size_t ahead) {
    if (done_ + ahead <= shown_) return;
    shown_ = done_ + ahead;
    if (c_.options.progress) c_.options.progress(shown_, total_);
  }

  /// An empty side is an error of the solver, except for an existing node group. With omitted
  /// members (DK332) it is unknown if a side is empty.
  void report_empty_sides(const Contact& contact, bool complete) {
    if (!complete) return;
    if (contact.main_empty()) report_empty_side(contact, RuleId::DK173, "main", Severity::error);
    if (!contact.secondary_empty()) return;
    const InterBase* inter = contact.inter;
    const std::int64_t group =
        inter->type == 7    ? static_cast<const InterType7*>(inter)->grnd_IDs.value
        : inter->type == 10 ? static_cast<const InterType10*>(inter)->grnd_IDs.value
                            : -1;
    if (group == 0 && inter->type == 7) return;  // it takes the nodes of the main surface
    const bool goes_on = group == 0 || (group > 0 && selections_.node_group(group) != nullptr);
    report_empty_side(contact, RuleId::DK172, "secondary",
                      goes_on ? Severity::warning : Severity::error);
  }

  void report_empty_side(const Contact& contact, RuleId rule, const char* side, Severity severity) {
    const std::string keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
    Finding d = make_finding(rule, contact.inter->span,
                             "the " + std::string(side) + " side of " + keyword + " " +
                                 std::to_string(contact.inter->id) +
                                 (contact.role == ContactRole::reversed ? " (reversed)" : "") +
                                 " is empty: nothing was examined");
    d.severity = severity;
    d.keyword = keyword;
    d.id = contact.inter->id;
    c_.findings.report(std::move(d));
  }

  void report(const Contact& contact, const detail::EvaluationFailure& failure) {
    const auto& [why, severity, of_interface] = failure;
    if (why.empty() || (of_interface && !reported_.insert(contact.inter).second)) return;
    const std::string keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
    Overrides overrides{.severity = severity};
    if (severity == Severity::warning) {
      overrides.solver = "It evaluates the contact.";
      overrides.fix = "Write the group, side, property or transform in a form that deck evaluates.";
    }
    Finding d = make_finding(RuleId::DK380, contact.inter->span,
                             keyword + " " + std::to_string(contact.inter->id) + ": " + why +
                                 "; the contact was not evaluated",
                             std::move(overrides));
    d.keyword = keyword;
    d.id = contact.inter->id;
    c_.findings.report(std::move(d));
  }

  SceneContext& c_;
  Selections& selections_;
  int threads_;
  detail::NotEvaluated not_evaluated_;
  std::set<const InterBase*> reported_;           ///< interfaces with a reported reason
  std::size_t done_ = 0, shown_ = 0, total_ = 0;  ///< contacts
  std::vector<detail::PendingContact> pending_;
  std::atomic<std::size_t> completed_{0};
  bool in_turn_ = detail::moves_nodes(*c_.scene.interfaces);
  SideBySide<detail::PendingContact*> work_{
      in_turn_ ? 1 : threads_, [this](detail::PendingContact* pending, std::size_t worker,
                                      int threads) { complete(*pending, worker, threads); }};
};

bool all_placed(const Coordinates& x) {
  const auto finite = [](double v) { return std::isfinite(v); };
  return std::all_of(x.x.begin(), x.x.end(), finite) &&
         std::all_of(x.y.begin(), x.y.end(), finite) && std::all_of(x.z.begin(), x.z.end(), finite);
}

}  // namespace

detail::CardSettings detail::card_settings(const InterBase& inter) {
  CardSettings c;
  visit_interface(inter, [&](const auto& i) {
    if constexpr (requires { i.Gap_max_s; }) {
      c.inacti = flag(i.Inacti);
      if constexpr (requires { i.Igap; }) c.igap = static_cast<int>(i.Igap.value);
      if constexpr (requires { i.Gap_scale; }) c.gap_scale = i.Gap_scale.value;
      if constexpr (requires { i.mesh_size; }) c.mesh_fraction = i.mesh_size.value;
    } else if constexpr (requires { i.Gap; }) {
      c.gapmin = i.Gap.before_geometry();
    } else {
      c.gapmin = i.Gapmin.before_geometry();
      c.igap = std::max(flag(i.Igap), 0);  // thicknesses count from Igap 1 on
      c.inacti = flag(i.Inacti);
      c.irem_gap = flag(i.Irem_gap);
      // Igap 4 of a TYPE19 overrules the cell.
      if (i.Irem_gap.origin == Origin::derived && i.Igap.value == 4) {
        const auto cell = static_cast<int>(written(i.Irem_gap));
        c.irem_gap = cell == 2 ? 2 : 1;
      }
      c.mesh_fraction = mesh_fraction_of(i.mesh_size.value);
      c.thermal = i.Ithe.value > 0;
      c.drad = i.Drad.before_geometry();
    }
    if constexpr (requires { i.Fscalegap; }) {
      // Fields that Igap disables keep their value on the card, for a what-if with another Igap.
      const auto of = [](const EffectiveReal& v) {
        return v.origin == Origin::derived ? written(v) : v.value;
      };
      if (const double scale = of(i.Fscalegap); scale != 0) c.gap_scale = scale;
      if (const double most = of(i.Gapmax); most != 0) c.gapmax = most;
    }
    if constexpr (requires { i.Fpenmax; }) c.fpenmax = i.Fpenmax.value;
  });
  return c;
}

const char* to_string(ContactKind kind) {
  return kind == ContactKind::node_segment ? "node_segment" : "edge_edge";
}

const char* to_string(ContactRole role) {
  return role == ContactRole::primary    ? "primary"
         : role == ContactRole::reversed ? "reversed"
                                         : "edges";
}

Scene build_scene(const Model& model, const Interfaces& interfaces, Findings& findings,
                  const SceneOptions& options) {
  Scene scene;
  scene.model = &model;
  scene.interfaces = &interfaces;
  scene.limits = options.limits;
  scene.coordinates = {model.nodes.x, model.nodes.y, model.nodes.z};
  scene.judged = options.penetrations;
  if (model.selections == nullptr) return scene;
  Connectivity connectivity(model);
  SceneContext context{model, connectivity, scene, findings, options};
  context.all_placed = all_placed(scene.coordinates);
  Builder(context, *model.selections).build();
  if (options.ties) {
    scene.ties = wanted_ties(context);
    scene.examined = Examined::contacts_and_ties;
  }
  return scene;
}

// ---- mesh-dependent values, written back to the fields of their interfaces ----------------------

const Contact* first_contact(const Scene& scene, const InterBase& inter) {
  for (const Contact& c : scene.contacts)
    if (c.inter == &inter && !c.dropped) return &c;
  return nullptr;
}

double Contact::pair_gap(std::uint32_t of_secondary, std::uint32_t of_main) const {
  const bool edges = kind == ContactKind::edge_edge;
  return gap_rule(edges ? secondary_edges[of_secondary].gap : secondary[of_secondary].gap,
                  edges ? main_edges[of_main].gap : main[of_main].gap,
                  sweep::at(secondary_length, of_secondary, 0), sweep::at(main_length, of_main, 0));
}

double geometry_value(const Contact& contact, std::string_view field) {
  return field == "Drad" ? contact.drad : contact.gapmin;
}

bool waits_for_geometry(const Interfaces& interfaces) {
  bool waits = false;
  for (const InterBase* inter : interfaces.ordered)
    if (!inter->resolved)
      visit_interface(*inter, [&](const auto& t) {
        t.for_each([&](std::string_view, const auto& e) {
          waits = waits || e.origin == Origin::geometry;
        });
      });
  return waits;
}

void resolve(Interfaces& interfaces, const Scene& scene) {
  interfaces.for_each_list([&](auto& list) {
    for (auto& inter : list) {
      const Contact* const contact = first_contact(scene, inter);
      if (contact == nullptr) continue;
      inter.for_each([&](std::string_view name, auto& field) {
        if constexpr (std::is_same_v<decltype(field), EffectiveReal&>)
          if (field.origin == Origin::geometry) field.value = geometry_value(*contact, name);
      });
      inter.resolved = true;
    }
  });
}

}  // namespace deck
