// A kernel is a composition of effects: every composition gives the bits of the run-time-flag
// kernel and of both instruction sets, and refuses a packet without the arrays that it reads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>

#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using testing::Packet;
using testing::Pair;

struct Case {
  std::string name;
  ContactCard card;
};

std::vector<Case> cases(ContactKind kind) {
  std::vector<Case> out;
  for (const int inacti : {0, 5, 6}) {
    for (const double viss : {0.0, 0.05}) {
      for (const int friction : {0, 1, 2}) {
        ContactCard card;
        card.kind = kind;
        card.inacti = inacti;
        card.viss = viss;
        card.fric = friction == 0 ? 0.0 : 0.25;
        card.iform = friction == 2 ? 2 : 1;
        out.push_back({fmt::format("inacti {} viss {} friction {}", inacti, viss, friction), card});
      }
    }
  }
  return out;
}

std::vector<Case> rare_cases() {
  ContactCard base;
  base.fric = 0.3;
  std::vector<Case> out;
  const auto add = [&](const char* name, auto change) {
    ContactCard card = base;
    change(card);
    out.push_back({name, card});
  };
  add("viscous law", [](ContactCard& c) { c.ifric = 1, c.c = {1e-9, 1e-3, 0, 0, 1e-5, 0}; });
  add("Darmstad", [](ContactCard& c) { c.ifric = 2, c.c = {0, -.1, 1e-8, -.2, .05, -.5}; });
  add("Renard", [](ContactCard& c) { c.ifric = 3, c.c = {.2, .15, .3, .1, 10, 40}; });
  add("decay", [](ContactCard& c) { c.ifric = 4, c.c = {.1, .02}; });
  for (const int filter : {1, 2, 3}) {
    for (const int iform : {1, 2}) {
      add("filter", [&](ContactCard& c) {
        c.ifiltr = filter, c.xfreq = filter == 1 ? 0.4 : 20.0, c.iform = iform;
      });
    }
  }
  add("temperature", [](ContactCard& c) {
    c.ithe = 1, c.ithe_form = 1, c.kthe = 10, c.fct_idf = Curve{{300, 500}, {0.8, 1.4}};
  });
  add("fixed stiffness", [](ContactCard& c) { c.istf = 1, c.stfac = 2e5; });
  add("part pairs", [](ContactCard& c) { c.fric_id = true; });
  for (const int iform : {1, 2}) {
    add("orthotropic", [&](ContactCard& c) {
      c.fric_id = c.fric_orthotropic = true;
      c.iform = iform;
    });
  }
  add("heat", [](ContactCard& c) {
    c.ithe = 1, c.ithe_form = 1, c.kthe = 10, c.frad = 1e-8, c.drad = 2.5, c.fheats = .5;
  });
  add("sphere", [](ContactCard& c) { c.icurv = 1, c.curv_node1 = {0, 0, -60}; });
  add("cylinder", [](ContactCard& c) {
    c.icurv = 2, c.curv_node1 = {0, -1, -60}, c.curv_node2 = {0, 1, -60};
  });
  add("bicubic", [](ContactCard& c) { c.icurv = 3; });
  add("tie", [](ContactCard& c) { c.itied = 1, c.dtmin = 1e-4; });
  add("criteria", [](ContactCard& c) { c.iadm = 2, c.angladm = 20; });
  return out;
}

/// Same bits everywhere. Counts the values that are not 0, so that a silent kernel shows.
std::size_t expect_same(const PacketResult& a, const PacketResult& b, const std::string& what) {
  const auto values = [](const PacketResult& r) {
    std::vector<double> all;
    PacketResult::for_each_array(
        r, [&](const auto& x, Field, auto) { all.insert(all.end(), x.begin(), x.end()); });
    return all;
  };
  const std::vector<double> x = values(a), y = values(b);
  std::size_t live = 0, off = x.size() != y.size();
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    live += x[i] != 0.0;
    off +=
        std::bit_cast<std::uint64_t>(x[i]) != std::bit_cast<std::uint64_t>(y[i]) && !(x[i] == y[i]);
  }
  EXPECT_EQ(off, 0u) << what;
  return live;
}

PacketResult evaluate_as(const Case& c, Model model, const Packet& packet, PlanOptions options,
                         unsigned threads = 1) {
  PacketResult r;
  evaluate(make_plan(c.card, model, options), packet.view(1e-5, 1.1e-5), r, threads);
  return r;
}

TEST(Composition, FixedAndRunTimeFlagsGiveTheSameBits) {
  for (const ContactKind kind : {ContactKind::node_segment, ContactKind::edge_edge}) {
    const Packet packet(testing::random_pairs(333, 7, kind == ContactKind::edge_edge));
    for (const Case& c : cases(kind)) {
      for (const Model model : {Model::reference, Model::robust}) {
        for (const bool energies : {false, true}) {
          const PlanOptions fixed{energies, false, Isa::automatic};
          const PlanOptions flags{energies, true, Isa::automatic};
          EXPECT_TRUE(make_plan(c.card, model, fixed).composed) << c.name;
          EXPECT_FALSE(make_plan(c.card, model, flags).composed) << c.name;
          const auto live = expect_same(evaluate_as(c, model, packet, fixed),
                                        evaluate_as(c, model, packet, flags), c.name);
          EXPECT_GT(live, 1000u);
        }
      }
    }
  }
}

TEST(Composition, InstructionSetsGiveTheSameBits) {
  const Packet packet(testing::random_pairs(333, 11));
  const Packet edges(testing::random_pairs(333, 12, true));
  std::vector<Case> all = cases(ContactKind::node_segment);
  for (const Case& c : rare_cases()) all.push_back(c);
  for (const Case& c : cases(ContactKind::edge_edge)) all.push_back(c);
  for (const Case& c : all) {
    const Packet& p = c.card.kind == ContactKind::edge_edge ? edges : packet;
    for (const Model model : {Model::reference, Model::robust}) {
      const PacketResult base = evaluate_as(c, model, p, {true, false, Isa::baseline});
      for (const Isa isa : {Isa::avx2, Isa::avx512, Isa::automatic})
        expect_same(base, evaluate_as(c, model, p, {true, false, isa}), c.name);
    }
  }
}

TEST(Composition, SplittingIntoPacketsAndThreadsChangesNoBit) {
  for (const std::size_t n : {1u, 2u, 3u, 5u, 63u, 64u, 65u, 129u, 1001u}) {
    const std::vector<Pair> pairs = testing::random_pairs(n, 5);
    const Packet packet(pairs);
    for (const Case& c : rare_cases()) {
      const PacketResult whole = evaluate_as(c, Model::reference, packet, {});
      expect_same(whole, evaluate_as(c, Model::reference, packet, {}, 2), c.name);
      expect_same(whole, evaluate_as(c, Model::reference, packet, {}, 7), c.name);
      const std::size_t last = n - 1;
      const PacketResult alone = evaluate_as(c, Model::reference, Packet({pairs[last]}), {});
      EXPECT_EQ(alone.force[2][0], whole.force[2][last]) << c.name << " of " << n;
      EXPECT_EQ(alone.heat[0][0], whole.heat[0][last]) << c.name << " of " << n;
    }
  }
}

TEST(Composition, AResultUsedAgainKeepsNothingOfThePlanBefore) {
  const Packet packet(testing::random_pairs(150, 31));
  std::vector<Case> all = rare_cases();
  for (const Case& c : cases(ContactKind::node_segment)) all.push_back(c);
  PacketResult reused;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const Case& c : {all[k], all[(7 * k + 3) % all.size()]}) {
      const KernelPlan plan = make_plan(c.card);
      evaluate(plan, packet.view(1e-5, 1e-5), reused);
      PacketResult fresh;
      evaluate(plan, packet.view(1e-5, 1e-5), fresh);
      expect_same(fresh, reused, c.name);
    }
  }
}

TEST(Composition, TrianglePacketsGiveTheBitsOfMixedPackets) {
  std::vector<Pair> pairs = testing::random_pairs(256, 3);
  for (Pair& p : pairs) {
    p.triangle = true;
    p.x[4] = p.x[3];
  }
  std::vector<Pair> mixed = pairs;
  for (std::size_t i = 0; i < mixed.size(); i += 64) {
    mixed[i] = testing::quad_pair({5, 5, 0.5});  // one quadrangle per block
  }
  const Case c = cases(ContactKind::node_segment).back();
  for (const Model model : {Model::reference, Model::robust}) {
    const PacketResult a = evaluate_as(c, model, Packet(pairs), {});
    const PacketResult b = evaluate_as(c, model, Packet(mixed), {});
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (i % 64 == 0) continue;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(a.force[k][i], b.force[k][i]) << i;
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(a.weights[k][i], b.weights[k][i]) << i;
    }
  }
}

TEST(Needs, MissingArraysAreRefused) {
  const Packet packet(testing::random_pairs(10, 1));
  ContactCard card;
  card.fric = 0.2;
  card.iform = 2;
  const KernelPlan plan = make_plan(card);
  PacketView view = packet.view(1e-6, 1e-6);
  EXPECT_EQ(missing_fields(plan, view), Field::none);
  view.ft_old[1] = nullptr;
  EXPECT_EQ(missing_fields(plan, view), Field::friction_memory);
  PacketResult r;
  EXPECT_THROW(evaluate(plan, view, r), std::invalid_argument);
}

TEST(Composition, AnInstructionSetThatIsAskedForIsTakenWhereThereIsOne) {
  const auto isa = [&](Isa wish) {
    return std::string(
        make_plan(testing::elastic_card(), Model::reference, {true, false, wish}).isa);
  };
  EXPECT_EQ(isa(Isa::baseline), "baseline");
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EQ(isa(Isa::avx2), "avx2");
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    EXPECT_EQ(isa(Isa::automatic), "avx512");
  }
#endif
}

}  // namespace
}  // namespace deck::cycle
