// Verbs and options that were taken away, and what to use instead: exit code 2 and one sentence.
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace deck::cli {

struct Removed {
  std::string_view verb, option;  ///< option empty: the verb itself
  std::string_view instead;
};

inline constexpr std::string_view naming_all =
    "the names of all decks that include the file, or of their directory";

inline constexpr std::array removed_words = {
    Removed{"fix", "--smooth", "--max-moved 100%, or --strategy move-part"},
    Removed{"fix", "--step", "deck fix without it"},
    Removed{"fix", "--iterations", "deck fix without it"},
    Removed{"accuracy", "--again", "deck accuracy, which measures the hard cases every time"},
    Removed{"accuracy", "--verbose", "--json, or bench_distance of tools/bench for number types"},
    Removed{"accuracy", "-v", "--json, or bench_distance of tools/bench for number types"},
    Removed{"convert", "--from", "libdeck in Python, or deck::Edit in C++"},
    Removed{"convert", "--round", "libdeck in Python, or deck::Edit in C++"},
    Removed{"convert", "--with-dependents", naming_all},
    Removed{"fix", "--with-dependents", naming_all},
    Removed{"lint", "--with-dependents", naming_all},
    Removed{"completion", "", "the file deck.bash that is installed with the program"},
    Removed{"replay", "", "the program replay of tools/bench, which is built with the tests"},
    Removed{"man", "", "the installed man pages, or deck help VERB"},
};

/// "'deck man' was removed: use …"; empty: there was no such verb or option.
inline std::string removed(std::string_view verb, std::string_view option) {
  for (const Removed& r : removed_words)
    if (r.verb == verb && r.option == option)
      return "'deck " + std::string(verb) + (option.empty() ? "" : " ") + std::string(option) +
             "' was removed: use " + std::string(r.instead);
  return {};
}

}  // namespace deck::cli
