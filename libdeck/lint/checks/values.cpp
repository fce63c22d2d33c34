// Ranges of numbers: signs from the schemas, and bounds that follow from what a value means.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

struct SignRule {
  std::string_view id;
  std::vector<std::string_view> fields;
};

const std::vector<SignRule>& sign_rules() {
  static const std::vector<SignRule> rules = {
      {"DK221", {"Gapmin", "Gap"}},
      {"DK222", {"Gapmax"}},
      {"DK223", {"Stfac"}},
      {"DK224", {"Fric", "Fric_pair", "Fric_dir2"}},
      {"DK225", {"VISs"}},
      {"DK226", {"VISF", "VISF_pair", "VISF_dir2"}},
      {"DK227", {"Bumult"}},
      {"DK228", {"Fscalegap", "Edge_scale_gap"}},
      {"DK229", {"Fpenmax"}},
      {"DK230", {"Stmin", "Stmax"}},
      {"DK231", {"%mesh_size"}},
      {"DK232", {"dtmin"}},
      {"DK233", {"Tstart", "Tstop"}},
      {"DK235", {"Kthe", "Rthe", "Frad", "Drad"}},
      {"DK236", {"NRadm", "Padm", "Angladm"}},
  };
  return rules;
}

double number_of(const Cell& cell) {
  return cell.field->type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
}

void check_sign_in(const Rule& rule, const std::vector<std::string_view>& fields,
                   const DecodedBlock& block, Reporter& r) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      if (cell.blank() || !(number_of(cell) < 0)) continue;
      if (std::find(fields.begin(), fields.end(), cell.field->name) == fields.end()) continue;
      r.report(rule, *block.block, cell.span,
               fmt::format("{} of {} {} is negative: {}", cell.field->name,
                           block.block->schema->keyword, block.block->id.value, cell.text));
    }
}

void check_sign(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const SignRule& s : sign_rules()) {
    if (s.id != rule.id) continue;
    for (const ContactCard& card : c.contacts) check_sign_in(rule, s.fields, card.decoded, r);
    for (const DecodedBlock& block : c.frictions) check_sign_in(rule, s.fields, block, r);
  }
}

void check_heat_share(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    for (const std::string_view name : {"Fheats", "Fheatm"})
      if (const double v = card.input(name); v < 0 || v > 1)
        report_at(r, rule, card, name,
                  fmt::format("{} of {} is {}; it is a share between 0 and 1", name, name_of(card),
                              number_text(v)));
  });
}

/// Fields that are shares or ratios: above 1 they mean something else than people think.
void check_above_one(const LintContext& c, const Rule& rule, Reporter& r, std::string_view field,
                     std::string_view meaning) {
  for (const ContactCard& card : c.contacts)
    if (const double v = card.input(field); v > 1)
      report_at(r, rule, card, field,
                fmt::format("{} of {} is {}{}", field, name_of(card), number_text(v), meaning));
}

void check_fpenmax(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "Fpenmax", "; a penetration never exceeds the gap");
}

void check_viss(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "VISs", " times the critical damping");
}

void check_fric(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "Fric", ", a friction coefficient above 1");
}

constexpr std::string_view sign_problem = "A quantity that cannot be negative is.";

void add_sign(std::vector<Rule>& out, std::string_view id, std::string_view title,
              std::string_view why, std::string_view solver, std::string_view bad,
              std::string_view good) {
  out.push_back({.id = id,
                 .title = title,
                 .severity = Severity::warning,
                 .problem = sign_problem,
                 .why = why,
                 .solver = solver,
                 .fix = "write a positive value, or 0 for the default",
                 .ignore = "Never.",
                 .bad = bad,
                 .good = good,
                 .check = check_sign});
}

constexpr std::string_view as_it_is = "it does not check the sign and computes with the value";

void add_signs(std::vector<Rule>& out) {
  add_sign(out, "DK221", "negative gap",
           "A negative gap is not a gap; the default is used instead.",
           "it computes a default gap from thickness and mesh size, as for 0",
           "@/INTER/TYPE7/1 Gapmin=-0.5\n", "@/INTER/TYPE7/1 Gapmin=0.5\n");
  add_sign(out, "DK222", "negative Gapmax",
           "The gap is min(Gapmax, ...); a negative cap leaves only Gapmin.", as_it_is,
           "@/INTER/TYPE7/1 Igap=2 Gapmax=-1.0\n", "@/INTER/TYPE7/1 Igap=2 Gapmax=1.0\n");
  add_sign(out, "DK223", "negative Stfac",
           "The contact force would pull instead of push, or the solver takes the sign for a code.",
           as_it_is, "@/INTER/TYPE7/1 Stfac=-1.0\n", "@/INTER/TYPE7/1 Stfac=1.0\n");
  add_sign(out, "DK224", "negative friction coefficient",
           "Friction would drive the motion and create energy.", as_it_is,
           "@/INTER/TYPE7/1 Fric=-0.2\n", "@/INTER/TYPE7/1 Fric=0.2\n");
  add_sign(out, "DK225", "negative VISs", "Negative damping creates energy at every impact.",
           as_it_is, "@/INTER/TYPE7/1 VISs=-0.05\n", "@/INTER/TYPE7/1 VISs=0.05\n");
  add_sign(out, "DK226", "negative VISF", "Negative damping creates energy while sliding.",
           as_it_is, "@/INTER/TYPE7/1 Fric=0.2 VISF=-1.0\n", "@/INTER/TYPE7/1 Fric=0.2 VISF=1.0\n");
  add_sign(out, "DK227", "negative Bumult",
           "The margin of the contact search is Bumult times a length; a negative one loses "
           "contacts.",
           as_it_is, "@/INTER/TYPE7/1 Bumult=-0.2\n", "@/INTER/TYPE7/1 Bumult=0.2\n");
  add_sign(out, "DK228", "negative gap scale", "The variable gap becomes negative: no contact.",
           as_it_is, "@/INTER/TYPE7/1 Igap=2 Fscalegap=-0.8\n",
           "@/INTER/TYPE7/1 Igap=2 Fscalegap=0.8\n");
  add_sign(out, "DK229", "negative Fpenmax",
           "Every node would count as too deep: penetration > Fpenmax * gap.", as_it_is,
           "@/INTER/TYPE7/1 Fpenmax=-0.5\n", "@/INTER/TYPE7/1 Fpenmax=0.5\n");
  add_sign(out, "DK230", "negative stiffness bound",
           "K = max(Stmin, min(Stmax, K_n)): a negative Stmax makes every stiffness negative.",
           as_it_is, "@/INTER/TYPE7/1 Istf=4 Stmax=-10.0\n", "@/INTER/TYPE7/1 Istf=4 Stmax=10.0\n");
  add_sign(out, "DK231", "negative %mesh_size",
           "The gap is limited by %mesh_size times a length; a negative limit leaves only Gapmin.",
           as_it_is, "@/INTER/TYPE7/1 Igap=3 %mesh_size=-0.4\n",
           "@/INTER/TYPE7/1 Igap=3 %mesh_size=0.4\n");
  add_sign(out, "DK232", "negative dtmin", "A time step is never below a negative limit.", as_it_is,
           "@/INTER/TYPE7/1 dtmin=-1.e-4\n", "@/INTER/TYPE7/1 dtmin=1.e-4\n");
  add_sign(out, "DK233", "negative time",
           "The run starts at 0; a contact that stops before never acts.", as_it_is,
           "@/INTER/TYPE7/1 Tstop=-1.0\n", "@/INTER/TYPE7/1 Tstop=1.0\n");
  add_sign(out, "DK235", "negative thermal coefficient", "Heat would flow from cold to warm.",
           as_it_is, "@/INTER/TYPE7/1 Ithe=1 Kthe=-1.0\n", "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n");
  add_sign(out, "DK236", "negative adaptive meshing criterion",
           "The criterion is then always or never met.", as_it_is,
           "@/INTER/TYPE7/1 Iadm=2 NRadm=3 Padm=-1.0\n",
           "@/INTER/TYPE7/1 Iadm=2 NRadm=3 Padm=1.0\n");
}

}  // namespace

void add_value_rules(std::vector<Rule>& out) {
  add_signs(out);
  out.push_back({.id = "DK234",
                 .title = "share of friction heat outside 0 to 1",
                 .severity = Severity::warning,
                 .problem = "Fheats or Fheatm is below 0 or above 1.",
                 .why = "They say which part of the friction energy becomes heat on each side; "
                        "more than all of it creates energy.",
                 .solver = "it checks only the sum of both",
                 .message = 1064,
                 .fix = "write shares that add up to at most 1",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Fheats=1.5\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Fheats=0.5\n",
                 .check = check_heat_share});
  out.push_back({.id = "DK237",
                 .title = "Fpenmax above 1 does nothing",
                 .severity = Severity::warning,
                 .problem = "Fpenmax is larger than 1.",
                 .why = "Nodes are switched off where penetration > Fpenmax * gap, and a "
                        "penetration is at most the gap.",
                 .solver = "the test never succeeds",
                 .fix = "write a share below 1, or 0 for no test",
                 .ignore = "When the field is kept to switch the test off.",
                 .bad = "@/INTER/TYPE7/1 Fpenmax=50.0\n",
                 .good = "@/INTER/TYPE7/1 Fpenmax=0.5\n",
                 .check = check_fpenmax});
  out.push_back({.id = "DK238",
                 .title = "VISs above critical damping",
                 .severity = Severity::warning,
                 .problem = "VISs is larger than 1.",
                 .why = "It is a share of the critical damping; usual is 0.05. Above 1 the damping "
                        "force exceeds the elastic one and lowers the time step.",
                 .solver = "it computes with the value",
                 .fix = "write a share, 0.05 is usual",
                 .ignore = "When the damping is tuned on purpose.",
                 .bad = "@/INTER/TYPE7/1 VISs=5.0\n",
                 .good = "@/INTER/TYPE7/1 VISs=0.05\n",
                 .check = check_viss});
  out.push_back({.id = "DK239",
                 .title = "friction coefficient above 1",
                 .severity = Severity::warning,
                 .problem = "Fric is larger than 1.",
                 .why =
                     "Metals and plastics stay below 1; a value like 2 or 20 is often a per cent "
                     "or a slip of columns.",
                 .solver = "it computes with the value",
                 .fix = "check the value",
                 .ignore = "Rubber, or friction that stands for interlocking.",
                 .bad = "@/INTER/TYPE7/1 Fric=20.0\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.2\n",
                 .check = check_fric});
}

}  // namespace deck::detail
