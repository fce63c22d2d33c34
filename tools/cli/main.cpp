// deck: the command line of libdeck. Runs the verb and converts any failure to a documented exit
// code.
#if __has_include(<gmp.h>)
#include <gmp.h>
#define DECK_LONG_NUMBERS_OF_GMP
#endif

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <fcntl.h>
#include <unistd.h>

#include "base/shared/pages.hpp"
#include "base/shared/shown_text.hpp"
#include "common.hpp"

namespace {

using namespace deck::cli;

/// A mapped file that shrinks during reading raises SIGBUS; the only safe reaction is to exit.
void on_bus_error(int) {
  constexpr char text[] = "deck: error: a file changed (became shorter) while it was read\n";
  [[maybe_unused]] const auto written = write(2, text, sizeof text - 1);
  _exit(exit_input);
}

/// The reader of a pipe is gone: exit. The signal is not ignored, because child processes would
/// inherit that.
void on_closed_pipe(int) { _exit(exit_usage); }

/// A file reached the size limit: the write fails with an error.
void on_file_size(int) {}

/// Opens substitutes for closed standard streams, so that no other file gets their descriptors.
/// They can be neither read nor written, so use is noticed.
void fill_closed_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) < 0)
      _exit(exit_internal);
}

/// Last handler, for example for an exception where none is allowed.
[[noreturn]] void on_terminate() {
  constexpr char text[] = "deck: internal error: cannot continue (out of memory?)\n";
  [[maybe_unused]] const auto written = write(2, text, sizeof text - 1);
  _exit(exit_internal);
}

/// Runs before static tables are built, which can also run out of memory.
[[gnu::constructor(101)]] void end_orderly() { std::set_terminate(on_terminate); }

#ifdef DECK_LONG_NUMBERS_OF_GMP
// GMP ends the program on errors; this makes it exit with the documented code.
void* gmp_reallocate(void* old, std::size_t, std::size_t size) {
  void* const p = std::realloc(old, size);
  if (p == nullptr) on_terminate();
  return p;
}
void* gmp_allocate(std::size_t size) { return gmp_reallocate(nullptr, 0, size); }
void gmp_free(void* p, std::size_t) { std::free(p); }
#endif

#ifdef __GLIBC__
/// Memory of all threads from one heap that begins with large pages: providing small ones takes up
/// to a fifth of the run time. The heap never shrinks: not for processes that run long.
void begin_heap_with_large_pages(std::string_view verb) {
  if (verb == "lsp" || verb == "batch") return;
  constexpr std::size_t begin = std::size_t{1} << 30;
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  void* const b = std::malloc(begin);
  if (b != nullptr) deck::prefer_large_pages(b, static_cast<char*>(b) + begin);
  std::free(b);
}
#endif

std::string version_text() {
  return std::string("deck ") + DECK_VERSION + " (compiled " +
#if defined(__clang__)
         "by clang " + __clang_version__ + ")";
#else
         "by g++ " + __VERSION__ + ")";
#endif
}

}  // namespace

int main(int argc, char** argv) {
#ifdef __GLIBC__
  begin_heap_with_large_pages(argc > 1 ? argv[1] : "");
#endif
  fill_closed_streams();
  std::signal(SIGBUS, on_bus_error);
  std::signal(SIGPIPE, on_closed_pipe);
  std::signal(SIGXFSZ, on_file_size);
#ifdef DECK_LONG_NUMBERS_OF_GMP
  mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_free);
#endif
  Session session;
  int code = exit_internal;
  try {
    code = run_program(argc, argv, version_text(), session);
  } catch (const std::bad_alloc&) {
    std::fputs("deck: internal error: out of memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "deck: internal error: %s\nPlease report it with the deck.\n",
                 deck::terminal_text(e.what()).c_str());
  } catch (...) {
    std::fputs("deck: internal error of unknown kind\n", stderr);
  }
  return session.flush_standard_output() || code == exit_internal ? code
                                                                  : static_cast<int>(exit_usage);
}
