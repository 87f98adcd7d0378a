#pragma once
// Text of others as a part of a page: whatever it holds, it is shown and never executed.

#include <span>
#include <string>

namespace ricochet {

/// Bytes as they came, as UTF-8 that a page may hold: what is none becomes U+FFFD, NUL and other control characters
/// beside tab and line feed their pictures (U+2400 ...).
std::string shown_utf8(const std::string& bytes);

/// Between tags, or in an attribute in double quotes.
std::string html_text(const std::string& bytes);

/// A JSON string that may stand in a script element: it holds no "<".
std::string json_text(const std::string& bytes);

/// The shortest number that reads back as the same, or null for what is not finite.
std::string json_number(double value);
std::string json_numbers(std::span<const double> values);

}  // namespace ricochet
