-- Taylor's bars: copper cylinders that hit a rigid wall end on, in SI: one that other programs have computed, and four
-- that were measured. Their final outlines beside the elements', and a table of lengths and radii. The elements have
-- the computed bar's copper throughout: 400 MPa + 100 MPa times the plastic strain. `samples`: how many of the bars,
-- from the first on. A minute on one core; `full=true`: cells of 0.6 of the side, 5 minutes.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples  = { 5, int = true, min = 1, max = 5, doc = "how many of the bars" },
  across   = { 6, min = 2, max = 20, doc = "cells of four triangles across a radius; 10 with full=true" },
  hardness = { 50, unit = "1/mm", min = 5, doc = "xi of the contact; twice as hard changes a length by 0.01 mm" },
  full     = { false, doc = "the figure in full" },
}
local across, xi = p.full and 10 or p.across, 1e3 * p.hardness

local copper = ricochet.material { E = 117e9, nu = 0.35, density = 8930, yield = 400e6, hardening = 100e6,
  source = "README of benchmark/tet15-p1/taylor in github.com/Cthonios/Carina.jl" }
local c_P = math.sqrt(117e9 * (1 - 0.35) / ((1 + 0.35) * (1 - 2 * 0.35) * 8930))

-- Lengths, diameters, heights z and radii r in mm, speeds in m/s, times in us. `share`: the step over h/c_P, which must
-- follow the flattest element. Computed: final length and radius by tetrahedra (Carina.jl, as above), on a wall
-- that holds the face and never lets it go. Measured: the black outlines of figures 4 and 5 of Zelepugin, Cherepanov &
-- Pakhnutova, Materials 16, 5452 (2023), CC BY 4.0, as digitised in github.com/qilinli/StructBench
-- (validation/references/taylor_copper.json), some of their corners: { z, r }. The first is of Wilkins & Guinan (1973).
local bars = {
  { name = "computed", speed = 227, length = 32.4, diameter = 6.4, time = 80, share = 0.025,
    final = { 21.420, 7.2255 } },
  { name = "measured, 210 m/s", speed = 210, length = 23.47, diameter = 7.62, time = 100, share = 0.025,
    final = { 14.796, 8.397 }, outline = { { 0, 8.397 }, { 0.752, 7.302 }, { 1.748, 5.602 }, { 4.147, 5.097 },
      { 7.399, 4.400 }, { 10.794, 4.002 }, { 14.796, 3.810 } } },
  { name = "measured, 162 m/s", speed = 162, length = 34.5, diameter = 7.8, time = 110, share = 0.025,
    final = { 26.313, 6.633 }, outline = { { 0, 6.633 }, { 0.708, 6.285 }, { 1.416, 5.936 }, { 2.139, 5.581 },
      { 2.847, 5.240 }, { 3.555, 4.970 }, { 4.624, 4.777 }, { 6.040, 4.635 }, { 7.471, 4.550 }, { 9.248, 4.344 },
      { 11.025, 4.152 }, { 12.803, 4.031 }, { 14.580, 3.903 }, { 20, 3.903 }, { 26.313, 3.903 } } },
  { name = "measured, 225 m/s", speed = 225, length = 34.5, diameter = 7.8, time = 110, share = 0.02,
    final = { 22.253, 8.020 }, outline = { { 0, 8.020 }, { 0.824, 7.209 }, { 1.647, 6.441 }, { 2.471, 5.737 },
      { 3.295, 5.332 }, { 4.538, 5.112 }, { 5.765, 4.898 }, { 7.413, 4.635 }, { 9.075, 4.372 }, { 10.722, 4.123 },
      { 12.368, 3.997 }, { 14.421, 3.938 }, { 16.487, 3.903 }, { 22.253, 3.903 } } },
  { name = "measured, 316 m/s", speed = 316, length = 34.5, diameter = 7.8, time = 110, share = 0.0025,
    final = { 15.996, 10.622 }, outline = { { 0.130, 5.929 }, { 0.188, 6.726 }, { 0.361, 7.508 }, { 0.549, 8.283 },
      { 0.867, 9.008 }, { 1.214, 9.726 }, { 1.676, 10.366 }, { 2.153, 10.622 }, { 1.922, 9.854 }, { 1.864, 9.065 },
      { 2.038, 8.105 }, { 2.168, 7.344 }, { 2.341, 6.590 }, { 2.832, 5.972 }, { 3.410, 5.432 }, { 3.959, 5.197 },
      { 4.884, 4.820 }, { 5.838, 4.528 }, { 7.211, 4.265 }, { 9.002, 4.045 }, { 10.996, 3.953 }, { 15.996, 3.953 } } },
}

-- The bar's final outline { z, r }, from the face of impact up along the side, in mm, `time` after it first felt the
-- wall, and its length, its radius and the height of that.
local function flattened(bar)
  local h = bar.diameter / 2 / across
  local flight = 30 / (xi * bar.speed)
  -- The wall is felt from a percent of a shock's force on, rho c_P v on the face.
  local felt = 0.01 * 8930 * c_P * bar.speed * math.pi * (bar.diameter / 2e3) ^ 2
  local outline, first
  local function length(state)
    if not first and state.force_n > felt then first = state.time end
    if not first or state.time <= first + bar.time / 1e6 then outline = state.projectile.outline end
    local low, high = math.huge, -math.huge
    for _, place in ipairs(state.projectile.outline) do
      low, high = math.min(low, place[2]), math.max(high, place[2])
    end
    return high - low
  end
  ricochet.series {
    scene = ricochet.scene {
      units = "SI",
      projectile = ricochet.cylinder { material = copper, radius = bar.diameter / 2e3, height = bar.length / 1e3,
        h_min = h / 1e3, h_max = h / 1e3, mesh = "crossed" },
      target = ricochet.plane {}, launch = { speed = bar.speed }, contact = { xi = xi },
      effects = { ricochet.yielding {} }, step = bar.share * h / 1e3 / c_P,
      ending = { at = "time", time = bar.time / 1e6 + flight },
    },
    of = { "force_n", length = length }, outlines = true, points = 500, duration = bar.time / 1e6 + flight,
    name = ("bar_%g"):format(bar.speed),
  }
  local points, low, high, widest = {}, math.huge, -math.huge, { 0, 0 }
  for i, place in ipairs(outline) do points[i] = { 1e3 * place[2], 1e3 * place[1] } end
  for _, point in ipairs(points) do low, high = math.min(low, point[1]), math.max(high, point[1]) end
  for _, point in ipairs(points) do
    point[1] = point[1] - low
    if point[2] > widest[2] then widest = point end
  end
  return points, high - low, widest[2], widest[1]
end

print(("%-20s %5s  %18s %7s  %18s %7s  %s"):format("bar", "m/s", "length: elements", "known", "radius: elements",
  "known", "height of the radius [mm]"))
local panels, lines, marks, labels = {}, {}, {}, {}
for i = 1, p.samples do
  local bar = bars[i]
  local points, length, radius, lifted = flattened(bar)
  print(("%-20s %5g  %10.3f %+6.1f %% %7.3f  %10.3f %+6.1f %% %7.3f  %.3f"):format(bar.name, bar.speed, length,
    100 * (length / bar.final[1] - 1), bar.final[1], radius, 100 * (radius / bar.final[2] - 1), bar.final[2], lifted))
  panels[i] = ("bar_%d"):format(i)
  lines[panels[i]] = { { name = "elements", points = points } }
  marks[panels[i]] = bar.outline and { { name = "measured", points = bar.outline } }
    or { { name = "computed: length, radius", points = { { 0, bar.final[2] }, { bar.final[1], bar.diameter / 2 } } } }
  labels[panels[i]] = ("r [mm], %s%g m/s"):format(bar.outline and "" or "computed, ", bar.speed)
end

ricochet.plot {
  x = "z", y = panels, name = "taylor_bar", xlabel = "height above the wall z [mm]", ylabel = labels, theory = lines,
  published = marks, title = "Copper cylinders after impact on a rigid wall: outlines",
  caption = ("Elements of 400 MPa + 100 MPa × plastic strain in all; %g cells across a radius."):format(across),
}
