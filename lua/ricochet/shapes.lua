-- Bodies of simple shape, over the one primitive ricochet.body.
local core = require "ricochet.core"

local shapes = {}

-- The fields of ricochet.body among those given of a shape: all but its own. Those that were not given stay so.
local function body_fields(t, given, ...)
  local body = { nodes = t.nodes }
  for name, value in pairs(given) do body[name] = value end
  for _, own in ipairs { ... } do body[own] = nil end
  return body
end

function shapes.disk(given)
  local t, own = core.check("disk", given)
  local body = body_fields(t, own, "radius")
  body.outline = {}
  -- Eight corners a rim node: the points lie on the circle to within its sagitta, (pi / corners)^2 / 2.
  local corners = 8 * math.ceil(math.sqrt(4 * math.pi * t.nodes))
  for i = 1, corners do
    local angle = 2 * math.pi * (i - 1) / corners
    body.outline[i] = { t.radius * math.cos(angle), t.radius * math.sin(angle) }
  end
  return core.own_body(body)
end

function shapes.wall(given)
  local t, own = core.check("wall", given)
  local body = body_fields(t, own, "width", "depth")
  local half, depth = t.width / 2, t.depth
  body.outline = { { -half, -depth }, { half, -depth }, { half, 0 }, { -half, 0 } }
  local rounding = 1e-9 * t.width
  body.anchored = function(x, y) return y < -depth + rounding or math.abs(x) > half - rounding end
  return core.own_body(body)
end

return shapes
