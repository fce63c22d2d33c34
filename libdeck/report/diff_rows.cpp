// What a comparison of two decks found, as rows of text.
#include "report/diff_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/count.hpp"
#include "base/shared/length3.hpp"
#include "base/shared/length_text.hpp"
#include "report/shared/json.hpp"

namespace deck {
namespace {

std::string diff_value(const DiffValue& v, const char* nothing = "-") {
  if (const auto* n = std::get_if<std::int64_t>(&v)) return std::to_string(*n);
  if (const auto* x = std::get_if<double>(&v)) return shortest(*x);
  if (const auto* t = std::get_if<std::string>(&v)) return *t;
  if (const auto* p = std::get_if<std::array<double, 3>>(&v))
    return fmt::format("{} {} {}", shortest((*p)[0]), shortest((*p)[1]), shortest((*p)[2]));
  return nothing;
}

/// Lengths that were subtracted: what round-off leaves behind six digits says nothing.

std::string entity_text(const Change& c) {
  std::string out = c.keyword;
  if (c.id != 0) out += fmt::format("/{}", c.id);
  if (c.id_b != 0) out += fmt::format(" -> {}", c.id_b);
  if (!c.title.empty()) out += " " + c.title;
  return out;
}

std::string members_text(const std::vector<std::int64_t>& ids, const char* sign, std::size_t most) {
  if (ids.empty()) return "";
  std::string out = fmt::format("{}{}: ", sign, ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (most > 0 && i == most) return out + " ...";
    out += fmt::format("{}{}", i == 0 ? "" : " ", ids[i]);
  }
  return out;
}

std::string place_text(const DiffSide& a, const DiffSide& b, const Change& c) {
  const bool second = c.b.valid();
  if (!second && !c.a.valid()) return "";
  return second ? b.loaded.deck().sources.where(c.b) : a.loaded.deck().sources.where(c.a);
}

bool has_members(const Change& c) {
  return !c.gained.empty() || !c.lost.empty() || !c.altered.empty();
}

struct Group {
  const char* name;
  const char* title;
};
constexpr Group diff_groups[] = {{"deck", "Deck"},
                                 {"interface", "Interfaces"},
                                 {"group", "Groups, surfaces, sets"},
                                 {"part", "Parts"},
                                 {"property", "Properties"},
                                 {"material", "Materials"},
                                 {"other", "Other keywords"},
                                 {"node", "Nodes"}};

}  // namespace

std::vector<DiffTable> diff_tables(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                                   std::size_t rows) {
  std::vector<DiffTable> out;
  const auto keep = [&](DiffTable table) {
    if (table.rows.empty()) return;
    if (rows > 0 && table.rows.size() > rows && table.left_out == 0) {
      table.left_out = table.rows.size() - rows;
      table.rows.resize(rows);
    }
    out.push_back(std::move(table));
  };
  for (const Group& group : diff_groups) {
    DiffTable whole{group.title, {"change", "what", "place"}, {}, 0};
    DiffTable fields{group.title, {"what", "field", "old", "new", "place"}, {}, 0};
    DiffTable effective{"Effective values",
                        {"interface", "field", "card", "now", "effective", "now", "why", "place"},
                        {},
                        0};
    DiffTable members{
        "Members", {"what", "list", "old", "new", "gained", "lost", "altered"}, {}, 0};
    DiffTable moved{"Nodes moved", {"node", "from", "to", "by", "place"}, {}, 0};
    for (const Change& c : diff.changes) {
      if (c.group != group.name) continue;
      if (c.kind == ChangeKind::moved) {
        const auto* p = std::get_if<std::array<double, 3>>(&c.old_value);
        const auto* q = std::get_if<std::array<double, 3>>(&c.new_value);
        const double by = p == nullptr || q == nullptr
                              ? 0
                              : length3((*q)[0] - (*p)[0], (*q)[1] - (*p)[1], (*q)[2] - (*p)[2]);
        moved.rows.push_back(
            {c.id_b == 0 ? std::to_string(c.id) : fmt::format("{} -> {}", c.id, c.id_b),
             diff_value(c.old_value), diff_value(c.new_value), length_text(by),
             place_text(a, b, c)});
      } else if (c.field.empty()) {
        whole.rows.push_back({to_string(c.kind), entity_text(c), place_text(a, b, c)});
      } else if (c.evaluated) {
        effective.rows.push_back({entity_text(c), c.field, diff_value(c.old_value),
                                  diff_value(c.new_value), diff_value(c.effective_old),
                                  diff_value(c.effective_new), c.why, place_text(a, b, c)});
      } else if (has_members(c)) {
        members.rows.push_back({entity_text(c), c.field, diff_value(c.old_value),
                                diff_value(c.new_value), members_text(c.gained, "+", 8),
                                members_text(c.lost, "-", 8), members_text(c.altered, "", 8)});
      } else {
        fields.rows.push_back({entity_text(c), c.field, diff_value(c.old_value),
                               diff_value(c.new_value), place_text(a, b, c)});
      }
    }
    keep(std::move(whole));
    keep(std::move(effective));
    keep(std::move(fields));
    keep(std::move(members));
    keep(std::move(moved));
  }
  const std::pair<const char*, const std::vector<PenetrationChange>*> lists[] = {
      {"New penetrations", &diff.appeared},
      {"Deeper penetrations", &diff.worse},
      {"Shallower penetrations", &diff.better},
      {"Penetrations gone", &diff.gone}};
  for (const auto& [title, list] : lists) {
    DiffTable table{title, {"interface", "node/edge", "depth", "now", "gap", "now"}, {}, 0};
    for (const PenetrationChange& p : *list) {
      if (rows > 0 && table.rows.size() == rows) break;
      const bool was = list != &diff.appeared, is = list != &diff.gone;
      table.rows.push_back(
          {p.role == "primary" ? std::to_string(p.interface_id)
                               : fmt::format("{} {}", p.interface_id, p.role),
           p.secondary[1] == 0 ? std::to_string(p.secondary[0])
                               : fmt::format("{}-{}", p.secondary[0], p.secondary[1]),
           was ? length_text(p.depth_old) : "-", is ? length_text(p.depth_new) : "-",
           was ? length_text(p.gap_old) : "-", is ? length_text(p.gap_new) : "-"});
    }
    table.left_out = list->size() - table.rows.size();
    keep(std::move(table));
  }
  return out;
}

std::string diff_verdict(const DeckDiff& diff) {
  if (diff.equal())
    return diff.same.empty()
               ? "Equal in meaning: no initial penetrations in either."
               : fmt::format("Equal in meaning, with the same {} penetrating nodes and edges.",
                             diff.same.size());
  std::vector<std::string> parts;
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) parts.push_back(deck::count(n, one, many));
  };
  const auto count = [&](auto&& test) {
    return static_cast<std::size_t>(std::count_if(diff.changes.begin(), diff.changes.end(), test));
  };
  say(count([](const Change& c) { return c.kind == ChangeKind::added; }), "keyword added",
      "keywords added");
  say(count([](const Change& c) { return c.kind == ChangeKind::removed; }), "keyword removed",
      "keywords removed");
  say(count([](const Change& c) { return c.kind == ChangeKind::changed && c.evaluated; }),
      "effective value of a contact changed", "effective values of contacts changed");
  say(count([](const Change& c) {
        return c.kind == ChangeKind::changed && !c.evaluated && has_members(c);
      }),
      "list of members changed", "lists of members changed");
  say(count([](const Change& c) {
        return c.kind == ChangeKind::changed && !c.evaluated && !has_members(c);
      }),
      "other field changed", "other fields changed");
  say(count([](const Change& c) { return c.kind == ChangeKind::moved; }), "node moved",
      "nodes moved");
  say(diff.appeared.size(), "new penetration", "new penetrations");
  say(diff.worse.size(), "deeper", "deeper");
  say(diff.better.size(), "shallower", "shallower");
  say(diff.gone.size(), "penetration gone", "penetrations gone");
  if (diff.stops_a != diff.stops_b)
    parts.insert(parts.begin(), diff.stops_b ? "the solver stops at the second deck"
                                             : "the solver stops at the first deck");
  std::string out = "Different: ";
  for (std::size_t i = 0; i < parts.size(); ++i) out += (i == 0 ? "" : ", ") + parts[i];
  return out + ".";
}

}  // namespace deck
