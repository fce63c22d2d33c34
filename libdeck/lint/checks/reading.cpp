// Pages of the rules that the keyword stage finds while reading. A table of text; it is long
// because every rule brings its page and two examples.
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

constexpr auto reading = RuleStage::reading;

void add_file_rules(std::vector<Rule>& out) {
  out.push_back(
      {.id = "DK001",
       .title = "no '#RADIOSS STARTER' banner",
       .severity = Severity::warning,
       .stage = reading,
       .problem = "The first line of the main file is not '#RADIOSS STARTER'.",
       .why = "The banner is how official builds tell a Starter deck from any other file.",
       .solver = "official builds stop at once; open-reader builds see a comment",
       .message = 100201,
       .message_severity = Severity::error,
       .fix = "put '#RADIOSS STARTER' in the first line, in front of it nothing, not even a byte "
              "order mark",
       .ignore = "The deck is only ever read by builds with the open reader.",
       .fixable = Fixable::safe,
       .bad = "@deck\n/BEGIN\nrun\n      2022         0\n"
              "                  kg                  mm                  ms\n/END\n",
       .good = "@bare\n"});
  out.push_back({.id = "DK002",
                 .title = "blocks before /BEGIN, or no /BEGIN",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "Keywords stand before /BEGIN, or there is no /BEGIN at all.",
                 .why = "The input version and the units come from /BEGIN; nothing can be read "
                        "without them.",
                 .solver = "everything before /BEGIN except /PARAMETER is ignored",
                 .fix = "start the deck with /BEGIN: run name, version, input and working units",
                 .ignore = "Never in a main file.",
                 .bad = "@deck\n#RADIOSS STARTER\n/TITLE\nnote\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK003",
                 .title = "unknown input version",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "The version in /BEGIN is none that the reference solver knows.",
                 .why = "Columns differ between versions; with an unknown one the newest layout is "
                        "taken, and fields land in other cells than meant.",
                 .solver = "open-reader builds take the newest layout, official builds refuse",
                 .message = 100202,
                 .message_severity = Severity::error,
                 .fix = "write the version the deck was made for in columns 1-10 of its line",
                 .ignore = "Never; write the version.",
                 .bad = "@bare\n@version 150\n",
                 .good = "@bare\n@version 2024\n"});
  out.push_back({.id = "DK004",
                 .title = "included file cannot be read",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A file named by #include is missing or unreadable.",
                 .why = "Everything in it is missing from the model, so most references fail too.",
                 .solver = "it stops, in some builds with 'error 760' and no file name",
                 .message = 100002,
                 .message_severity = Severity::error,
                 .fix = "correct the path, or name its folder with --include-path",
                 .ignore = "When the include is delivered separately and cannot be had.",
                 .bad = "@bare\n#include nowhere.inc\n",
                 .good = "@bare\n#include here.inc\n@file here.inc\n/TITLE\nnote\n"});
  out.push_back({.id = "DK005",
                 .title = "include cycle",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A file includes itself, directly or through others.",
                 .why = "Reading would never end.",
                 .solver = "it recurses until it fails",
                 .fix = "remove the directive",
                 .ignore = "Never.",
                 .bad = "@bare\n#include loop.inc\n@file loop.inc\n#include loop.inc\n",
                 .good = "@bare\n#include one.inc\n@file one.inc\n/TITLE\nnote\n"});
  out.push_back(
      {.id = "DK006",
       .title = "include tree beyond a limit",
       .severity = Severity::error,
       .stage = reading,
       .problem = "The include tree is deeper, larger or has more files than allowed.",
       .why = "The limits protect against includes that multiply themselves.",
       .solver = "it stops at about 10 levels of nesting",
       .fix = "flatten the include tree",
       .ignore = "Never; what lies behind the limit was not read.",
       .bad = "@bare\n@limit include_depth 1\n#include a.inc\n"
              "@file a.inc\n#include b.inc\n@file b.inc\n/TITLE\nnote\n",
       .good = "@bare\n#include a.inc\n@file a.inc\n#include b.inc\n@file b.inc\n/TITLE\nnote\n"});
  out.push_back({.id = "DK010",
                 .title = "no /END",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "The main file ends without /END.",
                 .why = "A deck that was cut off in transfer looks just like this.",
                 .solver = "it reads to the end of the file",
                 .message = 100215,
                 .message_severity = Severity::error,
                 .fix = "close the deck with /END",
                 .ignore = "When the deck is known to be complete.",
                 .fixable = Fixable::safe,
                 .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                        "                  kg                  mm                  ms\n",
                 .good = "@bare\n"});
  out.push_back(
      {.id = "DK011",
       .title = "text after /END",
       .severity = Severity::warning,
       .stage = reading,
       .problem = "Data stands behind /END of the main file.",
       .why = "It looks like part of the model and is none.",
       .solver = "it stops reading at /END",
       .fix = "move the lines above /END or delete them",
       .ignore = "When the tail is kept as a note on purpose; better make it comments.",
       .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
              "                  kg                  mm                  ms\n/END\n/TITLE\nnote\n",
       .good = "@bare\n"});
  out.push_back({.id = "DK015",
                 .title = "unknown unit code",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A unit is neither a prefix with g, m or s nor a positive number.",
                 .why = "Every value of the deck would be converted with a wrong factor.",
                 .solver = "it stops with an error; behind a number it drops the text, and for a "
                           "blank it takes the unit of the other system (warnings here)",
                 .message = 573,
                 .message_severity = Severity::error,
                 .fix = "write for example Mg, mm, s or kg, mm, ms",
                 .ignore = "Never.",
                 .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                        "               stone                  mm                  ms\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK016",
                 .title = "no unit system",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "/BEGIN names neither input nor working units.",
                 .why = "Values have no meaning without units.",
                 .solver = "it stops with an error; with /UNIT/LENGTH … of version 90 left in a "
                           "newer deck it may hang",
                 .message = 574,
                 .message_severity = Severity::error,
                 .fix = "add the two unit lines",
                 .ignore = "Never.",
                 .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK017",
                 .title = "input units differ from working units",
                 .severity = Severity::info,
                 .stage = reading,
                 .problem = "The deck is written in other units than it is computed in.",
                 .why = "Listings, results and limits typed elsewhere are in the working units.",
                 .solver = "it converts every value and warns",
                 .message = 754,
                 .fix = "nothing to do if this is meant",
                 .ignore = "When the conversion is meant.",
                 .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                        "                  kg                  mm                  ms\n"
                        "                  Mg                  mm                   s\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK018",
                 .title = "parameter is not defined",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "&name is used, and no parameter of that name is visible there.",
                 .why = "The value that was meant is replaced by 0.",
                 .solver = "it reports an error and reads 0",
                 .message = 100105,
                 .message_severity = Severity::error,
                 .fix = "define it with /PARAMETER in this file or globally",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Gapmin=&gap\n",
                 .good = "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                        0.5\n"
                         "@/INTER/TYPE7/1 Gapmin=&gap\n"});
  out.push_back({.id = "DK019",
                 .title = "parameter without a usable value",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "The definition of a parameter has no name, no value, or an expression "
                            "that cannot be evaluated.",
                 .why = "Every use of it becomes 0, or the number that the value begins with.",
                 .solver = "it goes on with 0, or with the leading number",
                 .fix = "name in columns 1-10, value or expression from column 11 on",
                 .ignore = "Never.",
                 .bad = "/PARAMETER/GLOBAL/REAL_EXPR/1\ngap\ngap       1.0 + * 2\n",
                 .good = "/PARAMETER/GLOBAL/REAL_EXPR/1\ngap\ngap       1.0 + 2\n"});
  out.push_back({.id = "DK033",
                 .title = "UTF-8 byte order mark",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "The file starts with the three bytes of a byte order mark.",
                 .why = "The first line is then not what it seems.",
                 .solver = "the bytes become part of the first line, the banner is not found",
                 .fix = "save the file without byte order mark",
                 .ignore = "Never.",
                 .fixable = Fixable::safe,
                 .bad = "@deck\n\xef\xbb\xbf#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                        "                  kg                  mm                  ms\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK035",
                 .title = "//SUBMODEL and //ENDSUB do not pair up",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A submodel is not closed, or //ENDSUB stands alone.",
                 .why = "The ids of everything behind it get the offsets of the submodel.",
                 .solver = "everything up to the end of the deck belongs to the submodel",
                 .fix = "close each //SUBMODEL with //ENDSUB",
                 .ignore = "Never.",
                 .bad = "//SUBMODEL/1\ndummy\n\n/TITLE\nnote\n",
                 .good = "//SUBMODEL/1\ndummy\n\n/TITLE\nnote\n//ENDSUB\n"});
}

void add_frame_rules(std::vector<Rule>& out) {
  out.push_back(
      {.id = "DK051",
       .title = "include: lines before its first keyword",
       .severity = Severity::warning,
       .stage = reading,
       .problem = "An included file begins with data instead of a keyword.",
       .why = "The lines do not continue the block of the including file: nodes, elements or list "
              "entries that seem to be in the model are not.",
       .solver = "it drops what stands before the first keyword of an included file",
       .fix = "repeat the keyword line (and title) at the top of the included file",
       .ignore = "When the lines are remarks; better make them comments.",
       .bad = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
              "                  kg                  mm                  ms\n/NODE\n"
              "         1                 0.0                 0.0                 0.0\n"
              "#include half.inc\n/END\n@file half.inc\n"
              "         2                 1.0                 0.0                 0.0\n",
       .good = "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
               "                  kg                  mm                  ms\n/NODE\n"
               "         1                 0.0                 0.0                 0.0\n"
               "#include half.inc\n/END\n@file half.inc\n/NODE\n"
               "         2                 1.0                 0.0                 0.0\n"});
  out.push_back({.id = "DK052",
                 .title = "blank before a slash of a keyword line",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A keyword line begins with a blank, or has one before a '/'.",
                 .why = "The line looks right and is read wrong.",
                 .solver = "it ends with 'error 760', or without a word",
                 .message = 760,
                 .message_severity = Severity::error,
                 .fix = "remove the blank",
                 .ignore = "Never.",
                 .fixable = Fixable::safe,
                 .bad = " /TITLE\nexample\n",
                 .good = "/TITLE\nexample\n"});
  out.push_back({.id = "DK054",
                 .title = "id in a header out of range",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "The id of a header is larger than 2147483647.",
                 .why = "Ids are 31-bit numbers: the entity gets another id, which nobody wrote.",
                 .solver = "it goes on with another number: an error here, because nobody can want "
                           "that",
                 .fix = "give the entity an id of at most 9 digits",
                 .ignore = "Never.",
                 .bad = "/SKEW/FIX/99999999999\naxes\n"
                        "                 0.0                 0.0                 0.0\n"
                        "                 1.0                 0.0                 0.0\n"
                        "                 0.0                 1.0                 0.0\n",
                 .good = "/SKEW/FIX/999\naxes\n"
                         "                 0.0                 0.0                 0.0\n"
                         "                 1.0                 0.0                 0.0\n"
                         "                 0.0                 1.0                 0.0\n"});
  out.push_back({.id = "DK055",
                 .title = "text that belongs to no keyword",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem =
                     "Text stands where no keyword is open: in front of the first one of the "
                     "main file, or behind the /END of an included file.",
                 .why = "It looks like part of the model and is none.",
                 .solver = "it skips everything up to the next keyword",
                 .fix = "add the keyword line, or turn the text into a comment",
                 .ignore = "Never.",
                 .bad = "@deck\n#RADIOSS STARTER\nnote\n/BEGIN\nrun\n      2022         0\n"
                        "                  kg                  mm                  ms\n/END\n",
                 .good = "@bare\n"});
  out.push_back({.id = "DK056",
                 .title = "parameter defined twice",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "Two parameters of one scope have the same name.",
                 .why = "Only one of the two values is used.",
                 .solver = "it keeps one of the two",
                 .fix = "remove one; here the first one is used",
                 .ignore = "When both have the same value.",
                 .bad = "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                        0.5\n"
                        "/PARAMETER/GLOBAL/REAL/2\ngap\ngap                        0.7\n",
                 .good = "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                        0.5\n"
                         "/PARAMETER/GLOBAL/REAL/2\nwide\nwide                       0.7\n"});
  out.push_back({.id = "DK057",
                 .title = "lines end with a carriage return alone",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "The file has carriage returns (CR) and no line feeds (LF).",
                 .why = "The whole file is one line.",
                 .solver = "it takes the whole file for one line",
                 .fix = "save the file with line feeds",
                 .ignore = "Never.",
                 .bad = "@deck\n#RADIOSS STARTER\r/BEGIN\rrun\r      2022         0\r/END\r",
                 .good = "@bare\n"});
  out.push_back({.id = "DK058",
                 .title = "include path with backslashes",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "The path of an #include separates its folders with a backslash.",
                 .why = "The deck can be read on one operating system only.",
                 .solver = "builds for Windows read the file, others stop: no such file",
                 .fix = "write the path with '/'",
                 .ignore = "When the deck never leaves Windows.",
                 .bad = "@bare\n#include .\\here.inc\n@file here.inc\n/TITLE\nnote\n",
                 .good = "@bare\n#include ./here.inc\n@file here.inc\n/TITLE\nnote\n"});
}

void add_cell_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK012",
                 .title = "text beyond column 100",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A data line is longer than 100 columns.",
                 .why = "Only 100 columns are read; values behind them are lost.",
                 .solver = "it drops the text silently (the closed reader warns)",
                 .message = 100213,
                 .fix = "shorten the line to 100 columns",
                 .ignore = "When the tail is a remark; better make it a comment line.",
                 .fixable = Fixable::unsafe,
                 .bad = "/TITLE\nexample\n/SKEW/FIX/1\naxes\n"
                        "                 0.0                 0.0                 0.0\n"
                        "                 1.0                 0.0                 0.0"
                        "                                             stray\n"
                        "                 0.0                 1.0                 0.0\n",
                 .good = "/SKEW/FIX/1\naxes\n"
                         "                 0.0                 0.0                 0.0\n"
                         "                 1.0                 0.0                 0.0\n"
                         "                 0.0                 1.0                 0.0\n"});
  out.push_back({.id = "DK013",
                 .title = "tab in fixed columns",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A data line contains a tab.",
                 .why =
                     "Editors show a tab as up to eight columns, the reference solver counts one: "
                     "the cells behind it are not where they seem to be.",
                 .solver = "a tab is one blank column",
                 .fix = "replace tabs by blanks and check the columns",
                 .ignore = "When the tab stands behind the last cell.",
                 .fixable = Fixable::safe,
                 .bad = "/GRNOD/NODE/7\nnodes\n         1\t2\n",
                 .good = "/GRNOD/NODE/7\nnodes\n         1         2\n"});
  out.push_back({.id = "DK014",
                 .title = "NUL byte in a data line",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A data line contains a NUL byte.",
                 .why = "It cuts the line off in most readers.",
                 .solver = "it ends the line there",
                 .fix = "remove the byte",
                 .ignore = "Never."});
  out.push_back({.id = "DK020",
                 .title = "no integer where one is expected",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "An integer cell holds text that does not start with a number.",
                 .why = "The flag or id becomes 0, which usually means a default.",
                 .solver = "it reports an error and reads 0",
                 .message = 100101,
                 .message_severity = Severity::error,
                 .fix = "write a whole number or leave the cell blank",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Istf=two\n",
                 .good = "@/INTER/TYPE7/1 Istf=2\n"});
  out.push_back({.id = "DK021",
                 .title = "no number where one is expected",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A real cell holds text that does not start with a number.",
                 .why = "The value becomes 0, which usually means a default.",
                 .solver = "it reports an error and reads 0",
                 .message = 100102,
                 .message_severity = Severity::error,
                 .fix = "write a number or leave the cell blank",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Gapmin=half\n",
                 .good = "@/INTER/TYPE7/1 Gapmin=0.5\n"});
  out.push_back({.id = "DK022",
                 .title = "text follows a number",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A cell holds a number and then something else, or a hexadecimal "
                            "number.",
                 .why = "Usually a value stands across the border of two cells; what is read is a "
                        "part of it.",
                 .solver = "it goes on with the leading number and drops the rest; a real cell "
                           "with 0x10 is 16",
                 .fix = "check that every value stands in its columns",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Istf=2x\n",
                 .good = "@/INTER/TYPE7/1 Istf=2\n"});
  out.push_back({.id = "DK023",
                 .title = "number out of range",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A number is larger than its type can hold.",
                 .why = "What is read instead is undefined.",
                 .solver = "it reads an undefined value",
                 .message = 100104,
                 .message_severity = Severity::error,
                 .fix = "write a smaller number",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Gapmax=1e400\n",
                 .good = "@/INTER/TYPE7/1 Gapmax=1e30\n"});
  out.push_back({.id = "DK024",
                 .title = "number too small to represent",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A number is not zero but becomes zero or subnormal.",
                 .why = "Subnormal numbers slow down every operation on them.",
                 .solver = "it reads 0 or a subnormal number",
                 .fix = "write 0 if that is meant",
                 .ignore = "When the value is known to be harmless.",
                 .bad = "@/INTER/TYPE7/1 Gapmin=1e-400\n",
                 .good = "@/INTER/TYPE7/1 Gapmin=1e-4\n"});
  out.push_back({.id = "DK025",
                 .title = "infinity or not-a-number",
                 .severity = Severity::error,
                 .stage = reading,
                 .problem = "A cell holds inf or nan.",
                 .why = "It spreads through every result it touches.",
                 .solver = "it goes on and computes with infinity or not-a-number: an error here, "
                           "because nobody can want that",
                 .fix = "write a finite number; 1e30 is the usual 'no limit'",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Gapmax=inf\n",
                 .good = "@/INTER/TYPE7/1 Gapmax=1e30\n"});
  out.push_back({.id = "DK026",
                 .title = "exponent without letter fills the cell",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A number like 1.2345678901234567-3 fills all columns of its cell.",
                 .why = "The letter has to be put in by the reader, which needs one more column.",
                 .solver = "open-reader builds lose the last character",
                 .fix = "write the exponent with E, or drop a digit",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Gapmin=1.2345678901234567-3\n",
                 .good = "@/INTER/TYPE7/1 Gapmin=1.234567-3\n"});
  out.push_back({.id = "DK027",
                 .title = "text in blank columns",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "Text stands in columns that this input version leaves blank.",
                 .why = "The card was written for another version, or a value is in the wrong "
                        "place.",
                 .solver = "it drops the text (the closed reader warns, even for 0)",
                 .message = 100214,
                 .fix = "delete it, or check which version the card was written for",
                 .ignore = "When old decks carry zeros there.",
                 .fixable = Fixable::unsafe,
                 .bad = "@version 120\n/INTER/TYPE7/1\nexample\n"
                        "         2         1                                       4\n"
                        "\n\n                 1.0\n\n\n",
                 .good = "@version 110\n/INTER/TYPE7/1\nexample\n"
                         "         2         1                                       4\n"
                         "\n\n                 1.0\n\n\n"});
  out.push_back({.id = "DK028",
                 .title = "text after the last cell",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "Text that is not zero stands behind the last cell of a line.",
                 .why = "It looks like a value and is not read.",
                 .solver = "it drops the text",
                 .message = 100213,
                 .fix = "move the value into its columns or delete it",
                 .ignore = "When it is a remark; better make it a comment line.",
                 .fixable = Fixable::unsafe,
                 .bad = "/SKEW/FIX/1\naxes\n"
                        "                 0.0                 0.0                 0.0\n"
                        "                 1.0                 0.0                 0.0      9.9\n"
                        "                 0.0                 1.0                 0.0\n",
                 .good = "/SKEW/FIX/1\naxes\n"
                         "                 0.0                 0.0                 0.0\n"
                         "                 1.0                 0.0                 0.0\n"
                         "                 0.0                 1.0                 0.0\n"});
  out.push_back({.id = "DK029",
                 .title = "block ends before its last line",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "A card needs more lines than the block has.",
                 .why = "Blank lines count as lines; a missing one shifts the rest up.",
                 .solver = "it takes every cell of the missing line for 0 and goes on",
                 .message = 100217,
                 .fix = "add the line; blanks are enough where defaults are wanted",
                 .ignore = "When only defaults are wanted in the missing lines at the end.",
                 .bad = "/INTER/TYPE7/1\nexample\n         2         1\n",
                 .good = "@/INTER/TYPE7/1 Gapmin=0.5\n"});
  out.push_back({.id = "DK030",
                 .title = "line too many",
                 .severity = Severity::warning,
                 .stage = reading,
                 .problem = "Data follows the last line of a card.",
                 .why = "An optional line is there whose flag is not set, or a line was inserted "
                        "above and everything moved down.",
                 .solver = "it ignores the line",
                 .message = 100219,
                 .fix = "set the flag that asks for the line, or delete the line",
                 .ignore = "Never without a look at the card.",
                 .fixable = Fixable::unsafe,
                 .bad = "/SKEW/FIX/1\naxes\n"
                        "                 0.0                 0.0                 0.0\n"
                        "                 1.0                 0.0                 0.0\n"
                        "                 0.0                 1.0                 0.0\n"
                        "                 0.0                 0.0                 1.0\n",
                 .good = "/SKEW/FIX/1\naxes\n"
                         "                 0.0                 0.0                 0.0\n"
                         "                 1.0                 0.0                 0.0\n"
                         "                 0.0                 1.0                 0.0\n"});
}

}  // namespace

void add_reading_rules(std::vector<Rule>& out) {
  add_file_rules(out);
  add_frame_rules(out);
  add_cell_rules(out);
}

}  // namespace deck::detail
