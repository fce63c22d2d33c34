// Shares the decks among ranks through the directory of the results.
#include "batch/ranks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>
#include <vector>

#include "batch/run.hpp"
#include "deck/text/number.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

std::optional<std::size_t> number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  const IntegerCell cell = read_integer(text);
  if (cell.status != NumberStatus::ok || cell.value < 0) return std::nullopt;
  return static_cast<std::size_t>(cell.value);
}

std::string file_text(const std::string& path) {
  std::error_code ec;
  if (fs::symlink_status(path, ec).type() != fs::file_type::regular) return {};
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Ranks Ranks::from_environment() {
  Ranks r;
  const auto rank = number_in("OMPI_COMM_WORLD_RANK"), size = number_in("OMPI_COMM_WORLD_SIZE");
  if (!rank || !size || *size < 2 || *rank >= *size) return r;
  r.rank_ = *rank;
  r.size_ = *size;
  r.local_size_ = std::max<std::size_t>(1, number_in("OMPI_COMM_WORLD_LOCAL_SIZE").value_or(1));
  // The number of the job comes from a process number and may return; the key is random.
  for (const char* variable : {"PMIX_NAMESPACE", "OMPI_MCA_orte_precondition_transports"})
    if (const char* const text = std::getenv(variable); text != nullptr)
      for (const char* c = text; *c != '\0'; ++c)
        r.job_ += std::isalnum(static_cast<unsigned char>(*c)) != 0 ? *c : '_';
  return r;
}

std::string Ranks::part_file(std::size_t rank) const {
  return place_ + "/" + std::to_string(rank) + ".json";
}
std::string Ranks::life_file(std::size_t rank) const {
  return place_ + "/" + std::to_string(rank) + ".alive";
}

Result<void> Ranks::open(const std::string& directory) {
  place_ = directory + "/job-" + job_;
  if (auto made = make_own_directory(place_); !made) return made;
  std::error_code ec;
  fs::remove(part_file(rank_), ec);
  last_beat_ = {};
  beat();
  return {};
}

void Ranks::beat() {
  const auto now = std::chrono::steady_clock::now();
  if (single() || (beats_ > 0 && now - last_beat_ < std::chrono::seconds(5))) return;
  last_beat_ = now;
  // A beat that cannot be written is one beat less.
  (void)write_result(life_file(rank_), std::to_string(++beats_), false);
}

Result<void> Ranks::deliver(const Summary& part) {
  return write_result(part_file(rank_), summary_json(part), true);
}

Result<Summary> Ranks::collect(Summary own, std::chrono::seconds patience) {
  using Clock = std::chrono::steady_clock;
  std::vector<Summary> parts;
  parts.push_back(std::move(own));
  for (std::size_t r = 1; r < size_; ++r) {
    std::string life;
    auto changed = Clock::now();
    for (;;) {
      beat();
      std::error_code ec;
      if (fs::exists(part_file(r), ec)) break;
      if (std::string now = file_text(life_file(r)); now != life) {
        life = std::move(now);
        changed = Clock::now();
      }
      if (Clock::now() - changed > patience)
        return Error{Error::Code::io,
                     "rank " + std::to_string(r) +
                         " no longer answers; finished decks are kept, run the same command again"};
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    auto part = parse_summary(file_text(part_file(r)));
    if (!part) return Error{Error::Code::io, part_file(r) + ": " + part.error().message};
    parts.push_back(std::move(*part));
  }
  auto merged = merge_summaries(parts);
  std::error_code ec;
  fs::remove_all(place_, ec);  // no longer needed
  return merged;
}

}  // namespace deck::cli
