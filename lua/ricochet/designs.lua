-- Which values of `over` go together: every one with every other, or by their places in lists of equal length.
local core = require "ricochet.core"

local designs = {}

-- Adds the names of a list of values that go together to those of `over`.
local function add_group(flat, group)
  local names, count = {}, nil
  for name, values in pairs(group) do
    if type(name) ~= "string" or type(values) ~= "table" then
      core.fail("'over' takes name = list of values, and what ricochet.zip or latin_hypercube returns", "over")
    end
    if flat[name] then core.fail(("over: '%s' is given twice"):format(name), "over") end
    if count and #values ~= count then
      core.fail(("over: '%s' has %d values, others beside it have %d"):format(name, #values, count), "over")
    end
    flat[name], count = values, #values
    names[#names + 1] = name
  end
  table.sort(names)
  return { names = names }
end

-- Refuses a key that is neither a place in the list nor, where it may be, a name: its values would be left out in
-- silence.
local function refuse_other_keys(t, may_be_name)
  for key in pairs(t) do
    local place = math.type(key) == "integer" and key >= 1 and key <= #t
    if not place and not (may_be_name and type(key) == "string") then
      core.fail(("over: the values of [%s] belong to no name; give name = list of values"):format(tostring(key)),
        "over")
    end
  end
end

--- The lists of `over` by name, and its factors in order: { names = {...} }, whose values go together.
function designs.of(over)
  local flat, factors = {}, {}
  refuse_other_keys(over, true)
  for name, values in pairs(over) do
    if type(name) == "string" then
      flat[name] = values
      factors[#factors + 1] = { names = { name } }
    end
  end
  for i = 1, #over do
    local groups = over[i]
    if type(groups) ~= "table" then core.fail("'over' takes name = list of values", "over") end
    local list = #groups > 0 and groups or { groups }
    refuse_other_keys(list)
    for _, group in ipairs(list) do
      if type(group) ~= "table" then core.fail("'over' takes name = list of values", "over") end
      factors[#factors + 1] = add_group(flat, group)
    end
  end
  table.sort(factors, function(a, b) return (a.names[1] or "") < (b.names[1] or "") end)
  return flat, factors
end

--- Refuses a sweep's factors that are not each a name of its own; `what` cannot do with others.
function designs.refuse_groups(factors, what, field)
  for _, factor in ipairs(factors) do
    if #factor.names > 1 then
      core.fail(("%s takes every value with every other: no zip or latin_hypercube in 'over'"):format(what), field)
    end
  end
end

--- Lists of equal length, whose values go together by their places.
function designs.zip(given)
  if type(given) ~= "table" then core.fail "takes lists of equal length: ricochet.zip { name = list, ... }" end
  local lists, count, first = core.plain(given), nil, nil
  for name, values in pairs(lists) do
    if type(name) ~= "string" or type(values) ~= "table" or #values == 0 then
      core.fail("takes lists of equal length that are not empty: ricochet.zip { name = list, ... }")
    end
    count, first = count or #values, first or name
    if #values ~= count then
      core.fail(("takes lists of equal length; '%s' has %d values, '%s' has %d"):format(first, count, name, #values),
        name)
    end
  end
  if not count then core.fail "takes at least one list: ricochet.zip { name = list, ... }" end
  return { lists }
end

-- Numbers of 0 to 1 from a seed, the same on every machine and in every sweep: splitmix64 (Steele, Lea & Flood 2014).
local function random_numbers(seed)
  local state = seed
  return function()
    state = state + 0x9e3779b97f4a7c15
    local z = (state ~ (state >> 30)) * 0xbf58476d1ce4e5b9
    z = (z ~ (z >> 27)) * 0x94d049bb133111eb
    return ((z ~ (z >> 31)) >> 11) * 2.0 ^ -53
  end
end

--- `n` points spread at random so that each n-th of every range holds one (McKay, Beckman & Conover 1979).
function designs.latin_hypercube(given)
  local t = core.check("latin_hypercube", given)
  local names, lists, random = {}, {}, random_numbers(t.seed)
  for name, range in pairs(t.ranges) do
    local numbers = type(range) == "table" and #range == 2 and math.type(range[1]) and math.type(range[2])
    if type(name) ~= "string" or not numbers or not (range[1] < range[2]) then
      core.fail(("ranges.%s must be { low, high }, two numbers, the lower first"):format(tostring(name)), "ranges")
    end
    names[#names + 1] = name
  end
  if #names == 0 then core.fail("'ranges' is empty; give at least one name = { low, high }", "ranges") end
  table.sort(names)
  for _, name in ipairs(names) do
    local low, high, places = t.ranges[name][1], t.ranges[name][2], {}
    for i = 1, t.n do places[i] = i end
    for i = t.n, 2, -1 do
      local j = 1 + math.floor(random() * i)
      places[i], places[j] = places[j], places[i]
    end
    for i = 1, t.n do places[i] = low + (high - low) * (places[i] - random()) / t.n end
    lists[name] = places
  end
  return { lists }
end

--- Values from `first` to `last`, each the same number of times the one before.
function designs.logspace(first, last, count)
  local numbers = type(first) == "number" and type(last) == "number"
  if not numbers or not (first > 0 and last > 0) or math.type(count) ~= "integer" or count < 2 or count > 1e7 then
    core.fail "takes two numbers above 0 and how many values, from 2: ricochet.logspace(first, last, count)"
  end
  local list = {}
  for k = 0, count - 1 do list[k + 1] = first * (last / first) ^ (k / (count - 1)) end
  list[count] = last
  return list
end

return designs
