// Engine files beside the deck: run name, times, listed ids.
#include "keyword/shared/engine_layout.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "deck/model.hpp"
#include "deck/text.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// "/RUN/car/1" or "/RERUN/car/1".
const EngineBlock* run_of(const EngineFile& file) {
  for (const EngineBlock& b : file.blocks)
    if (b.part(0) == "RUN" || b.part(0) == "RERUN") return &b;
  return nullptr;
}

std::vector<double> numbers_of(const LintContext& c, const EngineBlock& b) {
  std::vector<double> out;
  for (const Span& line : b.lines)
    for (const Span& cell : engine_cells(c.deck.sources, line)) {
      const RealCell number = read_real(c.text(cell));
      if (number.status != NumberStatus::ok && number.status != NumberStatus::implicit_exponent)
        return out;
      out.push_back(number.value);
    }
  return out;
}

/// Final time of the run; nullopt: unreadable, or /RERUN, which has none.
std::optional<double> final_time(const LintContext& c, const EngineFile& file) {
  const EngineBlock* run = run_of(file);
  if (run == nullptr || run->part(0) != "RUN") return std::nullopt;
  const std::vector<double> numbers = numbers_of(c, *run);
  const auto end = engine_layout(*run)->find(EngineCell::end);
  if (!end || numbers.size() <= *end || !(numbers[*end] > 0)) return std::nullopt;
  return numbers[*end];
}

/// Place for findings about missing keywords: the first line of the file.
Span first_line(const LintContext& c, const EngineFile& file) {
  const std::string_view line = c.deck.sources[file.file].line_at(0);
  return {file.file, static_cast<std::uint32_t>(line.size()), 0};
}

void check_run_missing(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const EngineFile& file : c.engine->files)
    if (run_of(file) == nullptr)
      r.report(rule, first_line(c, file), "the Engine file has neither /RUN nor /RERUN");
}

void check_run_name(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const EngineFile& file : c.engine->files) {
    const EngineBlock* run = run_of(file);
    if (run == nullptr || run->part(1) == c.engine->run) continue;
    r.report(rule, run->header,
             fmt::format("{} is not a run of this deck, which is named {}", clipped(run->keyword),
                         clipped(c.engine->run)));
  }
}

void check_run_number(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const EngineFile& file : c.engine->files) {
    const EngineBlock* run = run_of(file);
    if (run == nullptr) continue;
    const IntegerCell number = read_integer(run->part(2));
    if (number.status == NumberStatus::ok && number.value == file.number) continue;
    r.report(rule, run->header,
             fmt::format("{} is in the file of run {}", clipped(run->keyword), file.number));
  }
}

void check_final_time(const LintContext& c, const Rule& rule, Reporter& r) {
  std::optional<double> before;
  for (const EngineFile& file : c.engine->files) {
    const EngineBlock* run = run_of(file);
    if (run == nullptr || run->part(0) != "RUN") continue;
    const std::optional<double> end = final_time(c, file);
    const Span place = run->lines.empty() ? run->header : run->lines[0];
    if (run->lines.empty())
      r.report(rule, place, fmt::format("{} has no final time", clipped(run->keyword)));
    else if (!end)
      r.report(rule, place,
               fmt::format("the final time of {} is '{}'", clipped(run->keyword),
                           clipped(c.text(place))));
    else if (before && *end <= *before)
      r.report(rule, place,
               fmt::format("{} ends at {}, the run before it at {}", clipped(run->keyword),
                           number_text(*end), number_text(*before)));
    if (end) before = end;
  }
}

/// Ids listed after a keyword of an Engine file.
struct Listed {
  std::string_view what;                       ///< "interface"
  bool ranges = false;                         ///< first and last ids alternate
  std::size_t at_most = 0;                     ///< number of ids per line; 0: all
  std::vector<const Elements*> families = {};  ///< of elements
};

std::optional<Listed> listed(const LintContext& c, const EngineBlock& b) {
  if (b.part(0) == "DEL" && b.part(1) == "INTER") return Listed{"interface"};
  if (b.part(0) == "H3D" && b.part(1) == "PART") return Listed{"part"};
  if (b.part(0) == "ANIM" && b.part(1) == "SENSOR") return Listed{"sensor", false, 1};
  if (b.part(0) != "DEL") return std::nullopt;
  const Model& m = *c.model;
  Listed out{"element", b.part(2) == "1"};
  const std::string_view type = b.part(1);
  if (type == "BRICK") out.families = {&m.solid8};
  if (type == "QUAD") out.families = {&m.quad};
  if (type == "SHELL") out.families = {&m.shell4};
  if (type == "SH_3N") out.families = {&m.shell3, &m.tria};
  if (type == "TRUSS") out.families = {&m.truss};
  if (type == "BEAM") out.families = {&m.beam};
  if (type == "SPRING") out.families = {&m.spring};
  if (out.families.empty()) return std::nullopt;
  return out;
}

bool exists(const LintContext& c, const Listed& list, std::int64_t id) {
  for (const Elements* family : list.families)
    if (family->map.find(id) != no_index) return true;
  if (!list.families.empty()) return false;
  if (list.what == "interface") {
    const auto it = c.defined.find("inter");
    return it != c.defined.end() && it->second.count(id) > 0;
  }
  return list.what == "part" ? c.model->part_of_id.count(id) > 0 : c.model->sensors.count(id) > 0;
}

/// Sorted ids of element families, built on first use.
class SortedIds {
 public:
  bool any_between(const Elements* family, std::int64_t first, std::int64_t last) {
    auto& ids = sorted_[family];
    if (ids.empty()) {
      ids = family->id;
      std::sort(ids.begin(), ids.end());
    }
    const auto it = std::lower_bound(ids.begin(), ids.end(), first);
    return it != ids.end() && *it <= last;
  }

 private:
  std::map<const Elements*, std::vector<std::int64_t>> sorted_;
};

/// Some ids between the ends of a range may be missing, but not all.
void check_ranges(const LintContext& c, const Rule& rule, Reporter& r, const EngineBlock& b,
                  const Listed& list, SortedIds& ids) {
  for (const Span& line : b.lines) {
    const std::vector<Span> cells = engine_cells(c.deck.sources, line);
    for (std::size_t i = 0; i + 1 < cells.size(); i += 2) {
      const IntegerCell first = read_integer(c.text(cells[i]));
      const IntegerCell last = read_integer(c.text(cells[i + 1]));
      if (first.status != NumberStatus::ok || last.status != NumberStatus::ok ||
          (first.value == 0 && last.value == 0) ||  // an empty card
          std::any_of(list.families.begin(), list.families.end(), [&](const Elements* family) {
            return ids.any_between(family, first.value, last.value);
          }))
        continue;
      r.report(rule, cells[i],
               fmt::format("{} names {}s {} to {}, none of which exists", clipped(b.keyword),
                           list.what, first.value, last.value));
    }
  }
}

void check_ids(const LintContext& c, const Rule& rule, Reporter& r) {
  SortedIds ids;
  for (const EngineFile& file : c.engine->files) {
    for (const EngineBlock& b : file.blocks) {
      const std::optional<Listed> list = listed(c, b);
      if (!list) continue;
      if (list->ranges) check_ranges(c, rule, r, b, *list, ids);
      for (const Span& line : b.lines) {
        std::size_t n = 0;
        for (const Span& cell : engine_cells(c.deck.sources, line)) {
          if (list->at_most > 0 && n++ >= list->at_most) break;
          const IntegerCell id = read_integer(c.text(cell));
          const std::string name = clipped(b.keyword);
          if (id.status != NumberStatus::ok)
            r.report(rule, cell, fmt::format("'{}' in {} is no id", clipped(c.text(cell)), name));
          else if (!list->ranges && id.value != 0 && !exists(c, *list, id.value))
            r.report(
                rule, cell,
                fmt::format("{} names {} {}, which does not exist", name, list->what, id.value));
        }
      }
    }
  }
}

void check_outputs(const LintContext& c, const Rule& rule, Reporter& r) {
  double begin = 0;
  for (const EngineFile& file : c.engine->files) {
    const std::optional<double> end = final_time(c, file);
    if (!end) continue;
    for (const EngineBlock& b : file.blocks) {
      const bool states = (b.part(0) == "ANIM" || b.part(0) == "H3D") && b.part(1) == "DT";
      const bool history = b.part(0) == "TFILE" && b.part(1).size() <= 1;
      if (!states && !history) continue;
      const std::vector<double> n = numbers_of(c, b);
      const EngineLayout layout = engine_layout(b).value();
      const auto first = layout.find(EngineCell::first), every = layout.find(EngineCell::interval);
      if (!every || n.size() <= *every) continue;
      const double interval = n[*every];
      if (first && n[*first] > *end)
        r.report(rule, b.lines[0],
                 fmt::format("{} begins at {}, the run ends at {}", clipped(b.keyword),
                             number_text(n[*first]), number_text(*end)));
      else if (*end > begin && interval > *end - begin) {
        Finding& d =
            r.report(rule, b.lines[0],
                     fmt::format("{} writes every {}, the run takes {}", clipped(b.keyword),
                                 number_text(interval), number_text(*end - begin)));
        d.severity = Severity::info;
        d.reference_behaviour = "It writes the state at the start of the run only.";
      }
    }
    begin = *end;
  }
}

void check_late_interfaces(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.engine->files.empty()) return;
  std::optional<double> last;
  Span place;
  for (const EngineFile& file : c.engine->files) {
    const std::optional<double> end = final_time(c, file);
    if (!end) return;  // unknown end of the run
    if (!last || *end > *last) {
      last = end;
      place = run_of(file)->lines[0];
    }
  }
  for (const ContactCard& card : c.contacts) {
    const double start = card.value("Tstart");
    if (start < *last) continue;
    Finding& d = report_at(r, rule, card, "Tstart",
                           fmt::format("{} begins at {}, the last run ends at {}", name_of(card),
                                       number_text(start), number_text(*last)));
    d.notes.emplace_back(place, "the end of the last run");
  }
}

void check_includes(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const EngineFile& file : c.engine->files)
    for (const Span& line : file.includes)
      r.report(rule, line, "the Engine does not read what this line includes");
}

}  // namespace

std::vector<Checked> engine_checks() {
  return {{RuleId::DK800, check_run_missing},
          {RuleId::DK801, check_run_name},
          {RuleId::DK802, check_run_number},
          {RuleId::DK803, check_final_time},
          {RuleId::DK804, check_ids},
          {RuleId::DK805, check_outputs},
          {RuleId::DK806, check_late_interfaces},
          {RuleId::DK807, check_includes}};
}

}  // namespace deck::detail
