// libdeck._native: conversions and repairs of a deck, kept in memory until they are written.
#include <cmath>
#include <functional>
#include <map>

#include "deck/edit.hpp"
#include "edit/shared/conversion.hpp"
#include "edit/shared/depenetrate.hpp"
#include "edit/shared/edit_set.hpp"
#include "edit/shared/write.hpp"
#include "native.hpp"
#include "report/shared/deck_json.hpp"
#include "report/shared/fix.hpp"

namespace deck::python {
namespace {

/// What a deck is to become: the changed files, and the deck read again with them.
struct PyEdit {
  DeckPointer before;
  ChangedFiles changed;
  DeckPointer after;
  std::vector<LossEntry> losses;
  std::vector<std::string> notes;
  std::string report;  ///< of a fix: the document of `deck fix --json`
};
using EditPointer = std::shared_ptr<PyEdit>;

/// The deck as it is with the changed files.
DeckPointer read_again(const PyDeck& d, const ChangedFiles& changed) {
  auto loaded = [&] {
    const py::gil_scoped_release free;
    return d.loaded.with(changed);
  }();
  if (!loaded) raise_error(loaded.error().message);
  const py::gil_scoped_release free;
  return std::make_shared<PyDeck>(d.path, std::move(*loaded));
}

/// Adds what a rewrite does to `edit`; `now` is the deck that it was made for.
void take(PyEdit& edit, const PyDeck& now, const Rewrite& rewrite) {
  if (!rewrite.refusals.empty()) {
    std::string why = "refused:";
    for (std::size_t i = 0; i < rewrite.refusals.size() && i < 20; ++i)
      why += "\n" + rewrite.refusals[i];
    if (rewrite.refusals.size() > 20)
      why += "\nand " + std::to_string(rewrite.refusals.size() - 20) + " more";
    raise_error(why);
  }
  auto changed = apply_rewrite(now.loaded.deck().sources, rewrite);
  if (!changed) raise_error(changed.error().message);
  for (auto& [path, text] : *changed) edit.changed[path] = std::move(text);
  edit.losses.insert(edit.losses.end(), rewrite.losses.begin(), rewrite.losses.end());
  edit.notes.insert(edit.notes.end(), rewrite.notes.begin(), rewrite.notes.end());
}

void must_be_whole(const PyDeck& d) {
  if (d.loaded.incomplete())
    raise_error(d.path + ": the include tree is not complete", &d.loaded.deck(),
                &d.loaded.deck().findings.all());
}

EditPointer convert_deck(const DeckPointer& d, const std::vector<std::int64_t>& extract, bool flat,
                         bool expand, bool resolve, int version, bool allow_loss,
                         const std::string& units, bool keep_working,
                         const std::vector<std::string>& ids, bool partial, bool verify) {
  using Step = std::function<Rewrite(const LoadedDeck&)>;
  std::vector<std::pair<const char*, Step>> steps;  // with the option of `deck convert`
  if (!extract.empty())
    steps.emplace_back("--extract-contacts",
                       [&](const LoadedDeck& c) { return extract_contacts(c, extract); });
  if (flat) steps.emplace_back("--flatten", [](const LoadedDeck& c) { return flatten(c); });
  if (expand)
    steps.emplace_back("--expand-type19", [](const LoadedDeck& c) { return expand_type19(c); });
  if (resolve)
    steps.emplace_back("--resolve-defaults",
                       [&](const LoadedDeck& c) { return resolve_defaults(c, {allow_loss}); });
  if (version != 0)
    steps.emplace_back("--version",
                       [&](const LoadedDeck& c) { return to_version(c, version, {allow_loss}); });
  if (!units.empty()) {
    const auto target = parse_unit_system(units);
    if (!target) throw py::value_error("units: " + target.error().message);
    steps.emplace_back("--units", [&, system = *target](const LoadedDeck& c) {
      return to_units(c, system, {partial, keep_working});
    });
  }
  if (!ids.empty()) {
    RenumberOptions options;
    options.partial = partial;
    for (const std::string& text : ids) {
      auto rule = parse_renumber_rule(text);
      if (!rule) throw py::value_error("renumber: " + rule.error().message);
      options.rules.push_back(std::move(*rule));
    }
    steps.emplace_back("--renumber",
                       [options](const LoadedDeck& c) { return renumber(c, options); });
  }
  must_be_whole(*d);
  auto edit = std::make_shared<PyEdit>();
  edit->before = edit->after = d;
  for (const auto& [name, step] : steps) {
    Rewrite rewrite = alone_with(*edit->after, [&] { return step(edit->after->loaded); });
    take(*edit, *edit->after, rewrite);
    if (verify) {
      const DeckPointer next = read_again(*d, edit->changed);
      const auto why = alone_with(*edit->after, [&] {
        return first_difference(edit->after->loaded, next->loaded,
                                relation_of(name, rewrite.losses),
                                allow_loss ? &edit->losses : nullptr);
      });
      if (why) raise_error("the converted deck is not the same: " + *why);
      edit->after = next;
    } else {
      edit->after = read_again(*d, edit->changed);
    }
  }
  return edit;
}

EditPointer fix_deck(const DeckPointer& d, const std::string& strategy,
                     const std::vector<std::int64_t>& interfaces, double min_gap, int inacti,
                     std::optional<double> fpenmax, double max_moved,
                     std::optional<double> max_displacement, const std::vector<std::int64_t>& lock,
                     bool ties) {
  must_be_whole(*d);
  const auto share = [](double x) { return x >= 0 && x <= 1; };
  must_be(share(min_gap), "min_gap is a share from 0 to 1");
  must_be(share(max_moved), "max_moved is a share from 0 to 1");
  must_be(!fpenmax || share(*fpenmax), "fpenmax is a share from 0 to 1");
  must_be(!max_displacement || (*max_displacement > 0 && std::isfinite(*max_displacement)),
          "max_displacement is a finite length above 0");
  FixOptions base;
  base.threads = d->loaded.options().threads;
  base.interfaces = interfaces;
  base.ties = ties;
  const LoadedDeck& context = d->loaded;
  const auto with = [&]<class Options>(Options options) {
    static_cast<FixOptions&>(options) = base;
    return options;
  };
  auto fix = alone_with(*d, [&]() -> Result<PenetrationFix> {
    if (strategy == "reduce-gap") {
      auto options = with(ReduceGapOptions{});
      options.least_share = min_gap;
      return reduce_gaps(context, options);
    }
    if (strategy == "inacti") {
      auto options = with(InactiOptions{});
      options.inacti = inacti;
      return set_inacti(context, options);
    }
    if (strategy == "fpenmax") {
      auto options = with(FpenmaxOptions{});
      options.ratio = fpenmax;
      return set_fpenmax(context, options);
    }
    if (strategy == "move-nodes" || strategy == "move-part") {
      auto options = with(MoveNodesOptions{});
      options.most_moved = max_moved;
      options.most_displacement = max_displacement;
      options.lock = lock;
      return strategy == "move-part" ? move_part(context, options) : move_nodes(context, options);
    }
    return Error{Error::Code::config,
                 "strategy is 'reduce-gap', 'inacti', 'fpenmax', 'move-nodes' or "
                 "'move-part', not '" +
                     strategy + "'"};
  });
  if (!fix && fix.error().code == Error::Code::config) throw py::value_error(fix.error().message);
  if (!fix) raise_error(fix.error().message);
  auto edit = std::make_shared<PyEdit>();
  edit->before = d;
  take(*edit, *d, fix->rewrite);
  edit->after = read_again(*d, edit->changed);
  edit->report = fix_json(d->loaded, *fix, "no");
  return edit;
}

/// The edit as a set of files. Everything that it points to lives in `edit`.
void enter(EditSet& set, const PyEdit& edit) {
  const auto member = set.add(edit.before->loaded.deck(), edit.before->path);
  if (!member) raise_error(member.error().message);
  set.propose(*member, edit.after->loaded.deck(), edit.changed);
}

}  // namespace

std::vector<std::string> write_tree(const EditSet& set, const Deck& before,
                                    const std::string& directory, bool overwrite) {
  const auto plan = set.tree(directory);
  if (!plan) raise_error(plan.error().message);
  const py::object exists = py::module_::import("os.path").attr("lexists");
  std::vector<std::string> paths;
  for (const OutputFile& f : plan->files) {
    if (!overwrite && exists(f.path).cast<bool>()) {
      PyErr_SetString(PyExc_FileExistsError,
                      (f.path + " exists; overwrite=True replaces it").c_str());
      throw py::error_already_set();
    }
    for (std::uint32_t i = 0; i < before.sources.size(); ++i)
      if (py::module_::import("os.path").attr("realpath")(f.path).equal(
              py::module_::import("os.path").attr("realpath")(before.sources[i].path())))
        raise_error(f.path + " is a file of the deck itself; write to another directory");
    paths.push_back(f.path);
  }
  WriteOptions options;
  options.make_directories = true;
  options.below = directory;
  const auto done = [&] {
    const py::gil_scoped_release free;
    return write_files_atomic(plan->files, options);
  }();
  if (!done) raise_error(done.error().message);
  return paths;
}

void bind_edits(py::module_& m) {
  py::class_<PyEdit, EditPointer>(m, "Edit")
      .def_readonly("deck", &PyEdit::after)
      .def_property_readonly("files",
                             [](const PyEdit& e) {
                               py::dict out;
                               for (const auto& [path, text] : e.changed)
                                 out[py::str(path)] = py::bytes(text);
                               return out;
                             })
      .def_readonly("notes", &PyEdit::notes)
      .def_readonly("report_json", &PyEdit::report)
      .def("losses_json", [](const PyEdit& e) { return losses_json(e.losses); })
      .def("diff",
           [](const PyEdit& e) {
             EditSet set;
             enter(set, e);
             const auto patch = set.diff();
             if (!patch) raise_error(patch.error().message);
             return py::bytes(*patch);
           })
      .def("write", [](const PyEdit& e, const std::string& directory, bool overwrite) {
        EditSet set;
        enter(set, e);
        return write_tree(set, e.before->loaded.deck(), directory, overwrite);
      });
  m.def("convert", &convert_deck);
  m.def("fix", &fix_deck);
}

}  // namespace deck::python
