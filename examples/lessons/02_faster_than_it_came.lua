-- Lesson: a rugby ball can leave the floor faster than it came, e > 1. Is energy conserved? 30 bounces: six tilts,
-- five spins. It leaves lesson.html, a page for a class, in about 2 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nodes  = { 400, int = true, min = 60, max = 2000, doc = "nodes of the ball" },
  frames = { 60, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

local speed = 4  -- m/s, downwards
local rubber = ricochet.material { E = 10e6, nu = 0.33, density = 1100 }

local bounces = ricochet.sweep {
  name = "lesson_tilts",
  over = { tilt = { 0, 15, 30, 45, 60, 75 }, turns = { -6, -3, 0, 3, 6 } },
  units = { tilt = "degrees", turns = "1/s" },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.ellipse { a = 0.14, b = 0.095, nodes = p.nodes, material = rubber, thickness = 0.1,
        angle = at.tilt },
      target = ricochet.plane {},
      launch = { speed = speed, spin = 2 * math.pi * at.turns },
      accuracy = 1e-2,
    }
  end,
}
for _, row in ipairs(bounces:run()) do
  local function share(energy) return 100 * energy / row.before_total end
  row.moves_before, row.spins_before = share(row.before_projectile_translation), share(row.before_projectile_rotation)
  row.moves, row.spins = share(row.after_projectile_translation), share(row.after_projectile_rotation)
  row.wobbles = share(row.after_projectile_vibration)
  row.turns_after = math.abs(row.omega) / (2 * math.pi)
end

ricochet.lesson {
  grid = bounces,
  title = "Faster than it came: is energy conserved?",
  names = { "ball", "floor" },
  minutes = 15,
  processor_time = 2,
  frames = p.frames,
  intro = {
    "A rugby ball drops onto stone. It lands at " .. speed .. " m/s. You choose its tilt (at 0° it lies flat) and "
      .. "its spin.",
    "The bounce number e is the speed upwards after the bounce, divided by the speed downwards before it. Can e be "
      .. "more than 1? Guess the speed after the bounce, then let it go.",
  },
  sliders = {
    { of = "tilt", label = "Tilt", unit = "°" },
    { of = "turns", label = "Spin", texts = { "6 turns a second clockwise", "3 turns a second clockwise", "no spin",
      "3 turns a second anticlockwise", "6 turns a second anticlockwise" } },
  },
  guess = { of = "vn", question = "It lands at " .. speed .. " m/s. How fast does it go up afterwards?",
    from = 0, to = 6, step = 0.1 },
  results = {
    { of = "vn", label = "Speed upwards after the bounce", unit = "m/s" },
    { of = "e", label = "Bounce number e" },
    { of = "moves_before", label = "Energy before: movement", unit = "%" },
    { of = "spins_before", label = "Energy before: spin", unit = "%" },
    { of = "moves", label = "Energy after: movement", unit = "%" },
    { of = "spins", label = "Energy after: spin", unit = "%" },
    { of = "wobbles", label = "Energy after: wobble", unit = "%" },
  },
  graph = { x = "tilt", by = "turns" },
  intuition = {
    wrong = "“Nothing can bounce back faster than it came. That would make energy out of nothing.”",
    right = "The second sentence is true, the first is not. At a tilt of {tilt greatest=e}° the ball leaves with e = "
      .. "{e greatest=e}. Nothing was made out of nothing: before the bounce {spins_before greatest=e} % of the "
      .. "energy was spin, and afterwards only {spins greatest=e} %. The bounce turned spin into movement.",
  },
  questions = {
    { ask = "The ball does not spin before the bounce. At which tilt does it leave fastest, and how large is e there?",
      answer = "At {tilt turns=0 greatest=e}°, lying flat: e = {e turns=0 greatest=e}." },
    { ask = "It does not spin, and its tilt is 45°. Where did the energy go?",
      answer = "{spins tilt=45 turns=0} % of it is now spin, and {moves tilt=45 turns=0} % is movement: the floor "
        .. "pushes one end of the ball, so the ball starts to turn." },
    { ask = "Find the setting with the greatest e. How much of the energy was spin before, and how much is spin "
      .. "after?",
      answer = "Tilt {tilt greatest=e}°, {turns greatest=e}: e = {e greatest=e}. Spin had {spins_before greatest=e} "
        .. "% of the energy before and has {spins greatest=e} % after." },
    { ask = "Find the setting with the least e. Where is the energy then?",
      answer = "Tilt {tilt least=e}°, {turns least=e}: e = {e least=e}. {spins least=e} % of the energy is spin. The "
        .. "bounce turned movement into spin." },
    { ask = "Add movement, spin and wobble after any bounce. What do you get?",
      answer = "100 %, apart from rounding. Energy is conserved." },
  },
  teacher = {
    "Aim: e > 1 does not break the conservation of energy; e compares speeds of the centre, not energies. Ask for a "
      .. "guess at 60° and 6 turns anticlockwise first: hardly anyone dares to go above " .. speed .. " m/s. Then "
      .. "let the table “Energy before and after” decide.",
    "What goes wrong: pupils look at the movement alone and see energy appear. Point at the row “spin” in the table. "
      .. "Clockwise and anticlockwise differ once the ball is tilted: one spin drives the low end into the floor, "
      .. "the other takes it away.",
    "The model: a slice of rubber in the shape of an ellipse (28 cm by 19 cm, E = 10 MPa), of " .. p.nodes .. " "
      .. "points joined by springs, on a rigid plane without friction. Round balls can have e > 1, too, where they "
      .. "graze a soft wall: examples/03_super_rebound.lua.",
  },
}
