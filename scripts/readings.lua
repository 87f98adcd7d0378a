-- What the paper's model leaves open, and which reading of it gives which of its claims (Hayakawa & Kuninaka 2003,
-- section V). Each reading is run over the same lattices: the soft wall at Psi1 = 1, 3, 6, 10, a fixed normal speed
-- at 2 and 6, the hard wall at 0, 3, 6. For every claim: the numbers that must be above 0 for it, with their standard
-- errors; whether it is there, absent or undecided by so many lattices (95 %, Student's t); and by how much these
-- numbers differ from those of the first reading, lattice by lattice. Then where e and mu are greatest on the soft
-- wall, by a bootstrap over lattices. Where one segment alone pushes a node is what not to do: energy is gained or
-- lost, which the script allows (energy_tolerance = 10) and tells. `samples`: lattices a reading; two minutes on two
-- cores by default. `full=true`: 64, half an hour.
local ricochet = require "ricochet"
local readings = require "ricochet.readings"
local rows_of = require("ricochet.rows").rows_of
local statistics = require "ricochet.statistics"

local p = ricochet.parameters {
  samples  = { 8, int = true, min = 2, doc = "random lattices a reading" },
  seeds    = { 0, int = true, min = 0, doc = "added to every sample's seed: other lattices of the same kind" },
  nodes    = { 800, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
  full     = { false, doc = "64 lattices" },
}
local samples = p.full and 64 or p.samples
local list = ricochet.range(p.seeds + 1, p.seeds + samples)
local names, cases = {}, {}
for _, reading in ipairs(readings.list) do
  if not reading.first then names[#names + 1] = reading.name end
end
for case in pairs(readings.cases) do cases[#cases + 1] = case end
table.sort(cases)

local rows = ricochet.sweep {
  name = "readings", over = { sample = list, reading = names, case = cases },
  scene = function(at)
    local case = readings.cases[at.case]
    return readings.scene(readings.by_name[at.reading], p.nodes,
      { sample = at.sample, wall = case.wall, launch = case.launch })
  end,
}:run()

local function shown(terms)
  local parts = {}
  for i, term in ipairs(terms) do parts[i] = ("%+.3f ± %.3f"):format(term.mean, term.se) end
  return table.concat(parts, ", ")
end

local cells, deciding = {}, 0
for k, claim in ipairs(readings.claims) do
  print(("\n%s\n  above 0 if so: %s"):format(claim.name, claim.needs))
  local first
  for i, reading in ipairs(readings.list) do
    local numbers = readings.numbers(rows, reading, claim)
    local judged = readings.judged(numbers, claim)
    first = first or numbers
    local less = i > 1 and ("; less the first: %s"):format(shown(readings.difference(numbers, first, claim))) or ""
    print(("  %-28s %-9s %s (%d lattices)%s"):format(reading.name, judged.verdict, shown(judged.terms), judged.count,
      less))
    cells[#cells + 1] = { reading = #readings.list - i, claim = k, verdict = judged.verdict,
      score = readings.bounded(judged.score, 3) }
  end
end

print "\nreading: claims there, absent, undecided"
local nearest, most
for i, reading in ipairs(readings.list) do
  local count = { there = 0, absent = 0, undecided = 0 }
  for _, cell in ipairs(cells) do
    if cell.reading == #readings.list - i then count[cell.verdict] = count[cell.verdict] + 1 end
  end
  if count.undecided < #readings.claims then deciding = deciding + 1 end
  if not most or count.there - count.absent > most then nearest, most = reading.name, count.there - count.absent end
  print(("  %-28s %d %d %d   %s"):format(reading.name, count.there, count.absent, count.undecided, reading.doc))
end
print(("%d of %d readings decide a claim; nearest to all claims: %s"):format(deciding, #readings.list, nearest))

-- Rows of the soft wall with Psi1 and the columns of a reading, for peaks.
local function soft_rows(reading)
  local soft = {}
  for _, row in ipairs(rows) do
    if row.reading == (reading.first or reading.name) and row.case:find "^soft" then
      soft[#soft + 1] = { status = row.status, sample = row.sample, psi1 = readings.cases[row.case].launch.psi1,
        e = reading.first and row.e_first or row.e, mu = reading.first and row.mu_first or row.mu }
    end
  end
  return rows_of(soft)
end

print "\ngreatest mean on the soft wall: Psi1 (95 %), share of resamples in which it is neither at 1 nor at 10"
for _, reading in ipairs(readings.list) do
  local soft, parts = soft_rows(reading), {}
  for i, column in ipairs { "e", "mu" } do
    local peak = soft:peak { x = "psi1", of = column, unit = "sample" }
    parts[i] = ("%-2s %.3f at %g (%g to %g), inside %.2f"):format(column, peak.value, peak.at, peak.low, peak.high,
      peak.inside)
  end
  print(("  %-28s %s"):format(reading.name, table.concat(parts, "; ")))
end

print "\ngreatest drift of the energy, and mean change, as shares of the energy at the start"
for _, name in ipairs(names) do
  local most_drift, changes = 0, {}
  for _, row in ipairs(rows) do
    if row.reading == name and row.status == "finished" then
      most_drift, changes[#changes + 1] = math.max(most_drift, row.energy_drift), row.energy_closure
    end
  end
  local change = statistics.of(changes)
  print(("  %-28s %.2g, %+.2g ± %.1g (energy_tolerance %g)"):format(name, most_drift, change.mean, change.se,
    readings.by_name[name].tolerance or 0.01))
end

local ynames, xnames = {}, {}
for i, reading in ipairs(readings.list) do ynames[#readings.list + 1 - i] = reading.name end
for k, claim in ipairs(readings.claims) do xnames[k] = claim.name end
ricochet.heat_map {
  rows = rows_of(cells), x = "claim", y = "reading", of = "score", xnames = xnames, ynames = ynames, name = "readings",
  title = "Which reading of the model gives which claim of the paper",
  caption = ("Score: the least of the numbers that must be above 0 for a claim, over the half width of its " ..
    "interval of 95 %%. Above 1 the claim is there, below −1 it is absent, between it is undecided; beyond ±3 " ..
    "shown as ±3. " ..
    "%d lattices a reading, %d + %d nodes unless told."):format(samples, p.nodes, 5 * p.nodes),
}
