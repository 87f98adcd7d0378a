-- What effects cost and what they change: ricochet effects --cost, ricochet.relevance.
local core = require "ricochet.core"
local outcomes = require "ricochet.outcomes"
local refine = require "ricochet.refine"
local statistics = require "ricochet.statistics"
local student = require "ricochet.student"

local function with_effects(scene, effects)
  local t = core.given(scene)
  t.effects = effects
  -- One method for all, so that only the effects differ.
  t.method, t.step, t.theta, t.accuracy = "verlet", nil, nil, nil
  return core.functions.scene(t)
end

local priced = { method = "verlet", theta = 1.2 }

-- The scene with a contact that is the same whatever acts beside it, and stable at that step: what effects cost does
-- not depend on it.
local function with_contact(scene)
  local t, contact = core.given(scene), {}
  for name, value in pairs(t.contact or {}) do contact[name] = value end
  contact.V0, contact.xi = contact.V0 or 1000, contact.xi or 300
  t.contact = contact
  return core.functions.scene(t)
end

--- Prints what each effect of the catalogue costs in a scene, and the scene's own effects together: nanoseconds a node
--- and step beside those of the bare scene, all by verlet in one run; the least of the repeats counts. Without a scene:
--- the paper's soft wall.
local function cost(scene, repeats)
  local ricochet = require "ricochet"
  scene = scene or ricochet.scene {
    projectile = ricochet.disk { nodes = 800, placement = "poisson_disk", roughness = 0.03, seed = 1 },
    target = ricochet.wall { nodes = 4000, placement = "poisson_disk", stiffness = 100, roughness = 0.03, seed = 1 },
    launch = { speed = 0.1, psi1 = 1 },
  }
  scene = with_contact(scene)
  local own = core.given(scene).effects or {}
  local variants = {}
  local function add(name, effects, example)
    variants[#variants + 1] = {
      name = name, scene = with_effects(scene, effects), seconds = math.huge, example = example,
    }
  end
  add("bare", {})
  for _, effect in ipairs(core.catalogue()) do
    add(effect.name, { load("local ricochet = ... return " .. effect.example)(ricochet) }, effect.example)
  end
  if #own > 0 then add("the scene's own", own) end
  -- An effect that cannot act in this scene (moving anchors of a free body, attraction beyond the contact's reach) is
  -- left out, by what it says.
  for _, variant in ipairs(variants) do
    local works, message = pcall(core.accuracy_runs, variant.scene, { priced }, 1)
    if not works and variant.name ~= "bare" and variant.name ~= "the scene's own" then
      variant.refused = tostring(message):match "'effects': ([^\n]*)" or "does not act in this scene"
    end
    if not works and not variant.refused then error(message, 0) end
  end
  for _ = 1, repeats do  -- in turn, so that a busy moment does not fall on one of them alone
    for _, variant in ipairs(variants) do
      if variant.refused then goto continue end
      local row = core.accuracy_runs(variant.scene, { priced }, 1)[1]
      if row.status ~= "finished" then
        core.fail(("with %s the impact ended %s: %s"):format(variant.name, row.status, row.reason))
      end
      variant.seconds, variant.steps = math.min(variant.seconds, row.wall_seconds / row.steps), row.steps
      ::continue::
    end
  end
  local processor, cores = core.machine()
  local nodes = core.nodes(scene)
  print(("cost of effects on %s (%d cores), %d nodes, one impact alone, least of %d runs"):format(processor, cores,
    nodes, repeats))
  print(("%-16s %16s %14s   %s"):format("", "ns/node/step", "of the bare", "as in"))
  for _, variant in ipairs(variants) do
    if variant.refused then
      print(("%-16s %16s %14s   %s"):format(variant.name, "-", "-", variant.refused))
    else
      local share = variant.seconds / variants[1].seconds
      print(("%-16s %16.2f %13.1f%%   %s"):format(variant.name, variant.seconds / nodes * 1e9, 100 * share,
        variant.example or ""))
    end
  end
end

-- What the change c of an outcome comes to; `rows` and `bare` are those with and without the effect.
local function verdict_of(c, rows, bare)
  if c.count < 2 then
    local failed = rows[1].status ~= "finished" and rows[1] or bare[1].status ~= "finished" and bare[1]
    return ("%d pairs finished with this outcome defined: %s"):format(c.count, failed and failed.reason or "")
  end
  local change = math.abs(c.change)
  if math.max(change, c.se) < 1e-12 or not student.is_seen(change, c.se, c.count - 1) then return "not seen" end
  if c.sampling == 0 then return "changes it; these samples do not scatter" end
  return change < c.sampling and "below the sampling error" or "matters"
end

-- Why each effect cannot act in the scene, by its place; nothing of those that can.
local function refusals_in(scene, effects)
  local refusals, count = {}, 0
  for i, effect in ipairs(effects) do
    local refusal = core.refused_effects(with_effects(scene, { effect }))
    if refusal ~= "" then refusals[i], count = refusal, count + 1 end
  end
  if count == #effects then core.fail("'effects': none of them can act: " .. refusals[1], "effects") end
  return refusals
end

-- "-" for what is undefined.
local function shown(format, value) return value == value and format:format(value) or "-" end

-- What an effect changes of a column: `rows` and `bare` are of the same lattices, so their scatter falls out.
local function change_of(column, rows, bare)
  local changes, values = {}, {}
  for k, row in ipairs(rows) do
    local change = row[column] - bare[k][column]
    if row.status == "finished" and bare[k].status == "finished" and change == change then
      changes[#changes + 1], values[#values + 1] = change, bare[k][column]
    end
  end
  local change, base = statistics.of(changes), statistics.of(values)
  return { count = change.count, bare = base.mean, change = change.mean, se = change.se, sampling = base.se }
end

local function relevance(given)
  local t = core.check("relevance", given)
  outcomes.check(t.of, "of")
  if #t.effects == 0 then core.fail("'effects' is empty; name those that may matter", "effects") end
  if core.is_check() then return nil end
  local refusals = refusals_in(t.scene, t.effects)
  local function runs(effects)
    local scenes = {}
    for k = 1, t.samples do  -- what an effect draws is another in each sample, as its lattice is
      local own = {}
      for i, effect in ipairs(effects) do own[i] = core.reseeded(effect, k - 1) end
      scenes[k] = with_effects(refine.refined(t.scene, 1, k - 1), own)
    end
    return core.pilot(scenes)
  end
  local bare, bare_seconds = runs {}
  print(("%-10s %8s %12s %22s %20s %8s"):format("effect", "outcome", "bare", "change +- its se", "se of the mean",
    "cost"))
  local function compared(name, effect)
    local rows, seconds = runs { effect }
    local entry = { name = name, cost = seconds / bare_seconds }
    for _, column in ipairs(t.of) do
      local c = change_of(column, rows, bare)
      entry[column] = c
      print(("%-10s %8s %12s %22s %20s %7.0f%%  %s"):format(name, column, shown("%.4f", c.bare),
        shown("%+.2g", c.change) .. " +- " .. shown("%.1g", c.se), shown("%.2g", c.sampling), 100 * entry.cost,
        verdict_of(c, rows, bare)))
    end
    return entry
  end
  local result = {}
  for i, effect in ipairs(t.effects) do
    local name = core.effect_name(effect)
    if refusals[i] then print(("%-10s left out: %s"):format(name, refusals[i])) end
    result[i] = refusals[i] and { name = name, left_out = refusals[i] } or compared(name, effect)
  end
  return result
end

return { cost = cost, relevance = relevance }
