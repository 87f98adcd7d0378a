print((("a"):rep(20000):gsub(".-.-.-b[", "")))
