#pragma once
// The program's two ways of speaking. What a reader no longer takes never ends a run.

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ricochet {

/// To standard output, at once. What cannot be written is lost: in silence if nobody reads on (a closed pipe), and
/// remembered for output_lost() otherwise.
void put(std::string_view text);

/// The same of fmt::format().
template <class... Values>
void putf(fmt::format_string<Values...> format, Values&&... values) {
  put(fmt::format(format, std::forward<Values>(values)...));
}

/// To standard error, at once. What cannot be written is lost in silence.
void say(std::string_view text);

/// "error: ...\n" of what went wrong; a script may raise an error of any length, of which the beginning is told.
std::string complaint(std::string message);

/// Why some text of put() was lost ("No space left on device"), or "" if none was.
std::string output_lost();

/// Gives the three standard descriptors that are closed something to be, so that no file of results takes their place
/// and with it the program's messages. To be called first.
void open_standard_descriptors();

}  // namespace ricochet
