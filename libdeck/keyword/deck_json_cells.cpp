// What the value of a cell is in JSON, for the writer and the reader.
#include "keyword/shared/deck_json_cells.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

/// Length and code point of the sequence at `at`; length 0 if the bytes are no UTF-8.
struct Sequence {
  std::size_t length = 0;
  std::uint32_t code = 0;
};

Sequence sequence(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return at + k < text.size()
               ? static_cast<std::uint32_t>(static_cast<unsigned char>(text[at + k]))
               : 0u;
  };
  const std::uint32_t b0 = byte(0);
  if (b0 < 0x80) return {1, b0};
  const std::size_t n = b0 >= 0xc2 && b0 <= 0xdf   ? 2
                        : b0 >= 0xe0 && b0 <= 0xef ? 3
                        : b0 >= 0xf0 && b0 <= 0xf4 ? 4
                                                   : 0;
  if (n == 0) return {};
  std::uint32_t code = b0 & (0xffu >> (n + 1));
  for (std::size_t k = 1; k < n; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return {};
    code = (code << 6) | (byte(k) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[n] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
  return {n, code};
}

}  // namespace

bool is_utf8(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const Sequence s = sequence(bytes, at);
    if (s.length == 0) return false;
    at += s.length;
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

TextSum& TextSum::add(std::string_view text) {
  constexpr std::uint64_t prime = 1099511628211u;
  for (const char c : text) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * prime;
  hash_ = (hash_ ^ 0x100u) * prime;  // the end of a text is no byte of it
  return *this;
}

std::string TextSum::text() const {
  return fmt::format("{:08x}", static_cast<std::uint32_t>(hash_ ^ (hash_ >> 32)));
}

namespace {

void add_value(TextSum& sum, const nlohmann::json& value) {
  if (value.is_object()) {
    sum.add("{");
    for (const auto& [key, inner] : value.items()) {  // in the order of the keys
      sum.add(key);
      add_value(sum, inner);
    }
    sum.add("}");
  } else if (value.is_array()) {
    sum.add("[");
    for (const auto& inner : value) add_value(sum, inner);
    sum.add("]");
  } else if (value.is_number()) {
    sum.add(fmt::format("{}", value.get<double>()));
  } else if (value.is_string()) {
    sum.add("\"").add(value.get_ref<const std::string&>());
  } else {
    sum.add(value.dump());
  }
}

}  // namespace

std::string sum_of_json(std::string_view json) {
  TextSum sum;
  add_value(sum, nlohmann::json::parse(json, nullptr, false));
  return sum.text();
}

std::optional<std::string> utf8_to_latin1(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Sequence s = sequence(text, at);
    if (s.length == 0 || s.code > 0xff) return std::nullopt;
    out += static_cast<char>(s.code);
    at += s.length;
  }
  return out;
}

}  // namespace deck::detail
