// Escapes text for terminal, XML, CSV, JSON and CI logs.
#include "base/shared/shown_text.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <iterator>
#include <utility>

namespace deck {

TextUnit text_unit_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return {};
  const auto byte = [&](std::size_t k) -> std::uint32_t {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U;
  };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const std::size_t length = first >= 0xf8   ? 1
                             : first >= 0xf0 ? 4
                             : first >= 0xe0 ? 3
                             : first >= 0xc0 ? 2
                                             : 1;
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  std::uint32_t code = first & (0xffU >> (length + 1));
  bool good = length > 1;
  for (std::size_t k = 1; good && k < length; ++k) {
    good = (byte(k) & 0xc0U) == 0x80U;
    code = code << 6 | (byte(k) & 0x3fU);
  }
  good = good && code >= least[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
  if (!good) return {first, 1, false};
  return {code, length, true};
}

bool TextUnit::visible() const {
  if (!character || code < 0x20 || (code >= 0x7f && code < 0xa0)) return false;
  if (code < 0x61c) return true;
  const auto within = [&](std::uint32_t low, std::uint32_t high) {
    return code >= low && code <= high;
  };
  const bool direction =
      code == 0x61c || within(0x200e, 0x200f) || within(0x202a, 0x202e) || within(0x2066, 0x2069);
  const bool separator = within(0x2028, 0x2029);
  const bool unseen = code == 0x200b || within(0x2060, 0x2064) || within(0x206a, 0x206f) ||
                      code == 0xfeff || within(0xfff9, 0xfffb) || within(0xe0000, 0xe007f);
  const bool none = within(0xfdd0, 0xfdef) || (code & 0xfffeU) == 0xfffeU;
  return !direction && !separator && !unseen && !none;
}

namespace {

/// Writes a unit that must not be shown, as \n, \xNN or \u{...}.
void spell(std::string& out, const TextUnit& unit) {
  if (unit.code == '\n')
    out += "\\n";
  else if (unit.code == '\r')
    out += "\\r";
  else if (unit.code == '\t')
    out += "\\t";
  else if (!unit.character || unit.code < 0x80)
    fmt::format_to(std::back_inserter(out), "\\x{:02x}", unit.code);
  else
    fmt::format_to(std::back_inserter(out), "\\u{{{:x}}}", unit.code);
}

/// True at the second character of "##[" and "##vso[": CI runners obey these anywhere in a line.
bool starts_command(std::string_view text, std::size_t at) {
  if (text[at] != '#' || at == 0 || text[at - 1] != '#') return false;
  const std::string_view rest = text.substr(at + 1);
  return rest.starts_with('[') || rest.starts_with("vso[");
}

/// Calls show(bytes) for visible text and spells out the rest, except for text that `special`
/// handles.
template <class Special>
std::string escaped(std::string_view text, const Special& special) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const TextUnit unit = text_unit_at(text, i);
    if (!special(out, unit, i)) {
      if (unit.code == '#' && starts_command(text, i))
        out += "\\x23";
      else if (unit.visible())
        out += text.substr(i, unit.length);
      else
        spell(out, unit);
    }
    i += unit.length;
  }
  return out;
}

/// A line that starts with "::" is a workflow command; its first colon is spelled out.
bool opens_command(std::string_view text, std::size_t at) {
  if (!text.substr(at).starts_with("::")) return false;
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  return at == 0 || text[at - 1] == '\n';
}

/// `kept`: control characters that are not spelled out.
std::string for_terminal(std::string_view text, std::string_view kept) {
  return escaped(text, [&](std::string& out, const TextUnit& unit, std::size_t at) {
    const bool command = unit.code == ':' && opens_command(text, at);
    if (!command && kept.find(text[at]) == kept.npos) return false;
    out += command ? std::string_view("\\x3a") : text.substr(at, 1);
    return true;
  });
}

/// Characters and their replacements in a medium.
using Replacements = std::initializer_list<std::pair<char, std::string_view>>;
std::string replaced(std::string_view text, Replacements replacements) {
  return escaped(text, [&](std::string& out, const TextUnit& unit, std::size_t) {
    if (unit.code >= 0x80) return false;
    for (const auto& [character, replacement] : replacements)
      if (unit.code == static_cast<unsigned char>(character)) {
        out += replacement;
        return true;
      }
    return false;
  });
}

std::string markup_text(std::string_view text, std::string_view line_feed) {
  return replaced(text, {{'&', "&amp;"},
                         {'<', "&lt;"},
                         {'>', "&gt;"},
                         {'"', "&quot;"},
                         {'\'', "&#39;"},
                         {'\t', "&#9;"},
                         {'\n', line_feed}});
}

}  // namespace

std::string terminal_text(std::string_view text) { return for_terminal(text, ""); }

std::string terminal_lines(std::string_view text) { return for_terminal(text, "\n\t"); }

std::string terminal_columns(std::string_view text) {
  return escaped(text, [&](std::string& out, const TextUnit& unit, std::size_t at) {
    const bool command = unit.code == '#' && starts_command(text, at);
    if (unit.visible() && !command) return false;
    if (unit.code == '\t') {
      out += ' ';
    } else if (unit.character && unit.code <= 0x7f && !command) {
      out += "\xe2\x90";  // U+2400 and following
      out += static_cast<char>(0x80U + (unit.code == 0x7f ? 0x21U : unit.code));
    } else {
      out += "\xef\xbf\xbd";  // U+FFFD
    }
    return true;
  });
}

std::string xml_text(std::string_view text) { return markup_text(text, "&#10;"); }

std::string html_text(std::string_view text) { return markup_text(text, "\n"); }

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string workflow_text(std::string_view text) {
  return replaced(text, {{'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}});
}

std::string workflow_property(std::string_view text) {
  return replaced(text, {{'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}, {':', "%3A"}, {',', "%2C"}});
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  const auto number = [&](std::uint32_t code) {
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", code);
  };
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0x20 && c < 0x7f && c != '"' && c != '\\' && c != '#') {  // most characters
      out += static_cast<char>(c);
      ++i;
      continue;
    }
    const TextUnit unit = text_unit_at(text, i);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else if (c == '#' && starts_command(text, i)) {
      number(c);
    } else if (unit.visible()) {
      out += text.substr(i, unit.length);
    } else if (!unit.character && c >= 0xa0) {  // Latin-1
      out += static_cast<char>(0xc0 | (c >> 6));
      out += static_cast<char>(0x80 | (c & 0x3f));
    } else if (unit.code > 0xffff) {
      const std::uint32_t rest = unit.code - 0x10000;
      number(0xd800 + (rest >> 10));
      number(0xdc00 + (rest & 0x3ffU));
    } else {
      number(unit.code);
    }
    i += unit.length;
  }
  out += '"';
}

}  // namespace deck
