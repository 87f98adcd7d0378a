-- Young's modulus and Poisson's ratio of what a body is made of.
local core = require "ricochet.core"

local moduli = {}

-- E and nu of a band of `nodes` nodes of a body's stuff; of springs the mean of six, unless they lie in a pattern.
local function of_band(fields, nodes, nodes_an_area)
  local bands = fields.interior == "springs" and fields.placement ~= "triangular" and 6 or 1
  local height = 2 * math.sqrt(nodes / nodes_an_area)
  local width = height / 4
  local band = { outline = { { 0, 0 }, { width, 0 }, { width, height }, { 0, height } }, nodes = nodes }
  for _, name in ipairs {
    "interior", "stiffness", "quartic", "placement", "E", "nu", "material", "thickness", "state",
  } do
    band[name] = fields[name]
  end
  local E, nu = 0, 0
  for sample = 1, bands do
    band.seed = sample
    local measured = core.functions.elasticity { body = core.own_body(band) }
    E, nu = E + measured.E / bands, nu + measured.nu / bands
  end
  return E, nu
end

--- E and nu of what a body with such fields is made of, as its bands have them. The springs along a lattice's edges
--- hold half as much matter as those inside, and are as stiff: two bands, one of twice the width, tell what one without
--- edges would have.
function moduli.of(fields, nodes_an_area)
  local stuff = {}
  for name, value in pairs(fields) do stuff[name] = value end
  if fields.interior == "modes" then stuff.interior = fields.modes_of or "elements" end
  if stuff.interior == "elements" then return of_band(stuff, 100, nodes_an_area) end
  local E, nu = of_band(stuff, 3600, nodes_an_area)
  local E_wide, nu_wide = of_band(stuff, 14400, nodes_an_area)
  return 2 * E_wide - E, 2 * nu_wide - nu
end

return moduli
