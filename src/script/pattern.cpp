#include "script/pattern.hpp"

#include <array>
#include <bitset>
#include <cctype>
#include <vector>

namespace ricochet {
namespace {

using Set = std::bitset<256>;

struct Item {
  enum class Kind { single, open, close, position, back_reference, balance, frontier, end, malformed };
  Kind kind = Kind::single;
  Set set{};              // single, frontier
  char repetition = 0;    // single: * + - ? or none
  char from = 0, to = 0;  // balance; back_reference: from is the capture's number, from 0
};

struct Malformed {};
struct TooLong {};

unsigned char byte(char c) { return static_cast<unsigned char>(c); }

// %a, %d, ...; any other character stands for itself.
Set class_of(char letter) {
  int (*is)(int) = nullptr;
  switch (std::tolower(byte(letter))) {
    case 'a':
      is = std::isalpha;
      break;
    case 'c':
      is = std::iscntrl;
      break;
    case 'd':
      is = std::isdigit;
      break;
    case 'g':
      is = std::isgraph;
      break;
    case 'l':
      is = std::islower;
      break;
    case 'p':
      is = std::ispunct;
      break;
    case 's':
      is = std::isspace;
      break;
    case 'u':
      is = std::isupper;
      break;
    case 'w':
      is = std::isalnum;
      break;
    case 'x':
      is = std::isxdigit;
      break;
    case 'z':
      is = [](int c) { return static_cast<int>(c == 0); };
      break;  // not in the manual any more, but Lua still takes it
    default:
      break;
  }
  Set set;
  if (!is) return set.set(byte(letter));
  for (int c = 0; c < 256; ++c) set[static_cast<std::size_t>(c)] = is(c) != 0;
  return std::isupper(byte(letter)) ? ~set : set;
}

// Reads a pattern, item by item.
class Reader {
 public:
  explicit Reader(std::string_view pattern) : pattern_(pattern) {}

  std::vector<Item> items() {
    std::vector<Item> list;
    try {
      while (at_ < pattern_.size()) list.push_back(item());
    } catch (const Malformed&) {
      list.push_back({Item::Kind::malformed});  // Lua does not notice before it gets there, which may take long
    }
    return list;
  }

 private:
  bool next_is(char c) const { return at_ < pattern_.size() && pattern_[at_] == c; }
  char take() {
    if (at_ >= pattern_.size()) throw Malformed{};
    return pattern_[at_++];
  }

  Item item() {
    Item item;
    switch (const char c = take()) {
      case '(':
        if (next_is(')')) {
          ++at_;
          item.kind = Item::Kind::position;
        } else
          item.kind = Item::Kind::open;
        return item;
      case ')':
        item.kind = Item::Kind::close;
        return item;
      case '$':
        if (at_ == pattern_.size()) {
          item.kind = Item::Kind::end;
          return item;
        }
        item.set.set(byte(c));
        break;
      case '%':
        if (next_is('b')) {
          ++at_;
          item.kind = Item::Kind::balance;
          item.from = take();
          item.to = take();
          return item;
        }
        if (next_is('f')) {
          ++at_;
          item.kind = Item::Kind::frontier;
          if (take() != '[') throw Malformed{};
          item.set = set();
          return item;
        }
        if (at_ < pattern_.size() && std::isdigit(byte(pattern_[at_]))) {
          item.kind = Item::Kind::back_reference;
          item.from = static_cast<char>(take() - '1');
          return item;
        }
        item.set = class_of(take());
        break;
      case '[':
        item.set = set();
        break;
      case '.':
        item.set.set();
        break;
      default:
        item.set.set(byte(c));
    }
    if (at_ < pattern_.size() && std::string_view("*+-?").find(pattern_[at_]) != std::string_view::npos)
      item.repetition = take();
    return item;
  }

  // What follows a '[', up to its ']'; a ']' that comes first stands for itself. Where a set ends, Lua decides before
  // it reads what is in it: at the first ']' that no '%' precedes, even one that is the end of a range.
  Set set() {
    Set set;
    const bool complement = next_is('^');
    if (complement) ++at_;
    std::size_t end = at_;
    do {
      if (end >= pattern_.size()) throw Malformed{};
      if (pattern_[end++] == '%' && end < pattern_.size()) ++end;
    } while (end >= pattern_.size() || pattern_[end] != ']');
    while (at_ < end) {
      const char c = pattern_[at_++];
      if (c == '%') {
        set |= class_of(pattern_[at_++]);
      } else if (at_ + 1 < end && pattern_[at_] == '-') {
        for (int low = byte(c), high = byte(pattern_[at_ + 1]); low <= high; ++low)
          set.set(static_cast<std::size_t>(low));
        at_ += 2;
      } else {
        set.set(byte(c));
      }
    }
    at_ = end + 1;
    return complement ? ~set : set;
  }

  std::string_view pattern_;
  std::size_t at_ = 0;
};

// Tries a pattern at places of a text, backtracking.
class Matcher {
 public:
  Matcher(std::string_view text, std::vector<Item> items, double most)
      : text_(text), items_(std::move(items)), most_(most) {}

  std::optional<std::size_t> at(std::size_t place) {
    level_ = 0;
    depth_ = 0;
    const auto end = match(0, place);
    for (int i = 0; end && i < level_; ++i)
      if (captures_[static_cast<std::size_t>(i)].length == unclosed) throw Malformed{};
    return end;
  }
  double steps() const { return steps_; }

 private:
  static constexpr std::size_t unclosed = static_cast<std::size_t>(-1), place_only = static_cast<std::size_t>(-2);
  static constexpr int deepest = 200, most_captures = 32;  // as Lua's

  struct Capture {
    std::size_t begin, length;
  };

  void work(std::size_t steps) {
    steps_ += static_cast<double>(steps);
    if (steps_ > most_) throw TooLong{};
  }
  bool fits(const Item& item, std::size_t place) const { return place < text_.size() && item.set[byte(text_[place])]; }

  // Where the items from k on end if they match from `place` on.
  std::optional<std::size_t> match(std::size_t k, std::size_t place) {
    if (++depth_ > deepest) throw Malformed{};
    struct Leave {
      int& depth;
      ~Leave() { --depth; }
    } leave{depth_};
    for (; k < items_.size(); ++k) {
      const Item& item = items_[k];
      work(1);
      switch (item.kind) {
        case Item::Kind::open:
        case Item::Kind::position: {
          if (level_ >= most_captures) throw Malformed{};
          captures_[static_cast<std::size_t>(level_++)] = {place,
                                                           item.kind == Item::Kind::open ? unclosed : place_only};
          const auto end = match(k + 1, place);
          if (!end) --level_;
          return end;
        }
        case Item::Kind::close: {
          int open = level_ - 1;
          while (open >= 0 && captures_[static_cast<std::size_t>(open)].length != unclosed) --open;
          if (open < 0) throw Malformed{};
          Capture& capture = captures_[static_cast<std::size_t>(open)];
          capture.length = place - capture.begin;
          const auto end = match(k + 1, place);
          if (!end) capture.length = unclosed;
          return end;
        }
        case Item::Kind::back_reference: {
          if (item.from < 0 || item.from >= level_) throw Malformed{};
          const Capture& capture = captures_[static_cast<std::size_t>(item.from)];
          if (capture.length == unclosed) throw Malformed{};
          if (capture.length == place_only || text_.size() - place < capture.length) return std::nullopt;
          work(capture.length);
          if (text_.substr(capture.begin, capture.length) != text_.substr(place, capture.length)) return std::nullopt;
          place += capture.length;
          break;
        }
        case Item::Kind::balance: {
          if (place >= text_.size() || text_[place] != item.from) return std::nullopt;
          int open = 1;
          std::size_t end = place + 1;
          for (; end < text_.size(); ++end) {
            if (text_[end] == item.to) {
              if (--open == 0) break;
            } else if (text_[end] == item.from) {
              ++open;
            }
          }
          work(end - place);
          if (end >= text_.size()) return std::nullopt;
          place = end + 1;
          break;
        }
        case Item::Kind::frontier: {
          const unsigned char before = place == 0 ? 0 : byte(text_[place - 1]),
                              here = place < text_.size() ? byte(text_[place]) : 0;
          if (item.set[before] || !item.set[here]) return std::nullopt;
          break;
        }
        case Item::Kind::malformed:
          throw Malformed{};
        case Item::Kind::end:
          return place == text_.size() ? std::optional(place) : std::nullopt;
        case Item::Kind::single:
          if (item.repetition == '*' || item.repetition == '+') {
            std::size_t count = 0;
            while (fits(item, place + count)) ++count;
            work(count);
            for (const std::size_t least = item.repetition == '+'; count + 1 > least; --count) {
              if (const auto end = match(k + 1, place + count)) return end;
              if (count == 0) break;
            }
            return std::nullopt;
          }
          if (item.repetition == '-') {
            for (;; ++place) {
              if (const auto end = match(k + 1, place)) return end;
              work(1);
              if (!fits(item, place)) return std::nullopt;
            }
          }
          if (item.repetition == '?') {
            if (fits(item, place))
              if (const auto end = match(k + 1, place + 1)) return end;
          } else {
            if (!fits(item, place)) return std::nullopt;
            ++place;
          }
          break;
      }
    }
    return place;
  }

  std::string_view text_;
  std::vector<Item> items_;
  double most_, steps_ = 0;
  std::array<Capture, most_captures> captures_{};
  int level_ = 0, depth_ = 0;
};

}  // namespace

PatternSearch search_pattern(std::string_view text, std::string_view pattern, std::size_t begin, double matches,
                             bool anchors, double most) {
  PatternSearch search;
  const bool anchored = anchors && pattern.starts_with('^');
  if (anchored) pattern.remove_prefix(1);
  if (begin > text.size()) return search;
  std::optional<Matcher> matcher;
  try {
    matcher.emplace(text, Reader(pattern).items(), most);
    double found = 0;
    std::optional<std::size_t> last;  // a match that is empty does not begin where the one before ended
    for (std::size_t place = begin; found < matches;) {
      const auto end = matcher->at(place);
      if (end && end != last) {
        if (!search.first) search.first = {place, *end};
        ++found;
        last = place = *end;
      } else if (place < text.size()) {
        ++place;
      } else {
        break;
      }
      if (anchored) break;
    }
  } catch (const Malformed&) {
    search.refused = true;
  } catch (const TooLong&) {
    search.too_long = true;
    search.first.reset();
  }
  if (matcher) search.steps = matcher->steps();
  return search;
}

}  // namespace ricochet
