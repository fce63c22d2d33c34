// Conversions: each is made and read again. An edit to what is there already changes no byte; there
// and back gives the effective values of the beginning; default values written out stay the same to
// the last bit.
#include <array>

#include "deck/edit.hpp"
#include "edit/shared/conversion.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;
using fuzz::Whole;

bool only_kept(const Rewrite& r) {
  for (const LossEntry& e : r.losses)
    if (e.loss != Loss::kept) return false;
  return true;
}

/// The deck with a rewrite applied and read again; nullptr where it was refused.
std::unique_ptr<Whole> applied(const Whole& whole, const Rewrite& rewrite) {
  if (!rewrite.refusals.empty()) return nullptr;
  const auto files = apply_rewrite(whole.deck.sources, rewrite);
  require(files.ok(), "edits of a rewrite do not contradict each other",
          files.ok() ? "" : files.error().message);
  require(files->size() <= 1, "one file is changed at most");
  auto again =
      fuzz::read_text(files->empty() ? std::string(whole.bytes()) : files->begin()->second);
  require(again != nullptr, "a rewritten deck is a deck");
  return again;
}

void same_values(const Whole& a, const Whole& b, const char* what) {
  const std::string before = fuzz::effective_values(a.interfaces);
  const std::string after = fuzz::effective_values(b.interfaces);
  require(before == after, what, before + "\nbecame\n" + after);
}

void version(const Whole& whole, std::uint64_t h) {
  constexpr int versions[] = {110, 120, 130, 140, 2017, 2018, 2019, 2020, 2021, 2022, 2023, 2026};
  const Rewrite same = to_version(whole.context(), whole.deck.version);
  if (same.refusals.empty() && whole.deck.begin.version_written == whole.deck.version) {
    const auto it = applied(whole, same);
    if (only_kept(same))
      same_values(whole, *it, "a conversion to the same version changes nothing");
  }
  VersionOptions options;
  options.allow_loss = h / 12 % 2 == 0;
  const Rewrite there = to_version(whole.context(), versions[h % 12], options);
  const auto other = applied(whole, there);
  if (!other || !only_kept(there)) return;
  const Rewrite back = to_version(other->context(), whole.deck.version, options);
  const auto again = applied(*other, back);
  if (again && only_kept(back)) same_values(whole, *again, "versions: there and back");
}

void units(const Whole& whole, std::uint64_t h) {
  constexpr const char* systems[] = {"kg,mm,ms", "Mg,mm,s", "kg,m,s", "g,mm,ms", "g,cm,us"};
  const auto target = parse_unit_system(systems[h % 5]);
  const auto own = parse_unit_system(whole.deck.begin.input.mass_code + "," +
                                     whole.deck.begin.input.length_code + "," +
                                     whole.deck.begin.input.time_code);
  UnitsOptions options;
  options.keep_working = h / 5 % 3 == 0;
  options.partial = h / 15 % 2 == 0;
  const Rewrite there = to_units(whole.context(), *target, options);
  const auto other = applied(whole, there);
  if (!other || !own || !only_kept(there) || options.keep_working) return;
  if (!(whole.deck.begin.input == whole.deck.begin.working)) return;
  const Rewrite back = to_units(other->context(), *own, options);
  const auto again = applied(*other, back);
  if (again && only_kept(back)) same_values(whole, *again, "units: there and back");
}

void renumbered(const Whole& whole, std::uint64_t h) {
  constexpr const char* kinds[] = {"all", "node", "part", "element", "group", "surf", "inter"};
  const std::string kind = kinds[h % 7];
  const auto up = parse_renumber_rule(kind + "+1000"), down = parse_renumber_rule(kind + "-1000");
  RenumberOptions options;
  options.rules = {*up};
  const auto other = applied(whole, renumber(whole.context(), options));
  if (!other) return;
  options.rules = {*down};
  const auto again = applied(*other, renumber(other->context(), options));
  if (!again) return;  // a number in text that nobody describes may be an id now
  same_values(whole, *again, "ids: up and down");
}

void gaps(const Whole& whole, std::uint64_t h) {
  const auto written = [&](const auto& fix) {
    if (fix) applied(whole, fix->rewrite);
  };
  InactiOptions inacti;
  inacti.inacti = static_cast<int>(h / 3 % 8);
  if (h % 3 == 0) written(reduce_gaps(whole.context(), {}));
  if (h % 3 == 1) written(set_inacti(whole.context(), inacti));
  if (h % 3 == 2) written(set_fpenmax(whole.context(), {}));
}

void defaults(const Whole& whole, std::uint64_t) {
  const Rewrite r = resolve_defaults(whole.context(), {true});
  const auto again = applied(whole, r);
  if (again && only_kept(r)) same_values(whole, *again, "default values written out");
}

void expanded(const Whole& whole, std::uint64_t) { applied(whole, expand_type19(whole.context())); }

void extracted(const Whole& whole, std::uint64_t h) {
  std::vector<std::int64_t> ids;
  for (const InterBase* i : whole.interfaces.ordered)
    if (ids.size() <= h % 3) ids.push_back(i->id);
  const Rewrite r = extract_contacts(whole.context(), ids);
  if (r.refusals.empty() && r.new_text)
    require(fuzz::read_text(*r.new_text) != nullptr, "an extracted deck is a deck");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 12288) return 0;
  const std::string text = fuzz::text_of(data, size);
  const auto whole = fuzz::read_text(text);
  if (!whole) return 0;
  const std::uint64_t h = fuzz::hash_of(text);
  constexpr auto conversions =
      std::to_array({version, units, renumbered, defaults, expanded, extracted, gaps});
  conversions[h % conversions.size()](*whole, h / conversions.size());
  return 0;
}
