-- Lesson: 32 bumpy balls, each a little different. How well do we know their mean, and how sure can we be of the next
-- one? It leaves lesson.html, a page for a class, in about 1 s of processor time.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nodes  = { 400, int = true, min = 40, max = 2000, doc = "nodes of a ball" },
  frames = { 50, int = true, min = 2, max = 400, doc = "pictures of each replay" },
}

local rubber = ricochet.material { E = 10e6, nu = 0.33, density = 1100 }

local throws = ricochet.sweep {
  name = "lesson_throws",
  over = { ball = ricochet.range(32) },
  scene = function(at)
    return ricochet.scene {
      units = "SI",
      projectile = ricochet.disk { radius = 0.03, nodes = p.nodes, roughness = 0.0009, seed = at.ball,
        material = rubber, thickness = 0.03 },
      target = ricochet.plane {},
      launch = { speed = 1 },
      accuracy = 1e-2,
    }
  end,
}
-- The mean of the first n balls, its standard error and the scatter of single ones.
local sum, squares = 0, 0
for n, row in ipairs(throws:run()) do
  row.up = 100 * row.vn
  sum, squares = sum + row.up, squares + row.up ^ 2
  row.mean = sum / n
  row.scatter = n > 1 and math.sqrt(math.max(0, (squares - n * row.mean ^ 2) / (n - 1))) or 0 / 0
  row.error = row.scatter / math.sqrt(n)
end

ricochet.lesson {
  grid = throws,
  title = "How sure are we? 32 balls, each a little different",
  names = { "ball", "floor" },
  minutes = 20,
  processor_time = 1,
  frames = p.frames,
  intro = {
    "Here are 32 rubber balls. They are meant to be alike, but each has its own small bumps. Each lands on stone at "
      .. "1 m/s, which is 100 cm/s. It comes back a little slower.",
    "Guess how fast the next ball comes back. Then let it go. After some balls you will have a mean, and an error "
      .. "bar that tells how well you know it.",
  },
  sliders = { { of = "ball", label = "Ball number" } },
  guess = { of = "up", question = "It lands at 100 cm/s. How fast does this ball come back?",
    from = 60, to = 100, step = 1 },
  results = {
    { of = "up", label = "Speed when it leaves", unit = "cm/s" },
  },
  graph = { x = "tries" },
  intuition = {
    wrong = "“The more we measure, the better we can tell what the next ball will do.”",
    right = "The more we measure, the better we know the mean. After 4 balls its standard error is {error:2 ball=4} "
      .. "cm/s, after 16 it is {error:2 ball=16}. But single balls scatter as much as ever: by {scatter:2 ball=16} "
      .. "cm/s after 16 balls and by {scatter:2 ball=32} after 32. The next ball is as uncertain as the first one "
      .. "was.",
  },
  questions = {
    { ask = "Let balls 1 to 4 go. What is the mean of their speeds, and its standard error?",
      answer = "{mean ball=4} cm/s, with a standard error of {error:2 ball=4} cm/s." },
    { ask = "Go on to ball 16. What are mean and standard error now? By what factor did the error shrink?",
      answer = "{mean ball=16} cm/s and {error:2 ball=16} cm/s, from {error:2 ball=4} cm/s. Four times as many balls "
        .. "make the error about half as large: it goes with one over the square root of their number." },
    { ask = "Does the scatter of single balls shrink as well?",
      answer = "No. It is {scatter:2 ball=4} cm/s for the first 4 balls, {scatter:2 ball=16} cm/s for 16 and "
        .. "{scatter:2 ball=32} cm/s for 32." },
    { ask = "How many balls would you need to halve the error that 16 balls have? Try it, as far as there are balls.",
      answer = "Four times 16, which is 64. With 32 it is {error:2 ball=32} cm/s. One over the square root is a rule "
        .. "for many tries: one slow ball among the last 16 widens the error again." },
    { ask = "Somebody says: “The mean of my 4 balls is {mean ball=4}, yours of 32 is {mean ball=32}. One of us is "
      .. "wrong.” What do you say?",
      answer = "Neither is wrong. The mean of 4 balls is only known to about {error:2 ball=4} cm/s. About one time "
        .. "in three a mean is off by more than its standard error." },
  },
  teacher = {
    "Aim: the standard error of a mean shrinks as 1/√n, the scatter does not. Let pupils guess the first four balls "
      .. "one by one; then “Let the next four go” is quicker. Different pupils may take the balls in different "
      .. "orders: their error bars differ, and all means agree in the end.",
    "What goes wrong: pupils take the error bar for the range in which balls fall. Let them count how many balls lie "
      .. "within the bar of 16: far fewer than two thirds. And 1/√n is a rule for many samples: with 4 balls the "
      .. "error bar itself is uncertain by about 40 %.",
    "The model: slices of rubber (radius 3 cm, E = 10 MPa) of " .. p.nodes .. " points joined by springs at random, "
      .. "whose rim has random bumps of 0.9 mm (standard deviation), on a rigid plane. What differs from ball to "
      .. "ball is the seed. Most balls land on several bumps; those few that land on one beside their middle start to "
      .. "turn and come back slowly.",
  },
}
