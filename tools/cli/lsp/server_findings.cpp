// Scheduling of analyses, and sending of findings to the client.
#include <algorithm>

#include "deck/text.hpp"
#include "lsp/server.hpp"

namespace deck::lsp {
namespace {

int severity_of(Severity s) { return s == Severity::error ? 1 : s == Severity::warning ? 2 : 3; }

std::string full_message(const Finding& d) {
  std::string out = d.message;
  if (!d.reference_behaviour.empty()) out += "\nSolver: " + d.reference_behaviour;
  if (!d.help.empty()) out += "\nHelp: " + d.help;
  return out;
}

}  // namespace

// ---- when ------------------------------------------------------------------------------------

void Server::schedule(const std::string& path, bool now) {
  if (workspace_.deck_of(path) == nullptr) return;
  for (const OpenDeck* deck : decks_with(path)) {
    due_[deck->path] = Clock::now() + std::chrono::milliseconds(now ? 0 : delay_ms_);
    // The running analysis is of an outdated text.
    if (const auto it = analysing_.find(deck->path); it != analysing_.end()) *it->second = true;
  }
}

/// A file can be included by several open decks.
std::vector<OpenDeck*> Server::decks_with(const std::string& path) {
  std::vector<OpenDeck*> out;
  for (auto& [root, deck] : workspace_.decks())
    if (deck.syntax != nullptr && deck.syntax->file_of(path) != Span::no_file) out.push_back(&deck);
  return out;
}

std::optional<Server::Clock::time_point> Server::next_due() const {
  std::optional<Clock::time_point> first;
  const auto consider = [&](Clock::time_point t) {
    if (!first || t < *first) first = t;
  };
  for (const auto& [root, when] : due_)
    if (!analysing_.contains(root)) consider(when);
  return first;
}

void Server::start_due() {
  const auto now = Clock::now();
  for (auto it = due_.begin(); it != due_.end();) {
    const auto deck = workspace_.decks().find(it->first);
    if (deck == workspace_.decks().end()) {
      it = due_.erase(it);
      continue;
    }
    // One analysis at a time per deck; later changes are analysed afterwards.
    if (it->second > now || analysing_.contains(it->first)) {
      ++it;
      continue;
    }
    it = due_.erase(it);
    start_analysis(deck->second);
  }
}

namespace {

/// True if both decks have the same files, so that places can be transferred.
bool same_files(const Deck& a, const Deck& b) {
  if (a.sources.size() != b.sources.size()) return false;
  for (std::uint32_t f = 0; f < a.sources.size(); ++f)
    if (a.sources[f].path() != b.sources[f].path() ||
        a.sources[f].bytes().size() != b.sources[f].bytes().size())
      return false;
  return true;
}

}  // namespace

void Server::start_analysis(OpenDeck& deck) {
  const auto& syntax = workspace_.refresh(deck);
  if (syntax == nullptr || deck.fragment) {
    deck.semantics = nullptr;
    publish(deck);
    return;
  }
  auto stop = std::make_shared<std::atomic<bool>>(false);
  analysing_[deck.path] = stop;
  analyst_->push([this, stop, syntax, path = deck.path, texts = workspace_.texts(),
                  &schemas = workspace_.schemas(), settings = workspace_.settings()] {
    auto found =
        *stop ? nullptr : analyse(path, texts, syntax->generation, schemas, settings, *stop);
    if (found != nullptr && found->loaded && !same_files(syntax->deck, found->loaded->deck()))
      found = nullptr;
    queue_.push([this, stop, path, found = std::move(found)] {
      analysing_.erase(path);
      const auto it = workspace_.decks().find(path);
      if (it == workspace_.decks().end()) return;
      if (found == nullptr) {
        if (*stop) return;
        workspace_.changed();  // a file on disk changed between the two readings
        return schedule(path);
      }
      const bool first = it->second.semantics == nullptr;
      it->second.semantics = found;
      publish(it->second);
      if (first && client_.refresh_hints) request("workspace/inlayHint/refresh", nullptr);
    });
  });
}

void Server::start_geometry(OpenDeck& deck) {
  if (deck.fragment) return;
  if (const auto it = examining_.find(deck.path); it != examining_.end()) it->second->stop = true;
  auto progress = begin_progress("Contacts of " + deck.path.substr(deck.path.rfind('/') + 1));
  examining_[deck.path] = progress;
  geometer_->push([this, progress, path = deck.path, texts = workspace_.texts(),
                   &schemas = workspace_.schemas(), settings = workspace_.settings()] {
    const auto told = [&](std::size_t done, std::size_t all) {
      report_progress(*progress, done, all);
    };
    auto found =
        progress->stop ? nullptr : examine(path, texts, schemas, settings, told, progress->stop);
    queue_.push([this, path, progress, found = std::move(found)] {
      end_progress(progress);
      if (const auto it = examining_.find(path); it != examining_.end() && it->second == progress)
        examining_.erase(it);
      const auto it = workspace_.decks().find(path);
      if (it == workspace_.decks().end() || found == nullptr) return;
      it->second.geometry = found;
      if (it->second.semantics != nullptr) publish(it->second);
      if (client_.refresh_lenses) request("workspace/codeLens/refresh", nullptr);
      if (client_.refresh_hints) request("workspace/inlayHint/refresh", nullptr);
    });
  });
}

// ---- what ------------------------------------------------------------------------------------

Json Server::finding(const OpenDeck& deck, const Finding& d) const {
  const View view(workspace_, client_, deck, deck.path);
  Json out = {{"range", d.span.valid() ? view.range(d.span) : view.range(0, 0, 0)},
              {"severity", severity_of(d.severity)},
              {"code", finding_name(d)},
              {"source", "deck"},
              {"message", utf8(full_message(d))},
              {"data", {{"rule", finding_name(d)}, {"message", utf8(d.message)}}}};
  if (d.fix) out["data"]["fix"] = {{"title", utf8(d.fix->title)}, {"safe", d.fix->safe}};
  Json related = Json::array();
  for (const auto& [span, text] : d.notes)
    if (span.valid())
      related.push_back({{"location", view.location(span)}, {"message", utf8(text)}});
  if (!related.empty()) out["relatedInformation"] = std::move(related);
  return out;
}

namespace {

/// The nearest line with the text of a line of an earlier text; nullopt: none.
std::optional<std::uint64_t> line_now(const LineTable& lines, std::string_view text,
                                      const Geometry::PlacedFinding& f) {
  for (std::uint64_t away = 0; away < 5000; ++away) {
    if (lines.line(text, f.line + away) == f.line_text && f.line + away < lines.size())
      return f.line + away;
    if (away <= f.line && lines.line(text, f.line - away) == f.line_text &&
        f.line - away < lines.size())
      return f.line - away;
  }
  return std::nullopt;
}

}  // namespace

/// True if the findings belong to the current text.
bool Server::is_current(const OpenDeck& deck) const {
  return deck.semantics != nullptr && workspace_.current(deck) &&
         deck.semantics->generation == deck.syntax->generation;
}

/// Findings of a deck in a file, and further ones of other open decks with the file.
Json Server::with_others(const OpenDeck& deck, const std::string& path, const Json& own) {
  Json out = own;
  std::set<std::string> said;
  const auto is_new = [&](const Json& f) {
    return said.insert(f.at("range").dump() + f.value("code", "") + f.at("message").dump()).second;
  };
  for (const auto& [root, other] : workspace_.decks()) {
    const auto list = other.published.find(path);
    if (&other == &deck || list == other.published.end() || !is_current(other)) continue;
    if (said.empty()) std::for_each(own.begin(), own.end(), is_new);
    std::copy_if(list->second.begin(), list->second.end(), std::back_inserter(out), is_new);
  }
  return out;
}

void Server::publish(OpenDeck& deck) {
  std::map<std::string, Json> by_file;
  // Findings without a place are shown in the first line of the main file; severity 1: error, 2:
  // warning.
  const auto about_the_deck = [&](int severity, const std::string& message) {
    const Json start = {{"line", 0}, {"character", 0}};
    by_file.try_emplace(deck.path, Json::array())
        .first->second.push_back({{"range", {{"start", start}, {"end", start}}},
                                  {"severity", severity},
                                  {"source", "deck"},
                                  {"message", utf8(message)}});
  };
  const Semantics* s = deck.semantics.get();
  // Findings of an earlier text would be on wrong lines; new ones will follow.
  if (s != nullptr && !is_current(deck)) return;
  if (s != nullptr && s->refusal.empty()) {
    for (const Finding& d : s->lint.findings) {
      const std::uint32_t file = d.span.valid() ? d.span.file : 0;
      by_file.try_emplace(deck.syntax->deck.sources[file].path(), Json::array())
          .first->second.push_back(finding(deck, d));
    }
    if (deck.geometry != nullptr)
      for (const Geometry::PlacedFinding& f : deck.geometry->findings) {
        const std::uint32_t file = deck.syntax->file_of(f.path);
        if (file == Span::no_file) continue;
        const LineTable& lines = deck.syntax->lines(file);
        const auto line = line_now(lines, deck.syntax->deck.sources[file].bytes(), f);
        if (!line) continue;
        Finding d = f.finding;
        const std::uint64_t begin = lines.start(*line);
        const std::uint64_t column = d.span.offset - std::min(d.span.offset, f.line_offset);
        d.span = {file, d.span.length, begin + std::min<std::uint64_t>(column, f.line_text.size())};
        by_file.try_emplace(f.path, Json::array()).first->second.push_back(finding(deck, d));
      }
  } else if (s != nullptr) {
    about_the_deck(2, s->refusal);
  }
  if (s != nullptr && !s->config_error.empty()) about_the_deck(1, s->config_error);
  // Also files that had findings before, and open files without findings.
  for (const auto& [file, list] : deck.published) by_file.try_emplace(file, Json::array());
  if (deck.syntax != nullptr)
    for (std::uint32_t f = 0; f < deck.syntax->deck.sources.size(); ++f)
      if (const std::string& path = deck.syntax->deck.sources[f].path();
          workspace_.find(path) != nullptr)
        by_file.try_emplace(path, Json::array());
  deck.published.clear();
  for (auto& [path, list] : by_file) {
    Json params = {{"uri", workspace_.uri(path)}, {"diagnostics", with_others(deck, path, list)}};
    if (!list.empty()) deck.published.emplace(path, std::move(list));
    if (const Document* d = workspace_.find(path)) params["version"] = d->version;
    notify("textDocument/publishDiagnostics", std::move(params));
  }
}

// ---- progress --------------------------------------------------------------------------------

std::shared_ptr<Server::Progress> Server::begin_progress(const std::string& title) {
  auto progress = std::make_shared<Progress>();
  if (!client_.progress) return progress;
  progress->token = "deck-progress-" + std::to_string(next_id_++);
  progresses_[progress->token] = progress;
  request("window/workDoneProgress/create", {{"token", progress->token}});
  notify("$/progress",
         {{"token", progress->token},
          {"value",
           {{"kind", "begin"}, {"title", utf8(title)}, {"cancellable", true}, {"percentage", 0}}}});
  return progress;
}

void Server::report_progress(const Progress& progress, std::size_t done, std::size_t all) {
  if (progress.token.empty() || all == 0) return;
  notify("$/progress", {{"token", progress.token},
                        {"value",
                         {{"kind", "report"},
                          {"message", std::to_string(done) + " of " + std::to_string(all)},
                          {"percentage", std::min<std::size_t>(100, 100 * done / all)}}}});
}

void Server::end_progress(const std::shared_ptr<Progress>& progress) {
  if (progress->token.empty()) return;
  progresses_.erase(progress->token);
  notify("$/progress", {{"token", progress->token}, {"value", {{"kind", "end"}}}});
}

}  // namespace deck::lsp
