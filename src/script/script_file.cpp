#include "script/script_file.hpp"

#include <fmt/format.h>

#include <iostream>
#include <iterator>
#include <string_view>

#include "core/spelling.hpp"
#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Of the character at the beginning; 0 if there is none in UTF-8.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[k]) & 0xc0) != 0x80) return 0;
  return length;
}

// By its byte order mark, or by the zeros of what would be ASCII.
bool is_utf16(const std::string& text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return true;
  return text.size() > 3 && ((text[0] == 0 && text[2] == 0) || (text[1] == 0 && text[3] == 0));
}

}  // namespace

std::string read_source(const fs::path& path) {
  std::string text =
      path == standard_input ? std::string{std::istreambuf_iterator<char>(std::cin), {}} : read_file(path);
  if (is_utf16(text)) throw Error(path.string() + ": is written in UTF-16; save it as UTF-8");
  return text;
}

void check_script(const fs::path& script) {
  if (script == standard_input) return;
  std::error_code error;
  if (fs::exists(script, error)) return;
  if (error) throw FileError(fmt::format("cannot read {}: {}", script.string(), error.message()));
  if (fs::is_symlink(script, error))
    throw FileError(fmt::format("{} is a link to {}, which is not there", script.string(),
                                fs::read_symlink(script, error).string()));
  std::vector<std::string> near;
  for (const auto& entry :
       fs::directory_iterator(script.has_parent_path() ? script.parent_path() : fs::path("."), error))
    near.push_back(entry.path().filename().string());
  const std::string hint = did_you_mean(script.filename().string(), near);
  throw FileError(
      fmt::format("there is no script {}{}", script.string(),
                  hint.empty() ? fmt::format(" (looked for {})", fs::absolute(script, error).string()) : hint));
}

void warn_of_encoding(Session& session) {
  const std::string& text = session.sources.at(session.script.string());
  int line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(std::string_view(text).substr(i));
    if (length == 0)
      return session.warn(
          fmt::format("{}:{} is not UTF-8; save the script as UTF-8, or its texts will not be shown as "
                      "they are written",
                      session.script.string(), line));
    line += text[i] == '\n';
    i += length;
  }
}

}  // namespace ricochet
