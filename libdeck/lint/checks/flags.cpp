// One rule per flag: the legal values come from the schemas, so a rule holds for every keyword and
// version that has the flag. Values that deserve a message of their own have a rule of their own.
#include <algorithm>
#include <cmath>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

struct FlagRule {
  std::string_view id, field;
};

constexpr FlagRule flag_rules[] = {
    {"DK201", "Istf"},   {"DK202", "Igap"},  {"DK203", "Ibag"},     {"DK204", "Idel"},
    {"DK205", "Icurv"},  {"DK206", "Iadm"},  {"DK207", "Inacti"},   {"DK208", "Ifric"},
    {"DK209", "Ifiltr"}, {"DK210", "Iform"}, {"DK211", "Irem_gap"}, {"DK212", "Irem_i2"},
    {"DK213", "Ithe"},   {"DK214", "ITIED"}, {"DK215", "Iedge"},    {"DK216", "Ithe_form"},
    {"DK218", "Idir"},
};

std::string list_of(const std::vector<std::int64_t>& values) {
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i)
    out += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + std::to_string(values[i]);
  return out;
}

/// Values with a rule of their own.
bool special(std::string_view keyword, std::string_view field, std::int64_t value) {
  if (keyword == "/INTER/TYPE19")
    return (field == "Istf" && value == 6) || (field == "Idel" && value == 3) || field == "Iedge";
  if (keyword == "/INTER/TYPE11") return field == "Igap" && value == 2;
  return keyword == "/INTER/TYPE10" && field == "Inacti" && value == 5;
}

void check_block(const Rule& rule, std::string_view field, const DecodedBlock& block, Reporter& r) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      if (f.name != field || f.values.empty() || cell.blank() ||
          cell.status == NumberStatus::not_a_number)
        continue;
      if (std::find(f.values.begin(), f.values.end(), cell.integer) != f.values.end()) continue;
      if (special(block.block->schema->keyword, field, cell.integer)) continue;
      Diagnostic* d = r.report(rule, *block.block, cell.span,
                               fmt::format("{} of {} {} is {}; legal values are {}", f.name,
                                           block.block->schema->keyword, block.block->id.value,
                                           cell.integer, list_of(f.values)));
      if (d != nullptr && !f.doc.empty()) d->help += " (" + f.doc + ")";
    }
}

void check_flag(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const FlagRule& f : flag_rules) {
    if (f.id != rule.id) continue;
    for (const ContactCard& card : c.contacts) check_block(rule, f.field, card.decoded, r);
    for (const DecodedBlock& block : c.frictions) check_block(rule, f.field, block, r);
    // Iedge is read from /DEFAULT only; the other flags of a default have DK505.
    if (f.field == "Iedge")
      for (const DecodedBlock& block : c.defaults) check_block(rule, f.field, block, r);
  }
}

void check_ibc(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const std::string_view name : {"IBCX", "IBCY", "IBCZ"}) {
      const Cell* cell = card.decoded.find(name);
      if (cell == nullptr || cell->blank() || cell->text == "0" || cell->text == "1") continue;
      Diagnostic* d = r.report(rule, *card.block, cell->span,
                               fmt::format("column {} ({}) of {} holds '{}'; only 1 has an effect",
                                           cell->field->first, name, name_of(card), cell->text));
      if (d != nullptr) d->fix = Fix{"write 0", true, {{cell->span, "0"}}};
    }
}

constexpr std::string_view range_problem =
    "The flag has a value that the reference solver does not know for this interface.";
constexpr std::string_view range_why =
    "A flag without meaning selects whatever branch is left over, or a default; neither is what "
    "the card says.";
constexpr std::string_view range_solver =
    "it goes on with the number as it stands: it neither checks the flag nor says a word";

void add_flag(std::vector<Rule>& out, std::string_view id, std::string_view title,
              std::string_view bad, std::string_view good, std::string_view solver = range_solver) {
  out.push_back({.id = id,
                 .title = title,
                 .severity = Severity::warning,
                 .problem = range_problem,
                 .why = range_why,
                 .solver = solver,
                 .fix = "write one of the legal values",
                 .ignore = "A newer solver knows the value.",
                 .bad = bad,
                 .good = good,
                 .check = check_flag});
}

}  // namespace

void add_flag_rules(std::vector<Rule>& out) {
  add_flag(out, "DK201", "Istf: unknown stiffness definition", "@/INTER/TYPE7/1 Istf=7\n",
           "@/INTER/TYPE7/1 Istf=4\n");
  add_flag(out, "DK202", "Igap: unknown gap definition", "@/INTER/TYPE7/1 Igap=9\n",
           "@/INTER/TYPE7/1 Igap=3\n",
           "it goes on: every value above 1 gives a variable gap with Fscalegap and Gapmax, every "
           "negative one a constant gap");
  add_flag(out, "DK203", "Ibag: unknown airbag closure flag", "@/INTER/TYPE7/1 Ibag=4\n",
           "@/INTER/TYPE7/1 Ibag=1000\n",
           "it goes on: without airbag it warns (614) and takes 0, with one it keeps the number");
  add_flag(out, "DK204", "Idel: unknown deletion flag", "@/INTER/TYPE7/1 Idel=5\n",
           "@/INTER/TYPE7/1 Idel=-2\n",
           "it goes on: the sign apart, values beyond 2 count as 0, no deletion");
  add_flag(out, "DK205", "Icurv: unknown curvature flag", "@/INTER/TYPE7/1 Icurv=5\n",
           "@/INTER/TYPE7/1 Icurv=3\n");
  add_flag(out, "DK206", "Iadm: unknown adaptive meshing flag", "@/INTER/TYPE7/1 Iadm=3\n",
           "@/INTER/TYPE7/1 Iadm=1\n",
           "it goes on: without adaptive meshing it warns (647) and takes 0, with it it keeps the "
           "number");
  add_flag(out, "DK207", "Inacti: unknown treatment of initial penetrations",
           "@/INTER/TYPE7/1 Inacti=8\n", "@/INTER/TYPE7/1 Inacti=6\n");
  add_flag(out, "DK208", "Ifric: unknown friction law", "@/INTER/TYPE7/1 Ifric=6 C1=0.1 C6=0.1\n",
           "@/INTER/TYPE7/1 Ifric=1 C1=0.1\n");
  add_flag(out, "DK209", "Ifiltr: unknown friction filter",
           "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=5 Xfreq=0.5\n",
           "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=1 Xfreq=0.5\n");
  add_flag(out, "DK210", "Iform: unknown friction formulation", "@/INTER/TYPE7/1 Iform=6\n",
           "@/INTER/TYPE7/1 Iform=2\n");
  add_flag(out, "DK211", "Irem_gap: unknown removal flag", "@/INTER/TYPE7/1 Irem_gap=4\n",
           "@/INTER/TYPE7/1 Irem_gap=2\n");
  add_flag(out, "DK212", "Irem_i2: unknown treatment of tied nodes", "@/INTER/TYPE7/1 Irem_i2=5\n",
           "@/INTER/TYPE7/1 Irem_i2=3\n");
  add_flag(out, "DK213", "Ithe: unknown heat exchange flag", "@/INTER/TYPE7/1 Ithe=3\n",
           "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n",
           "it goes on: any value above 0 asks for heat exchange (warning 702 without thermal "
           "material), but its lines are read for Ithe = 1 only");
  add_flag(out, "DK214", "ITIED: unknown tie flag", "@/INTER/TYPE10/1 ITIED=7\n",
           "@/INTER/TYPE10/1 ITIED=1\n");
  add_flag(out, "DK215", "Iedge: unknown edge selection",
           "@/DEFAULT/INTER/TYPE19 Iedge=7\n@/INTER/TYPE19/1\n",
           "@/DEFAULT/INTER/TYPE19 Iedge=1\n@/INTER/TYPE19/1\n");
  out.back().problem =
      "Iedge of /DEFAULT/INTER/TYPE19, the only place from where it is read, is "
      "neither 1 (free edges) nor 2 (all edges).";
  add_flag(out, "DK216", "Ithe_form: unknown heat exchange form",
           "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Ithe_form=3\n",
           "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Ithe_form=1\n");
  out.push_back({.id = "DK217",
                 .title = "IBC: digit that has no effect",
                 .severity = Severity::warning,
                 .problem = "Columns 8, 9 or 10 of the line with Inacti hold something else than 0 "
                            "or 1.",
                 .why = "Each column releases the boundary condition in X, Y or Z if it is 1, and "
                        "does nothing otherwise.",
                 .solver = "it treats every other character like 0",
                 .fix = "write 1 to release the direction, 0 otherwise",
                 .ignore = "Never.",
                 .fixable = Fixable::safe,
                 .bad = "@/INTER/TYPE7/1 IBCX=0 IBCY=2 IBCZ=0\n",
                 .good = "@/INTER/TYPE7/1 IBCX=0 IBCY=1 IBCZ=0\n",
                 .check = check_ibc});
  add_flag(out, "DK218", "Idir: unknown direction flag of a friction pair",
           "@/FRICTION/1 Fric=0.1 grpart_ID1=0 part_ID1=1 part_ID2=2 Idir=4 C1_pair=0.0 "
           "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n",
           "@/FRICTION/1 Fric=0.1 grpart_ID1=0 part_ID1=1 part_ID2=2 Idir=0 C1_pair=0.0 "
           "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n");
}

}  // namespace deck::detail
