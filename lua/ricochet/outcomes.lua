-- The outcomes of an impact, by their names.
local core = require "ricochet.core"

local outcomes = {}

--- Names that a sweep's own values may share with a column: the row holds what was asked for under the name and as
--- over_NAME, and what came of it as outcome_NAME. Files have the latter under the name itself.
outcomes.shared = { "psi1", "seed", "step" }

--- Name -> unit of every column of an impact, and of those behind a sweep's values.
function outcomes.units(system)
  local units = core.columns(system)
  for _, name in ipairs(outcomes.shared) do units["outcome_" .. name] = units[name] end
  return units
end

--- A name that is no outcome is a mistake in `field` of the user's call.
function outcomes.check(names, field)
  local known = core.columns()
  local list = {}
  for name in pairs(known) do list[#list + 1] = name end
  for _, name in ipairs(names) do
    if not known[name] then
      core.fail(("an outcome has no '%s'%s"):format(name, core.did_you_mean(name, list)), field)
    end
  end
end

return outcomes
