// What can be wrong with the form of a keyword line: its length and its blanks.

#include <algorithm>

#include "keyword/shared/reader.hpp"
#include "text/shared/number_scan.hpp"

namespace deck::detail {
namespace {

void check_length(Deck& deck, const HeaderPlace& place) {
  if (place.end - place.slash <= header_columns) return;
  const std::uint64_t from = place.slash + header_columns;
  const std::string_view tail = deck.sources[place.file].bytes().substr(from, place.end - from);
  if (std::all_of(tail.begin(), tail.end(), is_blank)) return;
  report(deck, RuleId::DK012, make_span(place.file, from, place.end),
         "a keyword line of " + std::to_string(place.end - place.slash) + " characters; " +
             std::to_string(header_columns) + " are read",
         {.solver = "It ignores the text silently.", .fix = "shorten the line"});
}

/// A blank before the number in a header does no harm; elsewhere the solver reads another keyword.
void check_blanks(Deck& deck, const HeaderPlace& place, std::string_view header) {
  const auto shown = [&] { return std::string(header.substr(0, 60)); };
  const std::uint64_t slash = place.slash;
  if (place.begin != slash) {
    report(deck, RuleId::DK052, make_span(place.file, place.begin, slash),
           "a blank before " + shown());
    return;
  }
  if (header.size() > 1 && is_blank(header[1])) {
    // Control characters are blanks, too.
    const auto end = std::find_if_not(header.begin() + 1, header.end(), is_blank);
    report(
        deck, RuleId::DK052,
        make_span(place.file, slash + 1, slash + static_cast<std::uint64_t>(end - header.begin())),
        "a blank after the first slash of " + shown(),
        {.message = 0, .solver = "It does not know the keyword and reads nothing of the block."});
    return;
  }
  std::size_t inner = 1;
  while (inner < header.size() && !(header[inner] == '/' && is_blank(header[inner - 1]))) ++inner;
  // Before an id the solver reads over it.
  if (header.find_first_not_of("0123456789/ \t", std::min(inner, header.size())) ==
      std::string_view::npos)
    return;
  std::size_t blank = inner;
  while (is_blank(header[blank - 1])) --blank;
  report(deck, RuleId::DK052, make_span(place.file, slash + blank, slash + inner),
         "a blank before a slash of " + shown(),
         {.severity = Severity::warning, .message = 0, .solver = "Not known."});
}

}  // namespace

void check_header_line(Deck& deck, const HeaderPlace& place, std::string_view header) {
  check_length(deck, place);
  check_blanks(deck, place, header);
}

}  // namespace deck::detail
