// Compares recorded states with the kernel: recomputes the result columns by groups.
#include "replay/replay.hpp"

#include <algorithm>
#include <cmath>

#include "replay/results.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cycle {
namespace {

using detail::ColumnGroup;
using detail::ResultTable;
using detail::Table;

bool finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// Euclidean norm; infinite if a component is NaN.
double norm(const std::vector<double>& v) {
  if (!finite(v)) return INFINITY;
  double scale = 0.0, sum = 0.0;
  for (const double x : v) scale = std::max(scale, std::abs(x));
  if (scale == 0.0) return 0.0;
  for (const double x : v) sum += (x / scale) * (x / scale);
  return scale * std::sqrt(sum);
}

/// |computed - reference| / `size`. NaN equals nothing.
double relative(const std::vector<double>& computed, const std::vector<double>& reference,
                double size) {
  if (!finite(computed) || !finite(reference)) return INFINITY;
  std::vector<double> difference(reference.size());
  for (std::size_t c = 0; c < reference.size(); ++c) difference[c] = computed[c] - reference[c];
  const double off = norm(difference);
  return size > 0.0 ? off / size : off;
}

/// Statistics of one group of columns.
class Comparison {
 public:
  void row(std::size_t number, std::vector<double> reference, std::vector<double> computed,
           double zero_scale) {
    ++column.rows;
    const double size = norm(reference);
    if (size == 0.0) {
      ++zero_rows;
      const double off = relative(computed, reference, zero_scale);
      zero_max = std::max(zero_max, off);
      if (off > column.zero_max) column.zero_max = off;
      return;
    }
    const double e = relative(computed, reference, size);
    errors_.push_back(e);
    rows_.push_back({number, e, std::move(reference), std::move(computed)});
    if (rows_.size() > 4096) keep_worst();
  }
  void summarize() {
    keep_worst();
    column.acting = errors_.size();
    if (errors_.empty()) return;
    std::sort(errors_.begin(), errors_.end());
    const std::size_t n = errors_.size();
    column.median = errors_[n / 2];
    column.p99 = errors_[(99 * (n - 1) + 99) / 100];
    column.max = errors_.back();
  }
  std::vector<ReplayWorst> worst_rows() { return std::move(rows_); }
  ReplayColumn column;
  std::size_t zero_rows = 0;
  double zero_max = 0.0;

 private:
  void keep_worst() {
    std::stable_sort(rows_.begin(), rows_.end(), [](const auto& a, const auto& b) {
      return a.relative_error > b.relative_error;
    });
    if (rows_.size() > 10) rows_.resize(10);
  }
  std::vector<double> errors_;
  std::vector<ReplayWorst> rows_;
};

/// Scale for zero rows of a group: K0 gap for forces, else the largest recorded value.
double zero_scale(const Table& table, const ColumnGroup& group, const ResultTable& results,
                  std::size_t row) {
  const double* k0 = table.column("K0");
  const double* gap = table.column("gap");
  if (group.force && k0 != nullptr && gap != nullptr) return k0[row] * gap[row];
  double largest = 0.0;
  for (const std::string& name : group.columns)
    for (const std::size_t r : results.row)
      if (const double v = std::abs(table.column(name)[r]); std::isfinite(v))
        largest = std::max(largest, v);
  return largest;
}

/// Pair force of edges: sum of both ends of the main edge.
void compare_edge_force(const Table& table, const ResultTable& results, Comparison& out) {
  for (std::size_t i = 0; i < results.row.size(); ++i) {
    const std::size_t row = results.row[i];
    std::vector<double> reference, computed;
    for (const char* axis : {"_x", "_y", "_z"}) {
      const std::string a = std::string("f3") + axis, b = std::string("f4") + axis;
      reference.push_back(table.column(a)[row] + table.column(b)[row]);
      computed.push_back((*results.column(a))[i] + (*results.column(b))[i]);
    }
    out.row(row + 1, std::move(reference), std::move(computed),
            table.column("K0")[row] * table.column("gap")[row]);
  }
}

void compare_group(const Table& table, const ColumnGroup& group, const ResultTable& results,
                   Comparison& out) {
  const double constant = group.force ? 0.0 : zero_scale(table, group, results, 0);
  for (std::size_t i = 0; i < results.row.size(); ++i) {
    const std::size_t row = results.row[i];
    std::vector<double> reference, computed;
    for (const std::string& name : group.columns) {
      reference.push_back(table.column(name)[row]);
      computed.push_back((*results.column(name))[i]);
    }
    const double scale = group.force ? zero_scale(table, group, results, row) : constant;
    out.row(row + 1, std::move(reference), std::move(computed), scale);
  }
}

void compare(const Table& table, const std::string& kind, const ResultTable& results,
             ReplayReport& report) {
  const auto groups = detail::column_groups(table, kind);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Comparison one;
    one.column.name = groups[g].name;
    compare_group(table, groups[g], results, one);
    one.summarize();
    report.columns.push_back(one.column);
    if (g > 0) continue;
    Comparison whole;
    if (kind == "edge_edge") {
      compare_edge_force(table, results, whole);
      whole.summarize();
    }
    Comparison& main = kind == "edge_edge" ? whole : one;
    report.compared = main.column.rows;
    report.median = main.column.median;
    report.p99 = main.column.p99;
    report.max = main.column.max;
    report.zero_rows = main.zero_rows;
    report.zero_max_over_k0_gap = main.zero_max;
    report.worst = main.worst_rows();
  }
}

/// Number of rows with a non-zero recorded value (except weights).
std::size_t acting_rows(const Table& table, const std::string& kind, const ResultTable& results) {
  std::vector<const double*> columns;
  for (const auto& group : detail::column_groups(table, kind))
    if (group.force || group.name == "Q" || group.name == "K_nodal")
      for (const std::string& name : group.columns) columns.push_back(table.column(name));
  return static_cast<std::size_t>(
      std::count_if(results.row.begin(), results.row.end(), [&](std::size_t row) {
        return std::any_of(columns.begin(), columns.end(),
                           [&](const double* c) { return c[row] != 0.0; });
      }));
}

}  // namespace

ReplayReport replay(const ContactCard& card, std::string_view csv, const ReplayOptions& options) {
  Table table;
  ReplayReport report;
  if (!table.read(csv, report.error)) return report;
  if (table.rows() == 0) {
    report.error = "no states: nothing follows the header line";
    return report;
  }
  report.kind = detail::kind_of(table);
  report.error = detail::check_columns(table, report.kind, card);
  if (!report.error.empty()) return report;
  const ResultTable results =
      detail::compute_results(card, table, report.kind, options, report.error);
  if (!report.error.empty()) return report;
  report.records = results.row.size();
  compare(table, report.kind, results, report);
  report.acting = acting_rows(table, report.kind, results);
  if (options.csv) report.csv = to_csv(results);
  return report;
}

std::optional<std::string> states_text(std::string_view bytes, std::uint64_t limit) {
  if (!is_gzip(bytes)) return std::string(bytes);
  auto text = gunzip(bytes, limit);
  if (!text) return std::nullopt;
  return std::move(*text);
}

}  // namespace deck::cycle
