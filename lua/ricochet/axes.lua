-- Ranges and ticks of a plot's axes.
local core = require "ricochet.core"

local axes = {}

--- A range {low, high} of the user's.
function axes.given_range(range, field, ...)
  local is_pair = type(range) == "table" and type(range[1]) == "number" and type(range[2]) == "number"
  if not is_pair or range[1] >= range[2] then core.fail(("'%s' takes { from, to }"):format(field), field, ...) end
  return { low = range[1], high = range[2] }
end

--- Makes a range hold low and high.
function axes.widen(range, low, high) range.low, range.high = math.min(range.low, low), math.max(range.high, high) end

--- Room around the first and last point, also where there is only one.
function axes.roomy(low, high, share, log)
  if log then
    local factor = high > low and (high / low) ^ share or 2
    return ("[%.17g:%.17g]"):format(low / factor, high * factor)
  end
  local room = high > low and share * (high - low) or math.max(0.5, math.abs(low) / 2)
  return ("[%.17g:%.17g]"):format(low - room, high + room)
end

-- Places of round numbers between `low` and `high`: 4 to 8 of them.
local function round_places(low, high)
  local decade = 10 ^ math.floor(math.log((high - low) / 4, 10))
  local step = decade
  for _, factor in ipairs { 2, 5, 10 } do
    if (high - low) / step > 8 then step = factor * decade end
  end
  local places = {}
  for k = math.ceil(low / step), math.floor(high / step) do places[#places + 1] = k * step end
  return places, step
end

--- Ticks of a logarithmic axis. Over less than half a decade round numbers in equal steps have a label; up to three
--- decades 1, 2 and 5 of each; beyond, powers of ten, every one or every few. Minor ticks stand between.
function axes.log_tics(log, axis, low, high)
  if not log:find(axis) then return "" end
  local tics, decades = {}, math.log(high / low, 10)
  local function add(value, minor) tics[#tics + 1] = (minor and "'' %.6g 1" or "%.6g"):format(value) end
  if decades < 0.5 and high > low then
    local places, step = round_places(low, high)
    for _, place in ipairs(places) do add(place) end
    for k = math.ceil(5 * low / step), math.floor(5 * high / step) do
      if k % 5 ~= 0 then add(k * step / 5, true) end
    end
    return ("\nset %stics (%s)"):format(axis, table.concat(tics, ", "))
  end
  local every = math.max(1, math.ceil(decades / 8))
  for decade = math.floor(math.log(low, 10)) - 1, math.floor(math.log(high, 10)) + 1 do
    for step = 1, 9 do
      local labelled = decades < 3 and (step == 1 or step == 2 or step == 5) or step == 1 and decade % every == 0
      if labelled or every == 1 or step == 1 then add(step * 10 ^ decade, not labelled) end
    end
  end
  return ("\nset %stics (%s)"):format(axis, table.concat(tics, ", "))
end

return axes
