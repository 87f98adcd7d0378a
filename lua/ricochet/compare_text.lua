-- What ricochet.compare prints, and its list as CSV.
local text = {}

local columns = {
  { "E", "E", "%.5g" }, { "nu", "nu", "%.4f" }, { "wave_speed", "c_P", "%.4g" }, { "nodes", "nodes", "%d" },
  { "e", "e", "%.5f" }, { "contact_time", "contact time", "%.5g" },
  { "contact_time_energy", "... by energy", "%.5g" }, { "force", "greatest force", "%.5g" },
  { "inverted", "inverted", "%.2g" },
}

--- The list, a line an interior.
function text.csv(list)
  local header = { "interior" }
  for _, column in ipairs(columns) do header[#header + 1] = column[1] end
  local lines = { table.concat(header, ",") .. ",seconds,error,seconds_a_digit" }
  for i, entry in ipairs(list) do
    local cells, cost = { entry.interior }, entry.cost or { seconds = 0 / 0, error = 0 / 0, a_digit = 0 / 0 }
    for _, column in ipairs(columns) do cells[#cells + 1] = ("%.9g"):format(entry[column[1]]) end
    lines[i + 1] = ("%s,%.4g,%.4g,%.4g"):format(table.concat(cells, ","), cost.seconds, cost.error, cost.a_digit)
  end
  return table.concat(lines, "\n") .. "\n"
end

local function line(name, cells)
  for i, cell in ipairs(cells) do cells[i] = ("%20s"):format(cell) end
  print(("%-16s%s"):format(name, table.concat(cells)))
end

-- Why two may differ that are further apart than they must be.
local function reasons(a, b, v)
  local why = {}
  local function is_lattice(entry) return entry.interior == "springs" end
  if math.abs(a.nu - b.nu) > 0.01 then why[#why + 1] = ("nu is %.3f and %.3f"):format(a.nu, b.nu) end
  if is_lattice(a) ~= is_lattice(b) then why[#why + 1] = "a lattice's rim is as uneven as its spacing" end
  if a.inverted > 0 or b.inverted > 0 then
    why[#why + 1] = "triangles of springs have folded, which no elastic body does"
  end
  if a.is_linear ~= b.is_linear and v > 0.03 then
    why[#why + 1] = ("at %.2g c_P strains are no longer small, for which alone %s holds"):format(v, a.is_linear
      and a.interior or b.interior)
  end
  return #why > 0 and table.concat(why, "; ") or "a finer mesh, more modes or a shorter step would tell"
end

-- Whether two agree, in words. The bounds are those of a smooth disk on a plane: modes and elements converge to one
-- limit; lattices of 800 nodes stray from it by what their rims do.
local function verdict(a, b)
  local v = a.speed / a.wave_speed
  local bound = (a.interior == "springs" or b.interior == "springs") and 6e-3 or 2e-3
  local times = b.contact_time_energy / a.contact_time_energy - 1
  local head = ("%s and %s: e %+.5f%s"):format(b.interior, a.interior, b.e - a.e,
    times == times and (", contact time by energy %+.2f %%"):format(100 * times) or "")
  if math.abs(b.e - a.e) <= bound then return ("%s: agree within %g"):format(head, bound) end
  return ("%s: more than %g apart (%s)"):format(head, bound, reasons(a, b, v))
end

--- The table, then what must agree.
function text.print(list)
  local names = {}
  for i, entry in ipairs(list) do names[i] = entry.interior end
  line("", names)
  for _, column in ipairs(columns) do
    local cells = {}
    for i, entry in ipairs(list) do
      local value = entry[column[1]]
      cells[i] = (value ~= value or (column[1] == "nodes" and value == 0)) and "-" or column[3]:format(value)
    end
    line(column[2], cells)
  end
  for k = 1, 10 do
    local cells, is_any = {}, false
    for i, entry in ipairs(list) do
      local mode = entry.ringing[k]
      is_any = is_any or mode ~= nil
      cells[i] = mode and ("%.4f: %.5f"):format(mode.omega, mode.share) or "-"
    end
    if is_any then line(k == 1 and "omega/c_P: share" or "  (by share)", cells) end
  end
  local seconds, error, digit = {}, {}, {}
  for i, entry in ipairs(list) do
    local cost = entry.cost
    seconds[i] = cost and ("%.3f s"):format(cost.seconds) or "-"
    error[i] = cost and ("%.1g"):format(cost.error) or "-"
    digit[i] = cost and ("%.4f s"):format(cost.a_digit) or "-"
  end
  line("an impact", seconds)
  line("error of step", error)
  line("a correct digit", digit)
  for i = 2, #list do
    for k = 1, i - 1 do print(verdict(list[k], list[i])) end
  end
end

return text
