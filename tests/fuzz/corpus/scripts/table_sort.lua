local t = {} for i = 1, 1e5 do t[i] = i % 7 end table.sort(t, function(a, b) return true end)
