// The document of a listing of the Starter beside its deck.
#include <cmath>

#include "report/parts_rows.hpp"
#include "report/shared/json.hpp"
#include "report/shared/listing.hpp"

namespace deck {
namespace listing_document {
namespace {

template <class List>
void numbers(JsonWriter& json, const char* name, const List& list) {
  json.key(name).begin_array(true);
  for (const auto n : list) json.value(n);
  json.end_array();
}

/// Ids behind one another, without zeros.
template <std::size_t N>
void ids(JsonWriter& json, const char* name, const std::array<std::int64_t, N>& list) {
  json.key(name).begin_array(true);
  for (const std::int64_t n : list)
    if (n != 0) json.value(n);
  json.end_array();
}

void optional_number(JsonWriter& json, const char* name, const std::optional<double>& v) {
  json.key(name);
  if (v)
    json.value(*v);
  else
    json.null();
}

void count_or_null(JsonWriter& json, const char* name, const std::optional<std::uint64_t>& v) {
  json.key(name);
  if (v)
    json.value(*v);
  else
    json.null();
}

class Document {
 public:
  Document(const Listing& listing, const ListingReport& report, const LoadedDeck* loaded,
           std::string& out)
      : listing_(listing), report_(report), loaded_(loaded), json_(out) {}

  void write() {
    json_.begin_object();
    write_json_head(json_, "deck/explain", 1);
    json_.key("listing").begin_object(true).field("path", listing_.path);
    json_.field("printout", listing_.printout);
    count_or_null(json_, "errors", listing_.errors);
    count_or_null(json_, "warnings", listing_.warnings);
    json_.end_object();
    if (loaded_ != nullptr)
      write_json_deck(json_, loaded_->path(), loaded_->deck(), &loaded_->model(),
                      &loaded_->interfaces());
    else
      json_.key("deck").null();
    json_.field("agrees", report_.agrees());
    json_.key("messages").begin_array();
    for (const MessageGroup& group : report_.messages) message(group);
    json_.end_array();
    json_.key("contacts").begin_array();
    for (const ComparedContact& c : report_.contacts) contact(c);
    json_.end_array();
    json_.field("contacts_of_listing_only", report_.unnamed_contacts);
    json_.key("steps").begin_array();
    for (const ComparedSteps& s : report_.steps) steps(s);
    json_.end_array();
    findings("not_listed", report_.not_listed);
    json_.end_object();
  }

 private:
  void message(const MessageGroup& group) {
    json_.begin_object()
        .field("message", group.number)
        .field("severity", to_string(group.severity));
    json_.field("times", group.times).field("title", group.title).field("means", group.means);
    json_.field("do", group.action).key("places").begin_array();
    for (const MessagePlace& place : group.places) {
      json_.begin_object()
          .field("name", place.name)
          .field("id", place.id)
          .field("times", place.times);
      numbers(json_, "says", place.counted);
      this->place(place.span);
      numbers(json_, "nodes", place.nodes);
      numbers(json_, "lines", place.lines);
      findings("findings", place.findings);
      json_.end_object();
    }
    json_.end_array();
    findings("findings", group.findings);
    json_.end_object();
  }

  void place(const Span& span) {
    json_.key("place");
    if (loaded_ != nullptr)
      write_json_place(json_, loaded_->deck(), span);
    else
      json_.null();
  }

  void findings(const char* name, const std::vector<std::size_t>& list) {
    json_.key(name).begin_array();
    for (const std::size_t f : list) {
      const Diagnostic& d = report_.findings[f];
      json_.begin_object(true)
          .field("rule", id_text(d.rule))
          .field("severity", to_string(d.severity));
      json_.field("message", d.message);
      json_.key("reference").begin_object(true).field("message", d.reference->number);
      json_.field("severity", to_string(d.reference->severity)).end_object();
      place(d.span);
      json_.end_object();
    }
    json_.end_array();
  }

  void contact(const ComparedContact& c) {
    const Contact& contact = loaded_->scene().contacts[c.contact];
    json_.begin_object().field("interface", contact.inter->id).field("type", contact.inter->type);
    json_.field("role", to_string(contact.role)).field("agrees", c.agrees());
    json_.key("listed");
    if (c.listed != nullptr)
      json_.value(c.listed_count);
    else
      json_.null();
    json_.field("computed", c.pairs.size()).field("by_pair", c.by_pair);
    json_.field("largest_difference", c.largest_difference);
    json_.key("lines").begin_array(true);
    if (c.listed != nullptr) {
      json_.value(c.listed->line);
      if (c.listed->total_line != 0) json_.value(c.listed->total_line);
    }
    json_.end_array().key("pairs").begin_array();
    for (const ComparedPair& p : c.pairs) {
      const PenetrationRow& row = contact.penetrations[p.pair.row];
      json_.begin_object(true);
      ids(json_, "secondary", p.pair.secondary);
      ids(json_, "main", p.pair.main);
      json_.key("parts").begin_array(true).value(p.pair.secondary_element.part);
      json_.value(p.pair.main_element.part).end_array();
      json_.field("penetration", row.depth).field("gap", row.gap);
      json_.field("action", to_string(row.action)).key("listed");
      if (c.by_pair)
        json_.value(p.listed);
      else
        json_.null();
      optional_number(json_, "listed_penetration", p.listed_depth);
      json_.end_object();
    }
    json_.end_array().key("listed_only").begin_array();
    for (const ListedPair& p : c.only_listed) {
      json_.begin_object(true);
      ids(json_, "secondary", p.secondary);
      ids(json_, "main", p.main);
      optional_number(json_, "listed_penetration", p.depth);
      json_.end_object();
    }
    json_.end_array().end_object();
  }

  void steps(const ComparedSteps& s) {
    const auto step = [&](const char* name, double dt) {
      json_.key(name);
      if (std::isnan(dt) || dt >= 1e29)
        json_.null();
      else
        json_.value(dt);
    };
    json_.begin_object().field("of", s.kind ? detail::kind_name(*s.kind) : "node");
    json_.field("listed", s.listed).field("equal", s.equal);
    json_.field("not_computed", s.not_computed).field("largest_difference", s.largest_difference);
    step("smallest", s.smallest);
    json_.field("smallest_id", s.smallest_id).key("different").begin_array();
    for (const StepDifference& d : s.different) {
      json_.begin_object(true).field("id", d.id);
      step("listed", d.listed);
      step("computed", d.computed);
      json_.end_object();
    }
    json_.end_array().end_object();
  }

  const Listing& listing_;
  const ListingReport& report_;
  const LoadedDeck* loaded_;
  JsonWriter json_;
};

}  // namespace
}  // namespace listing_document

std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded) {
  std::string out;
  listing_document::Document(listing, report, loaded, out).write();
  return out;
}

}  // namespace deck
