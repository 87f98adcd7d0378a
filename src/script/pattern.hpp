#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace ricochet {

/// What a search by one of Lua's patterns finds, and how much work it is. [Lua 5.4 reference manual, section 6.4.1]
struct PatternSearch {
  struct Span {
    std::size_t begin, end;  ///< end is one past the last byte
  };
  std::optional<Span> first;  ///< the first match; nothing if there is none, or if the search was given up
  double steps = 0;           ///< comparisons of a byte with an item of the pattern
  bool too_long = false;      ///< given up after `most` steps
  bool refused = false;       ///< the pattern is malformed or too deep: Lua itself says why
};

/// Searches `text` from `begin` on for `pattern`, at most `matches` times, one after the other as string.gsub does.
/// `anchors`: a '^' at its beginning holds it to `begin` (string.gmatch knows none). Lua's own matcher goes the same
/// way, but cannot be stopped.
PatternSearch search_pattern(std::string_view text, std::string_view pattern, std::size_t begin, double matches,
                             bool anchors, double most);

}  // namespace ricochet
