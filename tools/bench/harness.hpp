// Shared by the benchmarks: clocks, alternating contestants, options, tables, and the document for
// tools/bench/ratios.
#pragma once
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bench {

/// Seconds: elapsed, and processor time of this process (user and system), which other programs
/// disturb least.
struct Times {
  double wall = 0, cpu = 0;
  static Times now() {
    timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double>(wall).count(),
            static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec)};
  }
  friend Times operator-(const Times& a, const Times& b) {
    return {a.wall - b.wall, a.cpu - b.cpu};
  }
  friend Times operator+(const Times& a, const Times& b) {
    return {a.wall + b.wall, a.cpu + b.cpu};
  }
};

template <class F>
Times time_of(F&& f) {
  const Times start = Times::now();
  f();
  return Times::now() - start;
}

using Contestants = std::vector<std::function<void()>>;

/// Times of each contestant. They alternate, so that disturbances affect all.
inline std::vector<std::vector<Times>> run_in_turns(const Contestants& all, int rounds) {
  std::vector<std::vector<Times>> out(all.size());
  for (int r = 0; r < rounds; ++r)
    for (std::size_t k = 0; k < all.size(); ++k) out[k].push_back(time_of(all[k]));
  return out;
}

/// The n-th smallest time, elapsed and processor time separately.
inline Times nth(const std::vector<Times>& times, std::size_t n) {
  std::vector<double> wall, cpu;
  for (const Times& t : times) wall.push_back(t.wall), cpu.push_back(t.cpu);
  std::sort(wall.begin(), wall.end());
  std::sort(cpu.begin(), cpu.end());
  return {wall[n], cpu[n]};
}
inline Times best(const std::vector<Times>& times) { return nth(times, 0); }
inline Times median(const std::vector<Times>& times) { return nth(times, times.size() / 2); }

/// Words of a command line; options are removed when read.
class Arguments {
 public:
  Arguments(int argc, char** argv) : words(argv + std::min(argc, 1), argv + argc) {}
  bool flag(std::string_view name) { return extract(name, 1).has_value(); }
  std::optional<std::string> value(std::string_view name) { return extract(name, 2); }
  template <class Number>
  Number number(std::string_view name, Number fallback) {
    const auto text = value(name);
    return text ? static_cast<Number>(std::atof(text->c_str())) : fallback;
  }
  std::vector<std::string> words;

 private:
  std::optional<std::string> extract(std::string_view name, std::ptrdiff_t count) {
    const auto at = std::find(words.begin(), words.end(), name);
    if (words.end() - at < count) return std::nullopt;
    const std::string last = at[count - 1];
    words.erase(at, at + count);
    return last;
  }
};

/// A column: JSON key of a number and its digits; 0 is blank.
struct Column {
  const char* key;
  const char* title;
};

/// Prints rows of JSON as a table; the first column is text.
inline void print_table(const std::string& title, const nlohmann::json& rows, const Column& first,
                        const std::vector<Column>& columns) {
  fmt::print("\n{}\n{:<46}", title, first.title);
  for (const Column& c : columns) fmt::print(" {:>9}", c.title);
  for (const auto& row : rows) {
    fmt::print("\n{:<46}", row[first.key].get<std::string>());
    for (const Column& c : columns) {
      const double value = row[c.key];
      fmt::print(" {:>9}", value == 0 ? std::string() : fmt::format("{:.1f}", value));
    }
  }
  fmt::print("\n");
}

/// Writes a document, if a file is given.
inline void write_json(const std::optional<std::string>& path, const nlohmann::json& document) {
  if (path) std::ofstream(*path) << document.dump(2) << "\n";
}

}  // namespace bench
