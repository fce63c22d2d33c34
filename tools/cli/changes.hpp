// Writes decks: one set of files for all decks of the call, in place, below a directory or as a
// patch, all or nothing. All verbs use it.
#pragma once
#include <string>
#include <vector>

#include "common.hpp"
#include "edit/shared/edit_set.hpp"

namespace deck::cli {

/// Options for writing decks.
struct WriteFlags {
  std::string directory, backup_suffix, root;
  bool in_place = false, diff = false, overwrite = false;
  bool read_back = false;  ///< read the planned contents before writing
};
/// Adds the options of a choice; the second function only --root.
void add_write_options(CommandLine& line, WriteFlags& choice);
void add_root_option(CommandLine& line, WriteFlags& choice);
/// Error in the combination of options; empty: none.
std::string usage_error(const WriteFlags& choice);

/// Before changes in place: completes an interrupted write, and returns the files of the decks that
/// other decks include, each with one of these.
Result<std::map<FileIdentity, std::string>> recover_and_find_dependents(
    const std::vector<std::string>& decks, const std::string& root, const CommonOptions& common);

class Changes {
 public:
  Changes(const CommonOptions& common, const WriteFlags& choice)
      : common_(common), choice_(choice) {}
  /// The decks: `given` with directories and patterns expanded. Completes interrupted writes. Must
  /// be called first.
  Result<std::vector<std::string>> decks(const std::vector<std::string>& given);
  /// Directory below which decks keep their relative path; empty: all at the top.
  const std::string& root() const { return root_; }
  /// See EditSet::add.
  Result<std::size_t> add(const LoadedDeck& loaded, const std::string& name);
  void propose(std::size_t deck, const Deck& now, const ChangedFiles& changed);
  /// Writes all files or prints the patch; `list`: also lists the files. On error nothing was
  /// written.
  Result<void> write(bool list);
  /// The error of write(), or of diff() if there is no output.
  Result<void> check();
  /// The patch.
  Result<std::string> diff() const { return set_.diff(); }
  /// Writes documents under these rules.
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
