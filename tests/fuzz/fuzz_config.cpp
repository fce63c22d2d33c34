// Settings of a stranger: .decklint.toml and baselines are read or refused, and globs match as a
// plain table of "this much of the pattern fits this much of the path" says.
#include <vector>

#include "lint/shared/baseline.hpp"
#include "lint/shared/config.hpp"
#include "support.hpp"

namespace {

/// * fits anything without a slash, ** anything, **/ also nothing, ? one byte that is no slash.
bool plain_glob(std::string_view p, std::string_view t) {
  std::vector<std::vector<char>> fits(p.size() + 1, std::vector<char>(t.size() + 1, 0));
  fits[p.size()][t.size()] = 1;
  std::vector<char> deep(t.size() + 2, 0);  // "**" after it has begun
  for (std::size_t i = p.size(); i-- > 0;) {
    deep.assign(deep.size(), 0);
    for (std::size_t k = t.size() + 1; k-- > 0;) {
      const bool more = k < t.size();
      if (p[i] == '*' && i + 1 < p.size() && p[i + 1] == '*') {
        deep[k] = fits[i + 2][k] != 0 || (more && deep[k + 1] != 0);
        const bool left_out = i + 2 < p.size() && p[i + 2] == '/' && fits[i + 3][k] != 0;
        fits[i][k] = deep[k] != 0 || left_out;
      } else if (p[i] == '*') {
        fits[i][k] = fits[i + 1][k] != 0 || (more && t[k] != '/' && fits[i][k + 1] != 0);
      } else {
        fits[i][k] = more && (p[i] == t[k] || (p[i] == '?' && t[k] != '/')) && fits[i + 1][k + 1];
      }
    }
  }
  return fits[0][0] != 0;
}

/// The whole path; the last component for a pattern without folders, else any end of the path.
bool expected(std::string_view pattern, std::string_view path) {
  while (path.starts_with("./")) path.remove_prefix(2);
  if (plain_glob(pattern, path)) return true;
  const bool folders = pattern.find('/') != std::string_view::npos;
  for (std::size_t at = path.find('/'); at != std::string_view::npos; at = path.find('/', at + 1))
    if ((folders || path.find('/', at + 1) == std::string_view::npos) &&
        plain_glob(pattern, path.substr(at + 1)))
      return true;
  return false;
}

}  // namespace

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
    if (baseline && kind == Baseline::Kind::lint) baseline->findings_of("a_0000.rad");
    if (baseline && kind == Baseline::Kind::gaps) baseline->gaps_of("a_0000.rad");
  }
  const auto line = text.find('\n');
  if (line == std::string::npos || size > 400) return 0;
  const std::string_view pattern = std::string_view(text).substr(0, line);
  const std::string_view path = std::string_view(text).substr(line + 1);
  require(glob_match(pattern, path) == expected(pattern, path),
          "a glob matches as the plain table says", text);
  return 0;
}
