#include "deck/cycle/replay.hpp"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "deck/cycle/heat.hpp"
#include "deck/cycle/kernel.hpp"

namespace deck::cycle {
namespace {

/// Columns of numbers by name, read from text.
class Table {
 public:
  /// False when the text has no header or a row does not fit it; `error` says why.
  bool read(std::string_view text, std::string& error) {
    std::size_t row = 0;
    while (!text.empty()) {
      const std::size_t eol = text.find('\n');
      std::string_view line = text.substr(0, eol);
      text.remove_prefix(eol == std::string_view::npos ? text.size() : eol + 1);
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      if (line.empty()) continue;
      if (names_.empty()) {
        header(line);
        continue;
      }
      ++row;
      if (!values(line)) {
        error = "row " + std::to_string(row) + " does not fit the header";
        return false;
      }
    }
    if (names_.empty()) error = "no header line";
    return error.empty();
  }
  [[nodiscard]] bool has(const std::string& name) const { return names_.contains(name); }
  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_[0].size(); }
  [[nodiscard]] const double* column(const std::string& name) const {
    const auto it = names_.find(name);
    return it == names_.end() ? nullptr : columns_[it->second].data();
  }
  [[nodiscard]] std::array<const double*, 3> triple(const std::string& stem) const {
    return {column(stem + "_x"), column(stem + "_y"), column(stem + "_z")};
  }

 private:
  void header(std::string_view line) {
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t comma = std::min(line.find(',', at), line.size());
      names_.emplace(std::string(line.substr(at, comma - at)), columns_.size());
      columns_.emplace_back();
      at = comma + 1;
    }
  }
  bool values(std::string_view line) {
    const char* p = line.data();
    const char* const end = p + line.size();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      double value = 0.0;
      const auto [next, code] = std::from_chars(p, end, value);
      // Smaller than any double: the nearest is 0.
      if (code != std::errc() && code != std::errc::result_out_of_range) return false;
      columns_[c].push_back(value);
      p = next;
      if (c + 1 == columns_.size()) return p == end;
      if (p == end || *p != ',') return false;
      ++p;
    }
    return true;
  }

  std::map<std::string, std::size_t> names_;
  std::vector<std::vector<double>> columns_;
};

bool finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// Euclidean norm; infinite where a component is no number.
double norm(const std::vector<double>& v) {
  if (!finite(v)) return INFINITY;
  double scale = 0.0, sum = 0.0;
  for (const double x : v) scale = std::max(scale, std::abs(x));
  if (scale == 0.0) return 0.0;
  for (const double x : v) sum += (x / scale) * (x / scale);
  return scale * std::sqrt(sum);
}

/// |computed - reference| / |reference|. What is no number equals nothing, not even itself.
double relative(const std::vector<double>& computed, const std::vector<double>& reference) {
  if (!finite(computed) || !finite(reference)) return INFINITY;
  std::vector<double> difference(reference.size());
  for (std::size_t c = 0; c < reference.size(); ++c) difference[c] = computed[c] - reference[c];
  const double size = norm(reference), off = norm(difference);
  return size > 0.0 ? off / size : (off > 0.0 ? off : 0.0);
}

/// Collects the comparison of rows.
class Comparison {
 public:
  void row(std::size_t number, std::vector<double> reference, std::vector<double> computed,
           double scale) {
    if (norm(reference) == 0.0) {
      ++report.zero_rows;
      const double off = scale > 0.0 ? norm(computed) / scale : norm(computed);
      report.zero_max_over_k0_gap = std::max(report.zero_max_over_k0_gap, off);
      return;
    }
    const double e = relative(computed, reference);
    errors_.push_back(e);
    rows_.push_back({number, errors_.back(), std::move(reference), std::move(computed)});
    if (rows_.size() > 4096) keep_worst();
  }
  ReplayReport finish(std::size_t records) {
    keep_worst();
    report.worst = std::move(rows_);
    report.records = records;
    report.compared = errors_.size() + report.zero_rows;
    if (!errors_.empty()) {
      std::sort(errors_.begin(), errors_.end());
      const std::size_t n = errors_.size();
      report.median = errors_[n / 2];
      report.p99 = errors_[(99 * (n - 1) + 99) / 100];
      report.max = errors_.back();
    }
    return std::move(report);
  }
  ReplayReport report;

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

/// Points a view at rows [first, first + n) of the columns.
template <std::size_t N>
std::array<const double*, N> shifted(std::array<const double*, N> p, std::size_t first) {
  for (const double*& q : p) {
    if (q != nullptr) q += first;
  }
  return p;
}
const double* shifted(const double* p, std::size_t first) { return p ? p + first : nullptr; }

struct Columns {
  PacketView view;
  std::vector<double> residual;  ///< TYPE11: both edges' initial penetrations
  std::vector<std::uint8_t> triangle;
};

Columns columns_of(const Table& t, const std::string& kind) {
  Columns c;
  const bool edges = kind == "edge_edge";
  const std::array<std::string, 5> role =
      edges ? std::array<std::string, 5>{"s1", "s2", "m1", "m2", ""}
            : std::array<std::string, 5>{"s", "1", "2", "3", "4"};
  for (std::size_t r = 0; r < (edges ? 4u : 5u); ++r) {
    c.view.position[r] = t.triple("x" + role[r]);
    c.view.velocity[r] = t.triple("v" + role[r]);
    c.view.mass[r] = t.column((edges ? "mass_" : "m") + role[r]);
  }
  c.view.k0 = t.column("K0");
  c.view.gap = t.column("gap");
  c.view.p0 = t.column("P0_in");
  c.view.ft_old = t.triple("ft_in");
  if (edges) {
    const double* s = t.column("pen_s_used");
    const double* m = t.column("pen_m_used");
    for (std::size_t i = 0; s && m && i < t.rows(); ++i) c.residual.push_back(s[i] + m[i]);
    c.view.p0 = c.residual.data();
  } else {
    const double* n3 = t.column("n3");
    const double* n4 = t.column("n4");
    for (std::size_t i = 0; n3 && n4 && i < t.rows(); ++i) c.triangle.push_back(n3[i] == n4[i]);
  }
  if (kind == "tied") {
    c.view.tie = {t.column("Fn_in"), t.column("Ft1_in"), t.column("Ft2_in"),
                  t.column("H1_in"), t.column("H2_in"),  t.column("H3_in")};
  } else {
    const char* const part[] = {"Fn", "Ft1", "Ft2", "H1", "H2", "H3", "pen", "side"};
    for (std::size_t k = 0; k < 8; ++k) c.view.tie[k] = t.column(std::string("tie_in_") + part[k]);
  }
  return c;
}

PacketView rows_of(const Columns& c, std::size_t first, std::size_t n) {
  PacketView v = c.view;
  v.size = n;
  for (std::size_t r = 0; r < 5; ++r) {
    v.position[r] = shifted(v.position[r], first);
    v.velocity[r] = shifted(v.velocity[r], first);
  }
  v.mass = shifted(v.mass, first);
  v.k0 = shifted(v.k0, first);
  v.gap = shifted(v.gap, first);
  v.p0 = shifted(v.p0, first);
  v.ft_old = shifted(v.ft_old, first);
  v.tie = shifted(v.tie, first);
  v.triangle = c.triangle.empty() ? nullptr : c.triangle.data() + first;
  return v;
}

/// Compares what else was recorded with what else was computed.
void compare_more(const Table& t, const std::string& kind, std::size_t row, std::size_t i,
                  const PacketResult& out, ReplayReport& report) {
  const auto check = [&](const std::vector<std::string>& names, auto value, double& worst) {
    std::vector<double> reference, computed;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const double* column = t.column(names[k]);
      if (column == nullptr) return;
      reference.push_back(column[row]);
      computed.push_back(value(k));
    }
    worst = std::max(worst, relative(computed, reference));
  };
  const bool edges = kind == "edge_edge";
  check(
      edges ? std::vector<std::string>{"hs1", "hs2", "hm1", "hm2"}
            : std::vector<std::string>{"H1", "H2", "H3", "H4"},
      [&](std::size_t k) { return out.weights[k][i]; }, report.max_weights);
  check(
      {"K_nodal"}, [&](std::size_t) { return out.k_nodal[i]; }, report.max_nodal_stiffness);
  check(
      {"P0_out"}, [&](std::size_t) { return out.p0[i]; }, report.max_p0);
  check(
      {"ft_out_x", "ft_out_y", "ft_out_z"}, [&](std::size_t k) { return out.ft[k][i]; },
      report.max_friction_memory);
  const auto tie = [&](std::size_t k) { return out.tie[k][i]; };
  if (kind == "tied") {
    check({"Fn_out", "Ft1_out", "Ft2_out", "H1_out", "H2_out", "H3_out"}, tie, report.max_tie);
  } else {
    check({"tie_out_Fn", "tie_out_Ft1", "tie_out_Ft2", "tie_out_H1", "tie_out_H2", "tie_out_H3",
           "tie_out_pen", "tie_out_side"},
          tie, report.max_tie);
  }
}

void replay_packet(const KernelPlan& plan, const Table& t, const Columns& columns,
                   const std::string& kind, std::size_t first, std::size_t n, Comparison& out) {
  PacketView view = rows_of(columns, first, n);
  view.dt1 = t.column("dt1")[first];
  view.dt12 = t.column("dt12")[first];
  PacketResult result;
  evaluate(plan, view, result);
  const bool edges = kind == "edge_edge";
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = first + i;
    std::vector<double> reference, computed;
    // Edges record the four nodal forces: the pair force is the sum over the main edge.
    const std::array<const double*, 3> f = edges ? t.triple("f3") : t.triple("F");
    const std::array<const double*, 3> f2 = edges ? t.triple("f4") : std::array<const double*, 3>{};
    for (std::size_t c = 0; c < 3; ++c) {
      reference.push_back(edges ? f[c][row] + f2[c][row] : f[c][row]);
      computed.push_back(result.force[c][i]);
    }
    out.row(row + 1, std::move(reference), std::move(computed), view.k0[i] * view.gap[i]);
    compare_more(t, kind, row, i, result, out.report);
  }
}

void replay_heat(const ContactCard& card, const Table& t, Model model, std::size_t row,
                 Comparison& out) {
  const char* const role[] = {"s", "1", "2", "3", "4"};
  HeatState s;
  std::vector<double> reference;
  for (std::size_t r = 0; r < 5; ++r) {
    const auto x = t.triple(std::string("x") + role[r]);
    for (std::size_t c = 0; c < 3; ++c) s.position[r][c] = x[c][row];
    s.temperature[r] = t.column(std::string("T") + role[r])[row];
    reference.push_back(t.column(std::string("Q_") + role[r])[row]);
    if (r > 0) s.weight[r - 1] = t.column(std::string("H") + role[r])[row];
  }
  s.area = t.column("area_s")[row];
  s.normal_force = t.column("Fn")[row];
  s.friction_heat = t.column("E_fric")[row];
  s.gap = t.column("gap")[row];
  s.dt1 = t.column("dt1")[row];
  const HeatFlow flow = pair_heat(card, s, model);
  out.row(row + 1, std::move(reference), {flow.q.begin(), flow.q.end()}, 0.0);
}

std::string kind_of(const Table& t) {
  if (t.has("E_fric")) return "heat";
  if (t.has("hs1")) return "edge_edge";
  if (t.has("Fn_in")) return "tied";
  return "node_segment";
}

std::vector<std::string> needed_columns(const std::string& kind) {
  std::vector<std::string> names{"dt1"};
  const auto triples = [&](std::initializer_list<const char*> stems) {
    for (const char* stem : stems) {
      for (const char* axis : {"_x", "_y", "_z"}) names.push_back(std::string(stem) + axis);
    }
  };
  if (kind == "edge_edge") {
    triples({"xs1", "xs2", "xm1", "xm2", "vs1", "vs2", "vm1", "vm2", "f3", "f4"});
    names.insert(names.end(), {"dt12", "K0", "gap", "pen_s_used", "pen_m_used", "mass_s1"});
    return names;
  }
  triples({"xs", "x1", "x2", "x3", "x4"});
  if (kind == "heat") {
    for (const char* r : {"s", "1", "2", "3", "4"}) {
      names.push_back(std::string("T") + r);
      names.push_back(std::string("Q_") + r);
    }
    names.insert(names.end(), {"H1", "H2", "H3", "H4", "area_s", "Fn", "E_fric", "gap"});
    return names;
  }
  triples({"vs", "v1", "v2", "v3", "v4", "F"});
  names.insert(names.end(), {"dt12", "K0", "gap", "ms"});
  return names;
}

std::string check_columns(const Table& t, const std::string& kind, const ContactCard& card) {
  for (const std::string& name : needed_columns(kind)) {
    if (!t.has(name)) return "column " + name + " is missing";
  }
  const ContactKind expected = kind == "edge_edge" ? ContactKind::edge_edge
                               : kind == "tied"    ? ContactKind::tied
                                                   : ContactKind::node_segment;
  if (card.kind != expected) return "the states (" + kind + ") do not fit the interface's type";
  return {};
}

}  // namespace

ReplayReport replay(const ContactCard& card, std::string_view csv, const ReplayOptions& options) {
  Table table;
  Comparison comparison;
  ReplayReport failed;
  if (!table.read(csv, failed.error)) return failed;
  const std::string kind = kind_of(table);
  failed.kind = kind;
  failed.error = check_columns(table, kind, card);
  if (!failed.error.empty()) return failed;
  const Columns columns = columns_of(table, kind);
  const KernelPlan plan = make_plan(card, options.model, options.plan);
  if (kind != "heat" && missing_fields(plan, columns.view) != Field::none) {
    failed.error = "the states lack columns that the interface's effects need";
    return failed;
  }
  const double* id = table.column("interface");
  const double* dt1 = table.column("dt1");
  const double* dt12 = table.column("dt12");
  std::size_t records = 0;
  const auto wanted = [&](std::size_t row) {
    return options.interface_id == 0 || id == nullptr || id[row] == options.interface_id;
  };
  for (std::size_t row = 0; row < table.rows();) {
    if (!wanted(row)) {
      ++row;
      continue;
    }
    std::size_t n = 1;
    if (kind == "heat") {
      replay_heat(card, table, options.model, row, comparison);
    } else {  // pairs of one cycle make a packet: they share the time step
      while (row + n < table.rows() && wanted(row + n) && dt1[row + n] == dt1[row] &&
             dt12[row + n] == dt12[row]) {
        ++n;
      }
      replay_packet(plan, table, columns, kind, row, n, comparison);
    }
    records += n;
    row += n;
  }
  ReplayReport report = comparison.finish(records);
  report.kind = kind;
  return report;
}

std::optional<std::string> states_text(std::string_view bytes, std::size_t limit) {
  const bool gzip = bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
  if (!gzip) return std::string(bytes);
  z_stream z{};
  if (inflateInit2(&z, 15 + 32) != Z_OK) return std::nullopt;
  std::string text;
  std::vector<char> chunk(1 << 16);
  int code = Z_OK;
  std::size_t used = 0;
  while (code == Z_OK || (code == Z_STREAM_END && used < bytes.size())) {
    if (code == Z_STREAM_END && inflateReset(&z) != Z_OK) break;  // a further gzip member
    if (z.avail_in == 0) {
      const std::size_t n = std::min<std::size_t>(bytes.size() - used, 1 << 20);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + used));
      z.avail_in = static_cast<uInt>(n);
      used += n;
    }
    z.next_out = reinterpret_cast<Bytef*>(chunk.data());
    z.avail_out = static_cast<uInt>(chunk.size());
    code = inflate(&z, Z_NO_FLUSH);
    const std::size_t made = chunk.size() - z.avail_out;
    if (text.size() + made > limit) {
      code = Z_MEM_ERROR;
      break;
    }
    text.append(chunk.data(), made);
    if (code == Z_STREAM_END) {  // hand back what the next member starts with
      used -= z.avail_in;
      z.avail_in = 0;
    }
    if (code == Z_BUF_ERROR) break;
  }
  inflateEnd(&z);
  if (code != Z_STREAM_END) return std::nullopt;
  return text;
}

}  // namespace deck::cycle
