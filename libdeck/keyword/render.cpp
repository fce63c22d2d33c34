// Lays out a card from its schema.
#include "keyword/shared/render.hpp"

#include <algorithm>
#include <charconv>

namespace deck {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

const std::string* given(const Values& values, std::string_view name) {
  for (const auto& [key, value] : values)
    if (key == name) return &value;
  return nullptr;
}

std::int64_t given_integer(const Values& values, std::string_view name) {
  const std::string* text = given(values, name);
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

/// The fields that a version has, from left to right.
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
  std::string pending;  // blank optional lines, which are needed only in front of others
  const auto holds = [&](const Condition& c) {
    return c.holds(c.field.empty() ? 0 : given_integer(values, c.field));
  };
  for (const CardSchema& card : schema.cards) {
    if (!card.in_version(version)) continue;
    if (!std::all_of(card.when.begin(), card.when.end(), holds)) continue;
    const std::vector<const Field*> fields = in_columns(card, version);
    const auto is_read = [&](const Field* f) {
      return std::all_of(f->when.begin(), f->when.end(), holds);
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
      if (const std::string* value = given(values, f->name)) {
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
