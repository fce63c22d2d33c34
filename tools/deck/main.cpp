// deck: the command line of libdeck. Finds the verb, lets it add its options, runs it and turns
// whatever goes wrong into one of the promised exit codes.
#include <gmp.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <sstream>

#include <unistd.h>

#include "common.hpp"
#include "deck/base/escape.hpp"

namespace {

using namespace deck::cli;

/// A mapped file that shrinks while it is read raises SIGBUS; nothing but an orderly end is left.
void on_bus_error(int) {
  constexpr char text[] = "deck: error: a file changed (became shorter) while it was read\n";
  [[maybe_unused]] const auto written = write(2, text, sizeof text - 1);
  _exit(exit_input);
}

/// What no handler is left for, such as an exception where none may pass.
[[noreturn]] void on_terminate() {
  constexpr char text[] = "deck: internal error: no way to go on (out of memory?)\n";
  [[maybe_unused]] const auto written = write(2, text, sizeof text - 1);
  _exit(exit_internal);
}

// The library of long numbers knows no error but the end of the program: let it be an orderly one.
[[noreturn]] void no_memory() {
  constexpr char text[] = "deck: internal error: out of memory\n";
  [[maybe_unused]] const auto written = write(2, text, sizeof text - 1);
  _exit(exit_internal);
}
void* gmp_allocate(std::size_t size) {
  void* const p = std::malloc(size);
  if (p == nullptr) no_memory();
  return p;
}
void* gmp_reallocate(void* old, std::size_t, std::size_t size) {
  void* const p = std::realloc(old, size);
  if (p == nullptr) no_memory();
  return p;
}
void gmp_free(void* p, std::size_t) { std::free(p); }

std::string version_text() {
  return std::string("deck ") + DECK_VERSION + " (compiled " +
#if defined(__clang__)
         "by clang " + __clang_version__ + ")";
#else
         "by g++ " + __VERSION__ + ")";
#endif
}

/// Number of single-character edits between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Refuses an unknown verb with the closest known one; 0: the verb is known or there is none.
int check_verb(int argc, char** argv, const std::vector<Verb>& all) {
  if (argc < 2 || argv[1][0] == '-') return 0;
  const std::string_view word = argv[1];
  const Verb* best = nullptr;
  std::size_t distance = 4;
  for (const Verb& v : all) {
    if (v.name == word) return 0;
    if (const auto d = edit_distance(word, v.name); d < distance) {
      distance = d;
      best = &v;
    }
  }
  std::string text = "deck: error: there is no verb '" + deck::terminal_text(word) + "'";
  if (word.find('.') != std::string_view::npos)
    text += "; name what to do first, for example: deck params " + deck::terminal_text(word);
  else if (best != nullptr)
    text += "; did you mean '" + std::string(best->name) + "'?";
  text += "\nRun 'deck --help' for the list.\n";
  std::fputs(text.c_str(), stderr);
  return exit_usage;
}

int run(int argc, char** argv) {
  const std::vector<Verb> all = verbs();
  if (const int code = check_verb(argc, argv, all); code != 0) return code;
  CLI::App app("Radioss contact decks (TYPE7, 10, 11, 19): read, check, measure, rewrite.", "deck");
  app.set_version_flag("--version", version_text(), "Version and compiler");
  app.set_help_flag("-h,--help", "This help; 'deck VERB --help' explains a verb");
  std::map<CLI::App*, Action> actions;
  for (const Verb& v : all) {
    CLI::App* sub = app.add_subcommand(std::string(v.name), std::string(v.summary));
    sub->set_help_flag("-h,--help", "This help");
    if (!v.examples.empty()) sub->footer("Examples:\n" + std::string(v.examples));
    actions[sub] = v.setup(*sub);
  }
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  deck params car_0000.rad              what every interface really uses\n"
      "  deck params car_0000.rad --json -     the same for programs\n"
      "\n"
      "Exit codes: 0 clean, 1 findings, 2 wrong usage, 3 input could not be read, 4 internal "
      "error.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, err;
    const int code = app.exit(e, out, err);
    std::fputs(out.str().c_str(), stdout);
    std::fputs(deck::terminal_lines(err.str()).c_str(), stderr);
    return code == 0 ? exit_clean : exit_usage;
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return exit_usage;
  }
  return actions.at(chosen.front())();
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGBUS, on_bus_error);
  std::set_terminate(on_terminate);
  mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_free);
  int code = exit_internal;
  try {
    code = run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("deck: internal error: out of memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "deck: internal error: %s\nPlease report it with the deck.\n",
                 deck::terminal_text(e.what()).c_str());
  } catch (...) {
    std::fputs("deck: internal error of unknown kind\n", stderr);
  }
  if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && code != exit_internal) {
    std::fputs("deck: error: standard output cannot be written\n", stderr);
    code = exit_usage;
  }
  return code;
}
