/* Preloaded into `deck` by kill.py, batch.py, library.py and shortage.py: numbers what the program
 * asks of the system and, at a chosen call, ends the process or refuses what it asks for.
 *   DECK_FAULT_OF=changes  calls that change files or open them, over the program and all its
 *                          children; the default
 *                 calls    all calls about files, from the start of main() on
 *                 memory   allocations and new threads, from there on; they fail with ENOMEM, EAGAIN
 *   DECK_FAULT_AT=N        the call (from 1; 0: none)
 *   DECK_FAULT_DO=kill     the process is killed before the call
 *                 half     like kill, but a write has stored half of its bytes
 *                 all      every process of the group is killed
 *                 ERRNO    the call fails with that number; of changes a write stores half first
 *   DECK_FAULT_MARK=FILE   made when it happened (so that the caller knows when N is too large)
 *   DECK_FAULT_COUNT=FILE  gets the number of all calls or allocations at the end
 *   DECK_FAULT_OPEN=abort:TEXT,hang:TEXT,once:TEXT  opening a file whose name has TEXT aborts, never
 *                          ends, or is refused but for the first time */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
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

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

/* Declares `real`, the function that this one hides. */
#define REAL(name, ...)  \
  typedef __VA_ARGS__;   \
  static function* real; \
  if (!real) real = (function*)dlsym(RTLD_NEXT, name)

static enum { changes, calls, memory } of;
static atomic_long own_counter, *counter = &own_counter;
static atomic_int in_main;
static long fault_at;
static int fault_errno;
static const char *action = "", *mark, *count_file, *on_open;

__attribute__((constructor)) static void set_up(void) {
  const char *at = getenv("DECK_FAULT_AT"), *what = getenv("DECK_FAULT_OF");
  fault_at = at ? atol(at) : 0;
  if (what) of = strcmp(what, "memory") == 0 ? memory : strcmp(what, "calls") == 0 ? calls : changes;
  if (getenv("DECK_FAULT_DO")) action = getenv("DECK_FAULT_DO");
  fault_errno = atoi(action);
  mark = getenv("DECK_FAULT_MARK");
  count_file = getenv("DECK_FAULT_COUNT");
  on_open = getenv("DECK_FAULT_OPEN");
  if (of == changes) /* children count on */
    counter = mmap(NULL, sizeof *counter, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
}

/* Writes a file by calls of the kernel, which are not counted. */
static void note(const char* path, long n) {
  char text[64];
  const int size = snprintf(text, sizeof text, "%ld\n", n);
  const long fd = syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY | O_TRUNC, 0600);
  syscall(SYS_write, fd, text, (size_t)size);
  syscall(SYS_close, fd);
}

static int (*real_main)(int, char**, char**);
static int counted_main(int argc, char** argv, char** env) {
  in_main = 1;
  const int code = real_main(argc, argv, env);
  in_main = 0;
  if (count_file) note(count_file, *counter);
  return code;
}
int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv,
                      int (*init)(int, char**, char**), void (*fini)(void), void (*end)(void),
                      void* stack) {
  REAL("__libc_start_main",
       int function(int (*)(int, char**, char**), int, char**, int (*)(int, char**, char**),
                    void (*)(void), void (*)(void), void*));
  real_main = main;
  return real(counted_main, argc, argv, init, fini, end, stack);
}

/* True if this call is the one; `changing`: it changes or opens a file. */
static int now(int changing) {
  if (of == memory || (of == changes ? !changing || fault_at == 0 : !in_main)) return 0;
  if (atomic_fetch_add(counter, 1) + 1 != fault_at) return 0;
  if (mark) note(mark, fault_at);
  return 1;
}
static int no_memory(void) {
  return of == memory && in_main && atomic_fetch_add(counter, 1) + 1 == fault_at;
}
/* Ends the process or leaves the number of the error. */
static void strike(void) {
  if (fault_errno) {
    errno = fault_errno;
    return;
  }
  if (strcmp(action, "all") == 0) syscall(SYS_kill, 0, SIGKILL);
  syscall(SYS_kill, getpid(), SIGKILL);
}

/* ---- memory ---- */

void* malloc(size_t n) {
  if (no_memory()) return errno = ENOMEM, NULL;
  return __libc_malloc(n);
}
void* calloc(size_t n, size_t size) {
  if (no_memory()) return errno = ENOMEM, NULL;
  return __libc_calloc(n, size);
}
void* realloc(void* p, size_t n) {
  if (no_memory()) return errno = ENOMEM, NULL;
  return __libc_realloc(p, n);
}
void* aligned_alloc(size_t align, size_t n) {
  if (no_memory()) return errno = ENOMEM, NULL;
  return __libc_memalign(align, n);
}
int posix_memalign(void** p, size_t align, size_t n) {
  if (no_memory()) return ENOMEM;
  *p = __libc_memalign(align, n);
  return *p ? 0 : ENOMEM;
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attr, void* (*run)(void*), void* arg) {
  REAL("pthread_create", int function(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*));
  if (no_memory()) return EAGAIN;
  return real(thread, attr, run, arg);
}

/* ---- calls ---- */

/* Defines a wrapper of a call. */
#define WRAP(changing, type, failure, name, parameters, ...) \
  type name parameters {                                     \
    REAL(#name, type function parameters);                   \
    if (now(changing)) return strike(), failure;             \
    return real(__VA_ARGS__);                                \
  }
WRAP(1, int, -1, fsync, (int fd), fd)
WRAP(1, int, -1, fdatasync, (int fd), fd)
WRAP(1, int, -1, syncfs, (int fd), fd)
WRAP(1, int, -1, rename, (const char* a, const char* b), a, b)
WRAP(1, int, -1, renameat2, (int a, const char* b, int c, const char* d, unsigned e), a, b, c, d, e)
WRAP(1, int, -1, link, (const char* a, const char* b), a, b)
WRAP(1, int, -1, unlink, (const char* a), a)
WRAP(1, int, -1, rmdir, (const char* a), a)
WRAP(1, int, -1, mkdir, (const char* a, mode_t m), a, m)
WRAP(1, int, -1, fchmod, (int fd, mode_t m), fd, m)
WRAP(1, int, -1, fchown, (int fd, uid_t u, gid_t g), fd, u, g)
WRAP(1, int, -1, ftruncate, (int fd, off_t n), fd, n)
WRAP(1, int, -1, flock, (int fd, int what), fd, what)
WRAP(0, int, -1, stat, (const char* path, struct stat* s), path, s)
WRAP(0, int, -1, lstat, (const char* path, struct stat* s), path, s)
WRAP(0, int, -1, fstat, (int fd, struct stat* s), fd, s)
WRAP(0, ssize_t, -1, read, (int fd, void* to, size_t n), fd, to, n)
WRAP(0, ssize_t, -1, pread, (int fd, void* to, size_t n, off_t from), fd, to, n, from)
WRAP(0, char*, NULL, getcwd, (char* to, size_t n), to, n)
WRAP(0, char*, NULL, realpath, (const char* path, char* to), path, to)
WRAP(0, void*, MAP_FAILED, mmap, (void* a, size_t n, int prot, int flags, int fd, off_t from), a, n,
     prot, flags, fd, from)
WRAP(0, int, -1, access, (const char* path, int mode), path, mode)

/* A close that fails has closed all the same. */
int close(int fd) {
  REAL("close", int function(int));
  if (!now(1)) return real(fd);
  if (fault_errno) real(fd);
  strike();
  return -1;
}

ssize_t write(int fd, const void* bytes, size_t size) {
  REAL("write", ssize_t function(int, const void*, size_t));
  if (!now(fd > 2)) return real(fd, bytes, size);
  const int half = of == changes && (fault_errno || strcmp(action, "half") == 0);
  if (half && size > 1 && real(fd, bytes, size / 2) < 0) return -1;
  strike();
  return -1;
}

/* True if the file must not be opened. */
static int named(const char* path) {
  const char* at = on_open;
  while (at && *at) {
    const char* colon = strchr(at, ':');
    if (!colon) return 0;
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

/* True if a file is not opened; errno says why. */
static int refused(const char* path, int changing) {
  if (on_open && named(path)) return errno = EACCES, 1;
  if (!now(changing)) return 0;
  strike();
  return 1;
}
#define MODE_BEHIND(flags)                                        \
  va_list list;                                                   \
  va_start(list, flags);                                          \
  const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0; \
  va_end(list)
int open(const char* path, int flags, ...) {
  REAL("open", int function(const char*, int, ...));
  MODE_BEHIND(flags);
  return refused(path, 1) ? -1 : real(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  REAL("open64", int function(const char*, int, ...));
  MODE_BEHIND(flags);
  return refused(path, 1) ? -1 : real(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  REAL("openat", int function(int, const char*, int, ...));
  MODE_BEHIND(flags);
  return refused(path, 0) ? -1 : real(folder, path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
  REAL("fopen", FILE * function(const char*, const char*));
  return refused(path, 0) ? NULL : real(path, mode);
}
