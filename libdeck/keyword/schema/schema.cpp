// SchemaSet: table of keywords and aliases, and search for the longest one that starts a header;
// legal words of a keyword. json.cpp reads the JSON.
#include "deck/keyword.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>

#include "base/shared/embedded.hpp"
#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "keyword/schema/json.hpp"
#include "keyword/shared/schema_facts.hpp"
#include "text/shared/columns.hpp"

namespace deck {
bool Condition::accepts(std::int64_t value) const {
  if (!in.empty() && std::find(in.begin(), in.end(), value) == in.end()) return false;
  if (std::find(not_in.begin(), not_in.end(), value) != not_in.end()) return false;
  return (!min || value >= *min) && (!max || value <= *max);
}

std::optional<int> Schema::stop(std::string_view demand) const {
  constexpr int of_mesh = 643, of_others = 659;
  if (const auto it = demands.find(demand); it != demands.end()) return it->second;
  if (demand != "unit") return std::nullopt;
  const auto converted = [](const Dimension& d) { return d.mass != 0 || d.length != 0 || d.time; };
  for (const auto& card : cards)
    for (const auto& field : card.fields)
      if (bulk || converted(field.dimension) || !field.dimension_when.empty() ||
          (field.type == FieldType::real && !field.dimension_known))
        return bulk ? of_mesh : of_others;
  if (cards.empty() || !layout_known()) return std::nullopt;
  return goes_on;
}

const Field* Schema::find_field(std::string_view name) const {
  // A field may be listed once per layout; the newest one counts.
  const Field* best = nullptr;
  int best_until = -1;
  for (const auto& card : cards)
    for (const auto& field : card.fields)
      if (const int until = std::min(card.until, field.until);
          field.name == name && until > best_until) {
        best = &field;
        best_until = until;
      }
  return best;
}

/// A schema or its text, parsed at the first use. Threads may share entries.
struct SchemaSet::LazySchema {
  std::string keyword;
  std::string source;
  const char* text = nullptr;  ///< text of built-in schemas, never freed

  explicit LazySchema(Schema parsed)
      : keyword(parsed.keyword), source(parsed.source), schema_(std::move(parsed)), ready_(true) {}
  LazySchema(std::string_view name, const detail::EmbeddedSchema& schema)
      : keyword(name), source(schema.file), text(schema.text) {}

  const Schema& get() const {
    if (!ready_.load(std::memory_order_acquire)) {
      // Not std::call_once: if memory runs out in it, the C library cannot load its unwinder and
      // ends the process.
      const std::lock_guard lock(parsing_);
      if (!ready_.load(std::memory_order_relaxed)) {
        // Cannot fail: the build has checked the text.
        if (auto parsed = detail::read_checked_schema(source, text)) schema_ = std::move(*parsed);
        ready_.store(true, std::memory_order_release);
      }
    }
    return schema_;
  }

 private:
  mutable std::mutex parsing_;
  mutable Schema schema_;
  mutable std::atomic<bool> ready_ = false;
};

const SchemaSet& SchemaSet::built_in() {
  static const SchemaSet set = [] {
    SchemaSet all;
    for (const auto& schema : detail::embedded_schemas()) {
      const auto names = detail::parts_of(schema.names, '\n');
      const auto entry = std::make_shared<const LazySchema>(names.front(), schema);
      for (const std::string_view name : names) all.by_name_.emplace(name, entry);
    }
    return all;
  }();
  return set;
}

Result<void> SchemaSet::add_json(std::string_view name, std::string_view text) {
  auto parsed = detail::read_schemas(name, text);
  if (!parsed) return parsed.error();

  // Builds the new table first, so that a bad file does not change the set.
  auto table = by_name_;
  std::set<std::string> fresh;
  for (auto& [schema, json] : *parsed) {
    const bool described = json.find("\"cards\"") != std::string::npos;
    std::vector<std::string> names = schema.aliases;
    names.insert(names.begin(), schema.keyword);
    const auto added = std::make_shared<const LazySchema>(std::move(schema));
    if (const auto it = table.find(added->keyword); it != table.end() &&
                                                    it->second->keyword == added->keyword &&
                                                    !fresh.count(added->keyword)) {
      // Keywords without cards are not checked.
      if (!it->second->get().cards.empty() && !described)
        return Error{Error::Code::config,
                     fmt::format("{}: {} replaces a schema with cards ({}) but has none; describe "
                                 "its lines, or write \"cards\": [] if its lines need not be read",
                                 name, added->keyword, it->second->source)};
      std::erase_if(table, [old = it->second](const auto& entry) { return entry.second == old; });
    }
    for (const auto& key : names) {
      const auto [it, inserted] = table.emplace(key, added);
      if (!inserted)
        return Error{Error::Code::config,
                     fmt::format("{}: {} of {} already names {} ({})", name, key, added->keyword,
                                 it->second->keyword, it->second->source)};
      fresh.insert(key);
    }
  }
  by_name_ = std::move(table);
  return {};
}

Result<void> SchemaSet::add_directory(const std::string& dir) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator it(dir, error), end; !error && it != end;
       it.increment(error))
    if (it->path().extension() == ".json") files.push_back(it->path());
  if (error)
    return Error{Error::Code::io,
                 fmt::format("{}: cannot list the schema directory: {}", dir, error.message())};
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    const auto source = Source::open(path.string(), Limits{});
    if (!source) return source.error();
    if (auto added = add_json(path.string(), (*source)->bytes()); !added) return added;
  }
  return {};
}

const Schema* SchemaSet::match(std::string_view header) const {
  header = detail::trim(header);
  if (header.empty() || header.front() != '/') return nullptr;
  // "/ SHELL/1" is not a keyword: the solver expects the name directly after the slash.
  if (header.size() > 1 && detail::is_blank(header[1])) return nullptr;
  const LazySchema* best = nullptr;
  std::string prefix;
  for (std::size_t begin = 1; begin <= header.size();) {
    const auto end = std::min(header.find('/', begin), header.size());
    const auto field = detail::trim(header.substr(begin, end - begin));
    begin = end + 1;
    if (field == "ADDD") continue;  // a sub-field without effect
    prefix += '/';
    prefix += field;
    const auto it = by_name_.find(prefix);
    if (it == by_name_.end()) continue;
    // "/GRNOD/1" is an empty group; "/GRNOD/FOO/1" is unknown.
    const bool type_follows = begin < header.size() && !detail::is_digit(header[begin]);
    if (!type_follows || it->second->source != "misread.json" || !prefix.starts_with("/GR"))
      best = it->second.get();
  }
  if (best != nullptr) return &best->get();
  // The solver accepts a material whose name only starts with that of a law.
  for (std::size_t size = header.size(); header.starts_with("/MAT/") && size > 5; --size)
    if (by_name_.contains(header.substr(0, size))) return find("/MAT/*");
  return nullptr;
}

const Schema* SchemaSet::find(std::string_view keyword) const {
  const auto it = by_name_.find(keyword);
  return it == by_name_.end() ? nullptr : &it->second->get();
}

std::vector<const Schema*> SchemaSet::all() const {
  std::vector<const Schema*> schemas;
  for (const auto& [name, entry] : by_name_)
    if (name == entry->keyword) schemas.push_back(&entry->get());
  return schemas;
}

namespace detail {
namespace {

/// True if `text` matches a word in capitals.
bool matches(std::string_view text, std::string_view word) {
  if (!word.ends_with('*')) return text == word;
  word.remove_suffix(1);
  return text.size() > word.size() && text.starts_with(word) &&
         (text[word.size()] == '_' || is_digit(text[word.size()]));
}

}  // namespace

std::span<const std::string> legal_words(const Schema& schema) {
  for (const CardSchema& card : schema.cards)
    if (card.words)
      for (const Field& field : card.fields)
        if (!field.words.empty()) return field.words;
  return {};
}

bool has_word(const Schema& schema, std::string_view text) {
  const auto words = legal_words(schema);
  const std::string capitals = in_capitals(text);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return matches(capitals, in_capitals(word)); });
}

}  // namespace detail

}  // namespace deck
