// What a title or a file name may hold, and what of it reaches a terminal, a log and a parser; text
// measured, folded and cut for a terminal.
#include "base/shared/shown_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <random>
#include <sstream>

namespace deck {
namespace {

const std::vector<std::pair<const char*, std::function<std::string(std::string_view)>>> media = {
    {"terminal", terminal_text},
    {"lines", terminal_lines},
    {"columns", terminal_columns},
    {"xml", xml_text},
    {"html", html_text},
    {"workflow", workflow_text},
    {"property", workflow_property},
    {"json", [](std::string_view text) {
       std::string out;
       append_json_string(out, text);
       return out;
     }}};

/// True if all of it is UTF-8 and nothing in it is a control character but those allowed.
bool harmless(std::string_view text, std::string_view allowed) {
  for (std::size_t i = 0; i < text.size();) {
    const TextUnit unit = text_unit_at(text, i);
    const bool fine = unit.visible() || (unit.character && unit.code < 0x80 &&
                                         allowed.find(text[i]) != std::string_view::npos);
    if (!fine && !(unit.code == 0xfffd && unit.character)) return false;
    i += unit.length;
  }
  return true;
}

std::size_t units_of(std::string_view text) {
  std::size_t units = 0;
  for (std::size_t i = 0; i < text.size(); i += text_unit_at(text, i).length) ++units;
  return units;
}

TEST(Escape, LeavesNoControlCharacterInAnyMediumAndDropsNothing) {
  const auto expect_harmless = [](const std::string& text) {
    const std::size_t units = units_of(text);
    ASSERT_EQ(units_of(terminal_columns(text)), units) << "a column for each";
    for (const auto& [name, escape] : media) {
      ASSERT_GE(escape(text).size(), units) << name;
      const bool lines = std::string_view(name) == "lines" || std::string_view(name) == "html";
      ASSERT_TRUE(harmless(escape(text), lines ? "\n\t" : "")) << name << " " << text;
    }
  };
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b)
      expect_harmless({static_cast<char>(a), static_cast<char>(b), 'x'});
  std::mt19937 random(7);
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    // Half of the bytes are such that open or continue a character.
    for (int i = 0; i < 12; ++i)
      text += static_cast<char>(random() % 2 == 0 ? random() & 0xff : 0x80 | (random() & 0x7f));
    expect_harmless(text);
  }
}

TEST(Escape, AllCodePointsAreWellFormedOrSpelled) {
  for (std::uint32_t code = 0x80; code <= 0x10ffff; code += code < 0x3000 ? 1 : 7) {
    std::string text;
    if (code < 0x800) {
      text = {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 63))};
    } else if (code < 0x10000) {
      text = {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 63)),
              static_cast<char>(0x80 | (code & 63))};
    } else {
      text = {static_cast<char>(0xf0 | code >> 18), static_cast<char>(0x80 | (code >> 12 & 63)),
              static_cast<char>(0x80 | (code >> 6 & 63)), static_cast<char>(0x80 | (code & 63))};
    }
    const TextUnit unit = text_unit_at(text, 0);
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    ASSERT_EQ(unit.character, !surrogate) << code;
    if (surrogate) continue;
    ASSERT_EQ(unit.code, code);
    std::string json;
    append_json_string(json, text);
    ASSERT_EQ(nlohmann::json::parse(json).get<std::string>(), text) << "JSON keeps the value";
  }
}

TEST(Escape, OverlongAndImpossibleSequencesAreBytes) {
  for (const char* text :
       {"\xc0\xaf", "\xc1\xbf", "\xe0\x80\xaf", "\xf0\x80\x80\xaf", "\xf4\x90\x80\x80",
        "\xf8\x90\x80\x80", "\xfc\x84\x80\x80", "\xed\xa0\x80", "\xff", "\x80"})
    EXPECT_FALSE(text_unit_at(text, 0).character) << terminal_text(text);
  EXPECT_EQ(terminal_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  const std::string_view cut = std::string_view("\xC3\xA9").substr(0, 1);  // what lies behind
  EXPECT_FALSE(text_unit_at(cut, 0).character);
  EXPECT_EQ(text_unit_at(cut, 0).length, 1U);
}

TEST(Escape, TerminalSpellsEscapeSequencesAndDirectionControls) {
  EXPECT_EQ(terminal_text("a\x1b[2J\x07\r\nb\tc"), "a\\x1b[2J\\x07\\r\\nb\\tc");
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "31m"),
            "\\u{9b}31m")
      << "a C1 control opens a sequence too";
  EXPECT_EQ(terminal_text("user\xe2\x80\xae nimda"), "user\\u{202e} nimda");
  EXPECT_EQ(terminal_text("\xe2\x81\xa6x\xe2\x81\xa9"), "\\u{2066}x\\u{2069}");
  EXPECT_EQ(terminal_text("Tr\xc3\xa4ger \xe6\x9d\xbf"), "Tr\xc3\xa4ger \xe6\x9d\xbf");
  EXPECT_EQ(terminal_lines("a\n\tb\r\n"), "a\n\tb\\r\n");
  for (const char* mark : {"\xD8\x9C", "\xE2\x80\x8E", "\xE2\x80\x8F", "\xE2\x80\xAA",
                           "\xE2\x80\xAE", "\xE2\x81\xA6", "\xE2\x81\xA9"})
    EXPECT_EQ(terminal_text(mark).find(mark), std::string::npos) << terminal_text(mark);
}

TEST(Escape, NoTextBecomesACommandOfARunner) {
  for (const std::string text : {"##[error]x", "a ##vso[task]", "#", "##", "###["}) {
    std::string json;
    append_json_string(json, text);
    EXPECT_TRUE(json.find("##[") == json.npos && json.find("##vso[") == json.npos) << json;
    EXPECT_EQ(nlohmann::json::parse(json).get<std::string>(), text);
  }
  EXPECT_EQ(terminal_text("::error file=x::y"), "\\x3a:error file=x::y");
  EXPECT_EQ(terminal_text("  ::stop-commands::t"), "  \\x3a:stop-commands::t");
  EXPECT_EQ(terminal_lines("a\n::warning::b"), "a\n\\x3a:warning::b");
  EXPECT_EQ(terminal_text("std::string"), "std::string");
  EXPECT_EQ(terminal_text("a ##[error]x ##vso[task.setvariable]y"),
            "a #\\x23[error]x #\\x23vso[task.setvariable]y");
  EXPECT_EQ(workflow_text("50%\r\n::error::x"), "50%25%0D%0A::error::x");
  EXPECT_EQ(workflow_property("a:b,c\x1b"), "a%3Ab%2Cc\\x1b");
}

TEST(Escape, MarkupIsEscaped) {
  EXPECT_EQ(xml_text("<a b=\"c\">'&\n\t\x01"), "&lt;a b=&quot;c&quot;&gt;&#39;&amp;&#10;&#9;\\x01");
  EXPECT_EQ(html_text("<\n>"), "&lt;\n&gt;");
  EXPECT_EQ(xml_text("\xef\xbf\xbf\xef\xb7\x90"), "\\u{ffff}\\u{fdd0}") << "non-characters";
}

TEST(Escape, ColumnsOfACardStayColumns) {
  EXPECT_EQ(terminal_columns("a\tb\x1b\x7f"), "a b\xe2\x90\x9b\xe2\x90\xa1");
  EXPECT_EQ(terminal_columns("\xe4\xe2\x80\xae"), "\xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(terminal_columns("##[error]"), "#\xef\xbf\xbd[error]") << "a command of a runner";
}

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

TEST(DisplayWidth, CountsColumnsNotBytes) {
  EXPECT_EQ(display_width("Gapmin"), 6u);
  EXPECT_EQ(display_width("ünïcödé"), 7u);
  EXPECT_EQ(display_width("車体"), 4u);
  EXPECT_EQ(display_width("한글 가"), 7u);
  EXPECT_EQ(display_width("e\xcc\x81"), 1u) << "an accent stands over its letter";
  EXPECT_EQ(display_width("\xb5m"), 2u) << "a byte that is no UTF-8";
  EXPECT_EQ(display_width("\x1b[1;31merror\x1b[0m"), 5u) << "colours take no column";
}

TEST(CutTo, ShowsThatSomethingIsMissingAndNeverHalfACharacter) {
  EXPECT_EQ(cut_to("barrier", 7), "barrier");
  EXPECT_EQ(cut_to("barrier", 6), "barri…");
  EXPECT_EQ(cut_to("車体前部", 6), "車体…");
  EXPECT_EQ(cut_to("車体前部", 7), "車体前…");
}

TEST(Broken, LosesNothingButBlanks) {
  const std::string text =
      "samples/a_folder/with_names.rad:50:1 and more, even more: 車体前部の接触 end";
  for (std::size_t width = 2; width < 40; ++width) {
    std::string all;
    for (const std::string& piece : broken(text, width, width)) {
      EXPECT_LE(display_width(piece), width) << piece;
      all += piece;
    }
    EXPECT_EQ(without_blanks(all), without_blanks(text));
  }
}

TEST(Broken, BreaksBehindABlankElseBehindASignElseAnywhere) {
  using Pieces = std::vector<std::string>;
  EXPECT_EQ(broken("aaa bbbb", 6, 6), (Pieces{"aaa", "bbbb"}));
  for (const std::string sign : {",", "/", ":"})
    EXPECT_EQ(broken("abc" + sign + "defgh", 6, 6), (Pieces{"abc" + sign, "defgh"}));
  EXPECT_EQ(broken("ab c/defghi", 6, 9), (Pieces{"ab", "c/defghi"})) << "half of the line";
  EXPECT_EQ(broken("ab c/defghi", 7, 9), (Pieces{"ab c/", "defghi"})) << "less than half";
  EXPECT_EQ(broken("ab_cdefg", 5, 5), (Pieces{"ab_", "cdefg"}));
  EXPECT_EQ(broken("abcdefgh", 4, 4), (Pieces{"abcd", "efgh"}));
  EXPECT_EQ(broken("   abcdefgh", 6, 6), (Pieces{"   abc", "defgh"})) << "not behind an indent";
}

TEST(Folded, NoLineIsWiderAndShortOnesStayAsTheyAre) {
  const std::string text =
      "16 initial penetrations on 9 nodes, deepest 0.35 of a gap of 1.25\n"
      "    = help: " +
      std::string(90, 'x') + "\n  short\n\n\x1b[1mbold text that goes on and on and on\x1b[0m\n";
  for (const std::size_t width : {20u, 30u, 80u}) {
    const std::string out = folded(text, width);
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(display_width(line), width) << line;
    EXPECT_NE(out.find("\n  short\n\n"), std::string::npos);
    EXPECT_EQ(without_blanks(out), without_blanks(text));
  }
  EXPECT_EQ(folded(text, 0), text);
  EXPECT_EQ(folded("  interface 3 has no gap", 20), "  interface 3 has no\n    gap");
}

TEST(Wrapped, SetsWordsBehindAnIndent) {
  EXPECT_EQ(wrapped("one two  three", 2, 9), "  one two\n  three\n");
  EXPECT_EQ(wrapped("", 2, 9), "");
}

}  // namespace
}  // namespace deck
