// What a conversion cost, on the terminal and as entries of the report.
#pragma once
#include <string>
#include <vector>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"

namespace deck::cli {

/// A refusal ("file:line:column: /KEYWORD/id field: why") as an entry of the report.
LossEntry refused_entry(const std::string& refusal);

/// Counts for people; what was lost or waits for a decision line by line. Values without effect of
/// one field are one line.
void print_losses(const std::vector<LossEntry>& losses, const CommonOptions& common);
/// The counts alone.
void print_loss_counts(const std::vector<LossEntry>& losses);

}  // namespace deck::cli
