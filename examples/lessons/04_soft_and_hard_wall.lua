-- Lesson: the same ball at the same speed hits soft and hard walls. How large is the force? 18 impacts: six walls,
-- three speeds. It leaves lesson.html, a page for a class, in about 5 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nodes  = { 400, int = true, min = 40, max = 2000, doc = "nodes of the ball; the wall has four times as many" },
  frames = { 60, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

local function rubber(MPa) return ricochet.material { E = 1e6 * MPa, nu = 0.33, density = 1100 } end

local impacts = ricochet.sweep {
  name = "lesson_walls",
  over = { wall = { 0.3, 1, 3, 10, 30, 100 }, speed = { 1, 2, 3 } },
  units = { wall = "MPa", speed = "m/s" },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.disk { radius = 0.03, nodes = p.nodes, material = rubber(10), thickness = 0.03 },
      target = ricochet.wall { width = 0.36, depth = 0.12, nodes = 4 * p.nodes, material = rubber(at.wall),
        thickness = 0.03 },
      launch = { speed = at.speed },
      accuracy = 1e-2,
    }
  end,
}
for _, row in ipairs(impacts:run()) do
  row.force = row.impulse_n / row.contact_time
  row.contact_ms = 1000 * row.contact_time
  row.deep_mm = 1000 * row.overlap
end

ricochet.lesson {
  grid = impacts,
  title = "Soft and hard wall: how large is the force?",
  names = { "ball", "wall" },
  minutes = 10,
  processor_time = 5,
  frames = p.frames,
  intro = {
    "A rubber ball hits a wall and bounces off. The wall may be soft (0.3 MPa, like foam rubber) or much harder than "
      .. "the ball (100 MPa). The ball itself has 10 MPa. MPa tells how stiff something is.",
    "Guess the mean force while they touch. Then let it go.",
  },
  sliders = {
    { of = "wall", label = "Stiffness of the wall", unit = "MPa" },
    { of = "speed", label = "Speed of the ball", unit = "m/s" },
  },
  guess = { of = "force", question = "How large is the mean force while they touch?", from = 0, to = 300, step = 5 },
  results = {
    { of = "force", label = "Mean force", unit = "N" },
    { of = "contact_ms", label = "They touch for", unit = "ms", digits = 4 },
    { of = "impulse_n", label = "Change of momentum", unit = "kg m/s" },
    { of = "deep_mm", label = "Ball and wall give way by", unit = "mm" },
    { of = "vn", label = "Speed when it leaves", unit = "m/s" },
  },
  graph = { x = "wall", by = "speed", log = true },
  intuition = {
    wrong = "“The force of a bounce depends on how heavy the ball is and how fast it flies. The wall has no say.”",
    right = "The same ball at 2 m/s pushes the softest wall with {force wall=0.3 speed=2} N, and the hardest one "
      .. "with {force wall=100 speed=2} N. The change of momentum differs much less: {impulse_n wall=0.3 speed=2} "
      .. "and {impulse_n wall=100 speed=2} kg m/s. What differs is the time: {contact_ms wall=0.3 speed=2} ms and "
      .. "{contact_ms wall=100 speed=2} ms. Force is change of momentum divided by time.",
  },
  questions = {
    { ask = "At 2 m/s, how long does the ball touch the softest wall, and how long the hardest?",
      answer = "{contact_ms wall=0.3 speed=2} ms and {contact_ms wall=100 speed=2} ms." },
    { ask = "Take the wall of 1 MPa. The speed doubles from 1 m/s to 2 m/s. What happens to the time of the touch, "
      .. "and what to the force?",
      answer = "The time stays about the same: {contact_ms wall=1 speed=1} ms and {contact_ms wall=1 speed=2} ms. "
        .. "The force about doubles, from {force wall=1 speed=1} N to {force wall=1 speed=2} N." },
    { ask = "Check the rule at 10 MPa and 3 m/s: divide the change of momentum by the time.",
      answer = "{impulse_n wall=10 speed=3} kg m/s divided by {contact_ms wall=10 speed=3} ms is "
        .. "{force wall=10 speed=3} N." },
    { ask = "From which wall does the ball leave fastest at 2 m/s? Where is the energy that the soft wall did not "
      .. "give back?",
      answer = "From the wall of {wall speed=2 greatest=vn} MPa: {vn speed=2 greatest=vn} m/s. A soft wall keeps "
        .. "waves in itself, as the chart “Where the energy is” shows." },
    { ask = "Why do gymnasts land on mats, and why do cars have airbags?",
      answer = "The body stops from the same speed, but it takes longer. The same change of momentum in a longer "
        .. "time needs a smaller force." },
  },
  teacher = {
    "Aim: force is change of momentum over time. Fix the speed at 2 m/s first and let each pupil guess two walls. "
      .. "The axis of the graph is logarithmic: each step is about three times as stiff.",
    "What goes wrong: pupils think that the hard wall “gives more back” and that this alone makes the force larger. "
      .. "Compare the two changes of momentum: they differ by a factor below two, the forces by far more. Beyond 10 "
      .. "MPa it is the ball that gives way, so a still harder wall changes less.",
    "The model: a slice of rubber (radius 3 cm, 3 cm thick, E = 10 MPa, 93 g) of " .. p.nodes .. " points joined by "
      .. "springs, on a block of 36 cm by 12 cm that is held at its sides and bottom. No gravity, no heat. The mean "
      .. "force is the change of momentum divided by the time of the touch; the greatest force stands in the chart.",
  },
}
