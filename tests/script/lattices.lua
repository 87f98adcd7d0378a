-- The table that test_by_error.cpp draws from: e of 300 lattices of the soft wall, of 200 + 1000 nodes, at each of some
-- angles, each struck from both sides. From the root of the tree, a minute on two cores:
--   ricochet run tests/script/lattices.lua --out /tmp/lattices && cp /tmp/lattices/lattices/lattices.csv tests/script/
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1 = { { 1, 4, 8 }, min = 0, doc = "tangents of the incident angle" },
  samples = { 300, int = true, min = 1, doc = "lattices" },
  nodes = { 200, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
})
local rows = ricochet.sweep {
  name = "both_sides",
  over = { sample = ricochet.range(p.samples), psi1 = p.psi1, side = { 1, -1 } },
  scene = function(at)
    return figures.scene(p, 1 / 100, { sample = at.sample, launch = { speed = p.speed, psi1 = at.side * at.psi1 } })
  end,
}:run()
local lines, e = { "psi1,sample,e,e_mirrored" }, {}
for _, row in ipairs(rows) do
  if row.status == "finished" then e[("%g,%d"):format(row.psi1, row.sample) .. (row.side > 0 and "" or "m")] = row.e end
end
for _, psi1 in ipairs(p.psi1) do
  for sample = 1, p.samples do
    local key = ("%g,%d"):format(psi1, sample)
    if e[key] and e[key .. "m"] then lines[#lines + 1] = ("%s,%.6f,%.6f"):format(key, e[key], e[key .. "m"]) end
  end
end
ricochet.file.write("lattices.csv", table.concat(lines, "\n") .. "\n")
