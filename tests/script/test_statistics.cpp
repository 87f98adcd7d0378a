// Errors that are errors: what this library calls seen is so by chance in one of twenty cases, and no more.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

/// Deviates of a normal law, and the share of repetitions in which `seen()` holds.
const char* repetitions = R"(local student = require "ricochet.student"
local statistics = require "ricochet.statistics"
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
local function share(count, seen)
  math.randomseed(7)
  local n = 0
  for _ = 1, count do if seen() then n = n + 1 end end
  return n / count
end
local function is_stated(share, what) assert(share > 0.04 and share < 0.06, what .. ": " .. share) end
)";

Ended ran(const std::string& text) {
  const Ended ended = script_with_module(repetitions + text);
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  return ended;
}

}  // namespace

TEST_CASE("Student's t has the values of its closed forms and tables to 1e-10") {
  ran(R"(local function near(a, b, what) assert(math.abs(a / b - 1) < 1e-10, what .. ": " .. ("%.17g"):format(a)) end
for _, t in ipairs { 0.1, 1, 2.5, 40 } do
  near(student.within(t, 1), 2 / math.pi * math.atan(t), "n = 1")
  near(student.within(t, 2), t / math.sqrt(2 + t * t), "n = 2")
  near(student.within(t, 4), t * (t * t + 6) / (t * t + 4) ^ 1.5, "n = 4")
end
-- By 60 digits of the incomplete beta function.
for n, t in pairs { [1] = 12.706204736174705, [2] = 4.302652729749462, [3] = 3.1824463052837091,
    [7] = 2.3646242515927849, [10] = 2.2281388519862747, [30] = 2.0422724563012379, [1000] = 1.9623390808264078 } do
  near(student.quantile(n), t, "n = " .. n)
end
near(student.quantile(5, 0.99), 4.0321429835552278, "99 %")
assert(math.abs(student.quantile(200000) - 1.9599639845) < 3e-5)
)");
}

TEST_CASE("a change is seen by chance in one of twenty cases with 2, 4 and 8 samples") {
  ran(R"(for _, samples in ipairs { 2, 4, 8 } do
  is_stated(share(8000, function()
    local values = {}
    for i = 1, samples do values[i] = normal() end
    local of = statistics.of(values)
    return student.is_seen(of.mean, of.se, of.count - 1)
  end), samples .. " samples")
end
)");
}

TEST_CASE("the slope of a plan is seen by chance in one of twenty cases with 2, 4 and 8 samples") {
  ran(R"(local size_error = require("ricochet.plan_sizes").error
for _, samples in ipairs { 2, 4, 8 } do
  is_stated(share(6000, function()
    local sizes = {}
    for i, factor in ipairs { 0.25, 0.5, 1 } do
      local values = {}
      for k = 1, samples do values[k] = 0.7 + 0.02 * normal() end
      local of = statistics.of(values)
      sizes[i] = { factor = factor, { mean = of.mean, sd = of.sd, freedom = of.count - 1 } }
    end
    return select(3, size_error(sizes, 1))
  end), samples .. " samples")
end
)");
}

TEST_CASE("an exponent is off by more than its interval says in one of twenty cases, lattices being alike or not") {
  ran(R"(local power_law = require "ricochet.power_law"
-- e of a lattice: an offset of its own, which falls out, a slope of its own, which does not, and scatter.
for _, samples in ipairs { 2, 4, 8 } do
  is_stated(share(4000, function()
    local rows = {}
    for sample = 1, samples do
      local offset, slope = 0.3 * normal(), 0.1 * normal()
      for _, v in ipairs { 0.01, 0.02, 0.05, 0.1 } do
        local y = -0.2 * math.log(v) + offset + slope * math.log(v) + 0.02 * normal()
        rows[#rows + 1] = { sample = sample, v = v, e = math.exp(y) }
      end
    end
    local law = power_law(rows, "v", "e", "sample")
    assert(law.freedom == samples - 1)
    return law.low > -0.2 or law.high < -0.2
  end), samples .. " lattices")
end
)");
}

TEST_CASE("a power law says why its exponent has no error, and refuses a row without a place") {
  ran(R"(local power_law = require "ricochet.power_law"
local nan = 0 / 0
local function rows(samples, change)
  local list = {}
  for s, sample in ipairs(samples) do
    for k, v in ipairs { 1, 2, 4 } do
      list[#list + 1] = { sample = sample, v = v, e = (0.5 + 0.01 * s * k) * v ^ -0.25 }
    end
  end
  if change then change(list) end
  return power_law(list, "v", "e", "sample")
end
local one = rows { 1 }
assert(one.se ~= one.se and one.low ~= one.low and one.reason:find "share one lattice", one.reason)
local hangs = rows({ 1, 2 }, function(list) for i = 1, 3 do list[i].v = 2 end end)
assert(hangs.se ~= hangs.se and hangs.reason:find "hangs on one lattice", hangs.reason)
local two = rows { 1, 2 }
assert(two.se > 0 and two.freedom == 1 and two.count == 6 and two.reason == "")
assert(rows({ 1, 2 }, function(list) list[2].e = nan end).count == 5)
local fine, message = pcall(rows, { 1, 2 }, function(list) list[2].v = nan end)
assert(not fine and tostring(message):find("'v' is undefined (nan) in a row", 1, true), tostring(message))
)");
}

TEST_CASE("points that agree to four digits are two to a plan") {
  ran(R"(local pilot = require "ricochet.plan_pilot"
local function name(value) return pilot.name_of({ psi1 = value, sample = 3 }, { "psi1", "sample" }, "sample") end
assert(name(1.00001) == "psi1=1.00001" and name(1.00002) == "psi1=1.00002" and name(0.1) == "psi1=0.1")
assert(name(1 / 3) ~= name(0.3333333333333333 + 1e-16) and name(2) == "psi1=2" and name "a" == "psi1=a")
)");
}

TEST_CASE("what an effect draws is another in each sample of relevance") {
  const Ended ended = script_with_module(R"(
local result = ricochet.relevance { scene = ricochet.scene {
    projectile = ricochet.disk { nodes = 60, placement = "triangular" }, target = ricochet.plane {} },
  effects = { ricochet.thermal { temperature = 1e-5 } }, of = { "e" }, samples = 6 }
assert(result[1].e.se > 0, result[1].e.se)
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("paired differences leave out what a lattice has everywhere, and are seen by chance in one of twenty cases") {
  ran(R"(local paired = require "ricochet.paired"
local gain, n = 0, 3000
is_stated(share(n, function()
  local rows = {}
  for sample = 1, 6 do
    local own = normal()
    for _, psi1 in ipairs { 6, 8 } do
      rows[#rows + 1] = { status = "finished", sample = sample, psi1 = psi1, e = own + 0.5 * normal() }
    end
  end
  rows[3].status = "tunnelled"  -- its lattice has no difference
  local of = paired(rows, "psi1", "e", { 6, 8 }, "sample")
  assert(of.units == 5 and of.freedom == 4 and (of.low > 0 or of.high < 0) == of.is_seen)
  gain = gain + math.log(of.gain) / n
  return of.is_seen
end), "6 lattices")
assert(math.abs(math.exp(gain) - 5) < 1, math.exp(gain))  -- (1.25 + 1.25) / 0.5, of few: somewhat more
local alone = { { psi1 = 6, e = 1, sample = 1, status = "finished" } }
local fine, message = pcall(paired, alone, "psi1", "e", { 6, 7 }, "sample")
assert(not fine and tostring(message):find("no row has psi1 = 7", 1, true), tostring(message))
)");
}
