// The times of Engine files in another unit system.
#include <fmt/format.h>

#include "deck/edit/convert.hpp"
#include "deck/text/number.hpp"
#include "edit/convert/units/unit_system_state.hpp"
#include "keyword/shared/engine_layout.hpp"

namespace deck {
namespace {

class EngineConverter {
 public:
  EngineConverter(const Deck& deck, const UnitSystem& target, bool accept, Rewrite& out)
      : deck_(deck),
        time_(detail::UnitFactors(deck.begin.working, target).time()),
        accept_(accept),
        out_(out) {}

  void convert(const EngineFile& file) {
    converted_ = 0;
    for (const EngineBlock& block : file.blocks)
      if (!block.lines.empty()) convert(block);
    LossEntry entry = entry_at(Loss::kept, Span{file.file, 0, 0});
    entry.note = converted_ == 0 ? "Engine file: no times to convert"
                                 : fmt::format("Engine file: {} {} converted", converted_,
                                               converted_ == 1 ? "time" : "times");
    out_.losses.push_back(std::move(entry));
  }

 private:
  void convert(const EngineBlock& block) {
    const std::optional<EngineLayout> layout = engine_layout(block);
    if (!layout) return undecided(block, block.header, "the cells of this keyword are not known");
    if (layout->list) return;
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
      const std::vector<Span> cells = engine_cells(deck_.sources, block.lines[i]);
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (i > 0 || k >= layout->cells.size())
          return undecided(block, cells[k], "this value of the keyword is not known");
        if (layout->cells[k] != EngineCell::plain) convert(block, cells[k]);
      }
    }
  }

  void convert(const EngineBlock& block, const Span& cell) {
    const std::string_view text = deck_.sources.text(cell);
    const RealCell value = read_real(text);
    if (value.status == NumberStatus::ok && value.value == 0) return;
    constexpr int width = 24;  // every double fits; lines of Engine files are in free format
    const auto scaled = detail::scale_text(text, width, time_);
    if (!scaled) return undecided(block, cell, "this is not a plain number");
    out_.edits.push_back({cell, scaled->text});
    ++converted_;
    if (scaled->exact) return;
    LossEntry entry = entry_at(Loss::approximated, cell);
    entry.keyword = std::string(block.keyword);
    entry.old_text = std::string(text);
    entry.new_text = scaled->text;
    entry.note = "no double holds the converted value exactly";
    out_.losses.push_back(std::move(entry));
  }

  void undecided(const EngineBlock& block, const Span& place, const std::string& why) {
    const std::string all = why + ", so it keeps its old units; convert it by hand";
    if (!accept_) {
      out_.refusals.push_back(deck_.sources.where(place) + ": " + std::string(block.keyword) +
                              ": " + why + ", so it cannot be brought to other units");
      return;
    }
    LossEntry entry = entry_at(Loss::undecided, place);
    entry.keyword = std::string(block.keyword);
    entry.note = all;
    out_.losses.push_back(std::move(entry));
  }

  LossEntry entry_at(Loss loss, const Span& place) const {
    LossEntry entry;
    entry.loss = loss;
    entry.file = deck_.sources[place.file].path();
    entry.line = deck_.sources.position(place).line;
    return entry;
  }

  const Deck& deck_;
  const detail::UnitFactor time_;
  bool accept_;
  Rewrite& out_;
  std::size_t converted_ = 0;
};

}  // namespace

void engine_to_units(const Deck& deck, const EngineFiles& engine, const UnitSystem& target,
                     const UnitsOptions& options, bool accept, Rewrite& out) {
  if (!detail::working_units_change(deck, target, options)) return;
  EngineConverter converter(deck, target, accept, out);
  for (const EngineFile& file : engine.files) converter.convert(file);
  for (const EngineFiles::Unread& file : engine.unread)
    out.refusals.push_back(file.path + ":1:1: the Engine file cannot be read: " + file.why);
  if (!out.refusals.empty()) out.edits.clear();
}

}  // namespace deck
