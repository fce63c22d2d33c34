// run_lint, in this order:
//   1. findings of reading, model and interfaces; all checks on the decoded blocks; team rules;
//      extra checks (geometry); findings of groups
//   2. sorted without duplicates; consequences and covered findings dropped; with a missing include
//      also findings about missing entities
//   3. per-file ignores and suppression comments; unused suppressions become findings
//   4. baseline, then severities of the configuration, fixes, counts
// A finding of a gate passes steps 3 and 4 unchanged (is_gate_rule).
#include "deck/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/shared/paths.hpp"
#include "base/shared/words.hpp"
#include "deck/model.hpp"
#include "lint/check.hpp"
#include "lint/rule_pages.hpp"
#include "lint/shared/config.hpp"
#include "lint/shared/fix.hpp"
#include "lint/suppress.hpp"

namespace deck {
namespace {

bool any_selects(const std::vector<std::string>& selectors, RuleId rule, std::string_view field) {
  return std::any_of(selectors.begin(), selectors.end(),
                     [&](const std::string& s) { return selects(s, rule, field); });
}

/// Selectors do not apply to findings of a gate.
bool enabled(const LintOptions& options, RuleId rule, std::string_view field) {
  if (is_gate_rule(rule)) return true;
  if (!options.select.empty() && !any_selects(options.select, rule, field)) return false;
  return !any_selects(options.ignore, rule, field);
}

/// Replaces rule names in all selectors by ids.
LintOptions with_ids(LintOptions options) {
  const auto to_ids = [](std::vector<std::string>& selectors) {
    for (std::string& s : selectors) s = to_selector(s);
  };
  to_ids(options.select);
  to_ids(options.ignore);
  for (auto& [glob, selectors] : options.per_file_ignores) to_ids(selectors);
  std::map<std::string, Severity> severities;
  for (const auto& [selector, severity] : options.severity)
    severities[to_selector(selector)] = severity;
  options.severity = std::move(severities);
  return options;
}

/// Rules of which some findings are selected.
std::set<RuleId> enabled_rules(const LintOptions& options) {
  std::set<RuleId> out;
  for (const Rule& rule : all_rules())
    if (detail::any_name(rule,
                         [&](std::string_view field) { return enabled(options, rule.id, field); }))
      out.insert(rule.id);
  return out;
}

/// per-file-ignores; matches each pattern once with each file.
class FileIgnores {
 public:
  FileIgnores(const Deck& deck, const LintOptions& options) : deck_(deck), options_(options) {}

  bool ignore(const Finding& d) {
    if (!d.span.valid()) return false;
    const auto [it, fresh] = rules_.try_emplace(d.span.file);
    if (fresh)
      for (const auto& [glob, rules] : options_.per_file_ignores)
        if (glob_match(glob, deck_.sources[d.span.file].path())) it->second.push_back(&rules);
    return std::any_of(it->second.begin(), it->second.end(),
                       [&](const auto* rules) { return any_selects(*rules, d.rule, d.field); });
  }

 private:
  const Deck& deck_;
  const LintOptions& options_;
  std::map<std::uint32_t, std::vector<const std::vector<std::string>*>> rules_;
};

/// `zeros: info`: the solver accepts text of zeros.
void downgrade_trailing_zeros(const Deck& deck, Finding& d) {
  if (rule_of(d.rule).lists("zeros", "info") &&
      deck.sources.text(d.span).find_first_not_of("0.+- ") == std::string_view::npos)
    d.severity = Severity::info;
}

/// Applies the override with the longest matching selector; a field id is longer than its rule id.
void override_severity(const LintOptions& options, Finding& d) {
  if (is_gate_rule(d.rule)) return;
  std::size_t best = 0;
  for (const auto& [selector, severity] : options.severity) {
    if (!selects(selector, d.rule, d.field)) continue;
    const std::size_t size = selector.size() + (selects(selector, d.rule) ? 0 : 1);
    if (size <= best) continue;
    best = size;
    d.severity = severity;
  }
}

/// `only_where` of a rule: false for findings that the schema cannot decide: text outside of cells
/// and missing lines if not every cell is described ("cells"), extra lines of partly described
/// properties and materials ("lines"), keywords known by name only ("keyword").
bool schema_is_complete_for(const SchemaSet& schemas, const Finding& d) {
  const Rule& rule = rule_of(d.rule);
  const Schema* s = rule.exceptions.contains("only_where") && !d.keyword.empty()
                        ? schemas.match(d.keyword)
                        : nullptr;
  if (s == nullptr) return true;
  if (rule.lists("only_where", "keyword")) return s->kind != "other";
  // /BEGIN is read before the version is known, without a schema.
  if (rule.lists("only_where", "cells"))
    return s->layout_known() && s->kind != "engine" && s->keyword != "/BEGIN";
  return !s->opaque_tail && s->kind != "prop" && s->kind != "mat" && s->kind != "other";
}

/// All findings of all sources without duplicates.
struct FindingPool {
  const SchemaSet& schemas;
  const std::set<RuleId>& rules;
  std::vector<Finding> kept = {};
  std::map<RuleId, std::uint64_t> dropped = {};

  void add(const Findings& from, const LintOptions& options) {
    std::map<RuleId, std::uint64_t> seen;
    for (const Finding& d : from.all()) {
      ++seen[d.rule];
      if (rules.contains(d.rule) && enabled(options, d.rule, d.field) &&
          schema_is_complete_for(schemas, d))
        kept.push_back(d);
    }
    for (const auto& [rule, count] : from.counts())
      if (rules.contains(rule) && count > seen[rule]) dropped[rule] += count - seen[rule];
  }

  void sort_and_unite() {
    const auto key = [](const Finding& d) {
      return std::tie(d.span.file, d.span.offset, d.rule, d.span.length, d.message);
    };
    // Span::no_file is the largest number; findings without a place come first.
    std::stable_sort(kept.begin(), kept.end(), [&](const Finding& a, const Finding& b) {
      if (a.span.valid() != b.span.valid()) return !a.span.valid();
      return key(a) < key(b);
    });
    kept.erase(std::unique(kept.begin(), kept.end(),
                           [&](const Finding& a, const Finding& b) { return key(a) == key(b); }),
               kept.end());
    drop_covered();
  }

  /// `covers` of a rule: drops findings of the listed rules within the span of a finding of this
  /// rule.
  void drop_covered() {
    std::vector<std::pair<const Rule*, Span>> larger;
    for (const Finding& d : kept)
      if (const Rule& rule = rule_of(d.rule); rule.exceptions.contains("covers"))
        larger.emplace_back(&rule, d.span);
    std::set<const Rule*> covering;
    for (const auto& [rule, span] : larger) covering.insert(rule);
    std::set<RuleId> covered;
    for (const Finding& d : kept) covered.insert(d.rule);
    std::erase_if(covered, [&](RuleId id) {
      return std::none_of(covering.begin(), covering.end(),
                          [&](const Rule* rule) { return rule->lists("covers", id_text(id)); });
    });
    std::erase_if(kept, [&](const Finding& d) {
      return covered.contains(d.rule) &&
             std::any_of(larger.begin(), larger.end(), [&](const auto& l) {
               const auto& [rule, span] = l;
               if (d.span.file != span.file || !rule->lists("covers", id_text(d.rule)))
                 return false;
               const bool within = d.span.offset >= span.offset &&
                                   d.span.offset + d.span.length <= span.offset + span.length;
               return within || d.span.offset == span.offset;
             });
    });
  }

  /// With a missing include, drops findings about missing entities. Returns the number per rule.
  std::map<std::string, std::uint64_t> drop_absences() {
    std::map<std::string, std::uint64_t> out;
    for (const Finding& d : kept)
      if (rule_of(d.rule).absence) ++out[std::string(id_text(d.rule))];
    std::erase_if(kept, [](const Finding& d) { return rule_of(d.rule).absence; });
    std::erase_if(dropped, [](const auto& of) { return rule_of(of.first).absence; });
    return out;
  }

  /// If the lines of a card are shifted, all its values are misread: drops findings about them
  /// until the lines are correct.
  void drop_consequences(const BlockIndex& index) {
    constexpr RuleId shifts[] = {RuleId::DK242, RuleId::DK243, RuleId::DK244};
    std::set<std::int64_t> shifted;
    for (const Finding& d : kept)
      if (std::find(std::begin(shifts), std::end(shifts), d.rule) != std::end(shifts))
        shifted.insert(index.find(d.span.file, d.span.offset));
    shifted.erase(-1);
    if (shifted.empty()) return;
    std::erase_if(kept, [&](const Finding& d) {
      // Errors that stop the solver are kept in any case.
      if (d.severity == Severity::error && d.reference && d.reference->severity == Severity::error)
        return false;
      const int n = id_number(d.rule);
      const bool value = n / 100 == 2 || n / 100 == 9 || n / 10 == 17 || n / 10 == 18 ||
                         n / 10 == 2 || is_team_rule(d.rule);
      return value && n / 10 != 24 && shifted.count(index.find(d.span.file, d.span.offset)) > 0;
    });
  }
};

/// The baseline of the deck; accepts findings once per entry.
class KnownFindings {
 public:
  explicit KnownFindings(const AcceptedFindings& accepted) {
    for (const auto& [key, amounts] : accepted)
      all_[key] = {{amounts.begin(), amounts.end()}, amounts.size()};
  }

  /// True if the finding is accepted. Uses up the smallest amount that is not exceeded.
  bool accept(const Deck& deck, const Finding& d) {
    if (all_.empty() || is_gate_rule(d.rule)) return false;
    const auto it = all_.find(finding_key(deck, d));
    if (it == all_.end()) return false;
    auto& [free, not_found] = it->second;
    if (not_found > 0) --not_found;
    constexpr double same = 1e-6;  // as for depths: above round-off of reordered sums
    const double amount = d.amount.value_or(0);
    const auto enough = free.lower_bound(amount - same * std::abs(amount));
    if (enough == free.end()) return false;
    free.erase(enough);
    return true;
  }

  /// Entries without a finding; a finding that got worse still counts.
  std::map<FindingKey, std::uint64_t> stale() const {
    std::map<FindingKey, std::uint64_t> out;
    for (const auto& [key, known] : all_)
      if (known.second > 0) out.emplace(key, known.second);
    return out;
  }

 private:
  /// Unused amounts, and the number of entries without findings.
  std::map<FindingKey, std::pair<std::multiset<double>, std::size_t>> all_;
};

void report_unused(const std::vector<detail::Suppression>& suppressions, const LintOptions& options,
                   Reporter& reporter) {
  const Rule& rule = rule_of(RuleId::DK091);
  for (const detail::Suppression& s : suppressions) {
    if (s.used) continue;
    // If a rule is switched off, its suppressions are not reported as unused.
    const bool active = std::any_of(s.rules.begin(), s.rules.end(), [&](const std::string& r) {
      return std::any_of(all_rules().begin(), all_rules().end(), [&](const Rule& known) {
        return !is_gate_rule(known.id) && detail::any_name(known, [&](std::string_view field) {
          return selects(r, known.id, field) && enabled(options, known.id, field);
        });
      });
    });
    if (!active) continue;
    reporter.report(rule, s.span,
                    fmt::format("nothing here violates {}", fmt::join(s.rules, ", ")));
  }
}

std::string joined(const std::map<std::string, std::uint64_t>& counts) {
  constexpr std::size_t shown = 40;
  std::string out;
  std::size_t n = 0;
  for (const auto& [name, count] : counts) {
    if (n++ == shown) return out + " and " + std::to_string(counts.size() - shown) + " more";
    out += (out.empty() ? "" : ", ") + name +
           (count > 1 ? " (" + std::to_string(count) + ")" : std::string());
  }
  return out;
}

std::vector<NotChecked> engine_not_checked(const EngineFiles& engine) {
  const std::string what = "the Engine file (*_0001.rad)";
  if (engine.run.empty()) return {{what, "only the Starter deck is read"}};
  if (engine.files.empty() && engine.unread.empty())
    return {{what, "there is none beside the deck"}};
  std::vector<NotChecked> out;
  for (const EngineFiles::Unread& u : engine.unread) out.push_back({u.path, u.why});
  return out;
}

/// `out`: checks that the extra checks did not make.
std::vector<NotChecked> not_checked(const LoadedDeck& loaded, const std::set<RuleId>& rules,
                                    std::vector<NotChecked> out) {
  std::map<std::string, std::uint64_t> unknown, by_name, opaque;
  for (const Block& b : loaded.deck().blocks) {
    if (b.opaque)
      ++opaque[std::string(b.keyword)];
    else if (b.schema == nullptr && !b.header.starts_with("//"))
      ++unknown[detail::clipped(b.keyword)];
    else if (b.schema != nullptr && b.schema->cards.empty() && !b.schema->layout_known() &&
             b.schema->kind != "engine" && b.schema->kind != "inter" &&
             b.schema->source != "misread.json")
      ++by_name[b.schema->keyword];
  }
  if (!unknown.empty())
    out.push_back(
        {"blocks of " + count(unknown.size(), "keyword", "keywords") + ": " + joined(unknown),
         "no schema describes their cards; --schemas DIR adds some"});
  if (!by_name.empty())
    out.push_back({"the lines of " + joined(by_name), "the solver reads them, deck does not"});
  const Coverage coverage =
      coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties);
  if (const auto text = not_examined_text(coverage); !text.empty())
    out.push_back({text, "only types 2, 7, 10, 11, 19, 24 and 25 have rules"});
  const auto& contacts = loaded.interfaces().ordered;
  if (const auto n = std::count_if(contacts.begin(), contacts.end(),
                                   [](const InterBase* i) { return is_type24_or_25(i->type); });
      n > 0)
    out.push_back({"forces of " + count(static_cast<std::size_t>(n), "interface", "interfaces") +
                       " of TYPE24 and TYPE25",
                   "they are not computed"});
  if (!opaque.empty())
    out.push_back({"encrypted blocks: " + joined(opaque), "their cards cannot be read"});
  for (const std::string& m : coverage.missing)
    out.push_back(
        {"the files behind '" + std::string(detail::trim(m)) + "'", "they could not be read"});
  for (NotChecked& n : engine_not_checked(loaded.engine_files())) out.push_back(std::move(n));
  if (const auto off = all_rules().size() - rules.size(); off > 0)
    out.push_back({std::to_string(off) + " of " + std::to_string(all_rules().size()) + " rules",
                   "switched off by --select, --ignore or the configuration"});
  return out;
}

std::uint64_t fnv1a(std::uint64_t hash, std::string_view text) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

Finding& Reporter::report(const Rule& rule, Span span, std::string message) {
  if (!sink_->wants(rule.id)) return unseen();
  return sink_->add(make_finding(rule.id, span, std::move(message)));
}

Finding& Reporter::report(const Rule& rule, const Block& block, Span span, std::string message) {
  return report(rule, {}, block, span, std::move(message));
}

Finding& Reporter::report(const Rule& rule, std::string_view field, const Block& block, Span span,
                          std::string message) {
  if (rule.fields.empty()) field = {};
  if (!field.empty() && options_ != nullptr && !enabled(*options_, rule.id, field)) return unseen();
  if (!sink_->wants(rule.id)) return unseen();
  Finding& d = sink_->add(make_finding(rule.id, span, std::move(message), {.field = field}));
  d.keyword = block.schema ? block.schema->keyword : detail::clipped(block.keyword);
  d.id = block.id.value;
  return d;
}

FindingKey finding_key(const Deck& deck, const Finding& d) {
  return {std::string(id_text(d.rule)),
          absolute_path(deck.sources[d.span.valid() ? d.span.file : 0].path()),
          d.keyword.empty() ? std::string() : d.keyword + "/" + std::to_string(d.id), d.field};
}

std::string fingerprint(const Deck& deck, const Finding& d) {
  // A field keeps the fingerprints of its former rule.
  const RuleField* const field = rule_of(d.rule).field(d.field);
  std::uint64_t hash =
      fnv1a(0xcbf29ce484222325ULL, id_text(field != nullptr ? field->was : d.rule));
  hash = fnv1a(hash, "|" + d.keyword + "|" + std::to_string(d.id) + "|");
  if (d.span.valid()) {
    const std::string_view line = deck.sources[d.span.file].line_at(d.span.offset);
    bool blank = true;  // leading blanks are ignored
    for (const char c : line) {
      const bool space = static_cast<unsigned char>(c) <= ' ';
      if (!space) hash = fnv1a(blank ? fnv1a(hash, " ") : hash, std::string_view(&c, 1));
      blank = space;
    }
  }
  return fmt::format("{:016x}", hash);
}

namespace {

void run_block_checks(const std::set<RuleId>& rules, const LintContext& context,
                      Reporter& reporter) {
  std::map<const Schema*, std::vector<const detail::BlockChecked*>> of_keyword;
  for (const Block& block : context.deck.blocks) {
    if (block.schema == nullptr || block.opaque || block.schema->bulk) continue;
    const auto [it, fresh] = of_keyword.try_emplace(block.schema);
    if (fresh)
      for (const detail::BlockChecked& c : detail::all_block_checks())
        if (rules.contains(c.id) && c.wants(rule_of(c.id), *block.schema)) it->second.push_back(&c);
    if (it->second.empty()) continue;
    const DecodedBlock decoded = decode(context.deck, block);
    for (const detail::BlockChecked* c : it->second)
      c->check(context, rule_of(c->id), reporter, decoded);
  }
}

/// Skipped if no rule needs their findings.
std::vector<NotChecked> run_extra_checks(const std::vector<ExtraCheck>& extra,
                                         const std::set<RuleId>& rules, bool gated,
                                         const LintContext& context, Reporter& reporter) {
  const bool wanted = std::any_of(rules.begin(), rules.end(), [](RuleId rule) {
    return rule_of(rule).stage == RuleStage::extra;
  });
  std::vector<NotChecked> out;
  if (!wanted && !gated) return out;
  if (extra.empty())
    out.push_back({std::string(geometry_rules),
                   "switched off (--no-geometry, or geometry = false in the configuration)"});
  for (const ExtraCheck& check : extra)
    for (NotChecked& n : check(context, reporter)) out.push_back(std::move(n));
  return out;
}

/// `rules`: those of which some findings are wanted.
LintResult lint(const LoadedDeck& loaded, const LintOptions& options, const std::set<RuleId>& rules,
                const std::vector<ExtraCheck>& extra) {
  const Deck& deck = loaded.deck();
  if (deck.begin.version_unread) {
    LintResult only;
    for (const Finding& d : deck.findings.all()) {
      only.findings.push_back(d);
      only.fingerprints.push_back(fingerprint(deck, d));
      ++only.counts[d.rule];
      ++only.errors;
    }
    return only;
  }
  FindingPool pool{loaded.schemas(), rules};
  for (const Stage stage : {Stage::deck, Stage::model, Stage::interfaces})
    pool.add(loaded.found_by(stage), options);
  pool.add(loaded.cell_findings(), options);

  Findings own(options.findings_per_rule);
  Reporter reporter(own, &options);
  const LintContext context = detail::build_context(loaded);
  for (const auto& [rule, check] : detail::all_checks())
    if (rules.contains(rule)) check(context, rule_of(rule), reporter);
  for (const RuleId rule : rules)
    if (is_team_rule(rule)) detail::check_cells(context, rule_of(rule), reporter);
  run_block_checks(rules, context, reporter);
  std::vector<NotChecked> left_out =
      run_extra_checks(extra, rules, options.gated, context, reporter);
  // Groups without a contact have findings, too.
  context.selections->resolve_all();
  pool.add(context.selections->findings(), options);

  const BlockIndex index(deck);
  std::vector<detail::Suppression> suppressions = detail::find_suppressions(deck, index, reporter);
  pool.add(own, options);
  pool.sort_and_unite();
  pool.drop_consequences(index);

  std::map<std::string, std::uint64_t> absences;
  const bool meshed = detail::has_block(context, "/ALE/STRUCTURED_MESH");
  if (loaded.incomplete() || meshed) absences = pool.drop_absences();

  LintResult result;
  result.not_checked = not_checked(loaded, rules, std::move(left_out));
  if (!absences.empty())
    result.not_checked.push_back({"what seems to be absent: " + joined(absences),
                                  meshed ? "it may be in the mesh that the solver makes"
                                         : "it may be in a file that could not be read"});
  FileIgnores file_ignores(deck, options);
  const auto hidden = [&](const Finding& d) {
    if (is_gate_rule(d.rule)) return false;
    if (file_ignores.ignore(d)) return true;
    if (detail::Suppression* s = detail::covering(suppressions, index, d)) {
      s->used = true;
      ++result.suppressed;
      return true;
    }
    return false;
  };
  std::erase_if(pool.kept, hidden);
  Findings late(options.findings_per_rule);
  Reporter late_reporter(late);
  report_unused(suppressions, options, late_reporter);
  pool.add(late, options);
  pool.sort_and_unite();

  KnownFindings known(options.baseline);
  for (Finding& d : pool.kept) {
    if (known.accept(deck, d)) {
      ++result.baselined;
      continue;
    }
    std::string print = fingerprint(deck, d);
    downgrade_trailing_zeros(deck, d);
    override_severity(options, d);
    detail::attach_fix(context, d);
    ++result.counts[d.rule];
    ++(d.severity == Severity::error     ? result.errors
       : d.severity == Severity::warning ? result.warnings
                                         : result.infos);
    result.findings.push_back(std::move(d));
    result.fingerprints.push_back(std::move(print));
  }
  result.stale = known.stale();
  // Dropped findings get the severity of the listed ones.
  for (const auto& [rule, count] : pool.dropped) {
    const auto kept = std::find_if(result.findings.begin(), result.findings.end(),
                                   [&r = rule](const Finding& d) { return d.rule == r; });
    if (kept == result.findings.end()) continue;
    result.dropped[rule] = count;
    result.counts[rule] += count;
    (kept->severity == Severity::error     ? result.errors
     : kept->severity == Severity::warning ? result.warnings
                                           : result.infos) += count;
  }
  return result;
}

}  // namespace

LintResult run_lint(const LoadedDeck& loaded, const LintOptions& given,
                    const std::vector<ExtraCheck>& extra) {
  const LintOptions options = with_ids(given);
  return lint(loaded, options, enabled_rules(options), extra);
}

void report_solver_errors(LoadedDeck& loaded) {
  if (!coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts).complete()) return;
  const auto is_error = [](const ReferenceMessage& m) { return m.severity == Severity::error; };
  std::set<RuleId> rules;
  for (const Rule& rule : all_rules())
    if (rule.stage <= RuleStage::check &&
        std::any_of(rule.messages.begin(), rule.messages.end(), is_error))
      rules.insert(rule.id);
  for (Finding& d : lint(loaded, {}, rules, {}).findings)
    if (d.severity == Severity::error && d.reference && is_error(*d.reference))
      loaded.report(std::move(d));
}

}  // namespace deck
