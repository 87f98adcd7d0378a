-- The outcomes of an impact, by their names.
local core = require "ricochet.core"

local outcomes = {}

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
