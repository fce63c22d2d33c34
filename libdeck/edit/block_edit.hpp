// One value into one block: finds its cell, formats the text, says what else has to be written.
// Private to the stage.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/edit.hpp"
#include "deck/keyword/decode.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {

/// What one value needs. A cell in fixed columns that is there goes to the writer of the caller;
/// all else are edits of lines.
struct BlockEdit {
  std::vector<TextEdit> edits;
  bool read_again = false;  ///< what comes next must see this change: other cells depend on it
  std::string note;         ///< digits were lost
};

/// The error "file:line:column: /KEYWORD/id field: why".
Error block_error(const Deck& deck, const Block& block, Span place, std::string_view field,
                  const std::string& why);

/// Puts `value` into the cell called `field`, `occurrence` cells of that name later. On an error
/// nothing is collected. `absent` is set where the block as it is has no such cell.
Result<BlockEdit> set_value(const Deck& deck, const Block& block, std::string_view field,
                            const CellValue& value, int occurrence, CellWriter& cells,
                            bool& absent);

/// Edits that remove the header and the lines of a block up to its last data line. Error: some of
/// them are in an included file.
Result<std::vector<TextEdit>> erase_block(const Deck& deck, const Block& block);
/// Edits that put blocks before /END of the main file.
std::vector<TextEdit> insert_blocks(const Deck& deck, std::string_view blocks);

}  // namespace deck::detail
