-- Walton's parameters of impacts, with the standard errors of a jackknife over samples.
local core = require "ricochet.core"
local statistics = require "ricochet.statistics"

--- theory.fit_walton of lists psi1, psi2, e and sample, whose errors it replaces: impacts of a sample share its
--- lattices, so what counts is the fit without each sample in turn.
local function walton_fit(columns, beta_x)
  local fit = core.theory.fit_walton { psi1 = columns.psi1, psi2 = columns.psi2, e = columns.e, beta_x = beta_x }
  local samples, others = {}, {}
  for _, sample in ipairs(columns.sample) do samples[sample] = true end
  for left_out in pairs(samples) do
    local some = { psi1 = {}, psi2 = {}, e = {} }
    for i, sample in ipairs(columns.sample) do
      if sample ~= left_out then
        for name, list in pairs(some) do list[#list + 1] = columns[name][i] end
      end
    end
    some.beta_x = beta_x
    local whole, other = pcall(core.theory.fit_walton, some)
    others[#others + 1] = whole and other or nil
  end
  for _, name in ipairs { "e", "mu", "beta0" } do
    local values = {}
    for i, other in ipairs(others) do values[i] = other[name] end
    fit[name .. "_se"] = statistics.jackknife(values)
  end
  return fit
end

return walton_fit
