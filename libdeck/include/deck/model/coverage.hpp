// What a verdict covers: how many interfaces were examined, which ones are of a type that is not,
// whether all included files were there, and whether the solver comes to its contacts at all. Every
// medium that says "clean" says this too.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "deck/model/interfaces.hpp"

namespace deck {

/// Interfaces of one keyword that are not examined.
struct NotExamined {
  std::string keyword;  ///< "/INTER/TYPE25"
  std::vector<std::int64_t> ids;
};

struct Coverage {
  std::size_t examined = 0;               ///< contacts and, where they are examined, ties
  std::vector<NotExamined> not_examined;  ///< by keyword
  std::vector<std::string> missing;       ///< included files that were not read, as written

  bool complete() const { return missing.empty(); }
  bool nothing() const { return examined == 0; }
};

/// What was looked at: contacts alone, or the ties of /INTER/TYPE2 as well.
enum class Examined : std::uint8_t { contacts, contacts_and_ties };
/// "TYPE7, 10, 11, 19, 24 and 25", with 2 where ties are looked at.
std::string examined_types(Examined examined);
Coverage coverage_of(const Deck& deck, const Interfaces& interfaces,
                     Examined examined = Examined::contacts);

/// "3 interfaces of TYPE25 (ids 4, 5, 6), 1 interface of TYPE2 (id 9)"; empty: nothing was left
/// out.
std::string not_examined_text(const Coverage& coverage);
/// What stands in place of a verdict where there is none: "No verdict: ..." over an incomplete
/// model, "Nothing examined: ..." without any interface that is examined; else empty.
std::string coverage_lead(const Coverage& coverage);
/// What is added to a verdict: " Not examined: ...", or nothing.
std::string coverage_tail(const Coverage& coverage);

}  // namespace deck
