-- Which names of `over` change the lattice, so that points which share one are run together.
local core = require "ricochet.core"
local points = require "ricochet.points"

local lattices = {}

--- A list of { name =, values =, changes_lattice = }, one a factor: does another value of it alone make another
--- lattice? Where this is wrong, it takes longer, and comes to the same. `make`: the scene at values of `over`;
--- `where`: why it must be a function of them, for an error.
function lattices.names_of(sweep, first, make, where)
  local group, _, hash = core.lattice(first)
  local names = {}
  for i, factor in ipairs(sweep.factors) do
    local count, changes = #sweep.over[factor.names[1]], false
    for _, k in ipairs { 2, count } do
      if k > 1 and k <= count then
        local values = points.values_at(sweep, 0)
        points.set(sweep, factor, values, k)
        changes = changes or core.lattice(make(values)) ~= group
      end
    end
    names[i] = { name = table.concat(factor.names, " "), values = count, changes_lattice = changes }
  end
  local _, _, again = core.lattice(make(points.values_at(sweep, 0)))
  if again ~= hash then
    core.fail_in(sweep.scene, "scene", "the function returned two different scenes for the same values: " .. where ..
      " it must depend on `at` alone, not on what it was called for before")
  end
  return names
end

return lattices
