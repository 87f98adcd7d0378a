-- e of a smooth disk of finite elements on a rigid plane, head on, against Poisson's ratio at several speeds, beside
-- that of the same disk by its vibrations (ricochet.theory.modal_disk, after Gerl & Zippelius 1999). Does e fall as nu
-- grows? c_P = sqrt(E/(rho (1 - nu^2))) is the speed of pressure waves in a sheet. `samples`: meshes a point, turned by
-- shares of a node's spacing. `full=true`: meshes of half the side and eleven ratios, 3 minutes on two cores.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nu       = { { 0, 0.1, 0.2, 0.33, 0.45 }, min = 0, max = 0.49, doc = "Poisson's ratios, rising" },
  speed    = { { 0.01, 0.02, 0.04, 0.07, 0.1 }, unit = "c_P", min = 1e-3, max = 0.1, doc = "impact speeds, rising" },
  samples  = { 3, int = true, min = 1, doc = "meshes a point" },
  h_min    = { 0.03, unit = "R", min = 0.005, max = 0.2, doc = "side of the smallest triangles; half with full=true" },
  hardness = { 600, min = 50, doc = "of the contact: 1/xi is the expected indentation over this" },
  full     = { false, doc = "the figure in full" },
}
local nus, speeds, h_min = p.nu, p.speed, p.h_min
if p.full then nus, h_min = { 0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.33, 0.37, 0.41, 0.45 }, p.h_min / 2 end

local E, density = 1e4, 800 / math.pi
local function wave_speed(nu) return math.sqrt(E / (density * (1 - nu ^ 2))) end

local rows = ricochet.sweep {
  name = "poisson_ratio",
  over = { sample = ricochet.range(p.samples), nu = nus, v = speeds },
  scene = function(at)
    local disk = ricochet.disk { interior = "elements", E = E, nu = at.nu, h_min = h_min, h_max = 4 * h_min }
    local turn = math.deg(h_min) * (at.sample - 1) / p.samples
    local function scene(contact)
      return ricochet.scene { projectile = ricochet.rotated { body = disk, angle = turn }, target = ricochet.plane {},
        launch = { speed = at.v * wave_speed(at.nu) }, contact = contact, accuracy = 1e-4 }
    end
    return scene { xi = p.hardness / ricochet.estimate(scene {}).overlap.value }
  end,
}:run()

local modal = {}
local function by_modes(nu, v)
  local key = ("%g %g"):format(nu, v)
  modal[key] = modal[key] or ricochet.theory.modal_disk { nu = nu, speed = v, alpha = 500 / math.sqrt(v) }.e
  return modal[key]
end
for _, row in ipairs(rows) do row.difference = row.e - by_modes(row.nu, row.v) end

local lines = {}
for i, v in ipairs(speeds) do
  lines[i] = { name = ("modes, %g c_P"):format(v), points = {} }
  for k, nu in ipairs(nus) do lines[i].points[k] = { nu, by_modes(nu, v) } end
end

-- Whether e falls from the first ratio to the last at each speed, by elements and by modes.
print(("%8s %32s %32s"):format("v / c_P", "e at nu = " .. table.concat(nus, " "), "by modes"))
local falls = {}
for i, v in ipairs(speeds) do
  local elements, modes, of, greatest = {}, {}, {}, 1
  for k, line in ipairs(rows:where { v = v }:summary { by = "nu", of = { "e" } }) do
    of[k] = line.e.mean
    if of[k] > of[greatest] then greatest = k end
    elements[k], modes[k] = ("%.4f"):format(line.e.mean), ("%.4f"):format(by_modes(line.nu, v))
  end
  falls[i] = of[#of] - of[1]
  print(("%8.3g  %s   %s   from the first nu to the last %+.4f, by modes %+.4f; greatest at nu = %g"):format(v,
    table.concat(elements, " "), table.concat(modes, " "), falls[i],
    by_modes(nus[#nus], v) - by_modes(nus[1], v), nus[greatest]))
end
for i = 2, #speeds do
  if falls[i - 1] > 0 and falls[i] <= 0 then
    local share = falls[i - 1] / (falls[i - 1] - falls[i])
    print(("from nu = %g to %g e rises below %.3f c_P, and falls above"):format(nus[1], nus[#nus], speeds[i - 1]
      * (speeds[i] / speeds[i - 1]) ^ share))
  end
end
rows:summary { by = "v", of = { "difference", "indentation" } }:print()

ricochet.plot {
  rows = rows, x = "nu", y = { "e", "difference" }, by = "v", name = "poisson_ratio",
  xlabel = "Poisson's ratio ν", ylabel = { difference = "e − e of the modes" }, theory = { e = lines },
  title = "Smooth disk of finite elements on a rigid plane, head on; v in c_P",
  caption = ("Plane stress, sides from %g R on, %d meshes a point, 1/ξ = indentation/%g."):format(h_min, p.samples,
    p.hardness),
}
