local t = {} table.move(t, 1, 1e15, 2)
