-- The points of a sweep: counted, and made as they are asked for.
local points = {}

local function values_of(sweep, factor) return #sweep.over[factor.names[1]] end

--- How many a sweep has.
function points.count(sweep)
  local count = 1
  for _, factor in ipairs(sweep.factors) do count = count * values_of(sweep, factor) end
  return count
end

--- Sets the names of a factor to their k-th values.
function points.set(sweep, factor, values, k)
  for _, name in ipairs(factor.names) do values[name] = sweep.over[name][k] end
end

--- The values of `over` at a point, counted from 0: the last factor is the fastest.
function points.values_at(sweep, point)
  local values = {}
  for i = #sweep.factors, 1, -1 do
    local factor = sweep.factors[i]
    local count = values_of(sweep, factor)
    points.set(sweep, factor, values, point % count + 1)
    point = point // count
  end
  return values
end

--- All of them.
function points.list(sweep)
  local list = {}
  for point = 0, points.count(sweep) - 1 do list[point + 1] = points.values_at(sweep, point) end
  return list
end

--- The names of `over` with their values and after how many points the next one comes, in the order of names:
--- { { name =, unit =, stride =, values = }, ... }.
function points.axes(sweep)
  local of, stride = {}, 1
  for i = #sweep.factors, 1, -1 do
    local factor = sweep.factors[i]
    for _, name in ipairs(factor.names) do
      of[name] = { name = name, unit = (sweep.units or {})[name] or "", stride = stride, values = sweep.over[name] }
    end
    stride = stride * values_of(sweep, factor)
  end
  local axes = {}
  for i, name in ipairs(sweep.names) do axes[i] = of[name] end
  return axes
end

--- An order in which points that share a lattice are neighbours: the place of the i-th point, from 0. names: a list of
--- { values =, changes_lattice = }, one a factor.
function points.by_lattice(names)
  local digits, stride = {}, 1
  for i = #names, 1, -1 do
    digits[i] = { count = names[i].values, stride = stride, is_outer = names[i].changes_lattice }
    stride = stride * names[i].values
  end
  local order = {}
  for _, outer in ipairs { false, true } do
    for i = #digits, 1, -1 do
      if digits[i].is_outer == outer then order[#order + 1] = digits[i] end
    end
  end
  return function(i)
    local place = 0
    for _, digit in ipairs(order) do
      place = place + i % digit.count * digit.stride
      i = i // digit.count
    end
    return place
  end
end

return points
