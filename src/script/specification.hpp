#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// A function of the Lua module: the one source for reading and checking its table, the messages, the editor stubs and
/// the reference page.
struct Function {
  std::string name;  ///< as a script writes it: "disk", "sweep.run", "rows:summary" (a method)
  std::string doc;
  std::vector<Field> fields;
  std::string returns;
  std::string example;
  std::vector<Field> results = {};  ///< what the returned table holds, where that is listed
};

/// Every function, in the order of the reference page.
std::span<const Function> functions();

/// The function of that name; a programming mistake if there is none.
const Function& function_named(const std::string& name);

/// Generated texts: lua/ricochet.d.lua (for the Lua language server) and lua/REFERENCE.md. Tests keep the files
/// current.
std::string editor_stubs();
std::string reference_page();

}  // namespace ricochet
