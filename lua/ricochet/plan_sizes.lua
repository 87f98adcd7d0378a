-- What the pilot of a plan shows of the size of lattices or meshes, by several sizes: { { factor =, [point] = { mean =,
-- sd =, freedom = } }, ... }.
local refine = require "ricochet.refine"
local student = require "ricochet.student"

local sizes_of = {}

-- The variance that is exceeded in one of ten cases, over the one that n degrees of freedom measured: n / chi^2 at 0.1,
-- by Wilson and Hilferty's approximation, good to 1 % from 5 degrees on.
local function cautious(n)
  return 1 / math.max(0.05, 1 - 2 / (9 * n) - 1.2816 * math.sqrt(2 / (9 * n))) ^ 3
end

--- Deviation of a point's outcome over samples, pooled from all sizes of the pilot, the one to plan with, and the
--- degrees of freedom that measured it.
function sizes_of.deviation(sizes, k)
  local square, freedom = 0, 0
  for _, size in ipairs(sizes) do
    square = square + size[k].sd ^ 2 * size[k].freedom
    freedom = freedom + size[k].freedom
  end
  return math.sqrt(square / freedom), math.sqrt(square / freedom * cautious(freedom)), freedom
end

--- What the size of lattice or mesh changes at point k, per unit of the spacing over the scene's own, its standard
--- error by the pooled deviation of all sizes, and whether it is told apart from 0. Of one size nothing is known.
function sizes_of.error(sizes, k)
  if #sizes < 2 then return 0, 0, false end
  local sd, _, freedom = sizes_of.deviation(sizes, k)
  local by_spacing = {}
  for i, size in ipairs(sizes) do
    by_spacing[i] = { x = size.factor ^ -0.5, value = size[k].mean, se = sd / math.sqrt(size[k].freedom + 1) }
  end
  local slope, se = refine.fitted_line(by_spacing)
  return slope, se, student.is_seen(slope, se, sd > 0 and freedom or #sizes - 2)
end

return sizes_of
