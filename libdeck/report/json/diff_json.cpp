// The document of `deck diff --json`.
#include "report/shared/diff.hpp"
#include "report/shared/json.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
namespace {

void write(JsonWriter& json, const DiffValue& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) {
    json.value(*n);
  } else if (const auto* x = std::get_if<double>(&value)) {
    json.value(*x);
  } else if (const auto* t = std::get_if<std::string>(&value)) {
    json.value(*t);
  } else if (const auto* p = std::get_if<std::array<double, 3>>(&value)) {
    json.begin_array(true).value((*p)[0]).value((*p)[1]).value((*p)[2]).end_array();
  } else {
    json.null();
  }
}

void write_id_list(JsonWriter& json, const char* name, const std::vector<std::int64_t>& ids) {
  json.key(name).begin_array(true);
  for (const std::int64_t id : ids) json.value(id);
  json.end_array();
}

void write(JsonWriter& json, const DiffSide& a, const DiffSide& b, const Change& c) {
  json.begin_object();
  json.field("kind", to_string(c.kind)).field("group", c.group);
  json.key("entity").begin_object(true);
  json.field("keyword", c.keyword).key("id");
  if (c.id == 0)
    json.null();
  else
    json.value(c.id);
  if (c.id_b != 0) json.field("id_b", c.id_b);
  json.field("title", c.title).end_object();
  json.key("field");
  if (c.field.empty())
    json.null();
  else
    json.value(c.field);
  write(json.key("old"), c.old_value);
  write(json.key("new"), c.new_value);
  if (c.evaluated) {
    write(json.key("effective_old"), c.effective_old);
    write(json.key("effective_new"), c.effective_new);
    json.field("why", c.why);
  }
  if (!c.gained.empty() || !c.lost.empty() || !c.altered.empty()) {
    write_id_list(json, "gained", c.gained);
    write_id_list(json, "lost", c.lost);
    write_id_list(json, "altered", c.altered);
  }
  write_json_place(json.key("a"), a.loaded.deck(), c.a);
  write_json_place(json.key("b"), b.loaded.deck(), c.b);
  json.end_object();
}

void write(JsonWriter& json, const char* name, const std::vector<PenetrationChange>& list) {
  json.key(name).begin_array();
  for (const PenetrationChange& p : list) {
    json.begin_object(true).field("interface", p.interface_id).field("role", p.role);
    if (p.secondary[1] == 0)
      json.field("node", p.secondary[0]);
    else
      json.key("edge").begin_array().value(p.secondary[0]).value(p.secondary[1]).end_array();
    json.field("depth_old", p.depth_old).field("depth_new", p.depth_new);
    json.field("gap_old", p.gap_old).field("gap_new", p.gap_new).end_object();
  }
  json.end_array();
}

}  // namespace

std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, "deck/diff", 1);
  json.key("a").begin_object();
  write_json_deck(json, a.loaded.path(), a.loaded.deck(), &a.loaded.model(),
                  &a.loaded.interfaces());
  if (a.verdict != nullptr) write_verdict(json, *a.verdict);
  json.end_object().key("b").begin_object();
  write_json_deck(json, b.loaded.path(), b.loaded.deck(), &b.loaded.model(),
                  &b.loaded.interfaces());
  if (b.verdict != nullptr) write_verdict(json, *b.verdict);
  json.end_object();
  json.field("equal", diff.equal()).field("text", diff_verdict(diff));
  json.key("notes").begin_array();
  for (const std::string& note : diff.notes) json.value(note);
  json.end_array();
  json.key("changes").begin_array();
  for (const Change& c : diff.changes) write(json, a, b, c);
  json.end_array();
  json.key("penetrations").begin_object();
  write(json, "new", diff.appeared);
  write(json, "gone", diff.gone);
  write(json, "worse", diff.worse);
  write(json, "better", diff.better);
  json.field("same", diff.same.size()).end_object();
  json.end_object();
  return out;
}

}  // namespace deck
