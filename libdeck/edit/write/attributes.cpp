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

#ifdef DECK_FILE_ATTRIBUTES
namespace {

constexpr const char* origin_note = "user.libdeck.origin";
constexpr const char* access_list = "system.posix_acl_access";

/// A value of `get(buffer, size)`, which gives its size; nullopt: there is none.
template <class Get>
std::optional<std::string> attribute_of(const Get& get) {
  std::string value(65536, '\0');  // the most that Linux keeps
  const ssize_t size = get(value.data(), value.size());
  if (size < 0) return std::nullopt;
  value.resize(static_cast<std::size_t>(size));
  return value;
}

std::string note_of(std::string_view origin, std::string_view bytes) {
  return fmt::format("{:016x} {}", content_hash(bytes), origin);
}

}  // namespace

Result<void> detail::keep_attributes(const std::string& from, int to) {
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
  return {};
}

void detail::note_origin(int fd, std::string_view origin, std::string_view bytes) {
  const std::string note = note_of(origin, bytes);
  // Without it the file is like any other: that is all that can be lost.
  if (!origin.empty() && fsetxattr(fd, origin_note, note.data(), note.size(), 0) != 0) return;
}

bool is_unchanged_output(const std::string& path, std::string_view origin) {
  const auto note = attribute_of(
      [&](char* b, std::size_t n) { return lgetxattr(path.c_str(), origin_note, b, n); });
  if (origin.empty() || !note || !note->ends_with(origin)) return false;
  const auto source = Source::open(path, Limits{});
  return source && *note == note_of(origin, (*source)->bytes());
}
#else
Result<void> detail::keep_attributes(const std::string&, int) { return {}; }
void detail::note_origin(int, std::string_view, std::string_view) {}
bool is_unchanged_output(const std::string&, std::string_view) { return false; }
#endif

}  // namespace deck
