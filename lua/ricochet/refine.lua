-- The same scene on other lattices: finer or coarser, or another sample of the same kind.
local core = require "ricochet.core"

local function refined_body(body, factor, shift)
  local given = core.given(body)
  if next(given) == nil then return body end  -- a plane has no fields, and no nodes
  local t = core.check("body", given, true)
  if t.points then
    if factor ~= 1 then core.fail_here "nodes that were given one by one cannot be made finer; give other points" end
  elseif t.h_min then
    given.h_min = t.h_min / math.sqrt(factor)
    if t.h_max then given.h_max = t.h_max / math.sqrt(factor) end
  else
    given.nodes = math.floor(factor * t.nodes + 0.5)
  end
  -- Outline, total mass and stiffness stay: the modulus of a network does not depend on its spacing, while a spring's
  -- stretch at a given strain does, as the spacing.
  if t.interior == "springs" and (given.quartic or not t.material) then given.quartic = t.quartic * factor end
  if t.mass then given.mass = t.mass / factor end
  if t.rim_spacing then given.rim_spacing = t.rim_spacing / math.sqrt(factor) end
  given.seed = t.seed + shift
  return core.own_body(given)
end

--- The scene with `factor` times as many nodes in both bodies of the same outline, mass and stiffness; seeds, those of
--- effects too, are moved by `shift`.
--- A step becomes the default one: another lattice needs its own.
local function refined(scene, factor, shift)
  local t = core.given(scene)
  t.projectile, t.target = refined_body(t.projectile, factor, shift), refined_body(t.target, factor, shift)
  if factor ~= 1 then t.step = nil end
  local effects = {}
  for i, effect in ipairs(t.effects or {}) do effects[i] = core.reseeded(effect, shift) end
  t.effects = effects
  return core.functions.scene(t)
end

--- Least squares for value = limit + slope * x over points { x =, value =, se = }, weighted by 1 / se^2. Returns the
--- slope, its standard error and the limit.
local function fitted_line(points)
  local w, x, y, xx, xy = 0, 0, 0, 0, 0
  for _, p in ipairs(points) do w, x, y = w + 1 / p.se ^ 2, x + p.x / p.se ^ 2, y + p.value / p.se ^ 2 end
  for _, p in ipairs(points) do
    xx, xy = xx + (p.x - x / w) ^ 2 / p.se ^ 2, xy + (p.x - x / w) * (p.value - y / w) / p.se ^ 2
  end
  local slope = xy / xx
  return slope, 1 / math.sqrt(xx), y / w - slope * x / w
end

return { refined = refined, fitted_line = fitted_line }
