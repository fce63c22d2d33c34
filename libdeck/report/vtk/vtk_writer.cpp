// Writes one VTK XML file of points, cells and arrays.
#include "report/vtk/vtk_writer.hpp"

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

}  // namespace

/// The length in bytes goes before the data, both in one run of base64.
void VtkPolyData::add_element(std::string& out, std::string_view name, const char* type,
                              bool vectors, const Words& words) {
  out += std::string("<DataArray type=\"") + type + "\" Name=\"";
  out += name;
  if (vectors) out += "\" NumberOfComponents=\"3";
  out += "\" format=\"binary\">\n";
  Encoder encoder(out);
  encoder.word(8 * words.size());
  for (const std::uint64_t word : words) encoder.word(word);
  encoder.finish();
  out += "\n</DataArray>\n";
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
