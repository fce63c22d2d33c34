// `deck accuracy`: what each word of --accuracy costs and gives, as text and JSON.
#include "report/shared/accuracy.hpp"

#include <fmt/format.h>

#include <utility>

#include "accuracy/shared/choice.hpp"
#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

TextTable::Cell wrong_cell(std::uint64_t wrong, std::uint64_t all) {
  if (wrong == 0) return {"0", Tone::green};
  return {fmt::format("{} = {}", wrong, share_text(wrong, all)), Tone::red};
}

// One row an accuracy, as on the page.
std::string choice_text(const AccuracyChoices& choices, bool color, std::size_t width) {
  std::string out;
  for (const std::string& sentence : accuracy_advice(choices))
    out += (out.empty() ? "" : " ") + sentence;
  out += "\n\n";
  const bool deck = choices.front().deck.has_value();
  TextTable table({"--accuracy", "+>on this deck", "+>wrong", ">hard cases", ">wrong there",
                   ">other answer", ">kinds"},
                  deck);
  for (const AccuracyChoice& c : choices) {
    const Tone own = c.accuracy == Accuracy::robust ? Tone::bold : Tone::plain;
    const std::size_t right = c.hard.kinds_never_wrong();
    table.row({{to_string(c.accuracy), own},
               {deck ? seconds_text(c.deck->seconds) : "", own},
               deck ? wrong_cell(c.deck->wrong.size(), c.deck->pairs) : "",
               {ratio_text(c.hard.ratio.value), own},
               wrong_cell(c.hard.wrong, c.hard.pairs),
               wrong_cell(c.hard.other_answer, c.hard.rewritten),
               {fmt::format("{} of {}", right, c.hard.kinds.size()),
                right == c.hard.kinds.size() ? Tone::green : Tone::red}});
  }
  out += table.fitted(width, color);
  const AccuracyChoice::OnHardCases& hard = choices.front().hard;
  if (deck)
    out += fmt::format("\nOn this deck: the whole of deck gaps, {}.",
                       count(choices.front().deck->pairs, "pair", "pairs"));
  return out + fmt::format(
                   "\nHard cases: {} made to break arithmetic, time against fast."
                   "\nOther answer: of {} written in other ways (order of nodes, axes, units)."
                   "\nKinds: kinds of hard cases without a wrong decision.\n",
                   count(hard.pairs, "pair", "pairs"), count(hard.rewritten, "pair", "pairs"));
}

}  // namespace

std::string accuracy_compiler() {
#if defined(__clang__)
  const std::string name = "clang ";
#elif defined(__GNUC__)
  const std::string name = "g++ ";
#else
  const std::string name;
#endif
#ifdef __OPTIMIZE__
  const std::string level = ", optimised";
#else
  const std::string level = ", not optimised";
#endif
  return name + __VERSION__ + level + ", no contraction";
}

std::string accuracy_text(const AccuracyChoices& choices, const AccuracyContext& context,
                          bool color, std::size_t width) {
  std::string out;
  if (!context.path.empty())
    out = terminal_text(context.path) + (choices.front().deck ? "\n" : ": no pair to decide\n");
  return out + choice_text(choices, color, width) +
         fmt::format("\n{}; {}\n", terminal_text(context.processor), accuracy_compiler());
}

Record<AccuracyChoice::OnDeck> record_of(const AccuracyChoice::OnDeck*) {
  using Row = AccuracyChoice::OnDeck;
  static constexpr Column<Row> columns[] = {
      column<&Row::seconds>("seconds", "Whole deck gaps"),
      column<&Row::ratio, &TimeRatio::value>("ratio", "Time against fast"),
      column<&Row::ratio, &TimeRatio::spread>("spread", "Of both times, as a share"),
      column<&Row::pairs>("pairs"), column("wrong", [](const Row& r) { return r.wrong.size(); })};
  return {"on_deck", "", columns, true};
}

Record<AccuracyChoice::OnHardCases> record_of(const AccuracyChoice::OnHardCases*) {
  static constexpr Column<AccuracyChoice::OnHardCases> columns[] = {
      column<&AccuracyChoice::OnHardCases::ns_per_pair>("ns_per_pair"),
      column<&AccuracyChoice::OnHardCases::ratio, &TimeRatio::value>("ratio", "Time against fast"),
      column<&AccuracyChoice::OnHardCases::ratio, &TimeRatio::spread>("spread",
                                                                      "Of both times, as a share"),
      column<&AccuracyChoice::OnHardCases::pairs>("pairs"),
      column<&AccuracyChoice::OnHardCases::wrong>("wrong"),
      column<&AccuracyChoice::OnHardCases::rewritten>("rewritten",
                                                      "Pairs written down in other ways"),
      column<&AccuracyChoice::OnHardCases::other_answer>("other_answer",
                                                         "Of these: the answer changed"),
      column<&AccuracyChoice::OnHardCases::kinds_never_wrong>("kinds_never_wrong",
                                                              "Of the members of families")};
  return {"on_hard_cases", "", columns, true};
}

Record<AccuracyChoice> record_of(const AccuracyChoice*) {
  static constexpr Column<AccuracyChoice> columns[] = {
      column<&AccuracyChoice::accuracy>("word"),
      column<&AccuracyChoice::deck>("deck", "null: no deck, or no pair in it"),
      column<&AccuracyChoice::hard>("hard")};
  return {"choice", "What a word of --accuracy costs and gives.", columns};
}

namespace {

std::array<double, 3> point(const Point3<double>& p) { return {p.x, p.y, p.z}; }

struct WorstRow {
  Accuracy word;
  const KindResult* of;

  const char* kind() const { return of->worst.edges ? "edge_edge" : "node_segment"; }
  std::vector<std::array<double, 3>> points() const {
    std::vector<std::array<double, 3>> out;
    for (std::size_t k = 0; k < (of->worst.edges ? 4u : 5u); ++k)
      out.push_back(point(of->worst.x[k]));
    return out;
  }
};
Record<WorstRow> record_of(const WorstRow*) {
  static constexpr Column<WorstRow> columns[] = {
      column<&WorstRow::word>("word"),
      column<&WorstRow::kind>("kind", "node_segment or edge_edge"),
      column<&WorstRow::of, &KindResult::worst, &PairSample::triangle>("triangle"),
      column<&WorstRow::points>(
          "points", "Corners and node, or both nodes of the secondary and of the main edge"),
      column<&WorstRow::of, &KindResult::worst, &PairSample::gap>("gap"),
      column<&WorstRow::of, &KindResult::exact>("exact", "The distance, rounded once"),
      column<&WorstRow::of, &KindResult::computed>("computed",
                                                   "The distance by the formula of the word"),
      column<&WorstRow::of, &KindResult::in_contact>("in_contact", "The right answer")};
  return {"pair", "A wrong decision about a hard case.", columns, true};
}

struct FamilyRow {
  const AccuracyChoices& choices;
  std::size_t index;
  const KindResult* first;  ///< of the first choice

  Counts wrong() const {
    Counts counts;
    for (const AccuracyChoice& c : choices)
      counts.emplace_back(to_string(c.accuracy), c.hard.kinds[index].wrong);
    return counts;
  }
};

void each_worst(const FamilyRow& r, const std::function<void(const WorstRow&)>& add) {
  for (const AccuracyChoice& c : r.choices)
    if (const KindResult& kind = c.hard.kinds[r.index]; kind.wrong > 0) add({c.accuracy, &kind});
}

Record<FamilyRow> record_of(const FamilyRow*) {
  using Row = FamilyRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::first, &KindResult::kind, &HardFamily::id>("id"),
      column<&Row::first, &KindResult::kind, &HardFamily::name>("name"),
      column<&Row::first, &KindResult::kind, &HardFamily::group>("group"),
      column<&Row::first, &KindResult::kind, &HardFamily::expected>("expected"),
      column<&Row::first, &KindResult::pairs>("pairs"),
      column<&Row::wrong>("wrong", "Wrong decisions of each word"),
      column("worst", "Of each word that is wrong: the wrong decision with the largest error",
             [](const Row& r) {
               return Rows<WorstRow>{[&r](const auto& add) { each_worst(r, add); }};
             })};
  return {"family", "A kind of hard cases.", columns};
}

struct WrongRow {
  Accuracy word;
  const WrongPair* pair;
};
Record<WrongRow> record_of(const WrongRow*) {
  static constexpr Column<WrongRow> columns[] = {
      column<&WrongRow::word>("word"),
      column<&WrongRow::pair, &WrongPair::interface>("interface"),
      column<&WrongRow::pair, &WrongPair::secondary>("secondary", "Node ids"),
      column<&WrongRow::pair, &WrongPair::main>("main"),
      column<&WrongRow::pair, &WrongPair::gap>("gap"),
      column<&WrongRow::pair, &WrongPair::exact>(
          "exact", "The distance; null: the interface has other rules, or moves nodes"),
      column<&WrongRow::pair, &WrongPair::computed>("computed",
                                                    "The distance by the formula of the word")};
  return {"wrong_pair", "A wrong decision about a pair of the deck.", columns, true};
}

}  // namespace

Record<HardMotion::Line> record_of(const HardMotion::Line*) {
  static constexpr Column<HardMotion::Line> columns[] = {
      column<&HardMotion::Line::accuracy>("word"),
      column<&HardMotion::Line::depth>("depth", "By step"),
      column<&HardMotion::Line::force>("force", "By step: the elastic force of a stiffness of 1"),
      column<&HardMotion::Line::jumps>("jumps",
                                       "Steps where the depth changes by more than the way")};
  return {"line", "", columns};
}

Record<HardMotion> record_of(const HardMotion*) {
  using Row = HardMotion;
  static constexpr Column<Row> columns[] = {
      column("corners",
             [](const Row& r) {
               return std::array{point(r.corners[0]), point(r.corners[1]), point(r.corners[2])};
             }),
      column<&Row::from, &point>("from"),
      column<&Row::to, &point>("to"),
      column<&Row::gap>("gap"),
      column<&Row::way>("way", "Of the node in one step"),
      column("lines", [](const Row& r) { return rows_of(r.lines); }),
      column("sentences", [](const Row& r) { return rows_of(motion_sentences(r)); })};
  return {
      "motion",
      "One hard case in motion: a node passes a triangle of hardly any area in straight steps of "
      "equal length.",
      columns};
}

namespace {

struct AccuracyDocument {
  const AccuracyChoices* choices;
  const AccuracyContext* context;
  HardMotion motion;
};

void each_wrong_pair(const AccuracyDocument& r, const std::function<void(const WrongRow&)>& add) {
  for (const AccuracyChoice& c : *r.choices)
    if (c.deck)
      for (const WrongPair& p : c.deck->wrong) add({c.accuracy, &p});
}

Record<AccuracyDocument> record_of(const AccuracyDocument*) {
  using Row = AccuracyDocument;
  static constexpr Column<Row> of_machine[] = {
      column<&Row::context, &AccuracyContext::processor>("processor"),
      column("compiler", [](const Row&) { return accuracy_compiler(); }),
      column<&Row::context, &AccuracyContext::command>("command")};
  static constexpr Record<Row> machine{"machine", "", of_machine, true};
  static constexpr Column<Row> columns[] = {
      column("deck",
             [](const Row& r) {
               return if_any(r.context->deck != nullptr,
                             DeckRow{r.context->path, r.context->deck, nullptr, nullptr});
             }),
      group<machine>("machine"),
      column("advice", "Two sentences: which accuracy to keep, and why",
             [](const Row& r) { return rows_of(accuracy_advice(*r.choices)); }),
      column("choices", "reference, fast, robust, exact",
             [](const Row& r) { return rows_of(*r.choices); }),
      column("families",
             [](const Row& r) {
               return rows_of(r.choices->front().hard.kinds, [&r](const KindResult& k) {
                 const auto& first = r.choices->front().hard.kinds;
                 return FamilyRow{*r.choices, static_cast<std::size_t>(&k - first.data()), &k};
               });
             }),
      column("wrong_pairs",
             [](const Row& r) {
               return Rows<WrongRow>{[&r](const auto& add) { each_wrong_pair(r, add); }};
             }),
      column<&Row::motion>("motion")};
  return {"document", "", columns};
}

constexpr DocumentHead accuracy_head{
    "deck/accuracy", 2,
    "Written by deck accuracy --json: what each word of --accuracy costs in time and decides "
    "wrongly, on the hard cases and, with the member deck, on a deck."};

}  // namespace

DocumentSchema accuracy_schema() { return document_schema<AccuracyDocument>(accuracy_head); }

std::string accuracy_json(const AccuracyChoices& choices, const AccuracyContext& context) {
  return write_document(accuracy_head, AccuracyDocument{&choices, &context, hard_motion()});
}

}  // namespace deck
