// VtkPolyData: points with vertices, lines or polygons and data arrays, as VTK XML. Private to the
// report stage.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/ties.hpp"
#include "deck/model/model.hpp"

namespace deck::detail {

/// Collects arrays and puts them into one document. Cells of one kind only.
class VtkPolyData {
 public:
  enum class Cells : std::uint8_t { vertices, lines, polygons };
  explicit VtkPolyData(Cells kind) : kind_(kind) {}

  void add_point(double x, double y, double z) { points_.insert(points_.end(), {x, y, z}); }
  /// A cell over point numbers.
  template <class Range>
  void add_cell(const Range& points) {
    for (const auto p : points) connectivity_.push_back(static_cast<std::int64_t>(p));
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
  }
  std::size_t points() const { return points_.size() / 3; }

  /// Data arrays; values of one item stand together.
  void point_data(std::string_view name, const std::vector<double>& values, int components = 1);
  void point_data(std::string_view name, const std::vector<std::int64_t>& values);
  void cell_data(std::string_view name, const std::vector<double>& values);
  void cell_data(std::string_view name, const std::vector<std::int64_t>& values);

  std::string document() const;

 private:
  Cells kind_;
  std::vector<double> points_;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::string point_arrays_, cell_arrays_;
};

// ties_vtk.cpp
std::string tie_lines(const Model& model, const Tie& tie);

}  // namespace deck::detail
