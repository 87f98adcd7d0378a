#include "script/thinned.hpp"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "core/error.hpp"
#include "store/packed.hpp"

namespace ricochet {

namespace {

using Places = std::vector<std::size_t>;

[[noreturn]] void refuse() {
  throw FileError(
      "a replay of the earlier report is damaged; run the script again with --resume to make its report anew");
}

/// What stands between two places of a text.
struct Span {
  std::size_t begins, ends;

  std::string of(const std::string& text) const { return text.substr(begins, ends - begins); }
};

// What stands behind `mark`, up to `end`.
Span span_after(const std::string& text, const std::string& mark, char end) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) refuse();
  const Span span{at + mark.size(), text.find(end, at + mark.size())};
  if (span.ends == std::string::npos) refuse();
  return span;
}

std::size_t count_in(const std::string& replay, const std::string& name) {
  const std::string digits = span_after(replay, "\"" + name + "\":", ',').of(replay);
  std::size_t value = 0;
  if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc() || value == 0) refuse();
  return value;
}

void replace(std::string& replay, const Span& span, const std::string& by) {
  replay.replace(span.begins, span.ends - span.begins, by);
}

// `rows` rows of `all` differences of `size` bytes in planes: the same of the kept places.
std::string kept_differences(const std::string& planes, std::size_t rows, std::size_t all, const Places& kept,
                             int size) {
  const std::size_t plane = rows * all;
  std::vector<std::uint32_t> steps;
  std::vector<std::uint32_t> values(all);
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint32_t sum = 0;
    for (std::size_t f = 0; f < all; ++f) {
      for (int k = 0; k < size; ++k)
        sum += static_cast<std::uint32_t>(
                   static_cast<unsigned char>(planes[static_cast<std::size_t>(k) * plane + row * all + f]))
               << (8 * k);
      values[f] = sum;
    }
    std::uint32_t before = 0;
    for (const std::size_t f : kept) {
      steps.push_back(values[f] - before);
      before = values[f];
    }
  }
  return byte_planes(steps, size);
}

void thin_packed(std::string& replay, const std::string& name, std::size_t rows, std::size_t all, const Places& kept,
                 int size) {
  const Span span = span_after(replay, "\"" + name + "\":\"", '"');
  const auto planes = inflated(from_base64(span.of(replay)), rows * all * static_cast<std::size_t>(size));
  if (!planes) refuse();
  replace(replay, span, base64(deflated(kept_differences(*planes, rows, all, kept, size))));
}

// "1,2,3,4" -> "1,4"
std::string kept_of(const std::string& list, std::size_t all, const Places& kept) {
  std::vector<std::string> values{""};
  for (const char c : list)
    if (c == ',')
      values.emplace_back();
    else
      values.back() += c;
  if (values.size() != all) refuse();
  std::string text;
  for (const std::size_t f : kept) text += (text.empty() ? "" : ",") + values[f];
  return text;
}

void thin_series(std::string& replay, std::size_t all, const Places& kept) {
  const Span series = span_after(replay, "\"series\":{", '}');
  const std::string text = series.of(replay);
  std::string thin;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begins = text.find('[', at), ends = text.find(']', at);
    if (begins == std::string::npos || ends == std::string::npos || ends < begins) refuse();
    thin += text.substr(at, begins + 1 - at) + kept_of(text.substr(begins + 1, ends - begins - 1), all, kept) + "]";
    at = ends + 1;
  }
  replace(replay, series, thin);
}

}  // namespace

std::string thinned(const std::string& replay, int frames) {
  const std::size_t all = count_in(replay, "frames"), nodes = count_in(replay, "nodes");
  const std::size_t wanted = static_cast<std::size_t>(frames);
  if (all <= wanted) return replay;
  Places kept;
  for (std::size_t i = 0; i < wanted; ++i) kept.push_back((i * (all - 1) + (wanted - 1) / 2) / (wanted - 1));
  std::string thin = replay;
  replace(thin, span_after(thin, "\"frames\":", ','), fmt::format("{}", wanted));
  thin_series(thin, all, kept);
  thin_packed(thin, "place", 2 * nodes, all, kept, 2);
  thin_packed(thin, "colour", nodes, all, kept, 1);
  return thin;
}

}  // namespace ricochet
