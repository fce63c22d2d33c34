// Glob patterns for paths. Follows all possible matches in parallel (a set of pattern positions) in
// one pass over the path. Cost: O(pattern * path) for every pattern.
#include <vector>

#include "lint/shared/config.hpp"

namespace deck {
namespace {

enum class Kind : char { literal, one, star, enter_deep, deep };

/// Reachable positions of a pattern. Position i is before p[i]. In "**" the first character is the
/// entry, from which "**/" can be skipped; the second one accepts any characters.
class Reached {
 public:
  explicit Reached(std::string_view pattern)
      : pattern_(pattern), kind_(pattern.size()), now_(pattern.size() + 1, false), next_(now_) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (pattern[i] == '?') kind_[i] = Kind::one;
      if (pattern[i] != '*') continue;
      const bool deep = i + 1 < pattern.size() && pattern[i + 1] == '*';
      kind_[i] = deep ? Kind::enter_deep : Kind::star;
      if (deep) kind_[++i] = Kind::deep;
    }
  }
  void start() { now_[0] = true; }
  /// Follows steps without a character; false: no position is left.
  bool pass_stars() {
    bool any = now_.back();
    for (std::size_t i = 0; i < kind_.size(); ++i) {
      if (!now_[i]) continue;
      any = true;
      if (kind_[i] == Kind::literal || kind_[i] == Kind::one) continue;
      now_[i + 1] = true;
      if (kind_[i] == Kind::enter_deep && i + 2 < kind_.size() && pattern_[i + 2] == '/')
        now_[i + 3] = true;
    }
    return any;
  }
  void step(char ch) {
    next_.assign(next_.size(), false);
    for (std::size_t i = 0; i < kind_.size(); ++i) {
      if (!now_[i]) continue;
      switch (kind_[i]) {
        case Kind::literal:
          if (ch == pattern_[i]) next_[i + 1] = true;
          break;
        case Kind::one:
          if (ch != '/') next_[i + 1] = true;
          break;
        case Kind::star:
          if (ch != '/') next_[i] = true;
          break;
        case Kind::deep:
          next_[i] = true;
          break;
        case Kind::enter_deep:
          break;
      }
    }
    now_.swap(next_);
  }
  bool at_end() const { return now_.back(); }

 private:
  std::string_view pattern_;
  std::vector<Kind> kind_;
  std::vector<bool> now_, next_;
};

}  // namespace

bool glob_match(std::string_view pattern, std::string_view path) {
  while (path.starts_with("./")) path.remove_prefix(2);
  // A pattern without folders matches the last component; one with folders matches the end of the
  // path.
  const bool folders = pattern.find('/') != std::string_view::npos;
  const std::size_t last = path.rfind('/');
  Reached reached(pattern);
  reached.start();
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && path[i - 1] == '/' && (folders || i - 1 == last)) reached.start();
    const bool hopeless = !reached.pass_stars() && (last == std::string_view::npos || i > last);
    if (hopeless) return false;
    reached.step(path[i]);
  }
  if (!path.empty() && path.back() == '/') reached.start();
  reached.pass_stars();
  return reached.at_end();
}

}  // namespace deck
