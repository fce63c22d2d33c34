// Values of which the solver speaks: every limit of the schemas fires on its values, names its
// message, and is silent on the others.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck {
namespace {

using test::lint_example;
using test::Linted;

int message_of(const Linted& run, RuleId rule) {
  const Diagnostic* d = run.find(rule);
  return d != nullptr && d->reference ? d->reference->number : 0;
}

std::string text_of(const Linted& run, RuleId rule) {
  const Diagnostic* d = run.find(rule);
  return d != nullptr ? d->message : run.list();
}

std::string reals(std::initializer_list<const char*> cells) {
  std::string out;
  for (const char* cell : cells) out += std::string(20 - std::string(cell).size(), ' ') + cell;
  return out + "\n";
}

std::string ids(std::initializer_list<const char*> cells) {
  std::string out;
  for (const char* cell : cells) out += std::string(10 - std::string(cell).size(), ' ') + cell;
  return out + "\n";
}

TEST(Limit, NamesTheCellItsValueWhatIsLegalAndTheMessage) {
  const Linted bad = lint_example("/PROP/TRUSS/9\nrod\n" + reals({"-4.0"}));
  EXPECT_EQ(text_of(bad, RuleId::DK640), "Area of /PROP/TRUSS 9 is -4.0; legal: above 0");
  EXPECT_EQ(message_of(bad, RuleId::DK640), 497);
  EXPECT_FALSE(bad.fires(RuleId::DK096)) << "said twice: " << bad.list();
  EXPECT_TRUE(lint_example("/PROP/TRUSS/9\nrod\n" + reals({"0.0"})).fires(RuleId::DK640));
  EXPECT_FALSE(lint_example("/PROP/TRUSS/9\nrod\n" + reals({"4.0"})).fires(RuleId::DK640));
}

TEST(Limit, ALineThatIsNotThereIsZero) {
  const std::string law = "/MAT/FABRI/9\nfabric\n" + reals({"1e-9"}) + reals({"1.0", "1.0", "0.3"});
  const Linted cut = lint_example(law);
  EXPECT_EQ(message_of(cut, RuleId::DK640), 306) << cut.list();
  EXPECT_EQ(cut.count(RuleId::DK640), 3u) << "G12, G23, G31";
  EXPECT_FALSE(lint_example(law + reals({"1.0", "1.0", "1.0"})).fires(RuleId::DK640));
}

TEST(Limit, ABeamNeedsItsAreaAndThreeMomentsOfInertia) {
  const Linted bad = lint_example("/PROP/BEAM/9\nbeam\n" + ids({"0", "0"}) + reals({"0.0", "0.0"}) +
                                  reals({"4.0", "2.0", "0.0", "4.0"}));
  EXPECT_EQ(bad.count(RuleId::DK640), 1u) << bad.list();
  EXPECT_EQ(message_of(bad, RuleId::DK640), 316);
}

TEST(Limit, EachRowIsTested) {
  const auto sandwich = [](const char* second) {
    return "/MAT/COMPSH/9\nply\n" + reals({"1e-9"}) + reals({"1.0", "1.0", "0.3"}) +
           "/PROP/SH_SANDW/9\nstack\n" + ids({"24"}) + reals({"0.0"}) +
           ids({"2", "0"}).substr(0, 20) + reals({"1.0"}) + reals({"1.0", "0.0", "0.0"}) +
           reals({"0.0", "0.5", "0.0"}).substr(0, 60) + ids({"9"}) +
           reals({"0.0", "0.5", "0.0"}).substr(0, 60) + ids({second});
  };
  const Linted bad = lint_example(sandwich("0"));
  EXPECT_EQ(bad.count(RuleId::DK640), 1u) << bad.list();
  EXPECT_EQ(message_of(bad, RuleId::DK640), 1083);
  EXPECT_FALSE(lint_example(sandwich("9")).fires(RuleId::DK640))
      << lint_example(sandwich("9")).list();
}

TEST(Limit, ASumIsOneValue) {
  const auto foam = [](const char* a, const char* b) {
    return "/MAT/VISC_HYP/9\nfoam\n" + reals({"1e-9"}) + reals({"0.0"}).substr(0, 20) +
           ids({"1", "2"}) + reals({"1.0"}) + reals({"2.0"}) + reals({a, b}) +
           reals({"1.0", "1.0"});
  };
  EXPECT_EQ(message_of(lint_example(foam("0.6", "0.6")), RuleId::DK640), 560)
      << lint_example(foam("0.6", "0.6")).list();
  EXPECT_EQ(message_of(lint_example(foam("-0.1", "0.6")), RuleId::DK640), 2084);
  EXPECT_FALSE(lint_example(foam("0.4", "0.6")).fires(RuleId::DK640));
}

TEST(Limit, AnInjectorTakesGasesOnly) {
  const auto injector = [](const char* gas) {
    return "/MAT/GAS/PREDEF/8\nHydrogen\nH2\n/PROP/INJECT2/9\ninjector\n" + ids({"1", "0"}) +
           ids({"1", "1"}) + ids({gas, ""}) + "";
  };
  const Linted bad = lint_example(injector("1"));
  EXPECT_EQ(message_of(bad, RuleId::DK640), 857) << bad.list();
  EXPECT_FALSE(lint_example(injector("8")).fires(RuleId::DK640));
  EXPECT_NE(message_of(lint_example(injector("77")), RuleId::DK640), 857) << "there is no such one";
}

std::string johnson(const char* c, const char* rate, const char* smooth, const char* cut,
                    const char* nu = "0.3") {
  return "/MAT/PLAS_JOHNS/9\nsteel\n" + reals({"1e-9"}) + reals({"210.0", nu}) +
         reals({"0.3", "0.2", "1.0"}) + reals({c, rate}).substr(0, 40) +
         ids({"0", smooth}).substr(0, 20) + reals({cut});
}

TEST(Limit, AStrainRateWithoutFilterIsAWarning) {
  EXPECT_EQ(message_of(lint_example(johnson("0.05", "1e-6", "0", "0.0")), RuleId::DK641), 1220);
  for (const auto& [smooth, cut] : {std::pair{"1", "0.0"}, {"0", "10.0"}})
    EXPECT_FALSE(lint_example(johnson("0.05", "1e-6", smooth, cut)).fires(RuleId::DK641)) << smooth;
  EXPECT_FALSE(lint_example(johnson("0.0", "1e-6", "0", "0.0")).fires(RuleId::DK641));
  const Linted no_rate = lint_example(johnson("0.05", "0.0", "0", "0.0"));
  EXPECT_EQ(message_of(no_rate, RuleId::DK640), 298) << no_rate.list();
  EXPECT_FALSE(no_rate.fires(RuleId::DK641));
}

TEST(Limit, APoissonRatioOfMinusOneStopsJohnsonCookAndNotTheElasticLaw) {
  EXPECT_EQ(message_of(lint_example(johnson("0.0", "0.0", "0", "0.0", "-1.0")), RuleId::DK640),
            300);
  const Linted elastic =
      lint_example("/MAT/ELAST/9\nsteel\n" + reals({"1e-9"}) + reals({"210.0", "-1.0"}));
  EXPECT_FALSE(elastic.fires(RuleId::DK640)) << elastic.list();
}

TEST(Limit, TheFactorOfALinearSpringIsOne) {
  const auto spring = [](const char* a, const char* function) {
    return "/PROP/SPRING/9\nspring\n" + reals({"1.0"}) + reals({"100.0", "0.0", a}) +
           ids({function}) + reals({"0.0"});
  };
  EXPECT_EQ(message_of(lint_example(spring("2.0", "0")), RuleId::DK641), 663);
  for (const auto& [a, function] : {std::pair{"2.0", "1"}, {"1.0", "0"}, {"0.0", "0"}})
    EXPECT_FALSE(lint_example(spring(a, function)).fires(RuleId::DK641)) << a << function;
}

TEST(Limit, OfSomeBuildsOnlyIsInformation) {
  const Linted tab = lint_example("/FAIL/TAB/1\n" + ids({"1", "1", "0"}));
  ASSERT_TRUE(tab.fires(RuleId::DK642)) << tab.list();
  EXPECT_EQ(message_of(tab, RuleId::DK642), 3145);
  EXPECT_EQ(tab.find(RuleId::DK642)->severity, Severity::info);
}

}  // namespace
}  // namespace deck
