// Packs and unpacks gzip files.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "deck/text.hpp"

namespace deck {

/// True if the bytes have a gzip header.
bool is_gzip(std::string_view bytes);

/// Unpacks a gzip file with one or several members; trailing zeros are ignored. Errors: damaged or
/// cut off, with the position (syntax); more than `most` bytes of text (limit). The message does
/// not name the file.
Result<std::string> gunzip(std::string_view bytes, std::uint64_t most);

/// The first `most` bytes of the text, as far as they can be unpacked.
std::string gunzip_head(std::string_view bytes, std::size_t most);

/// Packs a text without name and time, so equal texts give equal bytes.
std::string gzip(std::string_view text);

/// True if the path ends with ".gz".
bool has_gz_name(std::string_view path);
/// The path without ".gz".
std::string without_gz(std::string_view path);

}  // namespace deck
