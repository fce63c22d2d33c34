// deck diff: differences between two decks in effective values and contacts.

#include "report/shared/inspection.hpp"

#include <algorithm>
#include <filesystem>

#include "common.hpp"
#include "deck/contacts.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "verbs/gap_page.hpp"
#include "verbs/gate/options.hpp"
#include "verbs/git_deck.hpp"

namespace deck::cli::verb_diff {
namespace {

struct Options {
  CommonOptions common;
  std::string match = "id", format = "human", git, html;
  bool markdown = false, no_geometry = false;
  std::size_t rows = 20;
  double tolerance = diff_tolerance;
};

/// A deck with its contacts.
struct ComparedDeck {
  LoadedDeck loaded;
  SceneView view;
  Verdict verdict = {};
  DiffSide described(bool geometry) const { return {loaded, geometry ? &view : nullptr, &verdict}; }
};

/// Verdict of one side; merges its findings.
Verdict verdict_in(ComparedDeck& side, bool geometry) {
  if (geometry) side.loaded.findings();
  VerdictInput in;
  in.deck = &side.loaded.deck();
  in.interfaces = &side.loaded.interfaces();
  if (geometry) in.contacts = contact_facts(side.loaded.scene(), side.view);
  return make_verdict(in);
}

Result<ComparedDeck> read_side(const Options& o, const std::string& path, const SchemaSet& schemas,
                               const Overlay* overlay = nullptr) {
  auto loaded = load(path, schemas, o.common, Stage::interfaces, overlay);
  if (!loaded) return loaded.error();
  ComparedDeck side{std::move(*loaded), {}, {}};
  if (side.loaded.incomplete())
    return Error{Error::Code::io,
                 coverage_lead(coverage_of(side.loaded.deck(), side.loaded.interfaces()))};
  if (o.no_geometry) {
    side.verdict = verdict_in(side, false);
    return side;
  }
  Progress progress(!o.common.quiet);
  progress.step("contacts of " + path);
  SceneOptions scene = side.loaded.scene_options();
  scene.candidates = scene.nodal_stiffness = false;
  scene.ties = true;
  scene.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
  side.loaded.set_scene_options(scene);
  side.view = make_view(side.loaded.scene());
  side.loaded.mesh_values();
  side.verdict = verdict_in(side, true);
  return side;
}

/// The old deck: the first argument, or a git revision.
Result<ComparedDeck> read_old(const Options& o, const SchemaSet& schemas) {
  if (o.git.empty()) return read_side(o, o.common.decks[0], schemas);
  const auto old = git_deck(o.git, o.common.decks[0]);
  if (!old) return old.error();
  return read_side(o, old->path, schemas, &old->files);
}

/// Comparison of penetrations for the page.
std::vector<PageTrend> trends_of(const DeckDiff& diff) {
  std::vector<PageTrend> out;
  const std::pair<const char*, const std::vector<PenetrationChange>&> lists[] = {
      {"new", diff.appeared},
      {"worse", diff.worse},
      {"better", diff.better},
      {"same", diff.same},
      {"solved", diff.gone}};
  for (const auto& [trend, list] : lists)
    for (const PenetrationChange& p : list)
      out.push_back({p.interface_id, p.role, p.secondary, p.depth_old, p.gap_old, trend});
  return out;
}

int run(const Options& o) {
  const std::size_t wanted = o.git.empty() ? 2 : 1;
  if (o.common.decks.size() != wanted)
    return wrong_usage("diff", wanted == 1 ? "--git takes one deck: REV is the other side"
                                           : "expected DECK DECK, or --git REV DECK");
  if (const int bad = check_outputs(o.common, {o.html}); bad != exit_clean) return bad;
  if (const std::string why = no_viewer(o.html); !why.empty()) return wrong_usage("diff", why);
  if (!o.html.empty() && o.no_geometry)
    return wrong_usage("diff", "--html shows contacts: leave out --no-geometry");
  const auto schemas = load_schemas(o.common);
  if (!schemas) return failed(o.common, schemas.error());
  auto a = read_old(o, *schemas);
  auto b = a ? read_side(o, o.common.decks.back(), *schemas) : Result<ComparedDeck>(a.error());
  if (!a || !b) {
    const Error& error = a ? b.error() : a.error();
    std::error_code ec;
    const bool pipe =
        std::any_of(o.common.decks.begin(), o.common.decks.end(),
                    [&](const std::string& deck) { return std::filesystem::is_fifo(deck, ec); });
    return failed(
        o.common,
        error.message + (pipe ? "; 'deck diff --git REV DECK' reads the old side from git, "
                                "with its includes"
                              : ""),
        reading_code(error));
  }
  for (const ComparedDeck* side : {&*a, &*b}) {
    print_findings(side->loaded, o.common);
    if (o.no_geometry) continue;
    for (const Contact& c : side->loaded.scene().contacts)
      if (!c.evaluated)
        print_note("penetrations of interface " + std::to_string(c.inter->id) + " of " +
                   side->loaded.path() + " were not evaluated and are not compared");
  }
  const DiffSide sa = a->described(!o.no_geometry), sb = b->described(!o.no_geometry);
  const DeckDiff diff = diff_decks(sa, sb,
                                   o.match == "title"      ? MatchBy::title
                                   : o.match == "position" ? MatchBy::position
                                                           : MatchBy::id,
                                   o.tolerance);
  const int code = diff.equal() ? exit_clean : exit_findings;
  if (!o.common.json.empty())
    if (auto written = o.common.session->write_output(o.common.json, diff_json(sa, sb, diff));
        !written)
      return failed(o.common, written.error());
  if (o.common.wants_text() && o.html != "-") {
    DiffTextOptions text;
    text.rows = o.rows;
    if (o.markdown || o.format == "markdown") {
      print_text(diff_markdown(sa, sb, diff, text));
    } else if (o.format == "json") {
      print_text(diff_json(sa, sb, diff));
    } else {
      text.color = o.common.color_on(1);
      text.width = text_width();
      print_lines(diff_text(sa, sb, diff, text));
    }
  }
  if (!o.html.empty()) {
    const std::string path = b->loaded.path();
    const std::vector<PageTrend> trends = trends_of(diff);
    const auto page =
        difference_page(a->loaded, b->loaded, "diff", path, changes_json(sa, sb, diff), &trends);
    const auto written =
        page ? o.common.session->write_output(o.html, *page) : Result<void>(page.error());
    if (!written) return failed(o.common, written.error());
  }
  return code;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("DECK")
      .expects(1, -1, "DECK")
      .describe("The old and the new Starter deck; with --git the new one alone");
  line.option("--git REV", options->git,
              "The old deck is DECK with its includes as git has them at REV: a branch, a tag, a "
              "commit");
  line.option("--match HOW", options->match,
              "Counterparts: id; title (nodes and elements by id); position (for renumbered decks: "
              "nodes by coordinates, elements by nodes, the rest by title, then by order)")
      .one_of({"id", "title", "position"})
      .show_default();
  line.option("--format FORMAT", options->format, "human, json or markdown")
      .one_of({"human", "json", "markdown"})
      .show_default();
  line.flag("--markdown", options->markdown, "Short for --format markdown: for a review comment");
  line.option("--html FILE", options->html,
              "Write a page to FILE: the values that changed, the new deck's contacts with what is "
              "new, solved or deeper, and the nodes that moved, before and after");
  line.option("--rows N", options->rows, "Rows of a table; 0: all").show_default();
  line.option("--tolerance X", options->tolerance,
              "Numbers that differ by less than this share of their size are equal (coordinates "
              "and lengths: of the size of the model)")
      .range(0.0, 1.0)
      .show_default();
  line.flag("--no-geometry", options->no_geometry,
            "Do not evaluate contacts: no penetrations, no default gaps");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"diff", 24,
     "Differences in meaning between two decks; comments, order and format do not count",
     R"(  deck diff old_0000.rad new_0000.rad
  deck diff old_0000.rad new_0000.rad --markdown > comment.md
  deck diff --git main car_0000.rad                          what this branch changes
  deck diff old_0000.rad renumbered_0000.rad --match position
  deck diff old_0000.rad new_0000.rad --tolerance 1e-9       without round-off

Exit code 0: equal in meaning, 1: different.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_diff
