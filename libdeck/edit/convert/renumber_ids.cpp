// Reads renumbering rules and computes the new id of every entity.
#include "edit/convert/renumber_ids.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "keyword/shared/reader.hpp"

namespace deck {
namespace {

constexpr std::string_view elements[] = {"shell", "sh3n",  "solid", "quad",
                                         "tria",  "truss", "beam",  "spring"};
constexpr std::string_view groups[] = {"grnod",  "grshel", "grsh3n", "grtria", "grbric",
                                       "grquad", "grtrus", "grbeam", "grspri", "grpart",
                                       "surf",   "line",   "set"};
constexpr std::string_view others[] = {"node",     "part",  "prop",     "mat",  "subset",
                                       "box",      "funct", "sensor",   "skew", "frame",
                                       "friction", "inter", "transform"};

template <std::size_t N>
bool among(const std::string_view (&list)[N], std::string_view kind) {
  return std::find(std::begin(list), std::end(list), kind) != std::end(list);
}

/// The spaces that a rule's kind stands for.
std::vector<std::string_view> spaces_of_rule(std::string_view kind) {
  std::vector<std::string_view> out;
  const auto add = [&](const auto& list) {
    for (const std::string_view name : list) out.push_back(name);
  };
  const bool all = kind == "all";
  if (all || kind == "element") add(elements);
  if (all || kind == "group") add(groups);
  if (all) add(others);
  if (out.empty() && (among(elements, kind) || among(groups, kind) || among(others, kind)))
    out.push_back(kind);
  return out;
}

}  // namespace

Result<RenumberRule> parse_renumber_rule(std::string_view text) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config, "'" + std::string(text.substr(0, 60)) + "': " + why +
                                          "; expected for example node+1000, part-50 or shell=1"};
  };
  const auto mark = text.find_first_of("+-=");
  if (mark == std::string_view::npos) return bad("no +, - or =");
  RenumberRule rule;
  rule.kind = std::string(detail::trim(text.substr(0, mark)));
  if (spaces_of_rule(rule.kind).empty()) return bad("unknown kind");
  const std::string_view number = detail::trim(text.substr(mark + 1));
  const auto end = std::from_chars(number.data(), number.data() + number.size(), rule.value);
  if (number.empty() || end.ec != std::errc() || end.ptr != number.data() + number.size() ||
      rule.value < 0 || rule.value > 2147483647)
    return bad("no id behind the sign");
  rule.compact = text[mark] == '=';
  if (rule.compact && rule.value < 1) return bad("the first id must be 1 or more");
  if (text[mark] == '-') rule.value = -rule.value;
  return rule;
}

namespace detail {

std::string_view space_of(std::string_view kind) {
  constexpr std::string_view solids[] = {"brick",   "tetra4", "penta6",
                                         "tetra10", "bric20", "shel16"};
  if (among(solids, kind)) return "solid";
  return among(elements, kind) || among(groups, kind) || among(others, kind) ? kind
                                                                             : std::string_view();
}

bool IdSpace::defined(std::int64_t id) const {
  return std::binary_search(ids.begin(), ids.end(), id);
}

std::optional<std::int64_t> IdSpace::mapped(std::int64_t id) const {
  if (!changes) return id;
  if (only != 0) {
    if (id == only) return value;
    return id == value ? std::nullopt : std::optional(id);
  }
  if (!compact) return id + value;
  const auto it = std::lower_bound(ids.begin(), ids.end(), id);
  if (it != ids.end() && *it == id) return value + (it - ids.begin());
  // Named but not defined: it must not come to mean something.
  if (taken(id)) return std::nullopt;
  return id;
}

std::vector<std::int64_t> IdSpace::members(std::int64_t from, std::int64_t to,
                                           std::int64_t step) const {
  std::vector<std::int64_t> out;
  for (auto it = std::lower_bound(ids.begin(), ids.end(), from); it != ids.end() && *it <= to; ++it)
    if ((*it - from) % std::max<std::int64_t>(step, 1) == 0) out.push_back(*it);
  return out;
}

bool IdSpace::taken(std::int64_t new_id) const {
  if (!changes) return defined(new_id);
  if (only != 0) return new_id == value || (new_id != only && defined(new_id));
  if (!compact) return defined(new_id - value);
  return new_id >= value && new_id < value + static_cast<std::int64_t>(ids.size());
}

namespace {

/// One id gets another number: it has to be there, and the number has to be free and legal.
void check_single(const std::string& name, IdSpace& space, std::vector<std::string>& refusals) {
  const std::string from = name + " " + std::to_string(space.only);
  const std::string to = std::to_string(space.value);
  if (space.value == space.only) {
    space.changes = false;
  } else if (!space.defined(space.only)) {
    refusals.push_back("renumber: there is no " + from);
  } else if (space.defined(space.value)) {
    refusals.push_back("renumber: " + from + " would become " + to + ", which exists");
  } else if (space.value < 1 || space.value > largest_id) {
    refusals.push_back("renumber: " + from + " would become " + to + ", which is no legal id");
  }
}

}  // namespace

IdSpaces collect_spaces(const LoadedDeck& context, const RenumberOptions& options,
                        std::vector<std::string>& refusals) {
  IdSpaces spaces;
  for (const RenumberRule& rule : options.rules) {
    const auto list = spaces_of_rule(rule.kind);
    if (list.empty()) refusals.push_back("renumber: unknown kind '" + rule.kind + "'");
    for (const std::string_view name : list) {
      IdSpace& space = spaces[std::string(name)];
      if (space.changes) refusals.push_back("renumber: two rules for " + std::string(name));
      space.changes = true;
      space.compact = rule.compact;
      space.value = rule.value;
      space.only = rule.only;
    }
  }
  const Deck& deck = context.deck();
  const Model& m = context.model();
  for (const Block& b : deck.blocks) {
    if (b.schema == nullptr || b.schema->bulk) continue;
    const std::string_view space = space_of(b.schema->kind);
    if (!space.empty())
      spaces[std::string(space)].ids.push_back(b.id.value + deck.offset_of(b, b.schema->kind));
  }
  const auto add = [&](const char* space, const std::vector<std::int64_t>& ids) {
    auto& list = spaces[space].ids;
    list.insert(list.end(), ids.begin(), ids.end());
  };
  add("node", m.nodes.id);
  add("shell", m.shell4.id);
  add("sh3n", m.shell3.id);
  add("solid", m.solid8.id);
  add("quad", m.quad.id);
  add("tria", m.tria.id);
  add("truss", m.truss.id);
  add("beam", m.beam.id);
  add("spring", m.spring.id);
  for (auto& [name, space] : spaces) {
    std::erase_if(space.ids, [](std::int64_t id) { return id <= 0; });
    std::sort(space.ids.begin(), space.ids.end());
    space.ids.erase(std::unique(space.ids.begin(), space.ids.end()), space.ids.end());
    // A rule that changes nothing asks for no caution.
    if (!space.changes) continue;
    if (space.ids.empty()) {
      space.changes = false;
      continue;
    }
    if (space.only != 0) {
      check_single(name, space, refusals);
      continue;
    }
    if (space.compact
            ? space.ids.front() == space.value &&
                  space.ids.back() == space.value + static_cast<std::int64_t>(space.ids.size()) - 1
            : space.value == 0)
      space.changes = false;
    const std::int64_t last = space.compact
                                  ? space.value + static_cast<std::int64_t>(space.ids.size()) - 1
                                  : space.ids.back() + space.value;
    if (last > 2147483647)
      refusals.push_back("renumber: " + std::string(name) + " ids would reach " +
                         std::to_string(last) + "; the largest possible one is 2147483647");
    if (!space.compact && space.ids.front() + space.value < 1)
      refusals.push_back("renumber: " + std::string(name) + " id " +
                         std::to_string(space.ids.front()) + " would become " +
                         std::to_string(space.ids.front() + space.value));
  }
  return spaces;
}

}  // namespace detail
}  // namespace deck
