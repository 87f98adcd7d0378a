-- Two rods of one section and material meet end on: a compression runs through each, and comes back from its free
-- end as a tension that parts them. The shorter one, of length L1, is then at rest, whatever the speed: e = L1/L2, the
-- ratio of lengths (Saint-Venant 1867). The energy that is missing runs up and down in the longer one. Elements with
-- nu = 0 and nu = 0.3, whose sides move too, and a lattice; the limit is that of slender rods, fine meshes and a hard
-- contact. Pictures: e against the ratio; what it misses against the slenderness (rods_slender.png); the waves
-- (rods_waves.png). `samples`: how many slenderness ratios, meshes and contacts (2 to 4). `full=true`: four of each,
-- 165 s of one core.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples  = { 3, int = true, min = 2, max = 4, doc = "slenderness ratios, meshes, contacts" },
  speed    = { 0.005, unit = "sqrt(E/rho)", min = 1e-4, max = 0.02, doc = "impact speed" },
  rows     = { 6, int = true, min = 2, max = 48, doc = "rows of nodes across a rod" },
  hardness = { 1600, min = 10, doc = "of the contact, xi speed L1 over sqrt(E/rho)" },
  full     = { false, doc = "the figure in full" },
}
local samples = p.full and 4 or p.samples

local E, density = 1e4, 800 / math.pi
local c0 = math.sqrt(E / density)
local pairs_of_lengths = { { 1, 1 }, { 1, 2 }, { 1, 3 }, { 2, 3 } }

-- What a rod is of. Springs of constant k along a triangular lattice have E = 2 k/sqrt(3).
local kinds = {
  ["nu = 0"]    = { interior = "elements", E = E, nu = 0 },
  ["nu = 0.3"]  = { interior = "elements", E = E, nu = 0.3 },
  ["lattice"]   = { stiffness = E * math.sqrt(3) / 2 },
}
local kind_names = { "nu = 0", "nu = 0.3", "lattice" }

-- Of this length, `low` its lower end. A triangular lattice has 2/sqrt(3) nodes a square of its spacing.
local function rod(kind, width, length, low, rows)
  local spacing = width / rows
  local fields = {
    outline = { { -width / 2, low }, { width / 2, low }, { width / 2, low + length }, { -width / 2, low + length } },
    nodes = math.floor(2 / math.sqrt(3) * width * length / spacing ^ 2 + 0.5), placement = "triangular",
  }
  for name, value in pairs(kinds[kind]) do fields[name] = value end
  return ricochet.body(fields)
end

-- at: kind, lengths, slenderness of the shorter rod, rows, speed over c0, hardness.
local function scene(at)
  local lengths = pairs_of_lengths[at.lengths]
  local width = lengths[1] / at.slenderness
  return ricochet.scene {
    projectile = rod(at.kind, width, lengths[1], 0, at.rows),
    target = rod(at.kind, width, lengths[2], -lengths[2], at.rows),
    launch = { speed = at.speed * c0 }, contact = { xi = at.hardness / (at.speed * lengths[1]) },
  }
end

local function ratio(lengths) return pairs_of_lengths[lengths][1] / pairs_of_lengths[lengths][2] end

-- The rows of a sweep around the usual rods, with what e misses of the ratio.
local function sweep(name, over)
  local usual = { kind = "nu = 0", lengths = 2, slenderness = 20, rows = p.rows, speed = p.speed,
    hardness = p.hardness }
  local rows = ricochet.sweep {
    name = name, over = over,
    scene = function(at)
      local all = {}
      for field, value in pairs(usual) do all[field] = value end
      for field in pairs(over) do all[field] = at[field] end
      return scene(all)
    end,
  }:run()
  for _, row in ipairs(rows) do
    row.ratio = ratio(over.lengths and row.lengths or usual.lengths)
    row.missing = row.e_n / row.ratio - 1
  end
  return rows
end

local function first(list) return { table.unpack(list, 1, samples) } end

local by_length = sweep("rods", { kind = kind_names, lengths = { 1, 2, 3, 4 } })
local slender = sweep("rods_slender", { kind = kind_names, slenderness = first { 10, 20, 40, 80 } })
local meshes = sweep("rods_mesh", { rows = first { 3, 6, 12, 24 }, lengths = { 2, 4 } })
local contacts = sweep("rods_contact", { hardness = first { 200, 400, 800, 1600 }, lengths = { 2, 4 } })
local speeds = sweep("rods_speed", { speed = { p.speed / 2, p.speed, 2 * p.speed }, lengths = { 1, 2, 3, 4 } })

print(("%-9s %9s %9s %10s"):format("rod", "L1/L2", "e", "e L2/L1 - 1"))
for _, row in ipairs(by_length) do
  print(("%-9s %9.4f %9.4f %+10.4f"):format(row.kind, row.ratio, row.e_n, row.missing))
end
local function tell(name, rows, column)
  for _, row in ipairs(rows) do
    print(("%s %-9s %-9s L1/L2 %.4f: e L2/L1 - 1 = %+.4f"):format(name, row[column], rawget(row, "kind") or "",
      row.ratio, row.missing))
  end
end
tell("slenderness", slender, "slenderness")
tell("rows", meshes, "rows")
tell("hardness", contacts, "hardness")
for lengths = 1, 4 do
  local low, high = math.huge, -math.huge
  for _, row in ipairs(speeds:where { lengths = lengths }) do
    low, high = math.min(low, row.e_n), math.max(high, row.e_n)
  end
  print(("L1/L2 = %.4f: e at three speeds, a factor of 4 apart, within %.2g"):format(ratio(lengths), high - low))
end

ricochet.plot {
  rows = by_length, x = "ratio", y = { "e_n", "missing" }, by = "kind", name = "rods",
  xlabel = "L1/L2", ylabel = { e_n = "e", missing = "e L2/L1 − 1" },
  theory = { e_n = { { name = "L1/L2", f = function(x) return x end } } },
  title = "Rods that meet end on rebound by their ratio of lengths",
  caption = ("The shorter one 20 widths long, %d rows across, v = %g c0, contact ξ v L1 = %g c0."):format(p.rows,
    p.speed, p.hardness),
}
ricochet.plot {
  rows = slender, x = "slenderness", y = { "missing" }, by = "kind", name = "rods_slender",
  xlabel = "length of the shorter rod over its width", ylabel = { missing = "e L2/L1 − 1" },
  title = "Slender rods are nearer to the ratio of lengths; L1/L2 = 1/2",
  caption = ("%d rows across, v = %g c0, contact ξ v L1 = %g c0."):format(p.rows, p.speed, p.hardness),
}
ricochet.waves {
  scene = scene { kind = "nu = 0", lengths = 2, slenderness = 20, rows = p.rows, speed = p.speed,
    hardness = p.hardness },
  name = "rods_waves", duration = 6 / c0, slices = 150, points = 300,
  title = "A rod meets one of twice its length: what moves, where and when",
  caption = "The projectile stands still when the wave has come back; the target goes on, and rings.",
}
