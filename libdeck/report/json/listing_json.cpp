// The document of a listing of the Starter beside its deck.
#include <cmath>

#include "report/parts_rows.hpp"
#include "report/shared/listing.hpp"
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
const Record<ListingRow>& record_of(const ListingRow*) {
  using Row = ListingRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::listing, &Listing::path>("path"),
      column<&Row::listing, &Listing::printout>("printout",
                                                "/IOFLAG Ipri: pairs from 1 on, depths from 5 on"),
      column<&Row::listing, &Listing::errors>("errors", "From its end; null: it has no end"),
      column<&Row::listing, &Listing::warnings>("warnings")};
  static const Record<Row> record{"listing", "", columns, true};
  return record;
}

struct FindingOfListing {
  const ListingDocument* document = nullptr;
  const Diagnostic* d = nullptr;
  std::string_view rule() const { return id_text(d->rule); }
  std::optional<Place> place() const { return document->place(d->span); }
};
const Record<FindingOfListing>& record_of(const FindingOfListing*) {
  using Row = FindingOfListing;
  static constexpr Column<Row> columns[] = {
      column<&Row::rule>("rule"), column<&Row::d, &Diagnostic::severity>("severity"),
      column<&Row::d, &Diagnostic::message>("message"),
      column<Row>("reference", "", [](const Row& r) { return *r.d->reference; }),
      column<&Row::place>("place")};
  static const Record<Row> record{"finding", "A finding of deck lint.", columns, true};
  return record;
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
const Record<PlaceRow>& record_of(const PlaceRow*) {
  using Row = PlaceRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::at, &MessagePlace::name>("name", "What the message is about; may be empty"),
      column<&Row::at, &MessagePlace::id>("id", "0: it names nothing"),
      column<&Row::at, &MessagePlace::times>("times"),
      column<&Row::at, &MessagePlace::counted>(
          "says", "Numbers that its messages show, such as of penetrations, each once"),
      column<&Row::place>("place"),
      column<&Row::at, &MessagePlace::nodes>("nodes"),
      column<&Row::at, &MessagePlace::lines>("lines", "Lines of the listing"),
      column<&Row::own_findings>("findings")};
  static const Record<Row> record{"message_place", "", columns};
  return record;
}

struct MessageRow {
  const ListingDocument* document = nullptr;
  const MessageGroup* group = nullptr;
  Rows<PlaceRow> places() const {
    return {[this](const auto& add) {
      for (const MessagePlace& place : group->places) add({document, &place});
    }};
  }
  Rows<FindingOfListing> own_findings() const { return findings(document, group->findings); }
};
const Record<MessageRow>& record_of(const MessageRow*) {
  using Row = MessageRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::group, &MessageGroup::number>("message"),
      column<&Row::group, &MessageGroup::severity>("severity"),
      column<&Row::group, &MessageGroup::times>("times"),
      column<&Row::group, &MessageGroup::title>("title"),
      column<&Row::group, &MessageGroup::means>("means"),
      column<&Row::group, &MessageGroup::action>("do"),
      column<&Row::places>("places"),
      column<&Row::own_findings>("findings", "With the same message, about something else")};
  static const Record<Row> record{"message", "", columns};
  return record;
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
const Record<PairOfListing>& record_of(const PairOfListing*) {
  using Row = PairOfListing;
  static constexpr Column<Row> columns[] = {
      column<&Row::secondary>("secondary", "A node, or the two of an edge"),
      column<&Row::main>("main"),
      column<&Row::parts>("parts", "Of the secondary and of the main side; 0: none"),
      column<&Row::row, &PenetrationRow::depth>("penetration"),
      column<&Row::row, &PenetrationRow::gap>("gap"),
      column<&Row::row, &PenetrationRow::action>("action"),
      column<&Row::listed>("listed", "null: the listing does not show pairs"),
      column<&Row::pair, &ComparedPair::listed_depth>("listed_penetration")};
  static const Record<Row> record{"pair", "", columns, true};
  return record;
}

struct ListedOnly {
  const ListedPair* pair = nullptr;
  Ids secondary() const { return ids_of(pair->secondary); }
  Ids main() const { return ids_of(pair->main); }
};
const Record<ListedOnly>& record_of(const ListedOnly*) {
  using Row = ListedOnly;
  static constexpr Column<Row> columns[] = {
      column<&Row::secondary>("secondary"), column<&Row::main>("main"),
      column<&Row::pair, &ListedPair::depth>("listed_penetration")};
  static const Record<Row> record{"listed_pair", "A pair that only the listing has.", columns,
                                  true};
  return record;
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
    return {[this](const auto& add) {
      for (const ComparedPair& p : c->pairs) add({c, &p, &contact->penetrations[p.pair.row]});
    }};
  }
  Rows<ListedOnly> listed_only() const {
    return {[this](const auto& add) {
      for (const ListedPair& p : c->only_listed) add({&p});
    }};
  }
};
const Record<ContactOfListing>& record_of(const ContactOfListing*) {
  using Row = ContactOfListing;
  static constexpr Column<Row> columns[] = {
      column<&Row::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&Row::contact, &Contact::inter, &InterBase::type>("type"),
      column<&Row::contact, &Contact::role>("role"),
      column<&Row::agrees>("agrees"),
      column<&Row::listed>("listed",
                           "Penetrations in the listing; null: it does not work on the contact"),
      column<&Row::computed>("computed", "Pairs of deck gaps, ties included as in the listing"),
      column<&Row::c, &ComparedContact::by_pair>("by_pair", "The listing shows the pairs"),
      column<&Row::c, &ComparedContact::largest_difference>("largest_difference",
                                                            "Of depths, as a share of the gap"),
      column<&Row::lines>("lines",
                          "Of the listing: where its work begins, and the message with the number"),
      column<&Row::pairs>("pairs"),
      column<&Row::listed_only>("listed_only")};
  static const Record<Row> record{"contact", "", columns};
  return record;
}

struct StepsRow {
  const ComparedSteps* s = nullptr;
  std::string_view of() const {
    return s->kind ? std::string_view(detail::kind_name(*s->kind)) : "node";
  }
  std::optional<double> smallest() const { return finite_step(s->smallest); }
  Rows<StepDifference> different() const {
    return {[this](const auto& add) {
      for (const StepDifference& d : s->different) add(d);
    }};
  }
};
const Record<StepsRow>& record_of(const StepsRow*) {
  using Row = StepsRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::of>("of", "Kind of element, or node"),
      column<&Row::s, &ComparedSteps::listed>("listed"),
      column<&Row::s, &ComparedSteps::equal>("equal", "Within 1e-6"),
      column<&Row::s, &ComparedSteps::not_computed>("not_computed"),
      column<&Row::s, &ComparedSteps::largest_difference>("largest_difference",
                                                          "Relative, of those that are equal"),
      column<&Row::smallest>("smallest", "null: no element limits the step"),
      column<&Row::s, &ComparedSteps::smallest_id>("smallest_id"),
      column<&Row::different>("different")};
  static const Record<Row> record{"steps", "", columns};
  return record;
}

Rows<MessageRow> messages(const ListingDocument& r) {
  return {[&r](const auto& add) {
    for (const MessageGroup& group : r.report.messages) add({&r, &group});
  }};
}
Rows<ContactOfListing> contacts(const ListingDocument& r) {
  return {[&r](const auto& add) {
    for (const ComparedContact& c : r.report.contacts)
      add({&r.loaded->scene().contacts[c.contact], &c});
  }};
}
Rows<StepsRow> steps(const ListingDocument& r) {
  return {[&r](const auto& add) {
    for (const ComparedSteps& s : r.report.steps) add({&s});
  }};
}
std::optional<DeckRow> deck_of(const ListingDocument& r) {
  if (r.loaded == nullptr) return std::nullopt;
  const LoadedDeck& d = *r.loaded;
  return DeckRow{d.path(), &d.deck(), &d.model(), &d.interfaces()};
}

const Record<ListingDocument>& record_of(const ListingDocument*) {
  using Row = ListingDocument;
  static constexpr Column<Row> columns[] = {
      column<Row>("listing", "", [](const Row& r) { return ListingRow{&r.listing}; }),
      column<deck_of>("deck", "null: none is beside the listing"),
      column<Row>("agrees", "Penetrations and time steps are those of deck",
                  [](const Row& r) { return r.report.agrees(); }),
      column<messages>("messages"),
      column<contacts>("contacts"),
      column<Row>("contacts_of_listing_only", "Contacts that the deck does not have",
                  [](const Row& r) { return r.report.unnamed_contacts; }),
      column<steps>("steps"),
      column<Row>("not_listed",
                  "Findings about a message of the solver that the listing does not have",
                  [](const Row& r) { return findings(&r, r.report.not_listed); })};
  static const Record<Row> record{"document", "", columns};
  return record;
}

constexpr DocumentHead head{"deck/explain", 1,
                            "Written by deck explain NAME_0000.out --json: a listing of the "
                            "Starter beside its deck.",
                            false};

}  // namespace

const Record<StepDifference>& record_of(const StepDifference*) {
  using Row = StepDifference;
  static constexpr Column<Row> columns[] = {
      column<&Row::id>("id"),
      column<Row>("listed", "", [](const Row& r) { return finite_step(r.listed); }),
      column<Row>("computed", "", [](const Row& r) { return finite_step(r.computed); })};
  static const Record<Row> record{"step_difference", "", columns, true};
  return record;
}

DocumentSchema explain_schema() { return document_schema<ListingDocument>(head); }

std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded) {
  return write_document(head, ListingDocument{listing, report, loaded});
}

}  // namespace deck
