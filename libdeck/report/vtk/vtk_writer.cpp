// Writes one VTK XML file of points, cells and arrays.
#include "report/vtk/vtk_writer.hpp"

#include <bit>
#include <cstring>

namespace deck::detail {
namespace {

/// base64 of little-endian eight-byte words.
class Encoder {
 public:
  explicit Encoder(std::string& out) : out_(out) {}
  void word(std::uint64_t v) {
    for (int i = 0; i < 8; ++i) byte(static_cast<unsigned>(v >> (8 * i)) & 0xffU);
  }
  void finish() {
    if (held_ == 0) return;
    const int missing = 3 - held_;
    bits_ <<= 8 * missing;
    put(4 - missing);
    out_.append(static_cast<std::size_t>(missing), '=');
  }

 private:
  void byte(unsigned b) {
    bits_ = bits_ << 8 | b;
    if (++held_ < 3) return;
    put(4);
    held_ = 0;
    bits_ = 0;
  }
  void put(int characters) {
    static constexpr char alphabet[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < characters; ++i) out_ += alphabet[bits_ >> (18 - 6 * i) & 63U];
  }
  std::string& out_;
  unsigned bits_ = 0;
  int held_ = 0;
};

std::uint64_t word_of(double v) { return std::bit_cast<std::uint64_t>(v); }
std::uint64_t word_of(std::int64_t v) { return static_cast<std::uint64_t>(v); }

/// One DataArray element; the length in bytes goes before the data, both in one run of base64.
template <class T>
void add_array(std::string& out, std::string_view name, const std::vector<T>& values,
               int components) {
  out += "<DataArray type=\"";
  out += std::is_same_v<T, double> ? "Float64" : "Int64";
  out += "\" Name=\"";
  out += name;
  if (components > 1) out += "\" NumberOfComponents=\"" + std::to_string(components);
  out += "\" format=\"binary\">\n";
  Encoder encoder(out);
  encoder.word(8 * values.size());
  for (const T& v : values) encoder.word(word_of(v));
  encoder.finish();
  out += "\n</DataArray>\n";
}

}  // namespace

void VtkPolyData::point_data(std::string_view name, const std::vector<double>& values,
                             int components) {
  add_array(point_arrays_, name, values, components);
}
void VtkPolyData::point_data(std::string_view name, const std::vector<std::int64_t>& values) {
  add_array(point_arrays_, name, values, 1);
}
void VtkPolyData::cell_data(std::string_view name, const std::vector<double>& values) {
  add_array(cell_arrays_, name, values, 1);
}
void VtkPolyData::cell_data(std::string_view name, const std::vector<std::int64_t>& values) {
  add_array(cell_arrays_, name, values, 1);
}

std::string VtkPolyData::document() const {
  const auto count = [&](Cells kind) {
    return std::to_string(kind == kind_ ? offsets_.size() : std::size_t{0});
  };
  const char* element = kind_ == Cells::vertices ? "Verts"
                        : kind_ == Cells::lines  ? "Lines"
                                                 : "Polys";
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(points()) + "\" NumberOfVerts=\"" + count(Cells::vertices) +
      "\" NumberOfLines=\"" + count(Cells::lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      count(Cells::polygons) + "\">\n<PointData>\n" + point_arrays_ + "</PointData>\n<CellData>\n" +
      cell_arrays_ + "</CellData>\n<Points>\n";
  add_array(out, "Points", points_, 3);
  out += "</Points>\n<";
  out += element;
  out += ">\n";
  add_array(out, "connectivity", connectivity_, 1);
  add_array(out, "offsets", offsets_, 1);
  out += "</";
  out += element;
  out += ">\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out;
}

}  // namespace deck::detail
