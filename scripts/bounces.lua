-- A damped ball falls on a rigid floor and bounces under gravity, each lattice in one run: height and e of every bounce.
-- Beside them, balls of the same lattices that come at the same speeds without vibrating: what the ball still does of its
-- last impact changes e, or does not. samples=2 is a quick try; full=true draws more lattices of more nodes (about
-- 6 minutes on two cores).
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 6, int = true, min = 2, doc = "lattices" },
  bounces = { 6, int = true, min = 1, doc = "followed of each lattice" },
  height  = { 1, unit = "R", min = 0.1, max = 100, doc = "from which the ball falls" },
  g       = { 1e-2, unit = "c^2/R", min = 1e-6, max = 0.1, doc = "acceleration" },
  tau     = { 0.02, unit = "R/c", min = 0, max = 1, doc = "retardation time of the ball's springs (Kelvin-Voigt)" },
  film    = { false, doc = "also a film, ball.mp4; needs ffmpeg" },
  full    = { false, doc = "30 lattices of 800 nodes" },
}
local samples, nodes = p.full and 30 or p.samples, p.full and 800 or 200

local fastest = math.sqrt(2 * p.g * p.height)
local mass = 800  -- of the ball [m0]
local function scene(sample, launch, gravity)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = nodes, mass = mass / nodes, placement = "poisson_disk", seed = sample },
    target = ricochet.plane {},
    launch = launch,
    contact = { xi = 2000, V0 = mass * fastest ^ 2, reach = 0.02 },
    effects = { ricochet.damping { time = p.tau, on = "projectile" }, gravity },
  }
end
local function falling(sample)
  return scene(sample, { height = p.height, speed = 0 }, ricochet.gravity { g = p.g })
end

-- The bounces of all lattices, and by number.
local of_bounce, speeds = {}, {}
for sample = 1, samples do
  for _, row in ipairs(falling(sample):bounces { count = p.bounces }) do
    of_bounce[row.bounce] = of_bounce[row.bounce] or {}
    table.insert(of_bounce[row.bounce], row)
  end
end
local function mean_and_se(list, column)
  local sum, square = 0, 0
  for _, row in ipairs(list) do sum = sum + row[column] end
  for _, row in ipairs(list) do square = square + (row[column] - sum / #list) ^ 2 end
  return sum / #list, #list > 1 and math.sqrt(square / (#list - 1) / #list) or 0 / 0
end
for k, list in ipairs(of_bounce) do speeds[k] = mean_and_se(list, "speed") end

local still = ricochet.sweep {
  name = "still",
  over = { sample = ricochet.range(samples), speed = speeds },
  scene = function(at) return scene(at.sample, { speed = at.speed }) end,
}:run()

print "bounce  speed [c]  height [R]   e of bounces      e of balls that were still"
local bouncing, quiet = {}, {}
for k, list in ipairs(of_bounce) do
  local e, se = mean_and_se(list, "e")
  local alone = still:where { speed = speeds[k] }:summary { by = "speed", of = { "e" } }[1].e
  print(("%6d  %9.4f  %10.4f   %.4f +- %.4f  %.4f +- %.4f"):format(k, speeds[k], mean_and_se(list, "height"), e, se,
    alone.mean, alone.se))
  for _, row in ipairs(list) do bouncing[#bouncing + 1] = { row.speed, row.e } end
end
for _, row in ipairs(still) do quiet[#quiet + 1] = { row.speed, row.e } end

ricochet.plot {
  rows = still, x = "speed", y = { "e" }, name = "bounces",
  published = { e = { { name = "bounces, one after another", points = bouncing } } },
  xlabel = "speed at the first touch [c]",
  title = "e of a damped ball that bounces under gravity",
  caption = ("Disk of %d nodes on a rigid plane, τ = %g R/c, from %g R, g = %g c²/R, %d lattices. Filled: balls that " ..
    "were still."):format(nodes, p.tau, p.height, p.g, samples),
}

local show = { title = "a damped ball under gravity", plot = "height", material = "energy_density", ledger = true }
local fall = math.sqrt(2 * p.height / p.g)
ricochet.contact_sheet {
  scene = falling(1), times = { -fall, 0.5, 0.8 * fall, 2 * fall, 3 * fall, 4.5 * fall }, columns = 3, out = "ball",
  size = { 1500, 900 }, show = show,
}
if p.film then
  ricochet.animate { scene = falling(1), frames = 450, from = -fall, duration = 6 * fall, film = "ball.mp4", show = show }
end
