// Node-segment search against CGAL and Embree: the list of all pairs within their gap, build and
// query, one thread, the same arrays. No time is printed unless all answers agree. Ratios are of
// processor time, which does not suffer from other work on the machine.
//
//   bench_search [--quick] [--size N]... [--repeat K] [--largest N] [--scene NAME] [--no-rivals]
//                [--json FILE]
#include <functional>

#include "harness.hpp"
#include "rivals/cgal.hpp"
#include "rivals/scenes.hpp"
#ifdef DECK_HAVE_EMBREE
#include "rivals/embree.hpp"
#endif

namespace bench {
namespace {

struct Settings {
  std::vector<std::size_t> sizes;
  std::size_t largest = 0;  // also measure the library alone at this size
  int repeat = 3;
  std::string scene;
  std::optional<std::string> json;
  bool rivals = true;
};

// Processor time of rivals / one thread of the library, per scene.
nlohmann::json& ratios() {
  static nlohmann::json all = nlohmann::json::object();
  return all;
}

template <class Input>
struct Contestant {
  std::string name;
  std::function<Answer(const Input&)> run;
};

Answer ours(const Scene& s, int threads, std::size_t* tested = nullptr) {
  deck::SearchOptions o = s.options();
  o.threads = threads;
  deck::SearchResult result = deck::find_node_segment_pairs(s.input(), o);
  if (tested != nullptr) *tested = result.tested;
  return {std::move(result.pairs)};
}

std::vector<Contestant<Scene>> rivals() {
  std::vector<Contestant<Scene>> list;
  list.push_back({"CGAL AABB_tree", cgal_aabb_tree});
  list.push_back({"CGAL box_intersection_d (cutoff 10)",
                  [](const Scene& s) { return cgal_box_intersection(s, 10); }});
  list.push_back({"CGAL box_intersection_d (cutoff 2000)",
                  [](const Scene& s) { return cgal_box_intersection(s, 2000); }});
#ifdef DECK_HAVE_EMBREE
  list.push_back({"Embree 3 point query", embree_point_query});
#endif
  return list;
}

// Slope of log(time) over log(size), least squares.
double exponent(const std::vector<std::pair<double, double>>& points) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& [size, time] : points) {
    const double a = std::log(size), b = std::log(time);
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Measures all contestants; false (no times printed): answers differ.
template <class Input>
bool compare(const std::string& title, const std::vector<Contestant<Input>>& all,
             const Input& input, std::size_t items, const Settings& settings, double& own_time) {
  std::vector<Answer> answers(all.size());
  Contestants contestants;
  for (std::size_t i = 0; i < all.size(); ++i)
    contestants.emplace_back([&, i] { answers[i] = all[i].run(input); });
  std::vector<Times> times;
  for (const auto& of_one : run_in_turns(contestants, settings.repeat))
    times.push_back(median(of_one));
  const Digest own(answers[0]);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (Digest(answers[i]) == own) continue;
    fmt::print(stderr, "{}: {} finds {} pairs, {} finds {}\n", title, all[0].name, own.count,
               all[i].name, answers[i].pairs.size());
    return false;
  }
  fmt::print("\n{}: {} pairs, the same for all\n", title, own.count);
  fmt::print("  {:<40} {:>9} {:>9} {:>9} {:>7}\n", "", "wall s", "cpu s", "ns/item", "ratio");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Times& t = times[i];
    fmt::print("  {:<40} {:>9.4f} {:>9.4f} {:>9.1f} {:>7.2f}\n", all[i].name, t.wall, t.cpu,
               1e9 * t.cpu / static_cast<double>(items), t.cpu / times[0].cpu);
  }
  own_time = times[0].cpu;
  for (std::size_t i = 2; i < all.size(); ++i)
    ratios()[fmt::format("search, {}: {}", title, all[i].name)] = times[i].cpu / times[0].cpu;
  return true;
}

bool run_scene(const std::string& title, const std::function<Scene(std::size_t)>& make,
               const Settings& settings) {
  std::vector<std::pair<double, double>> growth;
  for (const std::size_t size : settings.sizes) {
    const Scene s = make(size);
    std::size_t tested = 0;
    std::vector<Contestant<Scene>> all{
        {"libdeck, 1 thread", [&](const Scene& scene) { return ours(scene, 1, &tested); }},
        {"libdeck, 2 threads", [](const Scene& scene) { return ours(scene, 2); }}};
    if (settings.rivals) {
      for (auto& rival : rivals()) all.push_back(rival);
    }
    const std::string what = fmt::format("{}: {} segments, {} secondary nodes", title,
                                         s.segments.size(), s.secondary.size());
    double time = 0.0;
    if (!compare(what, all, s, s.secondary.size(), settings, time)) return false;
    fmt::print("  {} distances computed\n", tested);
    growth.emplace_back(static_cast<double>(s.segments.size()), time);
  }
  if (settings.largest != 0) {
    const Scene s = make(settings.largest);
    const Times time = time_of([&] { ours(s, 1); });
    fmt::print("  {} segments: {:.3f} s\n", s.segments.size(), time.cpu);
    growth.emplace_back(static_cast<double>(s.segments.size()), time.cpu);
  }
  if (growth.size() > 1) fmt::print("  growth exponent of libdeck: {:.3f}\n", exponent(growth));
  return true;
}

// Edge-edge search of a folded shell with itself.
bool run_edges(const Settings& settings) {
  const std::string title = "edges of a folded shell, self contact";
  if (title.find(settings.scene) == std::string::npos) return true;
  for (const std::size_t size : settings.sizes) {
    const Scene s = folded_scene(size / 2);
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const auto& q : s.segments) {
      edges.push_back({q[0], q[1]});
      edges.push_back({q[0], q[3]});
    }
    deck::EdgeEdgeInput in;
    in.nodes = {s.x, s.y, s.z};
    in.secondary = edges;
    in.main = edges;
    deck::SearchOptions options;
    options.gap = deck::PairGap::constant(2 * side_gap);
    const auto run = [&options](const deck::EdgeEdgeInput& input) {
      return Answer{deck::find_edge_edge_pairs(input, options).pairs};
    };
    std::vector<Contestant<deck::EdgeEdgeInput>> all{{"libdeck, 1 thread", run}};
    if (settings.rivals) {
      all.push_back({"CGAL box_intersection_d (cutoff 2000)", [](const deck::EdgeEdgeInput& input) {
                       return cgal_edge_boxes(input, 2 * side_gap, 2000);
                     }});
    }
    double time = 0.0;
    const std::string what = fmt::format("{}: {} edges", title, edges.size());
    if (!compare(what, all, in, edges.size(), settings, time)) return false;
  }
  return true;
}

std::optional<Settings> parse(int argc, char** argv) {
  Arguments arguments(argc, argv);
  Settings settings;
  const bool quick = arguments.flag("--quick");
  settings.repeat = arguments.number("--repeat", quick ? 1 : 3);
  settings.largest = arguments.number("--largest", std::size_t{0});
  settings.scene = arguments.value("--scene").value_or("");
  settings.json = arguments.value("--json");
  settings.rivals = !arguments.flag("--no-rivals");
  while (const auto size = arguments.number("--size", std::size_t{0}))
    settings.sizes.push_back(size);
  if (settings.sizes.empty())
    settings.sizes =
        quick ? std::vector<std::size_t>{10000, 50000} : std::vector<std::size_t>{100000, 1000000};
  return arguments.words.empty() ? std::optional(settings) : std::nullopt;
}

int run(const Settings& settings) {
  const std::vector<std::pair<std::string, std::function<Scene(std::size_t)>>> scenes{
      {"uniform", uniform_scene},
      {"graded 1:1000", graded_scene},
      {"one outlier at 1e6", outlier_scene},
      {"folded shell, self contact", folded_scene}};
  for (const bool shuffled : {false, true}) {
    for (const auto& [name, make] : scenes) {
      const std::string title = name + (shuffled ? ", secondary nodes shuffled" : ", mesh order");
      if (title.find(settings.scene) == std::string::npos) continue;
      const auto build = [&make, shuffled](std::size_t size) {
        Scene s = make(size);
        if (shuffled) shuffle_secondary(s);
        return s;
      };
      if (!run_scene(title, build, settings)) return 1;
    }
  }
  if (!run_edges(settings)) return 1;
  write_json(settings.json, {{"ratios", ratios()}});
  return 0;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  const auto settings = bench::parse(argc, argv);
  if (!settings) {
    fmt::print(stderr,
               "usage: bench_search [--quick] [--size N]... [--repeat K] [--largest N] "
               "[--scene NAME] [--no-rivals] [--json FILE]\n");
    return 2;
  }
  return bench::run(*settings);
}
