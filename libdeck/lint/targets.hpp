// What an id on a card refers to: whether the target exists and how many members it has. Shared by
// the checks of references.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "deck/lint/lint.hpp"

namespace deck::detail {

/// "/GRNOD" for "grnod", "node" for "node": how people name the kind of an entity.
std::string_view kind_name(std::string_view kind);

/// A /GRNOD, /SURF or /LINE (`kind` "grnod", "surf", "line"), or a /SET in its place.
bool selection_exists(const LintContext& c, std::string_view kind, std::int64_t id);

/// "/GRNOD 5" where there is one, else "/SET 5".
std::string selection_name(const LintContext& c, std::string_view kind, std::int64_t id);

/// Nodes, segments or edges of such a selection.
std::size_t selection_size(const LintContext& c, std::string_view kind, std::int64_t id);

/// False if members were left out (DK332): the selection may have members.
bool selection_is_empty(const LintContext& c, std::string_view kind, std::int64_t id);

/// Whether the entity exists; no value: not known (no model, or a kind without a table).
std::optional<bool> target_exists(const LintContext& c, std::string_view kind, std::int64_t id);

/// The field of a block that names what it acts on, and whether that is there; nullptr: no such
/// field.
std::pair<const Field*, bool> acts_on(const LintContext& c, const DecodedBlock& d);

/// The field that names what the block acts on, where the solver passes over the block and checks
/// nothing of it: its target is 0, or there is none and no such block has any. Else nullptr.
const Field* acts_on_nothing(const LintContext& c, const DecodedBlock& d);

}  // namespace deck::detail
