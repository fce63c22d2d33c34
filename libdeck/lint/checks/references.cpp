// What interfaces and frictions refer to: groups, surfaces, lines, sensors, functions, parts.
// The functions that fill the table are as long as their pages.
#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"
#include "lint/targets.hpp"

namespace deck::detail {
namespace {

struct Side {
  std::string_view field, kind;
  bool secondary;
};

std::vector<Side> sides_of(const ContactCard& card) {
  switch (card.type) {
    case 7:
      // Ists turns the node group into a surface; that is not evaluated.
      if (card.given("Ists")) return {{"surf_IDm", "surf", false}};
      return {{"grnd_IDs", "grnod", true}, {"surf_IDm", "surf", false}};
    case 10:
      return {{"grnd_IDs", "grnod", true}, {"surf_IDm", "surf", false}};
    case 11:
      return {{"line_IDs", "line", true}, {"line_IDm", "line", false}};
    case 19:
      return {{"surf_IDs", "surf", true}, {"surf_IDm", "surf", false}};
    default:
      break;
  }
  const std::string_view keyword = card.block->schema->keyword;
  if (keyword.ends_with("/TYPE7") || keyword == "/INTER/TYPE5")
    return {{"grnd_IDs", "grnod", true}, {"surf_IDm", "surf", false}};
  if (keyword == "/INTER/TYPE2") {
    // From 2025 on a surface may give the secondary nodes.
    if (card.given("surf_IDs")) return {{"surf_IDs", "surf", true}, {"surf_IDm", "surf", false}};
    return {{"grnd_IDs", "grnod", true}, {"surf_IDm", "surf", false}};
  }
  if (keyword == "/INTER/TYPE3") return {{"surf_ID1", "surf", true}, {"surf_ID2", "surf", false}};
  return {};
}

/// Id of a side as the model knows it; 0: not given.
std::int64_t side_id(const LintContext& c, const ContactCard& card, const Side& side) {
  const auto id = static_cast<std::int64_t>(card.input(side.field));
  // Typed interfaces have the submodel offset in already.
  return card.inter != nullptr ? id : c.resolved(*card.block, side.kind, id);
}

constexpr std::array<std::string_view, 3> side_kinds = {"grnod", "surf", "line"};

/// Another kind of entity with that id; empty: none.
std::string_view other_kind(const LintContext& c, std::string_view kind, std::int64_t id) {
  for (const std::string_view k : side_kinds)
    if (k != kind && c.selections->is_plain(k, id)) return k;
  return {};
}

template <class F>
void each_side(const LintContext& c, F&& f) {
  if (c.selections == nullptr) return;
  for (const ContactCard& card : c.contacts)
    for (const Side& side : sides_of(card))
      if (const std::int64_t id = side_id(c, card, side); id != 0) f(card, side, id);
}

void check_missing_entity(const LintContext& c, const Rule& rule, Reporter& r) {
  each_side(c, [&](const ContactCard& card, const Side& side, std::int64_t id) {
    if (id < 0 || selection_exists(c, side.kind, id) || !other_kind(c, side.kind, id).empty())
      return;
    std::string message = fmt::format("{} of {} is {}, and there is no {} or /SET of that id",
                                      side.field, name_of(card), id, kind_name(side.kind));
    const std::int64_t offset = c.deck.offset_of(*card.block, side.kind);
    if (offset != 0 && selection_exists(c, side.kind, id - offset))
      message +=
          fmt::format("; {} exists outside the submodel, whose offset is {}", id - offset, offset);
    report_at(r, rule, card, side.field, std::move(message));
  });
}

void check_kind(const LintContext& c, const Rule& rule, Reporter& r) {
  each_side(c, [&](const ContactCard& card, const Side& side, std::int64_t id) {
    if (id < 0 || selection_exists(c, side.kind, id)) return;
    const std::string_view other = other_kind(c, side.kind, id);
    if (other.empty()) return;
    Diagnostic* d = report_at(
        r, rule, card, side.field,
        fmt::format("{} of {} is {}: there is a {} of that id, but a {} is expected here",
                    side.field, name_of(card), id, kind_name(other), kind_name(side.kind)));
    if (d == nullptr) return;
    if (const auto at = c.selections->where(other, id))
      d->notes.emplace_back(
          *at, std::string(kind_name(other)) + " " + std::to_string(id) + " is defined here");
    if (side.kind == "grnod" && other == "surf")
      d->help = fmt::format("define a /GRNOD/SURF of surface {} and refer to that", id);
  });
}

void note_definition(const LintContext& c, Diagnostic* d, const Side& side, std::int64_t id) {
  if (d == nullptr) return;
  const bool plain = c.selections->is_plain(side.kind, id);
  if (const auto at = c.selections->where(plain ? side.kind : "set", id))
    d->notes.emplace_back(*at, "it is defined here");
}

void check_empty(const LintContext& c, const Rule& rule, Reporter& r) {
  const bool secondary = rule.id == "DK172";
  each_side(c, [&](const ContactCard& card, const Side& side, std::int64_t id) {
    if (side.secondary != secondary || id < 0 || !selection_exists(c, side.kind, id)) return;
    if (selection_size(c, side.kind, id) != 0) return;
    Diagnostic* d = report_at(
        r, rule, card, side.field,
        fmt::format("the {} side of {}, {} {}, is empty", secondary ? "secondary" : "main",
                    name_of(card), kind_name(side.kind), id));
    note_definition(c, d, side, id);
    if (d == nullptr) return;
    if (secondary && side.kind != "grnod") {
      d->severity = Severity::error;
      d->reference = ReferenceMessage{118, Severity::error};
    }
    if (!secondary && (card.type == 7 || card.type == 19))
      d->reference = ReferenceMessage{3160, Severity::error};
  });
}

void check_analytical(const LintContext& c, const Rule& rule, Reporter& r) {
  each_side(c, [&](const ContactCard& card, const Side& side, std::int64_t id) {
    if (side.kind != "surf") return;
    const Surface* s = c.selections->surface(id);
    if (s == nullptr || !s->analytical) return;
    note_definition(c,
                    report_at(r, rule, card, side.field,
                              fmt::format("{} of {}: surface {} is analytical and has no segments",
                                          side.field, name_of(card), id)),
                    side, id);
  });
}

/// Sides, sensors and nodes of that id are looked for and not found; a function or friction is
/// looked for only if its id is positive.
void negative_reference(Reporter& r, const Rule& rule, const ContactCard& card,
                        const FieldView& f) {
  Diagnostic* d = report_at(r, rule, card, f.name,
                            fmt::format("{} of {} is negative: {}", f.name, name_of(card), f.text));
  if (d == nullptr) return;
  if (f.field->ref == "sensor") d->reference = ReferenceMessage{1010, Severity::error};
  if (f.field->ref == "node") d->reference = ReferenceMessage{78, Severity::error};
  if (f.field->ref != "funct" && f.field->ref != "friction") return;
  d->severity = Severity::warning;
  d->reference.reset();
  d->reference_behaviour = "it goes on without a word, as if no id were given";
}

void check_negative(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const FieldView& f : card.fields)
      if (f.field != nullptr && f.field->type == FieldType::id && f.input < 0)
        negative_reference(r, rule, card, f);
}

void check_ambiguous(const LintContext& c, const Rule& rule, Reporter& r) {
  each_side(c, [&](const ContactCard& card, const Side& side, std::int64_t id) {
    if (!c.selections->is_plain(side.kind, id)) return;
    const auto set = c.selections->where("set", id);
    if (!set) return;
    Diagnostic* d = report_at(r, rule, card, side.field,
                              fmt::format("{} of {}: {} {} and /SET {} both exist", side.field,
                                          name_of(card), kind_name(side.kind), id, id));
    if (d != nullptr) d->notes.emplace_back(*set, "the set that is not used");
  });
}

/// References by id to one definition elsewhere.
void check_target(const LintContext& c, const Rule& rule, Reporter& r,
                  std::initializer_list<std::string_view> fields, std::string_view kind,
                  std::string_view what) {
  const auto known = c.defined.find(kind);
  for (const ContactCard& card : c.contacts)
    for (const std::string_view field : fields) {
      const FieldView* f = card.find(field);
      if (f == nullptr || f->field == nullptr || !card.given(field) || f->input < 0) continue;
      const auto id = static_cast<std::int64_t>(f->input);
      if (known != c.defined.end() && known->second.count(id) > 0) continue;
      report_at(r, rule, card, field,
                fmt::format("{} of {} is {}, and there is no {} of that id", field, name_of(card),
                            id, what));
    }
}

void check_sensor(const LintContext& c, const Rule& rule, Reporter& r) {
  check_target(c, rule, r, {"sens_ID"}, "sensor", "/SENSOR");
}
void check_function(const LintContext& c, const Rule& rule, Reporter& r) {
  check_target(c, rule, r, {"fct_IDF", "fct_IDK"}, "funct", "/FUNCT");
}
void check_friction_id(const LintContext& c, const Rule& rule, Reporter& r) {
  check_target(c, rule, r, {"fric_ID"}, "friction", "/FRICTION");
}

void check_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr) return;
  each(c, rule, [&](const ContactCard& card) {
    for (const std::string_view field : {"node_ID1", "node_ID2"}) {
      const auto id = static_cast<std::int64_t>(card.input(field));
      if (id <= 0 || c.model->nodes.map.find(id) != no_index) continue;
      report_at(
          r, rule, card, field,
          fmt::format("{} of {} is {}, and there is no node of that id", field, name_of(card), id));
    }
  });
}

void check_duplicates(const LintContext& c, const Rule& rule, Reporter& r) {
  const auto all = c.defined.find("inter");
  if (all == c.defined.end()) return;
  const Block* first = nullptr;
  std::int64_t last = -1;
  for (const auto& [id, block] : all->second) {
    if (block->schema->keyword == "/INTER/SUB") continue;
    if (first == nullptr || id != last) {
      first = block;
      last = id;
      continue;
    }
    Diagnostic* d = r.report(rule, *block, block->header_span,
                             fmt::format("interface id {} is used twice", id));
    if (d != nullptr) d->notes.emplace_back(first->header_span, "first used here");
  }
}

void check_no_secondary_line(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("line_IDs"))
      report_at(r, rule, card, "line_IDs", name_of(card) + " has no secondary line");
  });
}

void check_no_main(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const auto sides = sides_of(card);
    if (sides.empty() || card.type == 11) continue;
    const std::string_view main = sides.back().field;
    if (card.given(main) || (card.type == 19 && card.given("surf_IDs"))) continue;
    Diagnostic* d = report_at(r, rule, card, main, name_of(card) + " has no main surface");
    if (d != nullptr && card.type == 0) d->reference = ReferenceMessage{119, Severity::error};
  }
}

void check_side_without_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("grnd_IDs"))
      report_at(r, rule, card, "grnd_IDs", name_of(card) + " has no secondary node group");
  });
}

void add_side_rules(std::vector<Rule>& out) {
  constexpr auto stop = Severity::error;
  out.push_back({.id = "DK170",
                 .title = "group, surface or line does not exist",
                 .severity = stop,
                 .problem = "A side of the contact names an id that no group, surface, line or set "
                            "has.",
                 .why = "The contact has nothing to act on.",
                 .solver = "it stops with an error",
                 .message = 2087,
                 .message_severity = stop,
                 .fix = "define the entity or correct the id",
                 .ignore = "When the definition is in an include that cannot be read.",
                 .bad = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=55\n",
                 .good = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1\n",
                 .check = check_missing_entity});
  out.push_back({.id = "DK171",
                 .title = "id of another kind of entity",
                 .severity = stop,
                 .problem = "The id exists, but belongs to another kind: a surface where a node "
                            "group is expected, for example.",
                 .why = "Ids of node groups, surfaces and lines are counted apart; the number "
                        "alone does not say which is meant.",
                 .solver = "it stops with an error that only says the id is unknown",
                 .message = 2087,
                 .message_severity = stop,
                 .fix = "refer to an entity of the right kind",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1\n",
                 .good = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1\n",
                 .check = check_kind});
  out.push_back({.id = "DK172",
                 .title = "secondary side is empty",
                 .severity = Severity::warning,
                 .problem = "The group, surface or line of the secondary side has no member.",
                 .why = "The interface is there and does nothing.",
                 .solver = "it warns for a node group and goes on; for surfaces and lines it stops",
                 .message = 552,
                 .fix = "correct the definition of the group",
                 .ignore = "When the part is left out of this variant on purpose.",
                 .bad = "/GRNOD/PART/4\nnothing\n        77\n@/INTER/TYPE7/1 grnd_IDs=4\n",
                 .good = "@/INTER/TYPE7/1 grnd_IDs=2\n",
                 .check = check_empty});
  out.push_back({.id = "DK173",
                 .title = "main side is empty",
                 .severity = stop,
                 .problem = "The surface or line of the main side has no segment or edge.",
                 .why = "There is nothing to touch.",
                 .solver = "it stops",
                 .message = 119,
                 .message_severity = stop,
                 .fix = "correct the definition of the surface",
                 .ignore = "Never.",
                 .bad = "/SURF/PART/3\nnothing\n        77\n@/INTER/TYPE7/1 surf_IDm=3\n",
                 .good = "@/INTER/TYPE7/1 surf_IDm=1\n",
                 .check = check_empty});
  out.push_back({.id = "DK174",
                 .title = "analytical surface in a segment contact",
                 .severity = stop,
                 .problem = "A side is a plane or an ellipsoid.",
                 .why = "Types 7, 10, 11 and 19 need segments with elements behind them.",
                 .solver = "it finds no segment and stops",
                 .message = 3160,
                 .message_severity = stop,
                 .fix = "use /INTER/TYPE14 or a rigid wall, or mesh the surface",
                 .ignore = "Never.",
                 .bad = "/SURF/PLANE/9\nfloor\n"
                        "                 0.0                 0.0                -5.0\n"
                        "                 0.0                 0.0                -4.0\n"
                        "@/INTER/TYPE7/1 surf_IDm=9\n",
                 .good = "@/INTER/TYPE7/1 surf_IDm=1\n",
                 .check = check_analytical});
  out.push_back({.id = "DK187",
                 .title = "negative reference",
                 .severity = stop,
                 .problem = "An id on the card is negative.",
                 .why = "Ids are positive; a minus sign has a meaning in lists only.",
                 .solver = "it finds nothing of that id; for a function or friction it goes on as "
                           "if none were given",
                 .message = 2087,
                 .message_severity = stop,
                 .fix = "write the id without the sign",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 grnd_IDs=-2\n",
                 .good = "@/INTER/TYPE7/1 grnd_IDs=2\n",
                 .check = check_negative});
  out.push_back({.id = "DK190",
                 .title = "a group and a set of the same id",
                 .severity = Severity::info,
                 .problem = "The id names a group, surface or line and a /SET as well.",
                 .why = "Only one of them is used.",
                 .solver = "the plain group wins",
                 .fix = "give one of them another id",
                 .ignore = "When the plain group is meant.",
                 .bad = "/SET/GENERAL/1\nlower\nPART               1\n"
                        "@/INTER/TYPE7/1 surf_IDm=1\n",
                 .good = "/SET/GENERAL/8\nlower\nPART               1\n"
                         "@/INTER/TYPE7/1 surf_IDm=1\n",
                 .check = check_ambiguous});
}

void add_target_rules(std::vector<Rule>& out) {
  constexpr auto stop = Severity::error;
  const auto add = [&](std::string_view id, std::string_view title, std::string_view problem,
                       std::string_view why, int message, std::string_view fix,
                       std::string_view bad, std::string_view good,
                       void (*check)(const LintContext&, const Rule&, Reporter&)) {
    out.push_back({.id = id,
                   .title = title,
                   .severity = stop,
                   .problem = problem,
                   .why = why,
                   .solver = "it stops with an error",
                   .message = message,
                   .message_severity = stop,
                   .fix = fix,
                   .ignore = "When the definition is in an include that cannot be read.",
                   .bad = bad,
                   .good = good,
                   .check = check});
  };
  add("DK175", "sensor does not exist", "sens_ID names no sensor.",
      "The contact would never be switched.", 1010, "define the sensor or set sens_ID 0",
      "@/INTER/TYPE7/1 sens_ID=9\n", "@/INTER/TYPE7/1 sens_ID=1\n", check_sensor);
  add("DK176", "function does not exist", "fct_IDF or fct_IDK names no function.",
      "Friction or heat exchange would have no curve.", 127, "define the function or set it to 0",
      "@/INTER/TYPE7/1 Fric=0.2 fct_IDF=9\n", "@/INTER/TYPE7/1 Fric=0.2 fct_IDF=1\n",
      check_function);
  add("DK177", "friction does not exist", "fric_ID names no /FRICTION.",
      "The contact would have no friction.", 1592, "define the /FRICTION or set fric_ID 0",
      "@/INTER/TYPE7/1 fric_ID=9\n", "@/FRICTION/1 C1=0.0 Fric=0.1\n@/INTER/TYPE7/1 fric_ID=1\n",
      check_friction_id);
  add("DK178", "curvature node does not exist", "node_ID1 or node_ID2 names no node.",
      "The curved gap has no centre or axis.", 78, "correct the node id",
      "@/INTER/TYPE7/1 Icurv=1 node_ID1=999\n", "@/INTER/TYPE7/1 Icurv=1 node_ID1=1\n",
      check_nodes);
  add("DK179", "interface id used twice", "Two interfaces have the same id.",
      "All interface types share one range of ids.", 117, "give one of them another id",
      "@/INTER/TYPE7/1\n@/INTER/TYPE11/1\n", "@/INTER/TYPE7/1\n@/INTER/TYPE11/2\n",
      check_duplicates);
  add("DK180", "TYPE11 without secondary line", "line_IDs is 0.",
      "line_IDm 0 means self contact of line_IDs; the other way round is not allowed.", 118,
      "give the line id", "@/INTER/TYPE11/1 line_IDs=0\n", "@/INTER/TYPE11/1 line_IDm=0\n",
      check_no_secondary_line);
  add("DK181", "interface without main surface", "surf_IDm is 0.",
      "Only the secondary side may be left out (self contact); TYPE19 takes the other side.", 3160,
      "give the surface id", "@/INTER/TYPE7/1 surf_IDm=0\n", "@/INTER/TYPE7/1 grnd_IDs=0\n",
      check_no_main);
  add("DK182", "TYPE10 without secondary nodes", "grnd_IDs is 0.",
      "Tied contact does not take the nodes of the main surface instead.", 552,
      "give the node group", "@/INTER/TYPE10/1 grnd_IDs=0\n", "@/INTER/TYPE10/1 grnd_IDs=2\n",
      check_side_without_nodes);
  out.back().severity = Severity::warning;
  out.back().solver = "it warns and goes on: the interface has no secondary node";
  out.back().message_severity = Severity::warning;
}

}  // namespace

void add_reference_rules(std::vector<Rule>& out) {
  add_side_rules(out);
  add_target_rules(out);
  add_friction_pair_rules(out);
}

}  // namespace deck::detail
