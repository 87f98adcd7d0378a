local s = ("x"):rep(1e6) while true do print(s) end
