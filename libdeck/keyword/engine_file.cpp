// Finds the Engine files of a deck and splits them into keywords and lines.
#include "deck/keyword.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "keyword/shared/engine_layout.hpp"
#include "keyword/shared/include_scan.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

constexpr std::string_view starter_ending = "_0000.rad", packed_ending = ".gz";
constexpr int most_runs = 9999;  // the name has four digits

std::string_view without(std::string_view text, std::string_view ending) {
  return text.substr(0, text.size() - ending.size());
}

/// `text`: a line of the file; `offset`: its position.
void add_line(EngineFile& out, std::string_view text, std::uint64_t offset) {
  text = detail::trim_right(text);
  const Span span{out.file, static_cast<std::uint32_t>(text.size()), offset};
  if (text.starts_with("#include"))
    out.includes.push_back(span);
  else if (text.empty() || text[0] == '#' || text[0] == '$')
    return;
  else if (text[0] == '/')
    out.blocks.push_back({text, span, {}});
  else if (!out.blocks.empty())
    out.blocks.back().lines.push_back(span);
}

EngineFile cut(const Source& source, std::uint32_t file, int number) {
  EngineFile out;
  out.file = file;
  out.number = number;
  const std::string_view bytes = source.bytes();
  for (std::size_t at = 0; at < bytes.size();) {
    const auto end = std::min(bytes.find('\n', at), bytes.size());
    add_line(out, bytes.substr(at, end - at), at);
    at = end + 1;
  }
  return out;
}

}  // namespace

std::string_view EngineBlock::part(std::size_t n) const {
  std::size_t begin = 1;  // after the first slash
  for (; n > 0; --n) {
    begin = keyword.find('/', begin);
    if (begin == std::string_view::npos) return {};
    ++begin;
  }
  return keyword.substr(begin, keyword.find('/', begin) - begin);
}

std::vector<std::string> engine_files_beside(std::string_view deck) {
  std::vector<std::string> out;
  const bool packed = deck.ends_with(packed_ending);
  if (packed) deck = without(deck, packed_ending);
  for (int number = 1; number <= most_runs && deck.ends_with(starter_ending); ++number) {
    std::string name = fmt::format("{}_{:04}.rad", without(deck, starter_ending), number);
    std::error_code ec;
    if (packed && !std::filesystem::exists(name, ec)) name += packed_ending;
    if (!std::filesystem::exists(name, ec)) break;
    out.push_back(std::move(name));
  }
  return out;
}

EngineFiles read_engine_files(Deck& deck, const Limits& limits) {
  EngineFiles out;
  std::string_view path = deck.sources[0].path();
  if (path.ends_with(packed_ending)) path = without(path, packed_ending);
  if (!path.ends_with(starter_ending)) return out;
  out.run = std::filesystem::path(without(path, starter_ending)).filename().string();
  if (out.run.empty()) return out;
  Limits small = limits;
  small.total_bytes = std::min(limits.total_bytes, limits.map_threshold);
  int number = 0;
  for (const std::string& name : engine_files_beside(deck.sources[0].path())) {
    if (++number > limits.files) break;
    auto source = Source::open_text(name, small);
    if (!source) {
      std::string why = source.error().message;
      if (why.starts_with(name + ": ")) why.erase(0, name.size() + 2);
      out.unread.push_back({name, std::move(why)});
      continue;
    }
    const std::uint32_t file = deck.sources.add(std::move(*source));
    detail::note_lint_markers(deck, file);
    out.files.push_back(cut(deck.sources[file], file, number));
  }
  return out;
}

std::string starter_of_engine_file(std::string_view path) {
  constexpr std::string_view ending = ".rad";
  const bool packed = path.ends_with(packed_ending);
  const std::string_view name = packed ? without(path, packed_ending) : path;
  if (name.size() <= starter_ending.size() || !name.ends_with(ending)) return {};
  const std::string_view stem = without(name, starter_ending);
  const std::string_view number = name.substr(stem.size() + 1, 4);
  if (name[stem.size()] != '_' || number == "0000" ||
      number.find_first_not_of("0123456789") != std::string_view::npos)
    return {};
  return std::string(stem) + std::string(starter_ending) +
         std::string(packed ? packed_ending : std::string_view());
}

std::vector<Span> engine_cells(const SourceSet& sources, Span line) {
  constexpr std::string_view between = " \t,";
  const std::string_view text = sources.text(line);
  std::vector<Span> out;
  for (std::size_t at = text.find_first_not_of(between); at < text.size();) {
    const auto end = std::min(text.find_first_of(between, at), text.size());
    out.push_back({line.file, static_cast<std::uint32_t>(end - at), line.offset + at});
    at = std::min(text.find_first_not_of(between, end), text.size());
  }
  return out;
}

// ---- the Engine keywords whose lines are known -------------------------------------------------

namespace {

struct EngineRow {
  std::vector<std::string_view> keywords;
  EngineLayout layout;
};

using enum EngineCell;

/// The first matching row applies.
const std::vector<EngineRow>& engine_rows() {
  static const std::vector<EngineRow> rows = {
      {{"/RUN"}, {{end}}},
      {{"/TFILE"}, {{interval}}},
      {{"/RFILE"}, {{plain, plain}}},
      {{"/ANIM/DT", "/H3D/DT"}, {{first, interval, time}}},
      {{"/OUTP/DT", "/STATE/DT", "/DYNAIN/DT"}, {{first, interval}}},
      {{"/DT/NODA"}, {{plain, time, plain}}},
      {{"/DT", "/DYREL"}, {{plain, time}}},
      {{"/DTIX", "/IMPL/DT/STOP"}, {{time, time}}},
      {{"/IMPL/DTINI"}, {{time}}},
      {{"/IMPL/DT"}, {}},  // unknown cells
      {{"/INIV/TRA"}, {{speed}, true}},
      {{"/PRINT", "/H3D/COMPRESS"}, {{plain}}},
      {{"/STOP"}, {{plain, plain, plain, plain, plain, plain}}},
      {{"/TITLE", "/ANIM/SHELL", "/ANIM/BRICK", "/ANIM/ELEM", "/ANIM/VECT", "/ANIM/NODA",
        "/H3D/PART", "/IMPL", "/DEL", "/RBODY", "/BCS"},
       {{}, true}},
  };
  return rows;
}

}  // namespace

std::optional<std::size_t> EngineLayout::find(EngineCell cell) const {
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] == cell) return i;
  return std::nullopt;
}

std::optional<EngineLayout> engine_layout(const EngineBlock& block) {
  for (const EngineRow& row : engine_rows())
    for (const std::string_view keyword : row.keywords)
      if (detail::is_below(block.keyword, keyword)) return row.layout;
  return std::nullopt;
}

}  // namespace deck
