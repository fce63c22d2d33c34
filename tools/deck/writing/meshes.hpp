// What decks of one call share of what was read.
#pragma once
#include "deck/model/mesh_memory.hpp"

namespace deck::cli {

/// Where load() looks for node and element blocks that it knows; null: nowhere.
MeshMemory*& shared_meshes();

/// Lets the decks of a call share their meshes, as long as it lives.
class SharedMeshes {
 public:
  SharedMeshes() { shared_meshes() = &meshes_; }
  ~SharedMeshes() { shared_meshes() = nullptr; }
  SharedMeshes(const SharedMeshes&) = delete;
  SharedMeshes& operator=(const SharedMeshes&) = delete;

 private:
  MeshMemory meshes_;
};

}  // namespace deck::cli
