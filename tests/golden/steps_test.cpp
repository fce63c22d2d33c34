// Steps of prescribed motion against recorded sets: the deck alone, its nodes moved as recorded,
// gives the recorded forces with its own memory of friction, gaps, ties and removed nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "deck/cycle.hpp"
#include "golden/recorded_set.hpp"
#include "replay/table.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using cycle::detail::Table;

using Three = std::array<double, 3>;

struct Moment {
  double time = 0.0;
  Three x{}, v{};
  double mass = 0.0, temperature = 0.0;
};

/// Where every recorded node was, by id; rows name a node only while it is in a pair.
class Record {
 public:
  /// `every_cycle`: only as long as no cycle is missing.
  Record(const Table& table, bool every_cycle) : table_(table), end_(table.rows()) {
    const std::array<std::string, 5> ids{"node", "n1", "n2", "n3", "n4"};
    const std::array<std::string, 5> roles{"s", "1", "2", "3", "4"};
    const double* t = table.column("t");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double cycle = table.column("cycle")[row];
      const double before = steps_.empty() ? cycle - 1 : table.column("cycle")[steps_.back()];
      if (every_cycle && cycle != before && cycle != before + 1) {
        end_ = row;
        break;
      }
      if (steps_.empty() || cycle != before) steps_.push_back(row);
      for (std::size_t r = 0; r < 5; ++r) {
        Moment m;
        m.time = t[row];
        for (std::size_t c = 0; c < 3; ++c) {
          const std::string axis = std::string("_") + "xyz"[c];
          m.x[c] = table.column("x" + roles[r] + axis)[row];
          m.v[c] = table.column("v" + roles[r] + axis)[row];
        }
        m.mass = table.column((r == 0 ? std::string("ms") : "m" + roles[r]))[row];
        if (const double* temperature = table.column(r == 0 ? "Ts" : "T" + roles[r]))
          m.temperature = temperature[row];
        auto& list = nodes_[static_cast<std::int64_t>(table.column(ids[r])[row])];
        if (list.empty() || list.back().time != m.time) list.push_back(m);
      }
    }
  }
  [[nodiscard]] const std::vector<std::size_t>& steps() const { return steps_; }
  [[nodiscard]] std::size_t end_of(std::size_t step) const {
    return step + 1 < steps_.size() ? steps_[step + 1] : end_;
  }
  void place(std::size_t step, const Model& model, Coordinates& x, cycle::State& state,
             cycle::CycleOptions& options) const {
    const std::size_t row = steps_[step];
    options.time = table_.column("t")[row];
    options.dt1 = table_.column("dt1")[row];
    options.dt12 = table_.column("dt12")[row];
    for (auto& v : state.velocity) v.resize(model.nodes.size());
    state.temperature.resize(model.nodes.size());
    for (const auto& [id, list] : nodes_) {
      const NodeIndex n = model.nodes.map.find(id);
      if (n == no_index) continue;
      const Moment m = step == 0 && options.time == 0.0 && list.front().time > 0.0
                           ? Moment{0.0,
                                    {x.x[n], x.y[n], x.z[n]},
                                    list.front().v,
                                    list.front().mass,
                                    list.front().temperature}
                           : at(list, options.time);
      x.x[n] = m.x[0];
      x.y[n] = m.x[1];
      x.z[n] = m.x[2];
      for (std::size_t c = 0; c < 3; ++c) state.velocity[c][n] = m.v[c];
      state.mass[n] = m.mass;
      if (table_.column("Ts") != nullptr) state.temperature[n] = m.temperature;
    }
  }

 private:
  /// As recorded; between two records on the straight line.
  static Moment at(const std::vector<Moment>& list, double time) {
    std::size_t k = 0;
    while (k < list.size() && list[k].time < time) ++k;
    if (k == list.size()) return list.back();
    if (k == 0 || list[k].time == time) return list[k];
    Moment m = list[k];
    const double u = (time - list[k - 1].time) / (list[k].time - list[k - 1].time);
    for (std::size_t c = 0; c < 3; ++c) {
      m.x[c] = (1 - u) * list[k - 1].x[c] + u * list[k].x[c];
      m.v[c] = (1 - u) * list[k - 1].v[c] + u * list[k].v[c];
    }
    return m;
  }
  const Table& table_;
  std::size_t end_;
  std::vector<std::size_t> steps_;
  std::map<std::int64_t, std::vector<Moment>> nodes_;
};

/// The deck of a set. The criteria of Iadm were recorded although the deck does not ask for
/// adaptive meshing, without which the solver drops Iadm.
std::string deck_text_of(const fs::path& dir) {
  std::string text = test::text_of(test::file_like(dir, "_0000.rad"));
  if (dir.filename() == "iadm1")
    text.insert(text.find("/INTER/TYPE7"), "/ADMESH/GLOBAL\n         1\n");
  return text;
}

using Key = std::pair<std::int64_t, std::set<std::int64_t>>;

struct Agreement {
  std::size_t rows = 0, acting = 0, off = 0, extra = 0, removed = 0, radii = 0;
  double worst = 0.0;
};

/// Replays a set from its deck; figures over all rows, and checks of what only some records have.
/// Over 80 lines: every column of a record is compared where its row is read.
Agreement from_deck(const std::string& name, const std::string& file, bool every_cycle) {
  Agreement result;
  const fs::path dir = deck::test::shared_dir() / "oracle" / "kernel" / name;
  SceneOptions scene_options;
  scene_options.candidates = false;
  scene_options.nodal_stiffness = true;
  const test::RecordedSet d(deck_text_of(dir), scene_options);
  const auto csv = test::states_of(dir / (file + ".csv.gz"));
  Table table;
  std::string error;
  EXPECT_TRUE(csv && table.read(*csv, error)) << error;
  const Record record(table, every_cycle);
  cycle::CycleOptions options;
  options.model = cycle::Model::reference;
  options.keep_pairs = true;
  options.margin = 0.5;
  const double* id[5] = {table.column("node"), table.column("n1"), table.column("n2"),
                         table.column("n3"), table.column("n4")};
  std::map<std::int64_t, int> fixed;
  const auto compare = [&](std::size_t step, const cycle::SceneOutcome& r, const Coordinates&) {
    std::map<Key, Three> got;
    std::map<std::int64_t, double> radius;
    std::set<std::int64_t> removed;
    for (const cycle::ContactOutcome& o : r.contacts) {
      if (o.contact->kind != ContactKind::node_segment) continue;
      for (const cycle::PairOutcome& p : o.pairs) {
        Key key{d.model.node_id(o.contact->secondary[p.at.secondary].node), {}};
        for (const NodeIndex n : o.contact->main[p.at.main].nodes)
          key.second.insert(d.model.node_id(n));
        got[key] = p.force;
      }
      for (const cycle::NodeCriteria& c : o.criteria) radius[d.model.node_id(c.node)] = c.radius;
      for (const cycle::NodeRelease& n : o.released) fixed[d.model.node_id(n.node)] = n.after;
      for (const cycle::Removal& n : o.removed)
        removed.insert(d.model.node_id(o.contact->secondary[n.secondary].node));
    }
    std::set<std::int64_t> seen;
    std::map<std::int64_t, bool> recorded_gone;
    std::map<std::int64_t, double> recorded_radius;
    std::map<std::int64_t, int> recorded_fixed;
    for (std::size_t row = record.steps()[step]; row < record.end_of(step); ++row) {
      Key key{static_cast<std::int64_t>(id[0][row]), {}};
      for (std::size_t k = 1; k < 5; ++k) key.second.insert(static_cast<std::int64_t>(id[k][row]));
      const Three f{table.column("F_x")[row], table.column("F_y")[row], table.column("F_z")[row]};
      const double size = std::hypot(f[0], f[1], f[2]);
      const auto found = got.find(key);
      const Three g = found != got.end() ? found->second : Three{};
      const double off = std::hypot(f[0] - g[0], f[1] - g[1], f[2] - g[2]);
      const double scale = table.column("K0")[row] * table.column("gap")[row];
      ++result.rows;
      result.acting += size > 0.0;
      const double e = size > 0.0 ? off / std::max(size, 1e-6 * scale) : off / scale;
      result.worst = std::max(result.worst, e);
      result.off += e > 1e-9;
      if (e > 1e-9 && result.off < 4)
        std::printf("%s row %zu: recorded %g %g %g, here %g %g %g\n", name.c_str(), row, f[0], f[1],
                    f[2], g[0], g[1], g[2]);
      got.erase(key);
      if (const double* r_s = table.column("R_s")) {
        const char* const columns[] = {"R_s", "R_1", "R_2", "R_3", "R_4"};
        static_cast<void>(r_s);
        for (std::size_t k = 0; k < 5; ++k) {
          auto& least = recorded_radius.try_emplace(static_cast<std::int64_t>(id[k][row]), 1e30)
                            .first->second;
          least = std::min(least, table.column(columns[k])[row]);
        }
      }
      seen.insert(key.first);
      seen.insert(key.second.begin(), key.second.end());
      // With ITIED the record keeps the node; the column is that of dtmin.
      if (const double* stiffness = table.column("stfs_out"); stiffness && !table.has("itied"))
        recorded_gone[key.first] = stiffness[row] < 0;
      if (const double* bc = table.column("bc_out"))
        recorded_fixed[key.first] = static_cast<int>(bc[row]);
    }
    // Other pairs may push only where the record does not say where their nodes were.
    for (const auto& [key, force] : got)
      result.extra += std::hypot(force[0], force[1], force[2]) > 0 && seen.contains(key.first) &&
                      std::all_of(key.second.begin(), key.second.end(),
                                  [&](std::int64_t n) { return seen.contains(n); });
    for (const auto& [node, gone] : recorded_gone) {
      EXPECT_EQ(removed.contains(node), gone) << name << " step " << step << " node " << node;
      result.removed += gone;
    }
    // Nodal normals come from all segments around, so every node must be where it was: at the
    // start, within the nine decimals of the deck.
    for (const auto& [node, r_node] : recorded_radius) {
      if (step > 0) break;
      EXPECT_NEAR(radius[node], r_node, 1e-6 * r_node) << name << " node " << node;
      ++result.radii;
    }
    for (const auto& [node, code] : recorded_fixed) {
      const auto known = fixed.find(node);
      EXPECT_TRUE(known == fixed.end() || known->second == code)
          << name << " step " << step << " node " << node;
    }
  };
  const auto motion = [&](std::size_t step, Coordinates& x, cycle::State& state,
                          cycle::CycleOptions& o) { record.place(step, d.model, x, state, o); };
  const cycle::StepsOutcome out = cycle::run_steps(d.scene, cycle::make_state(d.scene), options,
                                                   record.steps().size(), motion, compare);
  std::printf(
      "%-16s %zu steps, %zu rows, %zu act, %zu off, %zu extra, %zu radii, worst %.1e, %zu "
      "searches\n",
      name.c_str(), record.steps().size(), result.rows, result.acting, result.off, result.extra,
      result.radii, result.worst, out.searches);
  return result;
}

void expect_agreement(const std::string& name, const std::string& file, std::size_t acting,
                      std::size_t removed = 0, bool every_cycle = false) {
  const Agreement a = from_deck(name, file, every_cycle);
  EXPECT_GT(a.acting, acting) << name;
  EXPECT_EQ(a.off, 0u) << name;
  EXPECT_EQ(a.extra, 0u) << name;
  EXPECT_GE(a.removed, removed) << name;
  EXPECT_EQ(a.radii >= 20, name == "iadm1") << a.radii;
}

bool no_sets() {
  return !fs::is_directory(deck::test::shared_dir() / "oracle" / "kernel" / "dtmin_1");
}

TEST(GoldenSteps, DrivenSetsAreReplayedFromTheirDecks) {
  // Recorded in every fifth to twenty-fifth cycle, so only what needs no memory of those between:
  // removed nodes stay away, released translations stay free.
  if (no_sets()) GTEST_SKIP() << "no recorded sets (DECK_CORPUS)";
  expect_agreement("dtmin_1", "node_segment", 500, 5);
  for (const char* name : {"ibc_110", "iadm1", "icurv1_bowl", "fctidf_form0", "tstart_tstop"})
    expect_agreement(name, "node_segment", 500);
}

TEST(GoldenSteps, MemoryOfFrictionGapsAndTiesIsThatOfTheSolver) {
  // Recorded in every cycle from the first touch on, for some time.
  if (no_sets()) GTEST_SKIP() << "no recorded sets (DECK_CORPUS)";
  for (const char* name : {"kern_iform2", "kern_ifiltr1", "kern_inacti5", "kern_itied2"})
    expect_agreement(name, "node_segment", 140, 0, true);
  for (const char* name : {"t10_base", "t10_itied1"}) expect_agreement(name, "tied", 140, 0, true);
}

}  // namespace
}  // namespace deck
