/* Preloaded into `deck` by kill.py and batch.py: numbers the calls that touch files and, at a
 * chosen one, ends the process or lets the call fail. Environment: DECK_FAULT_AT=N      the call
 * (from 1); counted over the program and all its children DECK_FAULT_DO=kill   the process is
 * killed before the call half   like kill, but a write has stored half of its bytes all    every
 * process of the group is killed ERRNO  the call fails with that number; a write stores half of its
 * bytes first DECK_FAULT_MARK=FILE made when it happened (so that the caller knows when N is too
 * large) DECK_FAULT_OPEN=abort:TEXT,hang:TEXT,once:TEXT  opening a file whose name has TEXT
 * aborts, never ends, or is refused but for the first time */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_long* counter;
static long fault_at;
static int fault_errno;
static const char *action = "", *mark, *on_open;

__attribute__((constructor)) static void set_up(void) {
  const char* at = getenv("DECK_FAULT_AT");
  fault_at = at ? atol(at) : 0;
  if (getenv("DECK_FAULT_DO")) action = getenv("DECK_FAULT_DO");
  fault_errno = atoi(action);
  mark = getenv("DECK_FAULT_MARK");
  on_open = getenv("DECK_FAULT_OPEN");
  counter = mmap(NULL, sizeof *counter, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
}

/* True if this call is the one. */
static int now(void) {
  if (fault_at == 0 || atomic_fetch_add(counter, 1) + 1 != fault_at) return 0;
  if (mark) syscall(SYS_close, (int)syscall(SYS_openat, AT_FDCWD, mark, O_CREAT | O_WRONLY, 0600));
  return 1;
}
static void end(void) {
  if (strcmp(action, "all") == 0) syscall(SYS_kill, 0, SIGKILL);
  syscall(SYS_kill, getpid(), SIGKILL);
}

/* Declares `real`, the function that this one hides. */
#define REAL(name, ...)  \
  typedef __VA_ARGS__;   \
  static function* real; \
  if (!real) real = (function*)dlsym(RTLD_NEXT, name)

/* Defines a wrapper of a call that returns int. */
#define WRAP(name, parameters, ...)       \
  int name parameters {                   \
    REAL(#name, int function parameters); \
    if (now()) {                          \
      if (!fault_errno) end();            \
      errno = fault_errno;                \
      return -1;                          \
    }                                     \
    return real(__VA_ARGS__);             \
  }
WRAP(fsync, (int fd), fd)
WRAP(fdatasync, (int fd), fd)
WRAP(syncfs, (int fd), fd)
WRAP(rename, (const char* a, const char* b), a, b)
WRAP(renameat2, (int a, const char* b, int c, const char* d, unsigned e), a, b, c, d, e)
WRAP(link, (const char* a, const char* b), a, b)
WRAP(unlink, (const char* a), a)
WRAP(rmdir, (const char* a), a)
WRAP(mkdir, (const char* a, mode_t m), a, m)
WRAP(fchmod, (int fd, mode_t m), fd, m)
WRAP(fchown, (int fd, uid_t u, gid_t g), fd, u, g)
WRAP(ftruncate, (int fd, off_t n), fd, n)
WRAP(flock, (int fd, int what), fd, what)

/* A close that fails has closed all the same. */
int close(int fd) {
  REAL("close", int function(int));
  if (now()) {
    if (!fault_errno) end();
    real(fd);
    errno = fault_errno;
    return -1;
  }
  return real(fd);
}

ssize_t write(int fd, const void* bytes, size_t size) {
  REAL("write", ssize_t function(int, const void*, size_t));
  if (fd > 2 && now()) {
    const int half = strcmp(action, "half") == 0;
    if ((half || fault_errno) && size > 1 && real(fd, bytes, size / 2) < 0) return -1;
    if (!fault_errno) end();
    errno = fault_errno;
    return -1;
  }
  return real(fd, bytes, size);
}

/* True if the file must not be opened. */
static int named(const char* path) {
  const char* at = on_open;
  while (at && *at) {
    const char* colon = strchr(at, ':');
    if (!colon) return;
    const size_t length = strcspn(colon + 1, ",");
    char text[256];
    if (length < sizeof text) {
      memcpy(text, colon + 1, length);
      text[length] = 0;
      if (strstr(path, text)) {
        if (strncmp(at, "abort:", 6) == 0) abort();
        if (strncmp(at, "once:", 5) == 0) return atomic_fetch_add(counter, 1) > 0;
        for (;;) pause();
      }
    }
    at = colon[1 + length] == ',' ? colon + 2 + length : NULL;
  }
  return 0;
}

static int opened(int (*real)(const char*, int, ...), const char* path, int flags, mode_t mode) {
  if (on_open && named(path)) {
    errno = EACCES;
    return -1;
  }
  if (now()) {
    if (!fault_errno) end();
    errno = fault_errno;
    return -1;
  }
  return real(path, flags, mode);
}
#define WRAP_OPEN(name)                                             \
  int name(const char* path, int flags, ...) {                      \
    REAL(#name, int function(const char*, int, ...));               \
    va_list list;                                                   \
    va_start(list, flags);                                          \
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0; \
    va_end(list);                                                   \
    return opened(real, path, flags, mode);                         \
  }
WRAP_OPEN(open)
WRAP_OPEN(open64)

FILE* fopen(const char* path, const char* mode) {
  REAL("fopen", FILE * function(const char*, const char*));
  if (on_open && named(path)) {
    errno = EACCES;
    return NULL;
  }
  return real(path, mode);
}
