// EditSet: the include trees of all decks of a call as one set of files. Every file is in it once,
// by where it is and not by how it was named, with every deck that includes it; what each deck
// wants its files to become is put together and written once, or refused where two decks disagree.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit.hpp"
#include "deck/keyword.hpp"
#include "edit/shared/write.hpp"
#include "keyword/shared/include_scan.hpp"

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
    std::vector<std::string> mains;    ///< main file of each deck, as it will lie there
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
  /// place any more (an error that names the deck).
  void add_outsider(const FileIdentity& file, const std::string& deck);

  /// Further paths by which decks of the set open a file, each with the path that plans name it by.
  std::vector<std::pair<std::string, std::string>> other_paths() const;
  /// `written` is a deck read from what was planned: what is not as it was proposed; empty:
  /// nothing.
  std::string read_back_difference(std::size_t deck, const Deck& written) const;

 private:
  struct File {
    FileIdentity identity;               ///< inode 0: from memory
    std::string place;                   ///< on disk, links resolved; empty: from memory
    std::string path;                    ///< as it was opened first
    std::deque<std::string> texts = {};  ///< as it was read, then what is wanted
    std::string on_disk = {};            ///< of a packed file: what was unpacked
    std::string outsider = {};           ///< a deck outside the set that includes it
  };
  /// A file of a deck.
  struct Use {
    std::string path;                   ///< as this deck opened it
    std::size_t file = 0;               ///< in `files_`
    std::string directive = {};         ///< "file:line" of the #include; empty: no file includes it
    std::size_t text = 0;               ///< of the file's texts
    std::set<std::string> places = {};  ///< where the directives lead to, absolute
  };
  struct Member {
    std::string name;
    std::vector<Use> uses = {};  ///< the main file first
    std::map<std::string, std::size_t, std::less<>> by_path = {};
    std::vector<std::size_t> order = {};    ///< of uses, as the reader opens them
    std::vector<std::string> outside = {};  ///< included by an absolute path
    std::string no_place = {};              ///< why the tree cannot be written elsewhere
    std::string units = {};                 ///< "kg, mm, ms", as /BEGIN says
  };
  /// What one deck wants of a file.
  struct Claim {
    std::size_t deck;
    const Use* use;
  };

  Result<std::size_t> enter(const Source& source);
  void lay_out(Member& member, const Deck& now, const std::string& main) const;
  Result<std::vector<std::pair<const File*, Claim>>> changes() const;
  Error conflict(const Claim& a, const Claim& b, const std::string& where) const;
  Result<std::vector<std::string>> tops() const;
  const std::string& text_of(const Use& use) const { return files_[use.file].texts[use.text]; }

  std::string root_;
  std::deque<File> files_;
  std::vector<Member> decks_;
  std::map<std::string, std::size_t> by_place_;
};

}  // namespace deck
