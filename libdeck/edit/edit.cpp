// Collects the changes of an Edit, reads the deck again where one change decides the next, and
// writes files.
#include "deck/edit.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "base/shared/paths.hpp"
#include "deck/keyword.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/text.hpp"
#include "edit/cells.hpp"
#include "edit/shared/edit_set.hpp"
#include "edit/shared/write.hpp"
#include "keyword/shared/include_scan.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

Error config(std::string why) { return {Error::Code::config, std::move(why)}; }

std::optional<FileIdentity> identity_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino};
}

std::vector<std::string> decks_in(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code ec;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, ec), end; !ec && it != end;
       it.increment(ec)) {
    const std::string path = it->path().string();
    if (path.ends_with("_0000.rad") || path.ends_with("_0000.rad.gz")) out.push_back(path);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

Result<const Block*> find_block(const Deck& deck, std::string_view keyword, std::int64_t id) {
  const Schema* wanted = SchemaSet::built_in().find(keyword);
  const Block* found = nullptr;
  for (const Block& b : deck.blocks) {
    const bool same =
        wanted != nullptr && b.schema != nullptr && b.schema->keyword == wanted->keyword;
    if (!same && !detail::is_below(b.keyword, keyword)) continue;
    const std::string_view kind = b.schema != nullptr ? std::string_view(b.schema->kind) : "";
    if (b.id.present ? b.id.value + deck.offset_of(b, kind) != id : id != 0) continue;
    if (found != nullptr)
      return config(deck.sources.where(b.header_span) + ": " + std::string(b.header) +
                    ": there are several; the first is " + std::string(found->header) + " in " +
                    deck.sources.where(found->header_span));
    found = &b;
  }
  if (found != nullptr) return found;
  return config(deck.sources[0].path() + ": there is no " + std::string(keyword) +
                (id != 0 ? " with id " + std::to_string(id) : ""));
}

class Edit::State {
 public:
  explicit State(const LoadedDeck& loaded) : original(&loaded), cells(loaded.deck().sources) {
    for (std::size_t i = 0; i < loaded.deck().blocks.size(); ++i) place.push_back(i);
  }

  const LoadedDeck& now() const { return later ? *later : *original; }

  void fail(Error why) {
    if (!error) error = std::move(why);
  }

  /// Index in `place` of a block: one of the original deck or an inserted one of the present deck;
  /// `erased` if neither.
  std::size_t number_of(const Block* block) const {
    const auto index_in = [&](const LoadedDeck& loaded) {
      const std::vector<Block>& all = loaded.deck().blocks;
      const auto index = static_cast<std::size_t>(block - all.data());
      return block != nullptr && index < all.size() ? index : erased;
    };
    if (const std::size_t index = index_in(*original); index != erased) return index;
    const std::size_t index = index_in(now());
    const auto it = std::find(place.begin(), place.end(), index);
    return index == erased || it == place.end() ? erased
                                                : static_cast<std::size_t>(it - place.begin());
  }

  /// Present form of a block; nullptr with an error if it was erased or is unknown.
  const Block* block_of(std::size_t number) {
    if (number == erased) {
      fail(config(original->path() + ": there is no such block"));
      return nullptr;
    }
    if (place[number] == erased) {
      fail(detail::block_error(original->deck(), original->deck().blocks[number], {}, {},
                               "it was removed before"));
      return nullptr;
    }
    return &now().deck().blocks[place[number]];
  }

  Result<const Block*> find(std::string_view keyword, std::int64_t id) {
    const auto first = find_block(original->deck(), keyword, id);
    const bool stands = first && place[number_of(*first)] != erased;
    if (stands || place.size() == original->deck().blocks.size()) return first;
    if (!refresh()) return *error;
    return find_block(now().deck(), keyword, id);
  }

  void set(std::size_t number, std::string_view field, const CellValue& value, int occurrence) {
    if (error || (read_again && !refresh())) return;
    const Block* here = block_of(number);
    if (here == nullptr) return;
    bool absent = false;
    auto edit = detail::set_value(now().deck(), *here, field, value, occurrence, cells, absent);
    if (absent && pending()) {
      // An earlier change may have made the cell.
      if (!refresh()) return;
      here = block_of(number);
      edit = detail::set_value(now().deck(), *here, field, value, occurrence, cells, absent);
    }
    if (!edit) return fail(edit.error());
    edits.insert(edits.end(), edit->edits.begin(), edit->edits.end());
    read_again = read_again || edit->read_again;
    if (!edit->note.empty()) notes.push_back(edit->note);
    if (absent && !edit->edits.empty()) check_new_line(number, field);
  }

  /// Error unless the added line is read as intended.
  void check_new_line(std::size_t number, std::string_view field) {
    if (!refresh()) return;
    const Block* here = block_of(number);
    for (const DecodedCard& card : decode(now().deck(), *here).cards)
      for (const Cell& cell : card.cells)
        if (!card.missing() && cell.field->name == field && !cell.blank()) return;
    fail(detail::block_error(now().deck(), *here, {}, field,
                             "its line is missing and cannot be added; add it by hand"));
  }

  void move_node(std::int64_t id, const Point3<double>& to) {
    if (error || (read_again && !refresh())) return;
    const Model& model = now().model();
    const NodeIndex n = model.find_node(id);
    if (n == no_index)
      return fail(config(original->path() + ": there is no node " + std::to_string(id)));
    if (!nodes) nodes.emplace(now());
    nodes->find_lines({&n, 1});
    const auto where = [&] {
      const Span line = nodes->line(n);
      return (line.valid() ? now().deck().sources.where(line) : original->path()) + ": node " +
             std::to_string(id);
    };
    if (!nodes->obstacle(n).empty())
      return fail(config(where() + " cannot be moved: " + nodes->obstacle(n)));
    const double wanted[3] = {to.x, to.y, to.z};
    const double is[3] = {model.nodes.x[n], model.nodes.y[n], model.nodes.z[n]};
    for (int axis = 0; axis < 3; ++axis) {
      const double x = wanted[axis];
      if (!std::isfinite(x))
        return fail(config(where() + ": infinity and not-a-number are no input"));
      if (x == is[axis] && !moved.contains({n, axis})) continue;
      const auto printed = nodes->print(n, axis, x);
      if (!printed) return fail(config(where() + ": " + shortest(x) + " does not fit its cell"));
      nodes->write(cells, n, axis, printed->text);
      moved.insert({n, axis});
      if (printed->value != x && std::nextafter(x, printed->value) != printed->value)
        notes.push_back(where() + ": " + shortest(x) + " becomes " + shortest(printed->value) +
                        ": its cell holds no more digits");
    }
  }

  void erase(std::size_t number) {
    if (error || (pending() && !refresh())) return;
    const Block* here = block_of(number);
    if (here == nullptr) return;
    auto removed = detail::erase_block(now().deck(), *here);
    if (!removed) return fail(removed.error());
    edits = std::move(*removed);
    const std::size_t gone = std::exchange(place[number], erased);
    for (std::size_t& other : place)
      if (other != erased && other > gone) --other;
    refresh();
  }

  void insert(std::string_view blocks) {
    if (error || (pending() && !refresh())) return;
    if (!blocks.starts_with('/'))
      return fail(config(original->path() + ": what is inserted has to begin with a keyword, as '" +
                         "/FUNCT/7'"));
    const std::size_t before = now().deck().blocks.size();
    edits = detail::insert_blocks(now().deck(), blocks);
    if (!refresh()) return;
    for (std::size_t i = before; i < now().deck().blocks.size(); ++i) place.push_back(i);
  }

  bool pending() const { return !cells.empty() || !edits.empty(); }

  /// Reads the deck again with all changes so far; false on error.
  bool refresh() {
    read_again = false;
    if (error) return false;
    if (!pending()) return true;
    std::vector<TextEdit> all = cells.release_edits();
    all.insert(all.end(), edits.begin(), edits.end());
    edits.clear();
    auto texts = apply_edits(now().deck().sources, all);
    if (!texts) {
      fail(texts.error());
      return false;
    }
    if (texts->empty()) return true;
    for (auto& [path, text] : *texts) changed[path] = std::move(text);
    auto again = load_changed();
    if (!again) {
      fail(again.error());
      return false;
    }
    nodes.reset();
    moved.clear();
    later.emplace(std::move(*again));
    cells = CellWriter(later->deck().sources);
    return true;
  }

  Result<LoadedDeck> load_changed() const {
    auto again = original->with(changed);
    if (again && again->deck().includes.size() < original->deck().includes.size())
      return Error{Error::Code::io, original->path() +
                                        ": a file that it includes could be read before, but not "
                                        "again; nothing was written"};
    return again;
  }

  const LoadedDeck* original;
  std::optional<LoadedDeck> later;
  ChangedFiles changed;  ///< texts with which `later` was read
  static constexpr std::size_t erased = static_cast<std::size_t>(-1);
  /// Present index of every block of the original, then of the inserted ones.
  std::vector<std::size_t> place;
  CellWriter cells;
  std::vector<TextEdit> edits;
  bool read_again = false;  ///< the next change depends on those before
  std::optional<detail::NodeCells> nodes;
  std::set<std::pair<NodeIndex, int>> moved;
  std::vector<std::string> notes;
  std::optional<Error> error;
};

Edit::Edit(const LoadedDeck& loaded) : state_(std::make_unique<State>(loaded)) {}
Edit::Edit(Edit&&) noexcept = default;
Edit& Edit::operator=(Edit&&) noexcept = default;
Edit::~Edit() = default;

Edit& Edit::set(const InterBase* inter, std::string_view field, const CellValue& value) {
  if (inter == nullptr || inter->block == nullptr) {
    state_->fail(config(state_->original->path() + ": there is no such interface"));
    return *this;
  }
  return set(inter->block, field, value);
}

Edit& Edit::set(const Block* block, std::string_view field, const CellValue& value,
                int occurrence) {
  const std::size_t number = state_->number_of(block);
  const auto has = [&](std::string_view name) {
    return block != nullptr && block->schema != nullptr &&
           block->schema->find_field(name) != nullptr;
  };
  // IBC as one text sets three flags.
  const auto* flags = std::get_if<std::string>(&value);
  if (field == "IBC" && !has(field) && has("IBCX") && flags != nullptr && flags->size() == 3) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      state_->set(number, std::string("IBC") + "XYZ"[axis], flags -> substr(axis, 1), occurrence);
    return *this;
  }
  const std::string percent = "%" + std::string(field);
  state_->set(number, !has(field) && has(percent) ? std::string_view(percent) : field, value,
              occurrence);
  return *this;
}

Edit& Edit::set(std::string_view keyword, std::int64_t id, std::string_view field,
                const CellValue& value, int occurrence) {
  const auto block = find(keyword, id);
  if (block) return set(*block, field, value, occurrence);
  state_->fail(block.error());
  return *this;
}

Edit& Edit::move_node(std::int64_t id, const Point3<double>& to) {
  state_->move_node(id, to);
  return *this;
}

Edit& Edit::insert(std::string_view blocks) {
  state_->insert(blocks);
  return *this;
}

Edit& Edit::erase(const Block* block) {
  state_->erase(state_->number_of(block));
  return *this;
}

Result<const Block*> Edit::find(std::string_view keyword, std::int64_t id) {
  return state_->find(keyword, id);
}

Result<void> Edit::status() const {
  if (state_->error) return *state_->error;
  return {};
}

const std::vector<std::string>& Edit::notes() const { return state_->notes; }

Result<LoadedDeck> Edit::read() {
  if (!state_->refresh()) return *state_->error;
  return state_->load_changed();
}

Result<EditSet> Edit::files() {
  if (!state_->refresh()) return *state_->error;
  EditSet set;
  const Deck& deck = state_->original->deck();
  const auto member = set.add(deck, state_->original->path());
  if (!member) return member.error();
  ChangedFiles changed = state_->changed;
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const auto it = changed.find(deck.sources[f].path());
    if (it != changed.end() && it->second == deck.sources[f].bytes()) changed.erase(it);
  }
  set.propose(*member, state_->now().deck(), changed);
  return set;
}

Result<std::string> Edit::diff() {
  const auto set = files();
  if (!set) return set.error();
  return set->diff();
}

Result<std::vector<std::string>> Edit::save(const SaveOptions& options) {
  const auto set = files();
  if (!set) return set.error();
  const auto plan = set->in_place();
  if (!plan) return plan.error();
  std::set<std::string> others(options.others.begin(), options.others.end());
  std::set<FileIdentity> touched;
  std::vector<std::string> paths;
  for (const OutputFile& f : plan->files) {
    touched.emplace(f.read->device, f.read->inode);
    paths.push_back(f.path);
    for (std::string& deck : decks_in(std::string(parent_path(f.path))))
      others.insert(std::move(deck));
  }
  const auto own = identity_of(plan->mains.front());
  IncludeScan scan(state_->original->options().read.include_paths);
  for (const std::string& deck : others) {
    if (identity_of(deck) == own) continue;
    for (const IncludeScan::File& f : scan.files(deck))
      if (touched.contains(f.identity))
        return config(f.path + " would change for " + state_->original->path() + ", and " + deck +
                      " includes it as well; nothing was written");
  }
  WriteOptions write;
  write.backup_suffix = options.backup_suffix;
  write.note_beside = plan->mains.front();
  if (const auto done = write_files_atomic(plan->files, write); !done) return done.error();
  return paths;
}

Result<std::vector<std::string>> Edit::save_to(const std::string& directory, bool overwrite) {
  const auto set = files();
  if (!set) return set.error();
  const auto plan = set->tree(directory);
  if (!plan) return plan.error();
  std::set<FileIdentity> own;
  const SourceSet& sources = state_->original->deck().sources;
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    if (sources[f].inode() != 0) own.emplace(sources[f].device(), sources[f].inode());
  std::vector<std::string> paths;
  for (const OutputFile& f : plan->files) {
    paths.push_back(f.path);
    const auto there = identity_of(f.path);
    if (!there) continue;
    if (own.contains(*there))
      return config(f.path +
                    " is a file of the deck itself; nothing was written. Name another "
                    "directory, or save in place");
    if (overwrite || is_unchanged_output(f.path, f.origin)) continue;
    const auto old = Source::open(f.path, state_->original->options().read.limits);
    if (!old || (*old)->on_disk() != f.bytes)
      return config(f.path + " is there already, with other contents; nothing was written");
  }
  const WriteOptions write{"", true, true, true, directory};
  if (const auto done = write_files_atomic(plan->files, write); !done) return done.error();
  return paths;
}

}  // namespace deck
