#include "script/look.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ricochet {
namespace {

int pixels_of(lua_State* L, double number) {
  if (number != std::floor(number))
    throw_here(L, FieldError("size", fmt::format("counts pixels, which {} does not", number)));
  return std::abs(number) <= 1e9 ? static_cast<int>(number) : 0;
}

void read_size(lua_State* L, Shooting& shooting) {
  if (lua_getfield(L, 1, "size") == LUA_TTABLE) {
    const std::vector<double> size = numbers_at(L, -1);
    if (size.size() != 2) throw_here(L, FieldError("size", "takes a width and a height"));
    shooting.width = pixels_of(L, size[0]);
    shooting.height = pixels_of(L, size[1]);
  }
  lua_pop(L, 1);
}

void finish(lua_State* L, Shooting& shooting) {
  Session& session = session_of(L);
  read_size(L, shooting);
  at_call(L, [&] {
    shooting.show.check();
    render::check_size(shooting.width, shooting.height);
  });
  shooting.origin = session.provenance().at("script_hash");
  shooting.threads = session.options.threads;
  shooting.warn = [&session](const std::string& text) { session.warn(text); };
}

}  // namespace

std::vector<Field> look_fields() {
  const Shooting usual;
  return {{"size", "numbers", "pixels", "width and height of the picture", any_number,
           fmt::format("{{{}, {}}}", usual.width, usual.height)},
          {"show", "show", "", "what the picture shows, and how", any_number, "{}"}};
}

Shooting shooting_of(lua_State* L) {
  Shooting shooting;
  read_inner_members(L, 1, "show", shooting.show);
  finish(L, shooting);
  return shooting;
}

Shooting sized_shooting_of(lua_State* L, const render::Show& show) {
  Shooting shooting;
  shooting.show = show;
  finish(L, shooting);
  return shooting;
}

}  // namespace ricochet
