// Completion: keywords, whole cards, flag values with meaning, ids with titles, include files.
// Inserted text keeps the columns.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "edit/shared/layout.hpp"
#include "lint/shared/topics.hpp"
#include "lsp/view.hpp"

namespace deck::lsp {
namespace {

constexpr std::size_t most_items = 1000;
enum Kind : int {
  kind_file = 17,
  kind_keyword = 14,
  kind_snippet = 15,
  kind_value = 20,
  kind_reference = 18
};

class Completion {
 public:
  Completion(const View& view, std::uint64_t offset) : view_(view), offset_(offset) {
    const LineTable& lines = view.syntax->lines(view.file);
    begin_ = lines.start(lines.line_of(offset));
    line_ = lines.line(view.text(), lines.line_of(offset));
    before_ = line_.substr(0, offset - begin_);
  }
  Json run() {
    const auto word = before_.find_first_not_of(" \t");
    if (word != before_.npos && before_[word] == '/')
      keywords(word);
    else if (before_.starts_with("#inc"))
      files();
    else
      cells();
    const bool cut = items_.size() > most_items;
    if (cut) items_.erase(items_.begin() + most_items, items_.end());
    return {{"isIncomplete", cut}, {"items", std::move(items_)}};
  }

 private:
  Json edit(std::uint64_t begin, std::uint64_t end, const std::string& text) const {
    return {{"range", view_.range(view_.file, begin, end)}, {"newText", utf8(text)}};
  }
  void keywords(std::size_t word) {
    // Before the caret, and the rest of the word after it.
    std::size_t end = before_.size();
    while (end < line_.size() && static_cast<unsigned char>(line_[end]) > ' ') ++end;
    const int version = version_here();
    for (const Schema* s : view_.schemas().all()) {
      if (s->from > version) continue;
      Json item = {
          {"label", s->keyword},
          {"kind", kind_keyword},
          {"detail", utf8(s->doc)},
          {"filterText", s->keyword},
          {"textEdit", edit(begin_ + word, begin_ + end, s->keyword + (s->has_id ? "/" : ""))}};
      items_.push_back(std::move(item));
      if (s->bulk || s->cards.empty() || !view_.client.snippets) continue;
      items_.push_back({{"label", s->keyword + " …"},
                        {"kind", kind_snippet},
                        {"detail", "all lines, with headings"},
                        {"filterText", s->keyword},
                        {"sortText", s->keyword + "~"},
                        {"insertTextFormat", 2},
                        {"insertTextMode", 1},
                        {"textEdit", edit(begin_ + word, begin_ + end, snippet(*s, version))}});
    }
  }
  int version_here() const {
    const std::int64_t b = view_.syntax->index.find(view_.file, begin_);
    return b < 0 ? view_.deck.version : view_.deck.blocks[static_cast<std::size_t>(b)].version;
  }
  static std::string snippet(const Schema& s, int version) {
    const std::string header = s.keyword + (s.has_id ? "/@1@" : "");
    const std::string card = new_card(s, header, version, "@2@");
    std::string out;
    bool stop = false;
    for (std::size_t i = 0; i < card.size(); ++i) {
      if (card.compare(i, 3, "@1@") == 0) {
        out += "${1:id}";
        i += 2;
      } else if (card.compare(i, 3, "@2@") == 0) {
        out += "${2:title}";
        i += 2;
      } else if (!stop && card[i] == ' ' && i > 0 && card[i - 1] == '\n') {
        out += "$0 ";  // the first line of values
        stop = true;
      } else {
        if (card[i] == '$' || card[i] == '}' || card[i] == '\\') out += '\\';
        out += card[i];
      }
    }
    while (out.ends_with('\n')) out.pop_back();
    return out;
  }
  void files() {
    namespace fs = std::filesystem;
    auto name = std::min(before_.find_first_of(" \t"), before_.size());
    name = std::min(before_.find_first_not_of(" \t", name), before_.size());
    if (name == before_.size() && !before_.ends_with(' ')) return;
    const std::string written(before_.substr(name));
    const auto slash = written.rfind('/');
    const std::string folder = slash == written.npos ? "" : written.substr(0, slash + 1);
    fs::path where(folder);
    if (!where.is_absolute()) where = fs::path(view_.path).parent_path() / where;
    std::error_code ec;
    std::vector<fs::path> found;
    for (fs::directory_iterator it(where, ec), end; !ec && it != end; it.increment(ec))
      found.push_back(it->path());
    std::sort(found.begin(), found.end());
    for (const fs::path& p : found) {
      const bool directory = fs::is_directory(p, ec);
      const std::string text = folder + p.filename().string() + (directory ? "/" : "");
      items_.push_back({{"label", utf8(text)},
                        {"kind", directory ? 19 : static_cast<int>(kind_file)},
                        {"textEdit", edit(begin_ + name, begin_ + line_.size(), text)}});
      if (items_.size() > most_items) return;
    }
  }
  // ---- cells ----------------------------------------------------------------------------------
  void cells() {
    const PlacedLine line = view_.line_at(offset_);
    if (line.what != PlacedLine::What::card || line.card.free_format) return;
    const Block& block = view_.deck.blocks[static_cast<std::size_t>(line.block)];
    // The column before the caret if text was typed there, else the next.
    const int column = static_cast<int>(offset_ - begin_);
    const bool typed =
        column > 0 && static_cast<std::size_t>(column) <= line_.size() &&
        static_cast<unsigned char>(line_[static_cast<std::size_t>(column - 1)]) > ' ';
    const Cell* cell = line.cell_at(typed ? column : column + 1);
    if (cell == nullptr || cell->field == nullptr) return;
    const CellColumns at = columns_of(line.card, *cell);
    if (cell->field->type == FieldType::id)
      ids(block, *cell, at);
    else
      values(*cell, at);
  }
  /// A cell with right-aligned text; the edit includes the blanks before it.
  Json cell_item(const CellColumns& at, const std::string& text) const {
    const auto first = static_cast<std::size_t>(at.first - 1),
               last = static_cast<std::size_t>(at.last);
    const std::size_t from = std::min(first, line_.size()), to = std::min(last, line_.size());
    const std::size_t width = last - first;
    const std::string padded =
        std::string(first - from + width - std::min(width, text.size()), ' ') + text;
    return edit(begin_ + from, begin_ + std::max(to, from), padded);
  }
  void values(const Cell& cell, const CellColumns& at) {
    const Field& f = *cell.field;
    std::size_t n = 0;
    const std::string help = field_help(f, view_.schemas(), 80);
    const auto add = [&](std::int64_t value, const std::string& meaning) {
      const std::string text = std::to_string(value);
      Json item = {{"label", text},
                   {"kind", kind_value},
                   {"detail", utf8(f.name + (meaning.empty() ? "" : ": " + meaning))},
                   {"filterText", text},
                   {"sortText", fmt::format("{:04}", n++)},
                   {"textEdit", cell_item(at, text)}};
      if (!help.empty()) item["documentation"] = markup(view_, "```text\n" + help + "```\n");
      items_.push_back(std::move(item));
    };
    if (f.type == FieldType::flag) {
      add(0, "");
      add(1, f.doc);
    }
    for (const std::int64_t v : f.values) {
      std::string meaning = meaning_of_value(f, v);
      if (v == 0 && meaning.empty() && !f.default_text.empty())
        meaning = "default: " + f.default_text;
      add(v, meaning);
    }
  }
  void ids(const Block& of, const Cell& cell, const CellColumns& at) {
    const std::string& kind = cell.field->ref;
    constexpr std::string_view may_be_sets[] = {"grnod", "surf", "line", "grpart"};
    const bool sets =
        std::find(std::begin(may_be_sets), std::end(may_be_sets), kind) != std::end(may_be_sets);
    const std::int64_t offset = view_.deck.offset_of(of, kind);
    std::vector<std::pair<std::int64_t, const Block*>> found;
    for (const Block& b : view_.deck.blocks)
      if (b.schema != nullptr && !b.schema->bulk && b.schema->has_id &&
          (b.schema->kind == kind || (sets && b.schema->kind == "set")))
        if (const std::int64_t id = id_of(view_.deck, b) - offset; id > 0)
          found.emplace_back(id, &b);
    std::sort(found.begin(), found.end());
    for (const auto& [id, b] : found) {
      const std::string text = std::to_string(id), title = title_of(view_.deck, *b);
      if (text.size() > static_cast<std::size_t>(at.last - at.first + 1)) continue;
      items_.push_back({{"label", text},
                        {"labelDetails", {{"description", utf8(title)}}},
                        {"kind", kind_reference},
                        {"detail", utf8(std::string(b->keyword) + " " + title)},
                        {"filterText", utf8(text + " " + title)},
                        {"sortText", fmt::format("{:012}", id)},
                        {"textEdit", cell_item(at, text)}});
      if (items_.size() > most_items) return;
    }
  }
  const View& view_;
  std::uint64_t offset_, begin_ = 0;
  std::string_view line_, before_;
  Json items_ = Json::array();
};

}  // namespace

Answer completion(const View& view, const Json& params) {
  return Completion(view, view.offset(params.at("position"))).run();
}

}  // namespace deck::lsp
