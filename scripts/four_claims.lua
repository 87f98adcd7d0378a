-- Four claims of Hayakawa & Kuninaka 2003, section V, side by side under the paper's words and under the reading that
-- gives each best, as lua/ricochet/readings.lua has them: e falls past Psi1 = 6 where an impact is over at the first
-- parting; its mean exceeds 1 with 2400 nodes and a wall of 1/50; mu peaks at 3 where the disk's rim is the hull of its
-- nodes; the hard wall is even and then rises above 1 with coarse, gentle rims.
-- The readings were chosen before these lattices were run: seeds begin at 2001, which no other script uses. `samples`:
-- lattices a point; two minutes on two cores by default. `full=true`: 100, twenty minutes. `claim`: one of them alone,
-- by the reading that gives it. `V0`, `xi`, `sides`: another contact than that of the paper's scenes; beside each mean
-- stands how deep the deepest node of a rim stood inside the other body.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"
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
  claim    = { "all", choices = { "all", "falls", "exceeds", "peaks", "rises" },
    doc = "which claim; one alone is shown by its best reading alone" },
  V0       = { figures.contact.V0, unit = "m0 c^2", min = 1e-3, doc = "energy of a rim node that touches a segment" },
  xi       = { figures.contact.xi, unit = "1/R", min = 10, doc = "how steeply the contact's energy falls" },
  sides    = { figures.contact.sides, choices = { "one", "two" }, doc = "whose nodes are pushed: the disk's; or both" },
  full     = { false, doc = "100 lattices" },
}
local samples = p.full and 100 or p.samples
local list = ricochet.range(p.seeds + 1, p.seeds + samples)

-- Each claim: its panel, the wall, the column, and the reading that gives it best.
local claims = {
  { panel = "falls", asked = "e: falls past 6?", wall = "soft", of = "e", best = "first parting",
    doc = ("over at the first parting (force below %g %%)"):format(100 * p.parted) },
  { panel = "exceeds", asked = "e: above 1?", wall = "soft", of = "e", best = "2400 nodes, 1/50",
    doc = "2400 nodes and a wall of 1/50" },
  { panel = "peaks", asked = "μ: peaks at 3?", wall = "soft", of = "mu", best = "hull of the disk",
    doc = "the disk's rim the hull of its nodes" },
  { panel = "rises", asked = "e, hard wall: even, then up?", wall = "hard", of = "e", best = "coarse, gentle rims",
    doc = "rims of two spacings and 0.01 R" },
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
        { sample = at.sample, wall = wall, parted = p.parted, contact = { V0 = p.V0, xi = p.xi, sides = p.sides },
          launch = { speed = 0.1, psi1 = at.psi1 } }, p.accuracy)
    end,
  }:run()
  return made[key]
end

-- Impacts as they are drawn: each once, whatever panels it stands in.
local drawn, drawn_of = {}, {}
local function drawn_for(rows, name, wall)
  if drawn_of[rows] then return drawn_of[rows] end
  local list = {}
  for i, row in ipairs(rows) do
    list[i] = { status = row.status, sample = row.sample, psi1 = row.psi1,
      reading = ("%s, %s wall"):format(name == words and words or "the best reading", wall) }
    for _, claim in ipairs(claims) do list[i][claim.panel] = 0 / 0 end
    drawn[#drawn + 1] = list[i]
  end
  drawn_of[rows] = list
  return list
end

local panels, labels, docs = {}, {}, {}
for _, claim in ipairs(claims) do
  local is_alone, names = p.claim == claim.panel, {}
  if is_alone or p.claim == "all" then
    names = is_alone and { claim.best } or { words, claim.best }
    panels[#panels + 1], labels[claim.panel], docs[#docs + 1] = claim.panel, claim.asked, claim.doc
  end
  for _, name in ipairs(names) do
    local reading, own = readings.by_name[name], {}
    local rows = rows_for(reading, claim.wall)
    local shown = drawn_for(rows, name, claim.wall)
    for i, row in ipairs(rows) do
      local value = row[reading.first and claim.of .. "_first" or claim.of]
      own[i] = { status = row.status, sample = row.sample, psi1 = row.psi1, [claim.of] = value,
        penetration = row.penetration }
      shown[i][claim.panel] = value
    end
    print(("\n%s, %s wall: %s"):format(claim.of, claim.wall, name))
    local of_claim = rows_of(own)
    of_claim:summary { by = "psi1", of = { claim.of, "penetration" } }:print()
    local peak = of_claim:peak { x = "psi1", of = claim.of, unit = "sample" }
    print(("greatest at Psi1 = %g (%g to %g with 95 %%), inside with %.3f"):format(peak.at, peak.low, peak.high,
      peak.inside))
  end
end

local is_all = p.claim == "all"
local by_words = "By the paper's words: nodes at random, all of Delaunay's springs, forces along the spring's normal. "
local caption = ("%s: %s. %sContact: V0 = %g, ξ = %g/R, sides = %s. %d + %d nodes unless told, %d lattices a point.")
  :format(is_all and "Best readings, from above" or "Reading", table.concat(docs, "; "), is_all and by_words or "",
    p.V0, p.xi, p.sides, p.nodes, 5 * p.nodes, samples)
ricochet.plot {
  rows = rows_of(drawn), x = "psi1", y = panels, by = "reading", name = "four_claims", ylabel = labels,
  title = is_all and "Four claims of the paper, by its words and by the best reading of each"
    or "A claim of the paper, by the reading that gives it",
  caption = caption,
}
