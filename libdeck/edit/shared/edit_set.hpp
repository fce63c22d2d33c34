// EditSet: the include trees of all decks of a call as one set of files. Every file is in it once,
// by what it is and not by how it was named, with every deck that includes it; what each deck wants
// its files to become is put together and written once, or refused where two decks disagree.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/deck.hpp"
#include "edit/shared/include_scan.hpp"
#include "edit/shared/write.hpp"

namespace deck {

class EditSet {
 public:
  EditSet() = default;
  /// tree() writes every deck where it lies below `root`, an absolute path, instead of at the top.
  explicit EditSet(std::string root) : root_(std::move(root)) {}

  /// What a call would write, once and for all of its decks. Points into the set.
  struct Plan {
    std::vector<OutputFile> files;     ///< by path; the bytes are those that will be on disk
    std::deque<std::string> packed;    ///< bytes of packed files
    std::vector<std::string> outside;  ///< trees: included by an absolute path, left where they are
    std::string main;                  ///< in place: main file of the first deck
  };

  /// Takes the files of a deck as they were read, before anything is changed. `name` stands for the
  /// deck in messages; empty: the path of its main file. Returns the number of the deck. Error: a
  /// file of it was read before, for another deck or another include, and was another one then.
  ///
  ///     EditSet set;
  ///     auto a = set.add(deck_a), b = set.add(deck_b);
  ///     set.propose(*a, deck_a, *apply_rewrite(deck_a.sources, rewrite_a));
  ///     set.propose(*b, deck_b, *apply_rewrite(deck_b.sources, rewrite_b));
  ///     auto plan = set.in_place();
  ///     if (plan) write_files_atomic(plan->files);
  Result<std::size_t> add(const Deck& deck, std::string name = {});

  /// What the files of a deck shall hold; those that `changed` does not name stay as they are.
  /// `now` is the deck read again with that text (the same deck where its includes stay).
  void propose(std::size_t deck, const Deck& now, const ChangedFiles& changed);

  /// The files that change, where they are; each of them is only to be replaced if it still is what
  /// was read. Error: two decks want different texts for one file, both places named.
  Result<Plan> in_place() const;
  /// All files of all decks below another directory, each deck with its relative names; where
  /// files of two decks would be in one place, below the directories that they lie in. Error: two
  /// files, or two texts of one file, for one place; a file that stays where it is would have to
  /// change.
  Result<Plan> tree(const std::string& directory) const;
  /// The changes of in_place() as one patch that git apply takes, every file once; of packed files
  /// it changes the unpacked ones, named without ".gz". Paths are relative to the top of the git
  /// work tree that holds the files, else to the current directory, else to the directory that all
  /// of them share.
  Result<std::string> diff() const;

  /// A deck that is not in the set and includes a file of it, too: the file cannot be changed in
  /// place any more (an error that names the deck), only split.
  void add_outsider(const FileIdentity& file, const std::string& deck);
  /// Gives decks that want another text for a file than the others do, or than decks outside the
  /// set need, a copy of their own beside it ("mesh_car.inc") and makes their #include lead there.
  /// Error: an #include cannot be changed.
  Result<void> split_includes();

  /// The files that would change in place, by identity, also where that is refused.
  std::set<FileIdentity> changed_files() const;
  /// The main file of a deck as it was read, and as tree() names it below its directory.
  const std::string& main_path(std::size_t deck) const { return decks_[deck].order.front(); }
  const std::string& main_target(std::size_t deck) const {
    return decks_[deck].layout.front().first;
  }
  /// `written` is a deck read from what was planned: what is not as it was proposed; empty:
  /// nothing.
  std::string read_back_difference(std::size_t deck, const Deck& written) const;

 private:
  /// A deck's use of a file.
  struct Use {
    std::size_t deck = 0;
    std::string path;   ///< as this deck opened it
    std::string place;  ///< "file:line" of the #include; empty: the main file
    std::size_t text = 0;
  };
  struct File {
    std::uint64_t device = 0, inode = 0;  ///< 0: from memory
    /// Where it is on disk, links resolved, and how it was opened: several if hard-linked.
    std::vector<std::pair<std::string, std::string>> places;
    std::deque<std::string> texts;  ///< as it was read, then what is wanted
    std::string on_disk;            ///< of a packed file: what was unpacked
    std::vector<Use> uses;
    std::string outsider;  ///< a deck outside the set that includes it
    bool is_new = false;   ///< a copy that is to be made
  };
  /// An #include of a deck as it shall be.
  struct Edge {
    std::string parent, written, child;  ///< paths as opened
  };
  struct Member {
    std::string name;
    std::string main;                                         ///< as opened
    std::map<std::string, std::size_t> file_of;               ///< by path as opened
    std::vector<std::pair<std::string, std::string>> layout;  ///< relative target, path as opened
    std::vector<std::string> outside;
    std::string no_layout;  ///< why there is none
    std::vector<Edge> edges;
    std::vector<std::string> order;  ///< the files as the reader opens them, repetitions included
    std::string units;               ///< "kg, mm, ms", as /BEGIN says
  };

  Result<std::size_t> enter(const Source& source);
  Result<std::vector<std::pair<const File*, std::size_t>>> changes() const;
  Error conflict(const File& file, const Use& a, const Use& b, const std::string& where) const;
  std::vector<std::string> folders() const;
  const Use* use_of(std::size_t deck, const std::string& path) const;
  static std::string_view as_written(Plan& plan, const std::string& text, bool packed);
  const Use* odd_use(const File& file) const;
  Result<void> give_copy(std::size_t deck, const std::string& path, const std::string& copy);
  std::string free_name(const std::string& path, const std::string& deck) const;

  std::string root_;
  std::deque<File> files_;
  std::vector<Member> decks_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> by_identity_;
  std::map<std::string, std::size_t> by_place_;
  std::map<std::string, std::size_t, std::less<>> by_path_;  ///< as opened before
};

}  // namespace deck
