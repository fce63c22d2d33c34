// The examples of deck/deck.hpp.  consumer DECK [DIRECTORY]
#include <cstdio>
#include <string>

#include <deck/deck.hpp>

namespace {

void print_defaults(const deck::LoadedDeck& loaded) {
  for (const deck::InterBase* inter : loaded.interfaces().ordered)
    deck::for_each_field(*inter, [&](std::string_view name, const auto& field) {
      if (field.origin == deck::Origin::card || name != "Inacti") return;
      std::printf("/INTER/TYPE%d/%lld: %s\n", inter->type, static_cast<long long>(inter->id),
                  std::string(name).c_str());
    });
}

void print_gaps(const deck::LoadedDeck& loaded) {
  const deck::Scene& scene = loaded.scene();
  for (const deck::Contact& contact : scene.contacts)
    std::printf("interface %lld: gaps up to %g, %zu %s%s\n",
                static_cast<long long>(contact.inter->id), contact.max_gap,
                contact.penetrations.size(), contact.is_tied_contact() ? "ties" : "penetrations",
                contact.evaluated ? "" : " (not evaluated)");
}

void print_penetrations(const deck::LoadedDeck& loaded) {
  const deck::Scene& scene = loaded.scene();
  for (const deck::NamedPenetration& p : deck::make_view(scene).penetrations) {
    const deck::PenetrationRow& row = scene.contacts[p.contact].penetrations[p.row];
    const auto node = static_cast<long long>(p.secondary[0]);
    std::printf("node %lld: %g of a gap of %g\n", node, row.depth, row.gap);
  }
}

void print_verdict(const deck::LoadedDeck& loaded) {
  for (const deck::Finding& finding : loaded.findings().all())
    std::printf("%s: %s\n", loaded.deck().sources.where(finding.span).c_str(),
                finding.message.c_str());
  std::printf("%s\n", deck::verdict_of(loaded).text.c_str());
}

void print_forces(const deck::LoadedDeck& loaded) {
  const deck::cycle::SceneOutcome& outcome = loaded.cycle().outcome;
  std::printf("largest force on a node %g\n", outcome.largest_nodal_force);
  std::printf("time step of the contacts %g\n", outcome.contact_dt);
}

std::size_t changed_files(const deck::LoadedDeck& loaded) {
  const deck::Rewrite rewrite = deck::to_version(loaded, 2026);
  for (const deck::LossEntry& loss : rewrite.losses)
    std::printf("%s %s: %s\n", loss.keyword.c_str(), loss.field.c_str(), loss.note.c_str());
  const auto files = deck::apply_rewrite(loaded.deck().sources, rewrite);  // texts by path
  return rewrite.refusals.empty() && files ? files->size() : 0;
}

int set_gap(const deck::LoadedDeck& loaded, const char* directory) {
  deck::Edit edit(loaded);
  edit.set(loaded.interfaces().find(1), "Gapmin", 0.8);
  if (const auto saved = edit.save_to(directory); !saved) {
    std::fprintf(stderr, "%s\n", saved.error().message.c_str());
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const auto result = deck::load(argv[1]);
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return 3;
  }
  const deck::LoadedDeck& loaded = *result;
  for (const deck::InterType7& inter : loaded.interfaces().type7)
    std::printf("TYPE7 %lld Gapmin %g Inacti %lld\n", static_cast<long long>(inter.id),
                inter.Gapmin.value, static_cast<long long>(inter.Inacti.value));
  print_defaults(loaded);
  print_gaps(loaded);
  print_penetrations(loaded);
  print_verdict(loaded);
  print_forces(loaded);
  std::printf("version 2026 changes %zu files\n", changed_files(loaded));
  return argc > 2 ? set_gap(loaded, argv[2]) : 0;
}
