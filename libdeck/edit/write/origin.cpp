// Notes on a written file what it was made from, in an attribute of the file.
#if __has_include(<sys/xattr.h>) && defined(__linux__)
#include <sys/xattr.h>
#define DECK_FILE_ATTRIBUTES 1
#endif

#include <fmt/format.h>

#include "deck/base/hash.hpp"
#include "deck/edit/write.hpp"
#include "deck/text/source.hpp"
#include "edit/write/write_plan.hpp"

namespace deck {
namespace {

std::string note_of(std::string_view origin, std::string_view bytes) {
  return fmt::format("{:016x} {}", content_hash(bytes), origin);
}

#ifdef DECK_FILE_ATTRIBUTES
constexpr const char* attribute = "user.libdeck.origin";
#endif

}  // namespace

void detail::note_origin([[maybe_unused]] int fd, std::string_view origin, std::string_view bytes) {
  if (origin.empty()) return;
  const std::string note = note_of(origin, bytes);
#ifdef DECK_FILE_ATTRIBUTES
  // Without it the file is like any other: that is all that can be lost.
  if (fsetxattr(fd, attribute, note.data(), note.size(), 0) != 0) return;
#endif
}

bool is_unchanged_output([[maybe_unused]] const std::string& path, std::string_view origin) {
  if (origin.empty()) return false;
#ifdef DECK_FILE_ATTRIBUTES
  std::string note(17 + origin.size() + 1, '\0');  // a longer one is another
  const ssize_t size = lgetxattr(path.c_str(), attribute, note.data(), note.size());
  if (size != static_cast<ssize_t>(17 + origin.size())) return false;
  note.pop_back();
  if (!note.ends_with(origin)) return false;
  const auto source = Source::open(path, Limits{});
  return source && note == note_of(origin, (*source)->bytes());
#else
  return false;
#endif
}

}  // namespace deck
