// Names of contacts, segments, elements and lists as the findings of the geometry checks say them.
#include <algorithm>

#include "deck/lint/geometry.hpp"
#include "lint/checks/geometry/geometry.hpp"

namespace deck {
namespace detail {

const ContactCard* GeometryRun::card(const Contact& contact) const {
  for (const ContactCard& card : context.contacts)
    if (card.inter == contact.inter) return &card;
  return nullptr;
}

Diagnostic* GeometryRun::report(RuleId id, const Contact& contact, std::string_view field,
                                std::string message) const {
  const ContactCard* c = card(contact);
  const Rule& rule = rule_of(id);
  if (c == nullptr) return reporter.report(rule, contact.inter->span, std::move(message));
  return report_at(reporter, rule, *c, field, std::move(message));
}

std::string name_of(const GeometryRun&, const Contact& contact) {
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
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

std::string list_text(const std::vector<std::int64_t>& list) {
  constexpr std::size_t most = 5;
  std::string out;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i)
    out += fmt::format("{}{}", i == 0 ? "" : ", ", list[i]);
  if (list.size() > most) out += fmt::format(" and {} more", list.size() - most);
  return out;
}

}  // namespace detail

void check_geometry(const LintContext& context, Reporter& reporter, const GeometryOptions& chosen) {
  if (context.model == nullptr || context.interfaces == nullptr) return;
  Diagnostics found;
  SceneOptions options;
  options.threads = chosen.threads;
  options.limits = chosen.limits;
  options.candidates = false;
  options.nodal_stiffness = true;  // the forces of Istf 2 to 5 need it
  const Scene scene = build_scene(*context.model, *context.interfaces, found, options);
  for (const Diagnostic& d : found.all()) {
    // The check of references says it with the cell and the reason.
    if (d.rule == RuleId::DK172 || d.rule == RuleId::DK173) continue;
    if (Diagnostic* out = reporter.report(rule_of(d.rule), d.span, d.message))
      out->severity = d.severity;
  }
  const SceneView view = make_view(scene);
  const detail::GeometryRun run{context, reporter, scene, view, chosen.threads};
  detail::check_penetrations(run);
  detail::check_gaps(run);
  detail::check_segments(run);
  detail::check_manual_geometry(run);
  detail::check_tables(run);
  const cycle::SceneOutcome forces = detail::check_cycle(run);
  if (chosen.gate == nullptr) return;
  for (const Diagnostic& d : check_gate(*chosen.gate, scene, view, &forces, chosen.earlier))
    if (Diagnostic* out = reporter.report(rule_of(d.rule), d.span, d.message)) {
      out->keyword = d.keyword;
      out->id = d.id;
    }
}

}  // namespace deck
