-- Elastic spheres of axisymmetric elements beside Hertz, Zener and the theory of radiated waves: four pictures.
--   elastic_sphere             on a rigid plane: force, overlap, time, and depth of the greatest von Mises stress over
--                              Hertz's, and 1 - e, against the speed
--   elastic_sphere_radiation   on a half-space of its own material: the energy that leaves it, against (v/c0)^(3/5) by
--                              Miller & Pursey's theory with Rayleigh waves, and Hunter's constant as Johnson quotes it
--   elastic_sphere_pulse       a steel ball on rock in SI: the force pulse of McLaskey & Glaser 2010
--   elastic_sphere_plate       on plates of several thicknesses, beside Zener 1941
-- c0 = sqrt(E/rho). `samples`: how many speeds and plates of the lists are used. `cells`: triangles along the contact's
-- radius. `full=true`: finer, and what doubling the half-space, the impedance of its edges and the mesh changes.
-- Forty seconds on two cores; 65 with `full=true`.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples  = { 6, int = true, min = 2, max = 6, doc = "speeds on the plane; two fewer on the half-space" },
  nu       = { { 0.25, 0.3 }, min = 0, max = 0.45, doc = "Poisson's ratios on the half-space" },
  cells    = { 8, min = 2, doc = "triangles along the contact's radius; 12 with full=true" },
  extent   = { 10, unit = "R", min = 3, doc = "radius and depth of the half-space's block" },
  full     = { false, doc = "the figure in full" },
}
local theory, E, density = ricochet.theory, 1e4, 800 / math.pi
local c0, mass = math.sqrt(E / density), 4 / 3 * math.pi * density
local cells = p.full and 1.5 * p.cells or p.cells

-- The first `count` of a list spread over `samples`, ends included.
local function some(list, count)
  local chosen = {}
  for k = 1, math.min(count, #list) do
    chosen[k] = list[math.floor(1.5 + (k - 1) * (#list - 1) / math.max(1, math.min(count, #list) - 1))]
  end
  return chosen
end

-- Hertz's impact at v [c0] on a rigid plane, or on what is of the same material.
local function hertz(nu, v, rigid)
  return theory.hertz { R = 1, m = mass, E = E, nu = nu, E2 = not rigid and E or nil, nu2 = not rigid and nu or nil,
    v = v * c0 }
end

local function ball(nu, h, a)
  return ricochet.sphere { E = E, nu = nu, h_min = h, h_max = math.max(0.15, h), fine_within = 1.3 * a }
end

-- Greatest force, and the depth of the greatest von Mises stress then, from a series.
local function at_most_force(rows)
  local most = rows[1]
  for _, row in ipairs(rows) do
    if row.force_n > most.force_n then most = row end
  end
  return most
end

-- A rigid plane: Hertz.
local nu_plane = 0.3
local plane_speeds = some({ 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2 }, p.samples)

local function on_plane(v)
  local a = hertz(nu_plane, v, true).a
  return ricochet.scene { projectile = ball(nu_plane, a / cells, a), target = ricochet.plane {},
    launch = { speed = v * c0 } }
end

local rows = ricochet.sweep { name = "elastic_sphere", over = { v = plane_speeds },
  scene = function(at) return on_plane(at.v) end }:run()
print(("on a rigid plane, nu = %g; over Hertz's: force, overlap, contact time; depth of the greatest stress over a"):
  format(nu_plane))
for k, row in ipairs(rows) do
  local law = hertz(nu_plane, row.v, true)
  local most = at_most_force(ricochet.series { scene = on_plane(row.v), points = 100, name = ("plane_%d"):format(k),
    of = { "force_n", "von_mises_max", "von_mises_depth" } })
  row.force_ratio, row.depth_ratio, row.time_ratio = most.force_n / law.F, row.overlap / law.h0,
    row.contact_time / law.t_c
  row.stress_depth, row.loss = most.von_mises_depth / law.a, 1 - row.e
  local p0 = 1.5 * law.F / (math.pi * law.a ^ 2)
  print(("v = %7.1e c0: %.4f %.4f %.4f  %.3f (0.48)  von Mises %.3f p0 (0.62)  1 - e = %.3e = %.3f v/c0"):format(row.v,
    row.force_ratio, row.depth_ratio, row.time_ratio, row.stress_depth, most.von_mises_max / p0, row.loss,
    row.loss / row.v))
end
local function one() return 1 end
ricochet.plot {
  rows = rows, x = "v", y = { "force_ratio", "depth_ratio", "time_ratio", "stress_depth", "loss" }, log = "x",
  name = "elastic_sphere", xlabel = "v / c0",
  ylabel = { force_ratio = "force / Hertz", depth_ratio = "overlap / Hertz", time_ratio = "time / Hertz",
    stress_depth = "depth of stress / a", loss = "1 − e" },
  yrange = { force_ratio = { 0.95, 1.15 }, depth_ratio = { 0.9, 1.05 }, time_ratio = { 0.9, 1.05 },
    stress_depth = { 0.3, 0.7 } },
  theory = { force_ratio = one, depth_ratio = one, time_ratio = one,
    stress_depth = { { name = "0.48", f = function() return 0.48 end } } },
  theory_name = "Hertz",
  title = "Elastic sphere on a rigid plane",
  caption = ("ν = %g, %g triangles along the contact's radius a. Law only."):format(nu_plane, cells),
}

-- A half-space of the same material: waves.
local space_speeds = some({ 3e-4, 1e-3, 3e-3, 1e-2 }, math.max(3, p.samples - 2))

-- `change`: what is doubled.
local function on_half_space(nu, v, change)
  local a = hertz(nu, v).a
  local h = a / (change == "mesh" and 2 * cells or cells)
  local extent = change == "block" and 2 * p.extent or p.extent
  return ricochet.scene {
    projectile = ball(nu, h, a),
    target = ricochet.half_space { extent = extent, E = E, nu = nu, h_min = h, fine_within = 1.3 * a,
      h_max = change == "mesh" and 0.4 or 0.8 },
    launch = { speed = v * c0 },
    effects = { ricochet.absorbing_edges { impedance = change == "edges" and 2 or 1 } },
  }
end

-- What left the sphere: its own vibration stays.
local function add_losses(list)
  for _, row in ipairs(list) do
    row.lost = 1 - (row.after_projectile_translation + row.after_projectile_vibration) / row.before_total
    row.lost_of_e = 1 - row.e ^ 2
    row.coefficient = row.lost / row.v ^ 0.6
  end
  return list
end

local waves = add_losses(ricochet.sweep { name = "elastic_sphere_radiation", over = { nu = p.nu, v = space_speeds },
  scene = function(at) return on_half_space(at.nu, at.v) end }:run())
for _, nu in ipairs(p.nu) do
  local of, constant = waves:where { nu = nu }, theory.hunter_coefficient { nu = nu }
  local law = of:power_law { x = "v", y = "lost", unit = "v" }
  print(("half-space of its material, nu = %g: lost ~ (v/c0)^%.3f +- %.3f (0.6); over (v/c0)^0.6, theory %.3f"):format(
    nu, law.exponent, law.se, constant))
  for _, row in ipairs(of) do
    print(("v = %7.1e c0: left the sphere %.5f, 1 - e^2 %.5f, vibration %.1e, by the edges %.5f"):format(row.v,
      row.lost, row.lost_of_e, row.after_projectile_vibration / row.before_total,
      row.absorbing_edges_energy / row.before_total))
    print(("  over (v/c0)^0.6: %.3f (%+.1f %%)"):format(row.coefficient, 100 * (row.coefficient / constant - 1)))
  end
end
if p.full then
  local doubled = add_losses(ricochet.sweep { name = "elastic_sphere_doubled",
    over = { change = { "none", "block", "edges", "mesh" }, v = { 1e-3, 1e-2 } },
    scene = function(at) return on_half_space(p.nu[#p.nu], at.v, at.change) end }:run())
  for _, row in ipairs(doubled) do
    print(("doubled %-5s v = %7.1e c0: left the sphere %.5f, 1 - e^2 %.5f"):format(row.change, row.v, row.lost,
      row.lost_of_e))
  end
end

local laws, constants = {}, {}
for k, nu in ipairs(p.nu) do
  local constant = theory.hunter_coefficient { nu = nu }
  laws[k] = { name = ("%.3f (v/c0)^0.6, ν = %g"):format(constant, nu),
    f = function(v) return constant * v ^ 0.6 end }
  constants[k] = { name = ("%.3f, ν = %g"):format(constant, nu), f = function() return constant end }
end
laws[#laws + 1] = { name = "Hunter by Johnson, 1.04", f = function(v) return 1.04 * v ^ 0.6 end }
constants[#constants + 1] = { name = "1.04", f = function() return 1.04 end }
ricochet.plot {
  rows = waves, x = "v", y = { "lost", "lost_of_e", "coefficient" }, by = "nu", log = "xy",
  name = "elastic_sphere_radiation", xlabel = "v / c0",
  ylabel = { lost = "energy that left the sphere", lost_of_e = "1 − e²", coefficient = "lost / (v/c0)^0.6" },
  yrange = { coefficient = { 1, 1.25 } },
  theory = { lost = laws, lost_of_e = laws, coefficient = constants },
  title = "Elastic sphere on a half-space of its own material",
  caption = ("Block of %g R with absorbing edges, %g triangles along the contact's radius. Law only."):format(p.extent,
    cells),
}

-- A steel ball on rock: the pulse.
local ball_radius, speed = 1.5e-3, 3.1316
local source = "K. Okubo's notebook on McLaskey & Glaser, J. Nondestr. Eval. 31, 157 (2012)"
local steel = ricochet.material { E = 197e9, nu = 0.3, density = 7930, source = source }
local rock = ricochet.material { E = 103e9, nu = 0.31, density = 2650, source = source .. "; its density is assumed" }
local struck = theory.hertz { R = ball_radius, E = steel.E, nu = steel.nu, E2 = rock.E, nu2 = rock.nu,
  m = 4 / 3 * math.pi * ball_radius ^ 3 * steel.density, v = speed }
local softness = (1 - steel.nu ^ 2) / (math.pi * steel.E) + (1 - rock.nu ^ 2) / (math.pi * rock.E)
local pulse_time = 4.53 * (4 * math.pi * steel.density * softness / 3) ^ 0.4 * ball_radius * speed ^ -0.2
local pulse_force = 1.917 * steel.density ^ 0.6 * softness ^ -0.4 * ball_radius ^ 2 * speed ^ 1.2
local h = struck.a / cells
local pulse = ricochet.series {
  scene = ricochet.scene {
    units = "SI",
    projectile = ricochet.sphere { radius = ball_radius, material = steel, h_min = h,
      h_max = math.max(0.15 * ball_radius, h), fine_within = 1.3 * struck.a },
    target = ricochet.half_space { extent = p.extent * ball_radius, material = rock, h_min = h,
      h_max = 0.8 * ball_radius, fine_within = 1.3 * struck.a },
    launch = { speed = speed }, effects = { ricochet.absorbing_edges {} },
  },
  of = { "force_n" }, points = 200, name = "pulse",
}
local most, impulse = at_most_force(pulse), 0
for k, row in ipairs(pulse) do
  row.micro = 1e6 * (row.time - most.time)
  if k > 1 then impulse = impulse + (row.time - pulse[k - 1].time) * (row.force_n + pulse[k - 1].force_n) / 2 end
end
local function sine(micro)
  local t = micro * 1e-6 / pulse_time + 0.5
  return t > 0 and t < 1 and pulse_force * math.sin(math.pi * t) ^ 1.5 or 0
end
local off = 0
for _, row in ipairs(pulse) do off = math.max(off, math.abs(row.force_n - sine(row.micro))) end
print(("steel ball on rock, %g m/s: F %.1f N (McLaskey & Glaser %.1f)"):format(speed, most.force_n, pulse_force))
print(("impulse %.3f of F t_c (sine 0.5564, Hertz 0.5436)"):format(impulse / (pulse_force * pulse_time)))
print(("the pulse within %.3f of F"):format(off / pulse_force))
ricochet.plot {
  rows = pulse, x = "micro", y = { "force_n" }, name = "elastic_sphere_pulse",
  xlabel = "time from the greatest force [µs]",
  ylabel = { force_n = "force [N]" },
  theory = { force_n = { { name = "McLaskey & Glaser, F sin(πt/t_c)^1.5", f = sine } } },
  title = "The force pulse of a steel ball on rock",
  caption = ("Radius %g mm, %g m/s; half-space of elements with absorbing edges. Law only."):format(1e3 * ball_radius,
    speed),
}

-- Plates: Zener.
local plate_speed, plate_radius, nu_plate = 1e-3, 15, 0.3
local function zener(thickness)
  return theory.zener { R = 1, m = mass, E = E, nu = nu_plate, E2 = E, nu2 = nu_plate, rho2 = density,
    thickness = thickness, v = plate_speed * c0 }
end
local plates = ricochet.sweep { name = "elastic_sphere_plate", over = { thickness = some({ 0.6, 0.8, 1.1, 1.6, 2.5 },
    math.max(2, p.samples - 1)) },
  scene = function(at)
    local a, half = hertz(nu_plate, plate_speed).a, at.thickness / 2
    return ricochet.scene {
      projectile = ball(nu_plate, a / cells, a),
      target = ricochet.cylinder { radius = plate_radius, height = at.thickness, E = E, nu = nu_plate,
        h_min = a / cells, h_max = at.thickness / (p.full and 8 or 5), fine_within = 1.3 * a, fine_at = { 0, half },
        anchored = function(x) return x == plate_radius end },
      launch = { speed = plate_speed * c0 },
    }
  end }:run()
local curve = {}
for k = 0, 60 do
  local law = zener(0.5 * 8 ^ (k / 60))
  curve[#curve + 1] = { law.lambda, law.e, law.t_c / hertz(nu_plate, plate_speed).t_c }
end
local function column(k)
  local points = {}
  for i, point in ipairs(curve) do points[i] = { point[1], point[k] } end
  return { { name = "Zener", points = points } }
end
for _, row in ipairs(plates) do
  local law = zener(row.thickness)
  row.lambda, row.time_ratio = law.lambda, row.contact_time / hertz(nu_plate, plate_speed).t_c
  print(("plate of %.2g R, lambda %.3f: e %.4f (Zener %.4f), contact time %.4f of Hertz's (Zener %.4f)"):format(
    row.thickness, law.lambda, row.e, law.e, row.time_ratio, law.t_c / hertz(nu_plate, plate_speed).t_c))
end
ricochet.plot {
  rows = plates, x = "lambda", y = { "e", "time_ratio" }, log = "x", name = "elastic_sphere_plate",
  xlabel = "Zener's λ", ylabel = { time_ratio = "contact time / Hertz" },
  theory = { e = column(2), time_ratio = column(3) },
  title = "Elastic sphere on plates of its own material",
  caption = ("v = %g c0, ν = %g, plates of %g R radius, held at their rim. Law only."):format(plate_speed, nu_plate,
    plate_radius),
}
