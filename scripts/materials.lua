-- Smooth disks of six materials on a rigid plane, head on, against the speed, in SI, beside what `ricochet.estimate`
-- says before anything runs. Speeds beyond 0.1 of a material's wave speed are left out. `samples`: seeds of the lattice;
-- `full=true`: finer lattices and more speeds (about an hour on two cores).
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 4, int = true, min = 1, doc = "lattices a point" },
  nodes   = { 1600, int = true, min = 60, doc = "nodes of a disk; four times as many with full=true" },
  radius  = { 0.005, unit = "m", min = 1e-6, doc = "of the disks" },
  full    = { false, doc = "the figure in full" },
}

local names = { "steel", "aluminium", "glass", "pmma", "ice", "rubber" }
local speeds = p.full and { 1, 2, 5, 10, 20, 50, 100, 200, 400 } or { 1, 4, 20, 100, 400 }
local nodes = p.full and 4 * p.nodes or p.nodes

local function scene_of(name, speed, seed)
  return ricochet.scene {
    units = "SI",
    projectile = ricochet.disk { radius = p.radius, material = ricochet.materials[name], nodes = nodes,
      placement = "triangular", seed = seed },
    target = ricochet.plane {},
    launch = { speed = speed },
  }
end

-- Every point that a disk survives without folding, with what is estimated of it.
local points, estimates = {}, {}
for _, name in ipairs(names) do
  for _, speed in ipairs(speeds) do
    local estimate = ricochet.estimate(scene_of(name, speed, 1))
    if speed <= 0.1 * estimate.wave_speed.value then
      points[#points + 1] = ("%s %g"):format(name, speed)
      estimates[points[#points]] = { name = name, speed = speed, estimate = estimate }
    end
  end
end

local rows = ricochet.sweep {
  name = "materials",
  over = { point = points, sample = ricochet.range(p.samples) },
  scene = function(at)
    local of = estimates[at.point]
    return scene_of(of.name, of.speed, at.sample)
  end,
}:run()

for _, row in ipairs(rows) do
  local of = estimates[row.point]
  row.material, row.speed = of.name, of.speed
  row.share = of.speed / of.estimate.wave_speed.value
  row.time_ratio = row.contact_time / of.estimate.contact_time.value
  row.depth_ratio = row.indentation / of.estimate.overlap.value
end

print(("%-10s %8s %8s %8s %10s %10s %10s %10s  %s"):format("material", "v [m/s]", "v/c_P", "e", "t [us]", "est. [us]",
  "F est.[N]", "p est.[MPa]", "warnings of the estimate"))
for _, line in ipairs(rows:summary { by = "point", of = { "e", "contact_time" } }) do
  local of = estimates[line.point]
  local kinds = {}
  for _, warning in ipairs(of.estimate.warnings) do kinds[#kinds + 1] = warning.kind end
  print(("%-10s %8g %8.2g %8.4f %10.4g %10.4g %10.3g %10.3g  %s"):format(of.name, of.speed,
    of.speed / of.estimate.wave_speed.value, line.e.mean, 1e6 * line.contact_time.mean,
    1e6 * of.estimate.contact_time.value, of.estimate.force.value, of.estimate.pressure.value / 1e6,
    table.concat(kinds, ", ")))
end

ricochet.plot {
  rows = rows, x = "speed", y = { "e", "time_ratio", "depth_ratio" }, by = "material", name = "materials", log = "x",
  xlabel = "speed [m/s]",
  ylabel = { time_ratio = "contact time / estimate", depth_ratio = "indentation / estimate" },
  theory = { time_ratio = { { name = "estimate", f = function() return 1 end } },
             depth_ratio = { { name = "estimate", f = function() return 1 end } } },
  title = "Disks of six materials on a rigid plane, head on",
  caption = ("Radius %g mm, length 1 m, plane stress, %d nodes (triangular), %d lattices a point; up to 0.1 of the "
    .. "wave speed c_P. Elastic: no yielding."):format(1e3 * p.radius, nodes, p.samples),
}
