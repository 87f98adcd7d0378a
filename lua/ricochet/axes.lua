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

--- Room around the first and last point, also where there is only one: from where to where an axis goes.
function axes.roomy(low, high, share, log)
  if log then
    local factor = high > low and (high / low) ^ share or 2
    return low / factor, high * factor
  end
  local room = high > low and share * (high - low) or low ~= 0 and math.abs(low) / 2 or 0.5
  return low - room, high + room
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

-- Units that take a prefix.
local prefixes = { [-9] = "n", [-6] = "µ", [-3] = "m", [3] = "k", [6] = "M", [9] = "G" }
local prefixed = { s = true, m = true, N = true, J = true, Pa = true }
local raised = { ["-"] = "⁻", ["0"] = "⁰", ["1"] = "¹", ["2"] = "²", ["3"] = "³", ["4"] = "⁴", ["5"] = "⁵", ["6"] = "⁶",
  ["7"] = "⁷", ["8"] = "⁸", ["9"] = "⁹" }

--- The power of ten in which an axis is told, a multiple of 3; 0 where its numbers are readable as they are: 20 ms, but
--- 0.02 R. The rule is that of the report's axes (words.js). Decades of a logarithmic axis are told as they are.
function axes.power_of(low, high, unit, log)
  local most = math.max(math.abs(low), math.abs(high))
  if not (most > 0 and most < math.huge) or log and high > 1000 * low then return 0 end
  local power = math.floor(math.log(most, 10) + 1e-12)
  local least = prefixed[unit] and -1 or -2
  return (power < least or power > 4) and 3 * (power // 3) or 0
end

--- "µs"; "10^{-6} m/s" of what takes no prefix, as gnuplot typesets it.
function axes.scaled_unit(unit, power)
  if power == 0 then return unit end
  if prefixed[unit] and prefixes[power] then return prefixes[power] .. unit end
  return ("10^{%d}%s"):format(power, unit ~= "" and " " .. unit or "")
end

-- "⁻⁶"
local function superscript(power) return (tostring(power):gsub(".", raised)) end

--- " µs", " 10⁻⁶ m/s": what stands behind a number that is told in a power of ten; nothing where that is 0.
function axes.told_unit(unit, power)
  if power == 0 then return "" end
  return " " .. axes.scaled_unit(unit, power):gsub("10^{.-}", "10" .. superscript(power))
end

--- What a label of the user's own is followed by, where marks are told in a power of ten.
function axes.marks_in(power)
  return power == 0 and "" or ", marks in 10" .. superscript(power)
end

-- The place of a tick, told in a power of ten.
local function tick(value, power, decimals)
  local told = value / 10 ^ power
  local text = decimals and ("%.*f"):gsub("*", decimals):format(told) or ("%.6g"):format(told)
  return ("'%s' %.12g"):format(text:gsub("^%-(0%.?0*)$", "%1"), value)
end

--- Ticks of a linear axis that is told in a power of ten; gnuplot's own where that is 0.
function axes.tics(axis, low, high, power)
  if power == 0 or high <= low then return ("set %stics autofreq"):format(axis) end
  local places, step = round_places(low, high)
  local decimals = math.max(0, math.ceil(-math.log(step / 10 ^ power, 10) - 1e-9))
  local texts = {}
  for i, place in ipairs(places) do texts[i] = tick(place, power, decimals) end
  return ("set %stics (%s)"):format(axis, table.concat(texts, ", "))
end

--- Ticks of a logarithmic axis. Over less than half a decade round numbers in equal steps have a label; up to three
--- decades 1, 2 and 5 of each; beyond, powers of ten, every one or every few. Minor ticks stand between. The labels are
--- told in a power of ten, if one is given.
function axes.log_tics(axis, low, high, power)
  local tics, decades = {}, math.log(high / low, 10)
  local function add(value, minor)
    local scaled = not minor and power and power ~= 0
    tics[#tics + 1] = scaled and tick(value, power) or (minor and "'' %.6g 1" or "%.6g"):format(value)
  end
  if decades < 0.5 and high > low then
    local places, step = round_places(low, high)
    for _, place in ipairs(places) do add(place) end
    for k = math.ceil(5 * low / step), math.floor(5 * high / step) do
      if k % 5 ~= 0 then add(k * step / 5, true) end
    end
    return ("set %stics (%s)"):format(axis, table.concat(tics, ", "))
  end
  local every = math.max(1, math.ceil(decades / 8))
  for decade = math.floor(math.log(low, 10)) - 1, math.floor(math.log(high, 10)) + 1 do
    for step = 1, 9 do
      local labelled = decades < 3 and (step == 1 or step == 2 or step == 5) or step == 1 and decade % every == 0
      if labelled or every == 1 or step == 1 then add(step * 10 ^ decade, not labelled) end
    end
  end
  return ("set %stics (%s)"):format(axis, table.concat(tics, ", "))
end

return axes
