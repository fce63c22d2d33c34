// The loss report as a JSON array.
#include "report/shared/losses.hpp"

#include "report/shared/json.hpp"

namespace deck {

void write_loss_lists(JsonWriter& json, const std::vector<LossEntry>& losses) {
  constexpr std::pair<Loss, std::string_view> groups[] = {{Loss::kept, "kept"},
                                                          {Loss::approximated, "approximated"},
                                                          {Loss::dropped, "dropped"},
                                                          {Loss::undecided, "undecided"}};
  for (const auto& [loss, name] : groups) {
    json.key(name).begin_array();
    for (const LossEntry& e : losses) {
      if (e.loss != loss) continue;
      json.begin_object();
      json.key("file").value(e.file);
      json.key("line").value(e.line);
      if (e.column > 0) {
        json.key("column").value(e.column);
        json.key("end_column").value(e.end_column);
      }
      json.key("keyword").value(e.keyword);
      json.key("id").value(e.id);
      json.key("field").value(e.field);
      json.key("old").value(e.old_text);
      json.key("new").value(e.new_text);
      json.key("note").value(e.note);
      json.end_object();
    }
    json.end_array();
  }
}

std::string losses_json(const std::vector<LossEntry>& losses) {
  std::string text;
  JsonWriter json(text);
  json.begin_object();
  write_json_head(json, "deck/losses", 1);
  write_loss_lists(json, losses);
  json.end_object();
  text += '\n';
  return text;
}

}  // namespace deck
