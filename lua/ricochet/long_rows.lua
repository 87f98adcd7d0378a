-- The rows of a long sweep: each is made when it is asked for, and its columns are read when they are. To a script they
-- are rows like others, and what it puts into one stays there.
local core = require "ricochet.core"
local outcomes = require "ricochet.outcomes"

local long_rows = {}

local POINT = {}  -- the key, in a row, of the point that it is of, from 0

-- What a row of this sweep does. of: { stored =, axes = by name, behind = columns of those names, as outcome_NAME,
-- kept = rows that hold something of their own }.
local function metatable_of(of)
  local Row = { __name = "row", __metatable = false }
  function Row.peek(row, name)
    local axis = of.axes[name]
    if axis then return axis.values[rawget(row, POINT) // axis.stride % #axis.values + 1] end
    if type(name) == "string" then
      return core.long_value(of.stored, rawget(row, POINT), of.behind[name] or name)
    end
  end
  function Row.whole(row)
    local whole = core.long_row(of.stored, rawget(row, POINT))
    for name, column in pairs(of.behind) do whole[name] = whole[column] end
    for name in pairs(of.axes) do whole[name] = Row.peek(row, name) end
    for name, value in next, row do
      if name ~= POINT then whole[name] = value end
    end
    return whole
  end
  function Row.__index(row, name)
    local value = Row.peek(row, name)
    if value == nil then return Row.whole(row)[name] end  -- an error that names the column
    return value
  end
  function Row.__newindex(row, name, value)
    of.kept[rawget(row, POINT)] = row
    rawset(row, name, value)
  end
  function Row.__pairs(row) return pairs(Row.whole(row)) end
  function Row.__tostring(row) return tostring(Row.whole(row)) end
  return Row
end

local held = setmetatable({}, { __mode = "k" })  -- by list: { count =, row = function (i) }

--- Of a list of these rows: { count =, row = function (i) }; nil of another list.
function long_rows.of(list) return held[list] end

--- The list. stored: of core.long_end(); axes: of points.axes().
function long_rows.list(stored, axes, count)
  local of, made = { stored = stored, axes = {}, behind = {}, kept = {} }, setmetatable({}, { __mode = "v" })
  for _, axis in ipairs(axes) do of.axes[axis.name] = axis end
  for _, name in ipairs(outcomes.shared) do
    if of.axes[name] then of.axes["over_" .. name], of.behind["outcome_" .. name] = of.axes[name], name end
  end
  local Row, list = metatable_of(of), {}
  held[list] = {
    count = count,
    row = function(i)
      local row = made[i]
      if not row then
        row = setmetatable({ [POINT] = i - 1 }, Row)
        made[i] = row
      end
      return row
    end,
  }
  return list
end

return long_rows
