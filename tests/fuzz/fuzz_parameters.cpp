// Parameter expressions: the input is a list of lines, each the expression of one parameter that
// may name the others.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "deck/keyword/deck.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view input(reinterpret_cast<const char*>(data), size);
  std::string text = "#RADIOSS STARTER\n/BEGIN\nfuzz\n      2024         0\nkg\nkg\n";
  for (int i = 0; !input.empty() && i < 200; ++i) {
    const auto end = std::min(input.find('\n'), input.size());
    const std::string name = "P" + std::to_string(i);
    text += i % 3 == 2 ? "/PARAMETER/LOCAL/INT_EXPR/1\ntitle\n"
                       : "/PARAMETER/GLOBAL/REAL_EXPR/1\ntitle\n";
    text += name + std::string(10 - name.size(), ' ');
    text += input.substr(0, end);
    text += '\n';
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  const auto deck = deck::read_deck_text("fuzz", text + "/END\n", deck::SchemaSet::built_in());
  if (!deck) return 0;
  for (const auto& [name, parameter] : deck->parameters)
    if (parameter.valid && !std::isfinite(parameter.real)) std::abort();
  return 0;
}
