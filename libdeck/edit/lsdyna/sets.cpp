// What the words of *SET_ mean, sets of sets, and sets as blocks of a Radioss deck.
#include "edit/lsdyna/sets.hpp"

#include <algorithm>

#include "edit/lsdyna/cards.hpp"

namespace deck::detail {
namespace {

/// Cuts a word off the end.
bool cut(std::string_view& text, std::string_view word) {
  if (!text.ends_with(word)) return false;
  text.remove_suffix(word.size());
  return true;
}

std::string lines_of(const std::vector<std::int64_t>& ids) {
  std::string out;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    out += list_cell(ids[i]);
    if (i % 10 == 9 || i + 1 == ids.size()) out += '\n';
  }
  return out;
}

template <class T>
void unite(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

void append(DynaSet& to, const DynaSet& from) {
  to.ids.insert(to.ids.end(), from.ids.begin(), from.ids.end());
  to.ranges.insert(to.ranges.end(), from.ranges.begin(), from.ranges.end());
  to.segments.insert(to.segments.end(), from.segments.begin(), from.segments.end());
  if (to.unread.empty()) to.unread = from.unread;
}

}  // namespace

bool set_kind_of(std::int64_t type, DynaSetKind& kind) {
  switch (type) {
    case 0:
      kind = DynaSetKind::segment;
      return true;
    case 1:
      kind = DynaSetKind::shell;
      return true;
    case 2:
    case 6:
      kind = DynaSetKind::part;
      return true;
    case 4:
      kind = DynaSetKind::node;
      return true;
    default:
      return false;
  }
}

bool read_set_keyword(std::string_view keyword, DynaSetKeyword& out) {
  constexpr std::pair<std::string_view, DynaSetKind> kinds[] = {
      {"*SET_NODE", DynaSetKind::node},
      {"*SET_PART", DynaSetKind::part},
      {"*SET_SEGMENT", DynaSetKind::segment},
      {"*SET_SHELL", DynaSetKind::shell}};
  const auto* found = std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) {
    return keyword.starts_with(k.first) &&
           (keyword.size() == k.first.size() || keyword[k.first.size()] == '_');
  });
  if (found == std::end(kinds)) return false;
  out = {};
  out.kind = found->second;
  std::string_view rest = keyword.substr(found->first.size());
  // TITLE and COLLECT stand at the end, in any order.
  for (bool again = true; again;) {
    const bool title = cut(rest, "_TITLE"), collect = cut(rest, "_COLLECT");
    out.title = out.title || title;
    out.collect = out.collect || collect;
    again = title || collect;
  }
  using Form = DynaSetKeyword::Form;
  if (out.kind == DynaSetKind::segment)
    out.form = rest.empty() ? Form::segments : Form::other;
  else if (rest.empty() || rest == "_LIST")
    out.form = Form::list;
  else if (rest == "_COLUMN")
    out.form = Form::column;
  else if (rest == "_LIST_GENERATE" || rest == "_GENERATE")
    out.form = Form::generate;
  else if (rest == "_ADD")
    out.form = Form::add;
  else
    out.form = Form::other;
  return true;
}

void DynaSets::add(DynaSetKind kind, std::int64_t id, DynaSet set, bool collect) {
  const auto [it, fresh] = sets.try_emplace({kind, id});
  if (fresh) {
    it->second = std::move(set);
  } else if (collect) {
    append(it->second, set);
    it->second.sets.insert(it->second.sets.end(), set.sets.begin(), set.sets.end());
  } else {
    it->second.unread = "it is defined more than once";
  }
}

const DynaSet* DynaSets::find(DynaSetKind kind, std::int64_t id) {
  const std::pair key{kind, id};
  const auto it = sets.find(key);
  if (it == sets.end()) return nullptr;
  DynaSet& set = it->second;
  if (set.sets.empty() || resolved_.contains(key)) return &set;
  // Bounds the recursion as well.
  constexpr std::size_t deepest = 100;
  if (open_.size() >= deepest || !open_.insert(key).second) return nullptr;
  unite(set.sets);
  for (const std::int64_t other : set.sets) {
    const DynaSet* added = find(kind, other);
    if (added == nullptr)
      set.unread = "set " + std::to_string(other) + ", which it adds, is missing or adds this set";
    else
      append(set, *added);
  }
  open_.erase(key);
  resolved_.insert(key);
  unite(set.ids);
  unite(set.ranges);
  unite(set.segments);
  return &set;
}

std::string clause(std::string_view word, const std::vector<std::int64_t>& ids) {
  std::string out;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i % 9 == 0) out += std::string(word) + std::string(10 - word.size(), ' ');
    out += list_cell(ids[i]);
    if (i % 9 == 8 || i + 1 == ids.size()) out += '\n';
  }
  return out;
}

std::string plain_block(const DynaSet& set, DynaSetKind kind, const std::string& title) {
  if (!set.ranges.empty() || kind == DynaSetKind::shell) return {};
  if (kind == DynaSetKind::node) return "/GRNOD/NODE/@\n" + title + "\n" + lines_of(set.ids);
  if (kind == DynaSetKind::part) return "/SURF/PART/EXT/@\n" + title + "\n" + lines_of(set.ids);
  std::string out = "/SURF/SEG/@\n" + title + "\n";
  std::int64_t n = 0;
  for (const auto& nodes : set.segments) {
    out += list_cell(++n);
    const bool triangle = nodes[3] == nodes[2] || nodes[3] == 0;
    for (std::size_t i = 0; i < (triangle ? 3U : 4U); ++i) out += list_cell(nodes[i]);
    out += '\n';
  }
  return out;
}

std::string general_block(const DynaSet& set, DynaSetKind kind, const std::string& title) {
  std::vector<std::int64_t> triplets;
  for (const auto& [first, last] : set.ranges) triplets.insert(triplets.end(), {first, last, 1});
  std::string out = "/SET/GENERAL/@\n" + title + "\n";
  const auto add = [&](const std::string& word) {
    out += clause(word, set.ids) + clause(word + "_G", triplets);
  };
  if (kind == DynaSetKind::node) add("NODE");
  if (kind == DynaSetKind::part) add("PART");
  if (kind == DynaSetKind::shell) {
    add("SHELL");
    add("SH3N");
  }
  return out;
}

}  // namespace deck::detail
