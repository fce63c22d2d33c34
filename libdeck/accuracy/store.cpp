// Writes and reads a measurement: one line a record, floating-point numbers as their bits, the last
// line a hash of all before it.
#include "accuracy/shared/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

#include "base/shared/hash.hpp"

namespace deck {
namespace {

constexpr char column_separator = '\t';

struct RowWriter {
  std::string out;
  RowWriter& add(std::string_view text) {
    out += text;
    out += column_separator;
    return *this;
  }
  RowWriter& add(double v) { return add(std::bit_cast<std::uint64_t>(v)); }
  RowWriter& add(std::uint64_t v) { return add(std::string_view(std::to_string(v))); }
  void end() { out.back() = '\n'; }
};

struct RowReader {
  std::string_view rest;  // of one line
  bool good = true;

  std::string_view text() {
    const auto end = std::min(rest.find(column_separator), rest.size());
    const std::string_view out = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return out;
  }
  void get(std::string& v) { v = text(); }
  void get(double& v) {
    std::uint64_t bits = 0;
    get(bits);
    v = std::bit_cast<double>(bits);
  }
  void get(std::uint64_t& v) {
    const std::string_view t = text();
    const auto r = std::from_chars(t.data(), t.data() + t.size(), v);
    good = good && r.ec == std::errc() && r.ptr == t.data() + t.size();
  }
  void get(int& v) {
    std::uint64_t n = 0;
    get(n);
    v = static_cast<int>(n);
  }
  void get(bool& v) {
    std::uint64_t n = 0;
    get(n);
    v = n != 0;
  }
};

/// The members of a record in one order, for writing and reading.
template <class F>
void each_member(F&& f, auto& t) requires requires {
  t.max_scaled_error;
}
{
  f(t.name), f(t.what), f(t.samples), f(t.ns_per_pair), f(t.spread), f(t.seconds);
  f(t.max_relative_error), f(t.max_ulp), f(t.max_scaled_error), f(t.decision_errors);
  f(t.feature_errors), f(t.non_finite), f(t.rewritten), f(t.invariance_violations), f(t.jumps);
  f(t.fallback_share), f(t.exact_share), f(t.dominated);
}
template <class F>
void each_member(F&& f, auto& r) requires requires {
  r.expected;
}
{
  f(r.id), f(r.name), f(r.expected), f(r.tier), f(r.samples), f(r.max_relative_error);
  f(r.max_ulp), f(r.decision_errors), f(r.non_finite), f(r.has_example), f(r.got), f(r.exact);
  f(r.exact_closer), f(r.example.edges), f(r.example.triangle), f(r.example.gap);
  f(r.example.family);
  for (auto& p : r.example.x) f(p.x), f(p.y), f(p.z);
}
template <class F>
void each_member(F&& f, auto& s) requires requires {
  s.pairs;
}
{ f(s.name), f(s.pairs), f(s.ns_per_pair); }

struct Put {
  RowWriter& w;
  void operator()(const std::string& v) { w.add(std::string_view(v)); }
  void operator()(double v) { w.add(v); }
  void operator()(std::uint64_t v) { w.add(v); }
  void operator()(int v) { w.add(static_cast<std::uint64_t>(v)); }
  void operator()(bool v) { w.add(static_cast<std::uint64_t>(v)); }
};

template <class Row>
void write_rows(RowWriter& w, std::string_view kind, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    w.add(kind);
    each_member(Put{w}, row);
    w.end();
  }
}

template <class Row>
bool read_row(RowReader& line, std::vector<Row>& rows) {
  Row row;
  each_member([&](auto& v) { line.get(v); }, row);
  rows.push_back(std::move(row));
  return line.good && line.rest.empty();
}

std::string stored_head(const AccuracyReport& report, std::string_view key) {
  return fmt::format("{}\n{}\n", key, report.scene);
}

std::string_view next_line(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace

std::string stored_accuracy(const AccuracyReport& report, std::string_view key) {
  RowWriter w{stored_head(report, key)};
  write_rows(w, "tier", report.tiers);
  write_rows(w, "family", report.families);
  write_rows(w, "kind", report.kinds);
  write_rows(w, "stage", report.stages);
  return w.out + fmt::format("end {:016x}\n", content_hash(w.out));
}

std::optional<AccuracyReport> read_stored_accuracy(std::string_view text, std::string_view key) {
  const auto last = text.rfind("end ");
  if (last == text.npos ||
      text.substr(last) != fmt::format("end {:016x}\n", content_hash(text.substr(0, last))))
    return std::nullopt;
  text = text.substr(0, last);
  if (next_line(text) != key) return std::nullopt;
  AccuracyReport out;
  out.scene = next_line(text);
  while (!text.empty()) {
    RowReader line{next_line(text)};
    const std::string_view kind = line.text();
    const bool good = kind == "tier"     ? read_row(line, out.tiers)
                      : kind == "family" ? read_row(line, out.families)
                      : kind == "kind"   ? read_row(line, out.kinds)
                      : kind == "stage"  ? read_row(line, out.stages)
                                         : false;
    if (!good) return std::nullopt;
  }
  return out;
}

}  // namespace deck
