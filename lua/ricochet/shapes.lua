-- Bodies of simple shape, over the one primitive ricochet.body.
local core = require "ricochet.core"

local shapes = {}

-- The fields of ricochet.body among those given of a shape: all but its own. Those that were not given stay so, but for
-- the number of nodes, which a shape knows; nodes given one by one, and meshes, have none.
local function body_fields(t, given, ...)
  for _, own in ipairs { ... } do
    if given.material and given[own] == nil then
      core.fail(("'%s' has no usual value for a body of a material; give it in metres"):format(own), own)
    end
  end
  local body = { nodes = not t.points and not t.h_min and t.nodes or nil }
  for name, value in pairs(given) do body[name] = value end
  for _, own in ipairs { ... } do body[own] = nil end
  return body
end

-- Points along an ellipse, or a circle.
local function curve(a, b, corners)
  local outline = {}
  for i = 1, corners do
    local angle = 2 * math.pi * (i - 1) / corners
    outline[i] = { a * math.cos(angle), b * math.sin(angle) }
  end
  return outline
end

-- Eight corners a rim node, of which there are `rim`: the points lie on a circle to within its sagitta,
-- (pi / corners)^2 / 2. A finer rim has more, but no more than the body has nodes: a longer one is refused anyway. That
-- of a mesh is as fine everywhere as where the mesh is finest, up to a sagitta of 1e-9.
local function corners(t, rim, perimeter)
  local nodes = math.max(t.nodes, t.points and #t.points or 0)
  local finest = t.h_min or t.rim_spacing or math.huge
  return 8 * math.ceil(math.min(math.max(rim * math.sqrt(nodes), perimeter / finest),
    t.h_min and 8000 or math.max(nodes, 100)))
end

function shapes.disk(given)
  local t, own = core.check("disk", given)
  local body = body_fields(t, own, "radius")
  body.outline = curve(t.radius, t.radius, corners(t, math.sqrt(4 * math.pi), 2 * math.pi * t.radius))
  return core.own_body(body)
end

function shapes.ellipse(given)
  local t, own = core.check("ellipse", given)
  local body = body_fields(t, own, "a", "b")
  -- The perimeter to within 0.04 %.  [Ramanujan 1914, Q. J. Math. 45, 350]
  local h = ((t.a - t.b) / (t.a + t.b)) ^ 2
  local perimeter = math.pi * (t.a + t.b) * (1 + 3 * h / (10 + math.sqrt(4 - 3 * h)))
  body.outline = curve(t.a, t.b, corners(t, perimeter / math.sqrt(math.pi * t.a * t.b), perimeter))
  return core.own_body(body)
end

-- What a body of revolution is of, by the half at x >= 0 of its section, which was given as its outline.
local function axisymmetric(body, given)
  for field, only in pairs { interior = "elements", state = "axisymmetric" } do
    if given[field] and given[field] ~= only then
      core.fail(("'%s': this shape is a body of revolution, which takes %s = \"%s\"; leave it out"):format(field, field,
        only), field)
    end
    body[field] = only
  end
  return core.own_body(body)
end

-- Whether nothing is said of where its nodes are.
local function leaves_nodes(given)
  for _, field in ipairs { "nodes", "placement", "rim_spacing", "margin", "points", "h_min" } do
    if given[field] ~= nil then return false end
  end
  return true
end

function shapes.sphere(given)
  local t, own = core.check("sphere", given)
  if leaves_nodes(own) then
    t.h_min = t.radius / 50
    own.h_min = t.h_min
  end
  local body = body_fields(t, own, "radius")
  local count = corners(t, math.sqrt(2 * math.pi), math.pi * t.radius)
  body.outline = { { 0, -t.radius } }
  for i = 1, count - 1 do
    local angle = math.pi * i / count
    body.outline[i + 1] = { t.radius * math.sin(angle), -t.radius * math.cos(angle) }
  end
  body.outline[count + 1] = { 0, t.radius }
  return axisymmetric(body, own)
end

function shapes.cylinder(given)
  local t, own = core.check("cylinder", given)
  local body = body_fields(t, own, "radius", "height")
  local y = t.height / 2
  body.outline = { { 0, -y }, { t.radius, -y }, { t.radius, y }, { 0, y } }
  return axisymmetric(body, own)
end

function shapes.rectangle(given)
  local t, own = core.check("rectangle", given)
  local body = body_fields(t, own, "width", "height")
  local x, y = t.width / 2, t.height / 2
  body.outline = { { -x, -y }, { x, -y }, { x, y }, { -x, y } }
  return core.own_body(body)
end

function shapes.regular_polygon(given)
  local t, own = core.check("regular_polygon", given)
  local body = body_fields(t, own, "sides", "radius")
  body.outline = {}
  for i = 1, t.sides do
    local angle = 2 * math.pi * (i - 0.5) / t.sides - math.pi / 2
    body.outline[i] = { t.radius * math.cos(angle), t.radius * math.sin(angle) }
  end
  return core.own_body(body)
end

function shapes.polygon(given)
  return core.own_body(body_fields(core.check("polygon", given)))
end

function shapes.rotated(given)
  local t = core.check("rotated", given)
  local body = core.given(t.body)
  if next(body) == nil then
    core.fail("'body': a plane cannot be turned; take a wide rectangle with interior = \"rigid\"", "body")
  end
  body.angle = (body.angle or 0) + t.angle
  return core.own_body(body)
end

function shapes.wall(given)
  local t, own = core.check("wall", given)
  local body = body_fields(t, own, "width", "depth")
  local half, depth = t.width / 2, t.depth
  if t.h_min and not t.fine_at then body.fine_at = { 0, 0 } end
  body.outline = { { -half, -depth }, { half, -depth }, { half, 0 }, { -half, 0 } }
  local rounding = 1e-9 * t.width
  body.anchored = function(x, y) return y < -depth + rounding or math.abs(x) > half - rounding end
  return core.own_body(body)
end

function shapes.half_space(given)
  local t, own = core.check("half_space", given)
  local body = body_fields(t, own, "extent")
  local far = t.extent
  if t.h_min and not t.fine_at then body.fine_at = { 0, 0 } end
  body.outline = { { 0, -far }, { far, -far }, { far, 0 }, { 0, 0 } }
  body.anchored = function(x, y) return x == 0 and y == -far end
  return axisymmetric(body, own)
end

return shapes
