-- How the mean e rises with the slopes of a rough wall: many roughnesses, spacings and stiffnesses on one curve. A
-- smooth disk comes in at 0.1 c, from both sides on every lattice; the wall alone is rough, the rms slope of its
-- segments s = sqrt(2) sd/spacing. e0 is the e of the same lattices head on, at the same normal speed.
--
-- Two pictures of what a rough wall does [here]:
-- * Nails: the disk is reflected by one facet of slope a, e = -1 + (1 + e0)(1 + Psi1 a)/(1 + a^2), and meets facets
--   as often as they face it, in proportion to (1 + Psi1 a) where that is above 0. With normal slopes and x = Psi1 s:
--   <e> - e0 = (1 + e0) x^2 F(1/x)/(F(1/x) + x f(1/x)), f the normal density and F its integral: (1 + e0) Psi1^2 s^2
--   for small x, less from x = 0.5 on.
-- * A tilted surface: slopes have the mean 0 and are met alike: <e> - e0 = -(1 + e0) s^2, next to nothing.
-- A contact of length l spans l/spacing facets, and its chord has only the slope s spacing/l where that is less than
-- s. The second picture is drawn over Psi1^2 s^2, the first over the same with the slope of the chord.
-- `samples`: lattices a point; two minutes on two cores by default. `full=true`: 40 lattices and more rims, half an
-- hour.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"
local readings = require "ricochet.readings"
local rows_of = require("ricochet.rows").rows_of
local statistics = require "ricochet.statistics"

local p = ricochet.parameters {
  samples  = { 10, int = true, min = 2, doc = "random lattices a point, each struck from both sides" },
  seeds    = { 0, int = true, min = 0, doc = "added to every sample's seed" },
  psi1     = { { 2, 3, 4, 6 }, min = 0.1, doc = "tangents of the incident angle" },
  nodes    = { 800, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
  full     = { false, doc = "40 lattices, more rims" },
}
local samples = p.full and 40 or p.samples
local lattice = math.sqrt(math.pi / p.nodes)
-- Spacing over the lattice's, rms slope, stiffness of the wall over the disk's.
local rims = {
  { 1, 0.06, 10 }, { 1, 0.15, 10 }, { 2, 0.06, 10 }, { 2, 0.15, 10 }, { 4, 0.06, 10 }, { 4, 0.15, 10 },
  { 2, 0.15, 0.1 },
}
if p.full then
  for _, rim in ipairs { { 2, 0.03, 10 }, { 2, 0.3, 10 }, { 4, 0.3, 10 }, { 8, 0.06, 10 }, { 8, 0.15, 10 },
      { 2, 0.06, 0.1 }, { 4, 0.15, 0.1 }, { 2, 0.15, 0.01 } } do
    rims[#rims + 1] = rim
  end
end
local list = ricochet.range(p.seeds + 1, p.seeds + samples)

local rows = ricochet.sweep {
  name = "slopes", over = { sample = list, rim = ricochet.range(#rims), slant = p.psi1, side = { -1, 0, 1 } },
  scene = function(at)
    local spacing, slope, ratio = table.unpack(rims[at.rim])
    local method, theta = table.unpack(readings.steps[ratio < 1 and "soft" or "hard"])
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, mass = 1, stiffness = 1e4, seed = at.sample },
      target = ricochet.wall { nodes = 5 * p.nodes, mass = 1, stiffness = 1e4 * ratio, seed = at.sample,
        rim_spacing = spacing * lattice, roughness = slope * spacing * lattice / math.sqrt(2), crossing = "pass_over" },
      launch = at.side == 0 and { normal_speed = 0.1 / math.sqrt(1 + at.slant ^ 2) }
        or { speed = 0.1, psi1 = at.side * at.slant }, contact = figures.contact,
      method = method, theta = theta,
    }
  end,
}:run()

-- The normal density and its integral from -infinity. [Abramowitz & Stegun 1964, 26.2.17, to 7.5e-8]
local function density(z) return math.exp(-z * z / 2) / math.sqrt(2 * math.pi) end
local function integral(z)
  if z < 0 then return 1 - integral(-z) end
  local t = 1 / (1 + 0.2316419 * z)
  return 1 - density(z) * t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978
    + t * 1.330274429))))
end
local function nails(x)
  local z = 1 / x
  return x * x * integral(z) / (integral(z) + x * density(z))
end

-- Of each rim and angle: the rise of the mean over e0, lattice by lattice, over 1 + e0, where all three finished; and
-- the slope of the chord.
local points = {}
for i, rim in ipairs(rims) do
  for _, psi1 in ipairs(p.psi1) do
    local of, lengths, some = {}, {}, {}
    for _, row in ipairs(rows:where { rim = i, slant = psi1 }) do
      if row.status == "finished" then
        of[row.sample] = of[row.sample] or {}
        of[row.sample][row.side] = row
      end
    end
    local e0 = statistics.of_finished(rows:where { rim = i, slant = psi1, side = 0 }, "e").mean
    for _, sample in ipairs(list) do
      local lattice_rows = of[sample] or {}
      local zero, one, other = lattice_rows[0], lattice_rows[1], lattice_rows[-1]
      if zero and one and other then
        lengths[#lengths + 1], lengths[#lengths + 2] = one.contact_length, other.contact_length
        some[#some + 1] = { rim = i, psi1 = psi1, sample = sample, rise = ((one.e + other.e) / 2 - zero.e) / (1 + e0),
          one = (one.e - zero.e) / (1 + e0), other = (other.e - zero.e) / (1 + e0),
          kind = ("spacing %g, s = %g, wall %g"):format(rim[1], rim[2], rim[3]) }
      end
    end
    local facets = statistics.of(lengths).mean / (rim[1] * lattice)
    for _, point in ipairs(some) do
      point.facets, point.x2, point.chord2 = facets, (psi1 * rim[2]) ^ 2, (psi1 * rim[2] * math.min(1, 1 / facets)) ^ 2
      points[#points + 1] = point
    end
  end
end

-- c of rise = c x by least squares through 0, of points whose x is below `most`; its error is that of a bootstrap over
-- lattices, which all rims share.
local function coefficient(x, most, is_one)
  local sums, numbers = {}, {}
  for _, point in ipairs(points) do
    if point[x] < most and is_one(rims[point.rim]) then
      if not sums[point.sample] then
        sums[point.sample] = { 0, 0 }
        numbers[#numbers + 1] = point.sample
      end
      local sum = sums[point.sample]
      sum[1], sum[2] = sum[1] + point.rise * point[x], sum[2] + point[x] ^ 2
    end
  end
  local of = ricochet.bootstrap { values = numbers, of = function(lattices)
    local product, square = 0, 0
    for _, sample in ipairs(lattices) do
      product, square = product + sums[sample][1], square + sums[sample][2]
    end
    return product / square
  end }
  return of.value, of.se
end

local function told(x, most, is_one) return ("%6.2f ± %.2f"):format(coefficient(x, most, is_one)) end

print(("%8s %6s %6s %5s %7s %9s %20s %14s %14s %8s"):format("spacings", "s", "wall", "Psi1", "facets", "Psi1^2s^2",
  "(<e>-e0)/(1+e0)", "over Psi1^2s^2", "over chord's", "nails"))
for i, rim in ipairs(rims) do
  for _, psi1 in ipairs(p.psi1) do
    local values, point = {}, nil
    for _, each in ipairs(points) do
      if each.rim == i and each.psi1 == psi1 then
        values[#values + 1], point = each.rise, each
      end
    end
    local of = statistics.of(values)
    if point then
      print(("%8g %6g %6g %5g %7.2f %9.4f %11.4f ± %6.4f %6.2f ± %5.2f %6.2f ± %5.2f %8.4f"):format(rim[1], rim[2],
        rim[3], psi1, point.facets, point.x2, of.mean, of.se, of.mean / point.x2, of.se / point.x2,
        of.mean / point.chord2, of.se / point.chord2, nails(math.sqrt(point.chord2))))
    end
  end
end
print "\n(<e> - e0)/(1 + e0) over Psi1^2 s^2 where that is below 0.25, and over the same of the chord's slope; nails: 1"
local seen = {}
for _, rim in ipairs(rims) do
  local key = ("%g %g"):format(rim[1], rim[3])
  if not seen[key] then
    seen[key] = true
    local function is_one(other) return other[1] == rim[1] and other[3] == rim[3] end
    print(("  %g spacings, wall %g: %s, %s"):format(rim[1], rim[3], told("x2", 0.25, is_one),
      told("chord2", 0.25, is_one)))
  end
end
local function any() return true end
print(("  all: %s, %s"):format(told("x2", 0.25, any), told("chord2", 0.25, any)))
-- How far points are from a curve of nails, in their standard errors.
for _, x in ipairs { "x2", "chord2" } do
  local square, n = 0, 0
  for i in ipairs(rims) do
    for _, psi1 in ipairs(p.psi1) do
      local values, at = {}, nil
      for _, each in ipairs(points) do
        if each.rim == i and each.psi1 == psi1 then values[#values + 1], at = each.rise, each[x] end
      end
      local of = statistics.of(values)
      if of.se and of.se > 0 then
        n, square = n + 1, square + ((of.mean - nails(math.sqrt(at))) / of.se) ^ 2
      end
    end
  end
  print(("off the curve of nails over %s: %.1f standard errors (root mean square of %d points)"):format(
    x == "x2" and "Psi1^2 s^2" or "that of the chord", math.sqrt(square / n), n))
end

local lines = { nails = {}, square = {} }
for k = 0, 60 do
  local x2 = 10 ^ (-2.3 + 2.9 * k / 60)
  lines.nails[k + 1], lines.square[k + 1] = { x2, nails(math.sqrt(x2)) }, { x2, x2 }
end
local caption = ("Smooth disk of %d nodes, rough wall of %d: spacing of its rim over the lattice's, rms slope s, " ..
  "stiffness over the disk's; %d lattices a point, each struck from both sides."):format(p.nodes, 5 * p.nodes, samples)
-- Both sides as the impacts that they are, a lattice's as one unit.
local drawn = {}
for _, point in ipairs(points) do
  for _, e in ipairs { point.one, point.other } do
    drawn[#drawn + 1] = { status = "finished", pair = point.sample, x2 = point.x2, chord2 = point.chord2,
      kind = point.kind, rise = e }
  end
end
rows_of(drawn)
for _, picture in ipairs {
    { "chord2", "slopes", "Ψ₁² s² min(1, spacing/length)²: of the slope of the contact's chord (log)" },
    { "x2", "slopes_facets", "Ψ₁² s² (log)" } } do
  ricochet.plot {
    rows = drawn, x = picture[1], y = { "rise" }, by = "kind", name = picture[2], log = "x",
    xlabel = picture[3], ylabel = { rise = "(⟨e⟩ − e₀)/(1 + e₀)" },
    theory = { rise = { { name = "nails: facets met as they face", points = lines.nails },
      { name = "its first order", points = lines.square }, { name = "tilted surface", f = function() return 0 end } } },
    yrange = { rise = { -0.2, 1 } },
    title = "Rise of the mean e with the slopes of a rough wall", caption = caption,
  }
end
