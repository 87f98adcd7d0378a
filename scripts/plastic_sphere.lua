-- e of spheres that yield, on a rigid plane, against the speed in units of the yield speed v_y, for two ratios E*/Y;
-- beside Johnson's fully plastic impact at a pressure of 3 Y, Wu, Li & Thornton's two laws and Jackson & Green's fit,
-- and the share of the depth that the dent keeps. The window of the -1/4 law, and the speed at which yielding begins.
-- `samples`: speeds for each ratio. A minute of one core; `full=true`: more speeds from lower ones on, and elements
-- of 0.6 of the side, 16 minutes of one core.
local ricochet = require "ricochet"
local theory = ricochet.theory

local p = ricochet.parameters {
  samples = { 4, int = true, min = 2, max = 30, doc = "speeds for each ratio; 12 with full=true" },
  ratio   = { { 220, 999 }, min = 200, max = 3000, doc = "E*/Y of the spheres" },
  across  = { 8, min = 2, max = 20, doc = "elements across the radius of the contact; 13 with full=true" },
  full    = { false, doc = "the figure in full" },
}
local samples, across = p.full and 12 or p.samples, p.full and 13 or p.across

local E, nu, density = 1e4, 0.3, 800 / math.pi
local E_star, mass = E / (1 - nu ^ 2), 4 * math.pi / 3 * density
local slowest, fastest = p.full and 10 or 30, 2000

local function impact_of(ratio, x)
  local sphere = { R = 1, E_star = E_star, m = mass, Y = E_star / ratio }
  sphere.v = x * theory.yield_speed(sphere).v
  return sphere
end

-- Jackson & Green's, at x yield speeds.
local function pressed(ratio, x)
  local at = impact_of(ratio, x)
  at.nu = nu
  return theory.jackson_green(at)
end

local function scene_at(ratio, x)
  local a = pressed(ratio, x).a
  local h = a / across
  local at = impact_of(ratio, x)
  return ricochet.scene {
    projectile = ricochet.sphere { E = E, nu = nu, density = density, h_min = h, h_max = math.max(0.12, h),
      fine_within = 1.25 * a },
    target = ricochet.plane {}, launch = { speed = at.v }, effects = { ricochet.yielding { yield = at.Y } },
  }
end

local speeds = {}
for i = 1, samples do speeds[i] = slowest * (fastest / slowest) ^ ((i - 1) / (samples - 1)) end

local rows = ricochet.sweep {
  name = "plastic_sphere",
  over = { x = speeds, ratio = p.ratio },
  scene = function(at) return scene_at(at.ratio, at.x) end,
}:run()
for _, row in ipairs(rows) do
  row.over_yield_speed, row.kept = row.x, row.dent / row.overlap
  row.of = ("E*/Y = %g"):format(row.ratio)
end

-- What a theory says at these speeds; nothing where it refuses them.
local function says(f, ratio, x)
  local known, value = pcall(f, ratio, x)
  return known and value or nil
end
local laws = {
  { name = "Johnson, 3 Y", of = function(ratio, x) return theory.plastic(impact_of(ratio, x)).e end },
  { name = "Wu, Li & Thornton", of = function(ratio, x) return theory.wu_li_thornton(impact_of(ratio, x)).e end },
  { name = "Jackson & Green", of = function(ratio, x) return pressed(ratio, x).e end },
}

print(("%6s %9s %8s %8s %8s %8s %9s %9s %9s"):format("E*/Y", "v/v_y", "e", "Johnson", "W-L-T", "J-G", "exponent",
  "dent/depth", "J-G"))
local before = {}
for _, ratio in ipairs(p.ratio) do
  for _, x in ipairs(speeds) do
    local row = rows:where { ratio = ratio, x = x }[1]
    local last, at = before[ratio], pressed(ratio, x)
    local cells = {}
    for i, law in ipairs(laws) do cells[i] = says(law.of, ratio, x) end
    print(("%6g %9.1f %8.4f %8s %8s %8s %9s %9.3f %9.3f"):format(ratio, x, row.e,
      cells[1] and ("%.4f"):format(cells[1]) or "-", cells[2] and ("%.4f"):format(cells[2]) or "-",
      cells[3] and ("%.4f"):format(cells[3]) or "-",
      last and ("%.3f"):format(math.log(row.e / last.e) / math.log(x / last.x)) or "-", row.kept,
      at.residual / at.depth))
    before[ratio] = row
  end
  print(("E*/Y = %g: the -1/4 law of Wu, Li & Thornton ends at %.0f v_y"):format(ratio,
    theory.wu_li_thornton(impact_of(ratio, 100)).window))
end

-- Where yielding begins: the slowest impact in which an element yields, of those around v_y. The softer the sphere, the
-- wider its contact, and the fewer steps it takes.
local soft = 100
local onset = ricochet.sweep {
  name = "plastic_sphere_onset",
  over = { x = p.full and { 0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.3, 1.5 } or { 0.8, 1.25 } },
  scene = function(at) return scene_at(soft, at.x) end,
}:run()
print(("E*/Y = %g:"):format(soft))
print "v/v_y   elements that yield   energy lost to it"
for _, row in ipairs(onset) do
  print(("%5.2f %21.0f %19.2g"):format(row.x, row.yielding_elements, row.yielding_energy / row.before_total))
end

local lines, dents = {}, {}
for i, ratio in ipairs(p.ratio) do
  for k, law in ipairs(laws) do
    -- Johnson's depends on v/v_y alone.
    if k > 1 or i == 1 then
      lines[#lines + 1] = { name = k == 1 and law.name or ("%s, %g"):format(law.name, ratio),
        f = function(x) return says(law.of, ratio, x) or 0 / 0 end }
    end
  end
  dents[i] = { name = ("Jackson & Green, %g"):format(ratio), f = function(x)
    local at = pressed(ratio, x)
    return at.residual / at.depth
  end }
end
ricochet.plot {
  rows = rows, x = "over_yield_speed", y = { "e", "kept" }, by = "of", log = "x", name = "plastic_sphere",
  xlabel = "impact speed [v_y]", ylabel = { kept = "dent / greatest depth" }, theory = { e = lines, kept = dents },
  title = "Spheres that yield, without hardening, on a rigid plane, beside laws only",
}
