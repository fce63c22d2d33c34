// Last step of reading, after all files: blocks before /BEGIN, parameters in headers, submodel
// offsets, unit systems, encrypted blocks.
#include <algorithm>

#include "deck/text.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t no_block = static_cast<std::size_t>(-1);

void drop_before_begin(Deck& deck, ReaderNotes& notes) {
  if (notes.before_begin.empty()) return;
  // One file for Starter and Engine: the Engine part ends with /END/ENGINE.
  std::size_t engine_part = 0;
  for (const std::size_t i : notes.before_begin)
    if (deck.blocks[i].header == "/END/ENGINE") engine_part = i + 1;
  std::vector<Block> kept;
  std::vector<std::size_t> place(deck.blocks.size(), no_block);
  std::size_t k = 0;
  for (std::size_t i = 0; i < deck.blocks.size(); ++i) {
    if (k < notes.before_begin.size() && notes.before_begin[k] == i) {
      ++k;
      if (i >= engine_part)
        report(deck, RuleId::DK002, deck.blocks[i].header_span,
               std::string(deck.blocks[i].header) + " stands before /BEGIN",
               {.severity = Severity::warning,
                .solver = "It ignores everything before /BEGIN except /PARAMETER.",
                .fix = "Move the block after /BEGIN."});
      continue;
    }
    place[i] = kept.size();
    kept.push_back(std::move(deck.blocks[i]));
  }
  deck.blocks = std::move(kept);
  for (std::size_t& block : notes.submodel_blocks) block = place[block];
}

void report_wide(Deck& deck, const Span& span, const std::string& what) {
  report(deck, RuleId::DK335, span,
         what + " does not fit into 32 bits; " + "the nearest number that does is taken");
}

void resolve_header_parameters(Deck& deck) {
  for (Block& b : deck.blocks) {
    for (HeaderId* id : {&b.id, &b.unit_id}) {
      const std::string_view text = deck.sources.text(id->span);
      if (!text.starts_with('&')) {
        // Plain digits may exceed 64 bits.
        if (id->present && id->value == std::numeric_limits<std::int32_t>::max() &&
            text.find_last_not_of("0123456789") == std::string_view::npos &&
            text.substr(std::min(text.find_first_not_of('0'), text.size())) != "2147483647")
          report_wide(
              deck, id->span,
              std::string(b.header.substr(0, 60)) + ": the id " + std::string(text.substr(0, 40)));
        continue;
      }
      const Parameter* p = deck.find_parameter(text.substr(1), id->span.file);
      if (p != nullptr && p->valid && p->type != Parameter::Type::text) {
        id->value = saturated(as_integer(*p));
        if (id->value != as_integer(*p))
          report_wide(deck, id->span,
                      std::string(b.header.substr(0, 60)) + ": the id " +
                          std::to_string(as_integer(*p)) + " of parameter '" + std::string(text) +
                          "'");
      } else {
        report(deck, RuleId::DK018, id->span,
               "parameter '" + std::string(text) + "' is not defined here",
               {.solver = "it reads 0", .fix = "define it with /PARAMETER before its first use"});
      }
    }
  }
}

/// Limits the offsets of a submodel, including its parents', to the range of ids.
void fit_offsets(Deck& deck, Submodel& s) {
  bool reported = false;
  for (std::int64_t* offset : {&s.definitions, &s.nodes, &s.elements, &s.parts, &s.materials,
                               &s.properties, &s.submodels}) {
    const std::int64_t written = *offset;
    *offset = saturated(written);
    if (*offset == written || reported) continue;
    report_wide(deck, s.span,
                "//SUBMODEL/" + std::to_string(s.id) + ": the offset " + std::to_string(written));
    reported = true;
  }
}

void fill_submodels(Deck& deck, const ReaderNotes& notes) {
  for (std::size_t i = 0; i < deck.submodels.size(); ++i) {
    Submodel& s = deck.submodels[i];
    if (notes.submodel_blocks[i] != no_block) {
      const Block& block = deck.blocks[notes.submodel_blocks[i]];
      s.id = block.id.value;
      LineCursor cursor(deck.sources, block);
      s.title = std::string(trim_right(cursor.next().text.substr(0, 100)));
      const Line line = cursor.next();
      std::int64_t* const cells[7] = {&s.definitions, &s.nodes,      &s.elements, &s.parts,
                                      &s.materials,   &s.properties, &s.submodels};
      const bool free_format = is_free(line);
      const FreeCells free = free_format ? split_free(line) : FreeCells();
      for (std::size_t c = 0; c < 7; ++c) {
        const int first = 10 * static_cast<int>(c) + 1;
        *cells[c] = read_offset(deck, !free_format      ? line.columns(first, first + 9)
                                      : c < free.size() ? free[c].second
                                                        : line.columns(101, 101));
      }
      fit_offsets(deck, s);
      for (int c = 1; c < 7; ++c)
        if (*cells[c] == 0) *cells[c] = s.definitions;
    }
    if (s.parent < 0) continue;
    // Parents precede their children, so their offsets are complete.
    const Submodel& p = deck.submodels[static_cast<std::size_t>(s.parent)];
    s.definitions += p.definitions;
    s.nodes += p.nodes;
    s.elements += p.elements;
    s.parts += p.parts;
    s.materials += p.materials;
    s.properties += p.properties;
    s.submodels += p.submodels;
    fit_offsets(deck, s);
    if (!s.units && p.units) s.units = p.units;
  }
  if (notes.unclosed_submodel >= 0)
    report(deck, RuleId::DK035,
           deck.submodels[static_cast<std::size_t>(notes.unclosed_submodel)].span,
           "//SUBMODEL is not closed by //ENDSUB",
           {.solver = "everything below belongs to the submodel", .fix = "close it with //ENDSUB"});
}

/// /UNIT/LENGTH|MASS|TIME/code: global units in versions up to 90.
void read_global_unit(Deck& deck, const Block& b) {
  const char kind = b.header[6];
  const std::string_view code = trim(b.header.substr(b.header.rfind('/') + 1));
  const char base = kind == 'L' ? 'm' : kind == 'M' ? 'g' : 's';
  UnitSystem& u = deck.begin.input;
  if (const auto f = unit_factor(code, base)) {
    (kind == 'L' ? u.length : kind == 'M' ? u.mass : u.time) = *f;
    (kind == 'L' ? u.length_code : kind == 'M' ? u.mass_code : u.time_code) = code;
    deck.begin.has_input = true;
  } else {
    report(deck, RuleId::DK015, b.header_span,
           "'" + std::string(code) + "' in " + std::string(b.header) + " is not a unit",
           {.solver = "it stops with an error", .fix = "write for example /UNIT/LENGTH/mm"});
  }
}

bool is_global_unit(const Block& b) {
  return b.header.starts_with("/UNIT/LENGTH") || b.header.starts_with("/UNIT/MASS") ||
         b.header.starts_with("/UNIT/TIME");
}

void fill_begin_units(Deck& deck, const ReaderNotes& notes) {
  Begin& begin = deck.begin;
  const bool units_in_begin = begin.has_input || begin.has_working;
  const Block* global = nullptr;
  std::string missing = "LENGTH MASS TIME";
  if (!units_in_begin)
    for (const Block& b : deck.blocks)
      if (is_global_unit(b)) {
        read_global_unit(deck, b);
        global = &b;
        const std::string_view name = b.header.substr(6, b.header.find('/', 6) - 6);
        if (const auto at = missing.find(trim(name)); at != std::string::npos)
          missing.erase(at, trim(name).size());
      }
  if (!begin.has_input && begin.has_working) begin.input = begin.working;
  if (begin.has_input && !begin.has_working) begin.working = begin.input;
  if (notes.begin_count == 0) return;
  // /UNIT/LENGTH, MASS and TIME are read up to version 90 only.
  if (!units_in_begin && (global == nullptr || deck.version > 90))
    report(deck, RuleId::DK016, begin.span,
           global == nullptr ? "/BEGIN names neither input nor working units"
                             : "/BEGIN of version " + std::to_string(deck.version) +
                                   " names no units; those of " + std::string(global->header) +
                                   " are read up to version 90 only",
           {.solver = global == nullptr ? "it stops with an error"
                                        : "it stops with an error, or does not end"});
  else if (const auto lacks = trim(missing); global != nullptr && !lacks.empty())
    report(deck, RuleId::DK016, begin.span,
           "there is no /UNIT/" + std::string(lacks.substr(0, lacks.find(' '))) +
               ", which a deck of version " + std::to_string(deck.version) + " needs",
           {.solver = "it stops with an error", .fix = "write /UNIT/LENGTH, MASS and TIME"});
  else if (!(begin.input == begin.working))
    report(deck, RuleId::DK017, begin.span,
           "input units differ from working units: every value is converted");
}

void fill_units(Deck& deck, const ReaderNotes& notes) {
  for (const Block& b : deck.blocks) {
    if (is_global_unit(b) || !b.header.starts_with("/UNIT/")) continue;
    LineCursor cursor(deck.sources, b);
    cursor.next();  // title
    UnitSystem units;
    if (const Line line = cursor.next(); line.valid()) read_units(deck, line, units, true);
    deck.units[b.id.value + deck.offset_of(b, "unit")] = units;
  }
  fill_begin_units(deck, notes);
}

/// Checks /BEGIN: four lines; only blank ones may follow.
void check_begin(Deck& deck) {
  for (const Block& b : deck.blocks) {
    if (b.header != "/BEGIN") continue;
    LineCursor cursor(deck.sources, b);
    int have = 0;
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      if (++have <= 4 || line.text.empty()) continue;
      report(deck, RuleId::DK030, line.whole(),
             "/BEGIN is complete after four lines; this line is extra",
             {.fix = "delete the line, or add the keyword it belongs to"});
    }
  }
}

void mark_opaque(Deck& deck) {
  for (Block& b : deck.blocks) {
    if (!b.header.starts_with("/MAT") && !b.header.starts_with("/PROP") &&
        !b.header.starts_with("/FAIL") && !b.header.starts_with("/FUNCT"))
      continue;
    LineCursor cursor(deck.sources, b);
    cursor.next();
    const std::string_view text = cursor.next().text.substr(0, 200);
    // Encrypted: a full line without blanks that is not a number.
    if (text.size() < 60 || text.find(' ') != std::string_view::npos) continue;
    b.opaque = text.find_first_not_of("0123456789.,+-eEdD") != std::string_view::npos;
  }
}

}  // namespace

void report(Deck& deck, RuleId rule, Span span, std::string message, Overrides overrides) {
  if (deck.findings.wants(rule))
    deck.findings.add(make_finding(rule, span, std::move(message), std::move(overrides)));
}

void complete_deck(Deck& deck, ReaderNotes& notes, const ReadOptions& options) {
  const std::uint64_t main_size = deck.sources[0].bytes().size();
  if (notes.begin_count == 0)
    report(deck, RuleId::DK002, make_span(0, 0, 0),
           "no /BEGIN: version and units are unknown; version " + std::to_string(newest_version) +
               " is assumed",
           {.fix = "Start the deck with /BEGIN, run name, version and units."});
  else
    drop_before_begin(deck, notes);
  if (!deck.end_seen) {
    const bool open_line = main_size > 0 && deck.sources[0].bytes().back() != '\n';
    report(deck, RuleId::DK010, make_span(0, main_size, main_size),
           open_line ? "the main file has no /END and ends within a line: is it complete?"
                     : "the main file has no /END");
  }
  read_parameters(deck, options.limits);
  resolve_header_parameters(deck);
  fill_submodels(deck, notes);
  fill_units(deck, notes);
  mark_opaque(deck);
  check_begin(deck);
}

}  // namespace deck::detail
