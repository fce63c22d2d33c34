// Content of an extraction.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "edit/cells.hpp"
#include "keyword/shared/references.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

inline constexpr std::size_t element_families = 8;

/// Blocks, nodes and elements that the interfaces need.
class Extraction {
 public:
  Extraction(const LoadedDeck& context, std::span<const std::int64_t> interfaces);
  void run();
  bool keeps(const Block& bulk, const ItemLines& item) const;

  std::vector<std::uint8_t> block_kept;                                  ///< by Deck::blocks
  std::vector<std::uint8_t> node_kept;                                   ///< by NodeIndex
  std::array<std::vector<std::uint8_t>, element_families> element_kept;  ///< by ElementKind, index
  std::vector<std::string> open_questions;  ///< possible omissions, for the report

 private:
  /// Reason why a block stays.
  enum Level : std::uint8_t {
    no = 0,
    defined,   ///< named
    selected,  ///< its selection must be complete
    touching,  ///< and adjacent elements matter
  };
  struct Task {
    std::size_t block;
    Level level;
  };
  void keep_block(std::string_view kind, std::int64_t id, Level level = defined);
  void keep_block(std::size_t index, Level level = defined);
  void process(const Task& task);
  void reference(std::string_view kind, std::int64_t id, bool selects, bool touch);
  void range(const Reference& r, bool selects, bool touch);
  void clauses_without_ids(const Block& b, const DecodedBlock& d);
  void resolved(const Block& b, bool touch);
  void tokens(const Block& b, const DecodedBlock& d);
  void keep_node(NodeIndex n, bool touch);
  void keep_element(ElementKind kind, std::uint32_t e, bool touch);
  void whole_part(std::uint32_t part, bool touch);
  void everything();
  std::int64_t id_of(const Block& bulk, const ItemLines& item) const;
  bool names_kept(std::string_view kind, const Block& b) const;
  void keep_switches();
  void drain();
  void neighbours();
  void scan_elements();
  void transforms();
  void materials();
  void functions();
  void submodel_frames();
  std::uint64_t size() const;

  const Deck& deck_;
  const Model& model_;
  Selections& selections_;
  std::map<std::pair<std::string, std::int64_t>, std::size_t, std::less<>> definitions_;
  std::deque<Task> queue_;
  std::vector<std::uint8_t> visited_;  // by block: Level
  std::vector<std::uint8_t> touched_;  // by node
  std::array<std::vector<std::uint8_t>, element_families> scanned_;
  std::vector<std::uint8_t> part_whole_;
  std::vector<std::vector<std::pair<ElementKind, std::uint32_t>>> elements_of_part_;
};

}  // namespace deck::detail
