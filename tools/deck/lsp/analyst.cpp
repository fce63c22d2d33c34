// Follows edits that stay within one block, and says what of the last look is still true.
#include "lsp/analyst.hpp"

#include <algorithm>
#include <cstring>

#include "deck/keyword/recognise.hpp"
#include "deck/model/reuse.hpp"
#include "deck/model/selection.hpp"

namespace deck::lsp {
namespace {

/// Bytes that two texts have in common at their begin.
std::uint64_t common_head(std::string_view a, std::string_view b) {
  const std::size_t most = std::min(a.size(), b.size());
  constexpr std::size_t step = 4096;
  std::size_t at = 0;
  while (at + step <= most && std::memcmp(a.data() + at, b.data() + at, step) == 0) at += step;
  while (at < most && a[at] == b[at]) ++at;
  return at;
}
std::uint64_t common_tail(std::string_view a, std::string_view b, std::uint64_t head) {
  const std::size_t most = std::min(a.size(), b.size()) - head;
  constexpr std::size_t step = 4096;
  std::size_t n = 0;
  while (n + step <= most &&
         std::memcmp(a.data() + a.size() - n - step, b.data() + b.size() - n - step, step) == 0)
    n += step;
  while (n < most && a[a.size() - 1 - n] == b[b.size() - 1 - n]) ++n;
  return n;
}

bool is_kind(const Block& b, std::initializer_list<std::string_view> kinds) {
  return b.schema != nullptr &&
         std::find(kinds.begin(), kinds.end(), b.schema->kind) != kinds.end();
}

/// Blocks that other blocks are read by: nothing of the last look is kept.
bool governs_others(const Block& b) {
  constexpr std::string_view starts[] = {"//", "/BEGIN", "/PARAMETER", "/UNIT"};
  return is_kind(b, {"parameter", "unit"}) ||
         std::any_of(std::begin(starts), std::end(starts),
                     [&](std::string_view s) { return b.header.starts_with(s); });
}

/// Blocks that only the interfaces and the rules read, not the model.
bool outside_model(const Block& b) {
  if (b.schema == nullptr) return false;
  return b.schema->kind == "inter" || b.schema->keyword.starts_with("/DEFAULT/INTER");
}

/// Blocks that say what groups have in them. What of nodes, elements, parts and subsets counts,
/// same_members compares.
bool defines_members(const Deck& deck, const Block& b) {
  if (is_kind(b, {"grnod", "surf", "line", "set", "box", "grshel", "grsh3n", "grbric", "grquad",
                  "grtria", "grtrus", "grbeam", "grspri", "grpart"}))
    return true;
  // Boxes have axes.
  return is_kind(b, {"skew", "frame"}) &&
         std::any_of(deck.blocks.begin(), deck.blocks.end(),
                     [](const Block& other) { return is_kind(other, {"box"}); });
}

/// True where a finding, or a place beside it, lies in the block.
bool speak_of(const Diagnostics& findings, const Block& block) {
  const auto inside = [&](const Span& s) {
    return s.valid() && std::any_of(block.body.begin(), block.body.end(), [&](const Piece& p) {
             return s.file == p.file && s.offset >= p.begin && s.offset <= p.end;
           });
  };
  return std::any_of(findings.all().begin(), findings.all().end(), [&](const Diagnostic& d) {
    return inside(d.span) || std::any_of(d.notes.begin(), d.notes.end(),
                                         [&](const auto& note) { return inside(note.first); });
  });
}

bool same_tree(const Deck& a, const Deck& b) {
  if (a.sources.size() != b.sources.size() || a.blocks.size() != b.blocks.size() ||
      a.includes.size() != b.includes.size() || a.submodels.size() != b.submodels.size() ||
      a.end_seen != b.end_seen)
    return false;
  for (std::uint32_t f = 0; f < a.sources.size(); ++f)
    if (a.sources[f].path() != b.sources[f].path()) return false;
  return true;
}

/// True for a file that the deck includes once.
bool single(const Deck& deck, std::uint32_t file) {
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f)
    if (f != file && deck.sources[f].path() == deck.sources[file].path()) return false;
  return true;
}

}  // namespace

/// Brings slacks and padded texts up to date with an edit of one block. nullopt: it was another
/// kind of edit, and they are not what they should be any more.
std::optional<Analyst::Edit> Analyst::follow(const Syntax& now) {
  if (real_ == nullptr || last_ == nullptr || slacks_.empty()) return std::nullopt;
  const Deck &old_deck = real_->deck, &new_deck = now.deck;
  if (!same_tree(old_deck, new_deck)) return std::nullopt;
  std::uint32_t file = Span::no_file;
  for (std::uint32_t f = 0; f < old_deck.sources.size(); ++f) {
    if (old_deck.sources[f].bytes() == new_deck.sources[f].bytes()) continue;
    if (file != Span::no_file) return std::nullopt;
    file = f;
  }
  if (file == Span::no_file) return Edit{true, 0};
  const std::string& path = old_deck.sources[file].path();
  std::vector<Slack>* slacks = slacks_.find(path);
  if (slacks == nullptr || !single(old_deck, file)) return std::nullopt;
  const std::string_view before = old_deck.sources[file].bytes();
  const std::string_view after = new_deck.sources[file].bytes();
  const std::uint64_t head = common_head(before, after);
  const std::uint64_t tail = common_tail(before, after, head);
  const std::uint64_t old_end = before.size() - tail, new_end = after.size() - tail;
  // The body that the edit lies in: at its very end it is the one before the next header.
  std::int64_t k = -1;
  Piece piece;
  for (const std::uint64_t at : {head, head == 0 ? head : head - 1}) {
    k = real_->index.find(file, at);
    if (k < 0) continue;
    const Block& b = old_deck.blocks[static_cast<std::size_t>(k)];
    if (!b.body.empty()) piece = b.body.back();
    if (!b.body.empty() && piece.file == file && piece.begin <= head && old_end <= piece.end) break;
    k = -1;
  }
  if (k < 0) return std::nullopt;
  const auto block = static_cast<std::size_t>(k);
  const Block &old_block = old_deck.blocks[block], &new_block = new_deck.blocks[block];
  if (governs_others(old_block) || old_block.header != new_block.header || new_block.body.empty() ||
      new_block.body.size() != old_block.body.size() || new_block.body.back().begin != piece.begin)
    return std::nullopt;
  const std::uint64_t new_piece_end = piece.end + new_end - old_end;  // modulo 2^64
  if (new_block.body.back().end != new_piece_end || new_piece_end <= piece.begin ||
      after[new_piece_end - 1] != '\n')
    return std::nullopt;
  const auto own = std::find_if(slacks->begin(), slacks->end(),
                                [&](const Slack& s) { return s.offset == piece.end; });
  if (own == slacks->end()) return std::nullopt;
  const std::uint64_t room = own->size + (old_end - head);
  if (room < new_end - head + 2) return std::nullopt;
  const std::uint64_t size = room - (new_end - head);
  // Bytes from the edit to the end of the slack: as many as before, so nothing else moves.
  const std::uint64_t from = slacks_.padded_offset(path, head, piece.end);
  const std::string fresh =
      std::string(after.substr(head, new_piece_end - head)) + slack_text(size);
  std::string& text = padded_.at(path);
  if (from + fresh.size() > text.size()) return std::nullopt;
  text.replace(from, fresh.size(), fresh);
  const std::uint64_t shift = new_end - old_end;
  own->size = size;
  for (auto it = own; it != slacks->end(); ++it) it->offset += shift;
  return Edit{false, block};
}

void Analyst::start_anew(const Syntax& now) {
  std::vector<std::uint32_t> files;
  for (std::uint32_t f = 0; f < now.deck.sources.size(); ++f)
    if (now.edited.contains(now.deck.sources[f].path()) && single(now.deck, f)) files.push_back(f);
  slacks_ = SlackTable::of(now.deck, files);
  padded_.clear();
  for (std::uint32_t f = 0; f < now.deck.sources.size(); ++f) {
    const Source& source = now.deck.sources[f];
    if (now.edited.contains(source.path()))
      padded_[source.path()] = slacks_.padded(source.path(), source.bytes());
  }
}

std::shared_ptr<const Deck> Analyst::read(const Syntax& now, const SchemaSet& schemas,
                                          const Settings& settings) const {
  ReadOptions options;
  options.include_paths = settings.include_paths;
  options.limits = settings.limits;
  options.overlay = &padded_;
  auto deck = read_deck(now.deck.sources[0].path(), schemas, options);
  if (!deck) return nullptr;
  auto out = std::make_shared<Deck>(std::move(*deck));
  return out;
}

void Analyst::build(Semantics& out, const std::optional<Edit>& edit, const SchemaSet& schemas,
                    const Settings& settings) {
  const bool follows = edit && last_ != nullptr && last_->model != nullptr;
  const Block* const block = follows && !edit->none ? &out.deck->blocks[edit->block] : nullptr;
  if (follows && (edit->none || outside_model(*block))) {
    out.model = last_->model;
    out.model_findings = last_->model_findings;
    out.model_deck = last_->model_deck;
    out.kept = last_->kept;
    return;
  }
  auto findings = std::make_shared<Diagnostics>(settings.limits.diagnostics_per_rule);
  ModelOptions options;
  options.threads = settings.threads;
  options.limits = settings.limits;
  auto model = std::make_shared<Model>(build_model(*out.deck, schemas, *findings, options));
  // What selections have to say is kept with them: its places move with an edit of their block.
  if (follows && !defines_members(*out.deck, *block) &&
      !speak_of(last_->model->selections->diagnostics(), last_->deck->blocks[edit->block]) &&
      same_members(*last_->model, *model)) {
    model->selections = last_->model->selections;
    model->selections->rebind(*model);
    out.kept = last_->kept;  // whose blocks the definitions are
  } else {
    out.kept = out.deck;
  }
  out.model_deck = out.deck;
  out.model = std::move(model);
  out.model_findings = std::move(findings);
}

std::shared_ptr<const Semantics> Analyst::look(const std::shared_ptr<const Syntax>& now,
                                               const SchemaSet& schemas, const Settings& settings,
                                               const std::atomic<bool>& stop) {
  auto out = std::make_shared<Semantics>(now);
  out->refusal = no_starter_deck(now->deck);
  if (!out->refusal.empty()) {
    real_ = nullptr;
    last_ = nullptr;
    return out;
  }
  std::optional<Edit> edit = follow(*now);
  if (!edit) start_anew(*now);
  out->deck = read(*now, schemas, settings);
  const auto usable = [&] {
    return out->deck != nullptr && out->deck->blocks.size() == now->deck.blocks.size() &&
           out->deck->includes.size() == now->deck.includes.size();
  };
  if (edit && !usable()) {
    edit.reset();
    start_anew(*now);
    out->deck = read(*now, schemas, settings);
  }
  EngineFiles engine;
  if (usable()) {
    // The same number of files as the deck in the editor has, Engine files included.
    auto deck = std::const_pointer_cast<Deck>(out->deck);
    engine = read_engine_files(*deck, settings.limits);
  }
  if (!usable() || out->deck->sources.size() != now->deck.sources.size()) {
    // Comment lines mean something here: the text as it is, without them.
    edit.reset();
    slacks_ = {};
    padded_.clear();
    out->deck = std::shared_ptr<const Deck>(now, &now->deck);
    engine = now->engine;
  }
  out->slacks = slacks_;
  real_ = nullptr;
  if (stop) return nullptr;
  build(*out, edit, schemas, settings);
  if (stop) return nullptr;
  find(*out, engine, schemas, settings);
  real_ = now;
  last_ = out;
  return out;
}

}  // namespace deck::lsp
