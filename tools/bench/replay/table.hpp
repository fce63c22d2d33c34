// Numeric columns by name, from and to CSV.
#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace deck::cycle::detail {

class Table {
 public:
  /// False: no header, or a row does not match it; `error` has the reason.
  bool read(std::string_view text, std::string& error);
  [[nodiscard]] bool has(const std::string& name) const { return names_.contains(name); }
  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_[0].size(); }
  /// Names in order; of equal names the first column counts.
  [[nodiscard]] const std::vector<std::string>& names() const { return order_; }
  /// Null when there is no such column.
  [[nodiscard]] const double* column(const std::string& name) const;
  /// stem_x, stem_y, stem_z.
  [[nodiscard]] std::array<const double*, 3> triple(const std::string& stem) const;
  /// stem + "1" ... stem + "n" + tail for the whole array.
  template <std::size_t N>
  [[nodiscard]] std::array<const double*, N> numbered(const std::string& stem,
                                                      const std::string& tail = {}) const {
    std::array<const double*, N> out{};
    for (std::size_t k = 0; k < N; ++k) out[k] = column(stem + std::to_string(k + 1) + tail);
    return out;
  }

 private:
  void header(std::string_view line);
  bool values(std::string_view line);
  std::map<std::string, std::size_t> names_;
  std::vector<std::string> order_;
  std::vector<std::vector<double>> columns_;
};

/// Result columns for some rows.
struct ResultTable {
  std::vector<std::size_t> row;  ///< 0-based data lines
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< parallel to `names`, each with the length of `row`
  [[nodiscard]] const std::vector<double>* column(std::string_view name) const;
};

/// Header "row,NAME,...", then one line per row: 17 significant digits, nan, inf.
std::string to_csv(const ResultTable& table);

}  // namespace deck::cycle::detail
