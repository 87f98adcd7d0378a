-- ricochet.plan: the error budget of a sweep (time step, size of lattice or mesh, contact, samples), and the cheapest
-- way to a wanted standard error.
local core = require "ricochet.core"
local designs = require "ricochet.designs"
local outcomes = require "ricochet.outcomes"
local of_sizes = require "ricochet.plan_sizes"
local pilot = require "ricochet.plan_pilot"
local refine = require "ricochet.refine"
local sampling = require "ricochet.sampling"
local statistics = require "ricochet.statistics"
local student = require "ricochet.student"
local sweeps = require "ricochet.sweep"
local text = require "ricochet.plan_text"

local most_points = 12        -- of the sweep's points that the pilot visits
local most_samples = 1e6      -- of a point that a plan may have
local least_nodes = 100       -- of a body: with fewer its contact is hardly more than a corner's
local factors = {}            -- of the number of nodes, that a plan chooses from
for i = -4, 8 do factors[#factors + 1] = 2 ^ (i / 2) end

local function copy(t)
  local result = {}
  for k, v in pairs(t) do result[k] = v end
  return result
end

-- Seconds at a factor, by a power law between sizes of the pilot; beyond them by nodes times steps, which is power 1.5.
local function seconds_at(sizes, factor)
  local below, above
  for _, size in ipairs(sizes) do
    if size.factor <= factor then below = size elseif not above then above = size end
  end
  if not (below and above) then
    local nearest = below or above
    return nearest.seconds * (factor / nearest.factor) ^ 1.5
  end
  local power = math.log(above.seconds / below.seconds) / math.log(above.factor / below.factor)
  return below.seconds * (factor / below.factor) ^ power
end

local function nearest_size(sizes, factor)
  local best = sizes[1]
  for _, size in ipairs(sizes) do
    if math.abs(math.log(size.factor / factor)) < math.abs(math.log(best.factor / factor)) then best = size end
  end
  return best
end

local Plan = { __name = "a plan", __metatable = false }
local held = setmetatable({}, { __mode = "k" })  -- what each plan is, where no script can change it
Plan.__index = function(_, name)
  return rawget(Plan, name) or core.unknown("a plan", name, {
    "run", "points", "samples", "nodes", "method", "theta", "choices", "predicted_seconds",
  })
end

-- The sweep that is planned, whose table is t; mistakes in t are told at its fields.
local function checked_sweep(t)
  local sweep = sweeps.contents(t.sweep) or core.fail("'sweep' must be a sweep (from ricochet.sweep)", "sweep")
  outcomes.check({ t.of }, "of")
  designs.refuse_groups(sweep.factors, "a plan", "sweep")
  if sweep.by_error then
    if t.samples ~= "sample" then
      core.fail("the sweep's samples = \"by_error\" counts them as 'sample'; leave 'samples' out", "samples")
    end
    sweep = copy(sweep)
    sweep.names = { table.unpack(sweep.names) }
    table.insert(sweep.names, t.samples)
  end
  local known = false
  for _, name in ipairs(sweep.names) do known = known or name == t.samples end
  if not known then core.fail(("the sweep's 'over' has no '%s' to count samples by"):format(t.samples), "samples") end
  if not core.accuracy_outcomes[t.of] then
    local names = {}
    for name in pairs(core.accuracy_outcomes) do names[#names + 1] = name end
    table.sort(names)
    core.fail(("the time step's error of '%s' cannot be estimated; plans are for one of %s"):format(
      t.of, table.concat(names, ", ")), "of")
  end
  return sweep
end

-- Factors of the nodes, rising.
local function sorted_sizes(given)
  local sizes = copy(given)
  table.sort(sizes)
  for i, factor in ipairs(sizes) do
    if not (factor > 0 and factor <= 16) then
      core.fail(("a size is a factor of the nodes, above 0 and at most 16, not %g"):format(factor), "sizes")
    end
    if factor == sizes[i - 1] then core.fail(("'sizes' names %g twice"):format(factor), "sizes") end
  end
  return sizes
end

-- The softness of a contact as an error: what it changes, where that is told apart from scatter.
local function counted(softness)
  return student.is_seen(softness.mean, softness.se, softness.count - 1) and math.abs(softness.mean) or 0
end

-- The four errors of the sweep as it is at point k, of which those of the time step and the contact are known.
local function budget_of_point(plan, name, k, step, softness)
  local sizes = plan.sizes
  local sd, sd_cautious = of_sizes.deviation(sizes, k)
  local slope, slope_se, slope_seen = of_sizes.error(sizes, k)
  local p = {
    name = name, mean = nearest_size(sizes, 1)[k].mean, sd = sd, sd_cautious = sd_cautious,
    sampling = sd / math.sqrt(plan.samples_now), slope = slope, slope_se = slope_se,
    slope_seen = slope_seen, lattice = math.sqrt(slope ^ 2 + slope_se ^ 2), step = step,
    softness = softness.mean, softness_se = softness.se, softness_counts = counted(softness),
  }
  local greatest = -1
  for _, part in ipairs { { "samples", p.sampling }, { plan.division .. " size", p.lattice }, { "time step", p.step },
    { "contact", p.softness_counts } } do
    if part[2] > greatest then p.dominates, greatest = part[1], part[2] end
  end
  return p
end

-- What is left of each error with `factor` times the nodes, and the samples that the worst point needs then; those of a
-- point on average where each takes its own, by_error, for one standard error of all.
local function needed_samples(t, points, factor, by_error)
  local strayed = math.abs(factor ^ -0.5 - (t.continuum and 0 or 1))
  local step_error = pilot.step_share * t.standard_error
  local budget = { sampling = 0, lattice = 0, step = step_error, softness = 0 }
  local least, spread, left = math.huge, 0, {}
  for k, p in ipairs(points) do
    left[k] = math.max(0, t.standard_error ^ 2 - step_error ^ 2 - (p.lattice * strayed) ^ 2 - p.softness_counts ^ 2)
    least, spread = math.min(least, left[k]), math.max(spread, p.sd_cautious)
    budget.lattice = math.max(budget.lattice, p.lattice * strayed)
    budget.softness = math.max(budget.softness, p.softness_counts)
  end
  local samples, sum = 2, 0
  for k, p in ipairs(points) do
    local square = by_error and least or left[k]
    local needed = square > 0 and math.ceil(p.sd_cautious ^ 2 / square) or math.huge
    if by_error then needed = math.max(sampling.least, needed) end
    samples, sum = math.max(samples, needed), sum + needed
  end
  budget.sampling = by_error and math.sqrt(least) or spread / math.sqrt(samples)
  return samples, budget, by_error and sum / #points or samples
end

-- The method and step of every point, as the pilot chose them; those of the shortest step are shown, and taken by
-- points that the pilot left out.
local function choose_steps(plan, rows)
  plan.choices = {}
  for k, p in ipairs(plan.points) do
    local row = rows[k][1]
    plan.choices[k] = { name = p.name, method = row.method, theta = row.theta }
    if k == 1 or row.step < plan.shortest then
      plan.shortest, plan.method, plan.theta = row.step, row.method, row.theta
    end
  end
end

-- Of every factor of the nodes, with the samples that its worst point needs, the cheapest.
local function choose_cheapest(plan, t)
  local sizes = plan.sizes
  for _, factor in ipairs(#sizes > 1 and factors or { sizes[1].factor }) do
    local samples, budget, of_a_point = needed_samples(t, plan.points, factor, plan.sweep.by_error)
    local seconds = of_a_point * seconds_at(sizes, factor)
    local enough = #sizes == 1 or factor >= plan.least_factor
    if enough and samples <= most_samples and (not plan.samples or seconds < plan.predicted_seconds) then
      plan.samples, plan.nodes, plan.predicted_seconds, plan.budget = samples, factor, seconds, budget
      plan.of_a_point = of_a_point
      choose_steps(plan, nearest_size(sizes, factor).rows)
    elseif not plan.samples then
      plan.budget = budget
    end
  end
end

-- The least factor of the nodes that leaves every body at any point enough of them; 1 where one has too few.
local function least_factor(sweep, points, sample)
  local fewest = math.huge
  for _, point in ipairs(points) do
    local at = copy(point)
    at[sample] = 1
    local scene = core.given(sweeps.scene_at(sweep, at))
    for _, body in ipairs { scene.projectile, scene.target } do
      if next(core.given(body)) ~= nil then fewest = math.min(fewest, core.nodes_of(body)) end
    end
  end
  return math.min(1, least_nodes / fewest)
end

-- Sizes for a pilot that was given none: a quarter, a half and all of the nodes; larger ones where those are too few.
local function usual_sizes(least)
  if least <= 0.25 then return { 0.25, 0.5, 1 } end
  return least <= 0.5 and { 0.5, 1 } or { 1, 2 }
end

-- The scenes of a sample; with --check all that is made.
local function make_scenes(sweep, points, sample)
  local scenes = {}
  for i, point in ipairs(points) do
    local at = copy(point)
    at[sample] = 1
    scenes[i] = sweeps.scene_at(sweep, at)
  end
  return scenes
end

-- The plan of a sweep from what the pilot shows of it at the points.
local function planned(sweep, t, points, all, samples_now)
  local least = least_factor(sweep, points, t.samples)
  local sizes = pilot.of_sizes(sweep, t, points, all, sorted_sizes(t.sizes or usual_sizes(least)))
  local steps = pilot.step_errors(sweep, t, points)
  local softness = pilot.softness(sweep, t, points, nearest_size(sizes, 1))
  local processor, cores = core.machine()
  local result = {
    sweep = sweep, sample = t.samples, of = t.of, standard_error = t.standard_error, pilot = t.pilot, sizes = sizes,
    samples_now = samples_now, points = {}, budget = {}, samples = false, least_factor = least,
    division = refine.division(make_scenes(sweep, points, t.samples)).one,
    machine = ("%s (%d cores)"):format(processor, cores),
  }
  local of_the_model = { mean = 0, se = 0, count = 0 }  -- where the scenes give xi
  for k, point in ipairs(points) do
    local name = pilot.name_of(point, sweep.names, t.samples)
    result.points[k] = budget_of_point(result, name, k, steps[k], softness[k] or of_the_model)
  end
  choose_cheapest(result, t)
  return result
end

local function plan(given)
  local t = core.check("plan", given)
  local sweep = checked_sweep(t)
  local all, samples_now = pilot.points_of(sweep, t.samples)
  local points = pilot.spread_out(all, most_points)
  if t.sizes then sorted_sizes(t.sizes) end
  if core.is_check() then
    make_scenes(sweep, points, t.samples)
    return nil
  end
  local began = core.clock()
  local result = planned(sweep, t, points, all, samples_now)
  result.pilot_seconds = core.clock() - began
  text.print(result, { factor = factors[#factors], samples = most_samples })
  if core.is_resume() then text.go_on_with_kept(result) end
  local shown = { sweep = t.sweep }
  for name, value in pairs(result) do
    if name ~= "sweep" then shown[name] = core.plain(value) end
  end
  held[shown] = result
  return setmetatable(shown, Plan)
end

-- The fields of a sweep by error, as the plan has them.
local function by_the_plan(given, plan)
  return { samples = "by_error", standard_error = plan.budget.sampling, of = plan.of, pilot = given.pilot,
    most = math.max(given.most, given.pilot), mirrored = given.mirrored }
end

--- Runs the planned sweep; prints the predicted and the real time. Returns its rows.
Plan.run = core.wrap(function(plan)
  local self = core.is(plan, Plan) and held[plan] or core.fail "is a method of a plan: write plan:run(), with a colon"
  if not self.samples then core.fail "there is no plan to run: the wanted standard error is out of reach" end
  local sweep, over, values = self.sweep, {}, {}
  for i = 1, self.samples do values[i] = i end
  for _, name in ipairs(sweep.names) do over[name] = sweep.over[name] end
  local counted = sweep.by_error and by_the_plan(sweep.by_error, self) or {}
  if not sweep.by_error then over[self.sample] = values end
  local choices = {}
  for _, choice in ipairs(self.choices) do choices[choice.name] = choice end
  text.keep(self)
  counted.name, counted.over, counted.units = sweep.name, over, sweep.units
  function counted.scene(at)
    local scene = core.given(refine.refined(sweep.scene(at), self.nodes, 0))
    local chosen = choices[pilot.name_of(at, sweep.names, self.sample)] or self
    scene.method, scene.theta, scene.step, scene.accuracy = chosen.method, chosen.theta, nil, nil
    return core.with_chosen_step(core.functions.scene(scene), self.budget.step)
  end
  local began = core.clock()
  local rows = sweeps.sweep(counted):run()
  local took = core.clock() - began
  -- The standard error that came of it, at the worst of the points.
  local by_point, worst = {}, { se = -1 }
  for _, row in ipairs(rows) do
    local name = pilot.name_of(row, sweep.names, self.sample)
    by_point[name] = by_point[name] or {}
    table.insert(by_point[name], row)
  end
  for name, list in pairs(by_point) do
    local of = statistics.of_units(list, self.of)
    if of.units > 1 and of.se > worst.se then worst = { name = name, se = of.se, sd = of.sd } end
  end
  print(("predicted %.1f s, took %.1f s; largest standard error %.2g of %s at %s, wanted %g"):format(
    self.predicted_seconds, took, worst.se, self.of, worst.name, self.standard_error))
  if not sweep.by_error and worst.se > self.standard_error then
    local enough = math.ceil((worst.sd / self.standard_error) ^ 2)
    print(("  more than the pilot of %d had shown: %d samples would do"):format(self.pilot, enough))
  end
  return rows
end)

return { plan = plan }
