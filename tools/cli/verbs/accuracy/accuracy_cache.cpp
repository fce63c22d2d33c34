// Finds, reads and writes the kept measurement of the hard cases.
#include "verbs/accuracy/accuracy_cache.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "accuracy/shared/store.hpp"
#include "base/shared/hash.hpp"
#include "batch/record.hpp"
#include "edit/shared/write.hpp"
#include "processor.hpp"
#include "report/shared/accuracy.hpp"

namespace deck::cli {
namespace {

std::optional<std::string> file_contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Empty where the user has no such directory. A relative $XDG_CACHE_HOME is to be ignored.
std::filesystem::path cache_directory() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    const std::filesystem::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : std::filesystem::path();
  };
  if (const auto cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "deck";
  if (const auto home = absolute("HOME"); !home.empty()) return home / ".cache" / "deck";
  return {};
}

/// What the measurement depends on: the program, the processor, and what was asked.
std::string measurement_key(const std::string& program, const HardCases& which) {
  return fmt::format("deck hard cases, form 1; {}; {}; {}; {} {} {} {}", program,
                     accuracy_compiler(), processor_name(), which.samples, which.seed,
                     which.repeats, which.decisions_only ? "decisions" : "all");
}

struct KeptPlace {
  std::string key, path;  ///< empty: nothing is kept
};

KeptPlace kept_place(const HardCases& which) {
  const std::filesystem::path directory = cache_directory();
  const std::string program = program_identity();
  if (directory.empty() || program.empty()) return {};
  const std::string key = measurement_key(program, which);
  return {key, (directory / fmt::format("hard-cases-{:016x}", content_hash(key))).string()};
}

std::optional<AccuracyReport> kept_report(const HardCases& which) {
  const KeptPlace place = kept_place(which);
  if (place.path.empty()) return std::nullopt;
  const auto text = file_contents(place.path);
  return text ? read_stored_accuracy(*text, place.key) : std::nullopt;
}

AccuracyReport measure_now(const HardCases& which,
                           std::function<void(std::uint64_t, std::uint64_t)> progress) {
  std::vector<PairSample> samples;
  for (const HardFamily& f : hard_families()) {
    const auto some = hard_cases(f.id, which.samples, which.seed);
    samples.insert(samples.end(), some.begin(), some.end());
  }
  AccuracyOptions options;
  options.repeats = which.repeats;
  options.decisions_only = which.decisions_only;
  options.progress = std::move(progress);
  return measure_accuracy(samples, options);
}

}  // namespace

AccuracyReport measured_hard_cases(const HardCases& which,
                                   std::function<void(std::uint64_t, std::uint64_t)> progress) {
  if (!which.again) {
    HardCases more = which;
    more.decisions_only = false;
    if (auto report = kept_report(more)) return std::move(*report);
    if (which.decisions_only)
      if (auto report = kept_report(which)) return std::move(*report);
  }
  AccuracyReport report = measure_now(which, std::move(progress));
  // Where it cannot be kept, the next run measures again.
  if (const KeptPlace place = kept_place(which); !place.path.empty())
    (void)write_file_atomic(place.path, stored_accuracy(report, place.key),
                            {"", true, true, false});
  return report;
}

}  // namespace deck::cli
