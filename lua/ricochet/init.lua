-- The module a script requires: local ricochet = require "ricochet"
local core = require "ricochet.core"

local ricochet = { theory = core.theory }

-- Those written in C++: "disk", or "file.write" in a table of its own.
for name, call in pairs(core.functions) do
  local inner, last = name:match "^(.+)%.(.+)$"
  if inner then
    ricochet[inner] = ricochet[inner] or {}
    ricochet[inner][last] = call
  else
    ricochet[name] = call
  end
end

ricochet.materials = require "ricochet.materials"

for name, shape in pairs(require "ricochet.shapes") do ricochet[name] = core.wrap(shape) end
ricochet.sweep = core.wrap(require("ricochet.sweep").sweep)
ricochet.series = core.wrap(require("ricochet.series").series)
ricochet.waves = core.wrap(require("ricochet.waves").waves)
require "ricochet.bounces"
ricochet.plot = core.wrap(require("ricochet.plot").plot)
ricochet.histogram = core.wrap(require("ricochet.histogram").histogram)
ricochet.heat_map = core.wrap(require("ricochet.heat_map").heat_map)
ricochet.accuracy = core.wrap(require("ricochet.accuracy").accuracy)
ricochet.relevance = core.wrap(require("ricochet.effects").relevance)
ricochet.bootstrap = core.wrap(require("ricochet.bootstrap").call)
ricochet.plan = core.wrap(require("ricochet.plan").plan)
ricochet.dem = core.wrap(require("ricochet.dem").dem)
ricochet.compare = core.wrap(require("ricochet.compare").compare)
ricochet.find = core.wrap(require("ricochet.find").find)
ricochet.lesson = core.wrap(require("ricochet.lesson").lesson)

for name, design in pairs(require "ricochet.designs") do
  if name ~= "of" then ricochet[name] = core.wrap(design) end
end

--- refined(scene, factor): the same scene on finer lattices, or coarser ones.
ricochet.refined = core.wrap(function(scene, factor)
  if type(factor) ~= "number" or not (factor > 0 and factor <= 64) then
    core.fail(("'factor' of the nodes must be above 0 and at most 64, is %s"):format(tostring(factor)), "factor")
  end
  return require("ricochet.refine").refined(scene, factor, 0)
end)

--- range(n): 1 ... n; range(first, last [, step]). A last value that rounding alone puts beyond is among them:
--- range(0.1, 0.3, 0.1) holds 0.3.
ricochet.range = core.wrap(function(first, last, step)
  if last == nil then first, last = 1, first end
  step = step or 1
  if type(first) ~= "number" or type(last) ~= "number" or type(step) ~= "number" or step == 0 then
    core.fail "takes numbers: range(n), range(first, last) or range(first, last, step); step must not be 0"
  end
  if first + step == first or last + step == last then
    core.fail(("counts by %g, which is lost in rounding at %g"):format(step, first + step == first and first or last))
  end
  if (last - first) / step > 1e7 then core.fail "would hold more than 1e7 values" end
  local list = {}
  local steps = (last - first) / step
  local whole = math.floor(steps + 1e-9)
  for k = 0, whole do list[k + 1] = first + k * step end
  if whole > 0 and math.abs(steps - whole) < 1e-9 then list[whole + 1] = last end
  return list
end)

-- What scripts hold is empty, so that every assignment meets __newindex, one of a name that is there too.
setmetatable(ricochet, { __index = function(_, name) core.unknown("the module", name, core.function_names()) end })
return setmetatable({}, {
  __index = ricochet,
  __newindex = function(_, name)
    core.fail_here(("the module's '%s' cannot be set; write: local %s = ..."):format(tostring(name), tostring(name)))
  end,
  __pairs = function() return pairs(ricochet) end,
})
