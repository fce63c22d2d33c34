// Decks in memory, what a conversion makes of them, and their values as text to compare.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edit/units_support.hpp"
#include "lint/shared/example.hpp"
#include "where.hpp"

namespace deck::test {

using edit_test::as_text;
using edit_test::effective_values;
using edit_test::Files;
using edit_test::Whole;

inline std::unique_ptr<Whole> open_text(const std::string& text,
                                        const std::string& name = "main_0000.rad") {
  return Whole::text(text, name);
}

/// The values that differ, one line each; empty if there are none.
inline std::string difference(const std::map<std::string, std::string>& a,
                              const std::map<std::string, std::string>& b) {
  std::string out;
  for (const auto& [name, value] : a) {
    const auto it = b.find(name);
    if (it == b.end()) out += name + ": " + value + " -> missing\n";
    if (it != b.end() && it->second != value)
      out += name + ": " + value + " -> " + it->second + "\n";
  }
  for (const auto& [name, value] : b)
    if (a.count(name) == 0) out += name + ": new " + value + "\n";
  return out;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& l : lines) out += l + "\n";
  return out;
}

inline std::vector<LossEntry> losses_of(const Rewrite& r, Loss kind) {
  std::vector<LossEntry> out;
  for (const LossEntry& l : r.losses)
    if (l.loss == kind) out.push_back(l);
  return out;
}

inline std::vector<std::string> sample_decks() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "samples"))
    if (entry.path().string().ends_with("_0000.rad")) out.push_back(entry.path().string());
  std::sort(out.begin(), out.end());
  EXPECT_GE(out.size(), 10u);
  return out;
}

/// A main file of one version around some cards.
inline std::string deck_of_version(int version, const std::string& cards) {
  char head[200];
  std::snprintf(head, sizeof head,
                "#RADIOSS STARTER\n/BEGIN\nrun\n%10d         0\n"
                "                  kg                  mm                  ms\n"
                "                  kg                  mm                  ms\n",
                version);
  return head + cards + "/END\n";
}

inline std::string card(const std::string& keyword, int id, int version,
                        const std::vector<std::pair<std::string, std::string>>& values) {
  const Schema* schema = SchemaSet::built_in().find(keyword);
  EXPECT_NE(schema, nullptr) << keyword;
  if (schema == nullptr) return {};
  const std::string header =
      schema->has_id ? keyword + "/" + std::to_string(id) : std::string(keyword);
  return render_card(*schema, header, version, values);
}

}  // namespace deck::test
