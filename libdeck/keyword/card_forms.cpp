// Writes a card from its schema; JSON form of a cell's value.
#include "keyword/shared/card_forms.hpp"

#include <algorithm>
#include <charconv>

namespace deck {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

const std::string* find_value(const Values& values, std::string_view name) {
  for (const auto& [key, value] : values)
    if (key == name) return &value;
  return nullptr;
}

std::int64_t value_as_integer(const Values& values, std::string_view name) {
  const std::string* text = find_value(values, name);
  std::int64_t v = 0;
  if (text != nullptr) std::from_chars(text->data(), text->data() + text->size(), v);
  return v;
}

void put_ending_at(std::string& line, int last, std::string_view text) {
  const auto begin = static_cast<std::size_t>(std::max<std::int64_t>(
      0, static_cast<std::int64_t>(last) - static_cast<std::int64_t>(text.size())));
  if (line.size() < begin) line.resize(begin, ' ');
  line.resize(begin);
  line += text;
}

/// The fields of a version, left to right.
std::vector<const Field*> in_columns(const CardSchema& card, int version) {
  std::vector<const Field*> out;
  for (const Field& f : card.fields)
    if (f.in_version(version)) out.push_back(&f);
  std::stable_sort(out.begin(), out.end(),
                   [](const Field* a, const Field* b) { return a->first < b->first; });
  return out;
}

}  // namespace

std::string render_card(const Schema& schema, std::string_view header, int version,
                        const Values& values) {
  std::string out = std::string(header) + "\n";
  if (schema.has_title) out += "example\n";
  std::vector<std::string> used;
  std::string pending;  // blank optional lines, written only before another line
  const auto accepted = [&](const Condition& c) {
    return c.accepts(c.field.empty() ? 0 : value_as_integer(values, c.field));
  };
  for (const CardSchema& card : schema.cards) {
    if (!card.in_version(version)) continue;
    if (!std::all_of(card.when.begin(), card.when.end(), accepted)) continue;
    const std::vector<const Field*> fields = in_columns(card, version);
    const auto is_read = [&](const Field* f) {
      return std::all_of(f->when.begin(), f->when.end(), accepted);
    };
    if (!fields.empty() && std::none_of(fields.begin(), fields.end(), is_read)) continue;
    std::string head = card.blank() ? "" : "#", line;
    bool any = false;
    for (const Field* f : fields) {
      const auto width = static_cast<std::size_t>(f->last - f->first + 1);
      if (width > 3 && static_cast<std::size_t>(f->last) > head.size() + 1) {
        const std::string name = f->name.substr(0, std::max<std::size_t>(width - 1, 3));
        put_ending_at(head, f->last, name);
      }
      if (const std::string* value = find_value(values, f->name)) {
        put_ending_at(line, f->last, *value);
        used.push_back(f->name);
        any = true;
      }
    }
    if (card.repeat != Repeat::once && !any) continue;
    pending += head + (head.empty() ? "" : "\n") + line + "\n";
    if (card.optional && !any) continue;
    out += pending;
    pending.clear();
  }
  for (const auto& [name, value] : values)
    if (std::find(used.begin(), used.end(), name) == used.end())
      out += "# unused: " + name + "=" + value + "\n";
  return out;
}

}  // namespace deck

namespace deck::detail {

CellKind kind_of(const Cell& cell) {
  if (cell.blank()) return CellKind::null;
  if (cell.parameter || cell.field->type == FieldType::text) return CellKind::text;
  if (cell.field->type == FieldType::flag) return CellKind::integer;
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

/// Length of the UTF-8 sequence at `at`; 0: invalid.
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
