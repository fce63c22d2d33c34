// Collects the data for rules: decoded cards, definitions and references.
#include "lint/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <type_traits>

#include "base/shared/words.hpp"
#include "keyword/shared/references.hpp"

namespace deck {
namespace {

template <class T>
FieldView view_of(const Deck& deck, std::string_view name, const Effective<T>& e) {
  FieldView v;
  v.name = name;
  if constexpr (std::is_arithmetic_v<T>) {
    v.value = static_cast<double>(e.value);
    v.input = static_cast<double>(e.input);
  } else {
    // IBC: the three digits as one number.
    for (const char c : e.value) v.value = v.value * 10 + (c == '1' ? 1 : 0);
    for (const char c : e.input) v.input = v.input * 10 + (c == '1' ? 1 : 0);
  }
  v.has_input = e.has_input;
  v.origin = e.origin;
  v.span = e.span;
  if (e.span.valid()) v.text = detail::trim(deck.sources.text(e.span));
  return v;
}

/// Fields of a typed interface with the spans of their cells.
template <class Inter>
void add_fields(const Deck& deck, const Inter& inter, ContactCard& card) {
  inter.for_each([&](std::string_view name, const auto& effective) {
    FieldView v = view_of(deck, name, effective);
    if (const Cell* cell = card.decoded.find(name)) {
      v.span = cell->span;
      v.text = cell->text;
      v.field = cell->field;
    } else if (v.origin != Origin::default_block) {
      v.span = {};
      v.text = {};
    }
    card.fields.push_back(v);
  });
}

/// Cells without a member in the typed struct; all cells if there is none.
void add_plain_fields(ContactCard& card) {
  for (const DecodedCard& line : card.decoded.cards)
    for (const Cell& cell : line.cells) {
      if (card.find(cell.field->name) != nullptr) continue;
      FieldView v;
      v.name = cell.field->name;
      v.value = v.input = detail::number_of(cell);
      v.has_input = !cell.blank();
      v.origin = Origin::card;
      v.span = cell.span;
      v.text = cell.text;
      v.field = cell.field;
      card.fields.push_back(v);
    }
}

void bind(const Deck& deck, const InterBase& inter, ContactCard& card) {
  card.inter = &inter;
  card.type = inter.type;
  visit_interface(inter, [&](const auto& typed) { add_fields(deck, typed, card); });
  add_plain_fields(card);
}

}  // namespace

const FieldView* ContactCard::find(std::string_view name) const {
  for (const FieldView& f : fields)
    if (f.name == name) return &f;
  return nullptr;
}

double ContactCard::value(std::string_view name) const {
  const FieldView* f = find(name);
  return f ? f->value : 0;
}

std::int64_t ContactCard::flag(std::string_view name) const {
  const std::int64_t v = id(name);
  return v == 1000 ? 0 : v;
}

double ContactCard::input(std::string_view name) const {
  const FieldView* f = find(name);
  return f && f->has_input ? f->input : 0;
}

bool ContactCard::bounds(std::string_view name) const {
  constexpr double none = 1e20;
  return given(name) && std::abs(input(name)) < none;
}

Span ContactCard::span(std::string_view name) const {
  const FieldView* f = find(name);
  return f && f->span.valid() ? f->span : block->header_span;
}

std::string ContactCard::show(std::string_view name) const {
  const FieldView* f = find(name);
  if (f == nullptr) return std::string(name);
  const std::string head = std::string(name) + " = ";
  // Shows the value on the card even if the solver overrides it.
  if (f->has_input && !f->text.empty() && (f->input != 0 || f->origin == Origin::card))
    return head + std::string(f->text);
  const char* const source = f->origin == Origin::default_block ? " (from /DEFAULT/INTER)"
                             : f->origin == Origin::card        ? ""
                                                                : " (default)";
  return head + detail::number_text(f->value) + source;
}

namespace detail {

std::string number_text(double value) {
  if (value == std::floor(value) && std::fabs(value) < 1e15)
    return std::to_string(static_cast<std::int64_t>(value));
  return length_text(value);
}

std::vector<bool> nodes_of(const Model& model, const SegmentList& surface) {
  return marked(model, [&](auto&& mark) {
    surface.for_each([&](const Segment& s) {
      for (const NodeIndex n : s.nodes) mark(n);
    });
  });
}

Cell printout_level(const LintContext& c) {
  Cell out;
  for_each_block(c, "/IOFLAG", [&](const Block& b) {
    const DecodedBlock d = decode(c.deck, b);
    if (const Cell* cell = d.find("Ipri"); cell != nullptr && out.field == nullptr) out = *cell;
  });
  return out;
}

namespace {

template <class F>
bool any_field(const Schema& schema, F&& f) {
  return std::any_of(schema.cards.begin(), schema.cards.end(), [&](const CardSchema& card) {
    return std::any_of(card.fields.begin(), card.fields.end(), f);
  });
}

/// Ids in groups are checked where groups are resolved.
bool asks_for_targets(const Schema& schema) {
  const std::string_view kind = schema.kind;
  if (kind == "surf" || kind == "line" || kind == "set" || kind.starts_with("gr")) return false;
  return any_field(schema, [](const Field& f) {
    return f.missing || f.empty || f.required || f.wrong || f.acts_on;
  });
}

/// The kinds in LintContext::referenced; long lists of nodes and elements are not needed.
bool is_collected(std::string_view kind) {
  return kind == "grnod" || kind == "surf" || kind == "line" || kind == "friction";
}

void collect_references(LintContext& context, const DecodedBlock& block) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      if (cell.field->type != FieldType::id || cell.integer == 0) continue;
      const std::string_view kind = kind_of_id(block, cell);
      if (!is_collected(kind)) continue;
      const std::int64_t id = std::abs(cell.integer);
      context.referenced[kind].insert(context.resolved(*block.block, kind, id));
    }
}

}  // namespace

LintContext build_context(const LoadedDeck& loaded) {
  const Deck& deck = loaded.deck();
  LintContext context{deck,
                      loaded.schemas(),
                      &loaded.model(),
                      &loaded.interfaces(),
                      loaded.model().selections.get(),
                      &loaded,
                      {},
                      {},
                      {},
                      {},
                      {},
                      {},
                      {},
                      &loaded.engine_files()};
  std::map<const Block*, const InterBase*> typed;
  for (const InterBase* inter : loaded.interfaces().ordered) typed[inter->block] = inter;
  for (const Block& block : deck.blocks) {
    if (const Schema* s = block.schema; s != nullptr && !s->kind.empty() && s->has_id)
      context.defined[s->kind == "other" ? s->unique : s->kind].emplace(
          context.resolved(block, s->kind, block.id.value), &block);
    if (block.schema == nullptr || block.opaque || block.schema->bulk) continue;
    const std::string_view keyword = block.schema->keyword;
    const bool contact = keyword.starts_with("/INTER/") && keyword != "/INTER/SUB";
    const bool kept = contact || keyword == "/FRICTION" || keyword.starts_with("/DEFAULT/INTER/") ||
                      keyword.starts_with("/TH/") || asks_for_targets(*block.schema);
    if (!kept && !any_field(*block.schema, [](const Field& f) { return is_collected(f.ref); }))
      continue;
    DecodedBlock decoded = decode(deck, block);
    collect_references(context, decoded);
    if (contact || keyword == "/FRICTION") {
      ContactCard& card = (contact ? context.contacts : context.frictions).emplace_back();
      card.block = &block;
      card.decoded = std::move(decoded);
      if (const auto it = typed.find(&block); it != typed.end())
        bind(deck, *it->second, card);
      else
        add_plain_fields(card);
    } else if (keyword.starts_with("/DEFAULT/INTER/")) {
      context.defaults.push_back(std::move(decoded));
    } else if (keyword.starts_with("/TH/")) {
      context.histories.push_back(std::move(decoded));
    } else if (kept) {
      context.blocks_with_checked_ids.push_back(std::move(decoded));
    }
  }
  context.any_load_acts =
      std::any_of(context.blocks_with_checked_ids.begin(), context.blocks_with_checked_ids.end(),
                  [&](const DecodedBlock& d) { return acts_on(context, d).second; });
  return context;
}

}  // namespace detail
}  // namespace deck
