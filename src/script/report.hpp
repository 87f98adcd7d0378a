#pragma once
// Messages at the line of the user's that a mistake stands in.

#include <lua.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "impact/scene.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Where in the user's files a call stands.
struct CallSite {
  std::string file, function;
  int line = 0;
};

Session& session_of(lua_State* L);

/// The innermost call made by the user's own code (not by the library).
CallSite call_site(lua_State* L);

struct Mistake {
  std::vector<std::string> path;  ///< of the field, outermost first; empty: the call itself
  std::string message;
};

/// "file:line: function: message" with an excerpt of the source, for each mistake; `valid` is listed at the end if not
/// empty.
std::string report(const Session& session, const CallSite& site, const std::vector<Mistake>& mistakes,
                   const std::string& valid = "");

/// The error of one mistake in a call at its own place: "file:line: function: message".
Error at_this_call(lua_State* L, const std::string& message);

/// An error at the line of the user's that runs: "file:line: message" with that line.
Error at_line(lua_State* L, const std::string& message);

/// The error of a name that `what` has not: "file:line: what has no 'name' (did you mean ...?)" or the names there are.
Error unknown_name(lua_State* L, const std::string& what, const std::string& name, std::vector<std::string> names);

/// Throws the error of a field as a report at the site, looking for the field in the table, or in its launch or contact
/// table.
[[noreturn]] void throw_at(const Session& session, const CallSite& site, const FieldError& error);

/// What the engine says of a scene, with what its numbers are worth to the user.
FieldError explained(const FieldError& error, const Scene& scene);
/// The same at this call.
[[noreturn]] void throw_here(lua_State* L, const FieldError& error);

/// "a, b, c"
std::string joined(std::span<const std::string> words);

}  // namespace ricochet
