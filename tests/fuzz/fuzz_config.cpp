// Settings of a stranger: .decklint.toml, baselines and pages of rules are read or refused, and
// globs match as a plain table of "this much of the pattern fits this much of the path" says.
#include "../lint/plain_glob.hpp"
#include "lint/rule_pages.hpp"
#include "lint/shared/baseline.hpp"
#include "lint/shared/config.hpp"
#include "support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace deck;
  using fuzz::require;
  if (size > 65536) return 0;
  const std::string text = fuzz::text_of(data, size);
  const auto config = parse_lint_config(text, ".decklint.toml");
  require(config.ok() || !config.error().message.empty(), "a refusal says why");
  if (config)
    for (const auto& [glob, rules] : config->per_file_ignores) glob_match(glob, "a/b/c_0000.rad");
  for (const auto kind : {Baseline::Kind::lint, Baseline::Kind::gaps}) {
    const auto baseline = Baseline::parse(text, "baseline.json", kind);
    require(baseline.ok() || !baseline.error().message.empty(), "a refusal says why");
    if (baseline && kind == Baseline::Kind::lint) (void)baseline->findings_of("a_0000.rad");
    if (baseline && kind == Baseline::Kind::gaps) (void)baseline->gaps_of("a_0000.rad");
  }
  const auto page = detail::read_rule_page("X101.md", text, [](const std::string& keyword) {
    return SchemaSet::built_in().find(keyword);
  });
  require(page.ok() || page.error().message.starts_with("X101.md:"), "a refusal says where");
  const auto line = text.find('\n');
  if (line == std::string::npos || size > 400) return 0;
  const std::string_view pattern = std::string_view(text).substr(0, line);
  const std::string_view path = std::string_view(text).substr(line + 1);
  require(glob_match(pattern, path) == test::plain_glob(pattern, path),
          "a glob matches as the plain table says", text);
  return 0;
}
