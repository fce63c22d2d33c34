// The document of a listing of the Starter beside its deck.
#include <cmath>

#include "report/shared/inspection.hpp"
#include "report/shared/parts.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

using Ids = std::vector<std::int64_t>;

/// Ids without the zeros behind them.
template <std::size_t N>
Ids ids_of(const std::array<std::int64_t, N>& list) {
  Ids out;
  std::copy_if(list.begin(), list.end(), std::back_inserter(out),
               [](std::int64_t id) { return id != 0; });
  return out;
}

std::optional<double> finite_step(double dt) { return known(dt < 1e29, dt); }

struct ListingDocument {
  const Listing& listing;
  const ListingReport& report;
  const LoadedDeck* loaded = nullptr;

  std::optional<SourcePlace> place(const Span& span) const {
    return loaded == nullptr ? std::nullopt : place_of(loaded->deck(), span);
  }
};

struct FindingOfListing {
  const ListingDocument& document;
  const std::size_t* index;  ///< in ListingReport::findings
  const Diagnostic& finding() const { return document.report.findings[*index]; }
};
LINE_RECORD(FindingOfListing, "finding", "A finding of deck lint.",
            COLUMN("rule", "", id_text(r.finding().rule)),
            COLUMN("severity", "", r.finding().severity),
            COLUMN("message", "", r.finding().message),
            COLUMN("reference", "", *r.finding().reference),
            COLUMN("place", "", r.document.place(r.finding().span)));

struct PlaceRow {
  const ListingDocument& document;
  const MessagePlace* at;
};
RECORD(PlaceRow, "message_place", "",
       COLUMN("name", "What the message is about; may be empty", r.at->name),
       COLUMN("id", "0: it names nothing", r.at->id), COLUMN("times", "", r.at->times),
       COLUMN("says", "Numbers that its messages show, such as of penetrations, each once",
              r.at->counted),
       COLUMN("place", "", r.document.place(r.at->span)), COLUMN("nodes", "", r.at->nodes),
       COLUMN("lines", "Lines of the listing", r.at->lines),
       COLUMN("findings", "", rows<FindingOfListing>(r.at->findings, r.document)));

struct MessageRow {
  const ListingDocument& document;
  const MessageGroup* group;
};
RECORD(MessageRow, "message", "", COLUMN("message", "", r.group->number),
       COLUMN("severity", "", r.group->severity), COLUMN("times", "", r.group->times),
       COLUMN("title", "", r.group->title), COLUMN("means", "", r.group->means),
       COLUMN("do", "", r.group->action),
       COLUMN("places", "", rows<PlaceRow>(r.group->places, r.document)),
       COLUMN("findings", "With the same message, about something else",
              rows<FindingOfListing>(r.group->findings, r.document)));

struct ContactOfListing {
  const ListingDocument& document;
  const ComparedContact* c;
  const Contact& contact() const { return document.loaded->scene().contacts[c->contact]; }
  std::vector<std::size_t> lines() const {
    if (c->listed == nullptr) return {};
    std::vector<std::size_t> out{c->listed->line};
    if (c->listed->total_line != 0) out.push_back(c->listed->total_line);
    return out;
  }
};

struct PairOfListing {
  const ContactOfListing& of;
  const ComparedPair* pair;
  const PenetrationRow& row() const { return of.contact().penetrations[pair->pair.row]; }
};
LINE_RECORD(PairOfListing, "pair", "",
            COLUMN("secondary", "A node, or the two of an edge", ids_of(r.pair->pair.secondary)),
            COLUMN("main", "", ids_of(r.pair->pair.main)),
            COLUMN("parts", "Of the secondary and of the main side; 0: none",
                   std::array{r.pair->pair.secondary_element.part, r.pair->pair.main_element.part}),
            COLUMN("penetration", "", r.row().depth), COLUMN("gap", "", r.row().gap),
            COLUMN("action", "", r.row().action),
            COLUMN("listed", "null: the listing does not show pairs",
                   known(r.of.c->by_pair, r.pair->listed)),
            COLUMN("listed_penetration", "", r.pair->listed_depth));

}  // namespace

std::string_view listed_kind(const ComparedSteps& steps) {
  return steps.kind ? detail::kind_name(*steps.kind) : "node";
}

LINE_RECORD(ListedPair, "listed_pair", "A pair that only the listing has.",
            COLUMN("secondary", "", ids_of(r.secondary)), COLUMN("main", "", ids_of(r.main)),
            COLUMN("listed_penetration", "", r.depth));

namespace {

RECORD(ContactOfListing, "contact", "", COLUMN("interface", "", r.contact().inter->id),
       COLUMN("type", "", r.contact().inter->type), COLUMN("role", "", r.contact().role),
       COLUMN("agrees", "", r.c->agrees()),
       COLUMN("listed", "Penetrations in the listing; null: it does not work on the contact",
              known(r.c->listed != nullptr, r.c->listed_count)),
       COLUMN("computed", "Pairs of deck gaps, ties included as in the listing", r.c->pairs.size()),
       COLUMN("by_pair", "The listing shows the pairs", r.c->by_pair),
       COLUMN("largest_difference", "Of depths, as a share of the gap", r.c->largest_difference),
       COLUMN("lines", "Of the listing: where its work begins, and the message with the number",
              r.lines()),
       COLUMN("pairs", "", rows<PairOfListing>(r.c->pairs, r)),
       COLUMN("listed_only", "", r.c->only_listed));

}  // namespace

LINE_RECORD(StepDifference, "step_difference", "", COLUMN("id", "", r.id),
            COLUMN("listed", "", finite_step(r.listed)),
            COLUMN("computed", "", finite_step(r.computed)));

RECORD(ComparedSteps, "steps", "", COLUMN("of", "Kind of element, or node", listed_kind(r)),
       COLUMN("listed", "", r.listed), COLUMN("equal", "Within 1e-6", r.equal),
       COLUMN("not_computed", "", r.not_computed),
       COLUMN("largest_difference", "Relative, of those that are equal", r.largest_difference),
       COLUMN("smallest", "null: no element limits the step", finite_step(r.smallest)),
       COLUMN("smallest_id", "", r.smallest_id), COLUMN("different", "", r.different));

namespace {

RECORD(ListingDocument, "document", "",
       LINE_OBJECT("listing", "", COLUMN("path", "", r.listing.path),
                   COLUMN("printout", "/IOFLAG Ipri: pairs from 1 on, depths from 5 on",
                          r.listing.printout),
                   COLUMN("errors", "From its end; null: it has no end", r.listing.errors),
                   COLUMN("warnings", "", r.listing.warnings)),
       COLUMN("deck", "null: none is beside the listing",
              r.loaded == nullptr ? std::nullopt : std::optional(deck_row(*r.loaded))),
       COLUMN("agrees", "Penetrations and time steps are those of deck", r.report.agrees()),
       COLUMN("messages", "", rows<MessageRow>(r.report.messages, r)),
       COLUMN("contacts", "", rows<ContactOfListing>(r.report.contacts, r)),
       COLUMN("contacts_of_listing_only", "Contacts that the deck does not have",
              r.report.unnamed_contacts),
       COLUMN("steps", "", r.report.steps),
       COLUMN("not_listed", "Findings about a message of the solver that the listing does not have",
              rows<FindingOfListing>(r.report.not_listed, r)));

constexpr DocumentHead listing_head{
    "deck/explain", 1,
    "Written by deck explain NAME_0000.out --json: a listing of the "
    "Starter beside its deck.",
    false};

}  // namespace

DocumentSchema explain_schema() { return document_schema<ListingDocument>(listing_head); }

std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded) {
  return write_document(listing_head, ListingDocument{listing, report, loaded});
}

}  // namespace deck
