// ricochet.points: outlines and nodes from files beside the script.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/hash.hpp"
#include "core/vec2.hpp"
#include "script/reader.hpp"
#include "script/run_files.hpp"
#include "store/files.hpp"

namespace ricochet {
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

// Of the whole text; nothing if it is no finite number.
std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Reads the lines of a file, of which messages tell the number.
class PointReader {
 public:
  explicit PointReader(std::string name) : name_(std::move(name)) {}

  Points points(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark, which some programs write
    Points points;
    for (int number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = trimmed(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!line.empty() && line.front() != '#') take(line, number, points);
    }
    if (points.empty()) throw Error(name_ + " holds no points; give lines x,y");
    return points;
  }

 private:
  // A line x,y, or x;y; before the first one names of the columns may stand.
  void take(std::string_view line, int number, Points& points) {
    const std::size_t comma = line.find_first_of(",;");
    const auto fail = [&](const std::string& what) {
      throw Error(fmt::format("{}:{}: {}; give lines x,y", name_, number, what));
    };
    if (comma == std::string_view::npos) fail(fmt::format("'{:.40}' has no comma", line));
    const std::string_view texts[] = {trimmed(line.substr(0, comma)), trimmed(line.substr(comma + 1))};
    if (texts[1].find_first_of(",;") != std::string_view::npos)
      fail(fmt::format("'{:.40}' holds more than two columns", line));
    const std::optional<double> x = number_in(texts[0]), y = number_in(texts[1]);
    if (!x && !y && points.empty() && !named_) {
      named_ = true;
      return;
    }
    if (!x || !y) fail(fmt::format("'{:.40}' is no finite number", x ? texts[1] : texts[0]));
    points.emplace_back(*x, *y);
  }

  std::string name_;
  bool named_ = false;  // the columns
};

// points(name): the list { {x, y}, ..., hash = that of the file }.
int points_file(lua_State* L) {
  if (lua_type(L, 1) != LUA_TSTRING)
    throw at_this_call(L, fmt::format("takes the name of a file beside the script, is {}", shown(L, 1)));
  std::size_t length = 0;
  const char* given = lua_tolstring(L, 1, &length);
  const std::string name(given, length);
  const std::filesystem::path path = beside_script(L, name);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw FileError(at_this_call(L, fmt::format("there is no file '{}' beside the script", name)).what());
  if (std::filesystem::file_size(path, error) > most_bytes)
    throw at_this_call(L, fmt::format("'{}' is larger than 64 MiB; give fewer points", name));
  std::string text;
  Points list;
  try {
    text = read_file(path);
    list = PointReader(name).points(text);
  } catch (const FileError& failure) {
    throw FileError(at_this_call(L, failure.what()).what());
  } catch (const Error& failure) {
    throw at_this_call(L, failure.what());
  }
  lua_createtable(L, static_cast<int>(list.size()), 1);
  for (std::size_t i = 0; i < list.size(); ++i) {
    lua_createtable(L, 2, 0);
    for (int axis = 0; axis < 2; ++axis) {
      lua_pushnumber(L, list[i][axis]);
      lua_rawseti(L, -2, axis + 1);
    }
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushstring(L, hash_text(text).c_str());
  lua_setfield(L, -2, "hash");
  return 1;
}

}  // namespace

Group point_functions() {
  return {.functions = {
              {.name = "points",
               .doc = "Reads an outline, or nodes, from a CSV file beside the script or in a folder there: a line x,y "
                      "for each point; empty lines, lines that begin with # and names of the columns are passed over. "
                      "Returns the list { {x, y}, ... } with the file's `hash`, which goes into the scene's text with "
                      "the points: another file makes another scene.",
               .returns = "points",
               .example = "local wing = ricochet.polygon { outline = ricochet.points(\"wing.csv\"), nodes = 400 }",
               .call = guarded<points_file>,
               .arguments = {{"name", "string"}}}}};
}

}  // namespace ricochet
