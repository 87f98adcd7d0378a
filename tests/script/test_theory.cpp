// ricochet.theory as a script sees it, and `ricochet theory`.

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "script/program.hpp"
#include "script/reference.hpp"
#include "theory/catalogue.hpp"
#include "theory/errata.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

TEST_CASE("every theory answers a script with the value that the library has") {
  const Workplace here;
  std::string script = "local ricochet = require 'ricochet'\n";
  for (const theory::Theory& t : theory::theories()) script += fmt::format("print('{}', {})\n", t.name, t.example);
  const Ended ended = here.script(script);
  INFO(ended.err);
  CHECK(ended.status == 0);
  for (const theory::Theory& t : theory::theories()) CHECK_THAT(ended.out, Contains(t.name + "\t"));
  CHECK_THAT(ended.out, Contains("rods\t0.5\n") && Contains("walton\t-0.145\n") &&
                            Contains("kuwabara_kono_first_order\t0.989910902"));
}

TEST_CASE("theory returns tables of named numbers that know their names") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local stuck, sliding = ricochet.theory.maw { psi1 = 0.1, mu = 0.3, e = 1, nu = 0.3 }, ricochet.theory.maw { psi1 = 9, mu = 0.3, e = 1, nu = 0.3 }
print(stuck.regime, sliding.regime, rawget(sliding, "t1"))
local curve = ricochet.theory.tilted_curve { psi1 = { 0, 1, 2, 3 }, mu = { 0, 0, 0, 0 }, e_alpha = { 1, 2, 3, 4 }, offset = { 0, 0, 0, 0 }, nu = 0.3, at = { 0.5, 1.5 } }
print(("%.12g %.12g"):format(curve.e[1], curve.e[2]), #curve.e)
print(stuck.betta)
)");
  CHECK(ended.status == 1);
  CHECK(ended.out == "1.0\t3.0\tnil\n1.5 2.5\t2\n");
  CHECK(ended.first_line() == "error: s.lua:6: the table of theory.maw has no 'betta' (did you mean 'beta'?)");
}

TEST_CASE("a mistake in a theory's table is reported at the field's own line") {
  const Workplace here;
  const auto mistake = [&](const std::string& line) {
    const Ended ended = here.script("local ricochet = require 'ricochet'\n" + line, "--force");
    CHECK(ended.status == 1);
    return ended.err;
  };
  CHECK_THAT(mistake("local x = ricochet.theory.walton { mu = 0.3,\n  psi1 = -1,\n  e = 1, beta0 = 2 }"),
             Contains("error: s.lua:3: walton: 'psi1' must be at least 0, is -1") &&
                 Contains("error: s.lua:4: walton: 'beta0' must be between -1 and 1, is 2"));
  CHECK_THAT(mistake("ricochet.theory.walton { psi = 1, mu = 0.3, e = 1, beta0 = 0 }"),
             Contains("walton: unknown field 'psi' (did you mean 'psi1'?)") && Contains("walton: 'psi1' is missing"));
  CHECK_THAT(mistake("ricochet.theory.disk_log_law { R = 1, E = 1, nu = 0.3, rho = 1,\n  v = 3 }"),
             Contains("error: s.lua:3: disk_log_law: 'v': must be below the sound speed 1.04828, is 3"));
  CHECK_THAT(mistake("ricochet.theory.fit_walton { psi1 = { 1, 2, 3, 4 },\n  psi2 = { 1, 2 }, e = { 1, 1, 1, 1 } }"),
             Contains("error: s.lua:3: fit_walton: 'psi2': must hold as many values as psi1, 4; holds 2"));
  CHECK_THAT(mistake("ricochet.theory.kuwabara_kono { eta = 0.1, ends = 'forces' }"),
             Contains("'ends' must be one of overlap, force, is 'forces' (did you mean 'force'?)"));
  CHECK_THAT(mistake("print(ricochet.theory.mav)"),
             Contains("error: s.lua:2: ricochet.theory has no 'mav' (did you mean 'maw'?)"));
  CHECK_THAT(mistake("ricochet.theory.mine = 1"), Contains("error: s.lua:2: ricochet.theory takes no new fields"));
  CHECK_THAT(mistake("ricochet.theory:rods { L = 1 }"),
             Contains("error: s.lua:2: theory.rods takes one table and is called with a dot"));
  CHECK_THAT(mistake("ricochet.theory.hertz { R = 1e300, E = 1e300, nu = 0, m = 1, v = 1 }"),
             Contains("error: s.lua:2: theory.hertz: 'h0' is too large or too small for a number at these values"));
}

TEST_CASE("ricochet theory lists what there is, ricochet theory errata the misprints") {
  const Workplace here;
  const Ended list = here.shell("ricochet theory"), errata = here.shell("ricochet theory errata"),
              wrong = here.shell("ricochet theory errat");
  CHECK((list.status == 0 && errata.status == 0 && wrong.status == 2));
  for (const theory::Theory& t : theory::theories()) CHECK_THAT(list.out, Contains(t.name + " { "));
  CHECK_THAT(list.out, Contains("valid: ") && Contains("source: maw1976"));
  CHECK_THAT(errata.out, Contains(fmt::format("{}. ", theory::errata().size())) &&
                             Contains("printed: D = (3/4) [(1 - nu)/E") && Contains("checked: ") &&
                             Contains("printed: mu has a peak around Psi1 = 3") && Contains("can be had: "));
  CHECK_THAT(wrong.err, Contains("did you mean 'errata'?"));
}
