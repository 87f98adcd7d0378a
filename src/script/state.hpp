#pragma once
#include <lua.hpp>
#include <string>

#include "sandbox/sandbox.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Lua with the module, in the sandbox.
class State {
 public:
  explicit State(Session& session);

  /// Runs the session's script. Throws Error.
  void run_script();
  /// What accuracy costs in the first scene that the script made. Throws Error.
  void study_first_scene();
  /// Runs one piece of text. Throws Error. Prints the values of an expression.
  void run_text(const std::string& text);
  /// Runs the chunk on top of the stack and prints its values. Throws Error.
  void run_chunk();

  lua_State* lua() const { return L_; }

 private:
  void call_chunk(int results);

  Session& session_;
  Sandbox sandbox_;
  lua_State* const L_ = sandbox_.L;
};

/// Throws Error if arguments were given to a script that declares no parameters.
void refuse_unused_arguments(const Session& session);

}  // namespace ricochet
