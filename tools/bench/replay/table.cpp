// Reads and writes tables of recorded states.
#include "replay/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace deck::cycle::detail {

bool Table::read(std::string_view text, std::string& error) {
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

const double* Table::column(const std::string& name) const {
  const auto it = names_.find(name);
  return it == names_.end() ? nullptr : columns_[it->second].data();
}

std::array<const double*, 3> Table::triple(const std::string& stem) const {
  return {column(stem + "_x"), column(stem + "_y"), column(stem + "_z")};
}

void Table::header(std::string_view line) {
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    std::string name(line.substr(at, comma - at));
    if (names_.emplace(name, columns_.size()).second) order_.push_back(std::move(name));
    columns_.emplace_back();
    at = comma + 1;
  }
}

bool Table::values(std::string_view line) {
  const char* p = line.data();
  const char* const end = p + line.size();
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    double value = 0.0;
    const auto [next, code] = std::from_chars(p, end, value);
    // Underflow: 0.
    if (code != std::errc() && code != std::errc::result_out_of_range) return false;
    columns_[c].push_back(value);
    p = next;
    if (c + 1 == columns_.size()) return p == end;
    if (p == end || *p != ',') return false;
    ++p;
  }
  return true;
}

const std::vector<double>* ResultTable::column(std::string_view name) const {
  const auto it = std::find(names.begin(), names.end(), name);
  return it == names.end() ? nullptr : &columns[static_cast<std::size_t>(it - names.begin())];
}

namespace {

void append_number(double value, std::string& out) {
  if (std::isnan(value)) {
    out += "nan";
  } else if (std::isinf(value)) {
    out += value < 0.0 ? "-inf" : "inf";
  } else {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value,
                                   std::chars_format::scientific, 16);
    out.append(text, end.ptr);
  }
}

}  // namespace

std::string to_csv(const ResultTable& table) {
  std::string out = "row";
  for (const std::string& name : table.names) out += "," + name;
  out += '\n';
  for (std::size_t i = 0; i < table.row.size(); ++i) {
    out += std::to_string(table.row[i]);
    for (const auto& column : table.columns) {
      out += ',';
      append_number(column[i], out);
    }
    out += '\n';
  }
  return out;
}

}  // namespace deck::cycle::detail
