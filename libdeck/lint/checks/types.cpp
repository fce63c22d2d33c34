// Which interface types each contact rule is true for: the checks ask this table, the pages print
// it, and a test asks every rule about every type. A rule that is absent is about no interface.
#include <array>
#include <string_view>
#include <vector>

#include "deck/lint/rule.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

struct RuleTypes {
  std::string_view types;  ///< "7 11 19"
  std::string_view rules;  ///< "DK201 DK204"
};

constexpr std::array table = {
    RuleTypes{"7 10 11 19",
              "DK048 DK170 DK171 DK179 DK204 DK207 DK221 DK223 DK225 DK227 DK233 DK238 DK246 "
              "DK252 DK301 DK310 DK322 DK402 DK904 DK909 DK911 DK912"},
    RuleTypes{"7 11 19",
              "DK047 DK175 DK177 DK201 DK202 DK210 DK211 DK213 DK216 DK217 DK219 DK224 DK226 "
              "DK230 DK231 DK232 DK235 DK239 DK240 DK241 DK243 DK245 DK247 DK248 DK259 DK261 "
              "DK266 DK267 DK268 DK269 DK271 DK276 DK277 DK278 DK280 DK284 DK296 DK401 DK403 "
              "DK901 DK902 DK903 DK905 DK910 DK918 DK919"},
    RuleTypes{"7 10 19", "DK181 DK302 DK314 DK319 DK320 DK326 DK328 DK913"},
    RuleTypes{"7 10 11", "DK275"},
    RuleTypes{"7 19",
              "DK178 DK203 DK205 DK208 DK209 DK212 DK220 DK222 DK228 DK234 DK249 DK250 DK251 "
              "DK253 DK258 DK260 DK262 DK265 DK270 DK272 DK273 DK285 DK287 DK288 DK293 DK294 "
              "DK295 DK298 DK303 DK305 DK307 DK311 DK312 DK318 DK323 DK920 DK510 DK906 DK917"},
    RuleTypes{"11 19", "DK289 DK297 DK306 DK315"},
    RuleTypes{"7 10", "DK214"},
    RuleTypes{"7",
              "DK176 DK206 DK229 DK236 DK237 DK244 DK256 DK257 DK263 DK286 DK291 DK299 DK304 "
              "DK908 DK914 DK915 DK916"},
    RuleTypes{"10", "DK182 DK254 DK279 DK317 DK907"},
    RuleTypes{"11", "DK180 DK242 DK255 DK264"},
    RuleTypes{"19", "DK215 DK274 DK281 DK282 DK283 DK290 DK292 DK316 DK327"},
};

std::vector<int> numbers(std::string_view text) {
  std::vector<int> out;
  int value = 0;
  for (const char c : text) {
    if (c == ' ') {
      out.push_back(value);
      value = 0;
    } else {
      value = 10 * value + (c - '0');
    }
  }
  out.push_back(value);
  return out;
}

}  // namespace

std::vector<int> interface_types_of(std::string_view rule) {
  for (const RuleTypes& row : table)
    if (row.rules.find(rule) != std::string_view::npos) return numbers(row.types);
  return {};
}

}  // namespace deck::detail
