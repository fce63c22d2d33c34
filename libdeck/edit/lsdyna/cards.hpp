// Radioss cards from named values. Private to the LS-DYNA reader.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "deck/keyword/schema.hpp"

namespace deck::detail {

/// An id in ten columns.
std::string list_cell(std::int64_t id);

/// Surfaces, groups, lines and sets that the interfaces need besides those of the deck.
class DynaHelpers {
 public:
  /// Ids by kind of block, of all files of a call.
  using Taken = std::set<std::pair<std::string, std::int64_t>>;
  DynaHelpers(std::int64_t first_id, Taken& taken) : next_id_(first_id), taken_(taken) {}
  /// Id of the block for this key; the first time it is made from `block`, '@' being its id.
  std::int64_t id_of(const char* kind, std::int64_t a, std::int64_t b, std::string block);
  /// The same under the id `b` itself; another one if a block of this kind has that id already.
  std::int64_t own_id_of(const char* kind, std::int64_t a, std::int64_t b, std::string block);
  const std::string& text() const { return text_; }
  std::int64_t next_id() const { return next_id_; }

 private:
  std::int64_t make(const char* kind, std::int64_t id, std::string block);

  std::map<std::tuple<std::string, std::int64_t, std::int64_t>, std::int64_t> made_;
  std::string text_;
  std::int64_t next_id_;
  Taken& taken_;
};

/// Values of a card by field name; integers and reals as text.
class CardValues {
 public:
  CardValues(const Schema& schema, int version) : schema_(&schema), version_(version) {}
  /// False: this version has no such field, or the text does not fit.
  bool set(std::string_view field, std::int64_t value);
  /// `exact` becomes false if digits were lost.
  bool set(std::string_view field, double value, bool* exact = nullptr);
  const std::string* find(std::string_view field) const;
  /// The block with one line for each card whose conditions hold.
  std::string block(const std::string& header, const std::string& title) const;

 private:
  const Field* field(std::string_view name) const;
  const Schema* schema_;
  int version_;
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace deck::detail
