// Reads, changes and writes baselines.
#include "lint/shared/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/shared/paths.hpp"
#include "text/shared/columns.hpp"
#include "text/shared/read_json.hpp"

namespace deck {
namespace {

using Json = nlohmann::ordered_json;

const std::string untied = "untied";

std::string line_text(const Json& entry) {
  return entry.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json parsed(std::string_view line) { return read_json<Json>(line); }

const std::string* text_of(const Json& entry, const char* key) {
  if (!entry.is_object()) return nullptr;
  const auto it = entry.find(key);
  return it == entry.end() ? nullptr : it->get_ptr<const std::string*>();
}

/// Nine digits are enough to see changes.
double shortened(double value) {
  const std::string text = fmt::format("{:.9g}", value);
  double out = value;
  std::from_chars(text.data(), text.data() + text.size(), out);
  return out;
}

/// null: no number, or not finite.
double number_of(const Json& entry, const char* key) {
  const auto it = entry.find(key);
  return it != entry.end() && it->is_number() ? it->get<double>()
                                              : std::numeric_limits<double>::max();
}

}  // namespace

std::string name_in_baseline(const std::string& file, const std::string& path) {
  if (file == "-") return file;
  return std::filesystem::path(absolute_path(file))
      .lexically_relative(parent_path(absolute_path(path)))
      .generic_string();
}

bool Baseline::is_of_earlier_form(std::string_view text) {
  return text.find("\"schema\"") != text.npos && !text.starts_with("{\"deck\":\"");
}

Result<Baseline> Baseline::parse(std::string_view text, const std::string& path, Kind kind) {
  const char* const verb = kind == Kind::lint ? "lint" : "gaps";
  if (is_of_earlier_form(text))
    return Error{Error::Code::config,
                 fmt::format("{}: a baseline of an earlier form; write it anew for all its decks: "
                             "deck {} DECK... --write-baseline {}, or deck gate --accept",
                             path, verb, path)};
  Baseline out(path, kind);
  std::size_t number = 0;
  for (const std::string_view line : detail::parts_of(text, '\n')) {
    ++number;
    if (line.empty()) continue;
    // Beginning of a line as written; finds the deck without a JSON parser.
    constexpr std::string_view head = "{\"deck\":\"";
    const std::size_t quote = line.find('"', head.size());
    std::string deck;
    if (line.starts_with(head) && quote != line.npos &&
        line.substr(0, quote).find('\\') == line.npos) {
      deck = line.substr(head.size(), quote - head.size());
    } else {
      const Json entry = parsed(line);
      const std::string* name = text_of(entry, "deck");
      if (name == nullptr)
        return Error{Error::Code::config,
                     fmt::format("{}:{}: this is no entry of a baseline, as deck {} "
                                 "--write-baseline writes it",
                                 path, number, verb)};
      deck = *name;
    }
    out.decks_[deck].emplace(line);
  }
  return out;
}

const Baseline::Lines& Baseline::lines_of(const std::string& deck_path) const {
  static const Lines none;
  const auto it = decks_.find(name_in_baseline(deck_path, path_));
  return it == decks_.end() ? none : it->second;
}

bool Baseline::has(const std::string& deck_path) const { return !lines_of(deck_path).empty(); }

std::vector<std::string> Baseline::decks() const {
  std::vector<std::string> out;
  for (const auto& [deck, lines] : decks_)
    if (!lines.empty()) out.push_back(deck);
  return out;
}

Error Baseline::wrong_entry(const std::string& line) const {
  return {Error::Code::config,
          fmt::format("{}: this is no entry of {}: {}", path_,
                      kind_ == Kind::lint ? "lint" : "gaps", line.substr(0, 120))};
}

Result<AcceptedFindings> Baseline::findings_of(const std::string& deck_path) const {
  const std::filesystem::path directory = parent_path(absolute_path(path_));
  AcceptedFindings out;
  for (const std::string& line : lines_of(deck_path)) {
    const Json entry = parsed(line);
    const std::string *rule = text_of(entry, "rule"), *file = text_of(entry, "file"),
                      *entity = text_of(entry, "entity"), *field = text_of(entry, "field");
    if (rule == nullptr || file == nullptr || entity == nullptr || field == nullptr)
      return wrong_entry(line);
    out[{to_selector(*rule), absolute_path((directory / *file).string()), *entity, *field}]
        .push_back(number_of(entry, "value"));
  }
  return out;
}

Result<GapBaseline> Baseline::gaps_of(const std::string& deck_path) const {
  GapBaseline out;
  out.path = path_;
  out.accepts = true;
  out.decks = decks();
  if (has(deck_path)) out.deck_path = name_in_baseline(deck_path, path_);
  for (const std::string& line : lines_of(deck_path)) {
    const Json entry = parsed(line);
    const std::string* kind = text_of(entry, "kind");
    const auto inter = entry.find("interface"), ids = entry.find("ids");
    const bool whole = kind != nullptr && inter != entry.end() && ids != entry.end() &&
                       inter->is_number_integer() && ids->is_array() && !ids->empty() &&
                       ids->size() <= 2 &&
                       std::all_of(ids->begin(), ids->end(),
                                   [](const Json& id) { return id.is_number_integer(); });
    if (!whole) return wrong_entry(line);
    GapBaseline::Row row;
    row.interface_id = inter->get<std::int64_t>();
    row.role = *kind;
    for (std::size_t k = 0; k < ids->size(); ++k) row.secondary[k] = (*ids)[k].get<std::int64_t>();
    row.depth = number_of(entry, "depth");
    row.gap = number_of(entry, "gap");
    if (*kind == untied)
      out.untied[row.interface_id].insert(row.secondary[0]);
    else
      out.rows.push_back(std::move(row));
  }
  return out;
}

void Baseline::accept(const std::string& deck_path, const Deck& deck, const LintResult& result) {
  const std::string name = name_in_baseline(deck_path, path_);
  Lines lines;
  for (const Finding& d : result.findings) {
    if (is_gate_rule(d.rule)) continue;
    const FindingKey key = finding_key(deck, d);
    const Json value = d.amount ? Json(shortened(*d.amount)) : Json(nullptr);
    lines.insert(line_text({{"deck", name},
                            {"rule", key.rule},
                            {"file", name_in_baseline(key.file, path_)},
                            {"entity", key.entity},
                            {"field", key.field},
                            {"value", value}}));
  }
  decks_[name] = std::move(lines);
}

void Baseline::accept(const std::string& deck_path, const Scene& scene, const SceneView& view) {
  const std::string name = name_in_baseline(deck_path, path_);
  Lines lines;
  const auto add = [&](std::int64_t inter, const std::string& kind,
                       const std::vector<std::int64_t>& ids, const Json& depth, const Json& gap) {
    lines.insert(line_text({{"deck", name},
                            {"interface", inter},
                            {"kind", kind},
                            {"ids", ids},
                            {"depth", depth},
                            {"gap", gap}}));
  };
  for (const std::uint32_t i : view.deepest_per_node) {
    const NamedPenetration& p = view.penetrations[i];
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& row = c.penetrations[p.row];
    std::vector<std::int64_t> ids = {p.secondary[0]};
    if (p.secondary[1] != 0) ids.push_back(p.secondary[1]);
    add(c.inter->id, to_string(c.role), ids, shortened(row.depth), shortened(row.gap));
  }
  for (const auto& [inter, nodes] : untied_nodes(scene))
    for (const std::int64_t node : nodes) add(inter->id, untied, {node}, nullptr, nullptr);
  decks_[name] = std::move(lines);
}

void Baseline::replace_deck(const std::string& deck_path, const Baseline& other) {
  decks_[name_in_baseline(deck_path, path_)] = other.lines_of(deck_path);
}

std::string Baseline::text() const {
  std::string out;
  for (const auto& [deck, lines] : decks_)
    for (const std::string& line : lines) out += line + "\n";
  return out;
}

}  // namespace deck
