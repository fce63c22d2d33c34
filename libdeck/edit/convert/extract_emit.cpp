// Writes the text of an extraction and verifies that its contacts are unchanged.
#include <algorithm>
#include <cmath>
#include <map>

#include "deck/contacts.hpp"
#include "deck/edit.hpp"
#include "deck/text.hpp"
#include "edit/convert/extract.hpp"

namespace deck {
namespace {

using detail::Extraction;
using detail::ItemLines;

Result<LoadedDeck> read_small(const LoadedDeck& whole, std::string text) {
  auto deck = read_deck_text(whole.deck().sources[0].path(), std::move(text), whole.schemas(),
                             whole.options().read);
  if (!deck) return deck.error();
  return LoadedDeck::from(std::move(*deck), whole.options());
}

/// Writes a file without includes, reduced to kept content.
class ExtractWriter {
 public:
  ExtractWriter(const Deck& deck, const Extraction& kept)
      : deck_(deck), kept_(kept), bytes_(deck.sources[0].bytes()) {}

  std::string run(const std::string& about) {
    const auto nl = bytes_.find('\n');
    end_ = nl != std::string_view::npos && nl > 0 && bytes_[nl - 1] == '\r' ? "\r\n" : "\n";
    if (bytes_.starts_with("#RADIOSS STARTER")) line(bytes_.substr(0, nl));
    out_.append("# ").append(about).append(end_);
    for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
      const Block& b = deck_.blocks[i];
      if (b.schema != nullptr && b.schema->bulk)
        bulk(b);
      else if (kept_.block_kept[i] != 0)
        whole(b);
    }
    out_.append("/END").append(end_);
    return std::move(out_);
  }

 private:
  std::uint64_t line_start(std::uint64_t offset) const {
    const auto nl = offset == 0 ? std::string_view::npos : bytes_.rfind('\n', offset - 1);
    return nl == std::string_view::npos ? 0 : nl + 1;
  }
  std::uint64_t line_end(std::uint64_t offset) const {
    return std::min<std::uint64_t>(bytes_.find('\n', offset), bytes_.size() - 1) + 1;
  }
  /// A line with its own line end, or the file's.
  void line(std::string_view text) {
    while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
    out_.append(text).append(end_);
  }
  void copy(std::uint64_t begin, std::uint64_t end) {
    out_.append(bytes_.substr(begin, end - begin));
    if (!out_.ends_with('\n')) out_.append(end_);
  }

  void whole(const Block& b) {
    const std::uint64_t begin = line_start(b.header_span.offset);
    copy(begin, line_end(b.header_span.offset));
    for (const FilePiece& piece : b.body) copy(piece.begin, piece.end);
  }

  void bulk(const Block& b) {
    bool open = false;
    for (ItemLines items(deck_, b); items.next();) {
      if (!kept_.keeps(b, items)) continue;
      if (!open) copy(line_start(b.header_span.offset), line_end(b.header_span.offset));
      open = true;
      for (const Line& l : items.lines()) copy(l.offset, line_end(l.offset));
    }
  }

  const Deck& deck_;
  const Extraction& kept_;
  std::string_view bytes_;
  std::string_view end_ = "\n";
  std::string out_;
};

// ---- the check ----------------------------------------------------------------------------------

std::string text_of(double v) {
  const auto text = format_real(v, 24);
  return text ? text->text : std::string("not a number");
}
std::string text_of(std::int64_t v) { return std::to_string(v); }
std::string text_of(const std::string& v) { return v; }

std::vector<std::pair<std::string, std::string>> values_of(const Interfaces& all, std::int64_t id) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const InterBase* inter : all.all)
    if (inter->id == id)
      for_each_field(*inter, [&](std::string_view name, const auto& field) {
        out.emplace_back(name, text_of(field.value));
      });
  return out;
}

/// Numbers to compare of the contacts and ties of a deck, by interface and meaning.
class SceneNumbers {
 public:
  using Numbers = std::map<std::pair<std::int64_t, std::string>, std::vector<double>>;

  SceneNumbers(const LoadedDeck& deck, const SceneOptions& options) : model_(deck.model()) {
    Findings ignored;
    const Scene scene = deck.scene_with(options, ignored);
    for (const Tie& tie : scene.ties) add(tie);
    for (const Contact& contact : scene.contacts) add(contact);
  }
  const Numbers& all() const { return all_; }

 private:
  void add(const Contact& c) {
    const auto put = [&](const char* what, std::initializer_list<double> values) {
      append(c.inter->id, std::string(what) + " (" + to_string(c.role) + ")", values);
    };
    const auto edges = [&](const char* what, const std::vector<ContactEdge>& list) {
      put(what, {});
      for (const ContactEdge& e : list)
        put(what, {id(e.nodes[0]), id(e.nodes[1]), number(e.carrier), e.stiffness, e.gap});
    };
    put("gap limits", {c.gapmin, c.gapmax, c.max_gap, c.shortest_side});
    for (const SecondaryNode& s : c.secondary)
      put("secondary nodes", {id(s.node), s.gap, s.multiplier});
    for (const MainSegment& m : c.main)
      put("main segments", {id(m.nodes[0]), id(m.nodes[1]), id(m.nodes[2]), id(m.nodes[3]),
                            number(m.carrier), m.stiffness, m.gap});
    edges("secondary edges", c.secondary_edges);
    edges("main edges", c.main_edges);
    for (const double length : c.secondary_length) put("secondary gap limits", {length});
    for (const double length : c.main_length) put("main gap limits", {length});
    for (const double k : c.nodal_stiffness) put("nodal stiffness", {k});
  }

  /// Results for the nodes of a tie.
  void add(const Tie& tie) {
    for (const auto& s : tie.main)
      append(tie.inter->id, "main segments", {id(s[0]), id(s[1]), id(s[2]), id(s[3])});
    for (const TiedNode& n : tie.nodes) {
      const double segment = n.segment == no_index ? -1 : number(n.segment);
      append(
          tie.inter->id, "tied nodes",
          {id(n.node), segment, n.s, n.t, n.distance, n.search, number(n.message), number(n.tied)});
      append(tie.inter->id, "ties by penalty (other conditions on the nodes are not carried)",
             {number(n.penalty)});
    }
  }

  static double number(auto value) { return static_cast<double>(value); }
  double id(NodeIndex n) const { return number(model_.node_id(n)); }
  void append(std::int64_t interface_id, const std::string& what,
              std::initializer_list<double> values) {
    std::vector<double>& list = all_[{interface_id, what}];
    list.insert(list.end(), values);
  }

  const Model& model_;
  Numbers all_;
};

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

void compare(const LoadedDeck& whole, const LoadedDeck& small, const std::vector<std::int64_t>& ids,
             Rewrite& out) {
  const auto differs = [&](std::int64_t id, std::string field, std::string before,
                           std::string after) {
    const auto& all = whole.interfaces().all;
    const auto inter =
        std::find_if(all.begin(), all.end(), [&](const InterBase* i) { return i->id == id; });
    if (inter != all.end())
      out.losses.push_back(loss_entry(
          whole.deck(), Loss::approximated, *(*inter)->block, (*inter)->span,
          {std::move(field), std::move(before), std::move(after), "differs in the small deck"}));
  };
  for (const std::int64_t id : ids) {
    const auto a = values_of(whole.interfaces(), id), b = values_of(small.interfaces(), id);
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
      if (a[i].second != b[i].second) differs(id, a[i].first, a[i].second, b[i].second);
    if (a.size() != b.size()) differs(id, "", "", "the interface is not read");
  }
  SceneOptions options = whole.scene_options();
  options.only = ids;
  options.penetrations = options.candidates = false;
  options.ties = true;
  const SceneNumbers before(whole, options), after(small, options);
  for (const auto& [what, numbers] : before.all())
    if (const auto it = after.all().find(what);
        it == after.all().end() || !same(numbers, it->second))
      differs(what.first, what.second, "", "");
}

/// True if a tie of the deck is not among `ids`.
bool loses_ties(const LoadedDeck& c, const std::vector<std::int64_t>& ids) {
  const auto& ties = c.interfaces().type2;
  return std::any_of(ties.begin(), ties.end(), [&](const InterType2& tie) {
    return std::find(ids.begin(), ids.end(), tie.id) == ids.end();
  });
}

/// Notes effects that the small deck cannot show.
void remarks(const LoadedDeck& c, const std::vector<std::int64_t>& ids, Rewrite& out) {
  std::int64_t mover = 0;
  for (const InterBase* inter : c.interfaces().ordered) {
    const bool wanted = std::find(ids.begin(), ids.end(), inter->id) != ids.end();
    const bool may_move = inter->type == 7 || inter->type == 11 || inter->type == 19;
    const auto remark = [&](Loss loss, const char* field, std::string note) {
      out.losses.push_back(loss_entry(c.deck(), loss, *inter->block, inter->span,
                                      {.field = field, .note = std::move(note)}));
    };
    visit_interface(*inter, [&](const auto& i) {
      if (may_move && !wanted && i.Inacti.value == 3 && mover == 0) mover = i.id;
      if (may_move && wanted && mover != 0)
        remark(Loss::undecided, "Inacti",
               "interface " + std::to_string(mover) +
                   " comes first and moves nodes (Inacti 3); extract it too if they share nodes");
      if constexpr (requires { i.Irem_i2; })
        if (wanted && i.Irem_i2.value == 1 && loses_ties(c, ids))
          remark(Loss::dropped, "Irem_i2",
                 "nodes tied by /INTER/TYPE2 are removed from this interface in the whole deck; "
                 "extract these ties too where that matters");
    });
  }
}

/// One entry per keyword with dropped blocks.
void report_dropped(const Deck& deck, const Extraction& kept, const Model& model, Rewrite& out) {
  std::map<std::string, std::pair<const Block*, std::size_t>> dropped;
  std::size_t nodes = 0, elements = 0;
  for (const std::uint8_t v : kept.node_kept) nodes += v;
  std::size_t all_elements = 0;
  for (const auto& list : kept.element_kept) {
    all_elements += list.size();
    for (const std::uint8_t v : list) elements += v;
  }
  for (std::size_t i = 0; i < deck.blocks.size(); ++i) {
    const Block& b = deck.blocks[i];
    if (kept.block_kept[i] != 0 || (b.schema != nullptr && b.schema->bulk)) continue;
    auto& entry = dropped[std::string(b.keyword)];
    if (entry.second++ == 0) entry.first = &b;
  }
  for (const auto& [keyword, entry] : dropped) {
    out.losses.push_back(loss_entry(
        deck, Loss::dropped, *entry.first, entry.first->header_span,
        {.note = std::to_string(entry.second) + " not needed by the interfaces (the first one is "
                                                "named)"}));
  }
  out.notes.push_back(std::to_string(nodes) + " of " + std::to_string(model.nodes.size()) +
                      " nodes and " + std::to_string(elements) + " of " +
                      std::to_string(all_elements) + " elements are needed");
  for (const std::string& question : kept.open_questions) out.notes.push_back(question);
}

Rewrite extract_flat(const LoadedDeck& c, const std::vector<std::int64_t>& ids) {
  Rewrite out;
  Extraction kept(c, ids);
  kept.run();
  std::string about = "contact interfaces";
  for (const std::int64_t id : ids) about += " " + std::to_string(id);
  about += " of " + c.deck().sources[0].path() + " and what they need";
  std::erase_if(about, [](char ch) { return static_cast<unsigned char>(ch) < ' '; });
  std::string text = ExtractWriter(c.deck(), kept).run(about);
  const auto small = read_small(c, text);
  if (!small) {
    out.refusals.push_back(small.error().message);
    return out;
  }
  remarks(c, ids, out);
  report_dropped(c.deck(), kept, c.model(), out);
  compare(c, *small, ids, out);
  out.new_text = std::move(text);
  return out;
}

}  // namespace

Rewrite extract_contacts(const LoadedDeck& context, std::span<const std::int64_t> interfaces) {
  Rewrite out;
  std::vector<std::int64_t> ids(interfaces.begin(), interfaces.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  out.refusals = detail::unread_files(context.deck());
  for (const std::int64_t id : ids) {
    const auto& all = context.interfaces().all;
    if (std::any_of(all.begin(), all.end(), [&](const InterBase* i) { return i->id == id; }))
      continue;
    std::string have;
    for (std::size_t i = 0; i < all.size() && i < 20; ++i)
      have += (i == 0 ? "" : ", ") + std::to_string(all[i]->id);
    out.refusals.push_back(context.deck().sources[0].path() + ":1:1: no interface " +
                           std::to_string(id) +
                           " of type 2, 7, 10, 11, 19, 24 or 25; the deck has " +
                           (have.empty() ? "none" : have + (all.size() > 20 ? ", ..." : "")));
    out.bad_request = true;
  }
  if (ids.empty())
    out.refusals.push_back(context.deck().sources[0].path() + ":1:1: no interface was named");
  if (!out.refusals.empty()) return out;
  if (context.deck().includes.empty()) return extract_flat(context, ids);

  Rewrite flat = flatten(context, {.mark = false});
  if (!flat.refusals.empty()) return flat;
  const auto one = read_small(context, std::move(*flat.new_text));
  if (!one) {
    out.refusals.push_back(one.error().message);
    return out;
  }
  out = extract_flat(*one, ids);
  // Lines of the flat text are meaningless to users: name the block in its own file.
  for (LossEntry& entry : out.losses)
    for (const Block& b : context.deck().blocks)
      if (b.keyword == entry.keyword && b.id.value == entry.id) {
        const LossEntry place = loss_entry(context.deck(), entry.loss, b, b.header_span);
        entry.file = place.file;
        entry.line = place.line;
        break;
      }
  out.losses.insert(out.losses.begin(), flat.losses.begin(), flat.losses.end());
  return out;
}

}  // namespace deck
