// Reads fields of interfaces, /DEFAULT/INTER and /FRICTION blocks.
#include "model/interfaces_card.hpp"

#include <algorithm>
#include <charconv>

#include "deck/text.hpp"
#include "keyword/shared/solver_order.hpp"

namespace deck {

const Effective<std::int64_t>* DefaultInter::find(std::string_view field) const {
  for (const auto& [name, value] : values)
    if (name == field) return &value;
  return nullptr;
}

const Friction* Interfaces::friction(std::int64_t id) const {
  for (const Friction& f : frictions)
    if (f.id == id) return &f;
  return nullptr;
}

const DefaultInter* Interfaces::defaults_of(int type) const {
  for (const DefaultInter& d : defaults)
    if (d.type == type) return &d;
  return nullptr;
}

namespace detail {
namespace {

constexpr std::string_view default_prefix = "/DEFAULT/INTER/TYPE";

void report_default(Findings& findings, const Block& block, RuleId rule, std::string message,
                    const Span* earlier = nullptr) {
  if (!findings.wants(rule)) return;
  Finding d = make_finding(rule, block.header_span, std::move(message));
  d.keyword = block.schema->keyword;
  if (earlier != nullptr) d.notes.emplace_back(*earlier, "the first one is here");
  findings.add(std::move(d));
}

DefaultInter read_default(const Deck& deck, const Block& block, int type) {
  DefaultInter out;
  out.type = type;
  out.span = block.header_span;
  const DecodedBlock decoded = decode(deck, block);
  for (const DecodedCard& card : decoded.cards)
    for (const Cell& cell : card.cells) {
      if (cell.integer == 0 || cell.field->ignored) continue;
      Effective<std::int64_t> value;
      value.value = value.input = cell.integer;
      // Old manuals list 3 for "no deletion".
      if (type == 19 && cell.field->name == "Idel" && cell.integer == 3) value.value = 1000;
      value.has_input = true;
      value.origin = Origin::default_block;
      value.span = cell.span;
      out.values.emplace_back(cell.field->name, value);
    }
  return out;
}

/// The values of one part pair (or the global ones) from the cells with `suffix`.
class FrictionCells {
 public:
  FrictionCells(const Deck& deck, const DecodedBlock& block, const Friction& friction)
      : deck_(deck), block_(block), friction_(friction) {}

  void coefficients(const DecodedCard& card, FrictionValues& out) const {
    for (std::size_t i = 0; i < std::min<std::size_t>(card.cells.size(), 5); ++i)
      out.C[i] = working_value(deck_, block_, card.cells[i]);
  }
  void friction(const DecodedCard& card, FrictionValues& out) const {
    if (card.cells.size() < 3) return;
    out.C[5] = working_value(deck_, block_, card.cells[0]);
    out.Fric = working_value(deck_, block_, card.cells[1]);
    out.VISF = working_value(deck_, block_, card.cells[2]);
    apply_visf(out);
  }
  /// VISF 0 is 1 with friction; the incremental formulation ignores VISF.
  void apply_visf(FrictionValues& v) const {
    if (v.VISF == 0 && (v.Fric != 0 || friction_.Ifric != 0)) v.VISF = 1;
    if (friction_.Iform == 2) v.VISF = 0;
  }

 private:
  const Deck& deck_;
  const DecodedBlock& block_;
  const Friction& friction_;
};

void read_pairs(const Deck& deck, const DecodedBlock& block, const FrictionCells& cells,
                Friction& out) {
  for (const DecodedCard& card : block.cards) {
    if (card.schema->repeat != Repeat::group || card.cells.empty()) continue;
    const std::string& first = card.cells[0].field->name;
    if (first == "grpart_ID1") {
      FrictionPair pair;
      pair.span = card.line.whole();
      for (const Cell& cell : card.cells) {
        const auto id = deck.shifted_id(*block.block, cell.field->ref, cell.integer);
        if (cell.field->name == "grpart_ID1") pair.grpart_ID1 = id;
        if (cell.field->name == "grpart_ID2") pair.grpart_ID2 = id;
        if (cell.field->name == "part_ID1") pair.part_ID1 = id;
        if (cell.field->name == "part_ID2") pair.part_ID2 = id;
        if (cell.field->name == "Idir") pair.Idir = static_cast<int>(cell.integer);
      }
      out.pairs.push_back(pair);
    } else if (!out.pairs.empty()) {
      FrictionPair& pair = out.pairs.back();
      if (first == "C1_pair") cells.coefficients(card, pair.values);
      if (first == "C6_pair") cells.friction(card, pair.values);
      if (first == "C1_dir2") cells.coefficients(card, pair.second);
      if (first == "C6_dir2") cells.friction(card, pair.second);
    }
  }
}

Friction read_friction(const Deck& deck, const Block& block) {
  const DecodedBlock decoded = decode(deck, block);
  Friction out;
  out.id = deck.shifted_id(block, "friction", block.id.value);
  out.title = decoded.title;
  out.span = block.header_span;
  out.Ifric = decoded.integer("Ifric");
  out.Ifiltr = decoded.integer("Ifiltr");
  out.Iform = decoded.integer("Iform");
  if (out.Iform == 0) out.Iform = 1;
  out.Xfreq = working_value(deck, decoded, "Xfreq");
  if (out.Xfreq == 0) out.Ifiltr = 0;
  const FrictionCells cells(deck, decoded, out);
  for (const DecodedCard& card : decoded.cards) {
    if (card.schema->repeat == Repeat::group || card.cells.empty()) continue;
    const std::string& first = card.cells[0].field->name;
    if (first == "C1") cells.coefficients(card, out.values);
    if (first == "C6") cells.friction(card, out.values);
  }
  read_pairs(deck, decoded, cells, out);
  return out;
}

}  // namespace

void InterfaceCard::head(int type, InterBase& out) const {
  const Block& block = *decoded_.block;
  out.id = deck_.shifted_id(block, "inter", block.id.value);
  out.type = type;
  out.title = decoded_.title;
  while (!out.title.empty() && out.title.front() == ' ') out.title.erase(0, 1);
  out.block = &block;
  out.span = block.header_span;
}

const Cell* InterfaceCard::find(std::string_view field) const {
  if (const Cell* cell = decoded_.find(field)) return cell;
  // Versions before 130: Rthe.
  return field == "Kthe" ? decoded_.find("Rthe") : nullptr;
}

template <class Value, class F>
void InterfaceCard::read_cell(std::string_view field, Effective<Value>& out, F&& value_of) const {
  const Cell* cell = find(field);
  if (cell == nullptr) return;
  out.span = cell->span;
  if (cell->blank()) return;
  out.has_input = true;
  out.value = out.input = value_of(*cell);
  out.origin = Origin::card;
}

void InterfaceCard::read(std::string_view field, EffectiveInt& out) const {
  read_cell(field, out, [&](const Cell& cell) {
    return cell.field->type == FieldType::id
               ? deck_.shifted_id(*decoded_.block, cell.field->ref, cell.integer)
               : cell.integer;
  });
}

void InterfaceCard::read(std::string_view field, EffectiveReal& out) const {
  read_cell(field, out, [&](const Cell& cell) { return working_value(deck_, decoded_, cell); });
}

void InterfaceCard::read(std::string_view field, EffectiveText& out) const {
  out.value = "000";
  for (int axis = 0; axis < 3; ++axis) {
    const Cell* cell = find(std::string(field) + "XYZ"[axis]);
    if (cell == nullptr) continue;
    if (!out.span.valid()) {
      out.span = cell->span;
    } else {
      out.span.length = static_cast<std::uint32_t>(
          std::max(cell->span.offset + cell->span.length, out.span.offset + out.span.length) -
          out.span.offset);
    }
    if (cell->blank()) continue;
    out.has_input = true;
    out.origin = Origin::card;
    if (cell->integer == 1) out.value[static_cast<std::size_t>(axis)] = '1';
  }
  out.input = out.has_input ? out.value : std::string();
}

std::vector<DefaultInter> read_defaults(const Deck& deck, Findings& findings) {
  std::vector<DefaultInter> out;
  for (const Block* const at : detail::in_solver_order(deck, "/DEFAULT/INTER")) {
    const Block& block = *at;
    if (block.schema == nullptr || block.schema->kind != "default_inter") continue;
    const std::string& keyword = block.schema->keyword;
    const std::string_view number = std::string_view(keyword).substr(default_prefix.size());
    int type = 0;
    std::from_chars(number.data(), number.data() + number.size(), type);
    if (block.submodel >= 0) {
      report_default(findings, block, RuleId::DK503, keyword + " inside a submodel has no effect");
      continue;
    }
    const auto earlier =
        std::find_if(out.begin(), out.end(), [&](const DefaultInter& d) { return d.type == type; });
    if (earlier != out.end()) {
      report_default(findings, block, RuleId::DK504, keyword + " is given twice", &earlier->span);
      continue;
    }
    out.push_back(read_default(deck, block, type));
  }
  return out;
}

std::vector<Friction> read_frictions(const Deck& deck) {
  std::vector<Friction> out;
  for (const Block* const block : detail::in_solver_order(deck, "/FRICTION"))
    if (block->schema != nullptr && block->schema->keyword == "/FRICTION")
      out.push_back(read_friction(deck, *block));
  return out;
}

}  // namespace detail
}  // namespace deck
