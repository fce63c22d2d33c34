// Remembers what was read of node and element blocks: decks of a library share their meshes, and
// the same lines need not be read twice.
#pragma once
#include <cstddef>
#include <memory>

#include "deck/model/model.hpp"

namespace deck {

/// Lines by their bytes and by all that decides what they mean: layout, units, offsets of ids, the
/// part, the nodes there are. What is taken from here is therefore what reading them again would
/// give. Lines with a finding or with parameters are read every time. For models with one set of
/// schemas, one after the other.
class MeshMemory {
 public:
  /// Keeps what was used last, up to `bytes`.
  explicit MeshMemory(std::size_t bytes = std::size_t{64} << 20);
  ~MeshMemory();
  MeshMemory(const MeshMemory&) = delete;
  MeshMemory& operator=(const MeshMemory&) = delete;

  std::size_t hits() const;    ///< pieces of blocks that were known
  std::size_t misses() const;  ///< those that were read

  struct Store;  ///< private to the library
  Store& store() { return *store_; }

 private:
  std::unique_ptr<Store> store_;
};

/// As build_model without `meshes`, which may be null.
Model build_model(const Deck& deck, const SchemaSet& schemas, Diagnostics& diagnostics,
                  const ModelOptions& options, MeshMemory* meshes);

}  // namespace deck
