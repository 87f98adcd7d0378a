-- ricochet.plan: the error budget of a sweep (time step, lattice size, contact, samples), and the cheapest way to a
-- wanted standard error.
local core = require "ricochet.core"
local outcomes = require "ricochet.outcomes"
local sweeps = require "ricochet.sweep"
local refine = require "ricochet.refine"
local statistics = require "ricochet.statistics"

local most_points = 12        -- of the sweep's points that the pilot visits
local most_samples = 1e6     -- of a point that a plan may have
local step_share = 0.2        -- of the wanted standard error that the time step may take: 2 % of its square
local least_nodes = 100       -- of a body: with fewer its contact is hardly more than a corner's
local factors = {}            -- of the number of nodes, that a plan chooses from
for i = -4, 8 do factors[#factors + 1] = 2 ^ (i / 2) end

local function copy(t)
  local result = {}
  for k, v in pairs(t) do result[k] = v end
  return result
end

-- The sweep's points without their sample, each once, and how many samples it has.
local function points_of(sweep, sample)
  local list, seen, samples = {}, {}, {}
  for _, point in ipairs(sweep.points) do
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

local function spread_out(list, most)
  if #list <= most then return list end
  local few = {}
  for i = 1, most do few[i] = list[math.floor((i - 1) * (#list - 1) / (most - 1) + 1.5)] end
  return few
end

-- The variance that is exceeded in one of ten cases, over the one that n degrees of freedom measured: n / chi^2 at 0.1,
-- by Wilson and Hilferty's approximation, good to 1 % from 5 degrees on.
local function cautious(n)
  return 1 / math.max(0.05, 1 - 2 / (9 * n) - 1.2816 * math.sqrt(2 / (9 * n))) ^ 3
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

-- Every point with samples 1 ... count on lattices of `factor` times the nodes: rows by point, and seconds a sample of
-- all points, from the sweep's own scenes to the outcomes.
local function pilot(sweep, sample, points, count, factor, changes)
  local began, scenes = core.clock(), {}
  for i = 1, count do  -- points that share a lattice beside each other, as in the sweep
    for _, point in ipairs(points) do
      local at = copy(point)
      at[sample] = i
      local t = core.given(refine.refined(sweeps.scene_at(sweep, at), factor, 0))
      for name, value in pairs(changes) do t[name] = value end
      if changes.accuracy then t.step, t.theta, t.method = nil, nil, nil end
      scenes[#scenes + 1] = core.functions.scene(t)
    end
  end
  local making = core.clock() - began
  local rows, seconds = core.pilot(scenes)
  local by_point = {}
  for k in ipairs(points) do by_point[k] = {} end
  for i, row in ipairs(rows) do table.insert(by_point[(i - 1) % #points + 1], row) end
  return by_point, (making + seconds) / count
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

-- Deviation of a point's outcome over lattices, from all sizes of the pilot, and the one to plan with.
local function deviation(sizes, k)
  local square, freedom = 0, 0
  for _, size in ipairs(sizes) do
    square = square + size[k].sd ^ 2 * size[k].freedom
    freedom = freedom + size[k].freedom
  end
  return math.sqrt(square / freedom), math.sqrt(square / freedom * cautious(freedom))
end

local function name_of(point, names, sample)
  local parts = {}
  for _, name in ipairs(names) do
    if name ~= sample then
      local value = point[name]
      local shown = type(value) == "number" and ("%.4g"):format(value) or tostring(value)
      parts[#parts + 1] = ("%s=%s"):format(name, shown)
    end
  end
  return #parts > 0 and table.concat(parts, " ") or "all"
end

local Plan = { __name = "a plan", __metatable = false }
local held = setmetatable({}, { __mode = "k" })  -- what each plan is, where no script can change it
Plan.__index = function(_, name)
  return rawget(Plan, name) or core.unknown("a plan", name, {
    "run", "points", "samples", "nodes", "method", "theta", "choices", "predicted_seconds",
  })
end

local function print_line(...) print((...):format(select(2, ...))) end

local function print_budget(plan)
  print_line("error budget of the sweep as it is: %d samples a point", plan.samples_now)
  print_line("%-20s %9s %9s %18s %10s %8s  %s", "point", plan.of, "sampling", "lattice size", "time step", "contact",
    "dominates")
  for _, p in ipairs(plan.points) do
    local lattice = ("%+.2g +- %.2g"):format(-p.slope, p.slope_se)
    print_line("%-20s %9.4f %9.2g %18s %10.2g %8.2g  %s", p.name, p.mean, p.sampling, lattice, p.step, p.softness,
      p.dominates)
  end
  print_line("  lattice size: what an infinitely fine lattice would change, extrapolated in the spacing, "
    .. "and what the pilot leaves unknown of it")
end

local function print_cheapest(plan)
  local alike = true
  for _, choice in ipairs(plan.choices) do
    alike = alike and choice.method == plan.method and choice.theta == plan.theta
  end
  print_line("cheapest: %s with theta %.3g%s, %.3g times the nodes, %d samples a point; predicted %.1f s on %s",
    plan.method, plan.theta, alike and "" or " at the hardest point", plan.nodes, plan.samples, plan.predicted_seconds,
    plan.machine)
  if not alike then
    for _, choice in ipairs(plan.choices) do
      print_line("  %s: %s with theta %.3g", choice.name, choice.method, choice.theta)
    end
  end
  if #plan.sizes == 1 then
    print_line "  of the lattice's own error one size tells nothing: the nodes stay as they are"
  end
  print_line("  leaves %.2g from samples (less nine times of ten), %.2g from the lattice's size, "
    .. "%.2g from the time step, %.2g from the contact's softness", plan.budget.sampling, plan.budget.lattice,
    plan.budget.step, plan.budget.softness)
end

local function print_plan(plan)
  print_line("plan for %s of sweep '%s': standard error %g", plan.of, plan.sweep.name, plan.standard_error)
  print_line("pilot: %d samples at %d points, %d sizes; %.1f s", plan.pilot, #plan.points, #plan.sizes,
    plan.pilot_seconds)
  print_budget(plan)
  if plan.samples then
    print_cheapest(plan)
  else
    print_line("no plan: with %.2g from the lattice's size and %.2g from the contact's softness, %g is out of reach of "
      .. "%.3g times the nodes and %.0g samples; raise 'pilot' or 'sizes', give a greater contact.xi, ask for less, or "
      .. "leave 'continuum' out", plan.budget.lattice, plan.budget.softness, plan.standard_error,
      #plan.sizes > 1 and factors[#factors] or plan.sizes[1].factor, most_samples)
  end
end

-- Measured times differ between runs, and with them the cheapest plan: what a run decided is kept, so that --resume
-- goes on with it.
local function plan_file(sweep) return sweep.name .. "_plan.txt" end
local function request(plan) return ("standard_error %.15g of %s"):format(plan.standard_error, plan.of) end

local function keep(plan)
  local lines = {
    request(plan), ("samples %d"):format(plan.samples), ("nodes %.17g"):format(plan.nodes),
    ("predicted_seconds %.3g"):format(plan.predicted_seconds),
  }
  for _, choice in ipairs(plan.choices) do
    lines[#lines + 1] = ("point %s: %s theta %.17g"):format(choice.name, choice.method, choice.theta)
  end
  lines[#lines + 1] = ("others: %s theta %.17g\n"):format(plan.method, plan.theta)
  core.functions["file.write"](plan_file(plan.sweep), table.concat(lines, "\n"))
end

local function go_on_with_kept(plan)
  local known, text = pcall(core.functions["file.read"], plan_file(plan.sweep))
  if not known then return end
  local kept = text:match "^[^\n]*"
  if kept ~= request(plan) then
    core.fail(("%s keeps the plan of the earlier run, for a %s; "
      .. "give --resume the same, or run anew with --force"):format(plan_file(plan.sweep), kept), "standard_error")
  end
  local samples, nodes, seconds = text:match "samples (%S+)\nnodes (%S+)\npredicted_seconds (%S+)\n"
  plan.samples, plan.nodes, plan.predicted_seconds = math.tointeger(samples), tonumber(nodes), tonumber(seconds)
  plan.choices = {}
  for name, method, theta in text:gmatch "\npoint ([^\n]-): (%S+) theta ([^\n]+)" do
    plan.choices[#plan.choices + 1] = { name = name, method = method, theta = tonumber(theta) }
  end
  local method, theta = text:match "\nothers: (%S+) theta (%S+)"
  plan.method, plan.theta = method, tonumber(theta)
  if not (plan.samples and plan.nodes and plan.predicted_seconds and plan.method and plan.theta) then
    core.fail(("%s is damaged; restore it from a copy, or run anew with --force"):format(plan_file(plan.sweep)))
  end
  print(("goes on with the plan of the earlier run: %.3g times the nodes, %d samples a point"):format(plan.nodes,
    plan.samples))
end

-- The sweep that is planned, whose table is t; mistakes in t are told at its fields.
local function checked_sweep(t)
  local sweep = sweeps.contents(t.sweep) or core.fail("'sweep' must be a sweep (from ricochet.sweep)", "sweep")
  outcomes.check({ t.of }, "of")
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

-- What the pilot saw of every size:
-- { factor =, rows = by point, seconds =, [point] = { mean =, sd =, se =, freedom = } }.
local function pilot_of_sizes(sweep, t, points, all, factors_tried)
  local making = making_seconds(sweep, t.samples, points, t.pilot)
  local changes = { accuracy = math.min(0.1, step_share * t.standard_error), accuracy_of = t.of }
  local sizes = {}
  for i, factor in ipairs(factors_tried) do
    local rows, seconds = pilot(sweep, t.samples, points, t.pilot, factor, changes)
    sizes[i] = { factor = factor, rows = rows, seconds = (making + seconds) * #all / #points }
    for k, point in ipairs(points) do
      local of = statistics.of_finished(rows[k], t.of)
      if of.count < 2 then
        core.fail(("fewer than two impacts of the pilot finished at %s with %g times the nodes: %s"):format(
          name_of(point, sweep.names, t.samples), factor, rows[k][1].reason), "sweep")
      end
      sizes[i][k] = { mean = of.mean, sd = of.sd, se = of.se, freedom = of.count - 1 }
    end
  end
  return sizes
end

-- The error of the sweep's own time step at each point: the same samples by it and by a fine one.
local function step_errors(sweep, t, points)
  local few = math.min(t.pilot, 2)
  local own = pilot(sweep, t.samples, points, few, 1, {})
  local finer = { accuracy = math.min(0.1, 0.01 * t.standard_error), accuracy_of = t.of }
  local fine = pilot(sweep, t.samples, points, few, 1, finer)
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

-- The mean of what the trials said of the contact's softness; 0 where the scenes give xi, and it is of the model.
local function softness_of(rows)
  local sum, count = 0, 0
  for _, row in ipairs(rows) do
    if row.error_contact == row.error_contact then sum, count = sum + row.error_contact, count + 1 end
  end
  return count > 0 and sum / count or 0
end

-- The four errors of the sweep as it is at point k, whose time step's is known.
local function budget_of_point(name, sizes, k, samples_now, step)
  local sd, sd_cautious = deviation(sizes, k)
  -- What the lattice's size changes, per unit of the spacing over the scene's own: as seen, and together with what is
  -- not known of it.
  local by_spacing = {}
  for i, size in ipairs(sizes) do
    by_spacing[i] = { x = size.factor ^ -0.5, value = size[k].mean, se = math.max(size[k].se, 1e-12) }
  end
  local slope, slope_se = 0, 0
  if #sizes > 1 then slope, slope_se = refine.fitted_line(by_spacing) end  -- of one size nothing is known
  local p = {
    name = name, mean = nearest_size(sizes, 1)[k].mean, sd = sd, sd_cautious = sd_cautious,
    sampling = sd / math.sqrt(samples_now), slope = slope, slope_se = slope_se,
    lattice = math.sqrt(slope ^ 2 + slope_se ^ 2), step = step,
    softness = softness_of(nearest_size(sizes, 1).rows[k]),
  }
  local greatest = -1
  for _, part in ipairs { { "samples", p.sampling }, { "lattice size", p.lattice }, { "time step", p.step },
    { "contact", p.softness } } do
    if part[2] > greatest then p.dominates, greatest = part[1], part[2] end
  end
  return p
end

-- The samples that the worst point needs with `factor` times the nodes, and what is left of each error then.
local function needed_samples(t, points, factor)
  local strayed = math.abs(factor ^ -0.5 - (t.continuum and 0 or 1))
  local step_error = step_share * t.standard_error
  local samples, budget = 2, { sampling = 0, lattice = 0, step = step_error, softness = 0 }
  for _, p in ipairs(points) do
    local left = t.standard_error ^ 2 - step_error ^ 2 - (p.lattice * strayed) ^ 2 - p.softness ^ 2
    samples = left > 0 and math.max(samples, math.ceil(p.sd_cautious ^ 2 / left)) or math.huge
    budget.sampling = math.max(budget.sampling, p.sd_cautious)
    budget.lattice = math.max(budget.lattice, p.lattice * strayed)
    budget.softness = math.max(budget.softness, p.softness)
  end
  budget.sampling = budget.sampling / math.sqrt(samples)
  return samples, budget
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
    local samples, budget = needed_samples(t, plan.points, factor)
    local seconds = samples * seconds_at(sizes, factor)
    local enough = #sizes == 1 or factor >= plan.least_factor
    if enough and samples <= most_samples and (not plan.samples or seconds < plan.predicted_seconds) then
      plan.samples, plan.nodes, plan.predicted_seconds, plan.budget = samples, factor, seconds, budget
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
      local given = core.given(body)
      if next(given) ~= nil then fewest = math.min(fewest, core.check("body", given, true).nodes) end
    end
  end
  return math.min(1, least_nodes / fewest)
end

-- Sizes for a pilot that was given none: a quarter, a half and all of the nodes; larger ones where those are too few.
local function usual_sizes(least)
  if least <= 0.25 then return { 0.25, 0.5, 1 } end
  return least <= 0.5 and { 0.5, 1 } or { 1, 2 }
end

-- With --check: that the sweep's scenes can be made.
local function make_scenes(sweep, points, sample)
  for _, point in ipairs(points) do
    local at = copy(point)
    at[sample] = 1
    sweeps.scene_at(sweep, at)
  end
end

local function plan(given)
  local t = core.check("plan", given)
  local sweep = checked_sweep(t)
  local all, samples_now = points_of(sweep, t.samples)
  local points = spread_out(all, most_points)
  if t.sizes then sorted_sizes(t.sizes) end
  if core.is_check() then return make_scenes(sweep, points, t.samples) end
  local began = core.clock()
  local least = least_factor(sweep, points, t.samples)
  local factors_tried = sorted_sizes(t.sizes or usual_sizes(least))
  local sizes = pilot_of_sizes(sweep, t, points, all, factors_tried)
  local steps = step_errors(sweep, t, points)
  local processor, cores = core.machine()
  local result = {
    sweep = sweep, sample = t.samples, of = t.of, standard_error = t.standard_error, pilot = t.pilot, sizes = sizes,
    samples_now = samples_now, all = all, points = {}, budget = {}, samples = false,
    least_factor = least,
    machine = ("%s (%d cores)"):format(processor, cores),
  }
  for k, point in ipairs(points) do
    local name = name_of(point, sweep.names, t.samples)
    result.points[k] = budget_of_point(name, sizes, k, samples_now, steps[k])
  end
  choose_cheapest(result, t)
  result.pilot_seconds = core.clock() - began
  print_plan(result)
  if core.is_resume() then go_on_with_kept(result) end
  local shown = { sweep = t.sweep }
  for name, value in pairs(result) do
    if name ~= "sweep" and name ~= "all" then shown[name] = core.plain(value) end
  end
  held[shown] = result
  return setmetatable(shown, Plan)
end

--- Runs the planned sweep; prints the predicted and the real time. Returns its rows.
Plan.run = core.wrap(function(plan)
  local self = core.is(plan, Plan) and held[plan] or core.fail "is a method of a plan: write plan:run(), with a colon"
  if not self.samples then core.fail "there is no plan to run: the wanted standard error is out of reach" end
  local sweep, over, values = self.sweep, {}, {}
  for i = 1, self.samples do values[i] = i end
  for _, name in ipairs(sweep.names) do over[name] = sweep.over[name] end
  over[self.sample] = values
  local choices = {}
  for _, choice in ipairs(self.choices) do choices[choice.name] = choice end
  keep(self)
  local planned = sweeps.sweep { name = sweep.name, over = over, scene = function(at)
    local scene = core.given(refine.refined(sweep.scene(at), self.nodes, 0))
    local chosen = choices[name_of(at, sweep.names, self.sample)] or self
    scene.method, scene.theta, scene.step, scene.accuracy = chosen.method, chosen.theta, nil, nil
    return core.with_chosen_step(core.functions.scene(scene), self.budget.step)
  end }
  local began = core.clock()
  local rows = planned:run()
  local took = core.clock() - began
  -- The standard error that came of it, at the worst of the points.
  local by_point, worst = {}, { se = -1 }
  for _, row in ipairs(rows) do
    local name = name_of(row, sweep.names, self.sample)
    by_point[name] = by_point[name] or {}
    table.insert(by_point[name], row)
  end
  for name, list in pairs(by_point) do
    local of = statistics.of_finished(list, self.of)
    if of.count > 1 and of.se > worst.se then worst = { name = name, se = of.se, sd = of.sd } end
  end
  print(("predicted %.1f s, took %.1f s; largest standard error %.2g of %s at %s, wanted %g"):format(
    self.predicted_seconds, took, worst.se, self.of, worst.name, self.standard_error))
  if worst.se > self.standard_error then
    local enough = math.ceil((worst.sd / self.standard_error) ^ 2)
    print(("  more than the pilot of %d had shown: %d samples would do"):format(self.pilot, enough))
  end
  return rows
end)

return { plan = plan }
