-- A damped ball falls on a rigid floor and bounces under gravity, each lattice in one run. Beside every bounce the same
-- lattice, held still and dropped from the height of the rise before: what it still vibrates of its last impact changes
-- e, or does not. samples=2 is a quick try; full=true draws the figure in full (about 3 minutes).
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 12, int = true, min = 2, doc = "lattices of 400 nodes" },
  bounces = { 8, int = true, min = 1, doc = "followed of each lattice" },
  height  = { 1, unit = "R", min = 0.1, max = 100, doc = "from which the ball falls" },
  g       = { 1e-2, unit = "c^2/R", min = 1e-6, max = 0.1, doc = "acceleration" },
  tau     = { 0.02, unit = "R/c", min = 0, max = 1, doc = "retardation time of the ball's springs (Kelvin-Voigt)" },
  film    = { false, doc = "also a film, ball.mp4; needs ffmpeg" },
  full    = { false, doc = "40 lattices of 800 nodes" },
}
local samples, nodes = p.full and 40 or p.samples, p.full and 800 or 400

local mass = 800  -- of the ball [m0]
local function falling(sample, height)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = nodes, mass = mass / nodes, placement = "poisson_disk", seed = sample },
    target = ricochet.plane {},
    launch = { height = height, speed = 0 },
    contact = { xi = 2000, V0 = 2 * mass * p.g * p.height, reach = 0.02 },
    effects = { ricochet.gravity { g = p.g }, ricochet.damping { time = p.tau, on = "projectile" } },
  }
end

-- By number, the bounces of all lattices.
local bounces = {}
for sample = 1, samples do
  for k, row in ipairs(falling(sample, p.height):bounces { count = p.bounces }) do
    row.sample = sample
    bounces[k] = bounces[k] or {}
    table.insert(bounces[k], row)
  end
end

-- Mean and standard error of value(row).
local function statistics(rows, value)
  local sum, square = 0, 0
  for _, row in ipairs(rows) do sum = sum + value(row) end
  for _, row in ipairs(rows) do square = square + (value(row) - sum / #rows) ^ 2 end
  return sum / #rows, #rows > 1 and math.sqrt(square / (#rows - 1) / #rows) or 0 / 0
end

-- Balls held still are dropped from the mean height before each bounce.
local drops, speeds = { p.height }, {}
for k, rows in ipairs(bounces) do
  speeds[k] = statistics(rows, function(row) return row.speed end)
  if bounces[k + 1] then drops[k + 1] = statistics(rows, function(row) return row.height end) end
end
local rows = ricochet.sweep {
  name = "held",
  over = { sample = ricochet.range(samples), drop = drops },
  scene = function(at) return falling(at.sample, at.drop) end,
}:run()

local held = {}  -- [drop][sample]: e
for _, row in ipairs(rows) do
  held[row.drop] = held[row.drop] or {}
  held[row.drop][row.sample] = row.e
  row.ball = "held still, and dropped"
  for k, drop in ipairs(drops) do
    if row.drop == drop then row.speed = speeds[k] end
  end
end
print "bounce  speed [c]  rise [R]        e        more than held still"
local more_of = {}  -- [sample]: mean over all bounces but the first, which are one and the same impact
for k, list in ipairs(bounces) do
  local height = statistics(list, function(row) return row.height end)
  local e, e_se = statistics(list, function(row) return row.e end)
  local more, more_se = statistics(list, function(row) return row.e - held[drops[k]][row.sample] end)
  print(("%6d  %9.4f  %8.4f  %.4f +- %.4f  %+.4f +- %.4f"):format(k, speeds[k], height, e, e_se, more, more_se))
  for _, row in ipairs(list) do
    local difference = (row.e - held[drops[k]][row.sample]) / (#bounces - 1)
    if k > 1 then more_of[row.sample] = (more_of[row.sample] or 0) + difference end
    row.ball, row.speed = "bouncing", speeds[k]
    rows[#rows + 1] = row
  end
end
if #bounces > 1 then
  print(("bounces 2 to %d: e is higher than held still by %+.4f +- %.4f"):format(#bounces,
    statistics(more_of, function(more) return more end)))
end

ricochet.plot {
  rows = rows, x = "speed", y = { "e" }, by = "ball", name = "bounces",
  xlabel = "normal speed at the first touch [c]",
  title = "A damped ball that bounces under gravity",
  caption = ("Disk of %d nodes on a rigid plane, τ = %g R/c, from %g R at g = %g c²/R, %d lattices."):format(nodes,
    p.tau, p.height, p.g, samples),
}

local fall = math.sqrt(2 * p.height / p.g)
local show = { title = "A damped ball under gravity", plot = "height", ledger = true }
ricochet.contact_sheet {
  scene = falling(1, p.height), times = { -fall, 0.6, 0.9 * fall, 1.8 * fall, 2.6 * fall, 4.2 * fall }, columns = 3,
  out = "ball", size = { 1500, 900 }, show = show,
}
if p.film then
  ricochet.animate { scene = falling(1, p.height), frames = 450, from = -fall, duration = 6 * fall, film = "ball.mp4",
    show = show }
end
