// Contacts that follow their nodes step by step are those that are formed anew.
#include "edit/fix/movable.hpp"

#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

struct Followed : detail::MovableDeck {
  Followed(const LoadedDeck& loaded, const MoveNodesOptions& options)
      : MovableDeck(loaded, options) {}
  std::size_t nodes() const { return model_.nodes.size(); }
  void move(NodeIndex n, const P& by) {
    model_.nodes.x[n] += by[0];
    model_.nodes.y[n] += by[1];
    model_.nodes.z[n] += by[2];
  }
  const Scene& now() { return evaluate_with_ties(); }
  Scene anew() const {
    return detail::fix_scene(model_, interfaces_, context_.options().read.limits, options_, false);
  }
};

void expect_same(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    const Contact &x = a.contacts[c], &y = b.contacts[c];
    EXPECT_EQ(x.inter, y.inter);
    EXPECT_EQ(x.evaluated, y.evaluated);
    ASSERT_EQ(x.penetrations.size(), y.penetrations.size());
    for (std::size_t i = 0; i < x.penetrations.size(); ++i) {
      const PenetrationRow &r = x.penetrations[i], &s = y.penetrations[i];
      EXPECT_EQ(std::tie(r.secondary, r.main, r.depth, r.gap, r.normal),
                std::tie(s.secondary, s.main, s.depth, s.gap, s.normal));
    }
  }
  ASSERT_EQ(a.ties.size(), b.ties.size());
  for (std::size_t t = 0; t < a.ties.size(); ++t) {
    ASSERT_EQ(a.ties[t].nodes.size(), b.ties[t].nodes.size());
    for (std::size_t i = 0; i < a.ties[t].nodes.size(); ++i)
      EXPECT_EQ(a.ties[t].nodes[i].tied, b.ties[t].nodes[i].tied);
  }
}

/// Moves some nodes, or all, or none, time after time.
void follow(const SmallDeck& d) {
  const Built b(d);
  MoveNodesOptions options;
  Followed f(context_of(b), options);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> by(-0.15, 0.15);
  std::set<double> depths;  // of all rows together
  for (const std::size_t some : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{0},
                                 std::size_t{5}, f.nodes(), std::size_t{1}}) {
    for (std::size_t k = 0; k < some; ++k)
      f.move(static_cast<NodeIndex>(some == f.nodes() ? k : random() % f.nodes()),
             {by(random), by(random), by(random)});
    const Scene& now = f.now();
    expect_same(now, f.anew());
    double depth = 0;
    for (const Contact& c : now.contacts)
      for (const PenetrationRow& row : c.penetrations) depth += row.depth;
    depths.insert(depth);
  }
  EXPECT_GT(depths.size(), 2U) << "the moves change nothing";
}

TEST(MovableDeck, FollowsItsNodesAsIfFormedAnew) {
  for (const char* card :
       {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0", "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=1 Gapmin=0.5 Inacti=6",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=3 Gapmin=0.7",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Irem_gap=2",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Fpenmax=0.6",
        "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=1.0",
        "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Igap=1 Gapmin=0.5",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2", "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0\n"
        "@/INTER/TYPE19/2 surf_IDs=1 surf_IDm=2 Igap=3\n"
        "@/INTER/TYPE2/3 grnd_IDs=1 surf_IDm=1 dsearch=0.7"}) {
    SCOPED_TRACE(card);
    follow(two_plates(3, 0.6, card));
  }
}

TEST(MovableDeck, FollowsSolidsToo) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.8",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=0.8"}) {
    SCOPED_TRACE(card);
    follow(two_blocks(2, 0.4, card));
  }
}

}  // namespace
}  // namespace deck::test
