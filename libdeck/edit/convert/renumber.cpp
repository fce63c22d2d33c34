// Renumbers a deck: reads the rules, computes the new id of each entity, and writes it into all
// cells with ids. Refuses if a new id is taken or an id may be in undescribed text.
#include "deck/edit.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "edit/cells.hpp"
#include "keyword/shared/reader.hpp"
#include "keyword/shared/references.hpp"
#include "model/shared/families.hpp"

namespace deck {
namespace {

using detail::trim;

// ---- id spaces --------------------------------------------------------------------------------

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

/// Id spaces of a rule's kind.
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

/// Id space of an entity kind (all solids share one); empty if not renumbered.
std::string_view space_of(std::string_view kind) {
  constexpr std::string_view solids[] = {"brick",   "tetra4", "penta6",
                                         "tetra10", "bric20", "shel16"};
  if (among(solids, kind)) return "solid";
  return among(elements, kind) || among(groups, kind) || among(others, kind) ? kind
                                                                             : std::string_view();
}

/// Ids of one space, old and new.
struct IdSpace {
  std::vector<std::int64_t> ids;  ///< defined ids, ascending, unique
  bool changes = false, compact = false;
  std::int64_t value = 0;  ///< as in RenumberRule

  bool defined(std::int64_t id) const { return std::binary_search(ids.begin(), ids.end(), id); }
  /// New number of an id, defined or only referenced; nullopt if an undefined id would become
  /// defined.
  std::optional<std::int64_t> mapped(std::int64_t id) const {
    if (!changes) return id;
    if (!compact) return id + value;
    if (defined(id)) return value + (std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    return taken(id) ? std::nullopt : std::optional(id);
  }
  /// True if a defined id has this number afterwards.
  bool taken(std::int64_t new_id) const {
    if (!changes) return defined(new_id);
    if (!compact) return defined(new_id - value);
    return new_id >= value && new_id < value + static_cast<std::int64_t>(ids.size());
  }
};

using IdSpaces = std::map<std::string, IdSpace, std::less<>>;

/// All definitions of the deck with the rules applied. `refusals` gets invalid rules.
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
  const auto add = [&](std::string_view space, const std::vector<std::int64_t>& ids) {
    auto& list = spaces[std::string(space)].ids;
    list.insert(list.end(), ids.begin(), ids.end());
  };
  add("node", m.nodes.id);
  for (std::size_t k = 0; k < std::size(elements); ++k)
    add(elements[k], m.family(detail::all_families[k]).id);
  for (auto& [name, space] : spaces) {
    std::erase_if(space.ids, [](std::int64_t id) { return id <= 0; });
    std::sort(space.ids.begin(), space.ids.end());
    space.ids.erase(std::unique(space.ids.begin(), space.ids.end()), space.ids.end());
    if (!space.changes) continue;
    if (space.ids.empty()) {
      space.changes = false;
      continue;
    }
    const auto size = static_cast<std::int64_t>(space.ids.size());
    const std::int64_t first = space.compact ? space.value : space.ids.front() + space.value;
    const std::int64_t last = space.compact ? first + size - 1 : space.ids.back() + space.value;
    space.changes = first != space.ids.front() || last != space.ids.back();
    if (last > detail::largest_id)
      refusals.push_back("renumber: " + std::string(name) + " ids would reach " +
                         std::to_string(last) + "; the largest possible one is 2147483647");
    if (first < 1)
      refusals.push_back("renumber: " + std::string(name) + " id " +
                         std::to_string(space.ids.front()) + " would become " +
                         std::to_string(first));
  }
  return spaces;
}

// ---- cells ------------------------------------------------------------------------------------

/// True if undescribed text of a block may have ids of this space.
bool may_name(const Block& b, std::string_view space) {
  constexpr std::string_view none[] = {
      "/ANALY", "/DEF_SHELL", "/DEF_SOLID", "/IOFLAG", "/MEMORY", "/SPMD",  "/TITLE", "/RANDOM",
      "/AMS",   "/CAA",       "/SHFRA",     "/UPWIND", "/REFSTA", "/BEGIN", "/UNIT",  "/INTTHICK"};
  constexpr std::string_view of_materials[] = {"funct", "mat", "skew", "sensor"};
  constexpr std::string_view of_properties[] = {"funct", "mat", "prop", "skew", "frame", "sensor"};
  const auto below = [&](std::string_view keyword) { return detail::is_below(b.header, keyword); };
  if (std::any_of(std::begin(none), std::end(none), below)) return false;
  if (b.schema != nullptr && (b.schema->kind == "engine" || b.schema->kind == "parameter"))
    return false;
  if (below("/MAT") || header_reference(b) == "mat") return among(of_materials, space);
  return !below("/PROP") || among(of_properties, space);
}

class Renumbering {
 public:
  Renumbering(const LoadedDeck& context, const RenumberOptions& options, IdSpaces spaces)
      : deck_(context.deck()), options_(options), spaces_(std::move(spaces)) {}

  Rewrite run() {
    for (const Block& b : deck_.blocks) {
      const std::size_t before = out_.edits.size();
      block(b);
      const std::size_t ids = out_.edits.size() - before;
      if (ids == 0) continue;
      out_.losses.push_back(loss_entry(deck_, Loss::kept, b, b.header_span,
                                       {.note = count(ids, "id", "ids") + " changed"}));
    }
    for (std::string& why : detail::contradicting_copies(deck_.sources, out_.edits))
      out_.refusals.push_back(std::move(why));
    for (const auto& [name, space] : spaces_)
      if (space.changes) out_.notes.push_back(name + ": " + note_of(space));
    if (!out_.refusals.empty()) out_.edits.clear();
    return std::move(out_);
  }

 private:
  struct Renamed {
    bool changes = false;
    std::int64_t written = 0;  ///< new text
    std::string why;           ///< not empty: impossible
  };

  static std::string note_of(const IdSpace& space) {
    const std::int64_t first = space.ids.front();
    return std::to_string(space.ids.size()) + " ids, " + std::to_string(first) + " becomes " +
           std::to_string(*space.mapped(first));
  }

  const IdSpace* space(std::string_view kind) const {
    const auto it = spaces_.find(space_of(kind));
    return it == spaces_.end() ? nullptr : &it->second;
  }

  void undecided(const Block& b, Span place, std::string field, std::string why) {
    leave_undecided(out_, deck_, b, place, std::move(field), std::move(why), options_.partial);
  }

  /// New text of an id. `definition`: the entity's own id, which no set replaces.
  Renamed rename(const Block& b, std::string_view kind, std::int64_t written, bool definition) {
    const IdSpace* target = space(kind);
    if (written == 0) return {};
    const std::int64_t sign = written < 0 ? -1 : 1;
    const std::int64_t id = sign * written + deck_.offset_of(b, kind);
    const IdSpace* sets = space("set");
    if (!definition && (target == nullptr || !target->defined(id)) && sets != nullptr &&
        set_may_stand_for(kind) && sets->defined(id)) {
      const auto mapped = sets->mapped(id);
      if (target != nullptr && mapped && target->taken(*mapped))
        return {true, 0,
                "set " + std::to_string(id) + " would be " + std::to_string(*mapped) +
                    ", which a " + std::string(kind) + " has then"};
      target = sets;
    }
    if (target == nullptr || !target->changes) return {};
    const auto mapped = target->mapped(id);
    if (!mapped)
      return {true, 0,
              std::to_string(id) + " is not defined, and another " + std::string(kind) +
                  " would get that id"};
    const std::int64_t offset = deck_.offset_of(b, kind);
    const std::int64_t now = *mapped - offset;
    if (now < 1 || *mapped > detail::largest_id)
      return {
          true, 0,
          "the new id " + std::to_string(*mapped) +
              (offset > 0 ? " cannot be written below the submodel's offset" : " is not legal")};
    return {now != sign * written, sign * now, {}};
  }

  // ---- places ---------------------------------------------------------------------------------

  void header_id(const Block& b, std::string_view kind, bool definition) {
    const std::string_view text = deck_.sources.text(b.id.span);
    const Renamed r = rename(b, kind, b.id.value, definition);
    if (!r.changes) return;
    if (!r.why.empty()) return undecided(b, b.id.span, "id", r.why);
    if (!b.id.present || text.empty())
      return undecided(b, {}, "id", "the header has no id; it counts as 1");
    if (text.starts_with('&'))
      return undecided(b, b.id.span, "id", "the id is made by a parameter");
    out_.edits.push_back({b.id.span, std::to_string(r.written)});
  }

  /// A cell with its number.
  void cell(const detail::CellPlace& place, const Cell& c, std::string_view kind, bool definition) {
    if (c.blank() || c.integer == 0) return;
    set_id(place, c, rename(*place.block, kind, c.integer, definition));
  }

  void set_id(const detail::CellPlace& place, const Cell& c, const Renamed& r) {
    if (!r.changes) return;
    const std::string text = std::to_string(r.written);
    std::string why = r.why;
    if (c.parameter)
      why = "the id is made by a parameter";
    else if (c.status != NumberStatus::ok)
      why = "the cell holds more than a number";
    else if (why.empty() && !cells_.put(place, text))
      why = place.free_format ? "the new id makes this free-format line longer than 100 columns"
                              : "the new id " + text + " does not fit its columns";
    if (!why.empty()) undecided(*place.block, c.span, std::string(place.field), std::move(why));
  }

  // ---- blocks ---------------------------------------------------------------------------------

  void block(const Block& b) {
    if (b.schema == nullptr) return tokens(b, {});
    const Schema& s = *b.schema;
    if (const auto kind = header_reference(b); !kind.empty())
      header_id(b, kind, false);
    else if (!s.bulk && s.has_id && !space_of(s.kind).empty())
      header_id(b, s.kind, true);
    if (b.opaque) {
      for (const auto& [name, space] : spaces_)
        if (space.changes && may_name(b, name))
          return undecided(b, {}, "", "the block is encrypted; it may hold ids of kind " + name);
      return;
    }
    if (s.bulk) return items(b);
    const bool references =
        std::any_of(s.cards.begin(), s.cards.end(), [&](const CardSchema& card) {
          return std::any_of(card.fields.begin(), card.fields.end(),
                             [&](const Field& f) { return f.type == FieldType::id; });
        });
    if (!references && s.layout_known() && s.kind != "set") return;
    const DecodedBlock d = decode(deck_, b);
    ids(b, d);
    if (!s.layout_known()) tokens(b, d);
  }

  /// If one id of a line cannot change, the others stay too.
  void ids(const Block& b, const DecodedBlock& d) {
    const std::vector<IdCell> all = id_cells(d);
    for (std::size_t i = 0; i < all.size();) {
      const std::size_t edits = out_.edits.size(), open = out_.losses.size();
      const DecodedCard* line = all[i].card;
      for (; i < all.size() && all[i].card == line; ++i) id(b, all[i]);
      if (out_.losses.size() > open) out_.edits.resize(edits);
    }
  }

  void id(const Block& b, const IdCell& c) {
    if (c.kind.empty())
      number(b, c.cell->span, c.cell->integer);
    else if (c.range())
      range(b, c);
    else
      cell(detail::place_of(b, *c.card, *c.cell), *c.cell, c.kind, false);
  }

  /// Nodes and elements: many lines, few kinds of cells.
  void items(const Block& b) {
    struct Column {
      const Field* field;
      std::string_view kind;
      bool definition;
    };
    detail::ItemLines lines(deck_, b);
    std::vector<std::vector<Column>> rows;
    bool any = false;
    for (const CardSchema* card : lines.cards()) {
      rows.emplace_back();
      for (const Field& f : card->fields) {
        const bool own = rows.size() == 1 && &f == &card->fields[0];
        const std::string_view kind = own ? std::string_view(b.schema->kind) : f.ref;
        const IdSpace* target = kind.empty() ? nullptr : space(kind);
        if (!f.in_version(b.version) || target == nullptr || !target->changes) continue;
        rows.back().push_back({&f, kind, own});
        any = true;
      }
    }
    if (!any) return;
    while (lines.next_line()) {
      if (rows[lines.row()].empty()) continue;
      const DecodedCard card = lines.decoded(lines.row());
      for (const auto& [field, kind, definition] : rows[lines.row()])
        for (const Cell& c : card.cells)
          if (c.field == field) cell(detail::place_of(b, card, c), c, kind, definition);
    }
  }

  // ---- ranges and sets ------------------------------------------------------------------------

  void range(const Block& b, const IdCell& c) {
    const IdSpace* target = space(c.kind);
    if (target == nullptr || !target->changes) return;
    const std::int64_t offset = deck_.offset_of(b, c.kind);
    const std::int64_t from = c.cell->integer + offset, to = c.last->integer + offset;
    const auto refuse = [&](const std::string& why) {
      undecided(b, c.cell->span, c.cell->field->name, why);
    };
    if (c.cell->integer <= 0 || c.last->integer <= 0) return refuse("a range with a negative id");
    std::int64_t new_from = from + target->value, new_to = to + target->value;
    if (target->compact) {
      const auto lower = std::lower_bound(target->ids.begin(), target->ids.end(), from);
      const auto upper = std::upper_bound(target->ids.begin(), target->ids.end(), to);
      if (lower >= upper) return refuse("the range holds no id and has no new place");
      if (c.step != 1) return refuse("a range with an increment does not stay one");
      new_from = *target->mapped(*lower);
      new_to = *target->mapped(*(upper - 1));
    }
    if (new_from - offset < 1 || new_to > detail::largest_id)
      return refuse("the new range is not legal");
    if (new_from != from)
      set_id(detail::place_of(b, *c.card, *c.cell), *c.cell, {true, new_from - offset, {}});
    if (new_to != to)
      set_id(detail::place_of(b, *c.last_card, *c.last), *c.last, {true, new_to - offset, {}});
  }

  // ---- text that no schema describes ----------------------------------------------------------

  /// Reports the number and returns true if it could be an id that changes.
  bool number(const Block& b, Span place, std::int64_t value) {
    for (const auto& [name, space] : spaces_) {
      if (!space.changes || !may_name(b, name)) continue;
      const std::string_view kind = name == "solid" ? std::string_view("brick") : name;
      const std::int64_t id = std::abs(value) + deck_.offset_of(b, kind);
      if (!space.defined(id) || space.mapped(id) == id) continue;
      undecided(b, place, "",
                "the keyword is not described (completely), and " + std::to_string(value) +
                    " may be the " + name + " that gets another id");
      return true;
    }
    return false;
  }

  /// Words longer than a cell may be ids of ten columns without blanks.
  bool glued(const Block& b, const Line& line, std::size_t begin, std::size_t end) {
    constexpr std::size_t width = 10;
    if (end - begin <= width) return false;
    for (std::size_t at = begin; at < end;) {
      const std::size_t next = std::min(end, (at / width + 1) * width);
      const IntegerCell n = read_integer(line.text.substr(at, next - at));
      if (n.status == NumberStatus::ok && n.value != 0 &&
          number(b, line.columns(static_cast<int>(at) + 1, static_cast<int>(next)), n.value))
        return true;
      at = next;
    }
    return false;
  }

  /// One finding per block.
  void tokens(const Block& b, const DecodedBlock& d) {
    if (std::none_of(spaces_.begin(), spaces_.end(), [&](const auto& space) {
          return space.second.changes && may_name(b, space.first);
        }))
      return;
    const auto scan = [&](const Line& line, std::size_t begin, std::size_t end) {
      const std::string_view token = line.text.substr(begin, end - begin);
      const Span place = line.columns(static_cast<int>(begin) + 1, static_cast<int>(end));
      if (glued(b, line, begin, end)) return true;
      if (token.starts_with('&') || token.starts_with("-&")) {
        const std::int64_t value = detail::read_offset(deck_, place);
        return value != 0 && number(b, place, value);
      }
      const IntegerCell n = read_integer(token);
      return n.status == NumberStatus::ok && n.value != 0 && number(b, place, n.value);
    };
    if (b.schema != nullptr) return detail::find_undescribed_words(d, scan);
    if (b.id.present && number(b, b.id.span, b.id.value)) return;
    LineCursor cursor(deck_.sources, b);
    for (Line line = cursor.next(); line.valid(); line = cursor.next())
      if (detail::find_words(line, {}, scan)) return;
  }

  const Deck& deck_;
  const RenumberOptions& options_;
  IdSpaces spaces_;
  Rewrite out_;
  detail::CellEdits cells_{deck_.sources, out_.edits};
};

}  // namespace

Result<RenumberRule> parse_renumber_rule(std::string_view text) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config, "'" + std::string(text.substr(0, 60)) + "': " + why +
                                          "; expected for example node+1000, part-50 or shell=1"};
  };
  const auto mark = text.find_first_of("+-=");
  if (mark == std::string_view::npos) return bad("no +, - or =");
  RenumberRule rule;
  rule.kind = std::string(trim(text.substr(0, mark)));
  if (spaces_of_rule(rule.kind).empty()) return bad("unknown kind");
  const std::string_view number = trim(text.substr(mark + 1));
  const auto end = std::from_chars(number.data(), number.data() + number.size(), rule.value);
  if (number.empty() || end.ec != std::errc() || end.ptr != number.data() + number.size() ||
      rule.value < 0 || rule.value > detail::largest_id)
    return bad("no id behind the sign");
  rule.compact = text[mark] == '=';
  if (rule.compact && rule.value < 1) return bad("the first id must be 1 or more");
  if (text[mark] == '-') rule.value = -rule.value;
  return rule;
}

Rewrite renumber(const LoadedDeck& context, const RenumberOptions& options) {
  Rewrite out;
  out.refusals = detail::unread_files(context.deck());
  const std::size_t unread = out.refusals.size();
  IdSpaces spaces = collect_spaces(context, options, out.refusals);
  out.bad_request = out.refusals.size() > unread;
  if (!out.refusals.empty()) return out;
  return Renumbering(context, options, std::move(spaces)).run();
}

}  // namespace deck
