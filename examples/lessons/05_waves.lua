-- Lesson: a rod lands on its end, and a wave runs up and down in it. How fast is the wave? 24 impacts: four lengths,
-- three materials, two speeds. It leaves lesson.html, a page for a class, in about 3 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  side   = { 5, unit = "mm", min = 2, max = 20, doc = "size of the rod's elements" },
  frames = { 80, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

local density = 1100
local function rubber(MPa) return ricochet.material { E = 1e6 * MPa, nu = 0, density = density } end

local landings = ricochet.sweep {
  name = "lesson_rods",
  over = { length = { 10, 20, 30, 40 }, stiffness = { 5, 20, 80 }, speed = { 1, 2 } },
  units = { length = "cm", stiffness = "MPa", speed = "m/s" },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.rectangle { width = 0.04, height = 0.01 * at.length, interior = "elements",
        material = rubber(at.stiffness), h_min = 1e-3 * p.side, h_max = 1e-3 * p.side, thickness = 0.04 },
      target = ricochet.plane {},
      launch = { speed = at.speed },
      accuracy = 1e-2,
    }
  end,
}
for _, row in ipairs(landings:run()) do
  row.contact_ms = 1000 * row.contact_time
  row.wave = 2 * 0.01 * row.length / row.contact_time
  row.theory = math.sqrt(1e6 * row.stiffness / density)
end

ricochet.lesson {
  grid = landings,
  title = "Waves: how does the top of a rod know that the bottom has landed?",
  names = { "rod", "floor" },
  minutes = 15,
  processor_time = 3,
  frames = p.frames,
  intro = {
    "A rubber rod falls on its end. When the bottom stops, the top does not know it yet: the news has to run up the "
      .. "rod, as a wave. Then it runs down again. Only then does the rod leave the floor.",
    "Watch the dark part: there the rod stands still. Guess how long the rod touches the floor, then let it go.",
  },
  sliders = {
    { of = "length", label = "Length of the rod", unit = "cm" },
    { of = "stiffness", label = "Stiffness of the rubber", unit = "MPa" },
    { of = "speed", label = "Speed of the fall", unit = "m/s" },
  },
  guess = { of = "contact_ms", question = "How long does the rod touch the floor?", from = 0, to = 14, step = 0.1 },
  results = {
    { of = "contact_ms", label = "It touches the floor for", unit = "ms", digits = 4 },
    { of = "wave", label = "Twice the length, divided by this time", unit = "m/s" },
    { of = "vn", label = "Speed when it leaves", unit = "m/s" },
  },
  graph = { x = "length", by = "stiffness" },
  intuition = {
    wrong = "“A rod is stiff, so all of it stops at once. And if it falls faster, everything happens faster.”",
    right = "The top flies on until the wave arrives. And the wave does not care how fast the rod falls: the rod of "
      .. "20 cm and 20 MPa touches the floor for {contact_ms length=20 stiffness=20 speed=1} ms at 1 m/s, and for "
      .. "{contact_ms length=20 stiffness=20 speed=2} ms at 2 m/s. The wave's speed belongs to the material.",
  },
  questions = {
    { ask = "A rod is twice as long. What happens to the time of the touch? Compare 20 cm and 40 cm at 20 MPa.",
      answer = "It doubles: {contact_ms length=20 stiffness=20 speed=1} ms and "
        .. "{contact_ms length=40 stiffness=20 speed=1} ms at 1 m/s. The wave has twice as far to go." },
    { ask = "Find the speed of the wave from two moments. Take the rod of 40 cm and 20 MPa, and note when the bottom "
      .. "touches and when it leaves. How far has the wave run meanwhile?",
      answer = "Up and down, 2 × 40 cm. That takes {contact_ms length=40 stiffness=20 speed=1} ms, so the wave runs "
        .. "at {wave length=40 stiffness=20 speed=1} m/s." },
    { ask = "The rubber is four times as stiff. What happens to the speed of the wave? Compare 5, 20 and 80 MPa at "
      .. "40 cm.",
      answer = "It doubles each time: {wave length=40 stiffness=5 speed=1}, {wave length=40 stiffness=20 speed=1} "
        .. "and {wave length=40 stiffness=80 speed=1} m/s. Twice, not four times: the speed goes with the square "
        .. "root." },
    { ask = "Does the speed of the fall change the speed of the wave?",
      answer = "No. At 40 cm and 20 MPa it is {wave length=40 stiffness=20 speed=1} m/s for a fall at 1 m/s, and "
        .. "{wave length=40 stiffness=20 speed=2} m/s at 2 m/s." },
    { ask = "Stop the replay when the wave is at the top. What does the whole rod do at that moment, and where is "
      .. "the energy?",
      answer = "It stands still, and is squeezed from end to end. All its energy of movement is squeeze now: the "
        .. "chart “Where the energy is” shows movement near zero." },
  },
  teacher = {
    "Aim: nothing in a body happens everywhere at once; news runs at the speed of sound. The replay at a quarter of "
      .. "the speed shows it best. Colours show how fast each part moves: dark is at rest.",
    "What goes wrong: pupils take the speed of the rod for the speed of the wave. Question 4 is for them. The touch "
      .. "is a little longer than two lengths over the speed of sound, as the rod's end is not perfectly hard: the "
      .. "formula √(E/ρ) gives {theory length=40 stiffness=20 speed=1} m/s for 20 MPa, and the rod of 40 cm shows "
      .. "{wave length=40 stiffness=20 speed=1} m/s. The shorter the rod, the more that counts: "
      .. "{wave length=10 stiffness=20 speed=1} m/s at 10 cm.",
    "The model: a bar 4 cm wide of finite elements, with Poisson's ratio 0, so that it is a wave in one dimension; "
      .. "density " .. density .. " kg/m³; on a rigid plane, without gravity.",
  },
}
