// VtkPolyData: points with vertices, lines or polygons and data arrays, as VTK XML. Private to the
// report stage.
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace deck::detail {

/// Collects arrays and puts them into one document. Cells of one kind only.
class VtkPolyData {
 public:
  enum class Cells : std::uint8_t { vertices, lines, polygons };
  explicit VtkPolyData(Cells kind) : kind_(kind) {}

  void add_point(const std::array<double, 3>& at) { points_.push_back(at); }
  /// A cell over point numbers.
  template <class Range>
  void add_cell(const Range& points) {
    for (const auto p : points) connectivity_.push_back(static_cast<std::int64_t>(p));
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
  }
  /// A point that is a cell.
  void add_vertex(const std::array<double, 3>& at) {
    add_cell(std::array{points()});
    add_point(at);
  }
  std::size_t points() const { return points_.size(); }

  /// A data array: of each row a member or a function of it, which is a double, three of them, or
  /// an integer.
  template <class Rows, class Value = std::identity>
  void point_data(std::string_view name, const Rows& rows, Value value = {}) {
    add_array(point_arrays_, name, rows, value);
  }
  template <class Rows, class Value = std::identity>
  void cell_data(std::string_view name, const Rows& rows, Value value = {}) {
    add_array(cell_arrays_, name, rows, value);
  }

  std::string document() const;

 private:
  using Words = std::vector<std::uint64_t>;
  static void add_words(Words& words, double v) {
    words.push_back(std::bit_cast<std::uint64_t>(v));
  }
  static void add_words(Words& words, const std::array<double, 3>& v) {
    for (const double x : v) add_words(words, x);
  }
  static void add_words(Words& words, std::integral auto v) {
    words.push_back(static_cast<std::uint64_t>(v));
  }
  static void add_element(std::string& out, std::string_view name, const char* type, bool vectors,
                          const Words& words);

  template <class Rows, class Value = std::identity>
  static void add_array(std::string& out, std::string_view name, const Rows& rows,
                        Value value = {}) {
    using T = std::remove_cvref_t<decltype(std::invoke(value, *rows.begin()))>;
    Words words;
    words.reserve(rows.size());
    for (const auto& row : rows) add_words(words, std::invoke(value, row));
    add_element(out, name, std::integral<T> ? "Int64" : "Float64",
                std::same_as<T, std::array<double, 3>>, words);
  }

  Cells kind_;
  std::vector<std::array<double, 3>> points_;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::string point_arrays_, cell_arrays_;
};

}  // namespace deck::detail
