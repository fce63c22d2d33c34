// Writes one VTK XML file of points, cells and arrays.
#include "report/vtk/vtk_writer.hpp"

#include "report/html/stream.hpp"

namespace deck::detail {

/// Little-endian words of eight bytes; the length in bytes goes before the data, both in one run of
/// base64.
void VtkPolyData::add_element(std::string& out, std::string_view name, const char* type,
                              bool vectors, const Words& words) {
  out += std::string("<DataArray type=\"") + type + "\" Name=\"";
  out += name;
  if (vectors) out += "\" NumberOfComponents=\"3";
  out += "\" format=\"binary\">\n";
  std::string bytes;
  const auto add = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xffU);
  };
  add(8 * words.size());
  for (const std::uint64_t word : words) add(word);
  out += base64(bytes) + "\n</DataArray>\n";
}

std::string VtkPolyData::document() const {
  const auto count = [&](Cells kind) {
    return std::to_string(kind == kind_ ? offsets_.size() : std::size_t{0});
  };
  const std::string element = kind_ == Cells::vertices ? "Verts"
                              : kind_ == Cells::lines  ? "Lines"
                                                       : "Polys";
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(points()) + "\" NumberOfVerts=\"" + count(Cells::vertices) +
      "\" NumberOfLines=\"" + count(Cells::lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      count(Cells::polygons) + "\">\n<PointData>\n" + point_arrays_ + "</PointData>\n<CellData>\n" +
      cell_arrays_ + "</CellData>\n<Points>\n";
  add_array(out, "Points", points_);
  out += "</Points>\n<" + element + ">\n";
  add_array(out, "connectivity", connectivity_);
  add_array(out, "offsets", offsets_);
  out += "</" + element + ">\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out;
}

}  // namespace deck::detail
