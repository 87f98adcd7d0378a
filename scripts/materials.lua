-- Smooth disks of six materials on a rigid plane, head on, against the speed, in SI, beside what `ricochet.estimate`
-- says before anything runs. Each material at those speeds at which it warns of nothing: neither is the contact one of
-- few nodes, nor do springs fold. (That the pressure passes the yield stress is told, and left out of the physics.)
-- `samples`: lattices a point; `full=true`: finer lattices, which reach to lower speeds.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 4, int = true, min = 1, doc = "lattices a point" },
  nodes   = { 1600, int = true, min = 400, doc = "nodes of a disk; four times as many with full=true" },
  radius  = { 0.005, unit = "m", min = 1e-6, doc = "of the disks" },
  full    = { false, doc = "the figure in full" },
}

local names = { "steel", "aluminium", "glass", "pmma", "ice", "rubber" }
local speeds = { 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200 }
local nodes = p.full and 4 * p.nodes or p.nodes

local function scene_of(name, speed, seed)
  return ricochet.scene {
    units = "SI",
    projectile = ricochet.disk { radius = p.radius, material = ricochet.materials[name], nodes = nodes, seed = seed },
    target = ricochet.plane {},
    launch = { speed = speed },
  }
end

local function sound(estimate)
  for _, warning in ipairs(estimate.warnings) do
    if warning.kind ~= "over_yield" then return false end
  end
  return true
end

local points, estimates = {}, {}
for _, name in ipairs(names) do
  for _, speed in ipairs(speeds) do
    local estimate = ricochet.estimate(scene_of(name, speed, 1))
    if sound(estimate) then
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
  row.time_ratio = row.contact_time / of.estimate.contact_time.value
  row.depth_ratio = row.overlap / of.estimate.overlap.value
end

print(("%-10s %8s %8s %8s %10s %10s %10s %10s %10s"):format("material", "v [m/s]", "v/c_P", "e", "t [us]", "est. [us]",
  "F est.[N]", "p est.[MPa]", "over_yield"))
for _, line in ipairs(rows:summary { by = "point", of = { "e", "contact_time", "over_yield" } }) do
  local of = estimates[line.point]
  print(("%-10s %8g %8.2g %8.4f %10.4g %10.4g %10.3g %10.3g %10s"):format(of.name, of.speed,
    of.speed / of.estimate.wave_speed.value, line.e.mean, 1e6 * line.contact_time.mean,
    1e6 * of.estimate.contact_time.value, of.estimate.force.value, of.estimate.pressure.value / 1e6,
    line.over_yield.count == 0 and "-" or line.over_yield.mean == 1 and "yes" or "no"))
end

ricochet.plot {
  rows = rows, x = "speed", y = { "e", "time_ratio", "depth_ratio" }, by = "material", name = "materials", log = "x",
  xlabel = "speed [m/s]",
  ylabel = { time_ratio = "contact time / estimate", depth_ratio = "overlap / estimate" },
  yrange = { time_ratio = { 0.8, 1.25 }, depth_ratio = { 0.8, 1.25 } },
  theory = { time_ratio = { { name = "estimate", f = function() return 1 end } },
             depth_ratio = { { name = "estimate", f = function() return 1 end } } },
  title = "Disks of six materials on a rigid plane, head on: elastic, nothing yields",
  caption = ("Radius %g mm, length 1 m, plane stress, %d nodes (Poisson disks), %d lattices a point."):format(
    1e3 * p.radius, nodes, p.samples),
}
