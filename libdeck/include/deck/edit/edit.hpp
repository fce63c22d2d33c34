// Edit: values of a deck changed by name, shown as a patch, written back. The way to change a deck
// from a program.
//
//   deck::Edit edit(*loaded);
//   edit.set(loaded->interfaces().find(3), "Gapmin", 0.8);
//   edit.set("/PROP", 2, "Thick", 1.5).move_node(1001, {0, 0, 12.5});
//   if (const auto saved = edit.save(); !saved) ...saved.error().message
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deck/base/point3.hpp"
#include "deck/text/result.hpp"

namespace deck {

class EditSet;
class LoadedDeck;
struct Block;
struct Deck;
struct InterBase;

/// A number in the deck's working units, as the library gives values; or the text of the cell, in
/// the units of the card ("0.8", "&gap"; empty: blank).
using CellValue = std::variant<std::int64_t, double, std::string>;

struct SaveOptions {
  std::string backup_suffix;        ///< not empty: a file that is replaced stays under this ending
  std::vector<std::string> others;  ///< further decks that must not change
};

/// The block with this keyword, or below it ("/PROP" finds /PROP/SHELL), and id, offsets of
/// submodels added. Other names of a keyword are the same ("/PROP/TYPE1"). Error: none, or several.
Result<const Block*> find_block(const Deck& deck, std::string_view keyword, std::int64_t id);

/// Changes of one deck. It points to the deck, which must outlive it, stays where it is and is not
/// changed itself.
/// The first change that cannot be made is kept as an error ("file:line:column: /KEYWORD/id field:
/// what was expected"): diff(), save() and save_to() then give it, and nothing is written.
///
/// A number gets the shortest text that reads back to it, right-aligned; with fewer digits where
/// the cell is too narrow, which notes() tells. Lines that are too short grow, in fixed and in free
/// format; lines that a block leaves away at its end are added. Where a cell has the value already,
/// nothing changes.
class Edit {
 public:
  explicit Edit(const LoadedDeck& loaded);
  explicit Edit(LoadedDeck&&) = delete;
  Edit(Edit&&) noexcept;
  Edit& operator=(Edit&&) noexcept;
  ~Edit();

  /// A field by the manual's name, of a block of the deck. `occurrence`: which one, from 0, where a
  /// line with it repeats. A null pointer is an error of the edit.
  Edit& set(const InterBase* inter, std::string_view field, const CellValue& value);
  Edit& set(const Block* block, std::string_view field, const CellValue& value, int occurrence = 0);
  Edit& set(std::string_view keyword, std::int64_t id, std::string_view field,
            const CellValue& value, int occurrence = 0);
  /// Coordinates in working units. Error where the line of the node does not say where it is
  /// (/CNODE, /TRANSFORM).
  Edit& move_node(std::int64_t id, const Point3<double>& to);
  /// Adds blocks, whole lines that begin with a keyword, at the end of the main file. Lines that
  /// they leave away come when their fields are set.
  Edit& insert(std::string_view blocks);
  /// Removes a block with its lines; comments after its last line stay.
  Edit& erase(const Block* block);
  /// The block with this keyword and id, as find_block() has it, in the deck with what was
  /// inserted. One that was inserted is there until the next change.
  Result<const Block*> find(std::string_view keyword, std::int64_t id);

  /// The error that diff(), save() and save_to() would give.
  Result<void> status() const;
  /// Values that lost digits, one sentence each.
  const std::vector<std::string>& notes() const;
  /// The deck as it will be, read from memory.
  Result<LoadedDeck> read();

  /// The changes as a patch that git apply takes.
  Result<std::string> diff();
  /// Replaces the files that change where they are, packed ones packed; all of them or none, and
  /// only if they still are what was read. Gives their paths. Error: another deck in the folder of
  /// such a file, or one of `others`, includes it.
  Result<std::vector<std::string>> save(const SaveOptions& options = {});
  /// Writes all files of the deck below another directory. Error: a file that is there and differs,
  /// unless `overwrite`; a file of the deck itself in any case.
  Result<std::vector<std::string>> save_to(const std::string& directory, bool overwrite = false);
  /// All files of the deck with what they shall hold, for writing them in other ways.
  Result<EditSet> files();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace deck
