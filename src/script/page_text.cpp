#include "script/page_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ricochet {

namespace {

using Byte = unsigned char;

struct Lead {
  std::size_t length;
  std::uint32_t bits, least;  // of the first byte; the smallest character that needs so many
};

// What the first byte of a character says; of length 0 if none begins so.
Lead lead_of(Byte first) {
  if (first < 0x80) return {1, first, 0};
  if (first >= 0xC2 && first < 0xE0) return {2, first & 0x1Fu, 0x80};
  if (first >= 0xE0 && first < 0xF0) return {3, first & 0x0Fu, 0x800};
  if (first >= 0xF0 && first < 0xF5) return {4, first & 0x07u, 0x10000};
  return {0, 0, 0};
}

// How many bytes from `at` are one character; 0 if they are none.
std::size_t character_at(const std::string& bytes, std::size_t at) {
  const Lead lead = lead_of(static_cast<Byte>(bytes[at]));
  if (lead.length == 0 || at + lead.length > bytes.size()) return 0;
  std::uint32_t code = lead.bits;
  for (std::size_t k = 1; k < lead.length; ++k) {
    const Byte next = static_cast<Byte>(bytes[at + k]);
    if ((next & 0xC0) != 0x80) return 0;
    code = code << 6 | (next & 0x3Fu);
  }
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < lead.least || surrogate || code > 0x10FFFF ? 0 : lead.length;
}

}  // namespace

std::string shown_utf8(const std::string& bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = character_at(bytes, at);
    const Byte first = static_cast<Byte>(bytes[at]);
    if (length == 0)
      text += "\xEF\xBF\xBD";
    else if (first == 0x7F)
      text += "\xE2\x90\xA1";
    else if (first < 0x20 && first != '\t' && first != '\n')
      text += std::string("\xE2\x90") + static_cast<char>(0x80 + first);
    else
      text.append(bytes, at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

std::string html_text(const std::string& bytes) {
  std::string text;
  for (const char c : shown_utf8(bytes)) {
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

std::string json_text(const std::string& bytes) {
  std::string text = "\"";
  for (const char c : shown_utf8(bytes)) {
    if (c == '"' || c == '\\')
      text += std::string("\\") + c;
    else if (c == '\n')
      text += "\\n";
    else if (c == '\t')
      text += "\\t";
    else if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text + "\"";
}

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string json_numbers(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? "," : "") + json_number(value);
  return text + "]";
}

}  // namespace ricochet
