-- Bodies of other shapes fall on a block: an ellipse, a leaning bar, a triangle, a ring, a star from a file beside this
-- script, and a bar that comes to meet its disk, spinning.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nodes = { 300, int = true, min = 60, max = 20000, doc = "nodes of each body" },
  speed = { 0.1, unit = "c", min = 1e-3, max = 0.5, doc = "impact speed" },
}

-- The fields of a shape with those that all bodies here share.
local function with(own)
  local shared = { nodes = p.nodes, placement = "poisson_disk" }
  for name, value in pairs(own) do shared[name] = value end
  return shared
end

local function circle(radius)
  local outline = {}
  for i = 1, 60 do outline[i] = { radius * math.cos(math.pi * i / 30), radius * math.sin(math.pi * i / 30) } end
  return outline
end

local block = ricochet.wall(with { width = 4, depth = 0.8, stiffness = 1e3 })
local bar = ricochet.rectangle(with { width = 2.4, height = 0.8 })
local falling = {
  { "ellipse", ricochet.ellipse(with { a = 1.2, b = 0.7 }) },
  { "leaning bar", ricochet.rotated { body = bar, angle = 30 } },
  { "triangle", ricochet.regular_polygon(with { sides = 3, radius = 1.2 }) },
  { "ring", ricochet.disk(with { holes = { circle(0.5) } }) },
  { "star", ricochet.polygon(with { outline = ricochet.points "05_star.csv" }) },
}

local scenes, titles = {}, {}
for i, shape in ipairs(falling) do
  titles[i] = shape[1]
  scenes[i] = ricochet.scene { projectile = shape[2], target = block, launch = { speed = p.speed } }
end
titles[#titles + 1] = "moving bar"
scenes[#scenes + 1] = ricochet.scene {
  projectile = ricochet.disk(with {}),
  target = ricochet.rectangle(with { width = 4, height = 0.8, velocity = { 0, 0.05 }, spin = 0.03 }),
  launch = { speed = p.speed },
}

local rows = ricochet.contact_sheet { scenes = scenes, titles = titles, times = { 0, 3, 7, 16 }, out = "shapes",
  size = { 960, 1080 }, show = { material = "speed" } }
for i, row in ipairs(rows) do
  print(("%-12s e = %6.3f, spin %7.4f c/R, in contact for %5.2f R/c"):format(titles[i], row.e, row.omega,
    row.contact_time))
end
