// LS-DYNA contacts: nothing in the text makes the conversion fail, it says the same twice, and what
// it writes is read again without a complaint about its form.
#include "deck/edit/lsdyna.hpp"
#include "support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace deck;
  using fuzz::require;
  if (size > 16384) return 0;
  const std::string text = fuzz::text_of(data, size);
  LsDynaOptions options;
  constexpr int targets[] = {0, 7, 10, 11, 19, 0};
  constexpr int versions[] = {2022, 2026, 110, 2018};
  const std::uint64_t h = fuzz::hash_of(text);
  options.target = targets[h % 6];
  options.version = versions[h / 6 % 4];
  const Rewrite made = contacts_from_lsdyna("fuzz.k", text, SchemaSet::built_in(), options);
  const Rewrite again = contacts_from_lsdyna("fuzz.k", text, SchemaSet::built_in(), options);
  require(made.new_text == again.new_text && made.losses.size() == again.losses.size() &&
              made.refusals == again.refusals,
          "converting again gives the same");
  if (!made.refusals.empty() || !made.new_text) return 0;
  const std::string deck_text =
      "#RADIOSS STARTER\n/BEGIN\nfuzz\n" +
      std::string(10 - std::to_string(options.version).size(), ' ') +
      std::to_string(options.version) +
      "         0\n                  kg                  mm              "
      "    ms\n                  kg                  mm                  ms\n" +
      fuzz::without_includes(*made.new_text) + "/END\n";
  const auto whole = fuzz::read_files({{fuzz::main_name, deck_text}}, fuzz::main_name);
  require(whole != nullptr, "what was written is a deck");
  for (const Diagnostic& d : whole->deck.diagnostics.all())
    require(d.severity != Severity::error, "what was written is read without errors", d.message);
  require(!whole->interfaces.ordered.empty(), "an interface was written", deck_text);
  return 0;
}
