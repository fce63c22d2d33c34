// The text of an extraction, and the check that it still is the same contact.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "deck/contact/scene.hpp"
#include "deck/edit/convert.hpp"
#include "deck/text/number.hpp"
#include "edit/convert/extract_state.hpp"
#include "edit/convert/units/unit_system_state.hpp"

namespace deck {
namespace {

using detail::Extraction;
using detail::ItemLines;

/// The text of an extraction as a deck, read as `whole` was.
Result<LoadedDeck> read_small(const LoadedDeck& whole, std::string text) {
  auto deck = read_deck_text(whole.deck().sources[0].path(), std::move(text), whole.schemas(),
                             whole.options().read);
  if (!deck) return deck.error();
  return LoadedDeck::from(std::move(*deck), whole.options());
}

/// A file without includes, cut down to what stays.
class Writer {
 public:
  Writer(const Deck& deck, const Model& model, const Extraction& kept)
      : deck_(deck), model_(model), kept_(kept), bytes_(deck.sources[0].bytes()) {}

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
  /// A line with its own line end, or the file's if it has none.
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
    for (const Piece& piece : b.body) copy(piece.begin, piece.end);
  }

  void bulk(const Block& b) {
    const auto family = detail::family_of_kind(b.schema->kind);
    bool open = false;
    ItemLines items(deck_, b);
    while (items.next()) {
      const std::uint32_t i =
          family ? model_.family(*family).map.find(items.id()) : model_.nodes.map.find(items.id());
      if (i == no_index) continue;
      const auto& list =
          family ? kept_.element_kept[static_cast<std::size_t>(*family)] : kept_.node_kept;
      if (list[i] == 0) continue;
      if (!open) copy(line_start(b.header_span.offset), line_end(b.header_span.offset));
      open = true;
      for (const Line& l : items.lines()) copy(l.offset, line_end(l.offset));
    }
  }

  const Deck& deck_;
  const Model& model_;
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

/// Names and effective values of an interface.
std::vector<std::pair<std::string, std::string>> values_of(const Interfaces& all, std::int64_t id) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const InterBase* inter : all.all)
    if (inter->id == id)
      for_each_field(*inter, [&](std::string_view name, const auto& field) {
        out.emplace_back(name, text_of(field.value));
      });
  return out;
}

std::vector<double> edge_numbers(const Model& model, const std::vector<ContactEdge>& edges) {
  std::vector<double> out;
  for (const ContactEdge& e : edges)
    for (const double v : {static_cast<double>(model.node_id(e.nodes[0])),
                           static_cast<double>(model.node_id(e.nodes[1])),
                           static_cast<double>(e.carrier), e.stiffness, e.gap, e.length})
      out.push_back(v);
  return out;
}

/// Everything about the sides of a contact as numbers, by what they are.
std::map<std::string, std::vector<double>> numbers_of(const Model& model, const Contact& c) {
  std::map<std::string, std::vector<double>> out;
  out["gap limits"] = {c.gapmin, c.gapmax, c.max_gap, c.shortest_side};
  for (const SecondaryNode& s : c.secondary)
    for (const double v : {static_cast<double>(model.node_id(s.node)), s.gap, s.length,
                           s.nodal_stiffness, s.multiplier})
      out["secondary nodes"].push_back(v);
  for (const MainSegment& m : c.main) {
    for (const NodeIndex n : m.nodes)
      out["main segments"].push_back(static_cast<double>(model.node_id(n)));
    for (const double v :
         {static_cast<double>(m.carrier), m.stiffness, m.gap, m.thickness, m.length})
      out["main segments"].push_back(v);
  }
  out["secondary edges"] = edge_numbers(model, c.secondary_edges);
  out["main edges"] = edge_numbers(model, c.main_edges);
  return out;
}

/// What becomes of the nodes of a tie.
std::map<std::string, std::vector<double>> numbers_of(const Model& model, const Tie& tie) {
  std::map<std::string, std::vector<double>> out;
  for (const auto& segment : tie.main)
    for (const NodeIndex n : segment)
      out["main segments"].push_back(static_cast<double>(model.node_id(n)));
  for (const TiedNode& n : tie.nodes) {
    const double segment = n.segment == no_index ? -1 : static_cast<double>(n.segment);
    for (const double v :
         {static_cast<double>(model.node_id(n.node)), segment, n.s, n.t, n.distance, n.search,
          static_cast<double>(n.message), static_cast<double>(n.tied)})
      out["tied nodes"].push_back(v);
    out["ties by penalty (other conditions on the nodes are not carried)"].push_back(
        static_cast<double>(n.penalty));
  }
  return out;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

void compare(const LoadedDeck& whole, const LoadedDeck& small, const std::vector<std::int64_t>& ids,
             Rewrite& out) {
  const auto differs = [&](std::int64_t id, std::string field, std::string before,
                           std::string after) {
    for (const InterBase* inter : whole.interfaces().all) {
      if (inter->id != id) continue;
      LossEntry entry = loss_entry(whole.deck(), Loss::approximated, *inter->block, inter->span);
      entry.field = std::move(field);
      entry.old_text = std::move(before);
      entry.new_text = std::move(after);
      entry.note = "differs in the small deck";
      out.losses.push_back(std::move(entry));
      return;
    }
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
  Diagnostics ignored;
  const Scene before = whole.scene_with(options, ignored);
  const Scene after = small.scene_with(options, ignored);
  for (std::size_t i = 0; i < before.ties.size() && i < after.ties.size(); ++i) {
    const auto a = numbers_of(whole.model(), before.ties[i]),
               b = numbers_of(small.model(), after.ties[i]);
    for (const auto& [what, numbers] : a)
      if (const auto it = b.find(what); it == b.end() || !same(numbers, it->second))
        differs(before.ties[i].inter->id, what, "", "");
  }
  for (std::size_t i = 0; i < before.contacts.size(); ++i) {
    const Contact& x = before.contacts[i];
    if (i >= after.contacts.size() || after.contacts[i].inter->id != x.inter->id) {
      differs(x.inter->id, to_string(x.role), "", "no such contact");
      continue;
    }
    const auto a = numbers_of(whole.model(), x), b = numbers_of(small.model(), after.contacts[i]);
    for (const auto& [what, numbers] : a) {
      const auto it = b.find(what);
      if (it == b.end() || !same(numbers, it->second))
        differs(x.inter->id, what + " (" + to_string(x.role) + ")", "", "");
    }
  }
}

/// True if a tie of the deck is not among the interfaces.
bool loses_ties(const LoadedDeck& c, const std::vector<std::int64_t>& ids) {
  const auto& ties = c.interfaces().type2;
  return std::any_of(ties.begin(), ties.end(), [&](const InterType2& tie) {
    return std::find(ids.begin(), ids.end(), tie.id) == ids.end();
  });
}

/// What the small deck cannot show.
void remarks(const LoadedDeck& c, const std::vector<std::int64_t>& ids, Rewrite& out) {
  std::int64_t mover = 0;
  for (const InterBase* inter : c.interfaces().ordered) {
    const bool wanted = std::find(ids.begin(), ids.end(), inter->id) != ids.end();
    const auto check = [&](const auto& list) {
      for (const auto& i : list) {
        if (&i != inter) continue;
        if (!wanted && i.Inacti.value == 3 && mover == 0) mover = i.id;
        if (!wanted) continue;
        if (mover != 0) {
          LossEntry entry = loss_entry(c.deck(), Loss::undecided, *inter->block, inter->span);
          entry.field = "Inacti";
          entry.note =
              "interface " + std::to_string(mover) +
              " comes first and moves nodes (Inacti 3); extract it too if they share nodes";
          out.losses.push_back(std::move(entry));
        }
      }
    };
    check(c.interfaces().type7);
    check(c.interfaces().type11);
    check(c.interfaces().type19);
    const auto tied = [&](const auto& list) {
      for (const auto& i : list)
        if (&i == inter && wanted && i.Irem_i2.value == 1 && loses_ties(c, ids)) {
          LossEntry entry = loss_entry(c.deck(), Loss::dropped, *inter->block, inter->span);
          entry.field = "Irem_i2";
          entry.note =
              "nodes tied by /INTER/TYPE2 are removed from this interface in the whole "
              "deck; extract these ties too where that matters";
          out.losses.push_back(std::move(entry));
        }
    };
    tied(c.interfaces().type7);
    tied(c.interfaces().type19);
    tied(c.interfaces().type24);
    tied(c.interfaces().type25);
  }
}

/// One entry for every keyword of which something was left out.
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
    out.losses.push_back(loss_entry(deck, Loss::dropped, *entry.first, entry.first->header_span));
    out.losses.back().note =
        std::to_string(entry.second) + " not needed by the interfaces (the first one is named)";
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
  std::string text = Writer(c.deck(), c.model(), kept).run(about);
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
  // Lines of the flat form mean nothing to anybody: name the block in its own file.
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
