print(utf8.len(("x"):rep(1e9)))
