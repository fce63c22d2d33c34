// The document of a listing of the Starter beside its deck.
#include <cmath>

#include "report/shared/listing.hpp"
#include "report/shared/parts.hpp"
#include "report/shared/schemas.hpp"
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

  std::optional<Place> place(const Span& span) const {
    return loaded == nullptr ? std::nullopt : place_of(loaded->deck(), span);
  }
};

struct ListingRow {
  const Listing* listing = nullptr;
};
Record<ListingRow> record_of(const ListingRow*) {
  static constexpr Column<ListingRow> columns[] = {
      column<&ListingRow::listing, &Listing::path>("path"),
      column<&ListingRow::listing, &Listing::printout>(
          "printout", "/IOFLAG Ipri: pairs from 1 on, depths from 5 on"),
      column<&ListingRow::listing, &Listing::errors>("errors", "From its end; null: it has no end"),
      column<&ListingRow::listing, &Listing::warnings>("warnings")};
  return {"listing", "", columns, true};
}

struct FindingOfListing {
  const ListingDocument* document = nullptr;
  const Diagnostic* d = nullptr;
  std::string_view rule() const { return id_text(d->rule); }
  std::optional<Place> place() const { return document->place(d->span); }
};
Record<FindingOfListing> record_of(const FindingOfListing*) {
  using Row = FindingOfListing;
  static constexpr Column<Row> columns[] = {
      column<&Row::rule>("rule"), column<&Row::d, &Diagnostic::severity>("severity"),
      column<&Row::d, &Diagnostic::message>("message"),
      column("reference", [](const Row& r) { return *r.d->reference; }),
      column<&Row::place>("place")};
  return {"finding", "A finding of deck lint.", columns, true};
}

Rows<FindingOfListing> findings(const ListingDocument* document,
                                const std::vector<std::size_t>& list) {
  return {[document, &list](const auto& add) {
    for (const std::size_t f : list) add({document, &document->report.findings[f]});
  }};
}

struct PlaceRow {
  const ListingDocument* document = nullptr;
  const MessagePlace* at = nullptr;
  std::optional<Place> place() const { return document->place(at->span); }
  Rows<FindingOfListing> own_findings() const { return findings(document, at->findings); }
};
Record<PlaceRow> record_of(const PlaceRow*) {
  static constexpr Column<PlaceRow> columns[] = {
      column<&PlaceRow::at, &MessagePlace::name>("name", "What the message is about; may be empty"),
      column<&PlaceRow::at, &MessagePlace::id>("id", "0: it names nothing"),
      column<&PlaceRow::at, &MessagePlace::times>("times"),
      column<&PlaceRow::at, &MessagePlace::counted>(
          "says", "Numbers that its messages show, such as of penetrations, each once"),
      column<&PlaceRow::place>("place"),
      column<&PlaceRow::at, &MessagePlace::nodes>("nodes"),
      column<&PlaceRow::at, &MessagePlace::lines>("lines", "Lines of the listing"),
      column<&PlaceRow::own_findings>("findings")};
  return {"message_place", "", columns};
}

struct MessageRow {
  const ListingDocument* document = nullptr;
  const MessageGroup* group = nullptr;
  Rows<PlaceRow> places() const {
    return rows_of(group->places, [this](const MessagePlace& place) {
      return PlaceRow{document, &place};
    });
  }
  Rows<FindingOfListing> own_findings() const { return findings(document, group->findings); }
};
Record<MessageRow> record_of(const MessageRow*) {
  static constexpr Column<MessageRow> columns[] = {
      column<&MessageRow::group, &MessageGroup::number>("message"),
      column<&MessageRow::group, &MessageGroup::severity>("severity"),
      column<&MessageRow::group, &MessageGroup::times>("times"),
      column<&MessageRow::group, &MessageGroup::title>("title"),
      column<&MessageRow::group, &MessageGroup::means>("means"),
      column<&MessageRow::group, &MessageGroup::action>("do"),
      column<&MessageRow::places>("places"),
      column<&MessageRow::own_findings>("findings", "With the same message, about something else")};
  return {"message", "", columns};
}

struct PairOfListing {
  const ComparedContact* contact = nullptr;
  const ComparedPair* pair = nullptr;
  const PenetrationRow* row = nullptr;
  Ids secondary() const { return ids_of(pair->pair.secondary); }
  Ids main() const { return ids_of(pair->pair.main); }
  std::array<std::int64_t, 2> parts() const {
    return {pair->pair.secondary_element.part, pair->pair.main_element.part};
  }
  std::optional<bool> listed() const { return known(contact->by_pair, pair->listed); }
};
Record<PairOfListing> record_of(const PairOfListing*) {
  static constexpr Column<PairOfListing> columns[] = {
      column<&PairOfListing::secondary>("secondary", "A node, or the two of an edge"),
      column<&PairOfListing::main>("main"),
      column<&PairOfListing::parts>("parts", "Of the secondary and of the main side; 0: none"),
      column<&PairOfListing::row, &PenetrationRow::depth>("penetration"),
      column<&PairOfListing::row, &PenetrationRow::gap>("gap"),
      column<&PairOfListing::row, &PenetrationRow::action>("action"),
      column<&PairOfListing::listed>("listed", "null: the listing does not show pairs"),
      column<&PairOfListing::pair, &ComparedPair::listed_depth>("listed_penetration")};
  return {"pair", "", columns, true};
}

struct ListedOnly {
  const ListedPair* pair = nullptr;
  Ids secondary() const { return ids_of(pair->secondary); }
  Ids main() const { return ids_of(pair->main); }
};
Record<ListedOnly> record_of(const ListedOnly*) {
  static constexpr Column<ListedOnly> columns[] = {
      column<&ListedOnly::secondary>("secondary"), column<&ListedOnly::main>("main"),
      column<&ListedOnly::pair, &ListedPair::depth>("listed_penetration")};
  return {"listed_pair", "A pair that only the listing has.", columns, true};
}

struct ContactOfListing {
  const Contact* contact = nullptr;
  const ComparedContact* c = nullptr;
  bool agrees() const { return c->agrees(); }
  std::optional<std::uint64_t> listed() const {
    return known(c->listed != nullptr, c->listed_count);
  }
  std::size_t computed() const { return c->pairs.size(); }
  std::vector<std::size_t> lines() const {
    if (c->listed == nullptr) return {};
    std::vector<std::size_t> out{c->listed->line};
    if (c->listed->total_line != 0) out.push_back(c->listed->total_line);
    return out;
  }
  Rows<PairOfListing> pairs() const {
    return rows_of(c->pairs, [this](const ComparedPair& p) {
      return PairOfListing{c, &p, &contact->penetrations[p.pair.row]};
    });
  }
  Rows<ListedOnly> listed_only() const {
    return rows_of(c->only_listed, [this](const ListedPair& p) { return ListedOnly{&p}; });
  }
};
Record<ContactOfListing> record_of(const ContactOfListing*) {
  static constexpr Column<ContactOfListing> columns[] = {
      column<&ContactOfListing::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&ContactOfListing::contact, &Contact::inter, &InterBase::type>("type"),
      column<&ContactOfListing::contact, &Contact::role>("role"),
      column<&ContactOfListing::agrees>("agrees"),
      column<&ContactOfListing::listed>(
          "listed", "Penetrations in the listing; null: it does not work on the contact"),
      column<&ContactOfListing::computed>("computed",
                                          "Pairs of deck gaps, ties included as in the listing"),
      column<&ContactOfListing::c, &ComparedContact::by_pair>("by_pair",
                                                              "The listing shows the pairs"),
      column<&ContactOfListing::c, &ComparedContact::largest_difference>(
          "largest_difference", "Of depths, as a share of the gap"),
      column<&ContactOfListing::lines>(
          "lines", "Of the listing: where its work begins, and the message with the number"),
      column<&ContactOfListing::pairs>("pairs"),
      column<&ContactOfListing::listed_only>("listed_only")};
  return {"contact", "", columns};
}

struct ListedStepsRow {
  const ComparedSteps* s = nullptr;
  std::string_view of() const {
    return s->kind ? std::string_view(detail::kind_name(*s->kind)) : "node";
  }
  std::optional<double> smallest() const { return finite_step(s->smallest); }
  Rows<StepDifference> different() const { return rows_of(s->different); }
};
Record<ListedStepsRow> record_of(const ListedStepsRow*) {
  static constexpr Column<ListedStepsRow> columns[] = {
      column<&ListedStepsRow::of>("of", "Kind of element, or node"),
      column<&ListedStepsRow::s, &ComparedSteps::listed>("listed"),
      column<&ListedStepsRow::s, &ComparedSteps::equal>("equal", "Within 1e-6"),
      column<&ListedStepsRow::s, &ComparedSteps::not_computed>("not_computed"),
      column<&ListedStepsRow::s, &ComparedSteps::largest_difference>(
          "largest_difference", "Relative, of those that are equal"),
      column<&ListedStepsRow::smallest>("smallest", "null: no element limits the step"),
      column<&ListedStepsRow::s, &ComparedSteps::smallest_id>("smallest_id"),
      column<&ListedStepsRow::different>("different")};
  return {"steps", "", columns};
}

Rows<MessageRow> messages(const ListingDocument& r) {
  return rows_of(r.report.messages, [&r](const MessageGroup& group) {
    return MessageRow{&r, &group};
  });
}
Rows<ContactOfListing> contacts(const ListingDocument& r) {
  return rows_of(r.report.contacts, [&r](const ComparedContact& c) {
    return ContactOfListing{&r.loaded->scene().contacts[c.contact], &c};
  });
}
Rows<ListedStepsRow> steps(const ListingDocument& r) {
  return rows_of(r.report.steps, [&r](const ComparedSteps& s) { return ListedStepsRow{&s}; });
}
std::optional<DeckRow> deck_of(const ListingDocument& r) {
  if (r.loaded == nullptr) return std::nullopt;
  const LoadedDeck& d = *r.loaded;
  return DeckRow{d.path(), &d.deck(), &d.model(), &d.interfaces()};
}

Record<ListingDocument> record_of(const ListingDocument*) {
  using Row = ListingDocument;
  static constexpr Column<Row> columns[] = {
      column("listing", [](const Row& r) { return ListingRow{&r.listing}; }),
      column<deck_of>("deck", "null: none is beside the listing"),
      column("agrees", "Penetrations and time steps are those of deck",
             [](const Row& r) { return r.report.agrees(); }),
      column<messages>("messages"),
      column<contacts>("contacts"),
      column("contacts_of_listing_only", "Contacts that the deck does not have",
             [](const Row& r) { return r.report.unnamed_contacts; }),
      column<steps>("steps"),
      column("not_listed", "Findings about a message of the solver that the listing does not have",
             [](const Row& r) { return findings(&r, r.report.not_listed); })};
  return {"document", "", columns};
}

constexpr DocumentHead listing_head{
    "deck/explain", 1,
    "Written by deck explain NAME_0000.out --json: a listing of the "
    "Starter beside its deck.",
    false};

}  // namespace

Record<StepDifference> record_of(const StepDifference*) {
  using Row = StepDifference;
  static constexpr Column<Row> columns[] = {
      column<&Row::id>("id"), column("listed", [](const Row& r) { return finite_step(r.listed); }),
      column("computed", [](const Row& r) { return finite_step(r.computed); })};
  return {"step_difference", "", columns, true};
}

DocumentSchema explain_schema() { return document_schema<ListingDocument>(listing_head); }

std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded) {
  return write_document(listing_head, ListingDocument{listing, report, loaded});
}

}  // namespace deck
