-- The same scene on other lattices or meshes: finer or coarser, or another sample of the same kind.
local core = require "ricochet.core"

local function refined_body(body, factor, shift)
  local given = core.given(body)
  if next(given) == nil then return body end  -- a plane has no fields, and no nodes
  local t = core.check("body", given, true)
  if t.points then
    if factor ~= 1 then core.fail_here "nodes that were given one by one cannot be made finer; give other points" end
  elseif t.h_min then
    -- Every side is to be shorter by the same share, so they grow more slowly, and from the same distance on.
    if factor ~= 1 then
      given.h_min, given.grade = t.h_min / math.sqrt(factor), t.grade / math.sqrt(factor)
      given.fine_within = t.fine_within or 10 * t.h_min
      if t.h_max then given.h_max = t.h_max / math.sqrt(factor) end
    end
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

--- What the moving bodies of scenes are divided into, of one and of many: "lattice", "mesh", or "lattice and mesh".
local function division(scenes)
  local springs, elements = false, false
  for _, scene in ipairs(scenes) do
    local t = core.given(scene)
    for _, body in ipairs { t.projectile, t.target } do
      local given = core.given(body)
      local checked = given.outline and core.check("body", given, true)  -- a plane has no interior
      local interior = checked and (checked.interior == "modes" and checked.modes_of or checked.interior)
      springs, elements = springs or interior == "springs", elements or interior == "elements"
    end
  end
  if not elements then return { one = "lattice", many = "lattices" } end
  return springs and { one = "lattice and mesh", many = "lattices and meshes" } or { one = "mesh", many = "meshes" }
end

--- Least squares for value = limit + slope * x over points { x =, value =, se = }, weighted by 1 / se^2. Returns the
--- slope, its standard error and the limit. Points that do not scatter (every se is 0) weigh alike; what they stray
--- from the line is their error then, and of two, which lie on any, the slope is as uncertain as it is large. [here]
local function fitted_line(points)
  local scatter = false
  for _, p in ipairs(points) do scatter = scatter or p.se > 0 end
  local function weight(p) return scatter and 1 / math.max(p.se, 1e-12) ^ 2 or 1 end
  local w, x, y, xx, xy = 0, 0, 0, 0, 0
  for _, p in ipairs(points) do w, x, y = w + weight(p), x + p.x * weight(p), y + p.value * weight(p) end
  for _, p in ipairs(points) do
    xx, xy = xx + (p.x - x / w) ^ 2 * weight(p), xy + (p.x - x / w) * (p.value - y / w) * weight(p)
  end
  local slope = xy / xx
  local limit = y / w - slope * x / w
  if scatter then return slope, 1 / math.sqrt(xx), limit end
  if #points < 3 then return slope, math.abs(slope), limit end
  local rest = 0
  for _, p in ipairs(points) do rest = rest + (p.value - limit - slope * p.x) ^ 2 end
  return slope, math.sqrt(rest / (#points - 2) / xx), limit
end

return { division = division, refined = refined, fitted_line = fitted_line }
