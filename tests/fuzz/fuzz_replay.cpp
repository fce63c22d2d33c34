// Recorded states: any CSV, plain or gzip, is read or refused, and the statistics are sound.
#include <cmath>

#include "cycle/shared/replay.hpp"
#include "support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace deck;
  using fuzz::require;
  if (size > 32768) return 0;
  const std::string bytes = fuzz::text_of(data, size);
  const auto csv = cycle::states_text(bytes, std::size_t{1} << 22);
  if (!csv) return 0;
  require(csv->size() <= std::size_t{1} << 22, "inflating stops at its limit");
  // The card comes from the same bytes: every effect that a card can ask for.
  std::uint64_t h = fuzz::hash_of(bytes);
  const auto pick = [&h](int n) {
    const int v = static_cast<int>(h % static_cast<std::uint64_t>(n));
    h /= static_cast<std::uint64_t>(n);
    return v;
  };
  cycle::ContactCard card;
  constexpr cycle::ContactKind kinds[] = {cycle::ContactKind::node_segment,
                                          cycle::ContactKind::tied, cycle::ContactKind::edge_edge};
  card.kind = kinds[pick(3)];
  card.istf = pick(6);
  card.igap = pick(4);
  card.inacti = pick(8);
  card.visf = pick(2);
  card.fric = 0.1 * pick(3);
  card.ifric = pick(5);
  card.iform = 1 + pick(2);
  card.ifiltr = pick(4);
  card.xfreq = 0.5 * pick(3);
  card.icurv = pick(4);
  card.iadm = pick(3);
  card.ithe = pick(2);
  card.ithe_form = pick(2);
  card.kthe = pick(2);
  card.itied = pick(3);
  card.ibc = pick(8);
  if (pick(2) == 1) card.fct_idf = cycle::Curve{{0, 1, 1, 2}, {0.1, 0.2, 0.3, 0.1}};
  cycle::ReplayOptions options;
  options.model = pick(2) == 0 ? cycle::Model::reference : cycle::Model::robust;
  const cycle::ReplayReport report = cycle::replay(card, *csv, options);
  if (!report.error.empty()) return 0;
  require(report.compared <= report.records, "no more states are compared than there are");
  require(report.zero_rows <= report.compared, "zero rows are compared rows");
  require(!std::isnan(report.median) && !std::isnan(report.p99) && !std::isnan(report.max),
          "an error is never undefined");
  require(report.median <= report.p99 && report.p99 <= report.max, "percentiles are in order");
  require(report.worst.size() <= 10, "the worst ten are kept");
  return 0;
}
