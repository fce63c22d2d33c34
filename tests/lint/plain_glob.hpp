// What a pattern of file names matches, by definition, as a plain table of "this much of the
// pattern fits this much of the path": for tests of glob_match.
#pragma once
#include <string_view>
#include <vector>

namespace deck::test {

/// * fits anything without a slash, ** anything, **/ also nothing, ? one byte that is no slash.
inline bool fits_plainly(std::string_view p, std::string_view t) {
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
inline bool plain_glob(std::string_view pattern, std::string_view path) {
  while (path.starts_with("./")) path.remove_prefix(2);
  if (fits_plainly(pattern, path)) return true;
  const bool folders = pattern.find('/') != std::string_view::npos;
  for (std::size_t at = path.find('/'); at != std::string_view::npos; at = path.find('/', at + 1))
    if ((folders || path.find('/', at + 1) == std::string_view::npos) &&
        fits_plainly(pattern, path.substr(at + 1)))
      return true;
  return false;
}

}  // namespace deck::test
