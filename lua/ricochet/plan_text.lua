-- What ricochet.plan prints, and the plan that a run keeps.
local core = require "ricochet.core"

local text = {}

local function print_line(...) print((...):format(select(2, ...))) end

-- A change and its standard error.
local function change_text(change, se)
  return change == change and ("%+.2g +- %.2g"):format(change, se) or "unknown"
end

local function print_budget(plan)
  local size = plan.division .. " size"
  print_line("error budget of the sweep as it is: %d samples a point", plan.samples_now)
  print_line("%-20s %9s %9s %18s %10s %18s  %s", "point", plan.of, "sampling", size, "time step", "contact",
    "dominates")
  for _, p in ipairs(plan.points) do
    print_line("%-20s %9.4f %9.2g %18s %10.2g %18s  %s", p.name, p.mean, p.sampling,
      change_text(-p.slope, p.slope_se) .. (p.slope_seen and " *" or ""), p.step,
      change_text(p.softness, p.softness_se), p.dominates)
  end
  print_line("  %s: what an infinitely fine %s would change, extrapolated in the spacing, and what the pilot leaves "
    .. "unknown of it; *: told apart from 0", size, plan.division)
  print_line("  contact: what an infinitely hard one would change, mean over the pilot's samples; it counts where it "
    .. "is told apart from 0")
end

-- How many samples the plan takes.
local function samples_of(plan)
  if not plan.sweep.by_error then return ("%d samples a point"):format(plan.samples) end
  return ("samples by error: %.3g a point on average, at most %d (fewer where pairs pay, which the pilot does not see)")
    :format(plan.of_a_point, plan.samples)
end

local function print_cheapest(plan)
  local alike = true
  for _, choice in ipairs(plan.choices) do
    alike = alike and choice.method == plan.method and choice.theta == plan.theta
  end
  print_line("cheapest: %s with theta %.3g%s, %.3g times the nodes, %s; predicted %.1f s on %s",
    plan.method, plan.theta, alike and "" or " at the hardest point", plan.nodes, samples_of(plan),
    plan.predicted_seconds, plan.machine)
  if not alike then
    for _, choice in ipairs(plan.choices) do
      print_line("  %s: %s with theta %.3g", choice.name, choice.method, choice.theta)
    end
  end
  if #plan.sizes == 1 then
    print_line("  of the %s's own error one size tells nothing: the nodes stay as they are", plan.division)
  end
  print_line("  leaves %.2g from samples%s, %.2g from the %s's size, "
    .. "%.2g from the time step, %.2g from the contact's softness", plan.budget.sampling,
    plan.sweep.by_error and "" or " (less nine times of ten)", plan.budget.lattice, plan.division, plan.budget.step,
    plan.budget.softness)
end

--- The budget of a plan and the cheapest way, or why there is none within `limits`: the greatest factor of the nodes,
--- and the most samples.
function text.print(plan, limits)
  print_line("plan for %s of sweep '%s': standard error %g", plan.of, plan.sweep.name, plan.standard_error)
  print_line("pilot: %d samples at %d points, %d sizes; %.1f s", plan.pilot, #plan.points, #plan.sizes,
    plan.pilot_seconds)
  print_budget(plan)
  if plan.samples then
    print_cheapest(plan)
  else
    print_line("no plan: with %.2g from the %s's size and %.2g from the contact's softness, %g is out of reach of "
      .. "%.3g times the nodes and %.0g samples; raise 'pilot' or 'sizes', give a greater contact.xi, ask for less, or "
      .. "leave 'continuum' out", plan.budget.lattice, plan.division, plan.budget.softness, plan.standard_error,
      #plan.sizes > 1 and limits.factor or plan.sizes[1].factor, limits.samples)
  end
end

-- Measured times differ between runs, and with them the cheapest plan: what a run decided is kept, so that --resume
-- goes on with it.
local function plan_file(sweep) return sweep.name .. "_plan.txt" end
local function request(plan) return ("standard_error %.15g of %s"):format(plan.standard_error, plan.of) end

--- Writes the plan to the file that --resume reads.
function text.keep(plan)
  local lines = {
    request(plan), ("samples %d"):format(plan.samples), ("nodes %.17g"):format(plan.nodes),
    ("predicted_seconds %.3g"):format(plan.predicted_seconds),
    ("sampling_error %.17g"):format(plan.budget.sampling),
  }
  for _, choice in ipairs(plan.choices) do
    lines[#lines + 1] = ("point %s: %s theta %.17g"):format(choice.name, choice.method, choice.theta)
  end
  lines[#lines + 1] = ("others: %s theta %.17g\n"):format(plan.method, plan.theta)
  core.functions["file.write"](plan_file(plan.sweep), table.concat(lines, "\n"))
end

--- Puts what an earlier run kept in the place of what the pilot chose, if it kept anything.
function text.go_on_with_kept(plan)
  local known, kept_text = pcall(core.functions["file.read"], plan_file(plan.sweep))
  if not known then return end
  local kept = kept_text:match "^[^\n]*"
  if kept ~= request(plan) then
    core.fail(("%s keeps the plan of the earlier run, for a %s; "
      .. "give --resume the same, or run anew with --force"):format(plan_file(plan.sweep), kept), "standard_error")
  end
  local samples, nodes, seconds, of_samples =
    kept_text:match "samples (%S+)\nnodes (%S+)\npredicted_seconds (%S+)\nsampling_error (%S+)\n"
  plan.samples, plan.nodes, plan.predicted_seconds = math.tointeger(samples), tonumber(nodes), tonumber(seconds)
  plan.budget.sampling = tonumber(of_samples)
  plan.choices = {}
  for name, method, theta in kept_text:gmatch "\npoint ([^\n]-): (%S+) theta ([^\n]+)" do
    plan.choices[#plan.choices + 1] = { name = name, method = method, theta = tonumber(theta) }
  end
  local method, theta = kept_text:match "\nothers: (%S+) theta (%S+)"
  plan.method, plan.theta = method, tonumber(theta)
  if not (plan.samples and plan.nodes and plan.predicted_seconds and plan.budget.sampling and plan.method and
      plan.theta) then
    core.fail(("%s is damaged; restore it from a copy, or run anew with --force"):format(plan_file(plan.sweep)))
  end
  local samples_text = plan.sweep.by_error and ("%.2g from samples"):format(plan.budget.sampling)
    or ("%d samples a point"):format(plan.samples)
  print(("goes on with the plan of the earlier run: %.3g times the nodes, %s"):format(plan.nodes, samples_text))
end

return text
