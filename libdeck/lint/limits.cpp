// Reads the embedded table of limits. It is checked against its JSON schema and the keyword schemas
// by tests, not here.
#include "lint/limits.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/shared/embedded.hpp"
#include "deck/lint/rule.hpp"

namespace deck::detail {
namespace {

using Json = nlohmann::json;

NumberTest test_of(const Json& json, std::string field) {
  NumberTest out;
  out.field = std::move(field);
  const auto bound = [&](const char* key) {
    const auto it = json.find(key);
    return it == json.end() ? std::nullopt : std::optional(it->get<double>());
  };
  out.is = json.value("is", std::vector<double>());
  out.is_not = json.value("is_not", std::vector<double>());
  out.above = bound("above");
  out.below = bound("below");
  out.at_least = bound("at_least");
  out.at_most = bound("at_most");
  return out;
}

Limit limit_of(const Json& json, std::string keyword, std::string field) {
  Limit out;
  out.keyword = std::move(keyword);
  out.of = test_of(json, std::move(field));
  out.sum = json.value("sum", false);
  out.not_a = json.value("not_a", "");
  if (const auto when = json.find("when"); when != json.end())
    for (const Json& test : *when) out.when.push_back(test_of(test, test.value("field", "")));
  const bool error = json.contains("error"), warning = json.contains("warning");
  out.severity = error ? Severity::error : warning ? Severity::warning : Severity::info;
  out.message = json.value(error ? "error" : warning ? "warning" : "info", 0);
  const RuleId general = error ? RuleId::DK640 : warning ? RuleId::DK641 : RuleId::DK642;
  out.rule = json.value("rule", std::string(id_text(general)));
  out.says = json.value("says", "");
  out.fix = json.value("fix", "");
  out.known_from = json.value("known_from", "");
  return out;
}

}  // namespace

bool NumberTest::holds(double value) const {
  if (!is.empty() && std::find(is.begin(), is.end(), value) == is.end()) return false;
  if (std::find(is_not.begin(), is_not.end(), value) != is_not.end()) return false;
  return (!above || value > *above) && (!below || value < *below) &&
         (!at_least || value >= *at_least) && (!at_most || value <= *at_most);
}

const std::vector<Limit>& all_limits() {
  static const std::vector<Limit> limits = [] {
    std::vector<Limit> out;
    for (const EmbeddedFile& file : embedded_limits()) {
      const Json json = Json::parse(file.text);
      for (const Json& entry : json.at("limits"))
        for (const Json& keyword : entry.at("keywords"))
          for (const Json& field : entry.value("of", Json::array({""})))
            out.push_back(limit_of(entry, keyword.get<std::string>(), field.get<std::string>()));
    }
    return out;
  }();
  return limits;
}

const std::vector<const Limit*>& limits_of(const Schema& schema) {
  using ByKeyword = std::map<std::string_view, std::vector<const Limit*>>;
  static const ByKeyword by_keyword = [] {
    ByKeyword out;
    for (const Limit& limit : all_limits()) out[limit.keyword].push_back(&limit);
    return out;
  }();
  static const std::vector<const Limit*> none;
  const auto it = by_keyword.find(schema.keyword);
  return it == by_keyword.end() ? none : it->second;
}

}  // namespace deck::detail
