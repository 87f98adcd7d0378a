print(("a"):rep(100000):find(("a*"):rep(10) .. "b"))
