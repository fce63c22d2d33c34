// Extended attributes of written files: those of the file that is replaced are kept, and a result
// has a note of what it was made from.
#if __has_include(<sys/xattr.h>) && defined(__linux__)
#include <sys/xattr.h>
#define DECK_FILE_ATTRIBUTES 1
#endif

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "base/shared/hash.hpp"
#include "deck/text/source.hpp"
#include "edit/shared/write.hpp"
#include "edit/write/write_plan.hpp"

namespace deck {
namespace {

std::string note_of(std::string_view origin, std::string_view bytes) {
  return fmt::format("{:016x} {}", content_hash(bytes), origin);
}

#ifdef DECK_FILE_ATTRIBUTES
constexpr const char* attribute = "user.libdeck.origin";
constexpr const char* access_list = "system.posix_acl_access";

/// A value of `get(buffer, size)`, which gives its size where there is no buffer; nullopt: none.
template <class Get>
std::optional<std::string> attribute_of(const Get& get) {
  std::string value(65536, '\0');  // the most that Linux keeps
  const ssize_t size = get(value.data(), value.size());
  if (size < 0) return std::nullopt;
  value.resize(static_cast<std::size_t>(size));
  return value;
}
#endif

}  // namespace

Result<void> detail::keep_attributes([[maybe_unused]] const std::string& from,
                                     [[maybe_unused]] int to) {
#ifdef DECK_FILE_ATTRIBUTES
  const auto names =
      attribute_of([&](char* b, std::size_t n) { return llistxattr(from.c_str(), b, n); });
  if (!names) return {};  // this file system has none
  bool listed = false;
  for (std::size_t at = 0; at < names->size(); at += std::strlen(names->c_str() + at) + 1) {
    const char* const name = names->c_str() + at;
    listed = listed || std::string_view(name) == access_list;
    const auto old =
        attribute_of([&](char* b, std::size_t n) { return lgetxattr(from.c_str(), name, b, n); });
    const auto fresh =
        attribute_of([&](char* b, std::size_t n) { return fgetxattr(to, name, b, n); });
    if (old && old != fresh && fsetxattr(to, name, old->data(), old->size(), 0) != 0)
      return io_error("cannot keep " + std::string(name) + " of", from, errno);
  }
  // The directory may have given the new file one.
  if (!listed && fremovexattr(to, access_list) != 0 && errno != ENODATA && errno != ENOTSUP)
    return io_error("cannot keep the permissions of", from, errno);
#endif
  return {};
}

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
