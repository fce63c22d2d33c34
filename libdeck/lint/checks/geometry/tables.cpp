// Tables that the solver's listing has because Ipri asks for details.
#include <algorithm>

#include "lint/checks/geometry/geometry.hpp"

namespace deck::detail {
namespace {

constexpr std::int64_t pairs_from = 5, segments_from = 10;  // Ipri

/// The Ipri cell of /IOFLAG; its value is 0 where there is none.
Cell printout_level(const LintContext& c) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || b.schema->keyword != "/IOFLAG") continue;
    const DecodedBlock d = decode(c.deck, b);
    if (const Cell* cell = d.find("Ipri")) return *cell;
  }
  return {};
}

}  // namespace

void check_tables(const GeometryRun& run) {
  const Cell level = printout_level(run.context);
  if (level.integer < pairs_from) return;
  const auto report = [&](const Contact& c, int message, std::string what) {
    Diagnostic* d = run.report(RuleId::DK606, c, "", std::move(what));
    if (d == nullptr) return;
    d->reference = rule_of(RuleId::DK606).message(message);
    d->notes.emplace_back(level.span, "asks for the table");
  };
  for (const Contact& c : run.scene.contacts) {
    const bool edges = c.kind == ContactKind::edge_edge;
    const auto pairs = std::count_if(c.penetrations.begin(), c.penetrations.end(),
                                     [](const PenetrationRow& r) { return !r.on_surface; });
    if (!edges && pairs > 0)
      report(c, 1164,
             fmt::format("{}: the listing has a table of its {} (Ipri = {})", name_of(run, c),
                         count_text(static_cast<std::size_t>(pairs), "penetrating pair"),
                         level.integer));
    if (level.integer >= segments_from && c.reoriented_segments > 0)
      report(c, 3024,
             fmt::format(
                 "{}: the listing has a table of its {} (Ipri = {})", name_of(run, c),
                 count_text(static_cast<std::size_t>(c.reoriented_segments), "turned main segment"),
                 level.integer));
  }
}

}  // namespace deck::detail
