// Looks up the legal words of a keyword.
#include "keyword/shared/words.hpp"

#include <algorithm>

namespace deck::detail {
namespace {

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(),
                    [](char w, char t) { return upper(w) == upper(t); });
}

bool matches(std::string_view text, std::string_view word) {
  if (!word.ends_with('*')) return text.size() == word.size() && begins_with(text, word);
  word.remove_suffix(1);
  if (text.size() <= word.size() || !begins_with(text, word)) return false;
  const char next = text[word.size()];
  return next == '_' || (next >= '0' && next <= '9');
}

}  // namespace

std::span<const std::string> legal_words(const Schema& schema) {
  for (const CardSchema& card : schema.cards)
    if (card.words)
      for (const Field& field : card.fields)
        if (!field.words.empty()) return field.words;
  return {};
}

bool has_word(const Schema& schema, std::string_view text) {
  const auto words = legal_words(schema);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return matches(text, word); });
}

}  // namespace deck::detail
