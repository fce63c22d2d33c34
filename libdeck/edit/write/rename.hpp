// Renaming that replaces nothing, and exchanging two names: calls of Linux. Elsewhere they fail
// with ENOSYS, as they do on file systems that cannot; callers have another way.
#pragma once

#include <fcntl.h>
#include <stdio.h>

#include <cerrno>

namespace deck::detail {

#if defined(RENAME_NOREPLACE) && defined(RENAME_EXCHANGE)
inline int rename_if_free(const char* from, const char* to) {
  return renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
}
inline int rename_exchanging(const char* one, const char* other) {
  return renameat2(AT_FDCWD, one, AT_FDCWD, other, RENAME_EXCHANGE);
}
#else
inline int rename_if_free(const char*, const char*) {
  errno = ENOSYS;
  return -1;
}
inline int rename_exchanging(const char*, const char*) {
  errno = ENOSYS;
  return -1;
}
#endif

}  // namespace deck::detail
