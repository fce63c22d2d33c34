// Finds the entity that a user names: an interface by id, others by keyword or kind and id.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "inspect/match.hpp"
#include "inspect/shared/show.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

/// Kinds by the names that users write.
std::string kind_named(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"interface", "inter"}, {"material", "mat"}, {"property", "prop"},
      {"function", "funct"},  {"surface", "surf"}, {"group", "grnod"},
      {"contact", "inter"},   {"sh4n", "shell"},   {"elem", "element"}};
  const std::string wanted = in_lower_case(name);
  for (const auto& [word, kind] : names)
    if (word == wanted) return std::string(kind);
  return wanted;
}

class EntityFinder {
 public:
  EntityFinder(const Deck& deck, const Model& model) : deck_(deck), model_(model) {}

  Result<Entity> find(std::string_view what) {
    const auto mark = what.find_last_of(":/");
    const std::string_view number = mark == what.npos ? what : what.substr(mark + 1);
    const IntegerCell id = read_integer(number);
    if (id.status != NumberStatus::ok || id.value < 0)
      return bad(what, "'" + std::string(number) + "' is no id");
    if (mark == what.npos) return by_kind(what, "inter", id.value);
    if (what[mark] == ':') return by_kind(what, kind_named(what.substr(0, mark)), id.value);
    return by_keyword(what, what.substr(0, mark), id.value);
  }

 private:
  static Error bad(std::string_view what, const std::string& why) {
    return {Error::Code::config,
            "'" + std::string(what) + "': " + why +
                "; expected an interface id (3), KEYWORD/ID (/INTER/TYPE7/3) or KIND:ID (node:57, "
                "part:4, shell:12, mat:1, grnod:5, surf:2, set:9)"};
  }

  Entity of_block(const Block& b) const {
    Entity e;
    e.kind = b.schema->kind;
    e.keyword = b.schema->keyword;
    e.id = id_of(deck_, b);
    e.block = &b;
    e.span = b.header_span;
    e.title = b.schema->has_title ? decode(deck_, b).title : std::string();
    const auto at = [&](const std::map<std::int64_t, std::uint32_t>& map) {
      const auto it = map.find(e.id);
      return it == map.end() ? no_index : it->second;
    };
    if (e.kind == "part") e.index = at(model_.part_of_id);
    if (e.kind == "prop") e.index = at(model_.property_of_id);
    if (e.kind == "mat") e.index = at(model_.material_of_id);
    return e;
  }

  bool item(std::string_view kind, std::int64_t id, Entity& e) const {
    if (kind == "node") {
      const NodeIndex n = model_.nodes.map.find(id);
      if (n == no_index) return false;
      e.kind = "node";
      e.index = n;
      for (const BulkBlock& b : model_.node_blocks)
        if (n >= b.first && n - b.first < b.count) e.block = b.block;
      e.span = model_.node_span(n);
    } else if (const auto family = detail::family_of_kind(kind)) {
      const Elements& elements = model_.family(*family);
      const std::uint32_t i = elements.map.find(id);
      if (i == no_index) return false;
      e.index = i;
      const std::uint32_t block = i < elements.block.size() ? elements.block[i] : no_index;
      if (block < model_.element_blocks.size()) e.block = model_.element_blocks[block].block;
      e.kind = e.block != nullptr && e.block->schema != nullptr ? e.block->schema->kind
                                                                : std::string(kind);
      e.span = model_.element_span(*family, i);
    } else {
      return false;
    }
    e.id = id;
    e.keyword = e.block != nullptr && e.block->schema != nullptr ? e.block->schema->keyword : "";
    return true;
  }

  /// Keywords or kinds of the deck.
  std::vector<std::string> of_schemas(std::string Schema::*what) const {
    std::set<std::string> out;
    for (const Block& b : deck_.blocks)
      if (b.schema != nullptr) out.insert(b.schema->*what);
    return {out.begin(), out.end()};
  }
  static std::string meant(std::string_view word, const std::vector<std::string>& known) {
    const std::string close = closest_word(word, known);
    return close.empty() ? close : "; did you mean '" + close + "'";
  }

  Result<Entity> by_kind(std::string_view what, const std::string& kind, std::int64_t id) const {
    Entity e;
    if (item(kind, id, e)) return e;
    if (kind == "element")
      for (const detail::FamilyName& family : detail::family_names())
        if (item(family.id_kind, id, e)) return e;
    bool known = kind == "node" || kind == "element" || detail::family_of_kind(kind).has_value();
    for (const Block& b : deck_.blocks) {
      if (b.schema == nullptr || b.schema->bulk || b.schema->kind != kind) continue;
      known = true;
      if (id_of(deck_, b) == id) return of_block(b);
    }
    std::string why = kind == "inter" ? fmt::format("there is no interface {}", id)
                      : known         ? fmt::format("there is no {} {}", kind, id)
                                      : fmt::format("the deck has no entity of kind '{}'", kind);
    if (!known) why += meant(kind, of_schemas(&Schema::kind));
    return bad(what, why + with_id(id));
  }

  Result<Entity> by_keyword(std::string_view what, std::string_view keyword,
                            std::int64_t id) const {
    std::string wanted = in_capitals(keyword);
    if (!wanted.starts_with('/')) wanted.insert(0, "/");
    const auto named = [&](const Schema& s) {
      const auto fits = [&](std::string_view k) {
        return detail::is_below(k, wanted) || in_capitals(k).ends_with(wanted);
      };
      return fits(s.keyword) || std::any_of(s.aliases.begin(), s.aliases.end(), fits);
    };
    for (const Block& b : deck_.blocks) {
      if (b.schema == nullptr || b.schema->bulk || !named(*b.schema)) continue;
      if (id_of(deck_, b) == id) return of_block(b);
    }
    for (const Block& b : deck_.blocks) {
      Entity e;
      if (b.schema != nullptr && b.schema->bulk && named(*b.schema) && item(b.schema->kind, id, e))
        return e;
    }
    std::string why = fmt::format("there is no {}/{}", wanted, id);
    const std::vector<std::string> keywords = of_schemas(&Schema::keyword);
    if (std::none_of(keywords.begin(), keywords.end(),
                     [&](const std::string& k) { return detail::is_below(k, wanted); }))
      why += meant(wanted, keywords);
    return bad(what, why + with_id(id));
  }

  /// "; 3 is the id of part:3, mat:3": other entities with that id.
  std::string with_id(std::int64_t id) const {
    std::string out;
    for (const auto& [kind, block] : Definitions(deck_).with_id(id))
      if (kind != "other") out += fmt::format("{}{}:{}", out.empty() ? "" : ", ", kind, id);
    const auto add = [&](std::string_view kind) {
      if (Entity e; item(kind, id, e))
        out += fmt::format("{}{}:{}", out.empty() ? "" : ", ", kind, id);
    };
    add("node");
    for (const detail::FamilyName& family : detail::family_names()) add(family.id_kind);
    return out.empty() ? out : fmt::format("; {} is the id of {}", id, out);
  }

  const Deck& deck_;
  const Model& model_;
};

}  // namespace

Result<Entity> find_entity(const Deck& deck, const Model& model, std::string_view what) {
  return EntityFinder(deck, model).find(what);
}

}  // namespace deck
