for i = 1, 1e12 do math.random() end
