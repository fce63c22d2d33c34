// Prints the effective gap and initial-penetration flag of every TYPE7 of a deck: the smallest
// useful program on libdeck.
#include <cstdio>

#include <deck/contact/resolve.hpp>
#include <deck/keyword/deck.hpp>
#include <deck/model/interfaces.hpp>
#include <deck/model/model.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const deck::SchemaSet& schemas = deck::SchemaSet::built_in();
  const auto deck = deck::read_deck(argv[1], schemas);
  if (!deck) {
    std::fprintf(stderr, "%s\n", deck.error().message.c_str());
    return 3;
  }
  deck::Diagnostics findings;
  const deck::Model model = deck::build_model(*deck, schemas, findings);
  deck::Interfaces interfaces = deck::read_interfaces(*deck, model, findings);
  deck::resolve(interfaces, deck::build_scene(model, interfaces, findings));
  for (const deck::InterType7& inter : interfaces.type7)
    std::printf("TYPE7 %lld Gapmin %g Inacti %lld\n", static_cast<long long>(inter.id),
                inter.Gapmin.value, static_cast<long long>(inter.Inacti.value));
  return 0;
}
