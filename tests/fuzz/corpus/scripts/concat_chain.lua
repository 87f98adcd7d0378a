local t = {} for i = 1, 1e5 do t[i] = ("x"):rep(1e5) end table.concat(t)
