-- Whether the mirror image of a scene, x to -x, is a sample of the same kind: then a lattice may be struck from both
-- sides.
local core = require "ricochet.core"

local mirror = {}

-- Whether points in any order are as many to the right of x = middle as to the left, at the same places.
local function is_even(points, middle)
  local places, most = {}, 0
  for _, p in ipairs(points) do most = math.max(most, math.abs(p[1] - middle), math.abs(p[2])) end
  local function key(x, y) return ("%.0f %.0f"):format(1e7 * x / most + 0.25, 1e7 * y / most + 0.25) end
  for _, p in ipairs(points) do places[key(p[1] - middle, p[2])] = true end
  for _, p in ipairs(points) do
    if not places[key(middle - p[1], p[2])] then return false end
  end
  return true
end

local function extent(points)
  local low, high = points[1], points[1]
  for _, p in ipairs(points) do
    low = { math.min(low[1], p[1]), math.min(low[2], p[2]) }
    high = { math.max(high[1], p[1]), math.max(high[2], p[2]) }
  end
  return low, high
end

-- Whether a function of the place says the same to the right of x = middle as to the left, at a grid of places.
local function is_even_function(f, outline, middle)
  local low, high = extent(outline)
  for i = 0, 20 do
    for j = 0, 20 do
      local off, y = i / 20 * (high[1] - middle), low[2] + j / 20 * (high[2] - low[2])
      if f(middle + off, y) ~= f(middle - off, y) then return false end
    end
  end
  return true
end

-- What makes a body uneven, its axis being x = 0 or, of a projectile, wherever its middle is.
local function of_body(body, is_target)
  local t = core.given(body)
  if not t.outline then return nil end  -- a plane
  local low, high = extent(t.outline)
  local middle = is_target and 0 or (low[1] + high[1]) / 2
  if (t.angle or 0) ~= 0 then return ("is tilted by %g degrees"):format(t.angle) end
  if t.points then return "has nodes that were given one by one" end
  if t.placement == "triangular" then return "is a triangular lattice, which is no other from the other side" end
  if t.fine_at and t.fine_at[1] ~= middle then return "has a mesh that is finest beside its middle" end
  local places = {}
  for _, p in ipairs(t.outline) do places[#places + 1] = p end
  for _, hole in ipairs(t.holes or {}) do
    for _, p in ipairs(hole) do places[#places + 1] = p end
  end
  if not is_even(places, middle) then return "has an outline that is no mirror image of itself" end
  for _, name in ipairs { "anchored", "stiffness", "E", "nu", "density" } do
    if type(t[name]) == "function" and not is_even_function(t[name], t.outline, middle) then
      return ("is uneven: its %s is not the same on both sides"):format(name)
    end
  end
  if (t.spin or 0) ~= 0 then return "has a spin" end
  if t.velocity and (t.velocity[1] or 0) ~= 0 then return "has a velocity along the surface" end
  return nil
end

--- Whether the projectile comes in slanting, so that the other side is another impact.
function mirror.is_slanted(scene)
  local launch = core.given(scene).launch or {}
  for _, name in ipairs { "psi1", "angle", "tangential_speed" } do
    if (launch[name] or 0) ~= 0 then return true end
  end
  return false
end

--- Why the scene's mirror image is no sample of its kind, and the field that says so; nothing if it is one.
function mirror.asymmetry(scene)
  local t = core.given(scene)
  local launch = t.launch or {}
  for _, name in ipairs { "at", "spin" } do
    if (launch[name] or 0) ~= 0 then return ("launch.%s is %g, which has a side"):format(name, launch[name]) end
  end
  for _, effect in ipairs(t.effects or {}) do
    if core.effect_name(effect) == "moving_anchor" then return "moving_anchor may move along the surface" end
  end
  for _, name in ipairs { "projectile", "target" } do
    local why = of_body(t[name], name == "target")
    if why then return ("the %s %s"):format(name, why) end
  end
  return nil
end

return mirror
