/* Preloaded into `deck` by shortage.py: numbers what a program asks of the system from the start of
 * main() on, and refuses one. Environment:
 *   DECK_SHORT_OF=memory  allocations (malloc and its kin) and new threads; ENOMEM, EAGAIN
 *   DECK_SHORT_OF=calls   calls about files: open, read, write, stat, mmap, rename ...; EIO
 *   DECK_SHORT_AT=N       the one that fails (from 1; 0: none)
 *   DECK_SHORT_COUNT=FILE gets the number of all, and whether one was refused, at the end */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
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

static atomic_long memory, calls;
static atomic_int armed;
static long at;
static int of_memory;
static const char* count_file;

static int refuse_memory(void) {
  if (!armed) return 0;
  const long n = atomic_fetch_add(&memory, 1) + 1;
  return of_memory && n == at;
}
static int refuse_call(void) {
  if (!armed) return 0;
  const long n = atomic_fetch_add(&calls, 1) + 1;
  return !of_memory && n == at;
}

/* Without the calls that are counted: those of the kernel. */
static void write_count(void) {
  if (!count_file) return;
  char text[64];
  const long n = of_memory ? memory : calls;
  const int size = snprintf(text, sizeof text, "%ld\n", n);
  const long fd = syscall(SYS_openat, AT_FDCWD, count_file, O_CREAT | O_WRONLY | O_TRUNC, 0600);
  syscall(SYS_write, fd, text, (size_t)size);
  syscall(SYS_close, fd);
}

static int (*real_main)(int, char**, char**);
static int counted_main(int argc, char** argv, char** env) {
  const char* n = getenv("DECK_SHORT_AT");
  const char* of = getenv("DECK_SHORT_OF");
  at = n ? atol(n) : 0;
  of_memory = of && strcmp(of, "memory") == 0;
  count_file = getenv("DECK_SHORT_COUNT");
  armed = 1;
  const int code = real_main(argc, argv, env);
  armed = 0;
  write_count();
  return code;
}

#define REAL(name, ...)  \
  typedef __VA_ARGS__;   \
  static function* real; \
  if (!real) real = (function*)dlsym(RTLD_NEXT, name)

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv,
                      int (*init)(int, char**, char**), void (*fini)(void), void (*end)(void),
                      void* stack) {
  REAL("__libc_start_main",
       int function(int (*)(int, char**, char**), int, char**, int (*)(int, char**, char**),
                    void (*)(void), void (*)(void), void*));
  real_main = main;
  return real(counted_main, argc, argv, init, fini, end, stack);
}

void* malloc(size_t n) {
  if (refuse_memory()) return errno = ENOMEM, NULL;
  return __libc_malloc(n);
}
void* calloc(size_t n, size_t size) {
  if (refuse_memory()) return errno = ENOMEM, NULL;
  return __libc_calloc(n, size);
}
void* realloc(void* p, size_t n) {
  if (refuse_memory()) return errno = ENOMEM, NULL;
  return __libc_realloc(p, n);
}
void* aligned_alloc(size_t align, size_t n) {
  if (refuse_memory()) return errno = ENOMEM, NULL;
  return __libc_memalign(align, n);
}
int posix_memalign(void** p, size_t align, size_t n) {
  if (refuse_memory()) return ENOMEM;
  *p = __libc_memalign(align, n);
  return *p ? 0 : ENOMEM;
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attr, void* (*run)(void*), void* arg) {
  REAL("pthread_create", int function(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*));
  if (refuse_memory()) return EAGAIN;
  return real(thread, attr, run, arg);
}

#define WRAP(type, failure, name, parameters, ...)  \
  type name parameters {                            \
    REAL(#name, type function parameters);          \
    if (refuse_call()) return errno = EIO, failure; \
    return real(__VA_ARGS__);                       \
  }
WRAP(int, -1, fsync, (int fd), fd)
WRAP(int, -1, rename, (const char* a, const char* b), a, b)
WRAP(int, -1, link, (const char* a, const char* b), a, b)
WRAP(int, -1, unlink, (const char* a), a)
WRAP(int, -1, mkdir, (const char* a, mode_t m), a, m)
WRAP(int, -1, fchmod, (int fd, mode_t m), fd, m)
WRAP(int, -1, fchown, (int fd, uid_t u, gid_t g), fd, u, g)
WRAP(int, -1, ftruncate, (int fd, off_t n), fd, n)
WRAP(int, -1, flock, (int fd, int what), fd, what)
WRAP(int, -1, stat, (const char* path, struct stat* s), path, s)
WRAP(int, -1, lstat, (const char* path, struct stat* s), path, s)
WRAP(int, -1, fstat, (int fd, struct stat* s), fd, s)
WRAP(ssize_t, -1, read, (int fd, void* to, size_t n), fd, to, n)
WRAP(ssize_t, -1, pread, (int fd, void* to, size_t n, off_t from), fd, to, n, from)
WRAP(ssize_t, -1, write, (int fd, const void* from, size_t n), fd, from, n)
WRAP(char*, NULL, getcwd, (char* to, size_t n), to, n)
WRAP(char*, NULL, realpath, (const char* path, char* to), path, to)
WRAP(void*, MAP_FAILED, mmap, (void* a, size_t n, int prot, int flags, int fd, off_t from), a, n,
     prot, flags, fd, from)
WRAP(FILE*, NULL, fopen, (const char* path, const char* mode), path, mode)
WRAP(int, -1, access, (const char* path, int mode), path, mode)

int close(int fd) {
  REAL("close", int function(int));
  const int code = real(fd); /* a close that fails has closed all the same */
  if (refuse_call()) return errno = EIO, -1;
  return code;
}
#define WRAP_OPEN(name)                                             \
  int name(const char* path, int flags, ...) {                      \
    REAL(#name, int function(const char*, int, ...));               \
    va_list list;                                                   \
    va_start(list, flags);                                          \
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0; \
    va_end(list);                                                   \
    if (refuse_call()) return errno = EIO, -1;                      \
    return real(path, flags, mode);                                 \
  }
WRAP_OPEN(open)
WRAP_OPEN(open64)
int openat(int at_fd, const char* path, int flags, ...) {
  REAL("openat", int function(int, const char*, int, ...));
  va_list list;
  va_start(list, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;
  va_end(list);
  if (refuse_call()) return errno = EIO, -1;
  return real(at_fd, path, flags, mode);
}
