// Reads the head of a verb's document without holding the rest.
#include "batch/json.hpp"

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "report/shared/json.hpp"

namespace deck::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Listens to a document being parsed and keeps the members of its "summary", its "verdict" whole,
/// how much it says was examined, and the length of its "interfaces".
class Facts : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return scalar(nullptr); }
  bool boolean(bool v) override { return scalar(v); }
  bool number_integer(number_integer_t v) override { return scalar(v); }
  bool number_unsigned(number_unsigned_t v) override { return scalar(v); }
  bool number_float(number_float_t v, const string_t&) override { return scalar(v); }
  bool string(string_t& v) override { return scalar(v); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override {
    if (depth_ == 2 && section_ == "summary") counts[member_] = Json::object();
    return open(Json::object());
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (depth_ == 1) section_ = name;
    if (depth_ == 2) member_ = name;
    if (depth_ == 3) inner_ = name;
    name_ = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

  Json counts = Json::object();
  Json verdict;
  std::optional<std::uint64_t> examined;
  std::optional<bool> gate;

 private:
  /// A value of the verdict, in its place there.
  Json& keep(Json value) {
    if (building_.empty()) return verdict = std::move(value);
    Json& in = *building_.back();
    if (!in.is_array()) return in[name_] = std::move(value);
    in.push_back(std::move(value));
    return in.back();
  }
  bool in_verdict() const { return depth_ >= 1 && section_ == "verdict"; }
  bool open(Json empty) {
    if (in_verdict()) building_.push_back(&keep(std::move(empty)));
    if (depth_ == 1 && section_ == "interfaces") counts["interfaces"] = 0;
    if (depth_ == 2 && section_ == "interfaces")
      counts["interfaces"] = counts["interfaces"].get<std::uint64_t>() + 1;
    ++depth_;
    return true;
  }
  bool close() {
    --depth_;
    if (!building_.empty()) building_.pop_back();
    return true;
  }
  template <class T>
  bool scalar(const T& value) {
    if (in_verdict()) keep(value);
    if (depth_ == 2 && section_ == "summary") counts[member_] = value;
    if (depth_ == 3 && section_ == "summary" && counts[member_].is_object())
      counts[member_][inner_] = value;
    if constexpr (std::is_same_v<T, bool>)
      if (depth_ == 2 && section_ == "gate" && member_ == "passed") gate = value;
    if constexpr (std::is_same_v<T, number_unsigned_t>)
      if (depth_ == 1 && section_ == "examined") examined = value;
    return true;
  }
  int depth_ = 0;
  std::string section_, member_, inner_, name_;
  std::vector<Json*> building_;  ///< containers of the verdict that are open
};

void write_value(JsonWriter& json, const Json& v) {
  if (v.is_object()) {
    json.begin_object(true);
    for (const auto& [name, member] : v.items()) {
      json.key(name);
      write_value(json, member);
    }
    json.end_object();
  } else if (v.is_array()) {
    json.begin_array(true);
    for (const auto& item : v) write_value(json, item);
    json.end_array();
  } else if (v.is_string()) {
    json.value(v.get_ref<const std::string&>());
  } else if (v.is_boolean()) {
    json.value(v.get<bool>());
  } else if (v.is_number_unsigned()) {
    json.value(v.get<std::uint64_t>());
  } else if (v.is_number_integer()) {
    json.value(v.get<std::int64_t>());
  } else if (v.is_number()) {
    json.value(v.get<double>());
  } else {
    json.null();
  }
}

}  // namespace

std::string json_line(const Json& value) {
  std::string text;
  JsonWriter json(text);
  write_value(json, value);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

std::optional<DocumentFacts> document_facts(std::string_view document) {
  Facts facts;
  if (!Json::sax_parse(document.begin(), document.end(), &facts)) return std::nullopt;
  DocumentFacts out{json_line(facts.counts), {}, {}, facts.examined, facts.gate};
  if (facts.verdict.is_object()) {
    out.verdict = json_line(facts.verdict);
    out.level = facts.verdict.value("level", "");
  }
  return out;
}

}  // namespace deck::cli
