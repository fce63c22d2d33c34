// Reads and writes gzip with zlib in pieces, within a size limit.
#include "text/shared/gzip.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

namespace deck {
namespace {

constexpr std::string_view gz_ending = ".gz";
constexpr int gzip_window = 15 + 16;  // the largest window, in the format of gzip
constexpr std::size_t gzip_piece = std::size_t{1} << 18;

enum class Unpacked { whole, damaged, cut_off, too_long };

struct Inflater {
  z_stream z{};
  Inflater() {
    if (inflateInit2(&z, gzip_window) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&z); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

/// Unpacks into `text`, at most `most` bytes.
Unpacked inflate_all(std::string_view bytes, std::uint64_t most, std::string& text) {
  Inflater inflater;
  z_stream& z = inflater.z;
  std::string out(gzip_piece, '\0');
  std::size_t used = 0;
  for (;;) {
    const std::size_t offered = std::min(bytes.size() - used, gzip_piece);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + used));
    z.avail_in = static_cast<uInt>(offered);
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    const int code = inflate(&z, Z_NO_FLUSH);
    used += offered - z.avail_in;
    const std::size_t made = out.size() - z.avail_out;
    const std::uint64_t room = most - text.size();
    text.append(out, 0, static_cast<std::size_t>(std::min<std::uint64_t>(made, room)));
    if (made > room) return Unpacked::too_long;
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code == Z_STREAM_END) {
      const std::string_view rest = bytes.substr(used);
      if (rest.find_first_not_of('\0') == rest.npos) return Unpacked::whole;
      if (!is_gzip(rest) || inflateReset(&z) != Z_OK) return Unpacked::damaged;
    } else if (code == Z_BUF_ERROR || (code == Z_OK && made == 0 && used == bytes.size())) {
      return Unpacked::cut_off;
    } else if (code != Z_OK) {
      return Unpacked::damaged;
    }
  }
}

/// Text length stated in the last four bytes, if plausible.
std::size_t expected_length(std::string_view bytes, std::uint64_t most) {
  constexpr std::uint64_t best_ratio = 1032;  // upper limit of deflate compression
  if (bytes.size() < 4) return 0;
  std::uint64_t length = 0;
  for (std::size_t i = 1; i <= 4; ++i)
    length = length << 8 | static_cast<unsigned char>(bytes[bytes.size() - i]);
  return length <= most && length <= bytes.size() * best_ratio ? static_cast<std::size_t>(length)
                                                               : 0;
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

Result<std::string> gunzip(std::string_view bytes, std::uint64_t most) {
  std::string text;
  text.reserve(expected_length(bytes, most));
  const Unpacked end = inflate_all(bytes, most, text);
  if (end == Unpacked::whole) return text;
  if (end == Unpacked::too_long)
    return Error{Error::Code::limit,
                 "is packed with gzip, and its " + std::to_string(bytes.size()) +
                     " bytes unpack to more than the limit of " + std::to_string(most)};
  const bool cut = end == Unpacked::cut_off;
  return Error{Error::Code::syntax,
               fmt::format("is packed with gzip and {}: after {} bytes of text, in line {}, the "
                           "data {}; copy the file again",
                           cut ? "incomplete" : "damaged", text.size(),
                           std::count(text.begin(), text.end(), '\n') + 1,
                           cut ? "ends too early" : "are damaged")};
}

std::string gunzip_head(std::string_view bytes, std::size_t most) {
  std::string text;
  inflate_all(bytes, most, text);
  return text;
}

std::string gzip(std::string_view text) {
  z_stream z{};
  constexpr int memory_level = 8;  // default of zlib
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed, out(gzip_piece, '\0');
  for (int code = Z_OK; code != Z_STREAM_END;) {
    const std::size_t offered = std::min(text.size(), gzip_piece);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    z.avail_in = static_cast<uInt>(offered);
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    code = deflate(&z, offered == text.size() ? Z_FINISH : Z_NO_FLUSH);
    text.remove_prefix(offered - z.avail_in);
    packed.append(out, 0, out.size() - z.avail_out);
  }
  deflateEnd(&z);
  return packed;
}

bool has_gz_name(std::string_view path) {
  return path.size() > gz_ending.size() && path.ends_with(gz_ending);
}

std::string without_gz(std::string_view path) {
  if (has_gz_name(path)) path.remove_suffix(gz_ending.size());
  return std::string(path);
}

}  // namespace deck
