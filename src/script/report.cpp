#include "script/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/spelling.hpp"
#include "script/functions.hpp"
#include "script/source.hpp"

namespace ricochet {
namespace {

// The text of a file that was read; nullptr if it was not.
const std::string* text_of(const Session& session, const std::string& file) {
  const auto found = session.sources.find(file);
  return found == session.sources.end() ? nullptr : &found->second;
}

// Where a field stands. One that is not written there (the table was made elsewhere) stands where the table around it
// does, or the call.
SourcePlace place_of(const std::string* text, const CallSite& site, std::vector<std::string> path) {
  for (; text && !path.empty(); path.pop_back())
    if (const auto found = find_field(*text, site.line, site.function, path)) return *found;
  return {site.line, 1, 0};
}

}  // namespace

Session& session_of(lua_State* L) { return **static_cast<Session**>(lua_getextraspace(L)); }

CallSite call_site(lua_State* L) {
  constexpr int most_levels = 1000;  // each costs as many steps as it is deep
  const Session& session = session_of(L);
  CallSite site;
  lua_Debug frame;
  for (int level = 0; level < most_levels && lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Sl", &frame);
    const std::string source = frame.source[0] == '@' ? frame.source + 1 : "";
    if (frame.currentline <= 0 || source.starts_with(session.library.string())) {
      // Called through pcall, a function has no name here: that of the one it called will do.
      lua_getinfo(L, "n", &frame);
      const std::string name = frame.name ? frame.name : "";
      if (!name.empty() && name != "pcall" && name != "xpcall" && name != "fail") site.function = name;
      continue;
    }
    if (source.empty()) continue;  // text that was loaded: the line that calls it
    site.file = source;
    site.line = frame.currentline;
    return site;
  }
  return site;
}

std::string report(const Session& session, const CallSite& site, const std::vector<Mistake>& mistakes,
                   const std::string& valid) {
  const std::string* text = text_of(session, site.file);
  std::string result;
  for (const Mistake& mistake : mistakes) {
    const SourcePlace place = place_of(text, site, mistake.path);
    if (!result.empty()) result += "error: ";
    if (!site.file.empty()) result += fmt::format("{}:{}: ", site.file, place.line);
    if (!site.function.empty()) result += site.function + ": ";
    result += mistake.message + "\n";
    if (text) result += excerpt(*text, place);
  }
  if (!valid.empty()) result += "  valid fields: " + valid + "\n";
  result.pop_back();
  return result;
}

Error at_this_call(lua_State* L, const std::string& message) {
  return Error(report(session_of(L), call_site(L), {{{}, message}}));
}

Error at_line(lua_State* L, const std::string& message) {
  const CallSite site = call_site(L);
  const std::string* text = text_of(session_of(L), site.file);
  std::string whole = site.file.empty() ? message : fmt::format("{}:{}: {}", site.file, site.line, message);
  whole += "\n";
  if (text) whole += excerpt(*text, {site.line, 1, 0});
  whole.pop_back();
  return Error(whole);
}

Error unknown_name(lua_State* L, const std::string& what, const std::string& name, std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  std::string remedy = did_you_mean(name, names);
  if (remedy.empty() && !names.empty()) remedy = "; it has " + joined(names);
  return at_line(L, fmt::format("{} has no '{}'{}", what, name, remedy));
}

void throw_at(const Session& session, const CallSite& site, const FieldError& error) {
  Mistake mistake{{error.field}, fmt::format("'{}': {}", error.field, error.what())};
  const std::string* text = text_of(session, site.file);
  for (const Function& f : functions())
    if (text && f.is_table && find_field(*text, site.line, site.function, {f.name, error.field}))
      mistake.path = {f.name, error.field};
  throw Error(report(session, site, {mistake}));
}

FieldError explained(const FieldError& error, const Scene& scene) {
  return FieldError(error.field, scene.units.explained(error.what()));
}

void throw_here(lua_State* L, const FieldError& error) { throw_at(session_of(L), call_site(L), error); }

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace ricochet
