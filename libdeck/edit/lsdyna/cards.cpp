// Writes named values into the cells of Radioss cards.
#include "edit/lsdyna/cards.hpp"

#include <algorithm>

#include "deck/text/number.hpp"

namespace deck::detail {

std::string list_cell(std::int64_t id) {
  const auto text = format_integer(id, 10);
  return text ? std::string(10 - text->size(), ' ') + *text : std::string(10, ' ');
}

std::int64_t DynaHelpers::make(const char* kind, std::int64_t id, std::string block) {
  taken_.emplace(kind, id);
  block.replace(block.find('@'), 1, std::to_string(id));
  text_ += block;
  return id;
}

std::int64_t DynaHelpers::id_of(const char* kind, std::int64_t a, std::int64_t b,
                                std::string block) {
  const auto [it, fresh] = made_.try_emplace(std::tuple{std::string(kind), a, b}, 0);
  if (fresh) {
    while (taken_.contains({kind, next_id_})) ++next_id_;
    it->second = make(kind, next_id_++, std::move(block));
  }
  return it->second;
}

std::int64_t DynaHelpers::own_id_of(const char* kind, std::int64_t a, std::int64_t b,
                                    std::string block) {
  const auto made = made_.find(std::tuple{std::string(kind), a, b});
  if (made != made_.end()) return made->second;
  if (taken_.contains({kind, b})) return id_of(kind, a, b, std::move(block));
  made_.emplace(std::tuple{std::string(kind), a, b}, b);
  return make(kind, b, std::move(block));
}

const Field* CardValues::field(std::string_view name) const {
  for (const CardSchema& card : schema_->cards) {
    if (!card.in_version(version_)) continue;
    for (const Field& f : card.fields)
      if (f.name == name && f.in_version(version_)) return &f;
  }
  return nullptr;
}

bool CardValues::set(std::string_view name, std::int64_t value) {
  const Field* f = field(name);
  if (f == nullptr) return false;
  const auto text = format_integer(value, f->last - f->first + 1);
  if (text) values_[std::string(name)] = *text;
  return text.has_value();
}

bool CardValues::set(std::string_view name, double value, bool* exact) {
  const Field* f = field(name);
  if (f == nullptr) return false;
  const auto text = format_real(value, f->last - f->first + 1);
  if (!text) return false;
  values_[std::string(name)] = text->text;
  if (exact != nullptr) *exact = text->exact;
  return true;
}

const std::string* CardValues::find(std::string_view name) const {
  const auto it = values_.find(name);
  return it == values_.end() ? nullptr : &it->second;
}

std::string CardValues::block(const std::string& header, const std::string& title) const {
  std::string out = header + "\n" + title + "\n";
  std::string pending;  // blank optional lines, which are needed only in front of others
  for (const CardSchema& card : schema_->cards) {
    if (!card.in_version(version_)) continue;
    const bool there = std::all_of(card.when.begin(), card.when.end(), [&](const Condition& c) {
      const std::string* text = find(c.field);
      return c.holds(text == nullptr ? 0 : read_integer(*text).value);
    });
    if (!there) continue;
    std::string line;
    for (const Field& f : card.fields) {
      const std::string* text = f.in_version(version_) ? find(f.name) : nullptr;
      if (text == nullptr) continue;
      const auto last = static_cast<std::size_t>(f.last);
      if (line.size() < last) line.resize(last, ' ');
      line.replace(last - text->size(), text->size(), *text);
    }
    if (card.repeat != Repeat::once && !card.count.empty() && line.empty()) continue;
    pending += line + "\n";
    if (card.optional && line.empty()) continue;
    out += pending;
    pending.clear();
  }
  return out;
}

}  // namespace deck::detail
