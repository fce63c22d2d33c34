#include "convert_steps.hpp"

#include <CLI/CLI.hpp>

#include "deck/edit/flatten.hpp"
#include "deck/edit/unit_system.hpp"
#include "deck/edit/version.hpp"

namespace deck::cli {

void add_step_options(CLI::App& app, ConvertSteps& steps) {
  const std::string group = "Conversions, in this order";
  app.add_flag("--flatten", steps.flatten, "One file: every #include replaced by what it holds")
      ->group(group);
  app.add_option("--version", steps.version,
                 "Input version to write: 110, 120, 130, 140, 2017 ... 2026. Rewrites every block "
                 "whose columns differ")
      ->group(group)
      ->type_name("N");
  app.add_flag("--allow-loss", steps.allow_loss,
               "With --version: drop values that the other version has no cell for")
      ->group(group);
  app.add_option("--units", steps.units,
                 "Unit system to write, mass,length,time: kg,mm,ms or Mg,mm,s or numbers (factors "
                 "to kg, m, s)")
      ->group(group)
      ->type_name("SYSTEM");
  app.add_flag("--keep-working-units", steps.keep_working,
               "With --units: change the input units only; the solver computes as before")
      ->group(group);
  app.add_flag("--partial", steps.partial,
               "With --units: convert what is known although the deck holds values of unknown "
               "dimension, and list those as undecided")
      ->group(group);
}

Result<std::vector<ConvertStep>> make_steps(const ConvertSteps& steps) {
  std::vector<ConvertStep> all;
  if (steps.flatten)
    all.push_back({"--flatten", [](const EditContext& c) { return flatten(c); }, ""});
  if (steps.version != 0)
    all.push_back({"--version",
                   [&steps](const EditContext& c) {
                     return to_version(c, steps.version, {steps.allow_loss});
                   },
                   "--allow-loss drops what the version has no cell for"});
  if (!steps.units.empty()) {
    const auto target = parse_unit_system(steps.units);
    if (!target) return Error{Error::Code::config, "--units: " + target.error().message};
    all.push_back({"--units",
                   [&steps, system = *target](const EditContext& c) {
                     return to_units(c, system, {steps.partial, steps.keep_working});
                   },
                   "--partial converts what is known and lists the rest"});
  }
  if (steps.allow_loss && steps.version == 0)
    return Error{Error::Code::config, "--allow-loss goes with --version"};
  if ((steps.partial || steps.keep_working) && steps.units.empty())
    return Error{Error::Code::config, "--partial and --keep-working-units go with --units"};
  return all;
}

}  // namespace deck::cli
