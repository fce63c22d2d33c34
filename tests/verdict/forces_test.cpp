// What a verdict says about forces: of outcomes that are written down here.
#include <functional>

#include "deck/verdict.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

using Lines = std::vector<std::string>;
using Because = cycle::Removal::Because;

/// Two plates and an outcome of two contacts: nodes 5 .. 8 against a segment, and edges.
struct Forces {
  Forces() {
    contacts = {d.scene.contacts[0], d.scene.contacts[0]};
    Contact& edges = contacts[1];
    edges.kind = ContactKind::edge_edge;
    const auto edge = [&](std::int64_t a, std::int64_t b) {
      edges.secondary_edges.emplace_back().nodes = {d.model.find_node(a), d.model.find_node(b)};
    };
    edge(1, 6);
    edge(2, 7);
    other.id = 33;
    edges.inter = &other;
    outcome.contacts.resize(2);
    for (int i = 0; i < 2; ++i) outcome.contacts[i].contact = &contacts[i];
    in.deck = &d.deck;
    in.model = &d.model;
    in.interfaces = &d.interfaces;
    in.cycle = &outcome;
  }
  cycle::ContactOutcome& contact(std::size_t i) { return outcome.contacts[i]; }
  Lines lines() const {
    Lines out;
    for (const VerdictSentence& s : make_verdict(in).sentences) {
      std::string line = s.what + ": " + s.text;
      for (const auto& [name, n] : s.counts) line += " " + name + "=" + std::to_string(n);
      out.push_back(line);
    }
    return out;
  }

  Inspected d{plates()};
  InterType7 other;
  std::vector<Contact> contacts;
  cycle::SceneOutcome outcome;
  cycle::StepsOutcome steps;
  VerdictInput in;
};

Lines said_of(const std::function<void(Forces&)>& change) {
  Forces f;
  change(f);
  return f.lines();
}

const std::string none = "forces: No contact force at the start. pairs_with_force=0";

TEST(VerdictForces, PairsOfAllContactsAndTheLargestNodalForceAreSaid) {
  EXPECT_EQ(said_of([](Forces&) {}), Lines{none});
  EXPECT_EQ(said_of([](Forces& f) {
              f.contact(1).pairs_with_force = 1;
              f.outcome.largest_nodal_force = 12.34567;
            }),
            (Lines{"forces: 1 pair pushes at the start; largest nodal force 12.35 at no node. "
                   "pairs_with_force=1"}));
  EXPECT_EQ(said_of([](Forces& f) {
              f.contact(0).pairs_with_force = 3;
              f.contact(1).pairs_with_force = 2;
              f.outcome.largest_nodal_force = 7;
              f.outcome.force_node = f.d.model.find_node(6);
            }),
            (Lines{"forces: 5 pairs push at the start; largest nodal force 7 at node 6. "
                   "pairs_with_force=5"}));
}

TEST(VerdictForces, ContactsThatWereNotEvaluatedAreSaidOnce) {
  const auto open = [](bool first, bool second, std::size_t known) {
    return said_of([&](Forces& f) {
      f.contact(0).complete = first;
      f.contact(1).complete = second;
      if (known == 9) return;
      f.in.contacts.emplace().contacts = 2;
      f.in.contacts->not_evaluated = known;
    });
  };
  const std::string left = "forces_not_evaluated: Forces of ";
  EXPECT_EQ(open(false, false, 9),
            (Lines{"forces: No force was evaluated.",
                   left + "2 contacts are not evaluated. forces_not_evaluated=2"}));
  EXPECT_EQ(open(false, true, 9),
            (Lines{none, left + "1 contact are not evaluated. forces_not_evaluated=1"}));
  const auto last = [&](std::size_t known) { return open(false, false, known).back(); };
  EXPECT_EQ(last(1), left + "2 contacts are not evaluated. forces_not_evaluated=2");
  EXPECT_EQ(last(2), "forces: No force was evaluated.") << "said already";
}

TEST(VerdictForces, StepsBeforeTheLastThatPushedAreSaid) {
  const auto steps = [](const std::vector<std::array<std::size_t, 2>>& pairs, std::size_t now) {
    return said_of([&](Forces& f) {
      for (const auto& [a, b] : pairs) {
        auto& line = f.steps.lines.emplace_back();
        line.contacts.resize(2);
        line.contacts[0].pairs_with_force = a;
        line.contacts[1].pairs_with_force = b;
      }
      f.contact(0).pairs_with_force = now;
      f.contact(0).pairs_tied = now;
      f.contact(1).pairs_tied = 1;
      f.in.steps = &f.steps;
    });
  };
  const std::string one = "tied_now: 1 pair is tied then.",
                    two = "tied_now: 2 pairs are tied then.";
  EXPECT_EQ(steps({{0, 0}, {0, 0}}, 0),
            (Lines{"forces: No contact force after 1 step of prescribed motion. pairs_with_force=0",
                   one}));
  EXPECT_EQ(steps({{0, 0}, {0, 3}, {1, 0}, {0, 0}}, 0),
            (Lines{"forces: No contact force after 3 steps of prescribed motion. "
                   "pairs_with_force=0",
                   "steps_with_force: 2 of 3 evaluations before had forces, the first at step 1. "
                   "steps_with_force=2",
                   one}));
  EXPECT_EQ(steps({{2, 0}, {0, 0}}, 0)[1],
            "steps_with_force: 1 of 1 evaluation before had forces, the first at step 0. "
            "steps_with_force=1");
  EXPECT_EQ(steps({{2, 0}, {1, 0}}, 1),
            (Lines{"forces: 1 pair pushes after 1 step of prescribed motion; largest nodal force 0 "
                   "at no node. pairs_with_force=1",
                   two}));
}

TEST(VerdictForces, PairsTiedAreSaidOfStepsOnly) {
  EXPECT_EQ(said_of([](Forces& f) { f.contact(0).pairs_tied = 4; }), Lines{none});
}

TEST(VerdictForces, TiesHaveNone) {
  const auto ties = [](std::size_t n) {
    Lines lines = said_of([&](Forces& f) {
      f.in.contacts.emplace().contacts = 0;
      f.in.contacts->ties.emplace().ties = n;
    });
    std::erase_if(lines, [](const std::string& s) { return s.starts_with("penetrations"); });
    return lines;
  };
  EXPECT_EQ(ties(0), Lines{none});
  EXPECT_EQ(ties(1), (Lines{none, "tie_forces: Forces of 1 tie (TYPE2) are not computed."}));
  EXPECT_EQ(ties(3), (Lines{none, "tie_forces: Forces of 3 ties (TYPE2) are not computed."}));
}

TEST(VerdictForces, WhatDtminRemovesIsNamed) {
  const auto removed = [](const std::vector<Because>& nodes, const std::vector<Because>& edges) {
    Lines lines = said_of([&](Forces& f) {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        f.contact(0).removed.push_back({static_cast<std::uint32_t>(i), nodes[i]});
      for (std::size_t i = 0; i < edges.size(); ++i)
        f.contact(1).removed.push_back({static_cast<std::uint32_t>(i), edges[i]});
    });
    EXPECT_EQ(lines.front(), none);
    return lines.size() > 1 ? lines[1] : std::string();
  };
  const auto nodal = Because::nodal_step, kinematic = Because::kinematic_step;
  const std::string start = "removed: dtmin is above the time step of ";
  EXPECT_EQ(removed({Because::mid_surface}, {Because::no_element_left}), "");
  EXPECT_EQ(removed({nodal}, {}),
            start +
                "1 node or edge in contact: the solver removes it from the interface for good "
                "(node 5). removed_by_dtmin=1");
  EXPECT_EQ(removed({}, {kinematic, nodal}),
            start +
                "2 nodes or edges in contact: the solver removes them from the interface for "
                "good (edge 1-6, edge 2-7). removed_by_dtmin=2");
  EXPECT_EQ(removed({nodal, nodal, kinematic}, {}),
            start +
                "3 nodes or edges in contact: the solver removes them from the interface for "
                "good (node 5, node 6, node 7). removed_by_dtmin=3");
  EXPECT_EQ(removed({nodal, nodal, kinematic, nodal}, {nodal}),
            start +
                "5 nodes or edges in contact: the solver removes them from the interface for "
                "good (node 5, node 6, node 7 and 1 more). removed_by_dtmin=5")
      << "those of the first contact that dtmin takes something from";
  cycle::ContactOutcome o;
  for (const Because why :
       {nodal, Because::mid_surface, kinematic, Because::no_element_left, nodal})
    o.removed.push_back({0, why});
  EXPECT_EQ(removed_by_step(o), 3u);
}

TEST(VerdictForces, TheLargestAccelerationIsThatOfTheContactThatHasIt) {
  const auto said = [](std::size_t pairs, double first, double second, bool at_node) {
    const Lines lines = said_of([&](Forces& f) {
      f.contact(0).pairs_with_force = pairs;
      f.contact(0).largest_acceleration = first;
      f.contact(1).largest_acceleration = second;
      f.contact(0).acceleration_node = f.d.model.find_node(5);
      if (at_node) f.contact(1).acceleration_node = f.d.model.find_node(8);
    });
    return lines.size() > 1 ? lines[1] : std::string();
  };
  EXPECT_EQ(said(1, 2, 1, true), "acceleration: Largest acceleration 2: node 5, interface 1.");
  EXPECT_EQ(said(1, 2, 2, true), "acceleration: Largest acceleration 2: node 5, interface 1.");
  EXPECT_EQ(said(1, 2, 3.14159, true),
            "acceleration: Largest acceleration 3.142: node 8, interface 33.");
  EXPECT_EQ(said(1, 2, 3, false), "") << "of no node";
  EXPECT_EQ(said(0, 2, 1, true), "") << "without a force";
}

TEST(VerdictForces, PairsAtTheMidSurfaceAreSaid) {
  const auto closed = [](std::size_t a, std::size_t b) {
    return said_of([&](Forces& f) {
      f.contact(0).gap_closed = a;
      f.contact(1).gap_closed = b;
    });
  };
  EXPECT_EQ(closed(1, 0), (Lines{none,
                                 "mid_surface: 1 pair is at the mid-surface: the solver "
                                 "drops the node or edge. pairs_at_mid_surface=1"}));
  EXPECT_EQ(closed(1, 2), (Lines{none,
                                 "mid_surface: 3 pairs are at the mid-surface: the solver "
                                 "drops the nodes or edges. pairs_at_mid_surface=3"}));
}

TEST(VerdictForces, AContactThatLimitsTheStepIsSaid) {
  const auto said = [](std::size_t pairs, double contact, double structure) {
    const Lines lines = said_of([&](Forces& f) {
      f.contact(0).pairs_with_force = pairs;
      f.outcome.contact_dt = contact;
      f.outcome.structure.dt = structure;
    });
    return lines.size() > 1 ? lines[1] : std::string();
  };
  EXPECT_EQ(said(1, 0.5, 0.75),
            "time_step: Contact limits the time step: 0.5 against 0.75 of the elements.");
  EXPECT_EQ(said(1, 0.75, 0.75), "") << "not below";
  EXPECT_EQ(said(1, 0.5, 1e30), "") << "no element limits";
  EXPECT_EQ(said(0, 0.5, 0.75), "") << "no pair pushes";
}

TEST(VerdictForces, NothingIsSaidOfForcesWhereNothingWasExamined) {
  Forces f;
  const Inspected none_there(SmallDeck().node(1, 0, 0, 0).text());
  f.in.deck = &none_there.deck;
  f.in.interfaces = &none_there.interfaces;
  EXPECT_EQ(f.lines(),
            (Lines{"nothing_examined: Nothing examined: the deck has no contact interface."}));
}

TEST(SecondaryName, IsANodeOrAnEdge) {
  const Forces f;
  EXPECT_EQ(secondary_name(f.d.model, f.contacts[0], 2), "node 7");
  EXPECT_EQ(secondary_name(f.d.model, f.contacts[1], 1), "edge 2-7");
}

}  // namespace
}  // namespace deck::test
