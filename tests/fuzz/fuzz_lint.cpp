// Lint with geometry, every output format, and --fix: the documents are valid, safe fixes change no
// effective value, and fixing ends: a text that was fixed to the end has nothing more to fix.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "deck/lint.hpp"
#include "lint/shared/baseline.hpp"
#include "lint/shared/fix.hpp"
#include "lint/shared/geometry.hpp"
#include "report/shared/findings.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

LintResult lint(fuzz::Whole& whole, bool geometry) {
  std::vector<ExtraCheck> extra;
  if (geometry)
    extra.push_back([](const LintContext& c, Reporter& r) { return check_geometry(c, r); });
  LintOptions options;
  options.ignore = {"DK511"};  // its safe fix gives values the effect that they have lost
  return run_lint(whole.loaded, options, extra);
}

void check_documents(const fuzz::Whole& whole, const LintResult& result) {
  const std::vector<LintedDeck> decks = {{"fuzz", &whole.deck, &result, ""}};
  for (const std::string& document :
       {lint_json(decks), lint_sarif(decks, SchemaSet::built_in()), lint_gitlab(decks)})
    require(nlohmann::json::accept(document), "a document is valid JSON", document);
  lint_junit(decks);
  lint_github(decks);
  lint_human(decks, {});
  Baseline written("baseline.json", Baseline::Kind::lint);
  written.accept("fuzz", whole.deck, result);
  const auto read = Baseline::parse(written.text(), "baseline.json", Baseline::Kind::lint);
  require(read.ok() && read->findings_of("fuzz").ok(), "a baseline that was written is read");
}

/// The text after one round of fixes; the same text where there is nothing to fix.
std::string fixed(const fuzz::Whole& whole, const LintResult& result, bool unsafe) {
  const FixResult fixes = apply_fixes(whole.deck.sources, result.findings, unsafe);
  require(fixes.files.size() <= 1, "one file is fixed at most");
  require((fixes.applied > 0) == !fixes.files.empty(), "a fix that was applied is in the text");
  return fixes.files.empty() ? std::string(whole.bytes()) : fixes.files[0].text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 12288) return 0;
  const std::string text = fuzz::text_of(data, size);
  const std::uint64_t h = fuzz::hash_of(text);
  auto whole = fuzz::read_text(text);
  if (!whole) return 0;
  LintResult result = lint(*whole, h % 4 == 0);
  for (const Finding& d : result.findings) {
    require(find_rule(id_text(d.rule)) != nullptr, "a finding has a rule", d.message);
    if (d.span.valid()) whole->deck.sources.where(d.span);
  }
  require(result.fingerprints.size() == result.findings.size(), "every finding has its print");
  // The documents are many times as long as the deck.
  if (h / 32 % 256 == 0) check_documents(*whole, result);
  const bool unsafe = h / 4 % 3 == 0;
  const std::string before = fuzz::effective_values(whole->interfaces, true);
  // Some fixes take a line away, one in a round.
  const auto rounds = 20 + std::count(text.begin(), text.end(), '\n');
  for (int round = 0;; ++round) {
    const std::string next = fixed(*whole, result, unsafe);
    if (next == whole->bytes()) return 0;
    require(round < rounds, "fixing ends", next);
    whole = fuzz::read_text(next);
    require(whole != nullptr, "a fixed deck is a deck", next);
    if (!unsafe)
      require(fuzz::effective_values(whole->interfaces, true) == before,
              "a safe fix changes no effective value that is used", next);
    result = lint(*whole, false);
  }
}
