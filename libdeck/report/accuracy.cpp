// `deck accuracy`: what each word of --accuracy costs and gives, as text and JSON.
#include "report/shared/accuracy.hpp"

#include <fmt/format.h>

#include "accuracy/shared/choice.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

std::array<double, 3> point(const Point3<double>& p) { return {p.x, p.y, p.z}; }

TextTable::Cell share_cell(std::uint64_t wrong, std::uint64_t all) {
  return {share_text(wrong, all), wrong == 0 ? Tone::green : Tone::red};
}

}  // namespace

std::string accuracy_compiler() {
#ifdef __clang__
  const std::string name = "clang ";
#else
  const std::string name = "g++ ";
#endif
#ifdef __OPTIMIZE__
  return name + __VERSION__ + ", optimised, no contraction";
#else
  return name + __VERSION__ + ", not optimised, no contraction";
#endif
}

std::string accuracy_text(const AccuracyChoices& choices, const AccuracyContext& context,
                          bool color, std::size_t width) {
  std::string out;
  if (!context.path.empty())
    out = terminal_text(context.path) + (choices.front().deck ? "\n" : ": no pair to decide\n");
  for (const std::string& sentence : accuracy_advice(choices)) out += sentence + "\n";
  const bool deck = choices.front().deck.has_value();
  TextTable table({"--accuracy", "+>this deck", "+>against fast", "+>wrong", ">hard pairs",
                   ">wrong", ">rewritten"},
                  deck);
  for (const AccuracyChoice& c : choices) {
    const Tone own = c.accuracy == Accuracy::robust ? Tone::bold : Tone::plain;
    table.row(
        {{to_string(c.accuracy), own},
         {deck ? (c.deck->extrapolated ? "about " : "") + seconds_text(c.deck->seconds) : "", own},
         {!deck                          ? ""
          : c.accuracy == Accuracy::fast ? "1 x"
                                         : ratio_text(c.deck->ratio),
          own},
         {deck ? std::to_string(c.deck->wrong.size()) : "",
          deck && c.deck->wrong.empty() ? Tone::green : Tone::red},
         {ratio_text(c.hard.ratio.value), own},
         share_cell(c.hard.wrong, c.hard.pairs),
         share_cell(c.hard.other_answer, c.hard.rewritten)});
  }
  out += "\n" + table.fitted(width, color);
  if (deck)
    out += fmt::format("This deck: deck gaps, {}, processor time. ",
                       count(choices.front().deck->pairs, "pair", "pairs"));
  const auto& hard = choices[2].hard;
  out += fmt::format(
      "Hard: {} pairs of {} kinds; rewritten: answers that change when a pair "
      "is written otherwise (--json: the machine).\n",
      hard.pairs, hard.kinds.size());
  if (context.digest.own != context.digest.recorded)
    out += "This build answers hard pairs otherwise than recorded (--json: answers).\n";
  return out;
}

LINE_RECORD(AccuracyChoice::OnDeck, "on_deck", "", COLUMN("seconds", "Whole deck gaps", r.seconds),
            COLUMN("ratio", "Time against fast", r.ratio.value),
            COLUMN("spread", "Of both times, as a share", r.ratio.spread),
            COLUMN("pairs", "", r.pairs), COLUMN("wrong", "", r.wrong.size()),
            COLUMN("extrapolated", "Only a part of the pairs was computed exactly",
                   r.extrapolated));

LINE_RECORD(AccuracyChoice::OnHardCases, "on_hard_cases", "",
            COLUMN("ns_per_pair", "", r.ns_per_pair),
            COLUMN("ratio", "Time against fast", r.ratio.value),
            COLUMN("spread", "Of both times, as a share", r.ratio.spread),
            COLUMN("pairs", "", r.pairs), COLUMN("wrong", "", r.wrong),
            COLUMN("rewritten", "Pairs written down in other ways", r.rewritten),
            COLUMN("other_answer", "Of these: the answer changed", r.other_answer),
            COLUMN("kinds_never_wrong", "Of the members of families", r.kinds_never_wrong()));

RECORD(AccuracyChoice, "choice", "What a word of --accuracy costs and gives.",
       COLUMN("word", "", r.accuracy), COLUMN("deck", "null: no deck, or no pair in it", r.deck),
       COLUMN("hard", "", r.hard));

RECORD(HardMotion::Line, "line", "", COLUMN("word", "", r.accuracy),
       COLUMN("depth", "By step", r.depth),
       COLUMN("force", "By step: the elastic force of a stiffness of 1", r.force),
       COLUMN("jumps", "Steps where the depth changes by more than the way", r.jumps));

RECORD(HardMotion, "motion",
       "One hard case in motion: a node passes a triangle of hardly any area in straight steps of "
       "equal length.",
       COLUMN("corners", "",
              std::array{point(r.corners[0]), point(r.corners[1]), point(r.corners[2])}),
       COLUMN("from", "", point(r.from)), COLUMN("to", "", point(r.to)), COLUMN("gap", "", r.gap),
       COLUMN("way", "Of the node in one step", r.way), COLUMN("lines", "", rows_of(r.lines)),
       COLUMN("sentences", "", rows_of(motion_sentences(r))));

namespace {

const char* kind_of(const PairSample& s) { return s.edges ? "edge_edge" : "node_segment"; }
std::vector<std::array<double, 3>> points_of(const PairSample& s) {
  std::vector<std::array<double, 3>> out;
  for (std::size_t k = 0; k < (s.edges ? 4u : 5u); ++k) out.push_back(point(s.x[k]));
  return out;
}
constexpr char points_are[] =
    "Corners and node, or both nodes of the secondary and of the main edge";

struct WorstRow {
  Accuracy word;
  const KindResult* of;
};
LINE_RECORD(WorstRow, "pair", "A wrong decision about a hard case.", COLUMN("word", "", r.word),
            COLUMN("kind", "node_segment or edge_edge", kind_of(r.of->worst)),
            COLUMN("triangle", "", r.of->worst.triangle),
            COLUMN("points", points_are, points_of(r.of->worst)),
            COLUMN("gap", "", r.of->worst.gap),
            COLUMN("exact", "The distance, rounded once", r.of->exact),
            COLUMN("computed", "The distance by the formula of the word", r.of->computed),
            COLUMN("in_contact", "The right answer", r.of->in_contact));

struct FamilyRow {
  const AccuracyChoices& choices;
  const KindResult* first;  ///< of the first choice

  /// This kind in another choice.
  const KindResult& in(const AccuracyChoice& choice) const {
    return choice.hard.kinds[static_cast<std::size_t>(first - choices.front().hard.kinds.data())];
  }
  Counts wrong() const {
    Counts counts;
    for (const AccuracyChoice& c : choices) counts.emplace_back(to_string(c.accuracy), in(c).wrong);
    return counts;
  }
};

void each_worst(const FamilyRow& r, const std::function<void(const WorstRow&)>& add) {
  for (const AccuracyChoice& c : r.choices)
    if (r.in(c).wrong > 0) add({c.accuracy, &r.in(c)});
}

RECORD(FamilyRow, "family", "A kind of hard cases.", COLUMN("id", "", r.first->kind->id),
       COLUMN("name", "", r.first->kind->name), COLUMN("group", "", r.first->kind->group),
       COLUMN("expected", "", r.first->kind->expected), COLUMN("pairs", "", r.first->pairs),
       COLUMN("wrong", "Wrong decisions of each word", r.wrong()),
       COLUMN("worst", "Of each word that is wrong: the wrong decision with the largest error",
              rows_from<each_worst>(r)));

struct WrongRow {
  Accuracy word;
  const WrongPair* pair;
};
LINE_RECORD(WrongRow, "wrong_pair", "A wrong decision about a pair of the deck.",
            COLUMN("word", "", r.word), COLUMN("interface", "", r.pair->interface),
            COLUMN("secondary", "Node ids", r.pair->secondary), COLUMN("main", "", r.pair->main),
            COLUMN("gap", "", r.pair->gap),
            COLUMN("exact", "The distance; null: the interface has other rules, or moves nodes",
                   r.pair->exact),
            COLUMN("computed", "The distance by the formula of the word", r.pair->computed),
            COLUMN("in_contact", "The right answer", r.pair->in_contact),
            COLUMN("kind", "node_segment or edge_edge", kind_of(r.pair->sample)),
            COLUMN("triangle", "", r.pair->sample.triangle),
            COLUMN("points", points_are, points_of(r.pair->sample)));

struct AccuracyDocument {
  const AccuracyChoices* choices;
  const AccuracyContext* context;
  HardMotion motion;
};

std::optional<WrongRow> nearest_of(const AccuracyDocument& r) {
  if (!r.context->picture.nearest) return {};
  return WrongRow{Accuracy::reference, &*r.context->picture.nearest};
}

void each_wrong_pair(const AccuracyDocument& r, const std::function<void(const WrongRow&)>& add) {
  for (const AccuracyChoice& c : *r.choices)
    if (c.deck)
      for (const WrongPair& p : c.deck->wrong) add({c.accuracy, &p});
}

RECORD(AccuracyDocument, "document", "",
       COLUMN("deck", "",
              if_any(r.context->deck != nullptr,
                     DeckRow{r.context->path, r.context->deck, nullptr, nullptr})),
       LINE_OBJECT("machine", "", COLUMN("processor", "", r.context->processor),
                   COLUMN("compiler", "", accuracy_compiler()),
                   COLUMN("command", "", r.context->command)),
       COLUMN("advice", "What the price buys on the deck, and which word to keep",
              rows_of(accuracy_advice(*r.choices))),
       COLUMN("choices", "reference, fast, robust, exact", rows_of(*r.choices)),
       COLUMN("families", "", rows<FamilyRow>(r.choices->front().hard.kinds, *r.choices)),
       COLUMN("wrong_pairs", "", rows_from<each_wrong_pair>(r)),
       COLUMN("nearest", "The pair of the deck in contact whose distance is nearest to its gap",
              nearest_of(r)),
       COLUMN("motion", "", r.motion),
       LINE_OBJECT("answers", "What this build answers for hard pairs, bit for bit",
                   COLUMN("digest", "", fmt::format("{:016x}", r.context->digest.own)),
                   COLUMN("recorded", "Of g++ and clang, -O0 and -O3",
                          fmt::format("{:016x}", r.context->digest.recorded)),
                   COLUMN("equal", "", r.context->digest.own == r.context->digest.recorded)));

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
