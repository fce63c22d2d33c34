// A listing of the Starter beside its deck, for people and for programs.
#pragma once
#include <string>

#include "deck/inspect/listing.hpp"

namespace deck {

struct ListingTextOptions {
  bool color = false;
  std::size_t width = 0;  ///< columns of a line; 0: any
  std::size_t worst = 3;  ///< rows of the deepest penetrations of each contact
  bool verbose = false;   ///< every place and finding; else the first of many
};

/// `loaded` may be nullptr: the messages alone.
std::string listing_text(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded, const ListingTextOptions& options = {});
/// The document of `deck explain NAME_0000.out --json` (schemas/output/explain.schema.json).
std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded);

}  // namespace deck
