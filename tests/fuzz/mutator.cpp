// A mutator that knows what a deck is made of: lines, cards of 8, 10 and 20 columns or with commas,
// headers and blocks, ids that are in use, and numbers on which programs stumble. For the targets
// whose input is text; every third mutation is libFuzzer's own, on bytes.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "lint/shared/example.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using Lines = std::vector<std::string>;

/// The pieces between bars.
Lines pieces(std::string_view text) {
  Lines out(1);
  for (const char c : text)
    if (c == '|')
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

const Lines numbers = pieces(
    "0|1|-1|2|3|4|5|6|7|8|9|10|11|12|19|25|100|110|1000|1001|2022|2026|51|-2|-1000|99999999|"
    "999999999|2147483647|-2147483648|4294967295|4294967299|9223372036854775807|"
    "99999999999999999999|0.|-0.|.5|1.|-1.|0.1|1e-3|1e-20|1e-30|1e-154|1e-300|1e-308|5e-324|"
    "1e-400|1e20|1e30|1.4e154|1e155|1e300|1.8e308|1e400|-1e30|1.5d3|1+5|1-5|1e|e5|.|-|+|nan|inf|"
    "0x10|1,2|&P|&|1.e+03|000000001|1 2|*|'|/|#");
const Lines lines = pieces(
    "/END|#enddata|#include part.inc|#include|//SUBMODEL/1|//ENDSUB|/UNIT/1|# comment|| |\t|/|//|"
    "/INTER|=== part.inc|# decklint: ignore[DK201:Ibag]|# decklint: ignore|*KEYWORD|*END|"
    "*CONTACT_AUTOMATIC_GENERAL|*CONTACT_TIED_NODES_TO_SURFACE|$ comment");

class Mutation {
 public:
  Mutation(std::string_view text, unsigned seed) : random_(seed) {
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      lines_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (lines_.empty()) lines_.emplace_back();
  }

  void step() {
    using Change = void (Mutation::*)();
    constexpr Change changes[] = {
        &Mutation::cell,   &Mutation::cell,        &Mutation::cell,        &Mutation::cell,
        &Mutation::token,  &Mutation::token,       &Mutation::token,       &Mutation::header,
        &Mutation::length, &Mutation::repeat_line, &Mutation::remove_line, &Mutation::swap_lines,
        &Mutation::block,  &Mutation::new_line,    &Mutation::fresh_block, &Mutation::copy_cell};
    (this->*changes[below(std::size(changes))])();
    if (lines_.empty()) lines_.emplace_back();
  }

  /// Blocks of another input between those of this one.
  void mix(const Mutation& other) {
    for (std::size_t n = 1 + below(3); n > 0; --n) {
      const auto [first, last] = const_cast<Mutation&>(other).some_block();
      const Lines part(other.lines_.begin() + at(first), other.lines_.begin() + at(last));
      const auto place = lines_.begin() + at(some_block().first);
      lines_.insert(place, part.begin(), part.end());
    }
  }

  std::string text() const {
    std::string out;
    for (const std::string& l : lines_) out += l + "\n";
    return out;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  static std::ptrdiff_t at(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }
  std::size_t line_number() { return below(lines_.size()); }
  template <class List>
  auto pick(const List& list) {
    return list[below(std::size(list))];
  }

  /// A number: a known troublemaker, one that stands in the text already, or a neighbour of that.
  std::string number() {
    if (below(2) == 0) return pick(numbers);
    const std::string& line = lines_[line_number()];
    const auto first = line.find_first_of("0123456789", below(line.size() + 1));
    if (first == std::string::npos) return pick(numbers);
    const auto last = std::min(line.find_first_not_of("0123456789.eE", first), line.size());
    std::string found = line.substr(first, last - first);
    if (below(3) == 0) found.back() = static_cast<char>('0' + below(10));
    return found;
  }

  /// Columns of a cell on a line: [first, first + width).
  std::pair<std::size_t, std::size_t> some_cell(const std::string& line) {
    if (below(2) == 0 && line.find(',') != std::string::npos) {
      std::size_t first = line.rfind(',', below(line.size()));
      first = first == std::string::npos ? 0 : first + 1;
      return {first, std::min(line.find(',', first), line.size()) - first};
    }
    constexpr std::size_t widths[] = {10, 10, 20, 20, 8, 5};
    const std::size_t width = pick(widths);
    return {width * below(std::min<std::size_t>(line.size() / width + 2, 10)), width};
  }
  static void put(std::string& line, std::size_t first, std::size_t width, std::string text) {
    if (line.size() < first + width && line.find(',') == std::string::npos)
      line.resize(first + width, ' ');
    if (first > line.size()) return;
    const bool fixed = line.find(',') == std::string::npos;
    if (fixed && text.size() < width) text.insert(0, width - text.size(), ' ');
    line.replace(first, width, fixed ? text.substr(0, width) : text);
  }

  void cell() {
    std::string& line = lines_[line_number()];
    if (!line.empty() && (line[0] == '/' || line[0] == '#') && below(4) != 0) return cell();
    const auto [first, width] = some_cell(line);
    put(line, first, width, below(8) == 0 ? std::string() : number());
  }
  void copy_cell() {
    const std::string& from = lines_[line_number()];
    const auto [first, width] = some_cell(from);
    if (first >= from.size()) return;
    const std::string text = from.substr(first, width);
    std::string& to = lines_[line_number()];
    const auto place = some_cell(to);
    put(to, place.first, place.second, text);
  }
  /// Replaces a number or a word wherever it stands: JSON, TOML, free format, headers.
  void token() {
    std::string& line = lines_[line_number()];
    const auto word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
    };
    auto first = std::find_if(line.begin() + at(below(line.size() + 1)), line.end(), word);
    const auto last = std::find_if_not(first, line.end(), word);
    if (first == last) return;
    const std::string& other = lines_[line_number()];
    auto begin = std::find_if(other.begin() + at(below(other.size() + 1)), other.end(), word);
    const std::string taken(begin, std::find_if_not(begin, other.end(), word));
    const bool digits = std::isdigit(static_cast<unsigned char>(*first)) != 0;
    const std::string text = digits || taken.empty() ? number() : taken;
    line.replace(first, last, text);
  }
  static bool is_header(const std::string& line) {
    return !line.empty() && (line[0] == '/' || line[0] == '*');
  }
  /// A block: a header and what follows up to the next one.
  std::pair<std::size_t, std::size_t> some_block() {
    std::size_t first = line_number();
    while (first > 0 && !is_header(lines_[first])) --first;
    std::size_t last = first + 1;
    while (last < lines_.size() && !is_header(lines_[last])) ++last;
    return {first, std::min(last, first + 40)};
  }
  void header() {
    std::string& line = lines_[some_block().first];
    const auto slash = line.rfind('/');
    if (slash == std::string::npos) return;
    const std::size_t what = below(5);
    if (what == 0)
      line.resize(slash);
    else if (what == 1)
      line += "/" + number();
    else if (what == 2)
      line = std::string(keyword()->keyword) + line.substr(slash);
    else
      line = line.substr(0, slash + 1) + number();
  }
  void repeat_line() {
    const std::size_t n = line_number();
    const std::string copy = lines_[n];
    lines_.insert(lines_.begin() + at(below(2) == 0 ? n : line_number()), 1 + below(3), copy);
  }
  void remove_line() { lines_.erase(lines_.begin() + at(line_number())); }
  void swap_lines() { std::swap(lines_[line_number()], lines_[line_number()]); }
  void new_line() { lines_.insert(lines_.begin() + at(line_number()), pick(lines)); }
  void length() {
    std::string& line = lines_[line_number()];
    if (below(2) == 0)
      line.resize(below(line.size() + 1));
    else
      line += std::string(below(30), ' ') + number();
  }
  void block() {
    const auto [first, last] = some_block();
    const Lines copy(lines_.begin() + at(first), lines_.begin() + at(last));
    const std::size_t what = below(3);
    if (what != 0) lines_.erase(lines_.begin() + at(first), lines_.begin() + at(last));
    if (lines_.empty()) lines_.emplace_back();
    if (what != 1) lines_.insert(lines_.begin() + at(some_block().first), copy.begin(), copy.end());
  }
  const deck::Schema* keyword() {
    static const auto all = deck::SchemaSet::built_in().all();
    return all[below(all.size())];
  }
  /// A block that its schema describes, with some of its fields.
  void fresh_block() {
    const deck::Schema& schema = *keyword();
    std::vector<std::pair<std::string, std::string>> values;
    for (const deck::CardSchema& card : schema.cards)
      for (const deck::Field& field : card.fields)
        if (below(3) != 0) {
          const bool listed = !field.values.empty() && below(2) == 0;
          values.emplace_back(
              field.name,
              listed ? std::to_string(field.values[below(field.values.size())]) : number());
        }
    std::string text = deck::render_card(
        schema, schema.keyword + (schema.has_id ? "/" + number() : std::string()), 2022, values);
    if (!text.empty() && text.back() == '\n') text.pop_back();
    lines_.insert(lines_.begin() + at(some_block().first), std::move(text));
  }

  std::minstd_rand random_;
  Lines lines_;
};

std::size_t give_back(const std::string& text, std::uint8_t* data, std::size_t most) {
  const std::size_t size = std::min(text.size(), most);
  std::memcpy(data, text.data(), size);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (seed % 3 == 0) return LLVMFuzzerMutate(data, size, most);
  Mutation m({reinterpret_cast<const char*>(data), size}, seed / 3 + 1);
  for (unsigned n = 1 + seed / 3 % 4; n > 0; --n) m.step();
  return give_back(m.text(), data, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t a_size,
                                                 const std::uint8_t* b, std::size_t b_size,
                                                 std::uint8_t* out, std::size_t most,
                                                 unsigned seed) {
  Mutation m({reinterpret_cast<const char*>(a), a_size}, seed + 1);
  m.mix(Mutation({reinterpret_cast<const char*>(b), b_size}, seed + 2));
  return give_back(m.text(), out, most);
}
