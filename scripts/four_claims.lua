-- Four claims of Hayakawa & Kuninaka 2003, section V, side by side under the paper's words and under the reading that
-- gives each best, as lua/ricochet/readings.lua has them: e falls past Psi1 = 6 where an impact is over at the first
-- parting; its mean exceeds 1 with 2400 nodes and a wall of 1/50; mu peaks at 3 where the disk's rim is the hull of its
-- nodes; the hard wall is even and then rises above 1 with coarse, gentle rims.
-- The readings were chosen before these lattices were run: seeds begin at 2001, which no other script uses. `samples`:
-- lattices a point; two minutes on two cores by default. `full=true`: 100, twenty minutes.
local ricochet = require "ricochet"
local readings = require "ricochet.readings"
local rows_of = require("ricochet.rows").rows_of

local p = ricochet.parameters {
  samples  = { 8, int = true, min = 2, doc = "random lattices a point" },
  seeds    = { 2000, int = true, min = 0, doc = "added to every sample's seed" },
  nodes    = { 800, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
  soft     = { { 1, 2, 3, 4, 4.5, 6, 8, 10 }, min = 0, doc = "tangents of the incident angle, soft wall" },
  hard     = { { 0, 1, 2, 3, 4, 4.5, 5, 6 }, min = 0, doc = "tangents of the incident angle, hard wall" },
  parted   = { readings.parted, min = 1e-6, max = 0.5, doc = "share of its greatest force at which a touch is over" },
  accuracy = { 3e-3, min = 1e-6, max = 0.1, doc = "wanted error of e from the time step" },
  full     = { false, doc = "100 lattices" },
}
local samples, list = p.full and 100 or p.samples, {}
for k = 1, samples do list[k] = k + p.seeds end

-- Each claim: its panel, the wall, the column, and the reading that gives it best.
local claims = {
  { panel = "falls", wall = "soft", of = "e", best = "first parting" },
  { panel = "exceeds", wall = "soft", of = "e", best = "2400 nodes, 1/50" },
  { panel = "peaks", wall = "soft", of = "mu", best = "hull of the disk" },
  { panel = "rises", wall = "hard", of = "e", best = "coarse, gentle rims" },
}
local words = "the paper's words"

-- The impacts of a reading on a wall, made once.
local made = {}
local function rows_for(reading, wall)
  local run = reading.first or reading.name
  local key = wall .. " " .. run
  made[key] = made[key] or ricochet.sweep {
    name = ("four_claims_%s_%s"):format(wall, run:lower():gsub("%W+", "_")),
    over = { sample = list, psi1 = p[wall] },
    scene = function(at)
      return readings.scene(readings.by_name[run], p.nodes,
        { sample = at.sample, wall = wall, parted = p.parted,
          launch = { speed = 0.1, psi1 = at.psi1 } }, p.accuracy)
    end,
  }:run()
  return made[key]
end

local all = {}
for _, claim in ipairs(claims) do
  for _, name in ipairs { words, claim.best } do
    local reading, own = readings.by_name[name], {}
    for i, row in ipairs(rows_for(reading, claim.wall)) do
      local column = reading.first and claim.of .. "_first" or claim.of
      own[i] = { status = row.status, sample = row.sample, psi1 = row.psi1, [claim.of] = row[column],
        reading = ("%s, %s wall"):format(name == words and words or "the best reading", claim.wall) }
      local shown = { status = row.status, sample = row.sample, psi1 = row.psi1, reading = own[i].reading }
      for _, other in ipairs(claims) do shown[other.panel] = other == claim and row[column] or 0 / 0 end
      all[#all + 1] = shown
    end
    print(("\n%s, %s wall: %s"):format(claim.of, claim.wall, name))
    local rows = rows_of(own)
    rows:summary { by = "psi1", of = { claim.of } }:print()
    local peak = rows:peak { x = "psi1", of = claim.of, unit = "sample" }
    print(("greatest at Psi1 = %g (%g to %g with 95 %%), inside with %.3f"):format(peak.at, peak.low, peak.high,
      peak.inside))
  end
end

ricochet.plot {
  rows = rows_of(all), x = "psi1", y = { "falls", "exceeds", "peaks", "rises" }, by = "reading", name = "four_claims",
  title = "Four claims of the paper, by its words and by the best reading of each",
  ylabel = { falls = "e: falls past 6?", exceeds = "e: above 1?", peaks = "μ: peaks at 3?",
    rises = "e, hard wall: even, then up?" },
  caption = ("Best readings, from above: over at the first parting (force below %g %%); 2400 nodes and a wall of " ..
    "1/50; the disk's rim the hull of its nodes; rims of two spacings and 0.01 R. By the paper's words: %d + %d " ..
    "nodes at random, all of Delaunay's springs, forces along the spring's normal. %d lattices a point."):format(
    100 * p.parted, p.nodes, 5 * p.nodes, samples),
}
