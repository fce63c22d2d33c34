// Reads a listing of the Starter line by line: message blocks, work on contacts, tables of time
// steps.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "deck/text.hpp"
#include "inspect/shared/listing.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace listing_reading {
namespace {

using detail::trim;
using detail::words_of;

std::optional<std::int64_t> whole(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789-") != text.npos) return std::nullopt;
  const IntegerCell cell = read_integer(text);
  if (cell.status != NumberStatus::ok) return std::nullopt;
  return cell.value;
}

std::optional<double> real(std::string_view text) {
  const RealCell cell = read_real(text);
  if (text.empty() || cell.status != NumberStatus::ok) return std::nullopt;
  return cell.value;
}

std::optional<std::int64_t> leading_number(std::string_view text) {
  text = trim(text);
  return whole(text.substr(0, text.find_first_not_of("0123456789")));
}

/// All words as whole numbers; empty if one is not.
std::vector<std::int64_t> row_of_numbers(const std::vector<std::string_view>& words) {
  std::vector<std::int64_t> out;
  for (const std::string_view word : words) {
    const auto number = whole(word);
    if (!number) return {};
    out.push_back(*number);
  }
  return out;
}

/// "WARNING ID :    343"
std::optional<ListedMessage> message_head(std::string_view line) {
  static const std::map<std::string_view, Severity> kinds = {{"ERROR", Severity::error},
                                                             {"WARNING", Severity::warning},
                                                             {"MESSAGE", Severity::info},
                                                             {"INFO", Severity::info}};
  if (line.find(" ID") == line.npos) return std::nullopt;
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != 4 || words[1] != "ID" || words[2] != ":") return std::nullopt;
  const auto kind = kinds.find(words[0]);
  const auto number = whole(words[3]);
  if (kind == kinds.end() || !number || *number <= 0 || *number > 999999) return std::nullopt;
  return ListedMessage{static_cast<int>(*number), kind->second, 0, {}, {}, {}};
}

/// Messages printed during the work on a contact: they belong to its interface, which later parts
/// of a TYPE19 do not name.
constexpr int of_contact[] = {343, 499, 611, 612, 1164};

class ListingReader {
 public:
  explicit ListingReader(Listing& out) : out_(out) {}

  void line(std::string_view text) {
    ++number_;
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.remove_suffix(1);
    if (text.starts_with('|')) return;  // the summary at the end
    if (auto head = message_head(trim(text))) return begin_message(std::move(*head));
    if (in_message_ && message_text(text)) return;
    in_message_ = false;
    if (contact_line(text) || step_line(text)) return;
    setting(trim(text));
  }

  bool is_listing() const { return is_listing_; }
  bool of_engine() const { return of_engine_; }

 private:
  void begin_message(ListedMessage&& message) {
    is_listing_ = in_message_ = title_next_ = true;
    message.line = number_;
    out_.messages.push_back(std::move(message));
  }

  /// Reads a line of the open block; false if it does not belong to it.
  bool message_text(std::string_view text) {
    if (std::exchange(title_next_, false) && text.starts_with("**")) return true;
    if (text.starts_with("DESCRIPTION")) return true;
    if (!text.starts_with("   ")) return false;
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() >= 4 && !row_of_numbers(words).empty()) return false;  // a pair
    ListedMessage& m = out_.messages.back();
    if (words.size() == (m.number == 1164 ? 6 : m.number == 1631 ? 5 : 0)) penetration_row(words);
    described(m, trim(text));
    return true;
  }

  /// A row of the table of message 1164, or of 1631: two edges.
  void penetration_row(const std::vector<std::string_view>& words) {
    const std::vector<std::int64_t> ids = row_of_numbers({words.begin(), words.end() - 1});
    const auto depth = real(words.back());
    if (ids.empty() || !depth || out_.contacts.empty()) return;
    std::vector<ListedPair>& pairs = out_.contacts.back().pairs;
    if (ids.size() == 4)
      return pairs.push_back({{ids[0], ids[1]}, {ids[2], ids[3], 0, 0}, false, depth});
    if (pairs_of_.empty())
      for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs_of_[{pairs[i].secondary[0], pairs[i].main}].push_back(i);
    const std::array<std::int64_t, 4> main{ids[1], ids[2], ids[3], ids[4]};
    std::vector<std::size_t>& same = pairs_of_[{ids[0], main}];
    if (same.empty()) {  // a contact without listed candidates
      same.push_back(pairs.size());
      pairs.push_back({{ids[0], 0}, main, false, std::nullopt});
    }
    for (const std::size_t i : same) pairs[i].depth = depth;
  }

  /// Reads ids, nodes and numbers of a message line.
  void described(ListedMessage& m, std::string_view text) {
    if (text.starts_with("-- ")) text.remove_prefix(3);
    if (const auto colon = text.find(" TITLE:"); colon != text.npos && !m.ids.empty()) {
      if (m.ids.back().title.empty()) m.ids.back().title = trim(text.substr(colon + 7));
    } else if (text.starts_with("INTERFACE TYPE:") && !m.ids.empty()) {  // of 343: the title
      m.ids.back().title = trim(text.substr(15));
    }
    named_id(m, text);
    named_nodes(m, text);
    if (std::find(std::begin(of_contact), std::end(of_contact), m.number) != std::end(of_contact) &&
        !m.ids.empty() && !out_.contacts.empty() && out_.contacts.back().interface == 0)
      out_.contacts.back().interface = m.ids.front().id;
    if (m.count) return;
    for (const std::string_view lead : {"THERE ARE ", "CONCERNING ", ""})
      if (text.starts_with(lead))
        if (const auto n = leading_number(text.substr(lead.size())); n && *n >= 0) {
          m.count = static_cast<std::uint64_t>(*n);
          break;
        }
    if (m.count) total(m);
  }

  void named_id(ListedMessage& m, std::string_view text) {
    auto at = text.find(" ID");
    if (at == text.npos) return;
    std::string_view rest = text.substr(at + 3);
    rest.remove_prefix(std::min(rest.find_first_not_of(" :="), rest.size()));
    const auto id = leading_number(rest);
    const std::string_view kind = trim(text.substr(0, at));
    if (!id || kind.empty()) return;
    if (kind.ends_with("NODE")) {
      m.nodes.push_back(*id);
      return;
    }
    ListedId named{std::string(kind), *id, {}};
    if (const auto title = text.find("TITLE:"); title != text.npos)
      named.title = trim(text.substr(title + 6, text.find(',', title) - title - 6));
    m.ids.push_back(std::move(named));
  }

  /// "SECONDARY NODE: 105", "NODES 1 3 2 4", "SEGMENT: 1 1 3 4"
  static void named_nodes(ListedMessage& m, std::string_view text) {
    for (const std::string_view word : {"NODES ", "NODE:", "NODE ", "SEGMENT:"}) {
      const auto at = text.find(word);
      if (at == text.npos) continue;
      bool any = false;
      for (const std::string_view w : words_of(text.substr(at + word.size()))) {
        const auto id = whole(w);
        if (!id) break;
        if (std::find(m.nodes.begin(), m.nodes.end(), *id) == m.nodes.end()) m.nodes.push_back(*id);
        any = true;
      }
      if (any) return;
    }
  }

  /// Reads a message with a number for the present contact. 343 and 499 name it; a TYPE24 may have
  /// nothing else.
  void total(const ListedMessage& m) {
    const auto from_to = [&](int low, int high) { return m.number >= low && m.number <= high; };
    const bool edges = from_to(1632, 1634), nodes = from_to(1166, 1168) || from_to(1184, 1186);
    auto contact = out_.contacts.rbegin();
    if ((m.number == 343 || m.number == 499) && !m.ids.empty()) {
      const std::int64_t id = m.ids.front().id;
      const auto is_it = [&](const ListedContact& c) { return c.interface == id; };
      contact = std::find_if(contact, out_.contacts.rend(), is_it);
      if (contact == out_.contacts.rend()) begin_contact(id), contact = out_.contacts.rbegin();
    } else if ((!edges && !nodes) || out_.contacts.empty()) {
      return;
    }
    if (!edges && !nodes && contact->type == 25) return;
    (edges ? contact->edges : contact->total) = m.count;
    contact->total_line = m.line;
  }

  /// Reads a line of the work on a contact.
  bool contact_line(std::string_view text) {
    const std::string_view line = trim(text);
    if (line.starts_with("INTERFACE NUMBER.")) {
      if (const auto id = whole(words_of(line).back())) begin_contact(*id);
      return true;
    }
    if (line.starts_with("INTERFACE TYPE.") && !out_.contacts.empty()) {
      if (const auto type = whole(words_of(line).back()))
        out_.contacts.back().type = static_cast<int>(*type);
      return true;
    }
    if (line.starts_with("POSSIBLE IMPACT NUMBER")) {
      if (counted_) begin_contact(0);
      counted_ = true;
      return true;
    }
    if (line.starts_with("** INITIAL PENETRATION =")) {
      penetration_line(line);
      return true;
    }
    if (line.starts_with("IMPACT CANDIDATES")) {
      in_pairs_ = true;
      return true;
    }
    return in_pairs_ && pair_line(text);
  }

  /// A header occurs once per pass: at its second occurrence a new pass begins, whose contacts
  /// replace the old ones.
  void begin_contact(std::int64_t interface) {
    in_pairs_ = counted_ = false;
    pairs_of_.clear();
    if (interface != 0 &&
        std::any_of(out_.contacts.begin(), out_.contacts.end(), [&](const ListedContact& c) {
          return c.interface == interface && c.type != 0;
        }))
      out_.contacts.clear();
    ListedContact contact;
    contact.interface = interface;
    contact.line = number_;
    out_.contacts.push_back(std::move(contact));
  }

  /// Four or five ids, ten columns each.
  bool pair_line(std::string_view text) {
    const std::vector<std::string_view> words = words_of(text);
    if ((words.size() != 4 && words.size() != 5) || text.size() != 10 * words.size()) return false;
    const std::vector<std::int64_t> ids = row_of_numbers(words);
    if (ids.empty() || out_.contacts.empty()) return false;
    ListedPair pair;
    if (ids.size() == 5) {
      pair.secondary = {ids[0], 0};
      pair.main = {ids[1], ids[2], ids[3], ids[4]};
    } else {
      pair.secondary = {ids[0], ids[1]};
      pair.main = {ids[2], ids[3], 0, 0};
    }
    out_.contacts.back().pairs.push_back(pair);
    return true;
  }

  /// "** INITIAL PENETRATION = x IMPOSSIBLE ... NODE n", or of edges "... POSSIBLE NEW ...".
  void penetration_line(std::string_view line) {
    if (out_.contacts.empty()) return;
    std::vector<ListedPair>& pairs = out_.contacts.back().pairs;
    if (line.find("IMPOSSIBLE") == line.npos) {
      const std::vector<std::string_view> words = words_of(line);
      if (!pairs.empty() && words.size() > 4) pairs.back().depth = real(words[4]);
      return;
    }
    const auto node = whole(words_of(line).back());
    if (!node) return;
    if (pairs.empty() || pairs.back().secondary[0] != *node || pairs.back().on_segment)
      pairs.push_back({{*node, 0}, {}, true, std::nullopt});
    pairs.back().on_segment = true;
  }

  /// Tables of time steps.
  bool step_line(std::string_view text) {
    const std::string_view line = trim(text);
    if (line.ends_with("ELEMENTS TIME STEP")) {
      constexpr std::pair<std::string_view, ElementKind> kinds[] = {
          {"TRIANGULAR SHELL", ElementKind::shell3},
          {"SHELL", ElementKind::shell4},
          {"SOLID", ElementKind::solid8},
          {"QUAD", ElementKind::quad},
          {"TRUSS", ElementKind::truss},
          {"BEAM", ElementKind::beam},
          {"SPRING", ElementKind::spring}};
      steps_ = nullptr;
      for (const auto& [word, kind] : kinds)
        if (line.starts_with(word)) {
          steps_ = &out_.element_steps[kind];
          break;
        }
      return true;
    }
    if (line.starts_with("NODAL TIME STEP")) {
      steps_ = line.find("estimation") != line.npos ? &out_.node_steps : nullptr;
      return true;
    }
    if (steps_ == nullptr) return false;
    const std::vector<std::string_view> words = words_of(line);
    const auto dt = words.size() == 2 ? real(words[0]) : std::nullopt;
    const auto id = words.size() == 2 ? whole(words[1]) : std::nullopt;
    if (dt && id) {
      steps_->push_back({*id, *dt});
      return true;
    }
    const bool heading = line.empty() || line.starts_with('-') || line.starts_with("TIME STEP");
    if (!heading || (line.empty() && !steps_->empty())) steps_ = nullptr;
    return heading;
  }

  /// Reads a setting of the listing itself.
  void setting(std::string_view line) {
    if (line.starts_with("IPRI ") || line.starts_with("IPRI:")) {
      const auto words = words_of(line);
      if (const auto level = whole(words.back())) out_.printout = static_cast<int>(*level);
      is_listing_ = true;
    } else if (line.starts_with("NUMNOD:")) {
      if (const auto n = whole(words_of(line).back())) out_.nodes = static_cast<std::uint64_t>(*n);
    } else if (line.starts_with("CONTROL  PARAMETERS") ||
               line.starts_with("* INPUT READING PROCESS")) {
      is_listing_ = true;
    } else if (line.starts_with("CYCLE    TIME") || line.starts_with("NC=")) {
      of_engine_ = true;
    } else if (line.ends_with("ERROR(S)")) {
      if (const auto n = leading_number(line)) out_.errors = static_cast<std::uint64_t>(*n);
    } else if (line.ends_with("WARNING(S)")) {
      if (const auto n = leading_number(line)) out_.warnings = static_cast<std::uint64_t>(*n);
    }
  }

  Listing& out_;
  std::size_t number_ = 0;
  bool is_listing_ = false, of_engine_ = false;
  bool in_message_ = false, title_next_ = false;
  bool in_pairs_ = false;  ///< lines of numbers are pairs
  bool counted_ = false;   ///< the number of candidates is known: another one starts a new part
  /// Positions of the contact's pairs by node and segment, for message 1164.
  std::map<std::pair<std::int64_t, std::array<std::int64_t, 4>>, std::vector<std::size_t>>
      pairs_of_;
  std::vector<ListedStep>* steps_ = nullptr;
};

}  // namespace
}  // namespace listing_reading

namespace {

/// Advice for a file that is not a listing of the Starter.
std::string no_listing(const std::string& path, std::string_view text, bool of_engine) {
  if (of_engine)
    return path +
           " is a listing of the Engine; give the one of the Starter, which ends in _0000.out";
  if (text.find("\n/BEGIN") != text.npos || text.starts_with("/BEGIN") ||
      text.starts_with("#RADIOSS"))
    return path + " is a deck, no listing; 'deck lint " + path +
           "' looks at it, and 'deck explain' takes the listing that the Starter writes beside it "
           "(_0000.out)";
  return path +
         (text.empty() ? " is empty"
                       : " is no listing of the Starter: no message or interface of "
                         "one is in it") +
         "; the Starter writes it beside the deck, NAME_0000.out for NAME_0000.rad. Without one, "
         "'deck lint DECK' says what the Starter would";
}

}  // namespace

Result<Listing> read_listing_text(const std::string& path, std::string_view text) {
  Listing out;
  out.path = path;
  listing_reading::ListingReader reader(out);
  for (const std::string_view line : detail::parts_of(text, '\n')) reader.line(line);
  if (reader.is_listing()) return out;
  return Error{Error::Code::syntax, no_listing(path, text, reader.of_engine())};
}

Result<Listing> read_listing(const std::string& path, const Limits& limits) {
  const auto source = Source::open_text(path, limits);
  if (!source) return source.error();
  return read_listing_text(path, (*source)->bytes());
}

}  // namespace deck
