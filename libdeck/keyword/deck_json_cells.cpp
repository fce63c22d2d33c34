// What the value of a cell is in JSON.
#include "keyword/shared/deck_json_cells.hpp"

namespace deck::detail {

CellKind kind_of(const Cell& cell) {
  if (cell.blank()) return CellKind::null;
  if (cell.parameter) return CellKind::text;
  switch (cell.field->type) {
    case FieldType::text:
      return CellKind::text;
    case FieldType::flag:
      return CellKind::integer;
    default:
      break;
  }
  if (cell.status == NumberStatus::not_a_number || cell.status == NumberStatus::not_finite ||
      cell.status == NumberStatus::overflow)
    return CellKind::text;
  return cell.field->type == FieldType::real ? CellKind::real : CellKind::integer;
}

const CardSchema* list_card(const Schema& schema, int version) {
  const CardSchema* list = nullptr;
  for (const CardSchema& card : schema.cards) {
    if (!card.in_version(version)) continue;
    if (list != nullptr || !card.when.empty()) return nullptr;
    if (card.repeat != Repeat::rows && card.repeat != Repeat::ids) return nullptr;
    list = &card;
  }
  return list;
}

namespace {

/// Length of the sequence at `at`; 0 if the bytes are no UTF-8.
std::size_t sequence(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return at + k < text.size()
               ? static_cast<std::uint32_t>(static_cast<unsigned char>(text[at + k]))
               : 0u;
  };
  const std::uint32_t b0 = byte(0);
  if (b0 < 0x80) return 1;
  const std::size_t n = b0 >= 0xc2 && b0 <= 0xdf   ? 2
                        : b0 >= 0xe0 && b0 <= 0xef ? 3
                        : b0 >= 0xf0 && b0 <= 0xf4 ? 4
                                                   : 0;
  if (n == 0) return 0;
  std::uint32_t code = b0 & (0xffu >> (n + 1));
  for (std::size_t k = 1; k < n; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return 0;
    code = (code << 6) | (byte(k) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[n] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return 0;
  return n;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = sequence(bytes, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string latin1_to_utf8(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + 8);
  for (const char c : bytes) {
    const auto b = static_cast<unsigned char>(c);
    if (b < 0x80) {
      out += c;
      continue;
    }
    out += static_cast<char>(0xc0 | (b >> 6));
    out += static_cast<char>(0x80 | (b & 0x3f));
  }
  return out;
}

}  // namespace deck::detail
