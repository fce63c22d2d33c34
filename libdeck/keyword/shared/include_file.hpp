// The directive #include: its path and the places where the file may lie. Private to the library.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck::detail {

inline constexpr std::size_t longest_path = 4096;

/// True for the directive, also for one without a file name.
bool is_include(std::string_view line);

/// Path of the directive at `pos`; continuation by a trailing " +", "..." or "&", or by a next line
/// that starts with "+". `pos` moves behind the directive.
std::string include_path(std::string_view bytes, std::uint64_t& pos);

/// Candidate places of an include, in the order they are tried, without repetition; at the end the
/// packed files (".gz") of these names that are on disk, which are only looked for if none of the
/// places was taken.
class IncludeCandidates {
 public:
  IncludeCandidates(const std::string& written, const std::vector<std::string>& directories);
  /// The next one; nullptr: there are no more.
  const std::string* next();
  /// What there was so far.
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
  std::size_t places_ = 0, at_ = 0;
};

/// What a path that leads nowhere was probably meant to be; empty: no idea. `backslash`: it was
/// written with '\\'. Looks into the folders on disk.
std::string include_hint(std::string written, bool backslash,
                         const std::vector<std::string>& candidates);

}  // namespace deck::detail
