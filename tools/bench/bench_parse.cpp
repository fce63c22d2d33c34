// Parsing speed of the bulk reader (with findings) compared with a bare loop "columns to numbers to
// arrays", that loop with std::from_chars, and sscanf. Times are printed only if all arrays agree.
// Contestants alternate; best of all rounds. Ratios for one thread use processor time (user and
// system), the gain of a second thread elapsed time on an idle machine. Usage: bench_parse
// [--quick] [--megabytes N]
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "harness.hpp"
#include "model/bulk/bulk.hpp"

namespace {

using bench::Times;
using deck::Model;

// ---- decks --------------------------------------------------------------------------------------

enum class Kind { nodes, mixed, broken };

/// xorshift: equal decks on every machine.
struct Random {
  std::uint64_t state = 88172645463325252u;
  std::uint64_t next() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
};

constexpr std::string_view head =
    "#RADIOSS STARTER\n/BEGIN\nbench\n      2024         0\n"
    "                  Mg                  mm                   s\n"
    "                  Mg                  mm                   s\n";

/// Node lines of 71 bytes, half of the coordinates fixed, half scientific; mixed decks also have
/// shells and bricks, 9 elements per 10 nodes. Broken: 4 of 10 node lines have a fault.
void write_deck(const std::string& path, Kind kind, std::uint64_t bytes) {
  std::FILE* const out = std::fopen(path.c_str(), "wb");
  if (out == nullptr) throw std::runtime_error("cannot write " + path);
  std::fwrite(head.data(), 1, head.size(), out);
  Random random;
  const std::uint64_t per_node = kind == Kind::mixed ? 71 + 6 * 51 / 10 + 3 * 91 / 10 : 71;
  const std::uint64_t count = std::max<std::uint64_t>(bytes / per_node, 100);
  std::fputs("/NODE\n", out);
  std::string line;
  for (std::uint64_t i = 1; i <= count; ++i) {
    line = fmt::format("{:10}", i);
    for (int c = 0; c < 3; ++c) {
      const double v = (random.uniform() - 0.5) * 2000;
      line += random.next() % 2 ? fmt::format("{:20.9f}", v) : fmt::format("{:20.12e}", v);
    }
    if (kind == Kind::broken && i % 5 < 2) {
      static constexpr std::string_view faults[] = {"12x4", "1.5.2", "abc", "1e999", "--3"};
      const std::string_view fault = faults[random.next() % 5];
      line.replace(50 - fault.size(), fault.size(), fault);
    }
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), out);
  }
  if (kind == Kind::mixed) {
    // Elements use nodes near their own position, as in meshes.
    const auto element = [&](std::uint64_t id, int nodes, double place) {
      line = fmt::format("{:10}", id);
      const auto around = static_cast<std::uint64_t>(place * static_cast<double>(count));
      const std::uint64_t first = std::min(around + random.next() % 2000, count - 9) + 1;
      for (int n = 0; n < nodes; ++n)
        line += fmt::format("{:10}", first + static_cast<std::uint64_t>(n));
      line += '\n';
      std::fwrite(line.data(), 1, line.size(), out);
    };
    std::fputs("/SHELL/1\n", out);
    for (std::uint64_t i = 1; i <= count * 6 / 10; ++i)
      element(i, 4, static_cast<double>(i) / static_cast<double>(count));
    std::fputs("/BRICK/2\n", out);
    for (std::uint64_t i = 1; i <= count * 3 / 10; ++i)
      element(10'000'000 + i, 8, 0.6 + static_cast<double>(i) / static_cast<double>(count));
  }
  std::fputs("/END\n", out);
  std::fclose(out);
}

// ---- contestants --------------------------------------------------------------------------------

struct Arrays {
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z;
  std::vector<std::int64_t> element, corner;  // as written
  friend bool operator==(const Arrays&, const Arrays&) = default;
};

struct Mapping {
  const char* data = nullptr;
  std::size_t size = 0;
  explicit Mapping(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    size = static_cast<std::size_t>(::lseek(fd, 0, SEEK_END));
    data = static_cast<const char*>(::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0));
    ::close(fd);
  }
  ~Mapping() { ::munmap(const_cast<char*>(data), size); }
};

/// The minimal loop of every reader: lines, columns, numbers, arrays; no checks.
template <class Integer, class Real>
Arrays bare(const std::string& path, Integer integer, Real real) {
  const Mapping file(path);
  Arrays out;
  out.id.reserve(file.size / 71);
  out.x.reserve(file.size / 71);
  out.y.reserve(file.size / 71);
  out.z.reserve(file.size / 71);
  const char* p = file.data;
  const char* const end = file.data + file.size;
  int nodes = -1;  // 0: /NODE; n: elements with n nodes
  while (p < end) {
    const char* const line = p;
    const void* const nl = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
    p = nl == nullptr ? end : static_cast<const char*>(nl) + 1;
    if (*line == '/') {
      nodes = line[1] == 'N' ? 0 : line[1] == 'S' ? 4 : line[2] == 'R' ? 8 : -1;
      continue;
    }
    if (nodes < 0) continue;
    if (nodes == 0) {
      out.id.push_back(integer(line, line + 10));
      out.x.push_back(real(line + 10, line + 30));
      out.y.push_back(real(line + 30, line + 50));
      out.z.push_back(real(line + 50, line + 70));
    } else {
      out.element.push_back(integer(line, line + 10));
      for (int n = 1; n <= nodes; ++n)
        out.corner.push_back(integer(line + 10 * n, line + 10 * n + 10));
    }
  }
  return out;
}

Arrays bare_libdeck(const std::string& path) {
  return bare(
      path,
      [](const char* a, const char* b) {
        return deck::read_integer({a, static_cast<std::size_t>(b - a)}).value;
      },
      [](const char* a, const char* b) {
        return deck::read_real({a, static_cast<std::size_t>(b - a)}).value;
      });
}

Arrays bare_from_chars(const std::string& path) {
  const auto read = [](auto value, const char* a, const char* b) {
    while (a != b && *a == ' ') ++a;
    std::from_chars(a, b, value);
    return value;
  };
  return bare(
      path, [&](const char* a, const char* b) { return read(std::int64_t{0}, a, b); },
      [&](const char* a, const char* b) { return read(0.0, a, b); });
}

/// fgets; copies each cell, terminates it and calls sscanf.
Arrays with_sscanf(const std::string& path) {
  std::FILE* const in = std::fopen(path.c_str(), "rb");
  Arrays out;
  char line[256], cell[32];
  int nodes = -1;
  const auto cut = [&](int first, int width) {
    std::memcpy(cell, line + first, static_cast<std::size_t>(width));
    cell[width] = '\0';
  };
  const auto integer = [&](int first) {
    long long value = 0;
    cut(first, 10);
    static_cast<void>(std::sscanf(cell, "%lld", &value));
    return static_cast<std::int64_t>(value);
  };
  const auto real = [&](int first) {
    double value = 0;
    cut(first, 20);
    static_cast<void>(std::sscanf(cell, "%lg", &value));
    return value;
  };
  while (std::fgets(line, sizeof line, in) != nullptr) {
    if (line[0] == '/') {
      nodes = line[1] == 'N' ? 0 : line[1] == 'S' ? 4 : line[2] == 'R' ? 8 : -1;
      continue;
    }
    if (nodes < 0) continue;
    if (nodes == 0) {
      out.id.push_back(integer(0));
      out.x.push_back(real(10));
      out.y.push_back(real(30));
      out.z.push_back(real(50));
    } else {
      out.element.push_back(integer(0));
      for (int n = 1; n <= nodes; ++n) out.corner.push_back(integer(10 * n));
    }
  }
  std::fclose(in);
  return out;
}

struct Parsed {
  deck::Deck deck;
  Model model;
  deck::Findings findings;
  Times blocks, typed;
};

/// The library: include tree, blocks, nodes and elements with all findings.
std::unique_ptr<Parsed> library(const std::string& path, int threads) {
  auto out = std::make_unique<Parsed>();
  const Times start = Times::now();
  auto deck = deck::read_deck(path, deck::SchemaSet::built_in());
  if (!deck) throw std::runtime_error(deck.error().message);
  out->deck = std::move(*deck);
  const Times middle = Times::now();
  out->blocks = middle - start;
  const auto nodes = deck::detail::node_blocks(out->deck);
  const auto elements = deck::detail::element_blocks(out->deck);
  deck::detail::read_nodes(out->deck, nodes, out->model.nodes, out->model.node_blocks,
                           out->findings, threads);
  deck::detail::read_elements(out->deck, elements, out->model, out->findings, threads);
  out->typed = Times::now() - middle;
  return out;
}

Arrays arrays_of(const Parsed& parsed) {
  const Model& m = parsed.model;
  Arrays out{m.nodes.id, m.nodes.x, m.nodes.y, m.nodes.z, {}, {}};
  for (const deck::Elements* family : {&m.shell4, &m.solid8}) {
    out.element.insert(out.element.end(), family->id.begin(), family->id.end());
    for (const deck::NodeIndex n : family->nodes) out.corner.push_back(m.node_id(n));
  }
  return out;
}

// ---- measuring ----------------------------------------------------------------------------------

/// VmHWM of this process in kB. (ru_maxrss includes the parent before exec.)
long own_peak() {
  std::FILE* const in = std::fopen("/proc/self/status", "r");
  if (in == nullptr) return 0;
  char line[256];
  long kb = 0;
  while (std::fgets(line, sizeof line, in) != nullptr)
    if (std::sscanf(line, "VmHWM: %ld kB", &kb) == 1) break;
  std::fclose(in);
  return kb;
}

/// Peak memory of a separate process that reads the deck.
double peak_megabytes(const std::string& self, const std::string& path, int threads) {
  const std::string command = fmt::format("'{}' --child '{}' {}", self, path, threads);
  std::FILE* const child = ::popen(command.c_str(), "r");
  if (child == nullptr) return 0;
  long kb = 0;
  if (std::fscanf(child, "%ld", &kb) != 1) kb = 0;
  ::pclose(child);
  return static_cast<double>(kb) / 1024;
}

void row(std::string_view what, const Times& t, double base, double bytes) {
  fmt::print("  {:<44} {:8.3f} s {:8.3f} s {:7.3f} GB/s {:7.2f}x\n", what, t.wall, t.cpu,
             bytes / t.cpu / 1e9, base / t.cpu);
}

/// Times of the library: bulk data only, and with include tree and blocks.
struct LibraryTimes {
  std::vector<Times> typed_runs, all_runs;
  void run(const std::string& path, int threads) {
    const auto parsed = library(path, threads);
    typed_runs.push_back(parsed->typed);
    all_runs.push_back(parsed->typed + parsed->blocks);
  }
  Times typed() const { return bench::best(typed_runs); }
  Times all() const { return bench::best(all_runs); }
};

/// Current gain of a second thread for work without memory traffic.
double idle_gain() {
  const auto spin = [] {
    volatile double sum = 0;
    for (int i = 0; i < 30'000'000; ++i) sum = sum + i;
  };
  const auto times = bench::run_in_turns({spin,
                                          [&] {
                                            std::thread other(spin);
                                            spin();
                                            other.join();
                                          }},
                                         3);
  return 2 * bench::best(times[0]).wall / bench::best(times[1]).wall;
}

bool same_findings(const deck::Findings& a, const deck::Findings& b) {
  if (a.counts() != b.counts() || a.all().size() != b.all().size()) return false;
  for (std::size_t i = 0; i < a.all().size(); ++i)
    if (a.all()[i].message != b.all()[i].message || !(a.all()[i].span == b.all()[i].span))
      return false;
  return true;
}

int compare(const std::string& self, const std::string& path, std::string_view title, int runs) {
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  {
    const Arrays expected = bare_libdeck(path);
    const auto one = library(path, 1);
    const auto two = library(path, 2);
    if (!(bare_from_chars(path) == expected) || !(with_sscanf(path) == expected) ||
        !(arrays_of(*one) == expected) || !(arrays_of(*two) == expected) ||
        !same_findings(one->findings, two->findings)) {
      fmt::print("{}: the contestants disagree; no times\n", title);
      return 1;
    }
    std::uint64_t findings = 0;
    for (const auto& [rule, count] : one->findings.counts()) findings += count;
    fmt::print("{}: {:.0f} MB, {} nodes, {} elements, {} findings; all answers agree\n", title,
               bytes / 1e6, expected.id.size(), expected.element.size(), findings);
  }
  LibraryTimes one, two;
  const auto times =
      bench::run_in_turns({[&] { bare_libdeck(path); }, [&] { one.run(path, 1); },
                           [&] { bare_from_chars(path); }, [&] { two.run(path, 2); }},
                          runs);
  const Times ours = bench::best(times[0]), standard = bench::best(times[2]),
              scan = bench::time_of([&] { with_sscanf(path); });
  const double base = ours.cpu;
  fmt::print("  {:<44} {:>10} {:>10} {:>12} {:>8}\n", "", "elapsed", "processor", "per core",
             "ratio");
  row("bare loop, read_real (base of the ratios)", ours, base, bytes);
  row("bare loop, std::from_chars", standard, base, bytes);
  row("sscanf reader", scan, base, bytes);
  row("typed parse with diagnostics, 1 thread", one.typed(), base, bytes);
  row("typed parse with diagnostics, 2 threads", two.typed(), base, bytes);
  row("with the include tree and blocks, 1 thread", one.all(), base, bytes);
  row("with the include tree and blocks, 2 threads", two.all(), base, bytes);
  fmt::print(
      "  2 threads against 1, elapsed: {:.2f}x (with blocks: {:.2f}x); two threads that only "
      "compute gain {:.2f}x on this machine now\n",
      one.typed().wall / two.typed().wall, one.all().wall / two.all().wall, idle_gain());
  fmt::print("  against the sscanf reader: {:.1f}x (with blocks: {:.1f}x)\n",
             scan.cpu / one.typed().cpu, scan.cpu / one.all().cpu);
  for (const int threads : {1, 2}) {
    const double peak = peak_megabytes(self, path, threads);
    fmt::print("  peak memory, {} thread(s): {:.0f} MB = {:.2f} x deck\n", threads, peak,
               peak * 1048576 / bytes);
  }
  return 0;
}

/// A broken deck is compared with the clean one only: other readers do not check.
void compare_broken(const std::string& clean, const std::string& broken, int runs) {
  const auto size = [](const std::string& p) {
    return static_cast<double>(std::filesystem::file_size(p));
  };
  const auto parsed = library(broken, 1);
  std::uint64_t findings = 0;
  for (const auto& [rule, count] : parsed->findings.counts()) findings += count;
  LibraryTimes whole, faulty;
  for (int i = 0; i < runs; ++i) {
    whole.run(clean, 1);
    faulty.run(broken, 1);
  }
  const double scale = size(clean) / size(broken);
  fmt::print("broken lines: {} findings, {} kept; {:.3f} s against {:.3f} s clean = {:.2f}x\n",
             findings, parsed->findings.all().size(), faulty.typed().cpu * scale, whole.typed().cpu,
             faulty.typed().cpu * scale / whole.typed().cpu);
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Arguments arguments(argc, argv);
  if (arguments.flag("--child")) {
    const auto parsed = library(arguments.words.at(0), std::atoi(arguments.words.at(1).c_str()));
    fmt::print("{}\n", own_peak());
    return parsed->model.nodes.size() > 0 ? 0 : 1;
  }
  const bool quick = arguments.flag("--quick");
  const int runs = quick ? 1 : 5;
  const double megabytes = arguments.number("--megabytes", quick ? 40.0 : 177.0);
  const std::filesystem::path dir =
      std::filesystem::temp_directory_path() / fmt::format("bench_parse_{}", ::getpid());
  std::filesystem::create_directories(dir);
  const auto bytes = static_cast<std::uint64_t>(megabytes * 1e6);
  const std::string nodes = dir / "nodes_0000.rad", mixed = dir / "mixed_0000.rad",
                    broken = dir / "broken_0000.rad";
  write_deck(nodes, Kind::nodes, bytes);
  write_deck(mixed, Kind::mixed, bytes);
  write_deck(broken, Kind::broken, bytes);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  int status = compare(self, nodes, "node deck", runs);
  status |= compare(self, mixed, "node and element deck", runs);
  compare_broken(nodes, broken, runs);
  std::filesystem::remove_all(dir);
  return status;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_parse: {}\n", error.what());
  return 1;
}
