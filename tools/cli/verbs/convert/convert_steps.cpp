// Adds the options of the conversions and turns them into steps.
#include "verbs/convert/convert_run.hpp"

#include "deck/edit/convert.hpp"
#include "edit/shared/conversion.hpp"

namespace deck::cli {

void add_step_options(CommandLine& line, ConvertSteps& steps) {
  CommandLine group = line.group("Conversions, in this order");
  group
      .option("--extract-contacts", steps.extract,
              "A small deck of one file with these interfaces and everything they need")
      .comma_list()
      .value("ID[,ID...]");
  group.flag("--flatten", steps.flatten, "One file: every #include replaced by its content");
  group.flag("--expand-type19", steps.expand_type19,
             "Every TYPE19 as the TYPE7 and TYPE11 that the solver makes of it");
  group.flag(
      "--resolve-defaults", steps.resolve_defaults,
      "Write effective values onto the contact cards, so /DEFAULT/INTER is no longer needed");
  group
      .option("--version", steps.version,
              "Input version to write: 110, 120, 130, 140, 2017 ... 2026. Rewrites every block "
              "whose columns differ")
      .value("N");
  group.flag("--allow-loss", steps.allow_loss,
             "With --version: drop values without a cell in the other version. With "
             "--resolve-defaults: leave values without a cell to the default card. With --units: "
             "leave keywords of Engine files unchanged whose cells are not known, and accept other "
             "time steps of beams where the solver's own formula depends on the unit of length");
  group
      .option("--units", steps.units,
              "Unit system to write, mass,length,time: kg,mm,ms or Mg,mm,s or numbers (factors "
              "to kg, m, s)")
      .value("SYSTEM");
  group.flag("--keep-working-units", steps.keep_working,
             "With --units: change the input units only; the solver computes as before");
  group
      .option("--renumber", steps.renumber,
              "New ids: KIND+N and KIND-N shift them, KIND=N counts from N on; KIND is node, "
              "part, element, surf, all ... (repeatable)")
      .comma_list()
      .value("RULE");
  group.flag("--partial", steps.partial,
             "With --units or --renumber: convert the known values and list blocks that no schema "
             "describes as undecided");
}

Result<std::vector<ConvertStep>> make_steps(const ConvertSteps& steps) {
  std::vector<ConvertStep> all;
  if (!steps.extract.empty())
    all.push_back({"--extract-contacts",
                   [&steps](const LoadedDeck& c) { return extract_contacts(c, steps.extract); },
                   ""});
  if (steps.flatten)
    all.push_back({"--flatten", [](const LoadedDeck& c) { return flatten(c); }, ""});
  if (steps.expand_type19)
    all.push_back({"--expand-type19", [](const LoadedDeck& c) { return expand_type19(c); }, ""});
  if (steps.resolve_defaults)
    all.push_back(
        {"--resolve-defaults",
         [&steps](const LoadedDeck& c) { return resolve_defaults(c, {steps.allow_loss}); },
         "--allow-loss leaves these cells to the default card and writes the others"});
  if (steps.version != 0 && !is_target_version(steps.version))
    return Error{Error::Code::config,
                 "--version " + std::to_string(steps.version) +
                     ": not a version that can be written; 110 to 140 and 2017 to " +
                     std::to_string(newest_version) + " are"};
  if (steps.version != 0)
    all.push_back(
        {"--version",
         [&steps](const LoadedDeck& c) { return to_version(c, steps.version, {steps.allow_loss}); },
         "--allow-loss drops what the version has no cell for"});
  if (!steps.units.empty()) {
    const auto target = parse_unit_system(steps.units);
    if (!target) return Error{Error::Code::config, "--units: " + target.error().message};
    all.push_back(
        {"--units",
         [&steps, system = *target](const LoadedDeck& c) {
           return to_units(c, system, {steps.partial, steps.keep_working});
         },
         "--partial converts what is known and lists the rest",
         [&steps, system = *target](const Deck& deck, const EngineFiles& engine, Rewrite& out) {
           engine_to_units(deck, engine, system, {steps.partial, steps.keep_working},
                           steps.partial || steps.allow_loss, out);
         }});
  }
  if (!steps.renumber.empty()) {
    RenumberOptions renumbering;
    renumbering.partial = steps.partial;
    for (const std::string& text : steps.renumber) {
      auto rule = parse_renumber_rule(text);
      if (!rule) return Error{Error::Code::config, "--renumber: " + rule.error().message};
      renumbering.rules.push_back(std::move(*rule));
    }
    all.push_back({"--renumber",
                   [renumbering](const LoadedDeck& c) { return renumber(c, renumbering); },
                   "--partial renumbers what is known and lists the rest"});
  }
  if (steps.allow_loss && steps.version == 0 && !steps.resolve_defaults && steps.units.empty())
    return Error{Error::Code::config,
                 "--allow-loss goes with --version, --units or --resolve-defaults"};
  if (steps.keep_working && steps.units.empty())
    return Error{Error::Code::config, "--keep-working-units goes with --units"};
  if (steps.partial && steps.units.empty() && steps.renumber.empty())
    return Error{Error::Code::config, "--partial goes with --units or --renumber"};
  return all;
}

}  // namespace deck::cli
