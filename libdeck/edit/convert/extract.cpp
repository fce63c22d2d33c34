// Finds everything that the wanted interfaces need.
// Work list of (block, level): the interfaces first; each block adds the blocks it names, the
// selections of selections, and the elements that touch their nodes, until nothing is new. Then
// come blocks that act without being named: transformations, functions, materials, submodels. Cost:
// linear in the deck per round; a few rounds.
#include <algorithm>

#include "edit/convert/extract.hpp"
#include "keyword/shared/reader.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

namespace {

/// Id in the header of blocks whose schema does not name it: /FAIL/X/mat_ID, /TABLE/type/id.
std::int64_t own_id(const Block& b) {
  constexpr std::string_view table = "/TABLE/";
  if (b.header.starts_with(table)) {
    const auto slash = b.header.find('/', table.size());
    if (slash == std::string_view::npos) return 0;
    const std::string_view rest = b.header.substr(slash + 1);
    return read_integer(rest.substr(0, rest.find('/'))).value;
  }
  return b.id.present ? b.id.value : read_integer(b.header.substr(b.header.rfind('/') + 1)).value;
}

constexpr std::string_view selection_kinds[] = {"grnod",  "grshel", "grsh3n", "grtria",
                                                "grbric", "grquad", "grtrus", "grbeam",
                                                "grspri", "surf",   "line",   "set"};

bool is_selection(std::string_view kind) {
  return std::find(std::begin(selection_kinds), std::end(selection_kinds), kind) !=
         std::end(selection_kinds);
}

/// Switches of the run that act on contacts or their elements, and definitions of units.
bool is_switch(const Block& b) {
  constexpr std::string_view list[] = {"/BEGIN",  "/TITLE",    "/UNIT",      "/PARAMETER",
                                       "/ANALY",  "/INTTHICK", "/DEF_SHELL", "/DEF_SOLID",
                                       "/RANDOM", "/IOFLAG",   "/SPMD",      "/IMPLICIT",
                                       "/CAA",    "/SHFRA",    "/DEFAULT"};
  return std::any_of(std::begin(list), std::end(list),
                     [&](std::string_view k) { return detail::is_below(b.header, k); });
}

bool is_box_selection(const Block& b) { return b.header.find("/BOX") != std::string_view::npos; }

}  // namespace

Extraction::Extraction(const LoadedDeck& c, std::span<const std::int64_t> interfaces)
    : block_kept(c.deck().blocks.size(), 0),
      node_kept(c.model().nodes.size(), 0),
      deck_(c.deck()),
      model_(c.model()),
      selections_(*c.model().selections),
      visited_(c.deck().blocks.size(), 0),
      touched_(c.model().nodes.size(), 0),
      part_whole_(c.model().parts.size(), 0),
      elements_of_part_(c.model().parts.size()) {
  for (std::size_t k = 0; k < element_families; ++k) {
    const Elements& family = model_.family(static_cast<ElementKind>(k));
    element_kept[k].assign(family.size(), 0);
    scanned_[k].assign(family.size(), 0);
    for (std::uint32_t e = 0; e < family.size(); ++e)
      if (family.part[e] != no_index)
        elements_of_part_[family.part[e]].emplace_back(static_cast<ElementKind>(k), e);
  }
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (b.schema == nullptr || b.schema->kind.empty() || b.schema->bulk) continue;
    // A cell may name a table instead of a function.
    if (detail::is_below(b.header, "/TABLE"))
      definitions_.emplace(std::pair{std::string("funct"), own_id(b) + deck_.offset_of(b, "funct")},
                           i);
    definitions_.emplace(std::pair{b.schema->kind, b.id.value + deck_.offset_of(b, b.schema->kind)},
                         i);
  }
  for (const InterBase* inter : c.interfaces().all)
    if (std::find(interfaces.begin(), interfaces.end(), inter->id) != interfaces.end())
      keep_block(static_cast<std::size_t>(inter->block - deck_.blocks.data()), touching);
}

void Extraction::keep_block(std::size_t index, Level level) {
  if (visited_[index] >= level) return;
  visited_[index] = level;
  block_kept[index] = 1;
  queue_.push_back({index, level});
}

void Extraction::keep_block(std::string_view kind, std::int64_t id, Level level) {
  auto it = definitions_.find(std::pair{std::string(kind), id});
  if (it == definitions_.end() && set_may_stand_for(kind))
    it = definitions_.find(std::pair{std::string("set"), id});
  if (it != definitions_.end()) keep_block(it->second, level);
}

void Extraction::keep_node(NodeIndex n, bool touch) {
  if (n == no_index) return;
  node_kept[n] = 1;
  if (touch) touched_[n] = 1;
}

void Extraction::keep_element(ElementKind kind, std::uint32_t e, bool touch) {
  const Elements& family = model_.family(kind);
  if (e >= family.size()) return;
  element_kept[static_cast<std::size_t>(kind)][e] = 1;
  for (int i = 0; i < family.width; ++i) keep_node(family.of(e)[i], touch);
}

void Extraction::whole_part(std::uint32_t part, bool touch) {
  const std::uint8_t how = touch ? 2 : 1;
  if (part_whole_[part] >= how) return;
  part_whole_[part] = how;
  keep_block("part", model_.parts[part].id);
  for (const auto& [kind, e] : elements_of_part_[part]) keep_element(kind, e, touch);
}

void Extraction::everything() {
  for (std::uint32_t p = 0; p < model_.parts.size(); ++p) whole_part(p, true);
  for (std::size_t k = 0; k < element_families; ++k)
    for (std::uint32_t e = 0; e < element_kept[k].size(); ++e)
      keep_element(static_cast<ElementKind>(k), e, true);
  for (NodeIndex n = 0; n < node_kept.size(); ++n) keep_node(n, true);
}

/// `selects`: the reference selects elements, so the named item must stay complete.
void Extraction::reference(std::string_view kind, std::int64_t id, bool selects, bool touch) {
  if (kind == "node") return keep_node(model_.find_node(id), touch && selects);
  if (const auto family = family_of_kind(kind)) {
    if (const std::uint32_t e = model_.family(*family).map.find(id); e != no_index)
      keep_element(*family, e, touch);
    return;
  }
  keep_block(kind, id, !selects ? defined : touch ? touching : selected);
  if (!selects) return;
  const auto parts = [&](auto&& belongs) {
    for (std::uint32_t p = 0; p < model_.parts.size(); ++p)
      if (belongs(model_.parts[p])) whole_part(p, touch);
  };
  if (kind == "part") {
    if (const auto it = model_.part_of_id.find(id); it != model_.part_of_id.end())
      whole_part(it->second, touch);
  } else if (kind == "mat") {
    parts([&](const Part& p) { return p.mat_id == id; });
  } else if (kind == "prop") {
    parts([&](const Part& p) { return p.prop_id == id; });
  } else if (kind == "subset") {
    // The subset's own block names its children.
    parts([&](const Part& p) { return p.subset_id == id; });
  } else if (kind == "submodel") {
    parts([&](const Part& p) {
      for (std::int32_t s = p.submodel; s >= 0;
           s = deck_.submodels[static_cast<std::size_t>(s)].parent)
        if (const Submodel& m = deck_.submodels[static_cast<std::size_t>(s)];
            m.id + (m.parent < 0 ? 0
                                 : deck_.submodels[static_cast<std::size_t>(m.parent)].submodels) ==
            id)
          return true;
      return false;
    });
  }
}

void Extraction::process(const Task& task) {
  const Block& b = deck_.blocks[task.block];
  if (b.schema == nullptr || b.schema->bulk || b.opaque) return;
  const std::string& kind = b.schema->kind;
  const bool touch = task.level == touching;
  const DecodedBlock d = decode(deck_, b);
  // A subset named by a selection selects its children; a subset named by a part does not.
  const bool selects =
      kind == "inter" || is_selection(kind) || (kind == "subset" && task.level >= selected);
  for (const Reference& r : references_of(deck_, d)) {
    if (r.step == 0)
      reference(r.kind, r.id, selects, touch);
    else
      range(r, selects, touch);
  }
  if (kind == "set") clauses_without_ids(b, d);
  if (is_selection(kind)) {
    resolved(b, touch);
    if ((kind == "surf" || kind == "line") && is_box_selection(b)) everything();
  }
  if (!b.schema->layout_known()) tokens(b, d);
}

/// Nodes of a group, surface, line or set, and elements of groups. Elements with segments and edges
/// stay because the block names them or, where a contact needs them, as neighbours().
void Extraction::resolved(const Block& b, bool touch) {
  const std::string& kind = b.schema->kind;
  const std::int64_t id = b.id.value + deck_.offset_of(b, kind);
  const auto nodes = [&](const auto& list) {
    for (const NodeIndex n : list) keep_node(n, touch);
  };
  const auto nodes_of = [&](const auto& items) {
    for (const auto& item : items) nodes(item.nodes);
  };
  if (kind == "grnod") {
    if (const NodeSet* group = selections_.node_group(id)) nodes(group->nodes);
  } else if (kind == "surf") {
    if (const Surface* surface = selections_.surface(id)) nodes_of(surface->segments);
  } else if (kind == "line") {
    if (const LineSet* line = selections_.line(id)) nodes_of(line->edges);
  } else if (kind == "set") {
    if (const SetGeneral* set = selections_.set(id)) {
      nodes(set->nodes);
      nodes_of(set->segments);
      nodes_of(set->edges);
    }
  } else if (const auto* group = selections_.element_group(kind, id)) {
    if (const auto family = family_of_group(kind))
      for (const std::uint32_t e : *group) keep_element(*family, e, touch);
  }
}

// ---- sets ---------------------------------------------------------------------------------------

void Extraction::clauses_without_ids(const Block& b, const DecodedBlock& d) {
  for (const DecodedCard& card : d.cards) {
    if (card.cells.empty() || card.cells[0].blank()) continue;
    const SetClause clause = set_clause(card.cells[0].text);
    if (clause.name == "ALL" || clause.name == "BOX" || clause.name == "BOX2" ||
        clause.options.find('B') != clause.options.npos)
      everything();
    if (clause.name == "RBODY")
      open_questions.push_back("/SET " + std::to_string(b.id.value) +
                               " selects rigid bodies, which were not carried");
  }
}

/// Every existing id in the range.
void Extraction::range(const Reference& r, bool selects, bool touch) {
  if (r.kind == "node") {
    for (NodeIndex n = 0; n < model_.nodes.size(); ++n)
      if (r.covers(model_.nodes.id[n])) keep_node(n, touch);
  } else if (const auto family = family_of_kind(r.kind)) {
    const Elements& all = model_.family(*family);
    for (std::uint32_t e = 0; e < all.size(); ++e)
      if (r.covers(all.id[e])) keep_element(*family, e, touch);
  } else {
    for (const auto& [key, index] : definitions_)
      if (key.first == r.kind && r.covers(key.second))
        reference(r.kind, key.second, selects, touch);
  }
}

// ---- text that no schema describes --------------------------------------------------------------

/// Functions, axes and sensors in undescribed text: every whole number that could be an id counts
/// as one. Too many are harmless, too few are not.
void Extraction::tokens(const Block& b, const DecodedBlock& d) {
  if (b.schema->kind != "mat" && b.schema->kind != "prop" && b.schema->kind != "sensor" &&
      b.schema->kind != "other")
    return;
  const auto keep_named = [&](const Line& line, std::size_t begin, std::size_t end) {
    const std::string_view token = line.text.substr(begin, end - begin);
    const std::int64_t id = read_integer(token).value;
    if (token.find_first_not_of("0123456789") != std::string_view::npos || id <= 0) return false;
    for (const std::string_view kind : {"funct", "skew", "sensor"})
      keep_block(kind, id + deck_.offset_of(b, kind));
    if (b.schema->kind == "prop") keep_block("mat", id + deck_.offset_of(b, "mat"));
    return false;  // continue
  };
  for (const DecodedCard& card : d.cards)
    if (!card.missing()) find_words(card.line, {}, keep_named);
  for (const Line& line : d.extra) find_words(line, {}, keep_named);
}

// ---- from the selections to everything around them ----------------------------------------------

std::int64_t Extraction::id_of(const Block& bulk, const ItemLines& item) const {
  const Field& f = item.cards()[0]->fields[0];
  std::int64_t id = 0;
  if (item.plain(0)) {
    id = read_integer(columns(item.lines()[0].text, f.first, f.last)).value;
  } else if (const DecodedCard card = item.decoded(0); !card.cells.empty()) {
    id = card.cells[0].integer;
  }
  return deck_.shifted_id(bulk, bulk.schema->kind, id);
}

bool Extraction::keeps(const Block& bulk, const ItemLines& item) const {
  const auto family = family_of_kind(bulk.schema->kind);
  const IdMap& map = family ? model_.family(*family).map : model_.nodes.map;
  const std::uint32_t i = map.find(id_of(bulk, item));
  const auto& kept = family ? element_kept[static_cast<std::size_t>(*family)] : node_kept;
  return i != no_index && kept[i] != 0;
}

/// True if the block belongs to an item that stays and shares its id.
bool Extraction::names_kept(std::string_view kind, const Block& b) const {
  const auto it =
      definitions_.find(std::pair{std::string(kind), own_id(b) + deck_.offset_of(b, kind)});
  return it != definitions_.end() && block_kept[it->second] != 0;
}

void Extraction::keep_switches() {
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (is_switch(b) && b.submodel < 0) keep_block(i);
    // These depend on all nodes and their order.
    if (detail::is_below(b.header, "/CNODE") ||
        (detail::is_below(b.header, "/RANDOM") && model_.has_random))
      std::fill(node_kept.begin(), node_kept.end(), std::uint8_t{1});
  }
}

void Extraction::drain() {
  while (!queue_.empty()) {
    const Task task = queue_.front();
    queue_.pop_front();
    process(task);
  }
}

/// Elements with one of the nodes: each may carry a segment or decide a gap.
void Extraction::neighbours() {
  for (std::size_t k = 0; k < element_families; ++k) {
    const Elements& family = model_.family(static_cast<ElementKind>(k));
    const auto touches = [&](NodeIndex n) { return n != no_index && touched_[n] != 0; };
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      if (element_kept[k][e] != 0) continue;
      bool near = std::any_of(family.of(e), family.of(e) + family.width, touches);
      if (!near && e < family.extra.size() && family.extra[e] != no_index) {
        constexpr std::size_t most_mid_nodes = 12;
        const std::size_t first = family.extra[e];
        const std::size_t last = std::min(first + most_mid_nodes, family.extra_nodes.size());
        near = std::any_of(family.extra_nodes.begin() + static_cast<std::ptrdiff_t>(first),
                           family.extra_nodes.begin() + static_cast<std::ptrdiff_t>(last), touches);
      }
      if (near) element_kept[k][e] = 1;
    }
  }
}

/// Nodes, axes and parts of kept elements.
void Extraction::scan_elements() {
  for (const Block& b : deck_.blocks) {
    if (b.schema == nullptr || !b.schema->bulk) continue;
    const auto family = family_of_kind(b.schema->kind);
    if (!family) continue;
    const auto k = static_cast<std::size_t>(*family);
    const Elements& elements = model_.family(*family);
    ItemLines items(deck_, b);
    while (items.next()) {
      const std::uint32_t e = elements.map.find(id_of(b, items));
      if (e == no_index || element_kept[k][e] == 0 || scanned_[k][e] != 0) continue;
      scanned_[k][e] = 1;
      if (elements.part[e] != no_index) keep_block("part", model_.parts[elements.part[e]].id);
      for (std::size_t row = 0; row < items.cards().size(); ++row)
        for (const Cell& cell : items.decoded(row).cells) {
          if (cell.field->type != FieldType::id || cell.integer <= 0) continue;
          const std::string_view kind = cell.field->ref;
          const std::int64_t id = cell.integer + deck_.offset_of(b, kind);
          if (kind != "node") {
            keep_block(kind, id);
            continue;
          }
          // The node as written, and the one it was merged with.
          keep_node(model_.nodes.map.find(id), false);
          keep_node(model_.find_node(id), false);
        }
    }
  }
}

/// Transformations of kept nodes, with their groups.
void Extraction::transforms() {
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (!b.header.starts_with("/TRANSFORM/") || b.schema == nullptr || visited_[i] != 0) continue;
    const DecodedBlock d = decode(deck_, b);
    bool moves = d.integer("SUBMODEL") != 0;
    if (const std::int64_t group = d.integer("GR_NODE"); group > 0 && !moves)
      if (const NodeSet* set = selections_.node_group(group + deck_.offset_of(b, "grnod")))
        moves = std::any_of(set->nodes.begin(), set->nodes.end(),
                            [&](NodeIndex n) { return n != no_index && node_kept[n] != 0; });
    if (moves) keep_block(i);
  }
}

/// Blocks that change a function and have its id.
void Extraction::functions() {
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i)
    if (header_reference(deck_.blocks[i]) == "funct" && names_kept("funct", deck_.blocks[i]))
      keep_block(i);
}

/// Blocks of a material that have its id.
void Extraction::materials() {
  bool thermal = false;
  std::size_t first_thermal = deck_.blocks.size();
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (header_reference(b) != "mat") continue;
    const bool kept = names_kept("mat", b);
    if (kept) keep_block(i);
    if (!detail::is_below(b.header, "/HEAT/MAT")) continue;
    thermal = thermal || kept;
    const std::pair material{std::string("mat"), own_id(b) + deck_.offset_of(b, "mat")};
    if (first_thermal == deck_.blocks.size() && definitions_.contains(material)) first_thermal = i;
  }
  // Heat exchange needs a thermal material in the model.
  if (thermal || first_thermal == deck_.blocks.size()) return;
  const Block& b = deck_.blocks[first_thermal];
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i)
    if (block_kept[i] != 0 && deck_.blocks[i].schema != nullptr &&
        deck_.blocks[i].schema->kind == "inter" &&
        decode(deck_, deck_.blocks[i]).integer("Ithe") > 0) {
      keep_block(first_thermal);
      keep_block("mat", b.id.value + deck_.offset_of(b, "mat"));
      return;
    }
}

/// //SUBMODEL, its /BEGIN and //ENDSUB around kept blocks.
void Extraction::submodel_frames() {
  std::vector<std::uint8_t> wanted(deck_.submodels.size(), 0);
  const auto bulk_kept = [&](const Block& b) {
    for (ItemLines items(deck_, b); items.next();)
      if (keeps(b, items)) return true;
    return false;
  };
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (b.submodel < 0 || b.header.starts_with("//")) continue;
    const bool bulk = b.schema != nullptr && b.schema->bulk;
    if (bulk ? !bulk_kept(b) : block_kept[i] == 0) continue;
    for (std::int32_t s = b.submodel; s >= 0;
         s = deck_.submodels[static_cast<std::size_t>(s)].parent)
      wanted[static_cast<std::size_t>(s)] = 1;
  }
  std::vector<std::uint8_t> open;
  std::size_t next = 0;
  for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
    const Block& b = deck_.blocks[i];
    if (b.header.starts_with("//SUBMODEL") && next < wanted.size()) {
      open.push_back(wanted[next++]);
      block_kept[i] = open.back();
    } else if (b.header.starts_with("//ENDSUB")) {
      block_kept[i] = !open.empty() && open.back() != 0 ? 1 : 0;
      if (!open.empty()) open.pop_back();
    } else if (b.submodel >= 0 && wanted[static_cast<std::size_t>(b.submodel)] != 0 &&
               (detail::is_below(b.header, "/BEGIN") || detail::is_below(b.header, "/PARAMETER") ||
                detail::is_below(b.header, "/UNIT"))) {
      block_kept[i] = 1;
    }
  }
}

std::uint64_t Extraction::size() const {
  std::uint64_t n = 0;
  for (const auto* list : {&block_kept, &node_kept, &touched_, &visited_})
    for (const std::uint8_t v : *list) n += v;
  for (const auto& list : element_kept)
    for (const std::uint8_t v : list) n += v;
  return n;
}

void Extraction::run() {
  keep_switches();
  for (std::uint64_t before = 0, now = 1; before != now; now = size()) {
    before = size();
    drain();
    neighbours();
    scan_elements();
    transforms();
    materials();
    functions();
    drain();
  }
  // Merged nodes stay together.
  for (const auto& [a, b] : model_.merged_nodes)
    if (node_kept[a] != 0 || node_kept[b] != 0) node_kept[a] = node_kept[b] = 1;
  submodel_frames();
}

}  // namespace deck::detail
