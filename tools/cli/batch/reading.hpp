// What the texts of a summary for people, page and table, read from its entries.
#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "batch/summary.hpp"

namespace deck::cli {

/// An entry with its members at hand.
class EntryReading {
 public:
  explicit EntryReading(const SummaryEntry& entry)
      : status(entry.status), json_(nlohmann::json::parse(entry.json, nullptr, false)) {}

  /// "" where there is none.
  std::string text(const char* name) const {
    const auto found = json_.find(name);
    return found != json_.end() && found->is_string() ? found->get<std::string>() : std::string();
  }
  bool counted(const char* name) const {
    const auto counts = json_.find("counts");
    return counts != json_.end() && counts->contains(name) && counts->at(name).is_number();
  }
  /// 0 where it was not counted.
  double count(const char* name) const {
    return counted(name) ? json_.at("counts").at(name).get<double>() : 0;
  }
  /// Penetrating nodes and edges, each once.
  double penetrations() const { return count("nodes") + count("edges"); }
  /// What was found, in one number: of a geometry the penetrations, of lint errors and warnings.
  double found() const { return penetrations() + count("errors") + count("warnings"); }
  /// Why it did not get through, else the verdict.
  std::string what() const {
    // The deck stands beside it: "178:81: /INTER/TYPE7/3 ..." is a place in it.
    const std::string error = text("error"), deck = text("deck") + ":";
    if (error.starts_with(deck)) return error.substr(deck.size() + (error[deck.size()] == ' '));
    return error.empty() ? verdict("text") : error;
  }
  /// A member of the verdict: "level" or "text"; "" where there is none.
  std::string verdict(const char* name) const {
    const auto found = json_.find("verdict");
    return found != json_.end() && found->is_object() ? found->value(name, "") : std::string();
  }
  /// 0: clean; the larger, the worse.
  int rank() const {
    static constexpr std::string_view order[] = {"clean",   "findings",   "not-examined",
                                                 "skipped", "unreadable", "failed"};
    return static_cast<int>(std::find(std::begin(order), std::end(order), status) -
                            std::begin(order));
  }

  std::string status;

 private:
  nlohmann::json json_;
};

/// True if some entry counted this.
inline bool any_counted(const std::vector<EntryReading>& entries, const char* name) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const EntryReading& e) { return e.counted(name); });
}

}  // namespace deck::cli
