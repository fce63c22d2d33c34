// Prints the effective gap and initial-penetration flag of every TYPE7 of a deck: the smallest
// useful program on libdeck.
#include <cstdio>

#include <deck/deck.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto loaded = deck::load(argv[1]);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    return 3;
  }
  for (const deck::InterType7& inter : loaded->interfaces().type7)
    std::printf("TYPE7 %lld Gapmin %g Inacti %lld\n", static_cast<long long>(inter.id),
                inter.Gapmin.value, static_cast<long long>(inter.Inacti.value));
  return 0;
}
