-- A sweep with as many samples of every point as a wanted error takes, in rounds: a pilot, then what its deviations ask
-- for. Every decision follows from the rows alone, so that a resumed run, any order and any number of threads take the
-- same.
local core = require "ricochet.core"
local mirror = require "ricochet.mirror"
local refine = require "ricochet.refine"
local sampling = require "ricochet.sampling"
local statistics = require "ricochet.statistics"

--- Fields of a sweep that count only with samples = "by_error", checked.
local function checked(t)
  local own = { "standard_error", "relative_error", "mirrored" }
  if not t.samples then
    for _, name in ipairs(own) do
      if t[name] ~= nil then core.fail(("'%s' needs samples = \"by_error\" beside it"):format(name), name) end
    end
    return nil
  end
  if (t.standard_error == nil) == (t.relative_error == nil) then
    core.fail("samples = \"by_error\" takes standard_error or relative_error, one of them", "samples")
  end
  if t.pilot > t.most then core.fail("'pilot' is more than 'most'", "pilot") end
  require("ricochet.outcomes").check({ t.of }, "of")
  return t
end

local function copy(t)
  local result = {}
  for k, v in pairs(t) do result[k] = v end
  return result
end

-- What a point is at first: `count` lattices, of which the first `both` are struck from both sides.
local function begun(sweep, t, point)
  local first = copy(point)
  first.sample = 1
  local scene = sweep.make(first)
  sweep.first = sweep.first or scene
  local state = { point = point, count = t.pilot, both = 0, side = "one", why = nil, gain = 0 / 0 }
  state.why = not mirror.is_slanted(scene) and "comes in straight" or mirror.asymmetry(scene)
  if t.mirrored and mirror.is_slanted(scene) then
    if state.why then core.fail(("cannot be mirrored: %s"):format(state.why), "mirrored") end
    state.both, state.side = t.pilot, "both"
  end
  if t.mirrored == false then state.why = "was not asked for" end
  return state
end

-- Points and scenes of all rows so far; those that share a lattice beside each other.
local function asked(sweep, states)
  local points, scenes, most = {}, {}, 0
  for _, state in ipairs(states) do most = math.max(most, state.count) end
  local function add(state, sample, is_mirrored, pair)
    local point = copy(state.point)
    point.sample = sample
    local key = pair .. tostring(is_mirrored)
    if not sweep.made[key] then
      local scene = sweep.make(point)
      sweep.made[key] = is_mirrored and core.struck_from_other_side(scene) or scene
    end
    point.mirrored, point.pair = is_mirrored, pair
    points[#points + 1], scenes[#scenes + 1] = point, sweep.made[key]
  end
  for sample = 1, most do
    for i, state in ipairs(states) do
      local pair = (sample - 1) * #states + i
      if sample <= state.count then add(state, sample, false, pair) end
      if sample <= math.min(state.count, state.both) then add(state, sample, true, pair) end
    end
  end
  return points, scenes
end

-- The rows of each point, and the outcomes of its lattices that finished from both sides.
local function sorted(rows, states)
  for _, state in ipairs(states) do state.rows = {} end
  for _, row in ipairs(rows) do table.insert(states[(row.pair - 1) % #states + 1].rows, row) end
end

local function pairs_of(state, of)
  local by_pair, list = {}, {}
  for _, row in ipairs(state.rows) do
    if row.status == "finished" and row[of] == row[of] then
      local pair = by_pair[row.pair] or {}
      by_pair[row.pair] = pair
      pair[row.mirrored and 2 or 1] = row[of]
    end
  end
  for sample = 1, state.count do
    local pair = by_pair[(sample - 1) * state.stride + state.place]
    if pair and pair[1] and pair[2] then list[#list + 1] = pair end
  end
  return list
end

-- What the rows say of a point, and what it takes next. Returns whether more is to run.
local function decide(state, t)
  state.of = statistics.of_units(state.rows, t.of)
  state.wanted = sampling.wanted(t, state.of.mean)
  if not state.pilot then
    state.pilot = { mean = state.of.mean, sd = state.of.sd, units = state.of.units, wanted = state.wanted }
  end
  return sampling.decide(state, state.of, state.wanted, t.most, function() return pairs_of(state, t.of) end)
end

-- The impacts that a fixed number would have taken: that of the point that needs most, by its pilot.
local function fixed(states)
  local needed = 0
  for _, state in ipairs(states) do
    local pilot = state.pilot
    if pilot.units > 1 then
      needed = math.max(needed, sampling.least, math.ceil((pilot.sd / pilot.wanted) ^ 2))
    end
  end
  return needed, needed * #states
end

local function cell(value)
  if value ~= value then return "nan" end
  return math.type(value) == "float" and ("%.17g"):format(value) or tostring(value)
end

-- What was done, as a table in the run's folder.
local function keep(sweep, states)
  local lines = { table.concat(sweep.names, ",") .. (#sweep.names > 0 and "," or "") ..
    "pilot_mean,pilot_sd,wanted,lattices,mirrored_lattices,impacts,mean,sd,se,units,gain_of_pairs" }
  for _, state in ipairs(states) do
    local cells = {}
    for _, name in ipairs(sweep.names) do cells[#cells + 1] = cell(state.point[name]) end
    for _, value in ipairs { state.pilot.mean, state.pilot.sd, state.wanted, state.count,
      math.min(state.both, state.count), #state.rows, state.of.mean, state.of.sd, state.of.se, state.of.units,
      state.gain } do
      cells[#cells + 1] = cell(value)
    end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  core.functions["file.write"](sweep.name .. "_samples.csv", table.concat(lines, "\n") .. "\n")
end

local function told(state, names, t, goes_on)
  local parts = {}
  for _, name in ipairs(names) do parts[#parts + 1] = ("%s=%s"):format(name, cell(state.point[name])) end
  local missed = goes_on and ""
    or state.of.units < 2 and "cannot be planned: fewer than two impacts of the pilot finished with a value of " .. t.of
    or state.of.se > state.wanted and ("not met with %d, at most: raise 'most'"):format(t.most) or ""
  local where = table.concat(parts, " ")
  -- Between rounds `state.count` is what the next one is to have.
  local struck, lattices = {}, 0
  for _, row in ipairs(state.rows) do
    if not struck[row.sample] then struck[row.sample], lattices = true, lattices + 1 end
  end
  print(("  %-20s %s %.4f +- %.3g (wanted %.3g) of %d impacts on %d lattices, %s%s  %s"):format(where, t.of,
    state.of.mean, state.of.se, state.wanted, #state.rows, lattices,
    state.side == "both" and "from both sides" or "from one side",
    state.gain == state.gain and (" (pairs: x %.2g)"):format(state.gain) or "", missed))
end

local function tell(sweep, t, states, rounds)
  local impacts = 0
  for _, state in ipairs(states) do impacts = impacts + #state.rows end
  local number, all = fixed(states)
  print(("%s: %d impacts in %d rounds"):format(sweep.name, impacts, rounds))
  for _, state in ipairs(states) do told(state, sweep.names, t) end
  print(("  these errors are of the samples alone: what a finer %s would change (ricochet.refined) is not in them")
    :format(refine.division({ sweep.first }).one))
  print(("  by the pilot's deviations %d samples of every point would have met it too: %d impacts"):format(number, all))
end

-- What decides which scenes a round has, exactly.
local function text_of(sweep, states)
  local lines = {}
  for i, state in ipairs(states) do
    local parts = {}
    for k, name in ipairs(sweep.names) do parts[k] = ("%s = %q"):format(name, state.point[name]) end
    lines[i] = ("%s: %d, %d of them from both sides"):format(table.concat(parts, ", "), state.count,
      math.min(state.both, state.count))
  end
  return table.concat(lines, "\n")
end

-- The rows of all rounds so far. In shards they are those that were merged, and the first round of which some are not
-- there ends the script: with its plan, with a shard of it, or when what is there was merged.
local function rows_of_round(sweep, t, states, names, round)
  local points, scenes = asked(sweep, states)
  if core.part() ~= "whole" then
    local most = 0
    for _, state in ipairs(states) do most = math.max(most, state.count) end
    if not core.round_is_there(sweep.name, names, points, scenes, sweep.units, text_of(sweep, states), most,
      #states) then
      if round > 1 then
        local impacts = 0
        for _, state in ipairs(states) do impacts = impacts + #state.rows end
        print(("%s: %d impacts in %d rounds so far"):format(sweep.name, impacts, round - 1))
        for _, state in ipairs(states) do told(state, sweep.names, t, not state.done) end
      end
      core.end_round(sweep.name, round)
    end
  end
  return core.run_sweep(sweep.name, names, points, scenes, "round", sweep.units)
end

--- Runs it; the rows. sweep: { name =, names =, points = without samples, make = function (point) }.
local function run(sweep, t)
  local states, names, rounds = {}, copy(sweep.names), 0
  for _, name in ipairs { "sample", "mirrored", "pair" } do names[#names + 1] = name end
  sweep.made = {}
  for i, point in ipairs(sweep.points) do
    states[i] = begun(sweep, t, point)
    states[i].place, states[i].stride = i, #sweep.points
  end
  if core.is_check() then return core.run_sweep(sweep.name, names, asked(sweep, states)) end
  local goes_on = true
  while goes_on do
    sorted(rows_of_round(sweep, t, states, names, rounds + 1), states)
    goes_on, rounds = false, rounds + 1
    for _, state in ipairs(states) do
      if not state.done then
        state.done = not decide(state, t)
        goes_on = goes_on or not state.done
      end
    end
  end
  local points, scenes = asked(sweep, states)
  local rows = core.run_sweep(sweep.name, names, points, scenes, "last", sweep.units)
  tell(sweep, t, states, rounds)
  keep(sweep, states)
  return rows
end

return { checked = checked, run = run }
