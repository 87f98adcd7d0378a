#pragma once
// Where in a script's text a field of a table stands, so that a message can point at it.

#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ricochet {

struct SourcePlace {
  int line;    ///< from 1
  int column;  ///< from 1
  int length;  ///< of the name
};

/// Finds the field `path` (outermost first) of the table given in the call of `function` that begins at `line`. Nothing
/// if the table is not written there.
std::optional<SourcePlace> find_field(const std::string& source, int line, const std::string& function,
                                      const std::vector<std::string>& path);

/// A chunk's text in which what it declares as local outside of every block is assigned instead, so that it outlives
/// the chunk: "local x = 1" is "x = 1", "local x" is "x = nil".
std::string without_outer_locals(const std::string& source);

/// The error of a file's syntax: Lua's own message, what it leaves unsaid (" (did you mean 'return' for 'retrun' in
/// line 4?)", " (is a comma missing before it?)", or nothing), and the line.
Error syntax_error(const std::string& name, const std::string& source, const std::string& message);

/// "   14 |   radus = 0.05,\n      |   ^^^^^\n" for a place; a place of length 0 gives the line alone.
std::string excerpt(const std::string& source, const SourcePlace& place);

}  // namespace ricochet
