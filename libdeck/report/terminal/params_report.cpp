// Tables and JSON of `deck params`.
#include "deck/report/params_report.hpp"
#include "deck/base/escape.hpp"
#include "deck/contact/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "deck/report/json.hpp"
#include "deck/report/text_table.hpp"

namespace deck {
namespace {

/// What the geometry gives the parts of one interface.
std::vector<std::pair<std::string_view, double>> by_role(const ParamsInput& in,
                                                         const InterBase& inter,
                                                         std::string_view name) {
  std::vector<std::pair<std::string_view, double>> out;
  if (in.scene == nullptr) return out;
  for (const Contact& c : in.scene->contacts)
    if (c.inter == &inter && !c.dropped)
      out.emplace_back(to_string(c.role), geometry_value(c, name));
  return out;
}

std::string text_of(std::int64_t v) { return std::to_string(v); }
std::string text_of(double v) { return shortest(v); }
std::string text_of(const std::string& v) { return v; }

Tone tone_of(Origin origin) {
  switch (origin) {
    case Origin::card:
      return Tone::plain;
    case Origin::default_block:
      return Tone::cyan;
    case Origin::built_in:
      return Tone::dim;
    case Origin::derived:
    case Origin::geometry:
      break;
  }
  return Tone::yellow;
}

/// Interfaces that are in the deck but not evaluated here.
std::vector<const Block*> others(const ParamsInput& in) {
  std::vector<const Block*> out;
  for (const Block& b : in.deck->blocks) {
    if (!b.header.starts_with("/INTER/")) continue;
    const bool known = std::any_of(in.interfaces->ordered.begin(), in.interfaces->ordered.end(),
                                   [&](const InterBase* i) { return i->block == &b; });
    if (!known) out.push_back(&b);
  }
  return out;
}

std::string keyword_of(const Block& block) {
  return block.schema != nullptr ? block.schema->keyword : std::string(block.keyword);
}

template <class T>
void text_row(const ParamsInput& in, const InterBase& inter, std::string_view name,
              const Effective<T>& e, const ParamsTextOptions& options, TextTable& table) {
  if (options.changed_only && e.origin == Origin::card) return;
  std::string value = text_of(e.value);
  if (e.origin == Origin::geometry) {
    if (!inter.resolved) value = "from geometry";
    const auto values = by_role(in, inter, name);
    for (std::size_t i = 1; i < values.size(); ++i)
      value += fmt::format(", {} {}", values[i].first, text_of(values[i].second));
  }
  table.row({std::string(name),
             e.has_input ? text_of(e.input) : std::string("-"),
             {value, e.origin == Origin::card ? Tone::bold : Tone::plain},
             {to_string(e.origin), tone_of(e.origin)},
             {e.span.valid() ? in.deck->sources.where(e.span) : std::string(), Tone::dim}});
}

void write_value(JsonWriter& json, std::int64_t v) { json.value(v); }
void write_value(JsonWriter& json, double v) { json.value(v); }
void write_value(JsonWriter& json, const std::string& v) { json.value(v); }

template <class T>
void json_field(JsonWriter& json, const ParamsInput& in, const InterBase& inter,
                std::string_view name, const Effective<T>& e) {
  json.key(name).begin_object(true).key("input");
  if (e.has_input)
    write_value(json, e.input);
  else
    json.null();
  json.key("value");
  const bool geometric = e.origin == Origin::geometry;
  if (geometric && !inter.resolved)
    json.null();
  else
    write_value(json, e.value);
  json.field("origin", to_string(e.origin));
  if (const auto values = by_role(in, inter, name); geometric && values.size() > 1) {
    json.key("by_role").begin_object(true);
    for (const auto& [role, v] : values) json.field(role, v);
    json.end_object();
  }
  json.key("source");
  if (e.span.valid()) {
    const Position p = in.deck->sources.position(e.span);
    json.begin_object(true).field("file", in.deck->sources[e.span.file].path());
    json.field("line", p.line).field("column", p.column);
    json.field("end_column", p.column + e.span.length).end_object();
  } else {
    json.null();
  }
  json.end_object();
}

}  // namespace

std::string params_text(const ParamsInput& in, const ParamsTextOptions& options) {
  const Coverage coverage = coverage_of(*in.deck, *in.interfaces);
  std::string out;
  if (const std::string lead = coverage_lead(coverage); !lead.empty())
    out += toned(terminal_text(lead), Tone::bold, options.color) + "\n";
  for (const InterBase* inter : in.interfaces->ordered) {
    out +=
        toned(fmt::format("/INTER/TYPE{}/{}", inter->type, inter->id), Tone::bold, options.color);
    if (!inter->title.empty()) out += "  " + terminal_text(inter->title);
    out += "  " +
           toned(terminal_text(in.deck->sources.where(inter->span)), Tone::dim, options.color) +
           "\n";
    TextTable table({{"field", Align::left},
                     {"card", Align::right},
                     {"value", Align::right},
                     {"origin", Align::left},
                     {"place", Align::left}});
    visit_interface(*inter, [&](const auto& t) {
      t.for_each([&](std::string_view name, const auto& e) {
        text_row(in, *inter, name, e, options, table);
      });
    });
    out += table.render(options.color, 2) + "\n";
  }
  const auto& all = *in.interfaces;
  out += fmt::format("{}: {} interfaces (TYPE7 {}, TYPE10 {}, TYPE11 {}, TYPE19 {})",
                     terminal_text(in.path), all.ordered.size(), all.type7.size(),
                     all.type10.size(), all.type11.size(), all.type19.size());
  if (!coverage.not_examined.empty())
    out += "; not examined: " + terminal_text(not_examined_text(coverage));
  return out + "\n";
}

std::string params_json(const ParamsInput& in) {
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, "deck/params", 1);
  write_json_deck(json, in.path, *in.deck, in.model, in.interfaces);
  write_json_coverage(json, coverage_of(*in.deck, *in.interfaces));
  json.key("interfaces").begin_array();
  for (const InterBase* inter : in.interfaces->ordered) {
    json.begin_object();
    json.field("id", inter->id).field("type", inter->type).field("title", inter->title);
    json.key("source");
    write_json_place(json, *in.deck, inter->span);
    json.key("parameters").begin_object();
    visit_interface(*inter, [&](const auto& t) {
      t.for_each(
          [&](std::string_view name, const auto& e) { json_field(json, in, *inter, name, e); });
    });
    // No such cell on the card; its node-to-surface parts have the field all the same.
    if (inter->type == 19) json_field(json, in, *inter, "Fpenmax", EffectiveReal{});
    json.end_object().end_object();
  }
  json.end_array();
  json.key("not_evaluated").begin_array();
  for (const Block* b : others(in)) {
    json.begin_object(true).field("keyword", keyword_of(*b));
    json.field("id", b->id.value).key("source");
    write_json_place(json, *in.deck, b->header_span);
    json.end_object();
  }
  json.end_array();
  json.end_object();
  return out;
}

}  // namespace deck
