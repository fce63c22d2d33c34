// The rules about the first force evaluation on the examples of their pages; lint_rules.cases has
// more.
#include <gtest/gtest.h>

#include "lint/shared/geometry.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

TEST(CycleRules, FireOnTheirBadExampleIfAskedForAndNotOnTheGoodOne) {
  std::size_t rules = 0;
  for (const Rule& r : all_rules()) {
    if (id_number(r.id) / 100 != 4) continue;
    ++rules;
    EXPECT_TRUE(lint_geometry(r.bad).fires(r.id)) << id_text(r.id);
    EXPECT_FALSE(lint_example(r.bad).fires(r.id)) << id_text(r.id);
    const Linted good = lint_geometry(r.good);
    EXPECT_FALSE(good.fires(r.id)) << good.list();
    for (const Diagnostic& d : good.result.diagnostics)
      EXPECT_NE(d.severity, Severity::error) << id_text(d.rule) << " " << d.message;
  }
  EXPECT_GE(rules, 3u);
}

}  // namespace
}  // namespace deck::test
