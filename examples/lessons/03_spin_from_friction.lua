-- Lesson: how friction makes a ball spin, up to the superball, which grips. 24 bounces: four frictions, six angles.
-- It leaves lesson.html, a page for a class, in about 4 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  fine   = { 1.2, unit = "mm", min = 0.5, max = 5, doc = "size of the ball's elements where it touches" },
  frames = { 60, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

local rubber = ricochet.material { E = 10e6, nu = 0.33, density = 1100 }

local bounces = ricochet.sweep {
  name = "lesson_spins",
  over = { friction = { 0, 0.2, 0.5, 1 }, angle = { 0, 15, 30, 45, 60, 75 } },
  units = { angle = "degrees" },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.disk { radius = 0.03, interior = "elements", h_min = 1e-3 * p.fine, h_max = 0.005,
        grade = 0.2, material = rubber, thickness = 0.03 },
      target = ricochet.plane {},
      launch = { speed = 5, angle = at.angle },
      effects = { ricochet.friction { mu = at.friction } },
      accuracy = 1e-2,
    }
  end,
}
for _, row in ipairs(bounces:run()) do
  row.turns = math.abs(row.omega) / (2 * math.pi)
  row.slide = 5 * math.sin(math.rad(row.angle))
  row.rim = row.vt + 0.03 * row.omega  -- the lowest point of the ball, along the floor
  row.heat = 100 * row.friction_energy / row.before_total
end

ricochet.lesson {
  grid = bounces,
  title = "Spin from friction: why does a superball turn back?",
  names = { "ball", "floor" },
  minutes = 15,
  processor_time = 4,
  frames = p.frames,
  intro = {
    "A ball flies at 5 m/s against a floor. It does not spin. You choose the angle: 0° is straight down, 75° almost "
      .. "along the floor. You also choose the friction: 0 is wet ice, 1 is a superball on a rough floor.",
    "Guess how fast the ball spins after the bounce. Then let it go, and watch the white line.",
  },
  sliders = {
    { of = "angle", label = "Angle from straight down", unit = "°" },
    { of = "friction", label = "Friction", texts = { "0 (wet ice)", "0.2 (polished)", "0.5 (wood)", "1 (superball)" } },
  },
  guess = { of = "turns", question = "How many turns a second does the ball make after the bounce?", from = 0, to = 30,
    step = 0.5 },
  results = {
    { of = "turns", label = "Spin after the bounce", unit = "turns a second" },
    { of = "slide", label = "Speed along the floor before", unit = "m/s" },
    { of = "vt", label = "Speed along the floor after", unit = "m/s" },
    { of = "rim", label = "Speed of its lowest point after", unit = "m/s" },
    { of = "heat", label = "Energy that friction took", unit = "%" },
  },
  graph = { x = "angle", by = "friction" },
  intuition = {
    wrong = "“The more friction, the more spin, and the more energy is lost.”",
    right = "Friction that is weak lets the ball slide, and then more friction does give more spin. But once the "
      .. "ball grips, more friction gives no more spin. At 15° a friction of 0.2 gives {turns angle=15 friction=0.2} "
      .. "turns a second, and a friction of 1 gives {turns angle=15 friction=1}. And what grips does not rub: at 60° "
      .. "a friction of 1 takes {heat angle=60 friction=1} % of the energy, a friction of 0.5 takes "
      .. "{heat angle=60 friction=0.5} %.",
  },
  questions = {
    { ask = "On wet ice, how fast does the ball spin after the bounce? Why?",
      answer = "It does not spin: {turns angle=60 friction=0} turns a second at 60°. Without friction the floor only "
        .. "pushes towards the middle of the ball. Such a push cannot turn it." },
    { ask = "Keep the friction at 0.2. At which of the angles does the ball spin fastest?",
      answer = "At {angle friction=0.2 greatest=turns}°: {turns friction=0.2 greatest=turns} turns a second. "
        .. "Straight down there is nothing to turn it. Almost along the floor it lands so softly that friction is "
        .. "weak." },
    { ask = "Look at the lowest point of the ball at 45°. Which way does it move after the bounce on wet ice, and "
      .. "which way with the superball?",
      answer = "On ice it goes on at {rim angle=45 friction=0} m/s. With the superball its speed is "
        .. "{rim angle=45 friction=1} m/s: below zero, so it moves backwards. That is how a superball can turn back "
        .. "at the second bounce." },
    { ask = "Of all settings, which one spins fastest?",
      answer = "{angle greatest=turns}° with a friction of {friction greatest=turns}: {turns greatest=turns} turns a "
        .. "second." },
    { ask = "At 60°, which friction takes the most energy?",
      answer = "{friction angle=60 greatest=heat}: it takes {heat angle=60 greatest=heat} %. With more friction the "
        .. "ball grips instead of sliding, and with less there is little to rub." },
  },
  teacher = {
    "Aim: friction turns a ball, sliding and gripping differ, and heat comes from sliding only. Start at 60°, and go "
      .. "through the four frictions. Then do the same at 15°, where the order turns round.",
    "What goes wrong: pupils take friction for a loss, always. Ask where friction took most energy. Some expect the "
      .. "ball to spin the other way: the floor holds back its lowest point, so its top goes on.",
    "The model: a slice of rubber (radius 3 cm, E = 10 MPa) of finite elements on a rigid plane, with Coulomb's "
      .. "friction. That the lowest point turns back (β > 0) needs a ball that can be twisted and springs back; a "
      .. "rigid ball would roll at best.",
  },
}
