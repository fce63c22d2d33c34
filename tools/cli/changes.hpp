// How verbs write decks: one set of files for all decks of the call, in place, below a directory or
// as a patch, all of it or nothing. No verb writes decks by another way.
#pragma once
#include <string>
#include <vector>

#include "common.hpp"
#include "edit/shared/edit_set.hpp"

namespace deck::cli {

/// Where to write.
struct WriteFlags {
  std::string directory, backup_suffix, root;
  bool in_place = false, diff = false, overwrite = false;
  bool read_back = false;  ///< what was planned is read as it will lie there before it is written
};
/// Options that fill a choice, and of them --root alone.
void add_write_options(CommandLine& line, WriteFlags& choice);
void add_root_option(CommandLine& line, WriteFlags& choice);
/// What is wrong with the combination; empty: nothing.
std::string usage_error(const WriteFlags& choice);

/// Before decks are changed in place: finishes what a kill left half written of them, and returns
/// their files that other decks include, each with such a deck.
Result<std::map<FileIdentity, std::string>> recover_and_find_dependents(
    const std::vector<std::string>& decks, const std::string& root, const CommonOptions& common);

class Changes {
 public:
  Changes(const CommonOptions& common, const WriteFlags& choice)
      : common_(common), choice_(choice) {}

  /// The decks to work on: `given` with directories and patterns expanded. What a kill left half
  /// written of them is finished first. Call before anything else.
  Result<std::vector<std::string>> decks(const std::vector<std::string>& given);
  /// The directory below which decks keep their place; empty: decks are written at the top.
  const std::string& root() const { return root_; }

  /// See EditSet.
  Result<std::size_t> add(const LoadedDeck& loaded, const std::string& name);
  void propose(std::size_t deck, const Deck& now, const ChangedFiles& changed);

  /// Writes all, or prints the patch, and lists the files if `list` says so. Error: nothing was
  /// written, and why.
  Result<void> write(bool list);
  /// What write() would refuse, or diff() where there is no place to write to.
  Result<void> check();
  /// The patch.
  Result<std::string> diff() const { return set_.diff(); }
  /// Writes results that are no decks the same way.
  Result<void> write_documents(const std::vector<OutputFile>& files, bool list);

 private:
  Result<EditSet::Plan> plan();
  Result<void> read_back(const EditSet::Plan& plan) const;
  OutputRules rules(bool deck_tree) const;
  Result<void> put(const std::vector<OutputFile>& files, WriteOptions options,
                   const OutputRules& rules);
  void list_files(const std::vector<OutputFile>& files) const;

  const CommonOptions& common_;
  const WriteFlags& choice_;
  std::string root_;
  EditSet set_;
  std::vector<std::string> names_;
  std::map<FileIdentity, std::string> outsiders_;
};

}  // namespace deck::cli
