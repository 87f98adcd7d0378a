// ricochet.bootstrap and rows:peak, written in Lua: lua/ricochet/bootstrap.lua. The draws are of the streams that
// lattices are drawn from, not of Lua's own.

#include <new>
#include <type_traits>

#include "core/rng.hpp"
#include "core/streams.hpp"
#include "script/functions.hpp"

namespace ricochet {
namespace {

// draw(list, count): fills the list with `count` whole numbers from 1 to `count`, each as likely.
int draw(lua_State* L) {
  Random& random = *static_cast<Random*>(lua_touserdata(L, lua_upvalueindex(1)));
  luaL_checktype(L, 1, LUA_TTABLE);
  const lua_Integer count = luaL_checkinteger(L, 2);
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_pushinteger(L, 1 + static_cast<lua_Integer>(random.uniform() * static_cast<double>(count)));
    lua_rawseti(L, 1, i);
  }
  return 0;
}

// draws(seed): the function draw, one resample a call.
int draws(lua_State* L) {
  static_assert(std::is_trivially_destructible_v<Random>);  // nothing would destroy it
  new (lua_newuserdatauv(L, sizeof(Random), 0))
      Random(static_cast<std::uint64_t>(luaL_checkinteger(L, 1)), streams::resampling);
  lua_pushcclosure(L, draw, 1);
  return 1;
}

std::vector<Field> fields_of_resampling() {
  return {{"resamples", "integer", "", "how often it is drawn", {20, 1e5}, "2000"},
          {"seed", "integer", "", "of the draws", {0, 9007199254740992.0}, "1"},
          {"share", "number", "", "of the resamples that lie between low and high", {0.5, 0.999}, "0.95"}};
}

std::vector<Field> with_resampling(std::vector<Field> fields) {
  for (Field& field : fields_of_resampling()) fields.push_back(std::move(field));
  return fields;
}

Function bootstrap_function() {
  return {
      .name = "bootstrap",
      .doc =
          "The standard error and the interval of any statistic of numbers that are independent, by a bootstrap: a "
          "table of `value`, `se`, `low`, `high` (quantiles of the statistic over the resamples), `count` and "
          "`reason`, which says why there is no error (nan) where there is none. The interval is narrow where "
          "numbers are few: that of the mean of 8 holds the true one in 89 of 100 cases instead of 95, of 40 in 94. "
          "Undefined values (nan) are left out.",
      .fields =
          with_resampling({{"values", "table", "", "list of numbers"},
                           {"of", "function", "", "function (list) that returns a number; their mean unless given",
                            any_number, "", true}}),
      .returns = "table",
      .example =
          "ricochet.bootstrap { values = { 0.9, 1.1, 1.3 }, of = function(list) return math.max(table.unpack(list)) "
          "end }.se"};
}

Function peak_function() {
  return {.name = "rows:peak",
          .doc =
              "Where the mean of a column is greatest, by a bootstrap over whole lattices: a table of `at` and "
              "`value`, of the rows themselves; `low` and `high`, values of x between which the greatest mean of "
              "resamples lies; `inside`, the share of resamples in which it is neither at the first nor at the last x, "
              "so that there is a peak at all; `shares`, a list over the values of x, of x (by its own name), `mean` "
              "and `share`; `units` and `reason`, which says why there is none (nan). Where nothing depends on x, "
              "`inside` is the share of x that are inside, whatever the number of lattices.",
          .fields = with_resampling({{"x", "string", "", "column of numbers"},
                                     {"of", "string", "", "column whose mean is taken"},
                                     {"unit", "string", "", "as in rows:power_law", any_number, "", true}}),
          .returns = "table",
          .example = "rows:peak { x = \"psi1\", of = \"mu\" }.inside"};
}

}  // namespace

Group resampling_functions() {
  return {.functions = {bootstrap_function(), peak_function()}, .natives = {{"draws", draws}}};
}

}  // namespace ricochet
