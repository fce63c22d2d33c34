// Runs the geometry checks; names of contacts, segments, elements and lists in their findings.
#include <algorithm>

#include "base/shared/parallel.hpp"
#include "base/shared/words.hpp"
#include "lint/checks/geometry/geometry.hpp"
#include "lint/shared/geometry.hpp"

namespace deck {
namespace detail {

const ContactCard* GeometryRun::card(const InterBase& inter) const {
  for (const ContactCard& card : context.contacts)
    if (card.block == inter.block) return &card;
  return nullptr;
}

Finding& GeometryRun::report(RuleId id, const InterBase& inter, std::string_view field,
                             std::string message, std::optional<double> amount) const {
  const ContactCard* c = card(inter);
  const Rule& rule = rule_of(id);
  Finding& d = c == nullptr ? reporter.report(rule, inter.span, std::move(message))
                            : report_at(reporter, rule, *c, field, std::move(message));
  d.amount = amount;
  return d;
}

std::string name_of(const Contact& contact) {
  std::string name = fmt::format("/INTER/TYPE{} {}", contact.inter->type, contact.inter->id);
  if (contact.role != ContactRole::primary) name += fmt::format(" ({})", to_string(contact.role));
  return name;
}

std::string nodes_text(const Model& model, const MainSegment& segment) {
  const auto& n = segment.nodes;
  std::string out;
  for (std::size_t k = 0; k < (n[2] == n[3] ? 3U : 4U); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : " ", model.node_id(n[k]));
  return out;
}

std::string element_text(const ElementName& e) {
  return e.valid() ? fmt::format("element {} of part {}", e.id, e.part) : "no element";
}

std::string count_text(std::size_t n, std::string_view one) {
  return count(n, one, std::string(one) + "s");
}

namespace {

std::uint64_t segments_of(Selections& selections, std::int64_t surface) {
  const auto outline = selections.outline(surface);
  return outline ? outline->segments.size() : 0;
}

std::uint64_t edges_of(Selections& selections, std::int64_t id) {
  const LineSet* line = selections.line(id);
  return line == nullptr ? 0 : line->edges.size();
}

/// Number of members of the sides of an interface.
std::uint64_t members_of(Selections& selections, const InterBase& inter) {
  std::uint64_t out = 0;
  visit_any_interface(inter, [&](const auto& i) {
    if constexpr (std::is_same_v<std::decay_t<decltype(i)>, InterType2>) {
      const NodeSet* group = selections.node_group(i.grnd_IDs.value);
      out = segments_of(selections, i.surf_IDm.value) + segments_of(selections, i.surf_IDs.value) +
            (group ? group->nodes.size() : 0);
    } else if constexpr (requires { i.line_IDs; })
      out = edges_of(selections, i.line_IDs.value) + edges_of(selections, i.line_IDm.value);
    else if constexpr (requires { i.surf_IDs; })  // both directions, and edges
      out = 4 *
            (segments_of(selections, i.surf_IDs.value) + segments_of(selections, i.surf_IDm.value));
    else if constexpr (requires { i.surf_ID1; })  // front and back of shells
      out = 2 *
            (segments_of(selections, i.surf_ID1.value) + segments_of(selections, i.surf_ID2.value));
    else {
      const NodeSet* group = selections.node_group(i.grnd_IDs.value);
      out = segments_of(selections, i.surf_IDm.value) + (group ? group->nodes.size() : 0);
    }
  });
  return out;
}

/// Number of items of a model and its contacts.
std::uint64_t items_of(const LintContext& context) {
  const Model& m = *context.model;
  std::uint64_t out = m.nodes.size();
  for (const Elements* e :
       {&m.shell4, &m.shell3, &m.solid8, &m.quad, &m.tria, &m.truss, &m.beam, &m.spring})
    out += e->size();
  for (const InterBase* inter : context.interfaces->all)
    out += members_of(*context.selections, *inter);
  return out;
}

cycle::SceneOutcome first_cycle(const Scene& scene, const EngineFiles& engine, int threads) {
  cycle::CycleOptions options;  // as LoadedDeck::cycle(), without its pairs
  options.threads = threads;
  return cycle::run_cycle(scene, cycle::make_state(scene, {}, &engine, threads), options);
}

}  // namespace

NotChecked too_many_pairs(const std::string& contact, std::string_view what) {
  return {fmt::format("{}: {}", contact, what),
          "too many pairs are within its gap for a quick check; --geometry checks all of them"};
}

}  // namespace detail

std::vector<NotChecked> check_geometry(const LintContext& context, Reporter& reporter,
                                       const GeometryOptions& chosen) {
  std::vector<NotChecked> left_out;
  if (context.interfaces->all.empty()) return left_out;
  if (const std::uint64_t items = chosen.quick ? detail::items_of(context) : 0;
      chosen.quick && items > chosen.quick->items)
    return {{std::string(geometry_rules),
             fmt::format("the model and the sides of its contacts have {} nodes, elements and "
                         "segments, more than {}; --geometry checks all of them",
                         items, chosen.quick->items)}};
  Findings of_quick;
  std::optional<Scene> smaller;
  if (chosen.quick) {
    SceneOptions options = context.loaded->scene_options();
    options.limits.pair_bytes = std::min(options.limits.pair_bytes, chosen.quick->pair_bytes);
    options.candidates = false;
    options.ties = true;
    smaller = context.loaded->scene_with(options, of_quick);
  }
  const Scene& scene = smaller ? *smaller : context.loaded->scene();
  const Findings& found = smaller ? of_quick : context.loaded->found_by(Stage::scene);
  for (const Finding& d : found.all()) {
    // reported by the check of references, with cell and reason
    if (d.rule == RuleId::DK172 || d.rule == RuleId::DK173) continue;
    if (chosen.quick && d.rule == RuleId::DK390) {
      left_out.push_back(
          detail::too_many_pairs(fmt::format("{} {}", d.keyword, d.id), "penetrations and forces"));
      continue;
    }
    reporter.report(rule_of(d.rule), d.span, d.message) = d;
  }
  if (const auto large = found.counts().find(RuleId::DK390);
      chosen.quick && chosen.too_large != nullptr && large != found.counts().end())
    *chosen.too_large = large->second;
  const int threads = context.loaded->options().threads;
  std::vector<Crossing> crossings;
  cycle::SceneOutcome forces;
  // Crossings only read the scene; forces also write its selections.
  parallel_items(threads, 2, [&](std::size_t task) {
    if (task == 0) crossings = find_crossings(scene, threads);
    if (task == 1) forces = detail::first_cycle(scene, context.loaded->engine_files(), threads);
  });
  const SceneView view = make_view(scene, &crossings, threads);
  if (chosen.seen) chosen.seen(scene, view);
  const bool with_ties = scene.examined == Examined::contacts_and_ties;
  const detail::GeometryRun run{context, reporter,  scene,
                                view,    crossings, with_ties ? scene.ties : context.loaded->ties(),
                                threads, left_out,  chosen.quick.has_value()};
  detail::check_penetrations(run);
  detail::check_gaps(run);
  detail::check_segments(run);
  detail::check_manual_differences(run);
  detail::check_ties(run);
  detail::check_cycle(run, forces);
  if (chosen.gate == nullptr || !chosen.gate->any()) return left_out;
  for (const Finding& d :
       check_gate(*chosen.gate, scene, view, &forces, chosen.earlier, chosen.changed))
    reporter.report(rule_of(d.rule), d.span, d.message) = d;
  return left_out;
}

}  // namespace deck
