-- ricochet.series: one impact as columns of numbers over time.
local core = require "ricochet.core"
local rows_of = require("ricochet.rows").rows_of

-- What `of` asks for: columns { name =, unit =, doc =, f = }, the time first; those with `f` are functions of a state.
local function columns_of(of, units)
  local known, names = {}, {}
  for i, quantity in ipairs(core.quantities(units)) do
    known[quantity.name], names[i] = quantity, quantity.name
  end
  local columns, taken = { known.time }, { time = true }
  for i, name in ipairs(of) do
    if not known[name] then
      local named = type(name) == "string"
      core.fail(("'of' holds %s at place %d, which is no quantity%s"):format(named and "'" .. name .. "'"
        or "a " .. type(name), i, named and core.did_you_mean(name, names)
        or "; a function needs a name: name = function (state)"), "of")
    end
    if not taken[name] then columns[#columns + 1], taken[name] = known[name], true end
  end
  local own = {}
  for name, f in pairs(of) do
    local listed = math.type(name) == "integer"
    if listed and (name < 1 or name > #of) then
      core.fail(("'of' has nothing (nil) before place %d; leave no place out"):format(name), "of")
    end
    if not listed then own[#own + 1] = name end
    if not listed and type(f) ~= "function" then
      core.fail(("of.%s must be a function of the state, is a %s"):format(tostring(name), type(f)), "of")
    end
  end
  table.sort(own, function(a, b) return tostring(a) < tostring(b) end)
  for _, name in ipairs(own) do
    if type(name) ~= "string" or not name:match "^[%a_][%w_]*$" then
      core.fail(("of: '%s' cannot name a column; use letters, digits and _"):format(tostring(name)), "of")
    end
    if known[name] or name == "projectile" or name == "target" then
      core.fail(("of.%s: '%s' is a quantity already; take another name"):format(name, name), "of", name)
    end
    columns[#columns + 1] = { name = name, unit = "", doc = "a function of the script's", f = of[name] }
  end
  if #columns == 1 then core.fail("'of' names nothing beside the time; give { \"force_n\", ... }", "of") end
  return columns
end

local function value_of(column, state)
  if not column.f then return state[column.name] end
  local value = column.f(state)
  if type(value) ~= "number" then
    core.fail_in(column.f, column.name,
      ("the function must return a number, returned a %s at t = %g"):format(type(value), state.time))
  end
  return value
end

local function series(given)
  local t = core.check("series", given)
  if not t.name:match "^[%w_%-]+$" then
    core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name")
  end
  local units = core.given(t.scene).units or "paper"
  local columns, rows = columns_of(t.of, units), {}
  for i, state in ipairs(core.sample(t)) do
    local row = { units = units }
    for _, column in ipairs(columns) do row[column.name] = value_of(column, state) end
    rows[i] = core.strict(row, "a row of the series")
  end
  if not core.is_check() then core.store_series(t.scene, t.name, columns, rows) end
  return rows_of(rows)
end

return { series = series }
