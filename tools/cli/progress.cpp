// Draws the line of progress, and nothing where no one watches.
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/shared/columns.hpp"
#include "base/shared/escape.hpp"
#include "common.hpp"

namespace deck::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
constexpr milliseconds patience{300}, refresh{100};

}  // namespace

Progress::Progress(bool enabled)
    : enabled_(enabled && isatty(2) == 1), start_(steady_clock::now()), last_(start_) {}

Progress::~Progress() { clear(); }

void Progress::step(std::string_view what) {
  if (!enabled_) return;
  what_ = terminal_text(what);
  if (steady_clock::now() - start_ > patience) draw(-1);
}

void Progress::update(std::uint64_t done, std::uint64_t total, std::string_view what) {
  if (!enabled_) return;
  if (!what.empty()) what_ = terminal_text(what);
  const auto now = steady_clock::now();
  if (now - start_ < patience || now - last_ < refresh) return;
  last_ = now;
  draw(total == 0 ? -1 : static_cast<double>(done) / static_cast<double>(total));
}

void Progress::draw(double share) {
  constexpr int width = 30;
  // A line that the terminal breaks could not be drawn over.
  constexpr std::size_t bar = width + 10;
  const std::size_t columns = std::max<std::size_t>(terminal_width(2), bar + 10);
  std::string line = "\r\x1b[K" + cut_to(what_, columns - bar);
  if (share >= 0) {
    const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
    line += fmt::format(" [{}{}] {:3.0f} %", std::string(static_cast<std::size_t>(full), '#'),
                        std::string(static_cast<std::size_t>(width - full), '.'),
                        100 * std::clamp(share, 0.0, 1.0));
  } else {
    line += " ...";
  }
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace deck::cli
