-- Lesson: a ball drops and bounces. Where does the energy go? 18 drops: six heights, three floors. It leaves
-- lesson.html, a page for a class, in about 4 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nodes  = { 400, int = true, min = 40, max = 2000, doc = "nodes of the ball; a floor has four times as many" },
  frames = { 60, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

-- Hard and soft rubber, which lose nothing to heat here: springs of their stiffness.
local hard = ricochet.material { E = 10e6, nu = 0.33, density = 1100 }
local soft = ricochet.material { E = 1e6, nu = 0.33, density = 1100 }
local function mat(material)
  return ricochet.wall { width = 0.36, depth = 0.12, nodes = 4 * p.nodes, material = material, thickness = 0.03 }
end
local floors = { stone = ricochet.plane {}, ["hard mat"] = mat(hard), ["soft mat"] = mat(soft) }

local drops = ricochet.sweep {
  name = "lesson_drops",
  over = { height = { 0.1, 0.25, 0.5, 1, 1.5, 2 }, floor = { "stone", "hard mat", "soft mat" } },
  units = { height = "m" },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.disk { radius = 0.03, nodes = p.nodes, material = hard, thickness = 0.03 },
      target = floors[at.floor],
      launch = { speed = math.sqrt(2 * 9.81 * at.height) },  -- as fast as it is after the fall
      method = "pefrl",  -- keeps energy to more digits than the page shows
    }
  end,
}
for _, row in ipairs(drops:run()) do
  row.speed = math.sqrt(2 * 9.81 * row.height)
  row.back = 100 * row.after_projectile_translation / row.before_total
  row.rise = row.height * row.e ^ 2
  row.ball = 100 * row.after_projectile_vibration / row.before_total
  row.ground = 100 * row.after_target_vibration / row.before_total
  row.contact_ms = 1000 * row.contact_time
end

ricochet.lesson {
  grid = drops,
  title = "Drop and bounce: where does the energy go?",
  names = { "ball", "floor" },
  minutes = 15,
  processor_time = 4,
  frames = p.frames,
  intro = {
    "A rubber ball falls onto a floor and bounces. This ball is perfect: its rubber turns no energy into heat, and "
      .. "there is no air. Does it come back to where it started?",
    "Choose a height and a floor. Guess how much of the energy of the fall comes back as movement upwards. Then let "
      .. "it go.",
  },
  sliders = {
    { of = "height", label = "Height of the fall", unit = "m" },
    { of = "floor", label = "Floor" },
  },
  guess = { of = "back", question = "How much of its energy of movement does the ball get back?", from = 0, to = 100,
    step = 1 },
  results = {
    { of = "back", label = "Energy that comes back", unit = "%" },
    { of = "ball", label = "left as wobble of the ball", unit = "%" },
    { of = "ground", label = "left as waves in the floor", unit = "%" },
    { of = "speed", label = "Speed when it lands", unit = "m/s" },
    { of = "vn", label = "Speed when it leaves", unit = "m/s" },
    { of = "rise", label = "It rises to", unit = "m" },
    { of = "contact_ms", label = "It touches the floor for", unit = "ms" },
  },
  graph = { x = "height", by = "floor" },
  intuition = {
    wrong = "“A perfect ball bounces back to the height it fell from. If it does not, energy has been lost.”",
    right = "No energy is lost here, and still the ball comes back lower: from 1 m onto the soft mat it rises to "
      .. "{rise height=1 floor='soft mat'} m. The rest of the energy is still there. It moves the rubber to and fro, "
      .. "inside the ball and inside the floor. That is wobble and waves, not movement upwards.",
  },
  questions = {
    { ask = "Which floor gives back the most energy, and which the least? Look at 1 m.",
      answer = "Stone: {back height=1 floor=stone} %. Then the hard mat: {back height=1 floor='hard mat'} %. The "
        .. "soft mat gives back {back height=1 floor='soft mat'} %." },
    { ask = "The ball falls from 2 m onto the hard mat. Where is the energy afterwards?",
      answer = "{back height=2 floor='hard mat'} % is movement of the ball, {ball height=2 floor='hard mat'} % is "
        .. "wobble inside the ball, and {ground height=2 floor='hard mat'} % is waves in the mat. Together that is "
        .. "everything." },
    { ask = "On stone, nothing in the floor can move. Why does the ball not come back with 100 %?",
      answer = "The ball itself wobbles after the bounce. From 1 m that takes {ball height=1 floor=stone} % of the "
        .. "energy." },
    { ask = "On the hard mat, does the share that comes back depend on the height?",
      answer = "Yes. It falls from {back height=0.1 floor='hard mat'} % at 0.1 m to {back height=2 floor='hard mat'} "
        .. "% at 2 m. On stone it hardly changes: {back height=0.1 floor=stone} % and {back height=2 floor=stone} %." },
    { ask = "A real ball also gets a little warm. Would it rise higher or lower than this one?",
      answer = "Lower. Heat is one more place for the energy to go." },
  },
  teacher = {
    "Aim: energy is conserved, but not all of it is movement of the ball as a whole. Let each pupil write down a "
      .. "guess for stone first; most say 100 %. Compare stone with the soft mat from the same height. In “Energy "
      .. "before and after” the sum stays what it was, and “Where the energy is” shows who has it when.",
    "What goes wrong: pupils read “energy that comes back” as “height”. For a perfect fall they are the same share, "
      .. "because both are proportional to the square of the speed. Some say that the rest is heat. There is no heat "
      .. "here.",
    "The model: a round slice of rubber (radius 3 cm, 3 cm thick, E = 10 MPa), made of " .. p.nodes .. " points "
      .. "joined by springs, falls on a rigid plane or on a block of 36 cm by 12 cm that is held at its sides and "
      .. "bottom. The mat is of the same rubber or ten times softer. Gravity is left out during the bounce, which "
      .. "takes some thousandths of a second.",
  },
}
