// EditSet: files of all decks of a call. Each file is in it once, identified by its place on disk
// and not by its name, with every deck that includes it. The texts that the decks propose for a
// file are merged and written once, or refused if two decks disagree.
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
  /// tree() keeps the path of each deck below `root` (absolute) instead of writing it to the top.
  explicit EditSet(std::string root) : root_(std::move(root)) {}

  /// Files that a call would write. Points into the set.
  struct Plan {
    std::vector<OutputFile> files;     ///< by path, with final bytes
    std::deque<std::string> packed;    ///< bytes of packed files
    std::vector<std::string> outside;  ///< trees: files included by absolute path; not copied
    std::vector<std::string> mains;    ///< main file of each deck, with its new path
  };

  /// Adds the files of a deck as read, before any change; returns the number of the deck. `name` is
  /// used in messages; empty: path of the main file. Error: a file has changed since it was read
  /// for another deck or include.
  ///
  ///     EditSet set;
  ///     auto a = set.add(deck_a), b = set.add(deck_b);
  ///     set.propose(*a, deck_a, *apply_rewrite(deck_a.sources, rewrite_a));
  ///     set.propose(*b, deck_b, *apply_rewrite(deck_b.sources, rewrite_b));
  ///     auto plan = set.in_place();
  ///     if (plan) write_files_atomic(plan->files);
  Result<std::size_t> add(const Deck& deck, std::string name = {});

  /// New texts of a deck's files; files missing in `changed` stay. `now` is the deck read again
  /// with these texts (the same deck if its includes do not change).
  void propose(std::size_t deck, const Deck& now, const ChangedFiles& changed);

  /// Changed files in place; each is replaced only if it still is as it was read. Error: two decks
  /// want different texts for a file (names both places).
  Result<Plan> in_place() const;
  /// All files of all decks below another directory, with their relative names; decks whose files
  /// would collide go to their own directories below it. Error: two files or texts for one place,
  /// or a change of a file that stays where it is.
  Result<Plan> tree(const std::string& directory) const;
  /// Changes of in_place() as one patch for git apply, each file once. Packed files appear
  /// unpacked, named without ".gz". Paths are relative to the top of the git work tree of the
  /// files, else to the current directory, else to their common directory.
  Result<std::string> diff() const;

  /// Reports a deck outside the set that includes `file`: in_place() then refuses to change the
  /// file and names the deck.
  void add_outsider(const FileIdentity& file, const std::string& deck);

  /// Further paths by which decks open a file, each with its path in plans.
  std::vector<std::pair<std::string, std::string>> other_paths() const;
  /// Compares `written`, a deck read from a plan, with the proposed texts: first difference, or
  /// empty.
  std::string read_back_difference(std::size_t deck, const Deck& written) const;

 private:
  struct File {
    FileIdentity identity;               ///< inode 0: from memory
    std::string place;                   ///< on disk, links resolved; empty if from memory
    std::string path;                    ///< as first opened
    std::deque<std::string> texts = {};  ///< as read, then as proposed
    std::string on_disk = {};            ///< packed file: the unpacked bytes
    std::string outsider = {};           ///< a deck outside the set that includes it
  };
  struct Use {
    std::string path;                   ///< as this deck opened it
    std::size_t file = 0;               ///< in `files_`
    std::string directive = {};         ///< "file:line" of the #include; empty for the main file
    std::size_t text = 0;               ///< index in the file's texts
    std::set<std::string> places = {};  ///< absolute targets of the directives
  };
  struct Member {
    std::string name;
    std::vector<Use> uses = {};  ///< the main file first
    std::map<std::string, std::size_t, std::less<>> by_path = {};
    std::vector<std::size_t> order = {};    ///< of uses, in reading order
    std::vector<std::string> outside = {};  ///< included by an absolute path
    std::string no_place = {};              ///< reason why the tree cannot be written elsewhere
    std::string units = {};                 ///< "kg, mm, ms", from /BEGIN
  };
  /// Text that one deck wants for a file.
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
