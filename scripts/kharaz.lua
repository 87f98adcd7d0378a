-- The experiment of Kharaz, Gorham & Salman 2001: a 5 mm alumina sphere on thick glass, 3.9 m/s at every angle. e at
-- the normal speed of each angle is that of axisymmetric elements (the sphere on a half-space of glass, from whose
-- edges waves leave). With it the tangential motion follows from the theory of Maw, Barber & Fawcett, with Hertz's
-- contact (ricochet.theory.maw_hertz) and with springs for it (theory.maw), beside the measured points: v_t'/v_t of the
-- centre, spin, and the angle at which the contact point rebounds, with the errors of the points; that angle beside
-- what the experiment's own v_t'/v_t and spin make it, and what would have to be wrong for the points to hold.
-- `samples`: speeds at which e is computed; e between them by 1 - e^2 ~ v^k. `full=true`: at the speed of every angle,
-- with a finer mesh. Ten seconds; half a minute with `full=true`.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  samples = { 4, int = true, min = 2, doc = "normal speeds at which e is computed, three or more" },
  mu      = { 0.092, min = 0, doc = "friction of alumina on glass, as measured" },
  cells   = { 8, min = 2, doc = "triangles along the contact's radius; 12 with full=true" },
  full    = { false, doc = "the figure in full" },
}
local theory, radius, speed = ricochet.theory, 2.5e-3, 3.9
local alumina = ricochet.material { E = 380e9, nu = 0.23, density = 4000, source = "Chung & Ooi 2011, test 4" }
local glass = ricochet.materials.glass
local mass = 4 / 3 * math.pi * radius ^ 3 * alumina.density
local cells = p.full and 1.5 * p.cells or p.cells

local function tangent(angle) return math.tan(math.rad(angle)) end
local function normal_speed(angle) return speed * math.cos(math.rad(angle)) end

local speeds = {}
if p.full then
  for k, point in ipairs(figures.kharaz.e_t) do speeds[k] = normal_speed(point[1]) end
else
  local slowest = normal_speed(figures.kharaz.e_t[#figures.kharaz.e_t][1])
  local count = math.max(p.samples, 3)  -- what a law of two constants needs
  for k = 1, count do speeds[k] = slowest * (speed / slowest) ^ ((k - 1) / (count - 1)) end
end
table.sort(speeds)

local rows = ricochet.sweep {
  name = "kharaz",
  over = { v = speeds },
  scene = function(at)
    local a = theory.hertz { R = radius, E = alumina.E, nu = alumina.nu, E2 = glass.E, nu2 = glass.nu, m = mass,
      v = at.v }.a
    local h = a / cells
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.sphere { radius = radius, material = alumina, h_min = h,
        h_max = math.max(0.15 * radius, h), fine_within = 1.3 * a },
      target = ricochet.half_space { extent = 10 * radius, material = glass, h_min = h, h_max = 0.8 * radius,
        fine_within = 1.3 * a },
      launch = { speed = at.v },
      effects = { ricochet.absorbing_edges {} },
    }
  end,
}:run()
local function radiated(v)
  return theory.radiation_loss { R = radius, m = mass, E = alumina.E, nu = alumina.nu, E2 = glass.E, nu2 = glass.nu,
    rho2 = glass.density, v = v }.e
end
for _, row in ipairs(rows) do
  row.lost = 1 - row.e ^ 2
  print(("v_n = %.3f m/s: e = %.5f, by radiated waves alone %.5f"):format(row.v, row.e, radiated(row.v)))
end
local law = rows:power_law { x = "v", y = "lost", unit = "v" }
print(("1 - e^2 = %.4f (v_n / (m/s))^%.3f +- %.3f"):format(law.factor, law.exponent, law.se))
local function e_at(angle)
  if rows[1].e ~= rows[1].e then return 1 end  -- --check runs nothing
  for _, row in ipairs(rows) do
    if math.abs(row.v - normal_speed(angle)) < 1e-9 then return row.e end
  end
  return math.sqrt(1 - law.factor * normal_speed(angle) ^ law.exponent)
end

-- Of glass, which bears most of the deformation.
local function impact(angle, mu)
  return { psi1 = tangent(angle), mu = mu or p.mu, e = e_at(angle), nu = glass.nu, beta_x = 3.5 }
end
local function quantities(rebound, angle)
  local e_t = 1 - (1 + rebound.beta) / 3.5
  return { e_t = e_t, spin = 2.5 * speed * math.sin(math.rad(angle)) * (1 - e_t) / radius,
    contact = math.deg(math.atan(rebound.psi2 / e_at(angle))) }
end
local known = {}
local function by_hertz(angle)
  known[angle] = known[angle] or quantities(theory.maw_hertz(impact(angle)), angle)
  return known[angle]
end
-- By how much a point may miss: two readings of the same figures differ by so much in each column and by 0.6 degrees of
-- incidence, and mu of glass is known to 0.006.
local read = { e_t = 0.003, spin = 7, contact = 0.6 }
local function error_of(name, angle)
  local by_angle = (by_hertz(angle + 0.6)[name] - by_hertz(angle - 0.6)[name]) / 2
  local by_mu = quantities(theory.maw_hertz(impact(angle, p.mu + 0.006)), angle)[name] - by_hertz(angle)[name]
  return math.sqrt(read[name] ^ 2 + by_angle ^ 2 + by_mu ^ 2)
end
local function by_springs(angle) return quantities(theory.maw(impact(angle)), angle) end

local lines, published = {}, {}
for name, digits in pairs { e_t = "%.4f", spin = "%.1f", contact = "%.2f" } do
  local points = {}
  for k = 0, 60 do
    local angle = 1 + 87.5 * k / 60
    points[k + 1] = { angle, by_hertz(angle)[name] }
  end
  lines[name] = {
    { name = "Maw, Barber & Fawcett", points = points },
    { name = "with springs for Hertz's contact", f = function(angle) return by_springs(angle)[name] end },
  }
  published[name] = { { name = "Kharaz et al. 2001", points = figures.kharaz[name] } }
  local worst = { 0, 0 }
  for _, point in ipairs(figures.kharaz[name]) do
    local here, springs = by_hertz(point[1])[name], by_springs(point[1])[name]
    local text = "%-7s at %5.2f degrees: measured " .. digits .. ", Maw " .. digits .. " (%+.4g, %.1f errors), springs "
    print((text .. digits):format(name, point[1], point[2], here, here - point[2],
      math.abs(here - point[2]) / error_of(name, point[1]), springs))
    if math.abs(here - point[2]) > math.abs(worst[1]) then worst = { here - point[2], point[1] } end
  end
  print(("%s: greatest deviation %+.4g, at %g degrees"):format(name, worst[1], worst[2]))
end
-- The measured column there: the theory plus by how much the nearest point misses it.
local function measured(name, angle)
  local nearest = figures.kharaz[name][1]
  for _, point in ipairs(figures.kharaz[name]) do
    if math.abs(point[1] - angle) < math.abs(nearest[1] - angle) then nearest = point end
  end
  return by_hertz(angle)[name] + nearest[2] - by_hertz(nearest[1])[name]
end
-- The contact point's speed is v_t' - omega R, whatever bodies touch.
local function contact_of_columns(angle)
  local v_n = normal_speed(angle)
  local v_t, spin = measured("e_t", angle) * speed * math.sin(math.rad(angle)), measured("spin", angle) * radius
  return math.deg(math.atan((v_t - spin) / (e_at(angle) * v_n)))
end
local of_columns = {}
print "Where the contact slides all along: rebound of the contact point [degrees], and what alone would have to differ:"
print "angle  measured    Maw  by their v_t' and spin  1 % of e, deg  0.006 of mu, deg     e       mu  incidence, deg"
for k, point in ipairs(figures.kharaz.contact) do
  local angle, leaves = point[1], tangent(point[2])
  of_columns[k] = { angle, contact_of_columns(angle) }
  if theory.maw(impact(angle)).regime == 3 then
    local e, along = e_at(angle), tangent(angle)
    local maw = math.rad(by_hertz(angle).contact)
    local by_mu = 0.006 * 3.5 * (1 + e) / e * math.cos(maw) ^ 2
    print(("%5.2f %9.2f %6.2f %23.2f %14.2f %17.2f %5.2f %8.3f %15.2f"):format(angle, point[2], math.deg(maw),
      of_columns[k][2], math.deg(0.01 * math.sin(maw) * math.cos(maw)), math.deg(by_mu),
      (along - 3.5 * p.mu) / (leaves + 3.5 * p.mu), (along - e * leaves) / (3.5 * (1 + e)),
      math.deg(math.atan(e * leaves + 3.5 * p.mu * (1 + e))) - angle))
  end
end
for _, point in ipairs(figures.kharaz.rebound) do
  local e = measured("e_t", point[1]) * tangent(point[1]) / tangent(point[2])
  -- By 0.3 degrees of incidence.
  local error = math.rad(0.3) * 2 / math.sin(2 * math.rad(point[1])) * e
  if point[1] > 20 then
    print(("e by the angle at which the centre leaves, at %5.2f degrees: %.3f +- %.3f"):format(point[1], e, error))
  end
end
table.insert(published.contact, { name = "by their v_t' and spin", points = of_columns })
ricochet.plot {
  x = "angle", y = { "e_t", "spin", "contact" }, name = "kharaz", xrange = { 0, 90 },
  xlabel = "incident angle [degrees]",
  ylabel = { e_t = "v_t' / v_t of the centre", spin = "spin [rad/s]", contact = "rebound of contact [degrees]" },
  theory = lines, published = published,
  title = "5 mm alumina sphere on glass, 3.9 m/s",
  caption = ("μ = %g; e of axisymmetric elements, %.4f to %.4f. Published points as digitised."):format(p.mu,
    rows[#rows].e, rows[1].e),
}
