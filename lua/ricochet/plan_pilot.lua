-- The pilot of ricochet.plan: what a few samples of a sweep show of each of its errors.
local core = require "ricochet.core"
local listed = require("ricochet.points").list
local refine = require "ricochet.refine"
local statistics = require "ricochet.statistics"
local sweeps = require "ricochet.sweep"

local pilot = {}

--- Of the wanted standard error, what the time step may take: 2 % of its square.
pilot.step_share = 0.2

local function copy(t)
  local result = {}
  for k, v in pairs(t) do result[k] = v end
  return result
end

--- The sweep's points without their sample, each once, and how many samples it has; of one by error those of its pilot.
function pilot.points_of(sweep, sample)
  if sweep.by_error then return listed(sweep), sweep.by_error.pilot end
  local list, seen, samples = {}, {}, {}
  for _, point in ipairs(listed(sweep)) do
    local rest, key = copy(point), ""
    rest[sample] = nil
    for _, name in ipairs(sweep.names) do
      if name ~= sample then key = key .. tostring(rest[name]) .. "\0" end
    end
    if not seen[key] then
      seen[key] = true
      list[#list + 1] = rest
    end
    samples[point[sample]] = true
  end
  local count = 0
  for value in pairs(samples) do
    count = count + 1
    if math.type(value) ~= "integer" then
      core.fail(("over.%s must hold whole numbers to be counted on, has %s"):format(sample, tostring(value)), "samples")
    end
  end
  return list, count
end

--- At most `most` of a list, spread evenly.
function pilot.spread_out(list, most)
  if #list <= most then return list end
  local few = {}
  for i = 1, most do few[i] = list[math.floor((i - 1) * (#list - 1) / (most - 1) + 1.5)] end
  return few
end

-- A number in as few digits as tell it apart from every other.
local function exactly(value)
  for digits = 4, 17 do
    local shown = ("%." .. digits .. "g"):format(value)
    if tonumber(shown) == value then return shown end
  end
end

--- What a point is called: the names in `over` and their values, but for the sample.
function pilot.name_of(point, names, sample)
  local parts = {}
  for _, name in ipairs(names) do
    if name ~= sample then
      local value = point[name]
      local shown = math.type(value) == "float" and exactly(value) or tostring(value)
      parts[#parts + 1] = ("%s=%s"):format(name, shown)
    end
  end
  return #parts > 0 and table.concat(parts, " ") or "all"
end

-- Seconds that the sweep's own function takes to make a sample of all points, the first time.
local function making_seconds(sweep, sample, points, count)
  local began = core.clock()
  for i = 1, count do
    for _, point in ipairs(points) do
      local at = copy(point)
      at[sample] = i
      sweeps.scene_at(sweep, at)
    end
  end
  return (core.clock() - began) / count
end

-- The scene of a point's i-th sample with `factor` times the nodes, and what `change` makes of its table.
local function changed_scene(sweep, sample, point, i, factor, change)
  local at = copy(point)
  at[sample] = i
  local t = core.given(refine.refined(sweeps.scene_at(sweep, at), factor, 0))
  change(t)
  return core.functions.scene(t)
end

-- A change of scenes: by a step for an accuracy.
local function to_accuracy(accuracy, of)
  return function(t)
    t.accuracy, t.accuracy_of = math.min(0.1, accuracy), of
    t.step, t.theta, t.method = nil, nil, nil
  end
end

-- Every point with samples 1 ... count on lattices of `factor` times the nodes: rows by point, and seconds a sample of
-- all points, from the sweep's own scenes to the outcomes.
local function run(sweep, sample, points, count, factor, change)
  local began, scenes = core.clock(), {}
  for i = 1, count do  -- points that share a lattice beside each other, as in the sweep
    for _, point in ipairs(points) do
      scenes[#scenes + 1] = changed_scene(sweep, sample, point, i, factor, change)
    end
  end
  local making = core.clock() - began
  local rows, seconds = core.pilot(scenes)
  local by_point = {}
  for k in ipairs(points) do by_point[k] = {} end
  for i, row in ipairs(rows) do table.insert(by_point[(i - 1) % #points + 1], row) end
  return by_point, (making + seconds) / count
end

--- What the pilot saw of every size of the list, by steps for that share of the wanted standard error that the plan t
--- leaves to them:
--- { factor =, rows = by point, seconds =, [point] = { mean =, sd =, se =, freedom = } }.
function pilot.of_sizes(sweep, t, points, all, factors)
  local making = making_seconds(sweep, t.samples, points, t.pilot)
  local change = to_accuracy(pilot.step_share * t.standard_error, t.of)
  local sizes = {}
  for i, factor in ipairs(factors) do
    local rows, seconds = run(sweep, t.samples, points, t.pilot, factor, change)
    sizes[i] = { factor = factor, rows = rows, seconds = (making + seconds) * #all / #points }
    for k, point in ipairs(points) do
      local of = statistics.of_finished(rows[k], t.of)
      if of.count < 2 then
        core.fail(("fewer than two impacts of the pilot finished at %s with %g times the nodes: %s"):format(
          pilot.name_of(point, sweep.names, t.samples), factor, rows[k][1].reason), "sweep")
      end
      sizes[i][k] = { mean = of.mean, sd = of.sd, se = of.se, freedom = of.count - 1 }
    end
  end
  return sizes
end

--- The error of the sweep's own time step at each point: the same samples by it and by a fine one.
function pilot.step_errors(sweep, t, points)
  local few = math.min(t.pilot, 2)
  local own = run(sweep, t.samples, points, few, 1, function() end)
  local fine = run(sweep, t.samples, points, few, 1, to_accuracy(0.01 * t.standard_error, t.of))
  local errors = {}
  for k in ipairs(points) do
    local square, count = 0, 0
    for i, row in ipairs(own[k]) do
      if row.status == "finished" and fine[k][i].status == "finished" then
        square, count = square + (row[t.of] - fine[k][i][t.of]) ^ 2, count + 1
      end
    end
    errors[k] = count > 0 and math.sqrt(square / count) or 0 / 0
  end
  return errors
end

-- The scene of a pilot's row with a contact twice as hard, by its own method at half its step; nothing where the scene
-- gives xi, which is of its model then.
local function harder_scene(sweep, sample, point, i, factor, row)
  local is_given
  local scene = changed_scene(sweep, sample, point, i, factor, function(t)
    local contact = copy(t.contact or {})
    is_given = contact.xi ~= nil
    contact.xi = 2 * row.xi
    t.contact, t.method, t.theta, t.step, t.accuracy = contact, row.method, row.theta / 2, nil, nil
  end)
  return not is_given and scene or nil
end

--- What an infinitely hard contact would change at each point, of those that the program chose: the mean over the
--- pilot's samples of 2 (x(2 xi) - x(xi)), as { mean =, se =, count = }; the error halves with every doubling. Nothing
--- of points that give xi. `size`: what the pilot saw of the sweep's own. [the differences of a sequence of order 1:
--- here]
function pilot.softness(sweep, t, points, size)
  local scenes, of, changes, softness = {}, {}, {}, {}
  for k, point in ipairs(points) do
    for i, row in ipairs(size.rows[k]) do
      local is_known = row.status == "finished" and row[t.of] == row[t.of]
      local scene = is_known and harder_scene(sweep, t.samples, point, i, size.factor, row)
      if scene then
        scenes[#scenes + 1], of[#of + 1] = scene, { k = k, value = row[t.of] }
        changes[k] = changes[k] or {}
      end
    end
  end
  for j, row in ipairs(#scenes > 0 and core.pilot(scenes) or {}) do
    if row.status == "finished" then table.insert(changes[of[j].k], 2 * (row[t.of] - of[j].value)) end
  end
  for k in pairs(changes) do softness[k] = statistics.of(changes[k]) end
  return softness
end

return pilot
