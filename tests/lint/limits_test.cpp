// Values of which the solver speaks: every limit of the schemas fires on its values, names its
// message, and is silent on the others.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

using enum RuleId;

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
  ASSERT_TRUE(bad.fires(DK640)) << bad.list();
  EXPECT_EQ(bad.find(DK640)->message, "Area of /PROP/TRUSS 9 is -4.0; legal: above 0");
  EXPECT_FALSE(bad.fires(DK096)) << "said twice: " << bad.list();
  for (const auto& [area, said] : {std::pair("-4.0", 497), {"0.0", 497}, {"4.0", int{silent}}})
    expect_facts({{"/PROP/TRUSS/9\nrod\n" + reals({area}), DK640, said}});
}

TEST(Limit, ALineThatIsNotThereIsZero) {
  const std::string law = "/MAT/FABRI/9\nfabric\n" + reals({"1e-9"}) + reals({"1.0", "1.0", "0.3"});
  expect_facts({{law, DK640, 306}, {law + reals({"1.0", "1.0", "1.0"}), DK640, silent}});
  EXPECT_EQ(lint_example(law).count(DK640), 3u) << "G12, G23, G31";
}

TEST(Limit, ABeamNeedsItsAreaAndThreeMomentsOfInertia) {
  const std::string beam = "/PROP/BEAM/9\nbeam\n" + ids({"0", "0"}) + reals({"0.0", "0.0"}) +
                           reals({"4.0", "2.0", "0.0", "4.0"});
  expect_facts({{beam, DK640, 316}});
  EXPECT_EQ(lint_example(beam).count(DK640), 1u);
}

TEST(Limit, EachRowIsTested) {
  const auto sandwich = [](const char* second) {
    return "/MAT/COMPSH/9\nply\n" + reals({"1e-9"}) + reals({"1.0", "1.0", "0.3"}) +
           "/PROP/SH_SANDW/9\nstack\n" + ids({"24"}) + reals({"0.0"}) +
           ids({"2", "0"}).substr(0, 20) + reals({"1.0"}) + reals({"1.0", "0.0", "0.0"}) +
           reals({"0.0", "0.5", "0.0"}).substr(0, 60) + ids({"9"}) +
           reals({"0.0", "0.5", "0.0"}).substr(0, 60) + ids({second});
  };
  expect_facts({{sandwich("0"), DK640, 1083}, {sandwich("9"), DK640, silent}});
  EXPECT_EQ(lint_example(sandwich("0")).count(DK640), 1u);
}

TEST(Limit, ASumIsOneValue) {
  const auto foam = [](const char* a, const char* b) {
    return "/MAT/VISC_HYP/9\nfoam\n" + reals({"1e-9"}) + reals({"0.0"}).substr(0, 20) +
           ids({"1", "2"}) + reals({"1.0"}) + reals({"2.0"}) + reals({a, b}) +
           reals({"1.0", "1.0"});
  };
  expect_facts({{foam("0.6", "0.6"), DK640, 560},
                {foam("-0.1", "0.6"), DK640, 2084},
                {foam("0.4", "0.6"), DK640, silent}});
}

TEST(Limit, AnInjectorTakesGasesOnly) {
  const std::string injector = "/MAT/GAS/PREDEF/8\nHydrogen\nH2\n/PROP/INJECT2/9\ninjector\n" +
                               ids({"1", "0"}) + ids({"1", "1"});
  expect_facts({{injector + ids({"1", ""}), DK640, 857},
                {injector + ids({"8", ""}), DK640, silent},
                {injector + ids({"77", ""}), DK640, silent}});  // there is no such one
}

std::string johnson(const char* c, const char* rate, const char* smooth, const char* cut,
                    const char* nu = "0.3") {
  return "/MAT/PLAS_JOHNS/9\nsteel\n" + reals({"1e-9"}) + reals({"210.0", nu}) +
         reals({"0.3", "0.2", "1.0"}) + reals({c, rate}).substr(0, 40) +
         ids({"0", smooth}).substr(0, 20) + reals({cut});
}

TEST(Limit, OfAMaterialOrASpringIsAWarningWhereTheSolverOnlyWarns) {
  const auto spring = [](const char* a, const char* function) {
    return "/PROP/SPRING/9\nspring\n" + reals({"1.0"}) + reals({"100.0", "0.0", a}) +
           ids({function}) + reals({"0.0"});
  };
  expect_facts({
      // A strain rate without a filter.
      {johnson("0.05", "1e-6", "0", "0.0"), DK641, 1220},
      {johnson("0.05", "1e-6", "1", "0.0"), DK641, silent},
      {johnson("0.05", "1e-6", "0", "10.0"), DK641, silent},
      {johnson("0.0", "1e-6", "0", "0.0"), DK641, silent},
      {johnson("0.05", "0.0", "0", "0.0"), DK640, 298},
      {johnson("0.05", "0.0", "0", "0.0"), DK641, silent},
      // A Poisson ratio of -1 stops Johnson-Cook and not the elastic law.
      {johnson("0.0", "0.0", "0", "0.0", "-1.0"), DK640, 300},
      {"/MAT/ELAST/9\nsteel\n" + reals({"1e-9"}) + reals({"210.0", "-1.0"}), DK640, silent},
      // The factor of a linear spring is one.
      {spring("2.0", "0"), DK641, 663},
      {spring("2.0", "1"), DK641, silent},
      {spring("1.0", "0"), DK641, silent},
      {spring("0.0", "0"), DK641, silent},
  });
}

TEST(Limit, OfSomeBuildsOnlyIsInformation) {
  const Linted tab = lint_example("/FAIL/TAB/1\n" + ids({"1", "1", "0"}));
  expect_facts({{"/FAIL/TAB/1\n" + ids({"1", "1", "0"}), DK642, 3145}});
  EXPECT_EQ(tab.find(DK642)->severity, Severity::info);
}

}  // namespace
}  // namespace deck::test
