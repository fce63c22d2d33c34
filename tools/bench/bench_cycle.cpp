// Cost of the contact force kernel in ns per pair on one core: compared with a hand-written loop,
// with run-time flags, and per added effect. Times are printed only if all answers agree. Input:
// gathered pairs (structure of arrays); tables tell if geometry is included.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "cycle/kernel/block.hpp"
#include "cycle/kernel/force.hpp"
#include "cycle/kernel/geometry.hpp"
#include "cycle_scene.hpp"
#include "harness.hpp"

// One pair at a time, for the rival that tests flags per pair.
template <>
struct deck::cycle::detail::Registers<1> {
  typedef double Real __attribute__((vector_size(8)));
  typedef std::int64_t Bits __attribute__((vector_size(8)));
  typedef Real LooseReal;
  typedef Bits LooseBits;
};

namespace {

using namespace deck::cycle;  // NOLINT: a program, not a header
using namespace deck::cycle::sheet;

/// The force stage with precomputed geometry.
class ForceStage {
 public:
  ForceStage(const KernelPlan& plan, const PacketView& view)
      : plan_(plan), view_(view), blocks_(view.size / detail::block_pairs) {
    geometry();
    out_.resize(view.size);
  }
  void geometry() {
    for_each_block(
        [this](const detail::Constants& k, std::size_t at, detail::GeometryBlock& block) {
          plan_.table->geometry(k, view_, at, detail::block_pairs, block);
        });
  }
  void force() {
    for_each_block(
        [this](const detail::Constants& k, std::size_t at, detail::GeometryBlock& block) {
          plan_.table->force(k, plan_.effects, view_, at, detail::block_pairs, block, out_);
        });
  }
  [[nodiscard]] std::size_t pairs() const { return blocks_.size() * detail::block_pairs; }
  [[nodiscard]] const std::vector<detail::GeometryBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const PacketResult& out() const { return out_; }

 private:
  template <class F>
  void for_each_block(const F& f) {
    const detail::Constants k = detail::make_constants(plan_, view_);
    for (std::size_t b = 0; b < blocks_.size(); ++b) f(k, b * detail::block_pairs, blocks_[b]);
  }
  KernelPlan plan_;
  PacketView view_;
  std::vector<detail::GeometryBlock> blocks_;
  PacketResult out_;
};

/// Hand-written minimal loop with equal elastic force and outputs, with compiler vectors (the
/// compiler does not vectorize the plain loop).
template <class Registers>
[[gnu::always_inline]] inline void minimal_loop(const detail::GeometryBlock& g, const double* gap,
                                                const double* k0, std::size_t at,
                                                PacketResult& out) {
  using V = typename Registers::LooseReal;
  using B = typename Registers::LooseBits;
  const auto in = [](const double* p) __attribute__((always_inline))->const V& {
    return *reinterpret_cast<const V*>(p);
  };
  double* const h[4] = {out.weights[0].data() + at, out.weights[1].data() + at,
                        out.weights[2].data() + at, out.weights[3].data() + at};
  double* const f[3] = {out.force[0].data() + at, out.force[1].data() + at,
                        out.force[2].data() + at};
  double* const n[3] = {out.normal[0].data() + at, out.normal[1].data() + at,
                        out.normal[2].data() + at};
  double *const fn = out.normal_force.data() + at, *const kn = out.k_nodal.data() + at;
  double *const pen = out.penetration.data() + at, *const dist = out.distance.data() + at;
  double* const ge = out.effective_gap.data() + at;
  std::int64_t* const status = out.status.data() + at;
  for (std::size_t i = 0; i < detail::block_pairs; i += sizeof(V) / sizeof(double)) {
    constexpr std::int64_t touching = status_contact, over = status_gap_closed;
    const V zero = {}, p = in(g.penetration + i), room = in(gap + i);
    const V all = in(g.keep + i) != 0.0 ? in(k0 + i) : zero;
    const V d = room - p;
    const B closed = (d / room < 1e-10) & (all > 0.0);
    const V k = closed ? zero : all;
    const V phi = room / (d > 1e-10 ? d : zero + 1e-10);
    const V sec = 0.5 * k * phi;
    const V force = -(sec * p);
    *reinterpret_cast<V*>(fn + i) = force;
    *reinterpret_cast<V*>(kn + i) = sec * phi;
    *reinterpret_cast<V*>(pen + i) = p;
    *reinterpret_cast<V*>(dist + i) = in(g.distance + i);
    *reinterpret_cast<V*>(ge + i) = room;
    const B acts = (force != 0.0) & (k != 0.0);
    *reinterpret_cast<B*>(status + i) = (acts & touching) | (closed & over);
    for (std::size_t c = 0; c < 3; ++c) {
      *reinterpret_cast<V*>(f[c] + i) = force * in(g.normal[c] + i);
      *reinterpret_cast<V*>(n[c] + i) = in(g.normal[c] + i);
    }
    for (std::size_t c = 0; c < 4; ++c) *reinterpret_cast<V*>(h[c] + i) = in(g.weight[c] + i);
  }
}

// The loop per instruction set, selected as for the kernels.
using MinimalLoop = void (*)(const detail::GeometryBlock&, const double*, const double*,
                             std::size_t, PacketResult&);
void minimal_plain(const detail::GeometryBlock& g, const double* gap, const double* k0,
                   std::size_t at, PacketResult& out) {
  minimal_loop<detail::Registers<2>>(g, gap, k0, at, out);
}
#if defined(__x86_64__)
__attribute__((target("avx512f,avx512dq,avx512vl"))) void minimal_avx512(
    const detail::GeometryBlock& g, const double* gap, const double* k0, std::size_t at,
    PacketResult& out) {
  minimal_loop<detail::Registers<8>>(g, gap, k0, at, out);
}
__attribute__((target("avx2"))) void minimal_avx2(const detail::GeometryBlock& g, const double* gap,
                                                  const double* k0, std::size_t at,
                                                  PacketResult& out) {
  minimal_loop<detail::Registers<4>>(g, gap, k0, at, out);
}
#endif

MinimalLoop hand_written_for(const std::string& isa) {
#if defined(__x86_64__)
  if (isa == "avx512") return minimal_avx512;
  if (isa == "avx2") return minimal_avx2;
#endif
  return minimal_plain;
}

double worst_difference(const PacketResult& a, const PacketResult& b, std::size_t n) {
  double size = 0.0, off = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      size = std::max(size, std::abs(a.force[c][i]));
      off = std::max(off, std::abs(a.force[c][i] - b.force[c][i]));
      if (std::isnan(a.force[c][i]) || std::isnan(b.force[c][i])) return INFINITY;
    }
  }
  return size > 0.0 ? off / size : INFINITY;  // all zero proves nothing
}

void require_equal(double difference, const std::string& what) {
  if (difference == 0.0) return;
  fmt::print(stderr, "bench_cycle: {}: answers differ by {:.3e} of the largest; no times\n", what,
             difference);
  std::exit(1);
}

/// Best time of each in seconds, after a warm-up round.
std::vector<double> race(const bench::Contestants& all, int rounds) {
  for (const auto& contestant : all) contestant();
  std::vector<double> out;
  for (const auto& times : bench::run_in_turns(all, rounds)) out.push_back(bench::best(times).wall);
  return out;
}

struct Composition {
  std::string name;
  ContactCard card;
  bool energies = false;
};

std::vector<Composition> compositions(ContactKind kind) {
  ContactCard card;
  card.kind = kind;
  card.viss = 0.0;
  std::vector<Composition> out;
  out.push_back({"elastic", card});
  out.push_back({"+ energy", card, true});
  card.viss = 0.05;
  out.push_back({"+ damping", card});
  card.fric = 0.2;
  out.push_back({"+ damping, friction Iform 1", card});
  card.iform = 2;
  out.push_back({"+ damping, friction Iform 2", card});
  card.inacti = 6;
  out.push_back({"+ damping, friction Iform 2, Inacti 6", card});
  out.push_back({"all mechanical (and energy)", card, true});
  if (kind == ContactKind::edge_edge) return out;
  card.ifric = 3;
  card.c = {0.15, 0.1, 0.3, 0.05, 1, 5};
  out.push_back({"all mechanical, Renard law (generic)", card, true});
  card.ifric = 0;
  card.ithe = 1;
  card.ithe_form = 1;
  card.kthe = 500;
  card.fheats = card.fheatm = 0.4;
  out.push_back({"all mechanical and heat", card, true});
  return out;
}

PlanOptions option(bool energies, bool generic, Isa isa = Isa::automatic) {
  PlanOptions o;
  o.energies = energies;
  o.force_generic = generic;
  o.isa = isa;
  return o;
}

nlohmann::json composition_table(ContactKind kind, Model model, const Scene& scene, int rounds) {
  const PacketView view = scene.view();
  const double per_pair = 1e9 / static_cast<double>(view.size);
  nlohmann::json rows = nlohmann::json::array();
  for (const Composition& c : compositions(kind)) {
    const KernelPlan fixed = make_plan(c.card, model, option(c.energies, false));
    const KernelPlan flags = make_plan(c.card, model, option(c.energies, true));
    const KernelPlan base = make_plan(c.card, model, option(c.energies, false, Isa::baseline));
    PacketResult a, b, d;
    evaluate(fixed, view, a);
    evaluate(flags, view, b);
    evaluate(base, view, d);
    require_equal(worst_difference(a, b, view.size), c.name + ", flags");
    require_equal(worst_difference(a, d, view.size), c.name + ", baseline");
    ForceStage stage(fixed, view), stage_flags(flags, view);
    const std::vector<double> t = race(
        {[&] { evaluate(fixed, view, a); }, [&] { evaluate(flags, view, b); },
         [&] { evaluate(base, view, d); }, [&] { stage.force(); }, [&] { stage_flags.force(); }},
        rounds);
    rows.push_back({{"composition", c.name},
                    {"composed_ns", t[0] * per_pair},
                    {"flags_ns", t[1] * per_pair},
                    {"baseline_ns", t[2] * per_pair},
                    {"force_only_ns", t[3] * per_pair},
                    {"force_only_flags_ns", t[4] * per_pair},
                    {"million_pairs_per_second", 1e3 / (t[0] * per_pair)}});
  }
  bench::print_table(fmt::format("{}, {} model: ns per pair, geometry included in the first three",
                                 kind == ContactKind::edge_edge ? "edge-edge" : "node-quad",
                                 model == Model::reference ? "reference" : "robust"),
                     rows, {"composition", "composition"},
                     {{"composed_ns", "composed"},
                      {"flags_ns", "flags"},
                      {"baseline_ns", "baseline"},
                      {"force_only_ns", "force"},
                      {"force_only_flags_ns", "f.flags"},
                      {"million_pairs_per_second", "Mpairs/s"}});
  return rows;
}

/// The rival: one pair at a time, with a flag test per effect in the loop. It uses the kernels'
/// source, so answers must be bit-identical; compiled without run-time instruction sets.
template <Model M, ContactKind K>
void flags_per_pair(const KernelPlan& plan, const PacketView& view, PacketResult& out) {
  using One = detail::Pack<1>;
  const detail::Constants k = detail::make_constants(plan, view);
  out.prepare(view.size, plan.writes);
  for (std::size_t b = 0; b < view.size; b += detail::block_pairs) {
    detail::GeometryBlock block;
    const std::size_t n = std::min(detail::block_pairs, view.size - b);
    detail::geometry_block<One, M, K, false>(k, view, b, n, block);
    detail::force_block<One, M, K>(detail::RuntimeEffects{plan.effects}, k, view, b, n, block, out);
  }
}

/// A row of the cost table: an effect and its base.
struct EffectRow {
  std::string name;
  ContactCard without, with;
  bool energies = false;  ///< of `with`
  bool in_kernel = true;  ///< false: a separate stage, which the rival lacks
};

ContactCard plain(ContactKind kind, bool damping = false, int iform = 0) {
  ContactCard card;
  card.kind = kind;
  card.viss = damping ? 0.05 : 0.0;
  if (iform != 0) {
    card.fric = 0.2;
    card.iform = iform;
  }
  return card;
}

template <class Change>
ContactCard changed(ContactCard card, Change&& change) {
  change(card);
  return card;
}

std::vector<EffectRow> effect_rows(ContactKind kind) {
  const ContactCard elastic = plain(kind), damped = plain(kind, true), rub = plain(kind, true, 1);
  const auto with = [](const ContactCard& card, auto&& change) { return changed(card, change); };
  std::vector<EffectRow> rows;
  rows.push_back({"elastic energy (a logarithm)", elastic, elastic, true});
  rows.push_back(
      {"gap reduction (Inacti 6)", elastic, with(elastic, [](auto& c) { c.inacti = 6; })});
  rows.push_back({"normal damping (VISs) and kinematic time step", elastic, damped});
  rows.push_back({"friction, viscous (Iform 1)", damped, rub});
  rows.push_back({"friction, incremental (Iform 2)", damped, plain(kind, true, 2)});
  rows.push_back({"coefficients per pair of parts (/FRICTION)", rub,
                  with(rub, [](auto& c) { c.fric_id = true; })});
  const auto heat = [&](double frad) {
    return with(elastic, [&](auto& c) {
      c.ithe = c.ithe_form = 1;
      c.kthe = 500;
      c.frad = frad;
      c.drad = 0.6;
    });
  };
  rows.push_back({"heat conduction (Ithe, Ithe_form 1)", elastic, heat(0.0), false, false});
  if (kind == ContactKind::edge_edge) return rows;
  rows.push_back({"heat conduction and radiation (Frad)", elastic, heat(1e-8), false, false});
  for (const int law : {1, 2, 3}) {
    const char* names[] = {"", "friction law Ifric 1 (polynomial)",
                           "friction law Ifric 2 (exponential)",
                           "friction law Ifric 3 (piecewise)"};
    rows.push_back({names[law], rub, with(rub, [&](auto& c) {
                      c.ifric = law;
                      if (law == 3)
                        c.c = {0.15, 0.1, 0.3, 0.05, 1, 5};
                      else
                        c.c = {1e-6, -1e-3, 1e-6, -1e-3, 1e-2, -1e-2};
                    })});
  }
  rows.push_back({"friction filter (Ifiltr 1)", rub, with(rub, [](auto& c) {
                    c.ifiltr = 1;
                    c.xfreq = 0.3;
                  })});
  const ContactCard warm = with(rub, [](auto& c) {
    c.ithe = c.ithe_form = 1;
    c.kthe = 500;
  });
  rows.push_back({"friction against temperature (fct_IDF)", warm,
                  with(warm,
                       [](auto& c) {
                         c.fct_idf = Curve{{0, 1000}, {1.0, 2.0}};
                       }),
                  false, false});
  rows.push_back({"friction heat (Fheats, Fheatm)", warm,
                  with(warm, [](auto& c) { c.fheats = c.fheatm = 0.4; }), false, false});
  rows.push_back({"orthotropic friction", with(rub, [](auto& c) { c.fric_id = true; }),
                  with(rub, [](auto& c) { c.fric_id = c.fric_orthotropic = true; })});
  for (const int curve : {1, 2, 3}) {
    const char* names[] = {"", "sphere (Icurv 1)", "cylinder (Icurv 2)",
                           "bicubic surface (Icurv 3)"};
    rows.push_back({names[curve], elastic,
                    with(elastic,
                         [&](auto& c) {
                           c.icurv = curve;
                           c.curv_node1 = {0, 0, 1000};
                           c.curv_node2 = {1, 0, 1000};
                         }),
                    false, false});
  }
  rows.push_back({"adaptivity criteria (Iadm 2)", elastic,
                  with(elastic, [](auto& c) { c.iadm = 2; }), false, false});
  rows.push_back({"tie below the time step (ITIED 1)", damped,
                  with(damped, [](auto& c) { c.itied = 1; }), false, false});
  rows.push_back({"release of boundary conditions (IBC)", elastic,
                  with(elastic, [](auto& c) { c.ibc = 7; }), false, false});
  return rows;
}

template <ContactKind K>
nlohmann::json effect_costs(const char* title, const Scene& scene, int rounds) {
  const PacketView view = scene.view();
  const double ns = 1e9 / static_cast<double>(view.size);
  nlohmann::json rows = nlohmann::json::array();
  for (const EffectRow& row : effect_rows(K)) {
    const Model m = Model::reference;
    const KernelPlan less = make_plan(row.without, m, option(false, false));
    const KernelPlan more = make_plan(row.with, m, option(row.energies, false));
    const KernelPlan base = make_plan(row.with, m, option(row.energies, false, Isa::baseline));
    const KernelPlan flags = make_plan(row.with, m, option(row.energies, true));
    PacketResult a, b, c, d, e;
    evaluate(less, view, a);
    evaluate(more, view, b);
    evaluate(base, view, c);
    evaluate(flags, view, d);
    require_equal(worst_difference(b, c, view.size), row.name + ", baseline");
    require_equal(worst_difference(b, d, view.size), row.name + ", flags");
    std::vector<std::function<void()>> all = {
        [&] { evaluate(less, view, a); }, [&] { evaluate(more, view, b); },
        [&] { evaluate(base, view, c); }, [&] { evaluate(flags, view, d); }};
    if (row.in_kernel) {
      flags_per_pair<Model::reference, K>(more, view, e);
      require_equal(worst_difference(b, e, view.size), row.name + ", flags per pair");
      all.push_back([&] { flags_per_pair<Model::reference, K>(more, view, e); });
    }
    const std::vector<double> t = race(all, rounds);
    rows.push_back({{"effect", row.name},
                    {"without_ns", t[0] * ns},
                    {"with_ns", t[1] * ns},
                    {"added_ns", (t[1] - t[0]) * ns},
                    {"baseline_ns", t[2] * ns},
                    {"flags_ns", t[3] * ns},
                    {"flags_per_pair_ns", row.in_kernel ? t[4] * ns : 0.0}});
  }
  bench::print_table(fmt::format("{}, reference model, ns per pair, geometry included", title),
                     rows, {"effect", "effect"},
                     {{"without_ns", "without"},
                      {"with_ns", "with"},
                      {"added_ns", "added"},
                      {"baseline_ns", "baseline"},
                      {"flags_ns", "flags"},
                      {"flags_per_pair_ns", "per pair"}});
  return rows;
}

nlohmann::json hand_written_race(const Scene& scene, int rounds) {
  const PacketView view = scene.view();
  ContactCard card;
  card.viss = 0.0;
  const double per_pair =
      1e9 / static_cast<double>(view.size / detail::block_pairs * detail::block_pairs);
  nlohmann::json rows = nlohmann::json::array();
  for (const Isa isa : {Isa::automatic, Isa::avx2, Isa::baseline}) {
    PlanOptions options = option(false, false, isa);
    const KernelPlan plan = make_plan(card, Model::reference, options);
    if (!rows.empty() && rows.back()["isa"] == plan.isa) continue;
    MinimalLoop loop = hand_written_for(plan.isa);
    ForceStage stage(plan, view);
    stage.force();
    PacketResult out;
    out.resize(view.size);
    const auto by_hand = [&] {
      for (std::size_t b = 0; b < stage.blocks().size(); ++b) {
        const std::size_t at = b * detail::block_pairs;
        loop(stage.blocks()[b], view.gap + at, view.k0 + at, at, out);
      }
    };
    by_hand();
    require_equal(worst_difference(stage.out(), out, stage.pairs()), "hand-written loop");
    std::vector<double> t =
        race({[&] { stage.force(); }, by_hand, [&] { stage.geometry(); }}, 3 * rounds);
#if defined(__x86_64__)
    if (plan.isa == "avx512") {  // half the vector width is faster on some machines
      loop = minimal_avx2;
      t[1] = std::min(t[1], race({by_hand}, 3 * rounds)[0]);
    }
#endif
    fmt::print(
        "{}: elastic force, geometry excluded: composed {:.2f} ns, hand-written {:.2f} ns, "
        "ratio of speeds {:.3f}; geometry alone {:.1f} ns\n",
        plan.isa, t[0] * per_pair, t[1] * per_pair, t[1] / t[0], t[2] * per_pair);
    rows.push_back({{"isa", plan.isa},
                    {"composed_ns", t[0] * per_pair},
                    {"hand_written_ns", t[1] * per_pair},
                    {"speed_ratio", t[1] / t[0]},
                    {"geometry_ns", t[2] * per_pair}});
  }
  return rows;
}

/// Gather, evaluate and add to nodes in fixed order, compared with an unordered scatter.
nlohmann::json assembly_race(const Scene& scene, int rounds) {
  ContactCard card;
  card.fric = 0.2;
  const KernelPlan plan = make_plan(card, Model::reference, option(false, false));
  PacketResult r;
  evaluate(plan, scene.view(), r);
  NodalSums ordered, scattered;
  const auto in_order = [&] {
    ordered.resize(scene.mass.size());
    assemble(plan, scene.pairs, r, ordered);
  };
  const auto scatter = [&] {
    scattered.resize(scene.mass.size());
    for (std::size_t i = 0; i < r.size; ++i) {
      for (std::size_t role = 0; role < 5; ++role) {
        const double share = role == 0 ? -1.0 : r.weights[role - 1][i];
        const std::uint32_t n = scene.pairs.node[role][i];
        for (std::size_t c = 0; c < 3; ++c) scattered.force[c][n] += share * r.force[c][i];
        scattered.stiffness[n] += std::abs(share) * r.k_nodal[i];
        scattered.contact[n] |= static_cast<std::uint8_t>(r.status[i] & status_contact);
      }
    }
  };
  PacketBuffer buffer;
  const auto gather = [&] { buffer.gather(scene.nodes(), scene.pairs, plan.needs); };
  in_order();
  scatter();
  for (std::size_t c = 0; c < 3; ++c) {
    if (ordered.force[c] != scattered.force[c]) require_equal(1.0, "assembly");
  }
  const std::vector<double> t = race({gather, in_order, scatter}, rounds);
  const double per_pair = 1e9 / static_cast<double>(r.size);
  fmt::print("gather {:.1f} ns, ordered sums {:.1f} ns, plain scatter {:.1f} ns, ratio {:.2f}\n",
             t[0] * per_pair, t[1] * per_pair, t[2] * per_pair, t[1] / t[2]);
  return {{"gather_ns", t[0] * per_pair},
          {"ordered_ns", t[1] * per_pair},
          {"scatter_ns", t[2] * per_pair}};
}

}  // namespace

/// bench_cycle [CELLS] [ROUNDS] [--json FILE]: CELLS^2 pairs.
int main(int argc, char** argv) {
  bench::Arguments arguments(argc, argv);
  const auto json = arguments.value("--json");
  const auto number = [&](std::size_t k, int usual) {
    return arguments.words.size() > k ? std::atoi(arguments.words[k].c_str()) : usual;
  };
  const auto cells = static_cast<std::size_t>(number(0, 128));
  const int rounds = number(1, 15);
  const Scene nodes = make_scene(cells, false), edges = make_scene(cells, true);
  fmt::print("{} pairs, one thread\n", nodes.pairs.size());
  nlohmann::json all;
  all["hand_written"] = hand_written_race(nodes, rounds);
  all["assembly"] = assembly_race(nodes, rounds);
  for (const Model model : {Model::reference, Model::robust}) {
    const char* name = model == Model::reference ? "reference" : "robust";
    all[name]["node_segment"] = composition_table(ContactKind::node_segment, model, nodes, rounds);
    all[name]["edge_edge"] = composition_table(ContactKind::edge_edge, model, edges, rounds);
  }
  all["effects"]["node_segment"] =
      effect_costs<ContactKind::node_segment>("node-quad", nodes, rounds);
  all["effects"]["edge_edge"] = effect_costs<ContactKind::edge_edge>("edge-edge", edges, rounds);
  bench::write_json(json, all);
  return 0;
}
