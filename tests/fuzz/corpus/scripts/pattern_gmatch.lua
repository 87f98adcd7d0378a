for w in ("a"):rep(20000):gmatch(".-.-.-b") do print(w) end
