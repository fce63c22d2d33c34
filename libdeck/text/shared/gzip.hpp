// Packing and unpacking of gzip files: decks, includes and recorded states are stored packed.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "deck/text.hpp"

namespace deck {

/// True for bytes that begin as a gzip file does.
bool is_gzip(std::string_view bytes);

/// The text of a gzip file of one or several members; zeros behind the last one (tapes) are
/// ignored. Error: damaged or cut off, with how far it could be unpacked (syntax); more than
/// `most` bytes of text (limit). The message does not name the file.
Result<std::string> gunzip(std::string_view bytes, std::uint64_t most);

/// Up to `most` bytes of the text, as far as it can be unpacked.
std::string gunzip_head(std::string_view bytes, std::size_t most);

/// Packs a text: the same bytes for the same text, with neither a name nor a time in it.
std::string gzip(std::string_view text);

/// True for a path that says the file is packed: "car_0000.rad.gz".
bool has_gz_name(std::string_view path);
/// The path without ".gz", which is what the file is called once it is unpacked.
std::string without_gz(std::string_view path);

}  // namespace deck
