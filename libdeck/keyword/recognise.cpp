// Recognizes files that are not Starter decks.
#include "keyword/shared/recognise.hpp"

#include <algorithm>
#include <array>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/number_scan.hpp"

namespace deck {
namespace {

constexpr std::size_t head_bytes = 4096;  // bytes searched

struct Magic {
  std::string_view bytes, what;
};
constexpr Magic magics[] = {
    {"\x1f\x8b", "gzip-compressed data that was packed twice; unpack it first (gunzip)"},
    {"BZh", "bzip2-compressed data; unpack it first (bunzip2)"},
    {"\xfd"
     "7zXZ",
     "xz-compressed data; unpack it first (unxz)"},
    {"\x28\xb5\x2f\xfd", "zstd-compressed data; unpack it first (unzstd)"},
    {"PK\x03\x04", "a ZIP archive; unpack it first (unzip)"},
    {"\x7f"
     "ELF",
     "a program"},
    {"%PDF", "a PDF document"},
    {"\x89PNG", "a picture (PNG)"},
};

/// The first line that is neither blank nor a comment in any of these formats.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const auto nl = std::min(text.find('\n'), text.size());
    const std::string_view line = detail::trim(text.substr(0, nl));
    text.remove_prefix(std::min(nl + 1, text.size()));
    if (!line.empty() && line[0] != '$' && line[0] != '#') return line;
  }
  return {};
}

bool mostly_binary(std::string_view head) {
  std::size_t odd = 0;
  for (std::size_t i = 0; i < head.size();) {
    const TextUnit unit = text_unit_at(head, i);
    // Latin-1 letters are text.
    odd += !unit.visible() && unit.code != '\n' && unit.code != '\r' && unit.code != '\t' &&
           (unit.character || unit.code < 0xa0);
    i += unit.length;
  }
  return odd * 20 > head.size();
}

bool has_block(const Deck& deck, std::string_view start) {
  return std::any_of(deck.blocks.begin(), deck.blocks.end(),
                     [&](const Block& b) { return detail::is_below(b.header, start); });
}

/// True if the deck has keywords of Engine files.
bool is_engine(const Deck& deck) {
  constexpr std::string_view keywords[] = {"/RUN",   "/TFILE", "/STOP",   "/ANIM/DT", "/RFILE",
                                           "/PRINT", "/DT",    "/H3D/DT", "/MON"};
  if (has_block(deck, "/RUN")) return true;
  const auto found = std::count_if(std::begin(keywords), std::end(keywords),
                                   [&](std::string_view k) { return has_block(deck, k); });
  return found >= 2;
}

std::string text_kind(const Deck& deck, std::string_view head) {
  const std::string small = in_lower_case(head.substr(0, 1024));
  const std::string_view line = first_line(head);
  const std::string shown = "'" + std::string(line.substr(0, 60)) + "'";
  if (small.find("<html") != std::string::npos || small.find("<!doctype html") != std::string::npos)
    return "an HTML page; was the deck downloaded as a web page?";
  if (line.starts_with("<?xml")) return "an XML document";
  if (line.starts_with("{")) return "a JSON document";
  if (small.find("#radioss engine") != std::string::npos || is_engine(deck))
    return "an Engine file (*_0001.rad); name the Starter deck (*_0000.rad)";
  if (line.size() > 1 && line[0] == '*' && ((line[1] | 0x20) >= 'a' && (line[1] | 0x20) <= 'z'))
    return "a deck of LS-DYNA or Abaqus (it begins with " + shown +
           "); OpenRadioss itself reads decks of LS-DYNA";
  if (const std::string first = in_lower_case(line);
      first.starts_with("begin bulk") || first.starts_with("cend") || first.starts_with("sol "))
    return "a deck of Nastran (it begins with " + shown + ")";
  if (!deck.blocks.empty() && small.find("\n/begin\n") != std::string::npos)
    return "a deck whose keywords are not in capitals: it has " +
           std::string(deck.blocks.front().header.substr(0, 60)) + "; write /BEGIN and so on";
  if (!deck.blocks.empty())
    return "a part of one: it has " + std::string(deck.blocks.front().header.substr(0, 60)) +
           ", but neither '#RADIOSS STARTER' nor /BEGIN; if it is an include file, name the deck "
           "that includes it";
  return "text without a keyword, beginning with " + shown;
}

}  // namespace

Result<void> detail::refuse_empty(const Source& source) {
  const std::string_view bytes = source.bytes();
  if (!std::all_of(bytes.begin(), bytes.end(), detail::is_blank)) return {};
  return Error{Error::Code::syntax, source.path() + ": is empty (" + std::to_string(bytes.size()) +
                                        " bytes, all blank); expected a Starter deck "
                                        "with /BEGIN … /END"};
}

Result<void> detail::refuse_binary(const Source& source) {
  const std::string_view head = source.bytes().substr(0, head_bytes);
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff"))
    return Error{Error::Code::syntax,
                 source.path() + ": is UTF-16 text; save it as UTF-8 or ASCII"};
  const auto nul = static_cast<std::size_t>(std::count(head.begin(), head.end(), '\0'));
  if (nul * 10 <= head.size()) return {};
  return Error{Error::Code::syntax, source.path() + ": is a binary file (" + std::to_string(nul) +
                                        " NUL bytes in the first " + std::to_string(head.size()) +
                                        "); expected the text of a Starter deck"};
}

std::string unread_version(const Deck& deck) {
  if (!deck.begin.version_unread) return {};
  const Finding& d = deck.findings.all().front();
  return deck.sources.where(d.span) + ": " + d.message +
         "; convert the deck to version 51 or later";
}

std::string no_starter_deck(const Deck& deck) {
  if (deck.begin.version_unread) return {};
  const std::string_view bytes = deck.sources[0].bytes();
  const std::string_view head = bytes.substr(0, head_bytes);
  const auto is = [](std::string_view what) {
    return "is no Starter deck but " + std::string(what);
  };
  for (const Magic& m : magics)
    if (head.starts_with(m.bytes)) return is(m.what);
  const auto end = bytes.find('\n');
  const bool one_line = end == std::string_view::npos || end + 1 == bytes.size();
  const bool begin = deck.begin.span.valid() || has_block(deck, "/BEGIN");
  const bool banner = head.find("#RADIOSS STARTER") != std::string_view::npos;
  const bool more = deck.sources.size() > 1 || !one_line;
  const bool keywords = std::any_of(deck.blocks.begin(), deck.blocks.end(),
                                    [](const Block& b) { return !b.header.starts_with("/END"); });
  if (more && (begin || (banner && keywords))) return {};
  if (mostly_binary(head)) return is("binary data");
  if (one_line && std::count(head.begin(), head.end(), '\r') > 1)
    return "is one line only: its lines end with carriage returns without line feeds; save it with "
           "line feeds";
  if (banner && !keywords)
    return "is not a Starter deck: there is no keyword after '#RADIOSS STARTER'";
  if (one_line) return is("a single line of text; expected /BEGIN ... /END");
  return is(text_kind(deck, head));
}

}  // namespace deck
