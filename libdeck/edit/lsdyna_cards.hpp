// Radioss cards from named values. Private to the LS-DYNA reader.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "deck/keyword/schema.hpp"

namespace deck::detail {

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
