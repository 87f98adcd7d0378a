// The bootstrap and the place of a peak, on distributions whose answers are known.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace ricochet::test;

namespace {

const char* normal_numbers = R"(
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
local function normals(n, mean, sd)
  local list = {}
  for i = 1, n do list[i] = mean + sd * normal() end
  return list
end
local function near(a, b, by, what) assert(math.abs(a - b) <= by, what .. ": " .. a .. " for " .. b) end
math.randomseed(11)
)";

void ran(const std::string& text) {
  const Ended ended = script_with_module(normal_numbers + text);
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
}

}  // namespace

TEST_CASE("bootstrap: the error of a mean is that of the sample, and draws are each as likely") {
  ran(R"(local statistics = require "ricochet.statistics"
local values = normals(25, 3, 2)
local of, drawn = statistics.of(values), ricochet.bootstrap { values = values, resamples = 20000 }
near(drawn.value, of.mean, 1e-12, "mean")
-- Drawn from the sample itself, whose variance is (n - 1)/n of what estimates the law's.
near(drawn.se / (of.se * math.sqrt(24 / 25)), 1, 0.02, "se")
near((drawn.high - drawn.low) / (2 * 1.96 * drawn.se), 1, 0.03, "width")
local again = ricochet.bootstrap { values = values, resamples = 20000 }
assert(again.se == drawn.se and again.low == drawn.low)
assert(ricochet.bootstrap { values = values, seed = 2 }.se ~= ricochet.bootstrap { values = values }.se)
local counts, resamples = { 0, 0, 0, 0, 0, 0 }, 10000
ricochet.bootstrap { values = { 1, 2, 3, 4, 5, 6 }, resamples = resamples, of = function(list)
  for _, face in ipairs(list) do counts[face] = counts[face] + 1 end
  return list[1]
end }
for face, count in ipairs(counts) do near(count, resamples + 1, 5 * math.sqrt(resamples * 5 / 6), "face " .. face) end
)");
}

TEST_CASE("bootstrap: intervals of a mean, a deviation and an exponential median hold the true ones as often as told") {
  ran(R"(local function share_of(count, sample, of, truth)
  local held = 0
  for k = 1, count do
    local drawn = ricochet.bootstrap { values = sample(), of = of, resamples = 300, seed = k }
    if drawn.low <= truth and truth <= drawn.high then held = held + 1 end
  end
  return held / count
end
local function median(list)
  table.sort(list)
  local n = #list
  return n % 2 == 1 and list[(n + 1) / 2] or (list[n / 2] + list[n / 2 + 1]) / 2
end
near(share_of(1000, function() return normals(8, 1, 1) end, nil, 1), 0.89, 0.03, "mean of 8")
near(share_of(1000, function() return normals(40, 1, 1) end, nil, 1), 0.94, 0.025, "mean of 40")
local function exponentials()
  local list = {}
  for i = 1, 41 do list[i] = -math.log(1 - math.random()) end
  return list
end
near(share_of(1000, exponentials, median, math.log(2)), 0.945, 0.03, "median of 41")
)");
}

TEST_CASE("bootstrap: no more than one resample is held at a time") {
  const Workplace here;
  here.write("s.lua", R"(local values = {}
for i = 1, 20000 do values[i] = i end
local drawn = require "ricochet".bootstrap { values = values, resamples = 1000, of = function(list) return list[1] end }
assert(math.abs(drawn.se / 20000 * math.sqrt(12) - 1) < 0.05, drawn.se))");
  // All draws at once would be 320 MB.
  const Ended ended = here.shell("ulimit -v 250000; ricochet run s.lua --quiet --force");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("bootstrap: what has no error says why, and what is no number is refused") {
  ran(R"(local one = ricochet.bootstrap { values = { 4, 0 / 0 } }
assert(one.value == 4 and one.se ~= one.se and one.count == 1 and one.reason:find "no scatter", one.reason)
local odd = ricochet.bootstrap { values = { 1, 2 }, of = function() return 0 / 0 end }
assert(odd.low ~= odd.low and odd.reason:find "undefined", odd.reason)
local fine, message = pcall(ricochet.bootstrap, { values = { 1, "a" } })
assert(not fine and tostring(message):find("element 2 is a string", 1, true), tostring(message))
fine, message = pcall(ricochet.bootstrap, { values = { 1, 2 }, of = function() return "a" end })
assert(not fine and tostring(message):find("returned a string", 1, true), tostring(message))
)");
}

TEST_CASE("peak: a parabola's is found where it is, held by its interval, and a flat line's lies anywhere") {
  ran(R"(local bootstrap = require "ricochet.bootstrap"
local places = { 1, 2, 3, 4, 5, 6 }
local function rows_of(lattices, height, scatter)
  local rows = {}
  for sample = 1, lattices do
    local own = normal()  -- of the lattice, which takes no part in where the peak is
    for _, x in ipairs(places) do
      rows[#rows + 1] = { status = "finished", sample = sample, x = x, y = own + height(x) + scatter * normal() }
    end
  end
  return rows
end
local function peak_of(rows, seed) return bootstrap.peak(rows, "x", "y", "sample", 200, seed, 0.95) end

-- Equal means have no greatest, and rounding makes none.
local level = peak_of(rows_of(16, function(x) return math.min(x, 3) end, 0), 1)
assert(level.at ~= level.at and level.inside ~= level.inside and level.reason:find "are equal", level.reason)
local sharp = peak_of(rows_of(20, function(x) return -(x - 4) ^ 2 end, 0.3), 1)
assert(sharp.at == 4 and sharp.low == 4 and sharp.high == 4 and sharp.inside == 1 and sharp.units == 20)
local sum = 0
for _, place in ipairs(sharp.shares) do sum = sum + place.share end
near(sum, 1, 1e-12, "shares")

local held, count = 0, 400
for k = 1, count do
  local peak = peak_of(rows_of(16, function(x) return -0.1 * (x - 3) ^ 2 end, 1), k)
  if peak.low <= 3 and 3 <= peak.high then held = held + 1 end
end
assert(held / count >= 0.93, held / count)

local inside, wide = 0, 0
for k = 1, count do
  local peak = peak_of(rows_of(16, function() return 0 end, 1), k)
  inside, wide = inside + peak.inside / count, wide + (peak.high - peak.low) / count
end
near(inside, 4 / 6, 0.05, "inside of nothing")
assert(wide > 3.5, wide)

local rising = peak_of(rows_of(16, function(x) return x end, 0.5), 1)
assert(rising.at == 6 and rising.inside == 0)
local lost = rows_of(4, function(x) return -(x - 4) ^ 2 end, 0)
lost[4].status = "tunnelled"  -- one lattice has no row there; others tell
assert(peak_of(lost, 1).at == 4)
local series = rows_of(8, function(x) return -(x - 4) ^ 2 end, 0)
for _, row in ipairs(series) do row.status = nil end  -- as rows of a series are
assert(peak_of(series, 1).at == 4 and peak_of(series, 1).units == 8)
local alone = peak_of(rows_of(1, function(x) return x end, 0), 1)
assert(alone.at ~= alone.at and alone.reason:find "tell of no peak", alone.reason)
)");
}

TEST_CASE("peak: rows of a sweep have it as a method, with their lattices as units") {
  ran(R"(local rows = ricochet.sweep { name = "peak", over = { sample = ricochet.range(3), psi1 = { 0, 1, 3 } },
  scene = function(at)
    return ricochet.scene { launch = { psi1 = at.psi1 },
      projectile = ricochet.disk { nodes = 60, seed = at.sample, roughness = 0.03 },
      target = ricochet.wall { nodes = 150, stiffness = 400, seed = at.sample, width = 4, roughness = 0.03 } }
  end }:run()
local peak = rows:peak { x = "psi1", of = "mu", resamples = 50 }
assert(peak.units == 3 and #peak.shares == 3 and peak.shares[2].psi1 == 1)
local fine, message = pcall(rows.peak, rows, { x = "psi2", of = "mus" })
assert(not fine and tostring(message):find("the rows have no column 'mus'", 1, true), tostring(message))
)");
}
