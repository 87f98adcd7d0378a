-- What ricochet.accuracy prints, and its rows as CSV.
local text = {}

-- "" for what is undefined, as in the CSV of rows.
local function cell(format, value)
  return value == value and math.abs(value) < math.huge and format:format(value) or ""
end

--- The rows of a study, with their errors of `columns`; `time` is the unit of steps.
function text.csv(rows, columns, time)
  local header = {
    "method", ("step [%s]"):format(time), "theta", "status", "evaluations", "seconds [s]", "energy_drift",
    "momentum_residual",
  }
  for _, column in ipairs(columns) do header[#header + 1] = "error_of_" .. column end
  local lines = { table.concat(header, ",") }
  for _, row in ipairs(rows) do
    local cells = {
      row.method, cell("%.17g", row.step), cell("%.6g", row.theta), row.status, ("%.0f"):format(row.evaluations),
      cell("%.6g", row.wall_seconds), cell("%.6g", row.energy_drift), cell("%.6g", row.momentum_residual),
    }
    for _, column in ipairs(columns) do cells[#cells + 1] = cell("%.6g", row.error[column] or 0 / 0) end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

-- What the size of the lattice or mesh changes.
local function print_sizes(study, column)
  local lattice, division = study.lattice, study.division
  for _, size in ipairs(lattice.sizes) do
    print(("%5.3g times the nodes: %s = %.4f +- %.4f (sd %.3g, %d %s), %.3f s an impact"):format(size.factor, column,
      size.mean, size.se, size.sd, size.count, division.many, size.seconds))
  end
  local slope, slope_se = math.abs(lattice.slope), lattice.slope_se
  local verdict = ", not told apart from 0 by this many " .. (lattice.scatters and "samples" or "sizes")
  print(("error of %s from the size of the %s: %.2g +- %.2g against an infinitely fine one%s"):format(column,
    division.one, slope, slope_se, slope > 2 * slope_se and "" or verdict))
end

--- The table of a study, the orders of its methods, and what the rest of the error comes from.
function text.print(study)
  local column = study.columns[1]
  print(study.caption)
  print(("%-20s %11s %6s %10s %9s %11s %11s"):format("method", ("step [%s]"):format(study.time_unit), "theta",
    "force eval", "time [s]", "error of " .. column, "energy drift"))
  for _, row in ipairs(study.rows) do
    if row.status == "finished" then
      print(("%-20s %11.4g %6.2f %10.0f %9.3f %11.2g %11.2g"):format(row.method, row.step, row.theta, row.evaluations,
        row.wall_seconds, row.error[column], row.energy_drift))
    else
      print(("%-20s %11s   %s: %s"):format(row.method, cell("%.4g", row.step), row.status, row.reason))
    end
  end
  for _, method in ipairs(study.methods) do
    local order = study.order[method]
    print(order
      and ("%-20s %s falls with order %.2f +- %.2f of the step"):format(method, "error of " .. column, order.slope,
        order.se)
      or ("%-20s fewer than three steps are above ten times the floor: no order to be seen"):format(method))
  end
  if study.lattice then print_sizes(study, column) end
  if study.softness then
    print(("error of %s from the softness of the contact: about %.2g (xi = %.4g, chosen by the program, and twice as "
      .. "hard)"):format(column, study.softness.error[column], study.softness.xi))
  end
  print(("floor %.2g: the difference of two references; below ten times that no error is told"):format(
    study.floor[column]))
end

return text
